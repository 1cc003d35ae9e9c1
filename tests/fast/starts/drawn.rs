//! Linkages as models.

use super::linkage::{FAR, GROUND, Linkage, Step, TIP};
use crate::mechanisms::pin;
use serde_json::{Value, json};

impl Linkage {
    /// By how much columns are off the places of the points.
    pub fn off(&self, places: &[[f64; 2]], column: impl Fn(&str) -> f64) -> f64 {
        let bodies = self.bodies(places);
        let off = bodies.iter().map(|(name, place, angle, _)| {
            let turned = column(&format!("{name}.angle")) - angle;
            let off = [
                column(&format!("{name}.x")) - place[0],
                column(&format!("{name}.y")) - place[1],
                (0.5 * turned).sin() * 2.0,
            ];
            off.iter().fold(0.0, |most: f64, off| most.max(off.abs()))
        });
        off.fold(0.0, f64::max)
    }

    /// Name, place and angle of each body, and its points.
    fn bodies(&self, places: &[[f64; 2]]) -> Vec<(String, [f64; 2], f64, Value)> {
        let at = |k: usize| if k == FAR { self.ground[2] } else { places[k] };
        let rod = |name: String, from: usize, to: usize, length: f64, side: f64| {
            let (p, q) = (at(from), at(to));
            let angle = (side * (q[1] - p[1])).atan2(side * (q[0] - p[0]));
            let points = json!({ "A": [0.0, 0.0], "B": [side * length, 0.0] });
            (name, p, angle, points)
        };
        let mut bodies = vec![rod("crank".into(), 0, TIP, self.crank, 1.0)];
        for (k, step) in self.steps.iter().enumerate() {
            let own = k + 3;
            match *step {
                Step::Rods { from, lengths, .. } => {
                    for (j, (from, length)) in from.into_iter().zip(lengths).enumerate() {
                        bodies.push(rod(format!("r{own}{j}"), from, own, length, 1.0));
                    }
                }
                Step::Slider { from, length, .. } => {
                    bodies.push(rod(format!("r{own}"), from, own, length, 1.0));
                    bodies.push((format!("s{own}"), at(own), 0.0, json!({ "A": [0.0, 0.0] })));
                }
                Step::Arm {
                    pivot,
                    length,
                    side,
                    ..
                } => {
                    bodies.push(rod(format!("r{own}"), pivot, own, length, side));
                }
                Step::Carried { body, place } => {
                    // The rod that goes to the second point is the other way round where it begins there.
                    let name = match body[0] {
                        GROUND => format!("r{}0", body[1]),
                        _ => format!("r{}1", body[1]),
                    };
                    let owner = bodies.iter_mut().find(|(own, ..)| *own == name);
                    let (.., points) = owner.expect("a rod");
                    points["C"] = json!(place);
                }
            }
        }
        bodies
    }

    /// The end of a body, or a point of ground, that lies at a point.
    fn end(&self, point: usize) -> String {
        match point {
            0 => "ground.P0".into(),
            GROUND => "ground.P1".into(),
            TIP => "crank.B".into(),
            FAR => "ground.P2".into(),
            _ => match &self.steps[point - 3] {
                Step::Rods { .. } => format!("r{point}0.B"),
                Step::Slider { .. } | Step::Arm { .. } => format!("r{point}.B"),
                Step::Carried { body, .. } => match body[0] {
                    GROUND => format!("r{}0.C", body[1]),
                    _ => format!("r{}1.C", body[1]),
                },
            },
        }
    }

    /// The model, drawn at a crank's angle with places of so many digits.
    pub fn model(&self, drawn: f64, digits: f64) -> Value {
        let round = |x: f64| (x * digits).round() / digits;
        let places = self.places(drawn).expect("an assembly");
        let mut bodies = json!({ "ground": { "points": {} } });
        for (k, place) in self.ground.iter().enumerate() {
            bodies["ground"]["points"][format!("P{k}")] = json!(place);
        }
        for (name, place, angle, points) in self.bodies(&places) {
            bodies[name] = json!({ "mass": 1.0, "inertia": 0.1, "com": [0.0, 0.0], "points": points,
                "pose": { "position": place.map(round), "angle": round(angle) } });
        }
        let mut joints = json!({ "shaft": pin("ground.P0", "crank.A") });
        for (k, step) in self.steps.iter().enumerate() {
            let own = k + 3;
            match *step {
                Step::Rods { from, .. } => {
                    for (j, from) in from.into_iter().enumerate() {
                        joints[format!("p{own}{j}")] =
                            pin(&self.end(from), &format!("r{own}{j}.A"));
                    }
                    joints[format!("q{own}")] = pin(&format!("r{own}0.B"), &format!("r{own}1.B"));
                }
                Step::Slider { from, y, .. } => {
                    let height = format!("H{own}");
                    bodies["ground"]["points"][&height] = json!([0.0, y]);
                    joints[format!("p{own}")] = pin(&self.end(from), &format!("r{own}.A"));
                    joints[format!("q{own}")] = pin(&format!("r{own}.B"), &format!("s{own}.A"));
                    joints[format!("g{own}")] = json!({ "type": "prismatic", "axis": [1.0, 0.0],
                        "between": [format!("ground.{height}"), format!("s{own}.A")] });
                }
                Step::Arm {
                    pivot, pin: tip, ..
                } => {
                    joints[format!("p{own}")] = pin(&self.end(pivot), &format!("r{own}.A"));
                    joints[format!("g{own}")] = json!({ "type": "slot", "axis": [1.0, 0.0],
                        "between": [format!("r{own}.A"), self.end(tip)] });
                }
                Step::Carried { .. } => {}
            }
        }
        json!({ "format": "linkdyn/1", "units": "SI", "bodies": bodies, "joints": joints,
            "analysis": { "type": "assembly" } })
    }
}
