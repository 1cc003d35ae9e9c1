//! What is kept of the ends of accepted steps.

use super::Reduced;
use super::accepted::AcceptedPoint;
use super::curve::CoordinateCurve;
use super::inertia::Inertia;
use super::place::Placed;
use crate::mechanism::driven::Failure;
use crate::mechanism::independent::better_coordinate;

impl Reduced<'_> {
    /// (t, (u, u̇)) is the end of an accepted step: it serves for predictions from now on.
    pub fn accept(&mut self, time: f64, y: &[f64]) {
        // First-same-as-last methods have just been there.
        let f = self.freedom();
        let there = self.at == Some(time)
            && self
                .driven
                .independent
                .iter()
                .enumerate()
                .all(|(k, coordinate)| coordinate.jet[0] == y[k] && coordinate.jet[1] == y[f + k]);
        if there || self.evaluate(time, y).is_ok() {
            self.tell();
            self.keep(time);
        }
    }

    /// Finds the last accepted point again where it was not kept.
    ///
    /// # Errors
    /// As [`Reduced::evaluate`].
    pub(super) fn recall(&mut self) -> Result<(), Failure> {
        if !self.accepted.is_whole() {
            let (time, state) = (
                self.accepted.here.s,
                std::mem::take(&mut self.accepted.state),
            );
            let evaluated = self.evaluate(time, &state);
            self.accepted.state = state;
            evaluated?;
            let jets = [&self.q[..], &self.v, &self.a];
            let tangents = &[];
            self.accepted.put(&AcceptedPoint {
                time,
                jets,
                tangents,
            });
        }
        Ok(())
    }

    /// What says how coordinates follow beside the point at hand.
    fn keep_motions(&mut self) {
        if let Some(sequence) = self.sequence.as_mut().filter(|own| own.is_of(&self.driven)) {
            sequence.keep(&self.driven);
        } else if let Inertia::Sparse(sparse) = &mut self.inertia {
            sparse.keep(&self.driven);
        }
    }

    /// Keeps the point at hand.
    pub(super) fn keep(&mut self, time: f64) {
        let given = |order: usize| {
            self.driven
                .independent
                .iter()
                .map(move |own| own.jet[order])
        };
        let state = &mut self.accepted.state;
        state.clear();
        state.extend(given(0).chain(given(1)));
        let tangents = self.inertia.known_tangents();
        self.accepted.has_better = better_coordinate(&self.driven, tangents).is_some();
        // A curve that comes round has no ends beyond which positions would be predicted, and what is said needs no prediction.
        if self.chart.curve().is_some_and(CoordinateCurve::comes_round) {
            self.accepted.pass(time);
        } else if self.sequence.is_some() {
            self.accepted.set_aside();
            self.accepted.put(&AcceptedPoint {
                time,
                jets: [&self.q, &self.v, &self.a],
                tangents,
            });
        } else {
            self.accepted.keep(AcceptedPoint {
                time,
                jets: [&self.q, &self.v, &self.a],
                tangents,
            });
        }
        // On straight constraints motions are those of any point.
        if self.placed != Placed::Straight {
            self.keep_motions();
        }
        if matches!(self.placed, Placed::Guess | Placed::Close) && self.driven.is_redundant() {
            // Where that fails, the next evaluation chooses rows anew.
            let _ = self.driven.exchange_rows();
            self.keep_motions();
        }
        self.keep_stages();
    }
}
