//! Bounds that the rules of the claims share with the map of F12 and the page.

/// What counts as "near" a position \[deg\].
pub const NEAR: f64 = 2.5;
/// The paper's other singular configuration \[deg\].
pub const NEAR_OTHER: f64 = -40.0;
/// A change between neighbouring outputs this many times its median counts as abrupt.
pub const ABRUPT: f64 = 10.0;
/// The part of the stroke that is clear of the change point, for F12 \[deg\].
pub const CLEAR: f64 = 90.0;
