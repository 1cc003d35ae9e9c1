//! Linkages for wanted motions: known ones are found again, what is found is held against the law of cosines, and defects are told.

mod defects;
mod known;

use linkdyn::ask::Synthesised;
use linkdyn::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::TAU;

type Place = [f64; 2];

fn plus([a, b]: Place, [c, d]: Place) -> Place {
    [a + c, b + d]
}

fn minus([a, b]: Place, [c, d]: Place) -> Place {
    [a - c, b - d]
}

/// Complex product.
fn times([a, b]: Place, [c, d]: Place) -> Place {
    [a * c - b * d, a * d + b * c]
}

fn polar(length: f64, angle: f64) -> Place {
    [length * angle.cos(), length * angle.sin()]
}

fn length([x, y]: Place) -> f64 {
    x.hypot(y)
}

/// A four-bar by its lengths; the rocker's pin is left of the way from crank pin to rocker pivot where `side` is 1.
#[derive(Debug, Clone, Copy)]
struct FourBar {
    pivots: [Place; 2],
    crank: f64,
    coupler: f64,
    rocker: f64,
    /// The point along and across the coupler.
    point: Place,
    side: f64,
}

/// A crank that turns fully.
const KNOWN: FourBar = FourBar {
    pivots: [[0.02, -0.01], [0.32, 0.04]],
    crank: 0.1,
    coupler: 0.32,
    rocker: 0.22,
    point: [0.16, 0.19],
    side: 1.0,
};

impl FourBar {
    /// Crank pin, rocker pin, point; `None` where it does not close.
    fn pins(&self, angle: f64) -> Option<[Place; 3]> {
        let a = plus(self.pivots[0], polar(self.crank, angle));
        let way = minus(self.pivots[1], a);
        let d = length(way);
        let cosine =
            (d * d + self.coupler.powi(2) - self.rocker.powi(2)) / (2.0 * d * self.coupler);
        if cosine.abs() > 1.0 {
            return None;
        }
        let along = way[1].atan2(way[0]) + self.side * cosine.acos();
        let turn = polar(1.0, along);
        Some([
            a,
            plus(a, times(turn, [self.coupler, 0.0])),
            plus(a, times(turn, self.point)),
        ])
    }

    fn point(&self, angle: f64) -> Place {
        self.pins(angle).expect("closed")[2]
    }

    /// The coupler's angle.
    fn angle(&self, angle: f64) -> f64 {
        let [a, b, _] = self.pins(angle).expect("closed");
        let way = minus(b, a);
        way[1].atan2(way[0])
    }

    /// The rocker's angle.
    fn rocker(&self, angle: f64) -> f64 {
        let way = minus(self.pins(angle).expect("closed")[1], self.pivots[1]);
        way[1].atan2(way[0])
    }

    /// Of a model that was found.
    fn of(model: &Value) -> FourBar {
        let metres = |name: &str| -> f64 {
            let text = model["parameters"][name].as_str().unwrap_or("0 m");
            text.strip_suffix(" m")
                .expect("metres")
                .parse()
                .expect("a number")
        };
        let place = |name: &str| [metres(&format!("{name}_x")), metres(&format!("{name}_y"))];
        FourBar {
            pivots: [place("ground_A"), place("ground_D")],
            crank: metres("crank"),
            coupler: metres("coupler"),
            rocker: metres("rocker"),
            point: place("coupler_P"),
            side: 1.0,
        }
    }

    /// Distance of a place from its curve, on both sides.
    fn distance(&self, place: Place) -> f64 {
        let sides = [1.0, -1.0].map(|side| FourBar { side, ..*self });
        let off = |own: &FourBar, angle: f64| {
            own.pins(angle)
                .map_or(f64::INFINITY, |pins| length(minus(pins[2], place)))
        };
        let mut best = f64::INFINITY;
        for own in &sides {
            for k in 0..720 {
                let (mut low, mut high) =
                    (TAU * f64::from(k) / 720.0, TAU * f64::from(k + 2) / 720.0);
                let middle = 0.5 * (low + high);
                if off(own, middle) > off(own, low).min(off(own, high)) {
                    continue;
                }
                for _ in 0..100 {
                    let [a, b] = [low + 0.382 * (high - low), low + 0.618 * (high - low)];
                    match off(own, a) < off(own, b) {
                        true => high = b,
                        false => low = a,
                    }
                }
                best = best.min(off(own, low));
            }
        }
        best
    }
}

fn task(what: Value) -> Mechanism {
    let text = json!({ "format": "linkdyn/1", "units": "SI", "synthesise": what });
    text.to_string().parse().expect("a task")
}

/// What is found, and its JSON.
fn found(what: Value) -> (Synthesised, Value) {
    let found = task(what).synthesise().expect("an answer");
    let told = serde_json::to_value(&found).expect("JSON");
    (found, told)
}

/// Runs each model of an answer with the crank's angles, by itself, and holds its point or angle against what was wanted.
fn run_again(told: &Value, wanted: &dyn Fn(usize) -> (Option<Place>, Option<f64>), within: f64) {
    for (number, one) in told["linkages"]
        .as_array()
        .expect("a list")
        .iter()
        .enumerate()
    {
        let turns: Vec<f64> = serde_json::from_value(one["crank"].clone()).expect("angles");
        let mut model = one["model"].clone();
        let start = model["drivers"]["motor"]["motion"]["start"]
            .as_str()
            .expect("an angle")
            .to_owned();
        let start: f64 = start
            .strip_suffix(" deg")
            .expect("degrees")
            .parse()
            .expect("a number");
        let points: Vec<Value> = turns
            .iter()
            .enumerate()
            .map(|(k, turn)| json!([k, format!("{:?} rad", start.to_radians() + turn)]))
            .collect();
        model["drivers"]["motor"]["motion"] =
            json!({ "type": "table", "points": points, "interpolation": "monotone" });
        model
            .as_object_mut()
            .expect("an object")
            .remove("responses");
        let rows = (turns.len() - 1) * 40 + 1;
        model["analysis"] =
            json!({ "type": "kinematics", "end": turns.len() - 1, "outputs": rows });
        let mechanism: Mechanism = model.to_string().parse().expect("a model");
        let output = model["points"][0]
            .as_str()
            .map_or("rocker", |point| point.split_once('.').expect("a point").0)
            .to_owned();
        let run = mechanism.run().expect("runs");
        let column = |name: String| -> Vec<f64> {
            let column = mechanism.column(&name).expect("a column");
            run.column(column).to_vec()
        };
        let angle = column(format!("{output}.angle"));
        for k in 0..turns.len() {
            let (place, turned) = wanted(k);
            if let Some(place) = place {
                let own = [
                    column(format!("{output}.P.x"))[40 * k],
                    column(format!("{output}.P.y"))[40 * k],
                ];
                let off = length(minus(own, place));
                assert!(off < within, "linkage {number}, position {k}: {off:e} m");
            }
            if let Some(turned) = turned {
                let off = angle[40 * k] - angle[0] - turned;
                let off = off - TAU * (off / TAU).round();
                assert!(
                    off.abs() < within,
                    "linkage {number}, position {k}: {off:e} rad"
                );
            }
        }
    }
}
