//! The derivatives of what the search sees: exact where the engine knows them, else left to differences.

use super::problem::Problem;
use super::target::Aim;
use linkdyn_model::optimise::Relation;
use linkdyn_optimise::curve::{foot, place};
use linkdyn_optimise::{Evaluate, Outcome};

/// Part of the range below which a value says nothing of the length over which it matters.
const LEAST_LENGTH: f64 = 1e-2;

/// The function of a search, with its derivatives.
pub struct Searched<'s, 'p>(pub &'s mut Problem<'p>);

impl Evaluate for Searched<'_, '_> {
    fn values(&mut self, x: &[f64]) -> Outcome {
        self.0.outcome(x)
    }

    fn slopes(&mut self, x: &[f64]) -> Option<Vec<f64>> {
        let slopes = self.0.slopes(x);
        self.0.count(slopes.as_deref(), x.len());
        slopes
    }
}

impl Problem<'_> {
    /// Over what change of each parameter the mechanism changes much.
    fn lengths(&self, x: &[f64]) -> Vec<f64> {
        let all = self.target.variables.iter().zip(x);
        all.map(|(own, x)| match own.range {
            Some([lower, upper]) => {
                let width = upper - lower;
                x.abs().max(LEAST_LENGTH * width).min(width)
            }
            None if *x != 0.0 => x.abs(),
            None => 1.0,
        })
        .collect()
    }

    /// Counts what derivatives come from.
    fn count(&mut self, slopes: Option<&[f64]>, columns: usize) {
        let numbers = match self.target.aim {
            Aim::Goal | Aim::Goals => self.target.constraints.len(),
            Aim::Curve => 1,
            Aim::Objective | Aim::ConstrainedCurve => 1 + self.target.constraints.len(),
        };
        let columns = columns.max(1);
        match (slopes, self.target.aim) {
            (None, _) => (0..numbers).for_each(|number| self.derivatives.count(number, false)),
            (Some(slopes), Aim::Curve) => {
                let is_exact = slopes.iter().all(|own| own.is_finite());
                self.derivatives.count(0, is_exact);
            }
            (Some(slopes), _) => {
                for (number, row) in slopes.chunks_exact(columns).enumerate() {
                    let is_exact = row.iter().all(|own| own.is_finite());
                    self.derivatives.count(number, is_exact);
                }
            }
        }
    }

    /// Derivatives of what [`Problem::outcome`] gives, a row for each value; NaN where one is not known.
    fn slopes(&mut self, x: &[f64]) -> Option<Vec<f64>> {
        let lengths = self.lengths(x);
        let distances = match self.target.curve.is_some() {
            true => self.path_slopes(x, &lengths),
            false => None,
        };
        if self.target.aim == Aim::Curve {
            let extent = self.extent;
            return distances.map(|all| all.into_iter().map(|own| own / extent).collect());
        }
        let numbers = self.number_slopes(x, &lengths);
        let mut rows = Vec::new();
        match self.target.aim {
            Aim::Objective => rows.extend(self.objective_slopes(&numbers, x, &lengths)),
            Aim::ConstrainedCurve => rows.extend(self.square_slopes(distances, x.len())),
            Aim::Goal | Aim::Goals | Aim::Curve => {}
        }
        let first = usize::from(self.target.objective.is_some());
        let row = |number: usize| &numbers[number * x.len()..(number + 1) * x.len()];
        for (k, (one, scale)) in self.target.constraints.iter().zip(self.scales).enumerate() {
            let sign = match one.relation {
                Relation::Equal | Relation::AtMost => 1.0,
                Relation::AtLeast => -1.0,
            };
            let (left, right) = (row(first + 2 * k), row(first + 2 * k + 1));
            let both = left.iter().zip(right);
            rows.extend(both.map(|(left, right)| sign * (left - right) / scale));
        }
        Some(rows)
    }

    /// Derivatives of the numbers of a run, NaN where one is not known.
    fn number_slopes(&mut self, x: &[f64], lengths: &[f64]) -> Vec<f64> {
        if self.last.numbers.as_deref() != Some(x) {
            self.measure(x);
        }
        let slopes = self.variant.ask(|own| own.slopes(x, lengths));
        slopes.unwrap_or_else(|_| vec![f64::NAN; self.target.numbers() * x.len()])
    }

    /// Of the objective, with what tolerances add.
    fn objective_slopes(&mut self, numbers: &[f64], x: &[f64], lengths: &[f64]) -> Vec<f64> {
        let target = self.target;
        let sign = target.objective.as_ref().map_or(1.0, |own| own.sign);
        let mut slopes: Vec<f64> = numbers[..x.len()].iter().map(|own| sign * own).collect();
        if let Some(robust) = &target.robust {
            let found = self.deviation_slopes(x, lengths, &robust.scatter);
            let added = found.unwrap_or_else(|| vec![f64::NAN; x.len()]);
            let both = slopes.iter_mut().zip(added);
            both.for_each(|(own, added)| *own += robust.sigmas * added);
        }
        slopes
    }

    /// Of σ = √Σ s², s the secants over ± σ of each parameter: Σ s s′/σ, by the gradients at both ends.
    fn deviation_slopes(
        &mut self,
        x: &[f64],
        lengths: &[f64],
        scatter: &[(String, f64)],
    ) -> Option<Vec<f64>> {
        let (mut squares, mut sum) = (0.0, vec![0.0; x.len()]);
        for (number, (_, sigma)) in scatter.iter().enumerate() {
            self.runs += 2;
            let mut at = |by: f64| {
                let found = self
                    .variant
                    .ask(|own| own.deviating_slopes(x, (number, by), lengths));
                found.ok().flatten()
            };
            let [(high, up), (low, down)] = [at(*sigma)?, at(-sigma)?];
            let secant = 0.5 * (high - low);
            squares += secant * secant;
            for (sum, (up, down)) in sum.iter_mut().zip(up.iter().zip(&down)) {
                *sum += secant * 0.5 * (up - down);
            }
        }
        let deviation = squares.sqrt();
        (deviation > 0.0).then(|| sum.iter().map(|own| own / deviation).collect())
    }

    /// Of the sum of the squares of the distances.
    fn square_slopes(&self, slopes: Option<Vec<f64>>, columns: usize) -> Vec<f64> {
        let known = slopes.zip(self.last.path.as_ref());
        let known = known.and_then(|(slopes, (_, nodes))| Some((slopes, self.distances(nodes)?)));
        let Some((slopes, distances)) = known else {
            return vec![f64::NAN; columns];
        };
        let mut sum = vec![0.0; columns];
        for (row, distance) in slopes.chunks_exact(columns.max(1)).zip(distances) {
            for (sum, slope) in sum.iter_mut().zip(row) {
                *sum += 2.0 * distance * slope / (self.extent * self.extent);
            }
        }
        sum
    }

    /// Derivatives of the distances from the path, at feet that are held.
    fn path_slopes(&mut self, x: &[f64], lengths: &[f64]) -> Option<Vec<f64>> {
        if self.last.path.as_ref().is_none_or(|(own, _)| own != x) {
            // The path at this point, again.
            match self.measure(x) {
                super::variants::Found::Some(_) => {}
                super::variants::Found::None(_) | super::variants::Found::Stopped => return None,
            }
        }
        let (_, nodes) = self.last.path.as_ref()?;
        let through = &self.target.curve.as_ref()?.through;
        let n = x.len();
        let Some(timing) = self.timing else {
            let feet: Vec<_> = through.iter().map(|point| foot(nodes, *point)).collect();
            let times: Vec<f64> = feet.iter().map(|foot| foot.s).collect();
            let slopes = self.variant.ask(|own| own.path_slopes(x, lengths, &times));
            let slopes = slopes.ok().flatten()?;
            let each = feet.iter().zip(slopes.chunks_exact(2 * n));
            let of = |(foot, own): (&linkdyn_optimise::curve::Foot, &[f64])| -> Vec<f64> {
                let [a, b] = foot.normal;
                (0..n).map(|k| a * own[k] + b * own[n + k]).collect()
            };
            return Some(each.flat_map(of).collect());
        };
        // Beyond its end a path has no place.
        timing
            .times
            .iter()
            .try_for_each(|time| place(nodes, *time).map(|_| ()))?;
        let slopes = self
            .variant
            .ask(|own| own.path_slopes(x, lengths, &timing.times));
        slopes.ok().flatten()
    }
}
