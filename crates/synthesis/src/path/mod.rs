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
use follow::{End, follow};
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

/// Routes that are taken at most, until all curves are found.
const ROUTES: usize = 6;

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
    /// Curves that may be missing: none if all of [`CURVES`] were found, or if a whole route brought no new one and its other paths
    /// ended in singular points.
    pub missing: usize,
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
    let (start, stored) = (start(), stored());
    let mut random = Random::new(1);
    let mut paths = Paths {
        found: Vec::new(),
        complex: 0,
        missing: CURVES,
    };
    let mut table = Table::default();
    for route in 0..ROUTES {
        // Equations of δ and of δ̄ keep their form if all lengths of one kind are turned. So the points start elsewhere on each route, and a
        // curve that a path misses, or that two paths come to, is met by another path on the next route.
        let turns = [(); 2].map(|()| match route {
            0 => Number::from(1.0),
            _ => random.turn(),
        });
        let from: Displacements = start.map(|[d, dd]| [d * turns[0], dd * turns[1]]);
        let ends: Option<Vec<End>> = stored
            .par_iter()
            .map(|root| {
                let root = std::array::from_fn(|i| root[i] * turns[i % 2]);
                (!stop()).then(|| follow(root, &from, &target))
            })
            .collect();
        let ends = ends?;
        let before = paths.complex;
        let singular = ends.iter().filter(|end| **end == End::Singular).count();
        for end in ends {
            if let End::Root(root) = end
                && table.add(root)
            {
                paths.complex += 1;
                paths.found.extend(real(&root, first, size));
            }
        }
        let gone = CURVES.saturating_sub(paths.complex + singular);
        let brought = paths.complex - before;
        paths.missing = CURVES.saturating_sub(paths.complex).min(gone.max(brought));
        if paths.missing == 0 {
            break;
        }
    }
    Some(paths)
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
