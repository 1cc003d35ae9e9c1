//! What is known and unknown of a path.

use linkdyn_linear::bilinear::{Number, Random};

/// Displacements of eight points from the first, and their conjugates, which may be any numbers.
pub type Displacements = [[Number; 2]; 8];

/// x, x̄, a, ā, y, ȳ, b, b̄.
pub type Unknowns = [Number; 8];

/// Random displacements, of sizes between 0.5 and 1.5, so that no point stands out.
pub fn random_points(random: &mut Random) -> Displacements {
    let mut number = || random.turn() + random.turn() * 0.5;
    std::array::from_fn(|_| [number(), number()])
}
