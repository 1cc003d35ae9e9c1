//! A variant as the search sees it: an objective, how far constraints are off, how far a path is from its points.

use super::derivatives::{Derivatives, Last};
use super::guarded::Guarded;
use super::target::{Aim, Target};
use super::timing::Timing;
use super::variants::{Call, Detail, Found, Share};
use linkdyn_model::optimise::Relation;
use linkdyn_optimise::Outcome;
use linkdyn_optimise::curve::{Node, foot, place};
use linkdyn_optimise::quadratic::Kind;

/// What a variant comes to.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measured {
    /// As the model says it [SI], without what robustness adds.
    pub objective: f64,
    /// Standard deviation of the objective by tolerances [SI].
    pub deviation: Option<f64>,
    /// Both sides of each constraint [SI].
    pub sides: Vec<[f64; 2]>,
    /// Distance of each point from the path, with its sign, or both coordinates of it where the time counts [m].
    pub distances: Vec<f64>,
    /// The model's responses, NaN where they have no value.
    pub responses: Vec<f64>,
}

/// One evaluation, for the table.
#[derive(Debug, Clone)]
pub struct Record {
    pub x: Vec<f64>,
    /// Why there is nothing.
    pub missing: Option<String>,
    pub measured: Measured,
}

/// What a start has before it.
pub struct Problem<'p> {
    pub target: &'p Target,
    pub variant: Guarded<'p, Share<'p>>,
    pub timing: Option<&'p Timing>,
    /// Size of each constraint's sides.
    pub scales: &'p [f64],
    /// Size of the wanted curve [m].
    pub extent: f64,
    pub detail: Detail,
    pub call: Call,
    /// Runs of the engine.
    pub runs: u64,
    /// The evaluations, where they are wanted.
    pub records: Option<Vec<Record>>,
    /// What the derivatives came from.
    pub derivatives: Derivatives,
    /// Where numbers were worked out last, and the path with them.
    pub last: Last,
}

impl Target {
    /// What each constraint wants of its scaled difference.
    pub fn kinds(&self) -> Vec<Kind> {
        let all = self.constraints.iter();
        all.map(|one| match one.relation {
            Relation::Equal => Kind::Equal,
            Relation::AtMost | Relation::AtLeast => Kind::AtMost,
        })
        .collect()
    }

    /// Size of the wanted curve: the diagonal of the box around its points [m].
    pub fn extent(&self) -> f64 {
        let Some(curve) = &self.curve else {
            return 1.0;
        };
        let width = |k: usize| {
            let all = curve.through.iter().map(|point| point[k]);
            let most = all.clone().fold(f64::NEG_INFINITY, f64::max);
            most - all.fold(f64::INFINITY, f64::min)
        };
        match width(0).hypot(width(1)) {
            extent if extent > 0.0 => extent,
            _ => 1.0,
        }
    }

    /// Scaled differences of constraints, those that are to be at least something with the other sign.
    pub fn differences(&self, measured: &Measured, scales: &[f64]) -> Vec<f64> {
        let all = self.constraints.iter().zip(&measured.sides).zip(scales);
        all.map(|((one, [left, right]), scale)| match one.relation {
            Relation::Equal | Relation::AtMost => (left - right) / scale,
            Relation::AtLeast => (right - left) / scale,
        })
        .collect()
    }
}

impl Problem<'_> {
    /// What a variant comes to.
    pub fn measure(&mut self, x: &[f64]) -> Found<Measured> {
        let found = self.measured(x);
        if let Some(records) = &mut self.records
            && found != Found::Stopped
        {
            let (missing, measured) = match &found {
                Found::Some(measured) => (None, measured.clone()),
                Found::None(why) => (Some(why.clone()), Measured::default()),
                Found::Stopped => (None, Measured::default()),
            };
            records.push(Record {
                x: x.to_vec(),
                missing,
                measured,
            });
        }
        found
    }

    fn measured(&mut self, x: &[f64]) -> Found<Measured> {
        let mut measured = Measured::default();
        if self.target.curve.is_some() {
            self.runs += 1;
            self.last.path = None;
            let (detail, call) = (self.detail, self.call);
            match self.variant.find(|own| own.path(x, detail, call)) {
                Found::Some(nodes) => match self.distances(&nodes) {
                    Some(distances) => {
                        measured.distances = distances;
                        self.last.path = Some((x.to_vec(), nodes));
                    }
                    None => return Found::None("the path is too short".to_owned()),
                },
                Found::None(why) => return Found::None(why),
                Found::Stopped => return Found::Stopped,
            }
        }
        // Responses are reported in the end, and no search needs them.
        let is_told = self.call == Call::Last && !self.target.responses.is_empty();
        if self.target.aim == Aim::Curve && !is_told {
            return Found::Some(measured);
        }
        self.runs += 1;
        self.last.numbers = Some(x.to_vec());
        let call = self.call;
        let all = match self.variant.find(|own| own.numbers(x, call)) {
            Found::Some(all) => all,
            // A path is one even where the model's own analysis has no end.
            Found::None(_) if self.target.aim == Aim::Curve => return Found::Some(measured),
            Found::None(why) => return Found::None(why),
            Found::Stopped => return Found::Stopped,
        };
        self.take(&all, &mut measured);
        if let Some(robust) = &self.target.robust {
            match self.scatter(x, &robust.scatter) {
                Found::Some(deviation) => measured.deviation = Some(deviation),
                Found::None(why) => return Found::None(why),
                Found::Stopped => return Found::Stopped,
            }
        }
        Found::Some(measured)
    }

    /// The numbers of a run.
    pub fn take(&self, all: &[f64], measured: &mut Measured) {
        let first = usize::from(self.target.objective.is_some());
        let needed = self.target.numbers();
        if first == 1 {
            measured.objective = all[0];
        }
        measured.sides = all[first..needed]
            .chunks_exact(2)
            .map(|pair| [pair[0], pair[1]])
            .collect();
        measured.responses = all[needed..].to_vec();
    }

    /// σ of the objective to first order: √Σ (∂f/∂p σ)², by secants over ± σ of each parameter.
    fn scatter(&mut self, x: &[f64], scatter: &[(String, f64)]) -> Found<f64> {
        let mut squares = 0.0;
        for (number, (_, sigma)) in scatter.iter().enumerate() {
            let mut ends = [0.0; 2];
            for (end, by) in ends.iter_mut().zip([*sigma, -sigma]) {
                self.runs += 1;
                let call = self.call;
                let found = self
                    .variant
                    .find(|own| own.deviating(x, (number, by), call));
                match found {
                    Found::Some(all) => *end = all[0],
                    Found::None(why) => return Found::None(why),
                    Found::Stopped => return Found::Stopped,
                }
            }
            squares += (0.5 * (ends[0] - ends[1])).powi(2);
        }
        Found::Some(squares.sqrt())
    }

    /// How far the points are from the path.
    pub fn distances(&self, nodes: &[Node]) -> Option<Vec<f64>> {
        let curve = self.target.curve.as_ref()?;
        if nodes.len() < 2 {
            return None;
        }
        let Some(timing) = self.timing else {
            return Some(
                curve
                    .through
                    .iter()
                    .map(|point| foot(nodes, *point).residual)
                    .collect(),
            );
        };
        let mut all = Vec::with_capacity(2 * curve.through.len());
        for (point, time) in curve.through.iter().zip(&timing.times) {
            let [x, y] = place(nodes, *time)?;
            all.extend([x - point[0], y - point[1]]);
        }
        Some(all)
    }

    /// What is to be least: the objective with what robustness adds, or the squares of the distances by the size of the curve.
    pub fn value(&self, measured: &Measured) -> f64 {
        match &self.target.objective {
            Some(aimed) => {
                let sigmas = self.target.robust.as_ref().map_or(0.0, |own| own.sigmas);
                aimed.sign * measured.objective + sigmas * measured.deviation.unwrap_or(0.0)
            }
            None => {
                let squares = measured
                    .distances
                    .iter()
                    .map(|own| (own / self.extent).powi(2));
                squares.sum()
            }
        }
    }

    /// The function of the search.
    pub fn outcome(&mut self, x: &[f64]) -> Outcome {
        let measured = match self.measure(x) {
            Found::Some(measured) => measured,
            Found::None(_) => return Outcome::Missing,
            Found::Stopped => return Outcome::Stopped,
        };
        let differences = self.target.differences(&measured, self.scales);
        Outcome::of(match self.target.aim {
            Aim::Goal | Aim::Goals => differences,
            Aim::Curve => measured
                .distances
                .iter()
                .map(|own| own / self.extent)
                .collect(),
            Aim::Objective | Aim::ConstrainedCurve => std::iter::once(self.value(&measured))
                .chain(differences)
                .collect(),
        })
    }
}
