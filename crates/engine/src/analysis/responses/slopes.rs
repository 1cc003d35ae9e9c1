//! Derivatives of responses by the parameters of a motion, from those of its columns at single instants.
//!
//! ```text
//! max, min, range    ∂y/∂p where the extreme is: that it moves changes nothing to first order (envelope theorem), or it stands at an end
//! at                 y_p − y_t c_p/c_t, c the difference of both sides, where c = 0
//! first, last        ∂y/∂p there
//! mean, rms, …       the sums over the rows, differentiated
//! argmax, argmin     not known: they take second derivatives
//! ```
//!
//! Where there is a single row, as at rest, it is the extreme and the mean; differences and times have nothing to change with.
//!
//! An extreme is known to the root of round-off only. There the slope y_t is not yet zero, and one secant of it says how far off the
//! instant is; the derivatives are carried there.

use super::running::Running;
use super::{Evaluation, Over, Reducer, TakenFrom};
use linkdyn_model::response::{Dual, Program, Reduction};

/// An instant beside an extreme, in parts of the distance of two rows.
const BESIDE: f64 = 1e-3;
/// An extreme is found again within this part of it.
const NEAR: f64 = 1e-2;
/// An extreme is where it should be within this part of it.
const THERE: f64 = 1e-9;
/// What is higher than its neighbours by less than this part of what parameters can do is flat.
const FLAT: f64 = 1e-9;
/// Of its slope beside it, no more than this part is left at a smooth one.
const LEVEL: f64 = 0.1;
/// Newton's steps to a crossing.
const STEPS: usize = 30;
/// A crossing is met within this part of the rows' distance.
const MET: f64 = 1e-14;

/// Gives the needed columns at a time, with derivatives by the parameters and, behind them if that is requested, by time.
pub type Columns<'c> = dyn FnMut(f64, bool) -> Option<Vec<Dual<f64>>> + 'c;

/// What a reduction is differentiated with.
struct ReductionSlopes<'a, 'c> {
    running: &'a Running,
    reducer: &'a Reducer,
    /// Times of the rows.
    rows: &'a [f64],
    parameters: &'a [Dual<f64>],
    /// How many parameters there are; time is the next.
    count: usize,
    /// Over which change of each it matters.
    lengths: &'a [f64],
    columns: &'a mut Columns<'c>,
}

/// The derivative by one parameter; zero where there is none, NaN where it is not known.
fn slope(of: &Dual<f64>, k: usize) -> f64 {
    match &of.slope {
        Ok(slopes) => slopes
            .iter()
            .find(|(own, _)| *own == k)
            .map_or(0.0, |(_, slope)| *slope),
        Err(_) => f64::NAN,
    }
}

fn dual(value: f64, count: usize, slope: impl Fn(usize) -> f64) -> Dual<f64> {
    let slopes = (0..count).map(|k| (k, slope(k)));
    Dual {
        value,
        slope: Ok(slopes.filter(|(_, slope)| *slope != 0.0).collect()),
    }
}

impl Evaluation<'_> {
    /// The parameters that responses name, with their derivatives: of each place among them by each of `count` parameters.
    pub fn parameters_with(
        &self,
        count: usize,
        slope: impl Fn(usize, usize) -> f64,
    ) -> Vec<Dual<f64>> {
        let all = self.parameters.iter().enumerate();
        all.map(|(place, value)| dual(*value, count, |k| slope(place, k)))
            .collect()
    }

    /// Works out the gradient of all responses, those of one behind each other, after their values: NaN where a derivative is not
    /// known. `rows` are the times of the rows, `lengths` the changes of the parameters that matter.
    pub fn differentiate(
        &self,
        rows: &[f64],
        (parameters, lengths): (&[Dual<f64>], &[f64]),
        gradient: &mut [f64],
        columns: &mut Columns,
    ) {
        let of = self.of;
        if of.is_empty() {
            return;
        }
        let count = lengths.len();
        for (response, gradient) in of.list.iter().zip(gradient.chunks_exact_mut(count.max(1))) {
            let mut inputs = Vec::with_capacity(response.sources.len());
            for source in &response.sources {
                let TakenFrom::Reducer(index) = *source else {
                    break;
                };
                let reducer = &of.reducers[index];
                let [from, to] = reducer.parameters;
                let mut reduced = ReductionSlopes {
                    running: &self.running[index],
                    reducer,
                    rows,
                    parameters: &parameters[from..to],
                    count,
                    lengths,
                    columns: &mut *columns,
                };
                match reduced.differentiate() {
                    Some(found) => inputs.push(found),
                    None => break,
                }
            }
            if inputs.len() < response.sources.len() {
                continue;
            }
            let (from, own) = (response.first_parameter, response.parameters.len());
            let total = response.total.dual(&inputs, &parameters[from..from + own]);
            for (k, slot) in gradient.iter_mut().enumerate() {
                *slot = slope(&total, k);
            }
        }
    }
}

impl ReductionSlopes<'_, '_> {
    /// The result with its derivatives; `None` if they are not known.
    fn differentiate(&mut self) -> Option<Dual<f64>> {
        let Over::Rows { value, equation } = &self.reducer.over else {
            return None;
        };
        if let [only] = *self.rows {
            return self.alone(value, only);
        }
        match self.reducer.reduction {
            Reduction::Max => self.extreme(value, 1.0),
            Reduction::Min => self.extreme(value, -1.0),
            Reduction::Range => {
                let (most, least) = (self.extreme(value, 1.0)?, self.extreme(value, -1.0)?);
                let range = most.value - least.value;
                let of = |k: usize| slope(&most, k) - slope(&least, k);
                Some(dual(range, self.count, of))
            }
            Reduction::First => self.held(value, *self.rows.first()?),
            Reduction::Last => self.held(value, *self.rows.last()?),
            Reduction::Integral => Some(self.sums(value)?[0].clone()),
            Reduction::Mean | Reduction::Sum => {
                let [integral, _] = self.sums(value)?;
                let by = 1.0 / self.duration()?;
                Some(dual(by * integral.value, self.count, |k| {
                    by * slope(&integral, k)
                }))
            }
            Reduction::Rms => {
                let [_, squares] = self.sums(value)?;
                let duration = self.duration()?;
                let root = (squares.value / duration).sqrt();
                let by = 0.5 / (root * duration);
                let of = |k: usize| by * slope(&squares, k);
                (root > 0.0).then(|| dual(root, self.count, of))
            }
            Reduction::At => self.crossing(value, equation.as_ref()?),
            Reduction::ArgMax | Reduction::ArgMin | Reduction::Count => None,
        }
    }

    /// Of the only row.
    fn alone(&mut self, program: &Program, time: f64) -> Option<Dual<f64>> {
        match self.reducer.reduction {
            Reduction::Max
            | Reduction::Min
            | Reduction::First
            | Reduction::Last
            | Reduction::Mean
            | Reduction::Sum => self.held(program, time),
            Reduction::Rms => {
                let here = self.held(program, time)?;
                let sign = here.value.signum();
                let size = dual(here.value.abs(), self.count, |k| sign * slope(&here, k));
                (here.value != 0.0).then_some(size)
            }
            Reduction::ArgMax | Reduction::ArgMin => Some(dual(time, self.count, |_| 0.0)),
            Reduction::Range | Reduction::Integral | Reduction::Count => {
                Some(dual(0.0, self.count, |_| 0.0))
            }
            Reduction::At => None,
        }
    }

    /// What a program gives at a time, with its derivative by time.
    fn value(&mut self, program: &Program, time: f64) -> Option<Dual<f64>> {
        let columns = (self.columns)(time, true)?;
        let found = program.dual(&columns, self.parameters);
        found.value.is_finite().then_some(found)
    }

    /// The same without the derivative by time.
    fn held(&mut self, program: &Program, time: f64) -> Option<Dual<f64>> {
        let columns = (self.columns)(time, false)?;
        let found = program.dual(&columns, self.parameters);
        found.value.is_finite().then_some(found)
    }

    /// At the extreme to a side (±1).
    fn extreme(&mut self, program: &Program, side: f64) -> Option<Dual<f64>> {
        let (first, last) = (*self.rows.first()?, *self.rows.last()?);
        let time = self.running.extreme(side)?;
        let here = self.value(program, time)?;
        let rate = slope(&here, self.count);
        let apart = (last - first) / (self.rows.len() - 1).max(1) as f64;
        let is_held = (time <= first && side * rate <= 0.0) || (time >= last && side * rate >= 0.0);
        if is_held && self.is_high(&here, rate.abs() * apart) {
            return Some(here);
        }
        let step = match time + BESIDE * apart > last {
            true => -BESIDE * apart,
            false => BESIDE * apart,
        };
        let near = self.value(program, time + step)?;
        let bend = (slope(&near, self.count) - rate) / step;
        if !self.is_high(&here, 0.5 * bend.abs() * apart * apart) {
            return None;
        }
        let off = -rate / bend;
        // At a kink the slope jumps instead.
        if side * bend >= 0.0 || off.abs() > NEAR * apart || bend.is_nan() {
            return None;
        }
        let there = time + off;
        let is_off = off.abs() > THERE * apart && (first..=last).contains(&there);
        let top = match is_off {
            true => self.value(program, there)?,
            false => here.clone(),
        };
        let level = |of: &Dual<f64>| slope(of, self.count).abs();
        if level(&top) > LEVEL * level(&near) {
            return None;
        }
        // What the secant leaves is small enough for a straight line.
        let at = if is_off { there } else { time };
        let part = -slope(&top, self.count) / (bend * (time + step - at));
        let part = if part.is_finite() { part } else { 0.0 };
        Some(dual(here.value, self.count, |k| {
            let (own, other) = (slope(&top, k), slope(&near, k));
            own + part * (other - own)
        }))
    }

    /// Whether an extreme that drops so much to the next row remains one where parameters change by a tiny part: what is flat
    /// has its extreme anywhere.
    fn is_high(&self, at: &Dual<f64>, drop: f64) -> bool {
        let all = self.lengths.iter().enumerate();
        let most = all.map(|(k, length)| slope(at, k).abs() * length);
        // NaN of what is not known counts for nothing.
        drop > FLAT * most.fold(0.0, f64::max)
    }

    /// Integrals of the values and of their squares over the rows.
    fn sums(&mut self, program: &Program) -> Option<[Dual<f64>; 2]> {
        let (mut integral, mut squares) = (vec![0.0; self.count + 1], vec![0.0; self.count + 1]);
        for index in 0..self.rows.len() {
            let before = index.saturating_sub(1);
            let after = (index + 1).min(self.rows.len() - 1);
            let weight = 0.5 * (self.rows[after] - self.rows[before]);
            let here = self.held(program, self.rows[index])?;
            integral[self.count] += weight * here.value;
            squares[self.count] += weight * here.value * here.value;
            for k in 0..self.count {
                let slope = weight * slope(&here, k);
                integral[k] += slope;
                squares[k] += 2.0 * here.value * slope;
            }
        }
        let made = |of: &[f64]| dual(of[self.count], self.count, |k| of[k]);
        Some([made(&integral), made(&squares)])
    }

    /// How long the rows take; none of a single one.
    fn duration(&self) -> Option<f64> {
        let duration = self.rows.last()? - self.rows.first()?;
        (duration > 0.0).then_some(duration)
    }

    /// Where both sides of an equation are the same.
    fn crossing(&mut self, program: &Program, sides: &[Program; 2]) -> Option<Dual<f64>> {
        let [mut low, mut high] = self.running.between_rows()?;
        let width = high - low;
        let mut time = 0.5 * (low + high);
        let mut below = None;
        for _ in 0..STEPS {
            let [left, right] = [self.value(&sides[0], time)?, self.value(&sides[1], time)?];
            let above = left.value - right.value;
            let rate = slope(&left, self.count) - slope(&right, self.count);
            let next = time - above / rate;
            if !next.is_finite() {
                return None;
            }
            let is_met = width == 0.0 || (next - time).abs() <= MET * width.max(time.abs());
            if is_met {
                let here = self.value(program, time)?;
                let flow = slope(&here, self.count) / rate;
                return Some(dual(here.value, self.count, |k| {
                    slope(&here, k) - flow * (slope(&left, k) - slope(&right, k))
                }));
            }
            // The bracket keeps the crossing where Newton's step leaves it.
            let rises = *below.get_or_insert(rate > 0.0);
            match (above < 0.0) == rises {
                true => low = time,
                false => high = time,
            }
            time = match (low..=high).contains(&next) {
                true => next,
                false => 0.5 * (low + high),
            };
        }
        None
    }
}
