//! Random deviations of mechanisms, solved for without the engine, beside what the engine certifies and what it found.

use super::newton::{Gaps, Newton};
use super::told::{Random, Told, ask_outputs, parametric, spoil, tolerate};
use linkdyn_model::{JointKind, Model};
use linkdyn_variation::{Accuracy, Contribution};

/// Newton's own round-off, times how far a joint's gap carries an output [m or rad].
pub const ROUND_OFF: f64 = 1e-12;
/// A deviation below this says nothing of shares [m or rad].
const TINY: f64 = 1e-9;

/// What is tried: a model, a value of its driver, the size of all deviations.
pub struct Case {
    pub name: &'static str,
    /// [rad]
    pub at: f64,
    /// Of pins, plays, zones and drivers [m or rad].
    pub c: f64,
    /// Of all numbers of the geometry [m or rad]; 0: none.
    pub t: f64,
    /// Whether a bound is to be had for all outputs.
    pub is_certain: bool,
}

pub const fn case(name: &'static str, at: f64, c: f64, t: f64, is_certain: bool) -> Case {
    Case {
        name,
        at,
        c,
        t,
        is_certain,
    }
}

pub const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// How far deviations went to a side of an output.
#[derive(Debug, Clone, Default)]
struct Side {
    /// The farthest [rad or m], and the numbers that made it.
    most: f64,
    by: Vec<f64>,
}

/// What came of a case.
#[derive(Debug, Default)]
pub struct Tried {
    /// Solved, of all tries.
    pub solved: [usize; 2],
    /// Largest deviation over the certified one, and over the worst found; with what it is of.
    pub certified: (f64, String),
    pub found: (f64, String),
    /// By output and side: what it is, its worst found, the farthest over that.
    pub sides: Vec<(String, f64, f64)>,
    /// Outputs with a bound, of all.
    pub bounded: [usize; 2],
    pub beyond: Vec<String>,
}

/// The model of a case: a bundled one, or of `validation/`.
pub fn read(name: &str) -> Model {
    let text = match linkdyn_model::bundled::find(name) {
        Some(bundled) => bundled.text.to_owned(),
        None => {
            let root = env!("CARGO_MANIFEST_DIR");
            std::fs::read_to_string(format!("{root}/validation/{name}/model.json"))
                .expect("a model")
        }
    };
    let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("legal");
    loaded.model.into_model()
}

/// Numbers in [0, 1) that a try takes one after the other, and that can be taken again, changed.
struct Numbers<'r> {
    given: Vec<f64>,
    next: usize,
    random: &'r mut Random,
}

impl Numbers<'_> {
    fn next(&mut self) -> f64 {
        if self.next == self.given.len() {
            self.given.push(self.random.next());
        }
        self.next += 1;
        self.given[self.next - 1]
    }

    fn both(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
}

/// A few of the numbers made anew, the others moved by less and less.
fn vary(numbers: &[f64], random: &mut Random) -> Vec<f64> {
    let size = 0.3 * 0.01_f64.powf(random.next());
    let share = 2.0 / numbers.len() as f64;
    let vary = |number: &f64| {
        if random.next() < share {
            random.next()
        } else {
            (number + size * random.both().powi(3)).rem_euclid(1.0)
        }
    };
    numbers.iter().map(vary).collect()
}

/// A point of a disc: of its rim, or anywhere.
fn disc(numbers: &mut Numbers, radius: f64) -> [f64; 2] {
    let angle = std::f64::consts::PI * numbers.both();
    let part = (2.0 * numbers.next()).min(1.0).sqrt();
    [radius * part * angle.cos(), radius * part * angle.sin()]
}

/// An end of [−1, 1], or anywhere between.
fn side(numbers: &mut Numbers) -> f64 {
    (2.0 * numbers.both()).clamp(-1.0, 1.0)
}

/// Gaps that a model's own words allow.
fn gaps(model: &Model, pitch: &[f64], numbers: &mut Numbers) -> Gaps {
    let joints = model
        .joints
        .values()
        .zip(pitch)
        .map(|(joint, pitch)| match &joint.kind {
            JointKind::Revolute { clearance, .. } => {
                let limits = clearance.as_ref().and_then(|own| own.limits());
                disc(numbers, limits.map_or(0.0, |limits| limits[1]))
            }
            JointKind::Prismatic {
                play, guide_length, ..
            } => {
                let most = play.as_ref().map_or(0.0, |play| play.most);
                let part = numbers.next();
                let turn = guide_length.map_or(0.0, |length| 2.0 * most * (1.0 - part) / length);
                [most * part * side(numbers), turn * side(numbers)]
            }
            JointKind::Slot { play, .. } => [
                play.as_ref().map_or(0.0, |play| play.most) * side(numbers),
                0.0,
            ],
            JointKind::Gear { backlash, .. } => {
                [0.5 * backlash.unwrap_or(0.0) / pitch * side(numbers), 0.0]
            }
            _ => [0.0; 2],
        });
    let joints = joints.collect();
    let drivers = model.drivers.values();
    let drivers = drivers.map(|driver| driver.tolerance.unwrap_or(0.0) * side(numbers));
    Gaps {
        joints,
        drivers: drivers.collect(),
    }
}

/// Radii of the second wheels of gears; 1 of other joints.
fn pitch(model: &Model) -> Vec<f64> {
    model
        .joints
        .values()
        .map(|joint| match &joint.kind {
            // The gears here have equal wheels, whose centres are on the ground.
            JointKind::Gear { ratio, .. } => {
                let at = |k: usize| {
                    let end = &joint.between[k];
                    let pose = model.bodies[&end.body].pose.position;
                    let own = model.bodies[&end.body].points[&end.point];
                    assert_eq!(own, [0.0, 0.0]);
                    pose
                };
                let ([a, b], [c, d]) = (at(0), at(1));
                (a - c).hypot(b - d) / (1.0 - ratio)
            }
            _ => 1.0,
        })
        .collect()
}

/// The model with its parameters at corners, and its points anywhere in their zones.
fn deviated(case: &Case, told: &Told, numbers: &mut Numbers) -> Model {
    let mut off = told.loaded.model.clone().into_model();
    if case.t > 0.0 {
        let by = told.loaded.parameters.iter().map(|parameter| {
            let tolerance = parameter.tolerance.as_ref().expect("a tolerance");
            let value = if numbers.next() < 0.5 {
                tolerance.lower
            } else {
                tolerance.upper
            };
            (parameter.name.as_str(), value)
        });
        let by: Vec<(&str, f64)> = by.collect();
        off = told
            .loaded
            .source
            .with_deviations(&by)
            .expect("legal")
            .into_model();
    }
    for body in off.bodies.values_mut() {
        for (name, diameter) in &body.point_tolerances {
            let [x, y] = disc(numbers, 0.5 * diameter);
            let point = body.points.get_mut(name).expect("a point");
            *point = [point[0] + x, point[1] + y];
        }
    }
    off
}

/// A case whose model was asked.
pub struct Sampler<'c> {
    case: &'c Case,
    model: Model,
    told: Told,
    pub answer: Accuracy,
    /// By output, to the lower and the upper side.
    sides: Vec<[Side; 2]>,
    pub tried: Tried,
}

impl<'c> Sampler<'c> {
    pub fn new(case: &'c Case) -> Self {
        let model = read(case.name);
        let mut json = parametric(&model, 5);
        ask_outputs(&mut json, &model, Some(case.at));
        spoil(&mut json, case.c);
        if case.t > 0.0 {
            tolerate(&mut json, case.t);
        }
        let told = Told::read(&json).unwrap_or_else(|said| panic!("{}: {said}", case.name));
        let answer = told.answer();
        let mut tried = Tried::default();
        for output in &answer.outputs {
            tried.bounded[0] += usize::from(output.poses[0].certified.is_some());
            tried.bounded[1] += 1;
        }
        Sampler {
            case,
            sides: vec![Default::default(); answer.outputs.len()],
            model,
            told,
            answer,
            tried,
        }
    }

    /// Tries random deviations, and as many again that climb from the farthest ones on.
    pub fn run(&mut self, tries: usize, random: &mut Random) {
        for _ in 0..tries {
            self.one(Vec::new(), random);
        }
        let sides = 2 * self.sides.len();
        for number in 0..tries {
            let best = &self.sides[number % sides / 2][number % 2].by;
            let numbers = vary(best, random);
            self.one(numbers, random);
        }
        self.conclude();
    }

    /// One deviation of everything, from these numbers.
    fn one(&mut self, given: Vec<f64>, random: &mut Random) {
        let mut numbers = Numbers {
            given,
            next: 0,
            random,
        };
        let off = deviated(self.case, &self.told, &mut numbers);
        let gaps = gaps(&off, &pitch(&self.model), &mut numbers);
        let taken = numbers.given;
        let pose = &self.answer.outputs[0].poses[0];
        let newton = Newton::new(&off, &pose.position);
        // Where nothing is certified the equations may be singular at the nominal position.
        let mut starts = vec![&*pose.position];
        if !self.case.is_certain {
            starts.extend(pose.displaced.iter().flatten().map(Vec::as_slice));
        }
        let found: Vec<_> = starts
            .iter()
            .filter_map(|start| newton.solve(&pose.drivers, &gaps, start))
            .filter(|q| self.case.is_certain || self.is_near(q))
            .collect();
        self.tried.solved[0] += usize::from(!found.is_empty());
        self.tried.solved[1] += 1;
        let asked = self.told.loaded.model.accuracy.as_ref().expect("outputs");
        for (output, sides) in self.answer.outputs.iter().zip(&mut self.sides) {
            for q in &found {
                let y = newton.value(&asked.outputs[&output.name].of, q) - output.poses[0].nominal;
                let side = &mut sides[usize::from(y > 0.0)];
                if y.abs() > side.most || side.by.is_empty() {
                    *side = Side {
                        most: y.abs(),
                        by: taken.clone(),
                    };
                }
            }
        }
    }

    /// Whether a position belongs to this one: no body goes much farther than the worst found of any output takes it.
    fn is_near(&self, q: &[[f64; 3]]) -> bool {
        let poses = self.answer.outputs.iter().map(|output| &output.poses[0]);
        let start = &self.answer.outputs[0].poses[0].position;
        let away = |q: &[[f64; 3]]| {
            let parts = q.iter().flatten().zip(start.iter().flatten());
            parts.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let displaced = poses.flat_map(|pose| pose.displaced.iter().flatten());
        away(q) <= 1.5 * displaced.map(|q| away(q)).fold(0.0, f64::max)
    }

    /// The farthest deviations beside what is certified and what was found.
    fn conclude(&mut self) {
        let (tried, case) = (&mut self.tried, self.case);
        for (output, sides) in self.answer.outputs.iter().zip(&self.sides) {
            let pose = &output.poses[0];
            // What one source alone carries is reached exactly, and says nothing.
            let carries = |by: &&Contribution| by.reach[1] > by.reach[0];
            let is_alone = pose.contributions.iter().filter(carries).count() == 1;
            for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
                let most = sides[side].most;
                let what = || format!("{} {}", output.of, ["down", "up"][side]);
                if let Some(bound) = pose.certified.map(|bounds| bounds[side].abs()) {
                    if most > bound + ROUND_OFF {
                        tried.beyond.push(format!(
                            "{} at {}: {}: {:e} beyond {:e}",
                            case.name,
                            case.at,
                            what(),
                            sign * most,
                            sign * bound
                        ));
                    }
                    if !is_alone && most > TINY && most / bound > tried.certified.0 {
                        tried.certified = (most / bound, what());
                    }
                }
                let Some(found) = pose.found[side] else {
                    continue;
                };
                tried.sides.push((what(), found, most / found.abs()));
                if !is_alone && most > TINY && most / found.abs() > tried.found.0 {
                    tried.found = (most / found.abs(), what());
                }
            }
        }
    }
}
