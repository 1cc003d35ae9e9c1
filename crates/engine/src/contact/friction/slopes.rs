//! Derivatives of the friction force on one piece of its law, for whoever solves equations with it.

use super::Law;

/// Part of the sliding velocity or of the law's own over which its slope is taken [–]: errors of its square, and of round-off over it.
const STENCIL: f64 = 1e-5;

impl Law {
    /// Derivatives of T by the sliding velocity and by the normal force on a piece, of laws without bristles: T is in proportion
    /// to the normal force there, and smooth in the velocity.
    pub(crate) fn slopes_on_piece(&self, piece: i8, sliding: f64, normal: f64) -> [f64; 2] {
        let of = |sliding: f64| self.on_piece(piece, sliding, 1.0, 0.0).force;
        let kink = self
            .kinks()
            .fold(0.0, |most, kink| f64::max(most, kink.abs()));
        let step = STENCIL * f64::max(sliding.abs(), kink);
        let slope = if step > 0.0 {
            (of(sliding + step) - of(sliding - step)) / (2.0 * step)
        } else {
            0.0
        };
        [slope * normal, of(sliding)]
    }
}
