//! Spread of an output, and what stays within limits: first order, sources independent of each other.
//!
//! ```text
//! σ² = Σ σ_i²     pin on the rim in any direction ½ c²|g|², anywhere in its bearing ¼ c²|g|²
//!                 play on either side c²g², anywhere between ⅓ c²g²; zone ¼ r²|g|²
//!                 normal (t/sigma)²g² (as if it were not cut), uniform t²g²/3, triangular t²g²/6      t half the width
//! μ  = Σ g (l + u)/2
//! C_p = (U − L)/(6σ),  C_pk = min(U − μ, μ − L)/(3σ),  yield = Φ((U − μ)/σ) − Φ((L − μ)/σ)
//! ```

use super::source::{Influence, Play};

/// How pins stand in their bearings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pins {
    /// Anywhere on the rim, the worst of it in worst cases.
    Rim,
    /// Anywhere in the bearing, its rim in worst cases.
    Disc,
    /// Where the loads press them.
    Load,
    /// In the middle: clearances do not count.
    None,
}

/// How a parameter scatters within its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scatter {
    /// Normal, its limits at so many standard deviations.
    Normal(f64),
    /// All values alike.
    Uniform,
    /// Falling from the middle to the limits in straight lines.
    Triangular,
}

impl Scatter {
    /// Variance for a half width.
    pub fn variance(self, half: f64) -> f64 {
        match self {
            Scatter::Normal(sigma) => (half / sigma).powi(2),
            Scatter::Uniform => half * half / 3.0,
            Scatter::Triangular => half * half / 6.0,
        }
    }
}

/// Mean of the square of a size that is anywhere between two.
fn mean_square([least, most]: [f64; 2]) -> f64 {
    (least * least + least * most + most * most) / 3.0
}

/// Mean and variance of the output by one source.
pub(super) fn moments(play: &Play, g: Influence, pins: Pins) -> [f64; 2] {
    let square = g[0] * g[0] + g[1] * g[1];
    let (rim, sides) = match pins {
        Pins::Rim => (0.5, 1.0),
        Pins::Disc => (0.25, 1.0 / 3.0),
        Pins::Load | Pins::None => (0.0, 0.0),
    };
    match play {
        Play::Pin { clearance, .. } => [0.0, rim * mean_square(*clearance) * square],
        Play::Sides { half, .. } => [0.0, sides * mean_square(*half) * g[0] * g[0]],
        Play::Guided { half, length, .. } => {
            let most = g[0].abs().max(2.0 * g[1].abs() / length);
            [0.0, sides * mean_square(*half) * most * most]
        }
        Play::Driver { half, .. } => [0.0, Scatter::Normal(3.0).variance(half * g[0])],
        Play::Zone { radius, .. } => [0.0, 0.25 * radius * radius * square],
        Play::Parameter {
            lower,
            upper,
            scatter,
            ..
        } => [
            g[0] * 0.5 * (lower + upper),
            scatter.variance(0.5 * (upper - lower) * g[0]),
        ],
    }
}

/// What stays within limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capability {
    /// Share that is within them.
    pub within: f64,
    /// C_p.
    pub cp: f64,
    /// C_pk.
    pub cpk: f64,
}

/// Of a normal deviation of mean `mean` and standard deviation `sigma` in limits; none where nothing scatters.
pub(super) fn capability([low, high]: [f64; 2], mean: f64, sigma: f64) -> Option<Capability> {
    if sigma <= 0.0 || !sigma.is_finite() {
        return None;
    }
    let below = |x: f64| 0.5 * libm::erfc(-(x - mean) / (sigma * std::f64::consts::SQRT_2));
    Some(Capability {
        // the smaller tails are exact
        within: 1.0
            - (below(low) + 0.5 * libm::erfc((high - mean) / (sigma * std::f64::consts::SQRT_2))),
        cp: (high - low) / (6.0 * sigma),
        cpk: (high - mean).min(mean - low) / (3.0 * sigma),
    })
}
