//! Makes random linkages, and the models that say the same.

use super::super::told::Random;
use super::{Asked, Frame, Led, Linkage, Number, Point, Source, Vector, add, less, turn};
use serde_json::{Map, Value, json};

/// What makes a linkage.
struct Maker<'r> {
    random: &'r mut Random,
    /// Tolerances are of this size \[m\].
    size: f64,
    linkage: Linkage,
    parameters: Map<String, Value>,
    bodies: Map<String, Value>,
    joints: Map<String, Value>,
    names: Vec<String>,
    /// Points that others may hang on: body and name.
    free: Vec<(usize, String, Point)>,
}

impl Maker<'_> {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.random.next()
    }

    fn is(&mut self, likely: f64) -> bool {
        self.random.next() < likely
    }

    /// A new source with a reach, of one or two numbers.
    fn source(&mut self, reach: f64, is_disc: bool) -> Option<usize> {
        let at = self.linkage.count;
        let source = match is_disc {
            true => Source::Disc { at, radius: reach },
            false => Source::Line {
                at,
                ends: [-reach, reach],
            },
        };
        self.linkage.sources.push(source);
        self.linkage.count += 1 + usize::from(is_disc);
        Some(at)
    }

    /// A number of the geometry, and what the file says of it.
    fn number(&mut self, value: f64) -> (Number, Value) {
        if !self.is(0.4) {
            return (Number(value, None), json!(value));
        }
        let reach = self.size * self.between(0.3, 1.0);
        let name = format!("p{}", self.parameters.len());
        self.parameters
            .insert(name.clone(), json!({ "value": value, "tolerance": reach }));
        (
            Number(value, self.source(reach, false)),
            json!(format!("={name}")),
        )
    }

    /// A point, and what the file says of it.
    fn point(&mut self, [x, y]: Vector) -> (Point, Value) {
        let ((x, first), (y, second)) = (self.number(x), self.number(y));
        (Point([x, y], None), json!([first, second]))
    }

    /// A zone, perhaps, and what the file says of its point.
    fn zone(&mut self, place: Value) -> (Option<usize>, Value) {
        if !self.is(0.3) {
            return (None, place);
        }
        let reach = self.size * self.between(0.3, 1.0);
        let told = json!({ "position": place, "tolerance": 2.0 * reach });
        (self.source(reach, true), told)
    }

    /// A pin between two points, with a clearance or none.
    fn pin(&mut self, ends: [String; 2]) -> Option<usize> {
        let mut joint = json!({ "type": "revolute", "between": ends });
        let mut gap = None;
        if self.is(0.8) {
            let radius = self.size * self.between(0.3, 1.0);
            joint["clearance"] = json!({ "model": "ideal", "radius": radius });
            gap = self.source(radius, true);
        }
        self.joints.insert(format!("j{}", self.joints.len()), joint);
        gap
    }

    /// A body at a place, with its points; its number.
    fn body(&mut self, [x, y, angle]: Frame, points: Value) -> usize {
        let number = self.names.len();
        let name = format!("b{number}");
        let told = json!({ "points": points, "pose": { "position": [x, y], "angle": angle } });
        self.bodies.insert(name.clone(), told);
        self.names.push(name);
        number
    }

    /// A point of the ground.
    fn ground(&mut self, place: Vector) -> (String, Point) {
        let (point, told) = self.point(place);
        let points = self.bodies["ground"]["points"].as_object_mut();
        let points = points.expect("points");
        let name = format!("g{}", points.len());
        points.insert(name.clone(), told);
        (format!("ground.{name}"), point)
    }

    /// A place not too far from another.
    fn near(&mut self, [x, y]: Vector) -> Vector {
        let far = self.between(0.15, 0.35);
        let angle = std::f64::consts::PI * self.random.both();
        add([x, y], turn([far, 0.0], angle))
    }

    fn wheel(&mut self) {
        let drawn = self.near([0.0; 2]);
        let ratio = if self.is(0.5) { -1.0 } else { -2.0 };
        let points = self.bodies["ground"]["points"].as_object_mut();
        let name = format!("g{}", points.as_ref().expect("points").len());
        points.expect("points").insert(name.clone(), json!(drawn));
        let centre = Point(drawn.map(|by| Number(by, None)), None);
        let own = self.between(0.05, 0.1);
        let (x, told) = self.number(own);
        let angle = std::f64::consts::PI * self.random.both();
        let turned = angle + ratio * self.linkage.angle;
        let body = self.body(
            [drawn[0], drawn[1], turned],
            json!({ "O": [0, 0], "A": [told, 0] }),
        );
        let name = format!("ground.{name}");
        let own = self.names[body].clone();
        let gap = self.pin([name, format!("{own}.O")]);
        self.joints.insert(
            "mesh".into(),
            json!({ "type": "gear", "between": ["b1.O", format!("{own}.O")], "ratio": ratio, "angle": angle }),
        );
        self.linkage.led.push(Led::Wheel {
            ratio,
            angle,
            centre,
            gap,
        });
        self.free.push((
            body,
            format!("{own}.A"),
            Point([x, Number(0.0, None)], None),
        ));
    }

    /// Where the free point of a number is drawn.
    fn drawn(&self, number: usize) -> Vector {
        let nothing = vec![0.0; self.linkage.count];
        let (body, _, point) = &self.free[number];
        point.at(self.linkage.frames(&nothing)[*body], &nothing)
    }

    fn dyad(&mut self) {
        let last = self.free.len() - 1;
        let a = self.drawn(last);
        let (from, hung, point) = self.free[last].clone();
        // The second link hangs on the wheel before there is another, else on the ground.
        let second = (self.names.len() == 3 && last == 1).then(|| self.free[0].clone());
        let (to, far, pivot, c) = match second {
            Some((body, name, point)) => (body, name, point, self.drawn(0)),
            None => {
                let place = self.near(a);
                let (name, pivot) = self.ground(place);
                (0, name, pivot, place)
            }
        };
        let middle = [0.5 * (a[0] + c[0]), 0.5 * (a[1] + c[1])];
        let m = self.near(middle);
        let ([u, v], [s, t]) = (less(m, a), less(m, c));
        let ((l, first), (r, other)) = (self.number(u.hypot(v)), self.number(s.hypot(t)));
        let (zone, other) = self.zone(json!([other, 0.0]));
        let mut tips = [0.25, 0.35].map(|far| [far * self.random.next(), 0.2 * self.random.both()]);
        let tips = tips.each_mut().map(|tip| self.point(*tip));
        let [(p, p_told), (w, w_told)] = tips;
        let one = self.body(
            [a[0], a[1], v.atan2(u)],
            json!({ "A": [0, 0], "B": [first, 0], "P": p_told }),
        );
        let two = self.body(
            [c[0], c[1], t.atan2(s)],
            json!({ "A": [0, 0], "B": other, "P": w_told }),
        );
        let [one_name, two_name] = [one, two].map(|body| self.names[body].clone());
        let gaps = [
            self.pin([hung, format!("{one_name}.A")]),
            self.pin([far, format!("{two_name}.A")]),
            self.pin([format!("{one_name}.B"), format!("{two_name}.B")]),
        ];
        let ([x, y], [dx, dy]) = (less(m, a), less(c, a));
        self.linkage.led.push(Led::Dyad {
            hang: [(from, point, gaps[0]), (to, pivot, gaps[1])],
            long: [l, r],
            zone,
            gap: gaps[2],
            side: (dx * y - dy * x).signum(),
        });
        self.free.push((two, format!("{two_name}.P"), w));
        self.free.push((one, format!("{one_name}.P"), p));
        self.linkage.asked.extend([
            Asked::Angle(two),
            Asked::Place(one, p, 1),
            Asked::Place(two, w, 0),
        ]);
    }

    fn rocker(&mut self) {
        let last = self.free.len() - 1;
        let through = self.drawn(last);
        let (body, hung, point) = self.free[last].clone();
        let c = self.near(through);
        let (name, pivot) = self.ground(c);
        let [x, y] = less(through, c);
        let tip = [self.between(0.2, 0.4), 0.2 * self.random.both()];
        let (tip, told) = self.point(tip);
        let (zone, slot) = self.zone(json!([0, 0]));
        let own = self.body(
            [c[0], c[1], y.atan2(x)],
            json!({ "A": [0, 0], "S": slot, "P": told }),
        );
        let own_name = self.names[own].clone();
        let gap = self.pin([name, format!("{own_name}.A")]);
        let mut joint =
            json!({ "type": "slot", "between": [format!("{own_name}.S"), hung], "axis": [1, 0] });
        let mut play = None;
        if self.is(0.6) {
            let reach = self.size * self.between(0.3, 1.0);
            joint["play"] = json!(reach);
            play = self.source(reach, false);
        }
        self.joints.insert(format!("j{}", self.joints.len()), joint);
        self.linkage.led.push(Led::Rocker {
            pivot: (pivot, gap),
            through: (body, point),
            zone,
            play,
        });
        self.free.push((own, format!("{own_name}.P"), tip));
        self.linkage
            .asked
            .extend([Asked::Angle(own), Asked::Place(own, tip, 0)]);
    }
}

/// A linkage with deviations of a size \[m\].
pub fn linkage(random: &mut Random, size: f64) -> Linkage {
    let angle = std::f64::consts::PI * random.both();
    let mut maker = Maker {
        random,
        size,
        linkage: Linkage {
            sources: Vec::new(),
            count: 0,
            model: Value::Null,
            angle,
            driver: None,
            pivot: None,
            led: Vec::new(),
            asked: Vec::new(),
        },
        parameters: Map::new(),
        bodies: Map::new(),
        joints: Map::new(),
        names: vec!["ground".into()],
        free: Vec::new(),
    };
    maker
        .bodies
        .insert("ground".into(), json!({ "points": { "O": [0, 0] } }));
    let own = maker.between(0.05, 0.12);
    let (x, told) = maker.number(own);
    maker.body([0.0, 0.0, angle], json!({ "O": [0, 0], "A": [told, 0] }));
    maker.linkage.pivot = maker.pin(["ground.O".into(), "b1.O".into()]);
    let reach = 10.0 * size * maker.between(0.3, 1.0);
    maker.linkage.driver = maker.source(reach, false);
    if maker.is(0.3) {
        maker.wheel();
    }
    maker
        .free
        .push((1, "b1.A".into(), Point([x, Number(0.0, None)], None)));
    let stages = 1 + (3.0 * maker.random.next()) as usize;
    for _ in 0..stages {
        if maker.free.len() == 2 || maker.is(0.5) {
            maker.dyad();
        } else {
            maker.rocker();
        }
    }
    finish(maker, reach)
}

fn finish(maker: Maker, reach: f64) -> Linkage {
    let Maker {
        mut linkage,
        parameters,
        bodies,
        joints,
        names,
        ..
    } = maker;
    let mut outputs = Map::new();
    for (number, asked) in linkage.asked.iter().enumerate() {
        let column = match asked {
            Asked::Angle(body) => format!("{}.angle", names[*body]),
            Asked::Place(body, _, axis) => format!("{}.P.{}", names[*body], ["x", "y"][*axis]),
        };
        let at = json!({ "value": linkage.angle });
        outputs.insert(format!("o{number}"), json!({ "column": column, "at": at }));
    }
    let motion = json!({ "type": "constant_velocity", "start": linkage.angle, "velocity": 1 });
    linkage.model = json!({
        "format": "linkdyn/1",
        "name": "random",
        "units": { "length": "m", "angle": "rad" },
        "parameters": parameters,
        "bodies": bodies,
        "joints": joints,
        "drivers": { "motor": { "type": "rotation", "body": "b1", "motion": motion, "tolerance": reach } },
        "analysis": { "type": "kinematics", "end": 0.001, "outputs": 2 },
        "accuracy": { "outputs": outputs },
    });
    linkage
}
