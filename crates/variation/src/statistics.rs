//! Spread of an output, and what stays within limits: first order, sources independent of each other.
//!
//! ```text
//! σ² = Σ σ_i²     pin on the rim in any direction ½ c²|g|², anywhere in its bearing ¼ c²|g|²
//!                 play on either side c²g², anywhere between ⅓ c²g²; zone ¼ r²|g|²
//!                 normal (t/sigma)²g², uniform t²g²/3, triangular t²g²/6                              t half the width
//! μ  = Σ g (l + u)/2
//! C_p = (U − L)/(6σ),  C_pk = min(U − μ, μ − L)/(3σ),  yield = Φ((U − μ)/σ) − Φ((L − μ)/σ)
//! ```
//!
//! The normal counts as if it were not cut, which is what root sums of squares mean by σ = t/3 (Chase 1988). Cut at 3 σ its
//! standard deviation is 0.98658 of that, at 2 σ 0.87963: the spread is wide rather than narrow.
//!
//! A slider with a length on its guide counts as being at its farthest, or evenly between there: anywhere in its room it would
//! scatter less, by c²(g_e² + (2g_γ/L)²)/6.

use super::source::{Kind, Pair, Room, Scatter, Source};

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

impl Source {
    /// Mean and variance of an output with this influence.
    pub fn moments(&self, g: Pair, pins: Pins) -> [f64; 2] {
        let most = self.room.most();
        let (mean, variance) = match (self.kind, self.room) {
            (Kind::Clearance { least }, room) => {
                let part = match (pins, room) {
                    (Pins::Rim, Room::Disc(_)) => 0.5,
                    (Pins::Disc, Room::Disc(_)) => 0.25,
                    (Pins::Rim, Room::Line(_) | Room::Guide { .. }) => 1.0,
                    (Pins::Disc, Room::Line(_) | Room::Guide { .. }) => 1.0 / 3.0,
                    (Pins::Load | Pins::None, _) => 0.0,
                };
                // The mean square of a size anywhere between two.
                let square = (least * least + least * most + most * most) / 3.0;
                (0.0, part * square)
            }
            (Kind::Driver, _) => (0.0, Scatter::Normal(3.0).variance(most)),
            (Kind::Zone, _) => (0.0, 0.25 * most * most),
            (Kind::Parameter(scatter), Room::Line([low, high])) => {
                (0.5 * (low + high), scatter.variance(0.5 * (high - low)))
            }
            (Kind::Parameter(_), Room::Disc(_) | Room::Guide { .. }) => (0.0, 0.0),
        };
        [mean * g[0], variance * self.room.norm(g).powi(2)]
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

/// Of a normal deviation of mean `mean` and standard deviation `sigma` in limits; `None` if nothing scatters.
pub(super) fn capability([low, high]: [f64; 2], mean: f64, sigma: f64) -> Option<Capability> {
    if sigma <= 0.0 || !sigma.is_finite() {
        return None;
    }
    // The small tails are exact.
    let tail = |x: f64| 0.5 * libm::erfc(x / (sigma * std::f64::consts::SQRT_2));
    Some(Capability {
        within: 1.0 - (tail(mean - low) + tail(high - mean)),
        cp: (high - low) / (6.0 * sigma),
        cpk: (high - mean).min(mean - low) / (3.0 * sigma),
    })
}

#[cfg(test)]
mod tests {
    use super::super::source::Acts;
    use super::*;

    fn source(kind: Kind, room: Room) -> Source {
        Source {
            name: String::new(),
            kind,
            room,
            acts: Acts::Row(0),
        }
    }

    fn parameter(lower: f64, upper: f64, scatter: Scatter) -> Source {
        source(Kind::Parameter(scatter), Room::Line([lower, upper]))
    }

    fn pin([least, most]: [f64; 2]) -> Source {
        source(Kind::Clearance { least }, Room::Disc(most))
    }

    fn same(found: f64, expected: f64) {
        let off = (found / expected - 1.0).abs();
        assert!(off < 1e-14, "{found} {expected}");
    }

    #[test]
    fn variances_are_those_of_the_distributions() {
        // scipy.stats: triang(0.5, -1.5, 3), uniform(-1, 2)
        same(Scatter::Triangular.variance(1.5), 0.375);
        same(Scatter::Uniform.variance(1.0), 1.0 / 3.0);
        same(Scatter::Normal(3.0).variance(1.0), 1.0 / 9.0);
        // truncnorm(-3, 3).std() and truncnorm(-2, 2).std(), as the page says.
        for (cut, part) in [(3.0_f64, 0.98657839256), (2.0, 0.87962566103)] {
            let density = (-0.5 * cut * cut).exp() / (2.0 * std::f64::consts::PI).sqrt();
            let within = 1.0 - libm::erfc(cut / std::f64::consts::SQRT_2);
            let own = (1.0 - 2.0 * cut * density / within).sqrt();
            assert!((own - part).abs() < 1e-10, "{own} {part}");
        }
    }

    #[test]
    fn a_clearance_anywhere_between_two_scatters_as_their_mean_square() {
        // ∫ c² dc / (b − a) from 0.1 to 0.4: 0.07
        let [mean, variance] = pin([0.1, 0.4]).moments([0.6, 0.8], Pins::Rim);
        assert_eq!(mean, 0.0);
        same(variance, 0.5 * 0.07);
        let [_, variance] = pin([0.4, 0.4]).moments([0.6, 0.8], Pins::Disc);
        same(variance, 0.25 * 0.16);
        assert_eq!(pin([0.4, 0.4]).moments([0.6, 0.8], Pins::None)[1], 0.0);
    }

    #[test]
    fn a_guided_slider_scatters_as_its_farthest() {
        let (c, length, g) = (0.2, 0.1, [0.9, 0.06]);
        let slide = source(Kind::Clearance { least: c }, Room::Guide { gap: c, length });
        // 2 g_γ/L = 1.2 is more than g_e.
        let rim = slide.moments(g, Pins::Rim)[1];
        let between = slide.moments(g, Pins::Disc)[1];
        same(rim, (c * 1.2_f64).powi(2));
        same(between, (c * 1.2_f64).powi(2) / 3.0);
        let anywhere = c * c * (0.9_f64.powi(2) + 1.2_f64.powi(2)) / 6.0;
        assert!(between > anywhere, "{between} {anywhere}");
        let shifted = slide.moments([1.5, 0.06], Pins::Rim);
        same(shifted[1], (c * 1.5).powi(2));
    }

    #[test]
    fn shares_within_limits_have_their_digits() {
        // mpmath with 30 digits, rounded
        let cases = [
            ([-1.2, 0.9], 0.1, 0.3, 0.9961622760085734),
            ([-6.0, 6.0], 0.0, 1.0, 1.0 - 1.973175290075396e-9),
            ([-1.0, 0.2], 0.5, 0.25, 0.11506966923512062),
        ];
        for (limits, mean, sigma, within) in cases {
            let found = capability(limits, mean, sigma).expect("it scatters");
            assert!((found.within - within).abs() < 4e-16, "{found:?}");
        }
        let found = capability([-1.2, 0.9], 0.1, 0.3).expect("it scatters");
        same(found.cp, 7.0 / 6.0);
        same(found.cpk, 8.0 / 9.0);
        assert_eq!(capability([-1.0, 1.0], 0.0, 0.0), None);
    }

    /// Four sources of four kinds, their true distribution convolved by numpy (truncnorm, uniform, triang, arcsine).
    #[test]
    fn a_sum_of_several_sources_is_nearly_normal() {
        let sources = [
            (parameter(-1.0, 1.0, Scatter::Normal(3.0)), [1.0, 0.0]),
            (parameter(-0.8, 0.8, Scatter::Uniform), [-1.5, 0.0]),
            (parameter(-1.0, 2.0, Scatter::Triangular), [0.6, 0.0]),
            (pin([0.5, 0.5]), [0.5, 1.2]),
        ];
        let all = sources.map(|(source, g)| source.moments(g, Pins::Rim));
        let mean: f64 = all.iter().map(|by| by[0]).sum();
        let variance: f64 = all.iter().map(|by| by[1]).sum();
        same(mean, 0.3);
        same(variance, 0.9373611111111111);
        for (limits, normal, exact) in [
            ([-2.0, 2.0], 0.95168567960296, 0.95702),
            ([-1.5, 1.8], 0.90784462184460, 0.90907),
            ([-2.5, 2.5], 0.98655262646503, 0.99215),
            ([-1.0, 1.0], 0.67548415739959, 0.65903),
        ] {
            let found = capability(limits, mean, variance.sqrt()).expect("it scatters");
            assert!((found.within - normal).abs() < 1e-13, "{found:?} {normal}");
            // Edgeworth: excess kurtosis −0.408, so no more than 2·0.408/24·max|He₃ φ| = 0.019.
            assert!((found.within - exact).abs() < 0.019, "{found:?} {exact}");
        }
    }
}
