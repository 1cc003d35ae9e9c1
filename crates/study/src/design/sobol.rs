//! Sobol points with the direction numbers of Joe and Kuo, plain or with Owen's scrambling.
//!
//! ```text
//! point i    x = ⊕ v_k over the bits k that are set in i ⊕ (i >> 1)                    52 bits
//! v_k        m_k 2^(52−k) up to the degree s of the polynomial, v_{k−s} ⊕ (v_{k−s} >> s) ⊕ Σ a_j v_{k−j} beyond
//! scrambled  bit b flips by a hash of (column, the b bits above it): nested uniform scrambling, as a tree of random flips
//! ```
//!
//! Order and digits of the plain points are those of `scipy.stats.qmc.Sobol(scramble=False)`. Point 0 is the corner (0, …, 0). A count
//! that is a power of two is balanced. The mean of a smooth function errs by about N⁻¹ plain, by N^−1.5 scrambled.
//!
//! Sources: Joe and Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci. Comput. 30, 2008, file
//! new-joe-kuo-6, the first 256 dimensions, here `joe_kuo.txt`; Antonov and Saleev 1979 (the order); Owen, Randomly permuted (t, m, s)-nets
//! and (t, s)-sequences, 1995. The flips by a hash in place of a stored tree: Burley, Practical hash-based Owen scrambling, JCGT 9, 2020;
//! we hash each bit, where he uses one imperfect hash for all.

use super::fault::{DesignFault, MOST_COLUMNS};
use crate::random::{Philox, Purpose, mix};

/// Digits of a point: all that a double below 1 keeps when it is spaced evenly.
const BITS: usize = 52;
/// Digits that are scrambled one by one; those below are random.
const NESTED: usize = 32;

/// Degree, inner coefficients and first numbers of each dimension from the second on.
const TABLE: &str = include_str!("joe_kuo.txt");

/// Sobol points of some columns.
#[derive(Debug, Clone)]
pub(super) struct Sobol {
    columns: Vec<Column>,
}

#[derive(Debug, Clone)]
struct Column {
    /// v_k.
    directions: [u64; BITS],
    /// Keys of the scrambling.
    keys: Option<[u64; 2]>,
}

impl Sobol {
    /// Points with so many columns, scrambled by a seed if there is one.
    pub fn new(columns: usize, scrambled: Option<u64>) -> Result<Self, DesignFault> {
        if columns > MOST_COLUMNS {
            return Err(DesignFault::TooManyColumns { needed: columns });
        }
        let lines = TABLE
            .lines()
            .filter(|line| line.starts_with(char::is_numeric));
        let later = lines.map(|line| {
            let numbers = line.split(' ').map(|word| word.parse().unwrap_or_default());
            let numbers: Vec<u64> = numbers.collect();
            directions(numbers[2], &numbers[3..])
        });
        // The first column reverses the bits of i.
        let first: [u64; BITS] = std::array::from_fn(|k| 1 << (BITS - 1 - k));
        let all = std::iter::once(first).chain(later).take(columns);
        let key = |column: usize, seed| {
            let [a, b, ..] = Philox::of(seed, Purpose::Scramble).block([column as u64, 0, 0, 0]);
            [a, b]
        };
        let columns = all.enumerate().map(|(number, directions)| Column {
            directions,
            keys: scrambled.map(|seed| key(number, seed)),
        });
        Ok(Sobol {
            columns: columns.collect(),
        })
    }

    /// Coordinate `column` of point `number`, in \[0, 1).
    pub fn value(&self, number: u64, column: usize) -> f64 {
        let Column { directions, keys } = &self.columns[column];
        let mut rest = number ^ number >> 1;
        let mut x = 0;
        while rest != 0 {
            x ^= directions[rest.trailing_zeros() as usize];
            rest &= rest - 1;
        }
        let x = keys.map_or(x, |keys| scramble(x, keys));
        x as f64 / (1_u64 << BITS) as f64
    }
}

/// v_k of a column from the coefficients of its polynomial and its first numbers, whose count is its degree.
fn directions(a: u64, first: &[u64]) -> [u64; BITS] {
    let s = first.len();
    let mut v = [0; BITS];
    for k in 0..BITS {
        v[k] = if k < s {
            first[k] << (BITS - 1 - k)
        } else {
            let inner = (1..s).filter(|j| a >> (s - 1 - j) & 1 == 1);
            inner.fold(v[k - s] ^ v[k - s] >> s, |sum, j| sum ^ v[k - j])
        };
    }
    v
}

/// Flips each bit by a hash of the bits above it.
fn scramble(x: u64, keys: [u64; 2]) -> u64 {
    let hash = |node: u64| mix(mix(node ^ keys[0]).wrapping_add(keys[1]));
    let mut flips = 0;
    for level in 0..NESTED {
        // A one before the bits above tells the nodes of different levels apart.
        let node = 1 << level | x >> (BITS - level);
        flips |= (hash(node) & 1) << (BITS - 1 - level);
    }
    let low = (1 << (BITS - NESTED)) - 1;
    let node = 1 << NESTED | x >> (BITS - NESTED);
    x ^ flips ^ hash(node) & low
}
