//! What the starts come to: the best of them, how many reached it, and what was found, for programs.

use super::problem::Measured;
use super::question::{Aim, Question};
use super::search::Ended;
use super::slopes::Derivatives;
use linkdyn_model::optimise::Relation;
use linkdyn_output::csv::push_field;
use serde_json::{Value, json};

/// A violation below this part of a constraint's sides keeps it.
const KEPT: f64 = 1e-7;
/// A constraint whose sides are nearer than this part of them is active.
const ACTIVE: f64 = 1e-6;
/// Values that differ by less than this part are the same.
const SAME_VALUE: f64 = 1e-6;
/// Root mean squares of distances below this part of the curve's size are the same: none.
const NONE: f64 = 1e-8;
/// Designs nearer than this part of their ranges are the same.
const SAME_DESIGN: f64 = 1e-4;
/// A parameter nearer to its bound than this part of its range is at it.
const AT_BOUND: f64 = 1e-9;

/// What came out.
pub struct Told<'t> {
    pub question: &'t Question,
    /// Of which the best comes first.
    pub starts: Vec<&'t Ended>,
    /// How many starts reach the best value.
    pub reached: usize,
    /// Designs with that value, the best first.
    pub designs: Vec<&'t Ended>,
    /// Runs of all starts.
    pub runs: u64,
    pub scales: &'t [f64],
}

impl<'t> Told<'t> {
    /// Of all starts.
    pub fn new(question: &'t Question, ended: &'t [Ended], scales: &'t [f64]) -> Self {
        let mut starts: Vec<&Ended> = ended.iter().collect();
        // Constraints that are kept are as good as each other; of equals the first start.
        starts.sort_by(|a, b| {
            let off = |own: &Ended| {
                if own.violation <= KEPT {
                    0.0
                } else {
                    own.violation
                }
            };
            off(a)
                .total_cmp(&off(b))
                .then(a.value.total_cmp(&b.value))
                .then(a.number.cmp(&b.number))
        });
        let mut told = Told {
            question,
            reached: 0,
            designs: Vec::new(),
            runs: ended.iter().map(|own| own.runs).sum(),
            scales,
            starts,
        };
        if told.found().is_some() {
            let same: Vec<&Ended> = told
                .starts
                .iter()
                .copied()
                .filter(|own| told.is_same_value(own))
                .collect();
            told.reached = same.len();
            for own in same {
                if !told
                    .designs
                    .iter()
                    .any(|known| told.is_same_design(known, own))
                {
                    told.designs.push(own);
                }
            }
        }
        told
    }

    /// The best start, where it has values.
    pub fn best(&self) -> Option<(&'t Ended, &'t Measured)> {
        let best = *self.starts.first()?;
        Some((best, best.measured.as_ref()?))
    }

    /// The best start, where it is what was looked for.
    pub fn found(&self) -> Option<(&'t Ended, &'t Measured)> {
        self.best().filter(|(best, _)| best.violation <= KEPT)
    }

    fn is_same_value(&self, other: &Ended) -> bool {
        let Some((best, _)) = self.found() else {
            return false;
        };
        let [one, two] = [best, other].map(|own| match self.question.aim {
            Aim::Curve | Aim::ConstrainedCurve => own.value.sqrt(),
            Aim::Goal | Aim::Goals | Aim::Objective => own.value,
        });
        let floor = match self.question.aim {
            Aim::Curve | Aim::ConstrainedCurve => NONE,
            Aim::Goal | Aim::Goals | Aim::Objective => f64::MIN_POSITIVE,
        };
        other.violation <= KEPT
            && (one - two).abs() <= SAME_VALUE * one.abs().max(two.abs()) + floor
    }

    fn is_same_design(&self, one: &Ended, other: &Ended) -> bool {
        let variables = self.question.variables.iter().enumerate();
        let off = variables.map(|(k, own)| {
            let width = own
                .range
                .map_or(own.parameter.value.abs(), |[lower, upper]| upper - lower);
            (one.x[k] - other.x[k]).abs() / width.max(f64::MIN_POSITIVE)
        });
        off.fold(0.0, f64::max) <= SAME_DESIGN
    }

    /// The word for the bound at which a parameter is.
    pub fn bound(&self, k: usize, x: f64) -> Option<&'static str> {
        let [lower, upper] = self.question.variables[k].range?;
        let near = AT_BOUND * (upper - lower);
        match x {
            _ if x - lower <= near => Some("lower"),
            _ if upper - x <= near => Some("upper"),
            _ => None,
        }
    }

    /// Whether a constraint is kept, and whether it stands at its limit.
    pub fn state(&self, k: usize, [left, right]: [f64; 2]) -> (bool, bool) {
        let off = (left - right) / self.scales[k];
        let violation = match self.question.constraints[k].relation {
            Relation::Equal => off.abs(),
            Relation::AtMost => off,
            Relation::AtLeast => -off,
        };
        (violation <= KEPT, off.abs() <= ACTIVE)
    }

    /// Whether it was interrupted.
    pub fn is_stopped(&self) -> bool {
        self.starts.iter().any(|own| own.is_stopped)
    }

    /// The word for how all of it ended.
    pub fn status(&self) -> &'static str {
        match (self.is_stopped(), self.found(), self.best()) {
            (true, ..) => "interrupted",
            (_, Some(_), _) => "found",
            (_, None, Some(_)) => "not_reached",
            (_, None, None) => "no_values",
        }
    }

    /// Largest and root mean square distance of the points from the path [m].
    pub fn distances(&self, measured: &Measured) -> Option<[f64; 2]> {
        let curve = self.question.curve.as_ref()?;
        let each: Vec<f64> = match curve.at {
            None => measured.distances.iter().map(|own| own.abs()).collect(),
            Some(_) => measured
                .distances
                .chunks_exact(2)
                .map(|own| own[0].hypot(own[1]))
                .collect(),
        };
        let squares: f64 = each.iter().map(|own| own * own).sum();
        let most = each.iter().copied().fold(0.0, f64::max);
        Some([most, (squares / each.len() as f64).sqrt()])
    }

    /// `optimise.json`.
    pub fn to_json(&self, head: Value) -> Value {
        let mut all = head;
        let question = self.question;
        all["aim"] = match question.aim {
            Aim::Goal => "goal",
            Aim::Goals => "goals",
            Aim::Objective => "objective",
            Aim::Curve | Aim::ConstrainedCurve => "curve",
        }
        .into();
        all["status"] = self.status().into();
        all["seed"] = question.seed.into();
        all["evaluations"] = self.runs.into();
        let derivatives = self.derivatives();
        let [exact, differences] = derivatives.sum();
        all["derivatives"] = match (exact, differences) {
            (0, 0) => Value::Null,
            (_, 0) => "exact".into(),
            (0, _) => "central_differences".into(),
            _ => "mixed".into(),
        };
        let of = |(of, [exact, differences]): (String, [u64; 2])| json!({ "of": of, "exact": exact, "differences": differences });
        all["gradients"] = self.gradients().into_iter().map(of).collect();
        if let Some((best, measured)) = self.best() {
            all["design"] = self.design(&best.x);
            self.aims(&mut all, best, measured);
        }
        all["starts"] = self.in_order().iter().map(|own| self.start(own)).collect();
        all["reached"] = self.reached.into();
        all["designs"] = self.designs.iter().map(|own| self.plain(&own.x)).collect();
        all
    }

    /// What the derivatives of all starts came from.
    pub fn derivatives(&self) -> Derivatives {
        let starts = self.starts.iter();
        starts.fold(Derivatives::default(), |sum, own| sum.and(&own.derivatives))
    }

    /// The same by what is differentiated: how many gradients were exact, and how many differences.
    pub fn gradients(&self) -> Vec<(String, [u64; 2])> {
        let question = self.question;
        let objective = question.objective.as_ref().map(|own| own.text.clone());
        let path = question.curve.as_ref();
        let path = path.map(|own| format!("path of {}", own.point));
        let constraints = question.constraints.iter().map(|own| own.text.clone());
        let names = objective.or(path).into_iter().chain(constraints);
        names.zip(self.derivatives().0).collect()
    }

    /// The starts by their numbers.
    fn in_order(&self) -> Vec<&Ended> {
        let mut starts: Vec<&Ended> = self.starts.clone();
        starts.sort_by_key(|own| own.number);
        starts
    }

    fn plain(&self, x: &[f64]) -> Value {
        let all = self.question.variables.iter().zip(x);
        Value::Object(
            all.map(|(own, x)| (own.parameter.name.clone(), json!(x)))
                .collect(),
        )
    }

    fn design(&self, x: &[f64]) -> Value {
        let all = self.question.variables.iter().zip(x).enumerate();
        let each = all.map(|(k, (own, x))| {
            let range = own.range;
            let told = json!({
                "value": x, "unit": own.parameter.unit, "before": own.parameter.value,
                "lower": range.map(|own| own[0]), "upper": range.map(|own| own[1]),
                "at": self.bound(k, *x),
            });
            (own.parameter.name.clone(), told)
        });
        Value::Object(each.collect())
    }

    fn aims(&self, all: &mut Value, best: &Ended, measured: &Measured) {
        let question = self.question;
        if let Some(aimed) = &question.objective {
            let sigmas = question.robust.as_ref().map(|own| own.sigmas);
            all["objective"] = json!({
                "text": aimed.text, "sense": if aimed.sign > 0.0 { "minimise" } else { "maximise" },
                "value": measured.objective, "unit": aimed.unit,
                "sigmas": sigmas, "deviation": measured.deviation,
                "robust_value": sigmas.map(|_| aimed.sign * best.value),
            });
        }
        let constraints = question.constraints.iter().zip(&measured.sides).enumerate();
        let each = constraints.map(|(k, (one, sides))| {
            let (kept, active) = self.state(k, *sides);
            json!({
                "text": one.text, "left": sides[0], "right": sides[1], "unit": one.unit,
                "kept": kept, "active": active, "multiplier": best.multipliers.get(k),
            })
        });
        all["constraints"] = each.collect();
        if let (Some(curve), Some([most, mean])) = (&question.curve, self.distances(measured)) {
            all["curve"] = json!({
                "point": curve.point.to_string(), "points": curve.through.len(),
                "largest_distance": most, "rms_distance": mean, "residuals": measured.distances,
            });
        }
        let responses = question.responses.iter().zip(&measured.responses);
        let each = responses.map(|((name, unit), value)| {
            let value = value.is_finite().then_some(*value);
            (name.clone(), json!({ "value": value, "unit": unit }))
        });
        all["responses"] = Value::Object(each.collect());
        all["slope"] = json!(best.slope);
    }

    fn start(&self, own: &Ended) -> Value {
        let has = own.measured.is_some();
        json!({
            "start": own.number, "ended": own.how, "evaluations": own.runs,
            "value": has.then_some(own.value), "violation": has.then_some(own.violation),
            "slope": own.slope, "design": has.then(|| self.plain(&own.x)),
            "reached": self.is_same_value(own),
        })
    }
}

/// The table of all evaluations.
pub fn table(question: &Question, ended: &[Ended]) -> String {
    let mut out = String::from("start,evaluation,status");
    for own in &question.variables {
        out += &format!(
            ",{}",
            field(&heading(
                &format!("parameters.{}", own.parameter.name),
                &own.parameter.unit
            ))
        );
    }
    if let Some(aimed) = &question.objective {
        out += &format!(",{}", field(&heading(&aimed.text, &aimed.unit)));
    }
    for (k, one) in question.constraints.iter().enumerate() {
        for side in ["left", "right"] {
            out += &format!(
                ",{}",
                field(&heading(&format!("constraint {} {side}", k + 1), &one.unit))
            );
        }
    }
    if question.curve.is_some() {
        out += ",rms_distance [m]";
    }
    out.push('\n');
    for start in ended {
        for (number, record) in start.records.iter().enumerate() {
            let status = record.missing.as_deref().unwrap_or("completed");
            out += &format!("{},{number},{}", start.number, field(status));
            for x in &record.x {
                out += &format!(",{x:?}");
            }
            let has = record.missing.is_none();
            let measured = &record.measured;
            let mut cell = |value: f64| match has {
                true => out += &format!(",{value:?}"),
                false => out.push(','),
            };
            if question.objective.is_some() {
                cell(measured.objective);
            }
            for k in 0..question.constraints.len() {
                let [left, right] = measured.sides.get(k).copied().unwrap_or_default();
                cell(left);
                cell(right);
            }
            if let Some(curve) = &question.curve {
                let squares = measured.distances.iter().map(|own| own * own).sum::<f64>();
                cell((squares / curve.through.len() as f64).sqrt());
            }
            out.push('\n');
        }
    }
    out
}

fn heading(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    }
}

/// A cell of text.
fn field(text: &str) -> String {
    let mut cell = Vec::new();
    push_field(&mut cell, text);
    String::from_utf8_lossy(&cell).into_owned()
}
