//! What is known and unknown of a path.

use linkdyn_linear::bilinear::Number;

/// Displacements of eight points from the first, and their conjugates, which may be any numbers.
pub type Displacements = [[Number; 2]; 8];

/// x, x̄, a, ā, y, ȳ, b, b̄.
pub type Unknowns = [Number; 8];
