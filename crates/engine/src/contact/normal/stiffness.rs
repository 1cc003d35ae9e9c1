//! Stiffness from materials and radii.
//!
//! ```text
//! h = (1 − ν²)/E                                      of each material                [1/Pa]
//! 1/E* = h_b + h_j                                    contact modulus E*              [Pa]
//! K = 4/(3(h_b + h_j)) · √(R_b R_j/(R_b − R_j))       sphere R_j in a cup R_b         [N/m^1.5]
//! ```
//!
//! The law of spheres is what the literature on clearance joints uses for journals, too, with the radii of the pin and its
//! hole; it knows no length of the bearing. It holds where the patch of contact is small against the radii.
//!
//! Source: H. Hertz 1881; W. Goldsmith, *Impact: the theory and physical behaviour of colliding solids*, Arnold 1960.

/// h = (1 − ν²)/E [1/Pa].
pub fn flexibility(young_modulus: f64, poisson_ratio: f64) -> f64 {
    (1.0 - poisson_ratio * poisson_ratio) / young_modulus
}

/// K of a sphere in a cup [N/m^1.5], from h_b + h_j [1/Pa] and the radii R_b > R_j > 0 \[m\].
pub fn sphere_in_cup(flexibility: f64, bearing_radius: f64, journal_radius: f64) -> f64 {
    let curvature = bearing_radius * journal_radius / (bearing_radius - journal_radius);
    4.0 / (3.0 * flexibility) * curvature.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand for steel, E = 207 GPa, ν = 0.3, R_b = 10 mm, R_j = 9.5 mm:
    /// h = 0.91/207e9 = 4.396135e-12, R_b R_j/ΔR = 0.19 m, √ = 0.4358899, K = 4/(6h)·0.4358899 = 6.610198e10.
    #[test]
    fn a_steel_pin_in_a_steel_hole() {
        let h = flexibility(207e9, 0.3);
        let stiffness = sphere_in_cup(2.0 * h, 0.01, 0.0095);
        assert!(
            (stiffness / 6.610198e10 - 1.0).abs() < 1e-6,
            "{stiffness:e}"
        );
    }
}
