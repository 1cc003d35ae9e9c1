//! Small signs: markers of curves, and the parts of a mechanism. Sizes are in bars; a bar is half the width of a drawn body.

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

pub use arrow::{HEAD, arrow, force_arrows, round_arrow};
pub use belt::{belt, pulley};
pub use cylinder::{barrel, piston, rod};
pub use ground::{hatched_line, rails, support};
pub use hull::{hull, ribbon, rounded_hull};
pub use line::{BLOCK, block, centre_of_mass, slot};
pub use marker::marker;
pub use rack::Rack;
pub use spring::{coil, damped_spring, dashpot, legs, round_dashpot, spring};
pub use wheel::{plain_ring, wheel};
