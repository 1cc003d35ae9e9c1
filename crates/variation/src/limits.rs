//! What all searches for positions share.

/// Most corrections of a position: those that contract at all are done after a few.
pub(super) const MOST_PASSES: usize = 40;
/// Most steps of an ascent, or along an output.
pub(super) const MOST_STEPS: usize = 300;
/// The last correction, in radians or sizes: what is read then lacks its square.
pub(super) const DONE: f64 = 1e-10;
/// A correction longer than this, in radians or sizes, leads to another branch.
pub(super) const LONGEST: f64 = 0.3;
/// What is left to do after a correction of a size and the one before: those that contract go on to do so.
pub(super) fn left(size: f64, last: f64) -> f64 {
    if last.is_finite() {
        size * (size / last).min(1.0)
    } else {
        size
    }
}
/// Numbers that differ by less than this part are the same.
pub(super) const SAME: f64 = 1e-10;
