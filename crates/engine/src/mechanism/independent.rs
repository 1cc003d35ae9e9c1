//! Which coordinates determine the rest well.

use super::driven::{Driven, TOGETHER};

/// A coordinate that moves this much more than the independent one takes its place.
pub(super) const EXCHANGE: f64 = 2.0;

/// An independent coordinate and the one that moves more than it, where there is one; `tangents` are ∂q/∂u, one after the other (f × n).
pub(super) fn better_coordinate(driven: &Driven, tangents: &[f64]) -> Option<(usize, usize)> {
    let mut best = None;
    best_of(driven, 0, tangents, &mut best);
    best.map(|(_, k, column)| (k, column))
}

/// The same without tangents at hand, at the last factors: some at a time.
pub(super) fn better_of_all(driven: &mut Driven) -> Option<(usize, usize)> {
    let (n, f) = (driven.system.n(), driven.independent.len());
    let mut some = vec![0.0; TOGETHER.min(f) * n];
    let (mut best, mut first) = (None, 0);
    while first < f {
        let count = TOGETHER.min(f - first);
        driven.tangents_from(first, &mut some[..count * n]);
        best_of(driven, first, &some[..count * n], &mut best);
        first += count;
    }
    best.map(|(_, k, column)| (k, column))
}

/// How much the other coordinate moves, the number of the independent one, and the other's column.
type Best = Option<(f64, usize, usize)>;

/// Looks through tangents from the first one's number on.
fn best_of(driven: &Driven, first: usize, tangents: &[f64], best: &mut Best) {
    let system = driven.system;
    for (k, tangent) in tangents.chunks_exact(system.n().max(1)).enumerate() {
        let own = system.column_scale(driven.independent[first + k].column);
        for (column, s) in tangent.iter().enumerate() {
            let moves = s.abs() * own / system.column_scale(column);
            if moves > EXCHANGE && best.is_none_or(|(most, ..)| moves > most) {
                *best = Some((moves, first + k, column));
            }
        }
    }
}
