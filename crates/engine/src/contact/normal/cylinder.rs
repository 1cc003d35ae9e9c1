//! Parallel cylinders, a journal in a longer bearing: force per length instead of the spheres' K δ^1.5.
//!
//! ```text
//! L        axial length of the contact                    [m]
//! ΔR       R_b − R_j, the radial clearance                [m]
//! E*       contact modulus, 1/E* = h_b + h_j              [Pa]
//! κ        π E* L, slope of the force in a conformal limit [N/m]
//!
//! Johnson                  δ = F/κ · (ln(4π E* ΔR L/F) − 1)
//! Radzimovsky              δ = F/κ · (2/3 + ln(4R_b/b) + ln(4R_j/b)),     b = 1.6 √(F R_b R_j/(L E* ΔR))
//! Dubowsky, Freudenstein   δ = F/κ · (ln(κ L² ΔR/(F R_b R_j)) + 1)        h with 1/π, exponent 3 of L
//! ```
//!
//! All three are one law, δ = (F/κ) ln(Λ/F), with
//!
//! ```text
//! Λ = 4κΔR/e,   Λ = 6.25 e^(2/3) κΔR/π,   Λ = e κΔR L²/(R_b R_j)          [N]
//! ```
//!
//! In x = F/Λ and y = κδ/Λ it reads y = −x ln x. Newton's method solves it for u = ln x from u + ln(−u) = ln y, whose left
//! side rises and bends down, so that the second iterate is below the root and the others rise to it.
//!
//! ```text
//! F(0) = 0,  dF/dδ = κ/(ln(Λ/F) − 1),  zero at δ = 0        ∫F dδ = (Λ²/κ) · x²(−2u − 1)/4
//! ```
//!
//! **Range.** The formulas take the patch of contact to be narrow against the radii. δ(F) has a maximum at F = Λ/e, beyond
//! which a larger force would go with less penetration; the slope is infinite there. They are used up to x = e⁻², where
//! dF/dδ = κ; from there F goes on straight with this slope. That is δ = 0.398 ΔR for Johnson (its half-width, 0.89 √(R_b R_j), is
//! past what its theory holds for), 1.049 ΔR for Radzimovsky and 0.736 ΔR L²/(R_b R_j) for the third. `Logarithmic::range` tells it.
//!
//! Pereira, Ramalho and Ambrósio fitted an explicit power law F = K δⁿ to Johnson's curve, in millimetres and newtons,
//! for 5 µm ≤ ΔR < 10 mm:
//!
//! ```text
//! K = (0.965 ΔR + 0.0965) L E*/ΔR,  n = Y ΔR^(−0.005)
//! Y = 1.51 (ln(1000 ΔR))^(−0.151) below ΔR = 0.34954, 0.0151 ΔR + 1.151 from there
//! ```
//!
//! Sources: K. L. Johnson, *Contact Mechanics*, Cambridge 1985, §5.6; E. I. Radzimovsky, *Stress distribution and strength
//! condition of two rolling cylinders pressed together*, Univ. Illinois Eng. Exp. Sta. Bull. 408, 1953; S. Dubowsky,
//! F. Freudenstein, *Dynamic analysis of mechanical systems with clearances*, J. Eng. Ind. 93, 1971; C. Pereira,
//! A. Ramalho, J. Ambrósio, *A critical overview of internal and external cylinder contact force models*, Nonlinear Dyn. 63,
//! 2011 (which compares them), and *An enhanced cylindrical contact force model*, Multibody Syst. Dyn. 35, 2015. The formulas
//! are as these comparisons and the program DyS (L. Skrinjar) print them; for Dubowsky and Freudenstein, whose h has
//! been printed with and without 1/π, the one with it is taken: without, the contact would be π times as soft as the others.

use std::f64::consts::{E, PI};

/// x at the end of the range is e^END.
const END: f64 = -2.0;
/// More steps than Newton's method can need: it doubles the digits.
const ITERATIONS: usize = 20;

/// δ = (F/κ) ln(Λ/F).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Logarithmic {
    /// κ [N/m], above 0.
    pub modulus: f64,
    /// Λ \[N\], above 0.
    pub(crate) scale: f64,
}

/// Journal and bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// R_b \[m\].
    pub bearing_radius: f64,
    /// ΔR \[m\], above 0 and below R_b.
    pub clearance: f64,
    /// L \[m\].
    pub length: f64,
    /// h_b + h_j [1/Pa].
    pub flexibility: f64,
}

impl Pair {
    /// κ [N/m].
    fn modulus(&self) -> f64 {
        PI * self.length / self.flexibility
    }

    /// Johnson's law.
    pub fn johnson(&self) -> Logarithmic {
        let modulus = self.modulus();
        Logarithmic {
            modulus,
            scale: 4.0 * modulus * self.clearance / E,
        }
    }

    /// Radzimovsky's law.
    pub fn radzimovsky(&self) -> Logarithmic {
        let modulus = self.modulus();
        // 16/1.6² = 6.25
        Logarithmic {
            modulus,
            scale: 6.25 / PI * (2.0_f64 / 3.0).exp() * modulus * self.clearance,
        }
    }

    /// Dubowsky's and Freudenstein's law.
    pub fn dubowsky_freudenstein(&self) -> Logarithmic {
        let modulus = self.modulus();
        let radii = self.bearing_radius * (self.bearing_radius - self.clearance);
        Logarithmic {
            modulus,
            scale: E * modulus * self.clearance * self.length * self.length / radii,
        }
    }

    /// K [N/mⁿ] and n of Pereira, Ramalho and Ambrósio; none outside the clearances it was fitted for.
    pub(crate) fn pereira(&self) -> Option<(f64, f64)> {
        let millimetres = 1e3 * self.clearance;
        let y = match millimetres {
            0.005..0.34954 => 1.51 * (1e3 * millimetres).ln().powf(-0.151),
            0.34954..10.0 => 0.0151 * millimetres + 1.151,
            _ => return None,
        };
        let exponent = y * millimetres.powf(-0.005);
        // L [mm] · E* [N/mm²] = 1e-3 L E* in SI
        let per_millimetre =
            (0.965 * millimetres + 0.0965) / millimetres * 1e-3 * self.length / self.flexibility;
        Some((per_millimetre * 1e3_f64.powf(exponent), exponent))
    }
}

impl Logarithmic {
    /// Penetration at the end of the published formula's use \[m\].
    pub(crate) fn range(&self) -> f64 {
        -END * END.exp() * self.scale / self.modulus
    }

    /// F and dF/dδ at δ > 0.
    pub(crate) fn force(&self, penetration: f64) -> (f64, f64) {
        let beyond = penetration - self.range();
        if beyond >= 0.0 {
            return (END.exp() * self.scale + self.modulus * beyond, self.modulus);
        }
        let u = self.logarithm(penetration);
        (u.exp() * self.scale, self.modulus / (-u - 1.0))
    }

    /// ∫₀^δ F dδ \[J\] at δ > 0.
    pub(crate) fn energy(&self, penetration: f64) -> f64 {
        let beyond = (penetration - self.range()).max(0.0);
        let u = if beyond > 0.0 {
            END
        } else {
            self.logarithm(penetration)
        };
        let force = u.exp() * self.scale;
        let within = force * force / self.modulus * (-2.0 * u - 1.0) / 4.0;
        within + beyond * (force + 0.5 * self.modulus * beyond)
    }

    /// u = ln x of −u eᵘ = y, below END.
    fn logarithm(&self, penetration: f64) -> f64 {
        // each by itself, so that a tiny δ does not underflow
        let y = penetration.ln() + self.modulus.ln() - self.scale.ln();
        let mut u = y.min(END);
        for _ in 0..ITERATIONS {
            let step = (y - u - (-u).ln()) / (1.0 + 1.0 / u);
            let before = u;
            u = (u + step).min(END);
            if (u - before).abs() <= 2.0 * f64::EPSILON * u.abs() {
                break;
            }
        }
        u
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steel, 10 mm against 9.5 mm, 20 mm long.
    const PAIR: Pair = Pair {
        bearing_radius: 0.01,
        clearance: 0.0005,
        length: 0.02,
        flexibility: 2.0 * 0.91 / 207e9,
    };

    type Penetration = Box<dyn Fn(f64) -> f64>;

    /// δ(F) as printed.
    fn printed(pair: &Pair) -> [(Logarithmic, Penetration); 3] {
        let Pair {
            bearing_radius: bearing,
            clearance,
            length,
            flexibility,
        } = *pair;
        let (modulus, journal) = (1.0 / flexibility, bearing - clearance);
        let johnson = move |force: f64| {
            let f = force / length;
            f / (PI * modulus) * ((4.0 * PI * modulus * clearance / f).ln() - 1.0)
        };
        let radzimovsky = move |force: f64| {
            let f = force / length;
            let b = 1.6 * (f * bearing * journal / (clearance * modulus)).sqrt();
            f / (PI * modulus) * (2.0 / 3.0 + (4.0 * bearing / b).ln() + (4.0 * journal / b).ln())
        };
        let dubowsky = move |force: f64| {
            let h = flexibility / PI;
            force * h / length
                * ((length.powi(3) * clearance / (force * bearing * journal * h)).ln() + 1.0)
        };
        [
            (pair.johnson(), Box::new(johnson)),
            (pair.radzimovsky(), Box::new(radzimovsky)),
            (pair.dubowsky_freudenstein(), Box::new(dubowsky)),
        ]
    }

    #[test]
    fn the_force_inverts_the_printed_penetration() {
        for (law, penetration) in printed(&PAIR) {
            for x in [1e-200, 1e-12, 1e-6, 1e-3, 0.05, 0.1353] {
                let force = x * law.scale;
                let found = law.force(penetration(force)).0;
                assert!(
                    (found / force - 1.0).abs() < 1e-13,
                    "{law:?} {x}: {found:e} {force:e}"
                );
            }
        }
    }

    #[test]
    fn it_goes_on_straight_at_the_end_of_its_range() {
        for (law, _) in printed(&PAIR) {
            let end = law.range();
            let (before, after) = (
                law.force(end * (1.0 - 1e-12)),
                law.force(end * (1.0 + 1e-12)),
            );
            assert!(
                (before.0 / after.0 - 1.0).abs() < 1e-11,
                "{before:?} {after:?}"
            );
            assert!(
                (before.1 / after.1 - 1.0).abs() < 1e-10,
                "{before:?} {after:?}"
            );
            let (near, far) = (law.force(2.0 * end), law.force(3.0 * end));
            assert!((far.0 - near.0 - law.modulus * end).abs() < 1e-12 * far.0);
        }
        assert!((PAIR.johnson().range() / PAIR.clearance - 8.0 * (-3.0_f64).exp()).abs() < 1e-15);
    }

    #[test]
    fn no_penetration_is_too_small() {
        let law = PAIR.johnson();
        let mut last = (0.0, 0.0);
        for exponent in (-307..-3).step_by(4) {
            let (force, slope) = law.force(10_f64.powi(exponent));
            assert!(
                force > last.0 && slope > last.1 && slope.is_finite(),
                "1e{exponent}: {force:e} {slope:e}"
            );
            last = (force, slope);
        }
        assert!(!law.force(5e-324).0.is_nan());
    }

    /// No numbers of its authors were at hand; a slip in its millimetres would be a factor of hundreds.
    #[test]
    fn the_fit_of_pereira_is_near_johnsons_law() {
        for clearance in [20e-6, 100e-6, 500e-6, 2e-3] {
            let pair = Pair { clearance, ..PAIR };
            let (stiffness, exponent) = pair.pereira().expect("in its range");
            for force in [1e3, 1e4, 3e4] {
                let penetration = printed(&pair)[0].1(force);
                let ratio = stiffness * penetration.powf(exponent) / force;
                assert!((0.8..1.25).contains(&ratio), "{clearance} {force}: {ratio}");
            }
        }
        for clearance in [4.9e-6, 10e-3] {
            assert_eq!(Pair { clearance, ..PAIR }.pereira(), None);
        }
    }
}
