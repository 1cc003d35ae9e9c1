//! Columns that have no bound at a change point: reactions, and what follows from them.
//!
//! ```text
//! y(δ) = A/δ + B + O(δ)                δ: from the change point; λ: A along its self-stress
//! o(δ) = ½ (y(δ) − y(−δ)) = A/δ + O(δ)
//! ```
//!
//! Of two distances δ and 2δ, o is the larger at the nearer one where there is an A, and half as large else. How large A is
//! depends on the loads: where they do not press on the self-stress, there is none.

use linkdyn_linear::math::max_abs;
use linkdyn_output::{Column, Trajectory};

/// Where columns are compared, in parts of a small distance: the order of rows.
pub(super) const DISTANCES: [f64; 4] = [1.0, -1.0, 2.0, -2.0];
/// What is less than this part of the largest value of its unit is round-off.
const ROUND_OFF: f64 = 1e-6;

/// Names of the columns without bound, from rows at [`DISTANCES`].
pub(super) fn unbounded(rows: &Trajectory) -> Vec<String> {
    if rows.len() != DISTANCES.len() {
        return Vec::new();
    }
    let at = |row: usize, column: usize| rows.row(row)[column];
    let odd = |a: usize, b: usize, column: usize| 0.5 * (at(a, column) - at(b, column)).abs();
    let mut largest: Vec<(&str, f64)> = Vec::new();
    for (index, Column { unit, .. }) in rows.columns.iter().enumerate() {
        let most = max_abs(&std::array::from_fn::<f64, 4, _>(|row| at(row, index)));
        match largest.iter_mut().find(|(known, _)| known == unit) {
            Some((_, known)) => *known = known.max(most),
            None => largest.push((unit, most)),
        }
    }
    let columns = rows.columns.iter().enumerate();
    let found = columns.filter(|(index, column)| {
        let (near, far) = (odd(0, 1, *index), odd(2, 3, *index));
        let of_unit = largest.iter().find(|(unit, _)| *unit == column.unit);
        near > far && of_unit.is_some_and(|(_, largest)| near > ROUND_OFF * largest)
    });
    found.map(|(_, column)| column.name.clone()).collect()
}
