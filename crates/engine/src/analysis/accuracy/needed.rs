//! How far the output goes with a part of all deviations: the curve c(y) on the way to the reach.
//!
//! Beside a change point c goes with y², elsewhere with y. Shares that go with squares are dense enough for both.

use super::reach::{Between, Bordered, Displaced, Held};

/// Shares are (k/PARTS)².
const PARTS: usize = 8;
/// A reach that is off the straight line by less than this part needs no curve.
const STRAIGHT: f64 = 0.01;
/// Shares that people ask for.
const ROUND: [f64; 2] = [0.1, 0.5];

impl Bordered<'_, '_> {
    /// Deviations of the output, each with the share of all deviations that reaches it first, the least first; from displaced
    /// positions on the way from the nominal one (c = 0) to the reach (c = 1). A share at which nothing is found is left out;
    /// all are where the output goes with the share.
    pub(super) fn needed(&mut self, trail: &[Displaced]) -> Vec<[f64; 2]> {
        if is_straight(trail) {
            return Vec::new();
        }
        let mut shares: Vec<f64> = (1..PARTS)
            .map(|k| (k as f64 / PARTS as f64).powi(2))
            .collect();
        shares.extend(ROUND);
        shares.sort_by(f64::total_cmp);
        let mut curve = Vec::with_capacity(shares.len() + 1);
        for share in shares {
            curve.extend(self.at_share(trail, share).map(|y| [y, share]));
        }
        curve.extend(trail.last().map(|reached| [reached.y, 1.0]));
        curve
    }

    /// The deviation of the output where the share is first reached.
    fn at_share(&mut self, trail: &[Displaced], share: f64) -> Option<f64> {
        let mut ways = trail
            .windows(2)
            .map(|pair| Between::new(&pair[0], &pair[1]));
        ways.find_map(|between| {
            let guesses = [between.up(share), between.again(share)];
            guesses.into_iter().flatten().find_map(|guess| {
                let found = self.solve(guess, Held::Share(share))?;
                // Where c falls and rises again another position may have the same share.
                between.holds(found.y).then_some(found.y)
            })
        })
    }
}

/// Whether the reach is what the first position on the way says, to first order.
fn is_straight(trail: &[Displaced]) -> bool {
    match trail {
        [_, first, .., reached] => {
            (first.y / first.c / (reached.y / reached.c) - 1.0).abs() < STRAIGHT
        }
        _ => true,
    }
}
