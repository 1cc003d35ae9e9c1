//! Where deviations come from, and how far each can carry an output.
//!
//! With g = ∂y/∂e of the gap e that a source makes (for a joint −λ, the reaction under a unit load on the output):
//!
//! ```text
//! pin, clearance c                      |e| ≤ c                          reach c|g|                e = c g/|g|
//! zone about a point, diameter t        |d| ≤ t/2                        t/2·|g|
//! slot, slide without length, play c    |e| ≤ c                          c|g|
//! slide of length L on its guide        |e| + |γ| L/2 ≤ c                c·max(|g_e|, 2|g_γ|/L)
//! gear, backlash j                      |e| ≤ j/2 along the pitch circle  j/2·|g|/R₂
//! driver, tolerance t                   |e| ≤ t                          t|g|
//! parameter, from l to u                l ≤ p ≤ u                        max(l g, u g)
//! ```

use super::dimensions::PointId;
use super::statistics::Scatter;

/// What makes a deviation.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Play {
    /// A journal in its bearing: any gap up to the clearance in two rows from `row` on.
    Pin { row: usize, clearance: [f64; 2] },
    /// To either side in one row [m or rad].
    Sides { row: usize, half: [f64; 2] },
    /// A slider of a length on its guide: rows of the gap and of the turn.
    Guided {
        row: usize,
        half: [f64; 2],
        length: f64,
    },
    /// A driver that is off its value.
    Driver { row: usize, half: f64 },
    /// A point anywhere in its zone.
    Zone { point: PointId, radius: f64 },
    /// A parameter: what a unit of it changes in the dimensions, and whether what it changes bends.
    Parameter {
        lower: f64,
        upper: f64,
        scatter: Scatter,
        steps: Vec<(usize, f64)>,
        bends: bool,
    },
}

/// g of a source: one or two numbers.
pub(super) type Influence = [f64; 2];

/// |g| of a source with two numbers.
pub(super) fn length(g: Influence) -> f64 {
    (g[0] * g[0] + g[1] * g[1]).sqrt()
}

impl Play {
    /// Whether it lets anything be off.
    pub fn is_off(&self) -> bool {
        match self {
            Play::Pin {
                clearance: most, ..
            }
            | Play::Sides { half: most, .. }
            | Play::Guided { half: most, .. } => most[1] > 0.0,
            Play::Driver { half: most, .. } | Play::Zone { radius: most, .. } => *most > 0.0,
            Play::Parameter { lower, upper, .. } => *lower != 0.0 || *upper != 0.0,
        }
    }

    /// Greatest g·e over all e that the source allows, and least: how far it carries the output up and down.
    #[inline]
    pub fn reach(&self, g: Influence) -> [f64; 2] {
        let both = |reach: f64| [-reach, reach];
        match self {
            Play::Pin { clearance, .. } => both(clearance[1] * length(g)),
            Play::Sides { half, .. } => both(half[1] * g[0].abs()),
            Play::Driver { half, .. } => both(half * g[0].abs()),
            Play::Guided { half, length, .. } => {
                both(half[1] * g[0].abs().max(2.0 * g[1].abs() / length))
            }
            Play::Zone { radius, .. } => both(radius * length(g)),
            Play::Parameter { lower, upper, .. } => {
                let (a, b) = (lower * g[0], upper * g[0]);
                [a.min(b), a.max(b)]
            }
        }
    }

    /// Both ends of a source that goes to either side of one number.
    pub fn ends(&self) -> Option<[f64; 2]> {
        match self {
            Play::Sides { half, .. } => Some([-half[1], half[1]]),
            Play::Driver { half, .. } => Some([-half, *half]),
            Play::Parameter { lower, upper, .. } => Some([*lower, *upper]),
            Play::Pin { .. } | Play::Zone { .. } | Play::Guided { .. } => None,
        }
    }

    /// The e with the greatest g·e, times `side` (±1) the least.
    pub fn extreme(&self, g: Influence, side: f64) -> Influence {
        let one = |half: f64| [half * side * g[0].signum(), 0.0];
        let disc = |radius: f64| {
            let size = length(g);
            if size > 0.0 {
                [radius * side * g[0] / size, radius * side * g[1] / size]
            } else {
                [0.0, 0.0]
            }
        };
        match self {
            Play::Pin { clearance, .. } => disc(clearance[1]),
            Play::Zone { radius, .. } => disc(*radius),
            Play::Sides { half, .. } => one(half[1]),
            Play::Driver { half, .. } => one(*half),
            Play::Guided { half, length, .. } => {
                if g[0].abs() >= 2.0 * g[1].abs() / length {
                    one(half[1])
                } else {
                    [0.0, side * g[1].signum() * 2.0 * half[1] / length]
                }
            }
            Play::Parameter { lower, upper, .. } => {
                [if side * g[0] >= 0.0 { *upper } else { *lower }, 0.0]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of all gaps and turns that |e| + |γ| L/2 ≤ c allows the extreme one carries the output farthest, as far as the reach says.
    #[test]
    fn a_guided_slider_goes_to_a_corner_of_its_room() {
        let (c, length) = (0.03, 0.4);
        let play = Play::Guided {
            row: 0,
            half: [0.01, c],
            length,
        };
        // By the gap, by the turn, both alike, either sign.
        let cases = [
            ([2.0, 0.1], c * 2.0),
            ([-0.3, 0.5], c * 2.5),
            ([1.0, -0.2], c * 1.0),
            ([0.0, 0.0], 0.0),
        ];
        for (g, reach) in cases {
            let [down, up] = play.reach(g);
            assert!(
                (up - reach).abs() < 1e-16 && down == -up,
                "{g:?}: {up} {reach}"
            );
            for side in [-1.0, 1.0] {
                let [e, turn] = play.extreme(g, side);
                let used = e.abs() + 0.5 * length * turn.abs();
                assert!((used - c).abs() < 1e-17 || reach == 0.0, "{e} {turn}");
                let carried = g[0] * e + g[1] * turn;
                assert!((carried - side * up).abs() < 1e-16, "{g:?}: {carried}");
            }
            let mut most = 0.0_f64;
            for k in 0..=100 {
                let part = 0.01 * f64::from(k);
                for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                    let (e, turn) = (a * c * part, b * 2.0 * c * (1.0 - part) / length);
                    most = most.max(g[0] * e + g[1] * turn);
                }
            }
            assert!((most - up).abs() < 1e-16, "{g:?}: {most} {up}");
        }
    }
}
