//! Small signs: markers of curves, and the parts of a mechanism. Sizes are told in bars, half the width of a drawn body.

mod arrow;
mod belt;
mod cylinder;
mod ground;
mod hull;
mod line;
mod marker;
mod rack;
mod spring;
mod wheel;

pub use arrow::{arrow, round_arrow};
pub use belt::{Belt, belt, pulley};
pub use cylinder::{Cylinder, cylinder};
pub use ground::{hatched_line, rails, support};
pub use hull::rounded_hull;
pub use line::{BLOCK, block, slot};
pub use marker::marker;
pub use rack::{Rack, rack};
pub use spring::{coil, damped_spring, dashpot, round_dashpot, spring};
pub use wheel::{Wheel, wheel};
