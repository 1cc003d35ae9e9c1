//! All four-bars whose coupler point passes nine points.
//!
//! With p₀ as the origin, a dyad from the fixed pivot a to x on the coupler keeps its length as the coupler moves by δⱼ and turns by Θⱼ:
//!
//! ```text
//! Aⱼ Θⱼ + Āⱼ Θ̄ⱼ + Cⱼ = 0,   A = x (δ̄ − ā),   Ā = x̄ (δ − a),   C = δ δ̄ − δ ā − δ̄ a + x ā + x̄ a
//! ```
//!
//! The second dyad, (b, y), gives B, B̄, E. Both are linear in Θⱼ and Θ̄ⱼ, and ΘΘ̄ = 1 leaves for each of the eight displacements
//!
//! ```text
//! (E Ā − C B̄)(B C − A E) = (A B̄ − Ā B)²
//! ```
//!
//! in x, x̄, a, ā, y, ȳ, b, b̄, which are unknowns of their own (isotropic coordinates). Generic points have 4326 four-bars, 1442 coupler
//! curves with three cognates each (Wampler, Morgan and Sommese, Journal of Mechanical Design 114, 1992). Those of one random complex set
//! of points are stored, and are followed as the set moves to the wanted one: with probability one no path is lost (Morgan and Sommese,
//! Applied Mathematics and Computation 29, 1989).

mod follow;
mod monodromy;
mod table;
mod unknowns;

use crate::dyad::Dyad;
use follow::{End, NEAR, NEARER, follow};
use linkdyn_linear::bilinear::{Number, Random};
use rayon::prelude::*;
use table::Table;
use unknowns::random_points;

pub use monodromy::all_of_random_points;
pub use unknowns::{Displacements, Unknowns};

/// Points that a path is wanted through.
pub const POINTS: usize = 9;

/// Coupler curves through nine generic points.
pub const CURVES: usize = 1442;

/// How far, in parts of its size, a number may be from the conjugate of its bar, and still be real.
const REAL_PATH: f64 = 1e-8;
/// Fixed pivots nearer than this to moving ones, in parts of the extent of the points, are no link.
const SHORTEST: f64 = 1e-6;

/// The first unknowns of each class of three cognates, for the points of [`start`], as pairs of single floats.
const STORED: &[u8] = include_bytes!("curves.bin");

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Paths {
    /// Both dyads of each real four-bar, cognates one after the other; moving pivots where the point is at the first of the nine.
    pub found: Vec<[Dyad; 2]>,
    /// Coupler curves in complex numbers.
    pub complex: usize,
    /// Paths that went to infinity or ended in a singular point.
    pub singular: usize,
    /// Paths that were lost.
    pub lost: usize,
}

/// The points that the stored curves pass.
pub fn start() -> Displacements {
    random_points(&mut Random::new(0x2545_f491_4f6c_dd1d))
}

/// The stored curves, brought to round-off.
pub fn stored() -> Vec<Unknowns> {
    let float = |at: usize| {
        let bytes = STORED[4 * at..4 * at + 4].try_into().expect("four bytes");
        f64::from(f32::from_le_bytes(bytes))
    };
    let number = |at: usize| Number::new(float(2 * at), float(2 * at + 1));
    let all = (0..STORED.len() / 64).map(|k| std::array::from_fn(|i| number(8 * k + i)));
    let start = start();
    all.filter_map(|rough| follow::polished(rough, &start))
        .collect()
}

/// All real four-bars whose point passes nine points, in any order of motion. `stop` is asked whether to give up.
pub fn through_nine(points: &[Number; POINTS], stop: &(dyn Fn() -> bool + Sync)) -> Option<Paths> {
    let first = points[0];
    let size = points
        .iter()
        .map(|p| (p - first).norm())
        .fold(0.0, f64::max);
    let target: Displacements = std::array::from_fn(|j| {
        let delta = (points[j + 1] - first) / size;
        [delta, delta.conj()]
    });
    let from = start();
    let starts = stored();
    let followed = |which: &[usize], near: f64| -> Option<Vec<End>> {
        let ends = which
            .par_iter()
            .map(|k| (!stop()).then(|| follow(starts[*k], &from, &target, near)));
        ends.collect()
    };
    let all: Vec<usize> = (0..starts.len()).collect();
    let mut ends = followed(&all, NEAR)?;
    // Lost paths, and two that came to one curve, again with smaller steps.
    let again = doubtful(&ends);
    for (k, end) in again.iter().zip(followed(&again, NEARER)?) {
        ends[*k] = end;
    }
    let mut paths = Paths {
        found: Vec::new(),
        complex: 0,
        singular: ends.iter().filter(|end| **end == End::Singular).count(),
        lost: doubtful(&ends).len(),
    };
    let mut table = Table::default();
    for end in ends {
        if let End::Root(root) = end
            && table.add(root)
        {
            paths.complex += 1;
            paths.found.extend(real(&root, first, size));
        }
    }
    Some(paths)
}

/// Paths that were lost, and those of which two came to one curve.
fn doubtful(ends: &[End]) -> Vec<usize> {
    let again = |order: &mut dyn Iterator<Item = usize>| -> Vec<usize> {
        let mut table = Table::default();
        let is_again = |k: &usize| matches!(ends[*k], End::Root(root) if !table.add(root));
        order.filter(is_again).collect()
    };
    let lost = (0..ends.len()).filter(|k| ends[*k] == End::Lost);
    let mut all: Vec<usize> = lost.collect();
    all.extend(again(&mut (0..ends.len())));
    all.extend(again(&mut (0..ends.len()).rev()));
    all.sort_unstable();
    all.dedup();
    all
}

/// The real four-bars of a coupler curve.
fn real(root: &Unknowns, first: Number, size: f64) -> Vec<[Dyad; 2]> {
    let is_real = |root: &Unknowns| {
        let scale = root.iter().map(|z| z.norm()).fold(1.0, f64::max);
        let mut pairs = root.chunks(2);
        pairs.all(|pair| (pair[0] - pair[1].conj()).norm() <= REAL_PATH * scale)
    };
    let placed = |root: Unknowns| dyads(root.map(|z| z * size + first));
    let is_link = |[one, other]: &[Dyad; 2]| {
        let lengths = [
            one.fixed - one.moving,
            other.fixed - other.moving,
            one.moving - other.moving,
        ];
        lengths.iter().all(|way| way.norm() > SHORTEST * size)
    };
    // All cognates are real, or none is.
    let all = cognates(root).into_iter().filter(is_real);
    all.map(placed).filter(is_link).collect()
}

/// Both dyads of unknowns that are real, with all places counted from one origin.
pub(crate) fn dyads([x, _, a, _, y, _, b, _]: Unknowns) -> [Dyad; 2] {
    [(a, x), (b, y)].map(|(fixed, moving)| Dyad { fixed, moving })
}

/// A linkage and its two cognates (Roberts 1875): with k = (p − x)/(y − x) the third pivot is a + k (b − a).
pub fn cognates(one: &Unknowns) -> [Unknowns; 3] {
    let half = |x: Number, a: Number, y: Number, b: Number| {
        let k = x / (x - y);
        let c = a + (b - a) * k;
        // Of a and c: a − x, (x − a)(k − 1); of b and c, the same with the dyads exchanged, so 1 − k for k.
        [
            [a - x, a, (x - a) * (k - 1.0), c],
            [b - y, b, (b - y) * k, c],
        ]
    };
    let [x, xx, a, aa, y, yy, b, bb] = *one;
    let (own, bars) = (half(x, a, y, b), half(xx, aa, yy, bb));
    let joined = |k: usize| {
        std::array::from_fn(|i| {
            if i % 2 == 0 {
                own[k][i / 2]
            } else {
                bars[k][i / 2]
            }
        })
    };
    [*one, joined(0), joined(1)]
}
