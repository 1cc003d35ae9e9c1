//! What the starts come to: the best of them, how many reached it, and what was found.

use linkdyn_model::Unit;
use linkdyn_model::optimise::Relation;

use super::derivatives::Derivatives;
use super::problem::Measured;
use super::search::Ended;
use super::target::{Aim, Target, Variable};
use crate::{ModelFile, Unanswered};

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

/// Digits with which values are written: what is beyond them is not known of an optimum.
const DIGITS: usize = 12;

/// What came out.
pub struct Optimised {
    /// The model, as it is.
    pub file: ModelFile,
    pub(super) target: Target,
    /// The starts, of which the best comes first.
    pub(super) starts: Vec<Ended>,
    /// How many starts reach the best value.
    pub(super) reached: usize,
    /// Starts with designs of that value, the best first.
    designs: Vec<usize>,
    /// Runs of all starts.
    pub(super) runs: u64,
    scales: Vec<f64>,
    /// What the model comes to as it is, or why it has no result.
    pub(super) before: Result<Measured, String>,
}

impl Optimised {
    /// Of all starts.
    pub(super) fn new(
        file: ModelFile,
        target: Target,
        mut starts: Vec<Ended>,
        scales: Vec<f64>,
        before: Result<Measured, String>,
    ) -> Self {
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
        let mut all = Optimised {
            file,
            target,
            reached: 0,
            designs: Vec::new(),
            runs: starts.iter().map(|own| own.runs).sum(),
            scales,
            starts,
            before,
        };
        let numbers = 0..all.starts.len();
        let same: Vec<usize> = numbers
            .filter(|&own| all.is_same_value(&all.starts[own]))
            .collect();
        all.reached = same.len();
        for own in same {
            let mut known = all.designs.iter();
            let start = &all.starts[own];
            if !known.any(|&known| all.is_same_design(&all.starts[known], start)) {
                all.designs.push(own);
            }
        }
        all
    }

    /// The best start, where it has values.
    pub(super) fn best(&self) -> Option<(&Ended, &Measured)> {
        let best = self.starts.first()?;
        Some((best, best.measured.as_ref()?))
    }

    /// The best start, where it is what was looked for.
    pub(super) fn found(&self) -> Option<(&Ended, &Measured)> {
        self.best().filter(|(best, _)| best.violation <= KEPT)
    }

    /// The starts with designs of the best value, the best first.
    pub(super) fn designs(&self) -> impl ExactSizeIterator<Item = &Ended> {
        self.designs.iter().map(|&own| &self.starts[own])
    }

    pub(super) fn is_same_value(&self, other: &Ended) -> bool {
        let Some((best, _)) = self.found() else {
            return false;
        };
        let [one, two] = [best, other].map(|own| match self.target.aim {
            Aim::Curve | Aim::ConstrainedCurve => own.value.sqrt(),
            Aim::Goal | Aim::Goals | Aim::Objective => own.value,
        });
        let floor = match self.target.aim {
            Aim::Curve | Aim::ConstrainedCurve => NONE,
            Aim::Goal | Aim::Goals | Aim::Objective => f64::MIN_POSITIVE,
        };
        other.violation <= KEPT
            && (one - two).abs() <= SAME_VALUE * one.abs().max(two.abs()) + floor
    }

    fn is_same_design(&self, one: &Ended, other: &Ended) -> bool {
        let variables = self.target.variables.iter().enumerate();
        let off = variables.map(|(k, own)| {
            let width = own
                .range
                .map_or(own.parameter.value.abs(), |[lower, upper]| upper - lower);
            (one.x[k] - other.x[k]).abs() / width.max(f64::MIN_POSITIVE)
        });
        off.fold(0.0, f64::max) <= SAME_DESIGN
    }

    /// The word for the bound at which a parameter is.
    pub(super) fn bound(&self, k: usize, x: f64) -> Option<&'static str> {
        let [lower, upper] = self.target.variables[k].range?;
        let near = AT_BOUND * (upper - lower);
        match x {
            _ if x - lower <= near => Some("lower"),
            _ if upper - x <= near => Some("upper"),
            _ => None,
        }
    }

    /// Whether a constraint is kept, and whether it stands at its limit.
    pub(super) fn state(&self, k: usize, sides: [f64; 2]) -> (bool, bool) {
        let off = self.off(k, sides[0] - sides[1]);
        (self.violation(k, sides) <= KEPT, off.abs() <= ACTIVE)
    }

    /// A difference of the sides of a constraint, by their size.
    pub(super) fn off(&self, k: usize, difference: f64) -> f64 {
        difference / self.scales[k]
    }

    /// How far a constraint is not kept, by the size of its sides; below zero where it is.
    pub(super) fn violation(&self, k: usize, [left, right]: [f64; 2]) -> f64 {
        let off = self.off(k, left - right);
        match self.target.constraints[k].relation {
            Relation::Equal => off.abs(),
            Relation::AtMost => off,
            Relation::AtLeast => -off,
        }
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
    pub(super) fn distances(&self, measured: &Measured) -> Option<[f64; 2]> {
        let curve = self.target.curve.as_ref()?;
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

    /// What the derivatives of all starts came from.
    pub(super) fn derivatives(&self) -> Derivatives {
        let starts = self.starts.iter();
        starts.fold(Derivatives::default(), |sum, own| sum.and(&own.derivatives))
    }

    /// The same by what is differentiated: how many gradients were exact, and how many differences.
    pub(super) fn gradients(&self) -> Vec<(String, [u64; 2])> {
        let target = &self.target;
        let objective = target.objective.as_ref().map(|own| own.text.clone());
        let path = target.curve.as_ref();
        let path = path.map(|own| format!("path of {}", own.point));
        let constraints = target.constraints.iter().map(|own| own.text.clone());
        let names = objective.or(path).into_iter().chain(constraints);
        names.zip(self.derivatives().0).collect()
    }

    /// Why it is not what was looked for; `None` if it is.
    pub fn failure(&self) -> Option<String> {
        Some(match (self.status(), self.target.aim) {
            ("found", _) => return None,
            ("interrupted", _) => "interrupted: this is the best so far".to_owned(),
            ("no_values", _) => match &self.before {
                Err(why) if !why.is_empty() => {
                    format!("no variant has a result; the model as it is: {why}")
                }
                Ok(_) | Err(_) => "no variant has a result".to_owned(),
            },
            (_, Aim::Goal) => "the goal is not reached; this is the nearest".to_owned(),
            (_, Aim::Goals) => "not all goals are reached; these are the nearest".to_owned(),
            (_, Aim::Objective | Aim::Curve | Aim::ConstrainedCurve) => {
                "no variant was found that keeps all constraints; this is the nearest".to_owned()
            }
        })
    }

    /// Whether what was looked for was found.
    pub fn is_found(&self) -> bool {
        self.found().is_some()
    }

    /// The best values of the parameters that may change \[SI\], or the nearest; `None` if no variant has a result.
    pub fn values(&self) -> impl Iterator<Item = (&str, f64)> {
        let best = self.best().into_iter().flat_map(|(best, _)| &best.x);
        let variables = self.target.variables.iter();
        let values = variables.zip(best);
        values.map(|(own, x)| (own.parameter.name.as_str(), *x))
    }

    /// The model with what was found, everything else as it is; `None` if nothing was found.
    ///
    /// # Errors
    /// A model that has faults with these values.
    pub fn model(&self) -> Result<Option<ModelFile>, Unanswered> {
        let Some((best, _)) = self.found() else {
            return Ok(None);
        };
        self.at(&best.x).map(Some)
    }

    /// The model with these values, or as it is where there are none.
    pub(super) fn at(&self, x: &[f64]) -> Result<ModelFile, Unanswered> {
        let all = self.target.variables.iter().zip(x);
        let sets =
            all.map(|(own, x)| format!("parameters.{}={}", own.parameter.name, said(own, *x)));
        let sets = self.file.sets.iter().cloned().chain(sets).collect();
        let with = ModelFile::read(self.file.text.clone(), sets);
        with.map_err(|said| self.file.refused(said))
    }
}

/// A value as the file would say it, in the unit of the parameter where that is read so, else in SI.
fn said(variable: &Variable, x: f64) -> String {
    let parameter = &variable.parameter;
    let rounded = |x: f64| format!("{x:.*e}", DIGITS - 1).parse::<f64>().unwrap_or(x);
    if parameter.unit.is_empty() {
        return rounded(x).to_string();
    }
    let text = parameter.text.trim();
    let is_number = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let unit = text.trim_start_matches(is_number).trim();
    if let Ok(known) = Unit::parse(unit)
        && let Some(size) = known.convert(1.0, Unit::si(known.powers))
    {
        return format!("\"{} {unit}\"", rounded(x / size));
    }
    format!("\"{} {}\"", rounded(x), parameter.unit)
}
