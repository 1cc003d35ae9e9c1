//! Random mechanisms with redundant constraints, each with its regular twin.

use crate::linkage::Random;
use serde_json::{Value, json};

type V = [f64; 2];

fn turn(angle: f64, [x, y]: V) -> V {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y]
}

fn plus(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1]]
}

fn minus(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1]]
}

/// A model under construction, with points given by their places in the world.
struct Maker {
    random: Random,
    model: Value,
}

impl Maker {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * 0.5 * (self.random.signed() + 1.0)
    }

    fn place(&mut self, reach: f64) -> V {
        [self.within(-reach, reach), self.within(-reach, reach)]
    }

    /// A body with its frame anywhere.
    fn body(&mut self, name: &str, points: &[(&str, V)]) {
        let (origin, angle) = (self.place(0.5), self.within(-3.0, 3.0));
        let (mass, inertia, com) = (
            self.within(0.2, 3.0),
            self.within(0.01, 0.3),
            self.place(0.4),
        );
        let local: serde_json::Map<String, Value> = points
            .iter()
            .map(|(point, at)| (point.to_string(), json!(turn(-angle, minus(*at, origin)))))
            .collect();
        self.model["bodies"][name] = json!({ "mass": mass, "inertia": inertia, "com": com, "points": local,
            "pose": { "position": origin, "angle": angle } });
    }

    fn pin(&mut self, name: &str, first: &str, second: &str) {
        self.model["joints"][name] = json!({ "type": "revolute", "between": [first, second] });
    }

    /// Angle of a body in the drawing.
    fn angle(&self, body: &str) -> f64 {
        self.model["bodies"][body]["pose"]["angle"]
            .as_f64()
            .expect("drawn")
    }

    /// The second body fixed to the first as they are drawn.
    fn weld(model: &mut Value, name: &str, [first, second]: [(&str, &str); 2], angle: f64) {
        let between = [
            format!("{}.{}", first.0, first.1),
            format!("{}.{}", second.0, second.1),
        ];
        model["joints"][name] = json!({ "type": "fixed", "between": between, "angle": angle });
    }

    /// Pendulums, each on the one before, the first on a point at `from` of a body.
    fn hang(&mut self, count: usize, on: &str, mut from: V) {
        let mut holder = on.to_string();
        for k in 0..count {
            let end = plus(from, self.place(0.6));
            let name = format!("hung{k}");
            self.body(&name, &[("H", from), ("E", end)]);
            self.pin(&format!("h{k}"), &holder, &format!("{name}.H"));
            (holder, from) = (format!("{name}.E"), end);
        }
    }
}

/// The mechanism and its regular twin, and columns that both have.
pub struct Pair {
    pub kind: &'static str,
    pub redundant: Value,
    pub regular: Value,
    pub columns: Vec<String>,
}

pub fn pair(seed: u64) -> Pair {
    let mut random = Random(seed);
    let model = json!({ "format": "linkdyn/1", "units": "SI", "gravity": [random.signed() * 9.81, random.signed() * 9.81],
        "bodies": { "ground": { "points": {} } }, "joints": {}, "drivers": {} });
    let mut maker = Maker { random, model };
    let kind = maker.random.below(4);
    let more = 1 + maker.random.below(3);
    let mut pair = [parallel_cranks, doubled_bar, doubled_pin, braced_box][kind](&mut maker, more);
    let rtol = 10f64.powf(maker.within(-11.0, -6.0));
    let end = maker.within(0.5, 2.0);
    for model in [&mut pair.redundant, &mut pair.regular] {
        model["analysis"] = json!({ "type": "dynamics", "end": end, "outputs": 21,
            "solver": { "rtol": rtol, "atol": rtol, "max_wall_time": 20 } });
    }
    let (anchor, stiffness, omega) = (
        maker.place(1.0),
        maker.within(5.0, 50.0),
        maker.within(-8.0, 8.0),
    );
    for model in [&mut pair.redundant, &mut pair.regular] {
        if seed.is_multiple_of(3) {
            model["bodies"]["ground"]["points"]["S"] = json!(anchor);
            model["forces"]["spring"] = json!({ "type": "spring", "between": ["ground.S", "hung0.E"], "stiffness": stiffness, "free_length": 0.3 });
        }
        // Whatever else moves at the start is what has least energy, by the twin's sums as well.
        if seed.is_multiple_of(2) {
            model["initial"]["hung0"] = json!({ "angular_velocity": omega });
        }
    }
    pair.columns
        .extend((0..more).map(|k| format!("hung{k}.angle")));
    pair
}

/// The cranks and the plate as one body on a pivot, whose end is at `arm`.
fn one_crank(model: &Value, inertia: f64, moment: V, arm: V) -> Value {
    let mut regular = model.clone();
    let bodies = regular["bodies"].as_object_mut().expect("bodies");
    bodies.retain(|name, _| name == "ground" || name.starts_with("hung"));
    // So heavy that what is left for the inertia is positive.
    let square = moment[0] * moment[0] + moment[1] * moment[1];
    let heavy = 2.0 * square / inertia + 1.0;
    let com = moment.map(|m| m / heavy);
    bodies.insert(
        "one".into(),
        json!({ "mass": heavy, "inertia": inertia - square / heavy, "com": com,
        "points": { "P": [0, 0], "A": arm } }),
    );
    let joints = regular["joints"].as_object_mut().expect("joints");
    joints.retain(|name, _| name.starts_with('h'));
    joints.insert(
        "p".into(),
        json!({ "type": "revolute", "between": ["ground.P0", "one.P"] }),
    );
    joints["h0"]["between"][0] = json!("one.A");
    regular
}

/// A plate that moves without turning: with energy ½ (Σ I + Σ m c² + M r²) θ̇² and moment of gravity Σ m c + M r it moves
/// as one body with these sums, whose end at r has the motion of each of the plate's points.
fn parallel_cranks(maker: &mut Maker, more: usize) -> Pair {
    let cranks = 3 + maker.random.below(2);
    // Flat positions of two cranks and the plate are among the starts.
    let theta = if maker.random.below(4) == 0 {
        0.0
    } else {
        maker.within(-3.1, 3.1)
    };
    let arm = turn(theta, [maker.within(0.1, 0.6), 0.0]);
    let feet: Vec<V> = (0..cranks)
        .map(|k| {
            if k == 1 && theta == 0.0 {
                [0.7, 0.0]
            } else if k == 0 {
                [0.0; 2]
            } else {
                maker.place(0.8)
            }
        })
        .collect();
    let (mut inertia, mut moment) = (0.0, [0.0; 2]);
    let mut ground = json!({});
    for (k, foot) in feet.iter().enumerate() {
        ground[format!("P{k}")] = json!(foot);
        let name = format!("crank{k}");
        maker.body(&name, &[("P", *foot), ("A", plus(*foot, arm))]);
        let body = &maker.model["bodies"][&name];
        let number = |value: &Value| value.as_f64().expect("a number");
        let [mass, own, angle] =
            [&body["mass"], &body["inertia"], &body["pose"]["angle"]].map(number);
        let at = |value: &Value| [number(&value[0]), number(&value[1])];
        let com = minus(
            plus(at(&body["pose"]["position"]), turn(angle, at(&body["com"]))),
            *foot,
        );
        inertia += own + mass * (com[0] * com[0] + com[1] * com[1]);
        moment = plus(moment, com.map(|c| mass * c));
    }
    maker.model["bodies"]["ground"]["points"] = ground;
    let plate: Vec<(String, V)> = feet
        .iter()
        .enumerate()
        .map(|(k, foot)| (format!("A{k}"), plus(*foot, arm)))
        .collect();
    let points: Vec<(&str, V)> = plate
        .iter()
        .map(|(name, at)| (name.as_str(), *at))
        .collect();
    maker.body("plate", &points);
    let mass = maker.model["bodies"]["plate"]["mass"]
        .as_f64()
        .expect("a number");
    inertia += mass * (arm[0] * arm[0] + arm[1] * arm[1]);
    moment = plus(moment, arm.map(|a| mass * a));
    for k in 0..cranks {
        maker.pin(
            &format!("p{k}"),
            &format!("ground.P{k}"),
            &format!("crank{k}.P"),
        );
        maker.pin(
            &format!("a{k}"),
            &format!("crank{k}.A"),
            &format!("plate.A{k}"),
        );
    }
    maker.hang(more, "plate.A0", plus(feet[0], arm));
    let regular = one_crank(&maker.model, inertia, moment, arm);
    Pair {
        kind: "parallel cranks",
        redundant: maker.model.clone(),
        regular,
        columns: Vec::new(),
    }
}

/// A body on a pivot, and a bar from the pivot to another point of it.
fn doubled_bar(maker: &mut Maker, more: usize) -> Pair {
    let (end, hook) = (maker.place(0.7), maker.place(0.7));
    maker.model["bodies"]["ground"]["points"] = json!({ "O": [0, 0] });
    maker.body("b1", &[("O", [0.0; 2]), ("E", end), ("H", hook)]);
    maker.body("bar", &[("O", [0.0; 2]), ("E", end)]);
    maker.pin("j1", "ground.O", "b1.O");
    maker.pin("j2", "b1.E", "bar.E");
    maker.hang(more, "b1.H", hook);
    let mut regular = maker.model.clone();
    let angle = maker.angle("bar") - maker.angle("b1");
    Maker::weld(&mut regular, "j2", [("b1", "E"), ("bar", "E")], angle);
    maker.pin("j3", "ground.O", "bar.O");
    let columns = ["b1.angle", "bar.angle"].map(String::from).to_vec();
    Pair {
        kind: "doubled bar",
        redundant: maker.model.clone(),
        regular,
        columns,
    }
}

/// A chain with one of its pins twice.
fn doubled_pin(maker: &mut Maker, more: usize) -> Pair {
    let hook = maker.place(0.7);
    maker.model["bodies"]["ground"]["points"] = json!({ "O": [0, 0] });
    maker.body("b1", &[("O", [0.0; 2]), ("H", hook)]);
    maker.pin("j1", "ground.O", "b1.O");
    maker.hang(more, "b1.H", hook);
    let regular = maker.model.clone();
    if maker.random.below(2) == 0 {
        maker.pin("j2", "ground.O", "b1.O");
    } else {
        maker.pin("j2", "b1.H", "hung0.H");
    }
    Pair {
        kind: "doubled pin",
        redundant: maker.model.clone(),
        regular,
        columns: vec!["b1.angle".into()],
    }
}

/// Four bars from corner to corner of a quadrangle on a pivot, and both its diagonals.
fn braced_box(maker: &mut Maker, more: usize) -> Pair {
    let tilt = maker.within(-3.1, 3.1);
    let square = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.5], [0.0, 0.5]];
    let corners: Vec<V> = square
        .iter()
        .enumerate()
        .map(|(k, corner)| {
            if k == 0 {
                [0.0; 2]
            } else {
                turn(tilt, plus(*corner, maker.place(0.15)))
            }
        })
        .collect();
    maker.model["bodies"]["ground"]["points"] = json!({ "O": [0, 0] });
    let ends = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)];
    for (k, &(from, to)) in ends.iter().enumerate() {
        maker.body(
            &format!("bar{k}"),
            &[("F", corners[from]), ("T", corners[to])],
        );
    }
    maker.pin("o", "ground.O", "bar0.F");
    for k in 0..3 {
        maker.pin(
            &format!("c{k}"),
            &format!("bar{k}.T"),
            &format!("bar{}.F", k + 1),
        );
    }
    maker.pin("c3", "bar3.T", "bar0.F");
    maker.pin("d0", "bar0.F", "bar4.F");
    maker.pin("d1", "bar1.T", "bar4.T");
    maker.hang(more, "bar1.T", corners[2]);
    let mut regular = maker.model.clone();
    maker.pin("e0", "bar0.T", "bar5.F");
    maker.pin("e1", "bar2.T", "bar5.T");
    let angle = maker.angle("bar5") - maker.angle("bar0");
    Maker::weld(&mut regular, "e0", [("bar0", "T"), ("bar5", "F")], angle);
    let columns = ["bar0.angle", "bar2.angle", "bar5.angle"]
        .map(String::from)
        .to_vec();
    Pair {
        kind: "box",
        redundant: maker.model.clone(),
        regular,
        columns,
    }
}
