//! Which coordinates determine the rest well.

use super::driven::Driven;

/// A coordinate that moves this much more than the one pinned takes its place.
const EXCHANGE: f64 = 2.0;

/// A pin and the coordinate that moves more than it, where there is one; `motions` are ∂q/∂u, one after the other (f × n).
pub(super) fn better_pin(driven: &Driven, motions: &[f64]) -> Option<(usize, usize)> {
    let system = driven.system;
    let mut best: Option<(f64, usize, usize)> = None;
    for (k, motion) in motions.chunks_exact(system.n().max(1)).enumerate() {
        let own = system.column_scale(driven.pins[k].column);
        for (column, s) in motion.iter().enumerate() {
            let moves = s.abs() * own / system.column_scale(column);
            if moves > EXCHANGE && best.is_none_or(|(most, ..)| moves > most) {
                best = Some((moves, k, column));
            }
        }
    }
    best.map(|(_, k, column)| (k, column))
}
