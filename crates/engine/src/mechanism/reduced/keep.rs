//! What is kept of the ends of accepted steps.

use super::Reduced;
use super::curve::Curve;
use super::inertia::Inertia;
use super::place::Placed;

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
        let point = [&self.q[..], &self.v, &self.a];
        // A curve that comes round has no ends beyond which positions would be predicted, and what is said needs no prediction.
        let is_said = self.sequence.is_some();
        let predicts = !is_said && !self.chart.curve().is_some_and(Curve::comes_round);
        let tangents = self.inertia.known_tangents();
        self.accepted.keep(time, point, tangents, predicts);
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
