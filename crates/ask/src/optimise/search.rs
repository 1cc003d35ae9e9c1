//! The starts: each a search of its own, all at once, the same whichever thread runs them.

use super::derivatives::{Derivatives, Last};
use super::guarded::Guarded;
use super::problem::{Measured, Problem, Record};
use super::slopes::Searched;
use super::target::{Aim, Target};
use super::timing::Timing;
use super::variants::{Call, Detail, Found, Runs};
use linkdyn_engine::analysis::Progress;
use linkdyn_optimise::constrained::{self, Optimum};
use linkdyn_optimise::least_squares::{self, Fitted, least_squares};
use linkdyn_optimise::seek::{Seek, Side, Sought, seek};
use linkdyn_optimise::start::{self, Start};
use linkdyn_optimise::{Bounds, Outcome};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::Unanswered;

/// How a start ended, and with what.
#[derive(Debug, Clone)]
pub struct Ended {
    pub number: u64,
    /// In a word.
    pub how: &'static str,
    pub is_stopped: bool,
    pub x: Vec<f64>,
    /// What it comes to; `None` if there never was a value.
    pub measured: Option<Measured>,
    /// What is to be least there.
    pub value: f64,
    /// Largest violation of a constraint, scaled.
    pub violation: f64,
    /// Slope that is left, scaled; none of a goal.
    pub slope: Option<f64>,
    /// By constraint: what the objective would gain, [SI per SI].
    pub multipliers: Vec<f64>,
    pub runs: u64,
    pub derivatives: Derivatives,
    pub records: Vec<Record>,
}

/// What all starts share.
pub struct Search<'s> {
    pub target: &'s Target,
    pub runs: &'s Runs,
    pub timing: Option<&'s Timing>,
    pub scales: Vec<f64>,
    pub keep: bool,
}

/// A residual of a goal below this part of its sides is round-off.
const ENOUGH: f64 = 1e-12;
/// Distances below this part of the curve's size are none: first in the search, then in the last digits.
const ON_CURVE: [f64; 2] = [1e-9, 1e-13];
/// A goal takes so many evaluations at most.
const MOST: usize = 100;
/// The first step of a goal, by the value or the range.
const FIRST: f64 = 0.05;
/// A goal of a parameter without range is looked for between its value by this and times this.
const REACH: f64 = 1e3;

impl Search<'_> {
    /// All starts.
    ///
    /// # Errors
    /// More parameters than the starts can be spread over.
    pub fn run(&self, progress: &Progress) -> Result<Vec<Ended>, Unanswered> {
        let count = match self.target.aim {
            Aim::Goal => 1,
            Aim::Goals | Aim::Objective | Aim::Curve | Aim::ConstrainedCurve => self.target.starts,
        };
        progress.note(0.0, count as f64);
        let done = AtomicU64::new(0);
        let one = |number: u64| {
            let ended = self.start(number);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress.note(done as f64, count as f64);
            ended
        };
        (0..count).into_par_iter().map(one).collect()
    }

    /// What the model comes to as it is; the sizes of the sides of its constraints there, or at the first point that has values.
    ///
    /// # Errors
    /// More parameters than the starts can be spread over.
    pub fn as_it_is(&mut self) -> Result<Found<Measured>, Unanswered> {
        let all = self.target.variables.iter();
        let x: Vec<f64> = all.map(|own| own.parameter.value).collect();
        self.scales = vec![1.0; self.target.constraints.len()];
        let found = self.problem(Detail::Fine, false).measure(&x);
        let mut known = match &found {
            Found::Some(measured) => Some(measured.clone()),
            Found::None(_) | Found::Stopped => None,
        };
        if known.is_none() && self.target.aim != Aim::Goal {
            let start = self.spread(0, self.target.curve.is_some());
            let mut points = start
                .candidates(&self.bounds())
                .map_err(too_many)?
                .into_iter();
            let mut problem = self.problem(Detail::Coarse, false);
            known = points.find_map(|x| match problem.measure(&x) {
                Found::Some(measured) => Some(measured),
                Found::None(_) | Found::Stopped => None,
            });
        }
        if let Some(measured) = known {
            let size = |[left, right]: &[f64; 2]| match left.abs().max(right.abs()) {
                size if size > 0.0 => size,
                _ => 1.0,
            };
            self.scales = measured.sides.iter().map(size).collect();
        }
        Ok(found)
    }

    pub fn problem(&self, detail: Detail, keep: bool) -> Problem<'_> {
        Problem {
            target: self.target,
            variant: Guarded::new(|| self.runs.begin()),
            timing: self.timing,
            scales: &self.scales,
            extent: self.target.extent(),
            detail,
            call: Call::OfSearch,
            runs: 0,
            records: keep.then(Vec::new),
            derivatives: Derivatives::default(),
            last: Last::default(),
        }
    }

    fn start(&self, number: u64) -> Result<Ended, Unanswered> {
        match self.target.aim {
            Aim::Goal => Ok(self.goal()),
            Aim::Goals | Aim::Curve => self.fit(number),
            Aim::Objective | Aim::ConstrainedCurve => self.optimise(number),
        }
    }

    /// The box, of goals without one that in which they are looked for.
    fn bounds(&self) -> Bounds {
        let all = self.target.variables.iter();
        let ranges: Vec<[f64; 2]> = all
            .map(|own| own.range.unwrap_or_else(|| around(own.parameter.value)))
            .collect();
        Bounds::new(&ranges)
    }

    /// The file's own values, where they are in the box.
    fn given(&self, number: u64, bounds: &Bounds) -> Option<Vec<f64>> {
        let all = self.target.variables.iter();
        let x: Vec<f64> = all.map(|own| own.parameter.value).collect();
        let is_inside = |k: usize| (bounds.of(k)[0]..=bounds.of(k)[1]).contains(&x[k]);
        (number == 0 && (0..x.len()).all(is_inside)).then_some(x)
    }

    fn goal(&self) -> Ended {
        let mut problem = self.problem(Detail::Coarse, self.keep);
        let variable = &self.target.variables[0];
        let value = variable.parameter.value;
        let [lower, upper] = variable.range.unwrap_or_else(|| around(value));
        let step = match (variable.range, value) {
            (Some([lower, upper]), _) => FIRST * (upper - lower),
            (None, 0.0) => FIRST,
            (None, value) => FIRST * value.abs(),
        };
        let settings = Seek {
            start: value,
            step,
            range: [lower, upper],
            enough: ENOUGH,
            most: MOST,
        };
        let mut side = |x: f64| match problem.outcome(&[x]) {
            Outcome::Values(values) => Side::Value(values[0]),
            Outcome::Missing => Side::Missing,
            Outcome::Stopped => Side::Stopped,
        };
        let (ended, best) = seek(&mut side, &settings);
        let how = match ended {
            Sought::Reached => "reached",
            Sought::Jump => "jump",
            Sought::NotBracketed => "not_bracketed",
            Sought::Evaluations => "evaluations",
            Sought::NoValues => "no_values",
            Sought::Stopped => "stopped",
        };
        let is_stopped = ended == Sought::Stopped;
        self.ended(
            problem,
            0,
            (how, is_stopped),
            best.map(|(x, _)| vec![x]),
            (None, Vec::new()),
        )
    }

    fn fit(&self, number: u64) -> Result<Ended, Unanswered> {
        let bounds = self.bounds();
        let given = self.given(number, &bounds);
        let is_curve = self.target.curve.is_some();
        let mut problem = self.problem(Detail::Coarse, self.keep);
        let settings = least_squares::Settings {
            enough: if is_curve { ON_CURVE[0] } else { ENOUGH },
            ..least_squares::Settings::default()
        };
        let start = self.spread(number, is_curve);
        let mut f = Searched(&mut problem);
        let mut found =
            start::fit(&mut f, &bounds, &start, given.as_deref(), &settings).map_err(too_many)?;
        if is_curve && !found.residuals.is_empty() && found.ended != least_squares::Ended::Stopped {
            problem.detail = Detail::Fine;
            let settings = least_squares::Settings {
                enough: ON_CURVE[1],
                most_steps: 50,
                ..settings
            };
            let mut f = Searched(&mut problem);
            let finer = least_squares(&mut f, &bounds, &found.x, &settings);
            if !finer.residuals.is_empty() {
                found = finer;
            }
        }
        problem.detail = Detail::Fine;
        let Fitted {
            x,
            residuals,
            ended,
            slope,
        } = found;
        let how = match ended {
            least_squares::Ended::Solved => "solved",
            least_squares::Ended::Minimum => "minimum",
            least_squares::Ended::Steps => "steps",
            least_squares::Ended::Hopeless => "hopeless",
            least_squares::Ended::NoValues => "no_values",
            least_squares::Ended::Stopped => "stopped",
        };
        let is_stopped = ended == least_squares::Ended::Stopped;
        let x = (!residuals.is_empty()).then_some(x);
        Ok(self.ended(
            problem,
            number,
            (how, is_stopped),
            x,
            (Some(slope), Vec::new()),
        ))
    }

    fn optimise(&self, number: u64) -> Result<Ended, Unanswered> {
        let bounds = self.bounds();
        let given = self.given(number, &bounds);
        let kinds = self.target.kinds();
        let mut problem = self.problem(Detail::Fine, self.keep);
        let settings = constrained::Settings::default();
        let start = self.spread(number, self.target.curve.is_some());
        let mut f = Searched(&mut problem);
        let found = start::optimise(&mut f, &kinds, &bounds, &start, given.as_deref(), &settings)
            .map_err(too_many)?;
        let Optimum {
            x,
            values,
            multipliers,
            ended,
            slope,
        } = found;
        let how = match ended {
            constrained::Ended::Optimum => "optimum",
            constrained::Ended::Stuck => "stuck",
            constrained::Ended::Infeasible => "infeasible",
            constrained::Ended::Steps => "steps",
            constrained::Ended::NoValues => "no_values",
            constrained::Ended::Stopped => "stopped",
        };
        let is_stopped = ended == constrained::Ended::Stopped;
        let x = (!values.is_empty()).then_some(x);
        let multipliers = multipliers
            .iter()
            .zip(&self.scales)
            .map(|(own, scale)| own / scale);
        let multipliers = multipliers.collect();
        Ok(self.ended(
            problem,
            number,
            (how, is_stopped),
            x,
            (Some(slope), multipliers),
        ))
    }

    /// How wide a start looks: paths have many more valleys than other numbers.
    fn spread(&self, number: u64, is_curve: bool) -> Start {
        let variables = self.target.variables.len() as u64;
        let is_fit = matches!(self.target.aim, Aim::Goals | Aim::Curve);
        let (points, descents) = match (is_curve, is_fit) {
            (true, true) => (64 * variables, 60),
            (true, false) => (64 * variables, 4),
            (false, true) => (16 * variables, 8),
            (false, false) => (16 * variables, 1),
        };
        Start {
            seed: self.target.seed,
            number,
            points,
            descents,
        }
    }

    /// The end of a start, measured once more in the last digits.
    fn ended(
        &self,
        mut problem: Problem,
        number: u64,
        (how, is_stopped): (&'static str, bool),
        x: Option<Vec<f64>>,
        (slope, multipliers): (Option<f64>, Vec<f64>),
    ) -> Ended {
        let variables = self.target.variables.iter();
        let nominal = || variables.map(|own| own.parameter.value).collect();
        let is_there = x.is_some();
        let x: Vec<f64> = x.unwrap_or_else(nominal);
        let runs = problem.runs;
        let records = problem.records.take().unwrap_or_default();
        let derivatives = std::mem::take(&mut problem.derivatives);
        (problem.detail, problem.call) = (Detail::Fine, Call::Last);
        let measured = match is_there.then(|| problem.measure(&x)) {
            Some(Found::Some(measured)) => Some(measured),
            Some(Found::None(_) | Found::Stopped) | None => None,
        };
        let value = measured
            .as_ref()
            .map_or(f64::INFINITY, |own| problem.value(own));
        let violation = measured.as_ref().map_or(f64::INFINITY, |own| {
            let differences = self.target.differences(own, &self.scales);
            let kinds = self.target.kinds();
            let all = kinds
                .iter()
                .zip(differences)
                .map(|(kind, own)| kind.violation(own));
            all.fold(0.0, f64::max)
        });
        Ended {
            number,
            how,
            is_stopped,
            x,
            measured,
            value,
            violation,
            slope: slope.filter(|own| own.is_finite()),
            multipliers,
            runs,
            derivatives,
            records,
        }
    }
}

/// Where a parameter without range is looked for.
fn around(value: f64) -> [f64; 2] {
    match value {
        0.0 => [-REACH, REACH],
        value if value > 0.0 => [value / REACH, value * REACH],
        value => [value * REACH, value / REACH],
    }
}

fn too_many(fault: linkdyn_study::design::DesignFault) -> Unanswered {
    Unanswered::question(format!("optimise.design: {fault}"))
}
