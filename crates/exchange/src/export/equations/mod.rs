//! The equations of motion in minimal coordinates, as a text that stands alone: a module of Python, or a document in LaTeX.
//!
//! A planar mechanism of revolute, prismatic and fixed joints has coordinates p in which every point is a sum of constant vectors that
//! turn with bodies and stretch along guides ([`place`]): absolute angles φ, slides s, and x, y of bodies on which no joint hangs
//! ([`linkage`]).
//!
//! ```text
//! g(p) = 0,  G p = (f(t), u)              loops that close; drivers and the independent coordinates u, rows of constants
//! K ṗ = (0, ḟ, u̇),  K p̈ = (γ, f̈, ü)      K = [∂g/∂p; G],  γ = −bend of g
//! M = Σ m Dᵀ D + I Tᵀ T                   D = ∂r/∂p of a centre of mass r, T = ∂θ/∂p of its body
//! h = Σ m Dᵀ bend(r)                      entries are sums of c cos(φ_i − φ_j + δ)
//! Q = Σ Dᵀ F + Tᵀ τ                       gravity, springs, loads, torques
//! M p̈ + h = Q + Kᵀ (λ, e, 0)              λ: forces in the joints that close loops, e: what drivers exert
//! Rᵀ M R ü = Rᵀ (Q − h − M c)             p̈ = R ü + c,  R = K⁻¹ (0, 0, 1)
//! ```
//!
//! Coordinates and the projection by R: J. García de Jalón and E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994;
//! equations in relative and absolute angles: J. Wittenburg, Dynamics of Multibody Systems, 2008. Deviations: the vectors of a
//! tree of joints are summed in absolute angles, so that no product of rotations is needed; slides are coordinates in closed loops, too.
//!
//! | file | has |
//! | --- | --- |
//! | [`place`] | sums of vectors, and their derivatives |
//! | `law` | laws of time |
//! | `refused` | what is not written |
//! | [`linkage`] | from a model to coordinates and sums |
//! | [`start`] | the start, and independent coordinates |
//! | `python`, `program` | the module |
//! | `waves`, `latex` | products of sums, and the document |

mod identifiers;
mod latex;
mod law;
pub mod linkage;
pub mod place;
mod program;
mod python;
mod refused;
pub mod start;
#[cfg(test)]
mod tests;
mod waves;

pub use law::TimeLaw;
pub use linkage::Linkage;
pub use start::{BodyState, Equations, StartState};
