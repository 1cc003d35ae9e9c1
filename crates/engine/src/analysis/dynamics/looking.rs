//! What is looked at in a motion with contacts: the extremes of columns, and where polynomials say that there are more.

use super::episodes::{Episodes, by_time, insert};
use super::motion::Motion;
use super::settings::Settings;
use super::watch::{Node, SIDES, Watch};
use super::within::{self, POINTS};
use linkdyn_output::Trajectory;

/// How much larger a column may be between the points of a step than at them, in parts of the values' range.
const BETWEEN: f64 = 0.15;
/// Part of the values' range in a step by which a polynomial may be wrong at its top.
const WRONG: f64 = 1e-4;

/// What is looked at in a motion with contacts, beside the motion itself.
pub struct Looking {
    /// The extremes so far.
    pub(super) watch: Watch,
    /// The rows of contacts.
    pub(super) episodes: Episodes,
    /// The points within the step that give the polynomials.
    pub(super) inner: [Node; POINTS],
    /// The row that was evaluated last.
    pub(super) here: Node,
    /// Contacts and changes between stick and slip so far.
    pub(super) happened: u64,
}

/// A top to be looked at: quantity, side, place within the step, and value there by its polynomial.
pub(super) type Top = (usize, usize, f64, f64);

impl Looking {
    /// For what is wanted of a motion.
    pub fn new(motion: &Motion, settings: &Settings) -> Self {
        let system = motion.system();
        Looking {
            watch: Watch::new(system, settings.contents, &settings.columns),
            episodes: Episodes::new(system.contacts.len(), settings.events_are_outputs),
            inner: Default::default(),
            here: Node::default(),
            happened: 0,
        }
    }

    /// Puts rows at events into the outputs where they are wanted there, and gives the rows of peaks beside them.
    pub fn finish(self, outputs: &mut Trajectory) -> Trajectory {
        let (rows, are_outputs) = self.episodes.rows();
        let mut rows = by_time(rows);
        if are_outputs {
            insert(outputs, &rows);
            rows.clear();
        }
        rows.extend(
            self.watch
                .rows_beyond(outputs)
                .into_iter()
                .map(<[f64]>::to_vec),
        );
        let mut peaks = Trajectory::with_columns(&outputs.columns);
        by_time(rows).iter().for_each(|row| peaks.push_row(row));
        peaks
    }

    /// Tops of the polynomials that exceed the extremes so far.
    pub(super) fn tops(&self) -> Vec<Top> {
        let mut tops = Vec::new();
        for quantity in 0..self.watch.len() {
            let values = self.inner.each_ref().map(|node| node.values[quantity]);
            let (low, high) = values
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                    (low.min(*value), high.max(*value))
                });
            for (side, sign) in SIDES.into_iter().enumerate() {
                let extreme = sign * self.watch.extreme(quantity, side);
                let largest = if side == 0 { -low } else { high };
                // Between such points it is no larger, unless it is none that a polynomial meets.
                if largest + BETWEEN * (high - low) > extreme + self.watch.near[quantity] {
                    let (place, value) = within::top(&values.map(|value| sign * value));
                    if value > extreme + self.watch.near[quantity] {
                        tops.push((quantity, side, place, sign * value));
                    }
                }
            }
        }
        tops
    }

    /// Whether the row that was evaluated last is not what the polynomial says of its top.
    pub(super) fn is_wrong(&self, &(quantity, _, _, value): &Top) -> bool {
        let values = self.inner.iter().map(|node| node.values[quantity]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        (self.here.values[quantity] - value).abs()
            > WRONG * (high - low) + self.watch.near[quantity]
    }
}
