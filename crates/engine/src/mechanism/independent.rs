//! Which coordinates determine the rest well.

use super::driven::Driven;

/// A coordinate that moves this much more than the independent one takes its place.
const EXCHANGE: f64 = 2.0;

/// An independent coordinate and the one that moves more than it, where there is one; `tangents` are ∂q/∂u, one after the other (f × n).
pub(super) fn better_coordinate(driven: &Driven, tangents: &[f64]) -> Option<(usize, usize)> {
    let system = driven.system;
    let mut best: Option<(f64, usize, usize)> = None;
    for (k, tangent) in tangents.chunks_exact(system.n().max(1)).enumerate() {
        let own = system.column_scale(driven.independent[k].column);
        for (column, s) in tangent.iter().enumerate() {
            let moves = s.abs() * own / system.column_scale(column);
            if moves > EXCHANGE && best.is_none_or(|(most, ..)| moves > most) {
                best = Some((moves, k, column));
            }
        }
    }
    best.map(|(_, k, column)| (k, column))
}
