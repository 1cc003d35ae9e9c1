//! What was found, for programs: `optimise.json` and `evaluations.csv`.

use indexmap::IndexMap;
use linkdyn_output::csv::push_field;
use serde::{Serialize, Serializer};

use super::optimised::Optimised;
use super::problem::Measured;
use super::search::Ended;
use super::target::{Aim, Target};
use crate::{ENGINE, Varying};

#[derive(Serialize)]
struct Document<'a> {
    engine: &'a str,
    model: Varying,
    aim: &'a str,
    status: &'a str,
    seed: u64,
    evaluations: u64,
    derivatives: Option<&'a str>,
    gradients: Vec<Gradient>,
    #[serde(flatten)]
    best: Option<Best<'a>>,
    starts: Vec<Start<'a>>,
    reached: usize,
    designs: Vec<Design<'a>>,
}

type Design<'a> = IndexMap<&'a str, f64>;

#[derive(Serialize)]
struct Gradient {
    of: String,
    exact: u64,
    differences: u64,
}

#[derive(Serialize)]
struct Best<'a> {
    design: IndexMap<&'a str, Value<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    objective: Option<Objective<'a>>,
    constraints: Vec<Constraint<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    curve: Option<Curve<'a>>,
    responses: IndexMap<&'a str, Response<'a>>,
    slope: Option<f64>,
}

#[derive(Serialize)]
struct Value<'a> {
    value: f64,
    unit: &'a str,
    before: f64,
    lower: Option<f64>,
    upper: Option<f64>,
    at: Option<&'a str>,
}

#[derive(Serialize)]
struct Objective<'a> {
    text: &'a str,
    sense: &'a str,
    value: f64,
    unit: &'a str,
    sigmas: Option<f64>,
    deviation: Option<f64>,
    robust_value: Option<f64>,
}

#[derive(Serialize)]
struct Constraint<'a> {
    text: &'a str,
    left: f64,
    right: f64,
    unit: &'a str,
    kept: bool,
    active: bool,
    multiplier: Option<f64>,
}

#[derive(Serialize)]
struct Curve<'a> {
    point: String,
    points: usize,
    largest_distance: f64,
    rms_distance: f64,
    residuals: &'a [f64],
}

#[derive(Serialize)]
struct Response<'a> {
    value: Option<f64>,
    unit: &'a str,
}

#[derive(Serialize)]
struct Start<'a> {
    start: u64,
    ended: &'a str,
    evaluations: u64,
    value: Option<f64>,
    violation: Option<f64>,
    slope: Option<f64>,
    design: Option<Design<'a>>,
    reached: bool,
}

/// `optimise.json`.
impl Serialize for Optimised {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let target = &self.target;
        let [exact, differences] = self.derivatives().sum();
        let gradients = self.gradients().into_iter();
        let document = Document {
            engine: ENGINE,
            model: self.file.varying(),
            aim: match target.aim {
                Aim::Goal => "goal",
                Aim::Goals => "goals",
                Aim::Objective => "objective",
                Aim::Curve | Aim::ConstrainedCurve => "curve",
            },
            status: self.status(),
            seed: target.seed,
            evaluations: self.runs,
            derivatives: match (exact, differences) {
                (0, 0) => None,
                (_, 0) => Some("exact"),
                (0, _) => Some("central_differences"),
                _ => Some("mixed"),
            },
            gradients: gradients
                .map(|(of, [exact, differences])| Gradient {
                    of,
                    exact,
                    differences,
                })
                .collect(),
            best: self
                .best()
                .map(|(best, measured)| self.best_json(best, measured)),
            starts: self
                .in_order()
                .into_iter()
                .map(|own| self.start(own))
                .collect(),
            reached: self.reached,
            designs: self.designs().map(|own| self.design(&own.x)).collect(),
        };
        document.serialize(serializer)
    }
}

impl Optimised {
    fn design(&self, x: &[f64]) -> Design<'_> {
        let all = self.target.variables.iter().zip(x);
        all.map(|(own, x)| (own.parameter.name.as_str(), *x))
            .collect()
    }

    fn best_json<'a>(&'a self, best: &'a Ended, measured: &'a Measured) -> Best<'a> {
        let target = &self.target;
        let variables = target.variables.iter().zip(&best.x).enumerate();
        let design = variables.map(|(k, (own, x))| {
            let value = Value {
                value: *x,
                unit: &own.parameter.unit,
                before: own.parameter.value,
                lower: own.range.map(|own| own[0]),
                upper: own.range.map(|own| own[1]),
                at: self.bound(k, *x),
            };
            (own.parameter.name.as_str(), value)
        });
        let sigmas = target.robust.as_ref().map(|own| own.sigmas);
        let constraints = target.constraints.iter().zip(&measured.sides).enumerate();
        let distances = self.distances(measured);
        let curve = target.curve.as_ref().zip(distances);
        let responses = target.responses.iter().zip(&measured.responses);
        Best {
            design: design.collect(),
            objective: target.objective.as_ref().map(|aimed| Objective {
                text: &aimed.text,
                sense: if aimed.sign > 0.0 {
                    "minimise"
                } else {
                    "maximise"
                },
                value: measured.objective,
                unit: &aimed.unit,
                sigmas,
                deviation: measured.deviation,
                robust_value: sigmas.map(|_| aimed.sign * best.value),
            }),
            constraints: constraints
                .map(|(k, (one, sides))| {
                    let (kept, active) = self.state(k, *sides);
                    Constraint {
                        text: &one.text,
                        left: sides[0],
                        right: sides[1],
                        unit: &one.unit,
                        kept,
                        active,
                        multiplier: best.multipliers.get(k).copied(),
                    }
                })
                .collect(),
            curve: curve.map(|(curve, [most, mean])| Curve {
                point: curve.point.to_string(),
                points: curve.through.len(),
                largest_distance: most,
                rms_distance: mean,
                residuals: &measured.distances,
            }),
            responses: responses
                .map(|(own, value)| {
                    let (value, unit) = (value.is_finite().then_some(*value), &own.unit);
                    (own.name.as_str(), Response { value, unit })
                })
                .collect(),
            slope: best.slope,
        }
    }

    fn start<'a>(&'a self, own: &'a Ended) -> Start<'a> {
        let has = own.measured.is_some();
        Start {
            start: own.number,
            ended: own.how,
            evaluations: own.runs,
            value: has.then_some(own.value),
            violation: has.then_some(own.violation),
            slope: own.slope,
            design: has.then(|| self.design(&own.x)),
            reached: self.is_same_value(own),
        }
    }
}

impl Optimised {
    /// The table of all evaluations, as in `evaluations.csv`; they are kept if that is requested.
    pub fn table(&self) -> String {
        let target = &self.target;
        let mut out = self.headings().join(",");
        for start in self.in_order() {
            for (number, record) in start.records.iter().enumerate() {
                let status = record.missing.as_deref().unwrap_or("completed");
                out += &format!("\n{},{number},{}", start.number, field(status));
                record.x.iter().for_each(|x| out += &format!(",{x:?}"));
                for value in record.measured.row(target) {
                    match record.missing {
                        None => out += &format!(",{value:?}"),
                        Some(_) => out.push(','),
                    }
                }
            }
        }
        out + "\n"
    }

    fn headings(&self) -> Vec<String> {
        let heading = |name: &str, unit: &str| match unit {
            "" => field(name),
            unit => field(&format!("{name} [{unit}]")),
        };
        let target = &self.target;
        let mut all = ["start", "evaluation", "status"].map(String::from).to_vec();
        for own in &target.variables {
            let name = format!("parameters.{}", own.parameter.name);
            all.push(heading(&name, &own.parameter.unit));
        }
        all.extend(
            target
                .objective
                .iter()
                .map(|own| heading(&own.text, &own.unit)),
        );
        for (k, one) in (1..).zip(&target.constraints) {
            let sides = ["left", "right"].map(|side| format!("constraint {k} {side}"));
            all.extend(sides.map(|name| heading(&name, &one.unit)));
        }
        all.extend(target.curve.iter().map(|_| heading("rms_distance", "m")));
        all
    }

    /// The starts by their numbers.
    fn in_order(&self) -> Vec<&Ended> {
        let mut starts: Vec<&Ended> = self.starts.iter().collect();
        starts.sort_by_key(|own| own.number);
        starts
    }
}

impl Measured {
    /// Its numbers, as in a row of the table.
    fn row(&self, target: &Target) -> Vec<f64> {
        let mut row = Vec::new();
        row.extend(target.objective.iter().map(|_| self.objective));
        for k in 0..target.constraints.len() {
            row.extend(self.sides.get(k).copied().unwrap_or_default());
        }
        if let Some(curve) = &target.curve {
            let squares = self.distances.iter().map(|own| own * own).sum::<f64>();
            row.push((squares / curve.through.len() as f64).sqrt());
        }
        row
    }
}

/// A cell of text.
fn field(text: &str) -> String {
    let mut cell = Vec::new();
    push_field(&mut cell, text);
    String::from_utf8_lossy(&cell).into_owned()
}
