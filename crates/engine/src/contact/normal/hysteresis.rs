//! The hysteresis factor χ of F = K δⁿ (1 + χ δ̇/δ̇₀), from the coefficient of restitution e.
//!
//! ```text
//! rule                    χ                                                        e
//! Hunt, Crossley          3(1 − e)/2                                               0 … 1
//! Herbert, McWhannell     6(1 − e)/((2e − 1)² + 3)                                 0 … 1
//! Lee, Wang               3(1 − e)/4                                               0 … 1
//! Lankarani, Nikravesh    3(1 − e²)/4                                              0 … 1
//! Zhiying, Qishao         3(1 − e²) exp(2(1 − e))/4                                0 … 1
//! Flores et al.           8(1 − e)/(5e)                                            above 0 … 1
//! Gonthier et al.         d/e,  (1 + d/e)/(1 − d) = exp(d(1 + 1/e))                above 0 … 1
//! Hu, Guo                 3(1 − e)/(2e)                                            above 0 … 1
//! ```
//!
//! Each is zero at e = 1; the last three have no bound at e = 0. None depends on K, n, or the masses: for a free impact of
//! one mass the motion gives χ(1 + e) = ln((1 + χ)/(1 − χe)) exactly, which is what Gonthier's rule solves; so it alone
//! returns the e that is requested, the others one that is near it for elastic contacts. `linkdyn validate restitution`
//! measures all of them.
//!
//! Sources: K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42, 1975; R. G. Herbert, D. C. McWhannell, J. Eng. Ind. 99, 1977;
//! T. W. Lee, A. C. Wang, J. Mech. Trans. Autom. Des. 105, 1983; H. M. Lankarani, P. E. Nikravesh, J. Mech. Des. 112, 1990;
//! Qin Zhiying, Lu Qishao, J. Dyn. Control 4, 2006; P. Flores, M. Machado, M. T. Silva, J. M. Martins, Multibody Syst. Dyn.
//! 25, 2011; Y. Gonthier, J. McPhee, C. Lange, J.-C. Piedbœuf, Multibody Syst. Dyn. 11, 2004; S. Hu, X. Guo, Multibody
//! Syst. Dyn. 35, 2015. Compared in M. Machado, P. Moreira, P. Flores, H. M. Lankarani, Mech. Mach. Theory 53, 2012.

/// Where χ comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// Hunt and Crossley 1975.
    HuntCrossley,
    /// Herbert and McWhannell 1977.
    HerbertMcwhannell,
    /// Lee and Wang 1983.
    LeeWang,
    /// Lankarani and Nikravesh 1990.
    LankaraniNikravesh,
    /// Flores and others 2011.
    Flores,
    /// Gonthier and others 2004.
    Gonthier,
    /// Zhiying and Qishao 2006.
    ZhiyingQishao,
    /// Hu and Guo 2015.
    HuGuo,
}

impl Rule {
    /// Every rule.
    #[cfg(test)]
    const ALL: [Rule; 8] = [
        Rule::HuntCrossley,
        Rule::HerbertMcwhannell,
        Rule::LeeWang,
        Rule::LankaraniNikravesh,
        Rule::Flores,
        Rule::Gonthier,
        Rule::ZhiyingQishao,
        Rule::HuGuo,
    ];

    /// Whether e = 0 has no finite χ.
    pub(crate) fn needs_rebound(self) -> bool {
        match self {
            Rule::Flores | Rule::Gonthier | Rule::HuGuo => true,
            Rule::HuntCrossley
            | Rule::HerbertMcwhannell
            | Rule::LeeWang
            | Rule::LankaraniNikravesh
            | Rule::ZhiyingQishao => false,
        }
    }

    /// χ [–] at e from 0 to 1; infinite at 0 for a rule that needs a rebound.
    pub fn factor(self, restitution: f64) -> f64 {
        let e = restitution;
        match self {
            Rule::HuntCrossley => 1.5 * (1.0 - e),
            Rule::HerbertMcwhannell => 6.0 * (1.0 - e) / ((2.0 * e - 1.0).powi(2) + 3.0),
            Rule::LeeWang => 0.75 * (1.0 - e),
            Rule::LankaraniNikravesh => 0.75 * (1.0 - e * e),
            Rule::Flores => 1.6 * (1.0 - e) / e,
            Rule::Gonthier => exact(e),
            Rule::ZhiyingQishao => 0.75 * (1.0 - e * e) * (2.0 * (1.0 - e)).exp(),
            Rule::HuGuo => 1.5 * (1.0 - e) / e,
        }
    }
}

/// The root χ = d/e of χ(1 + e) = ln((1 + χ)/(1 − χe)) besides 0.
///
/// With ψ(x) = (ln(1 + x) − x)/x² that is ψ(χ) = e² ψ(−χe), which has no root at 0 and whose difference rises with d from
/// −(1 − e²)/2 to infinity at d = 1.
fn exact(e: f64) -> f64 {
    if e <= 0.0 {
        return f64::INFINITY;
    }
    let (mut low, mut high) = (0.0, 1.0);
    loop {
        let d = 0.5 * (low + high);
        if d <= low || d >= high {
            return low / e;
        }
        if psi(d / e) < e * e * psi(-d) {
            low = d
        } else {
            high = d
        }
    }
}

/// (ln(1 + x) − x)/x², −1/2 at 0.
fn psi(x: f64) -> f64 {
    if x.abs() > 0.1 {
        return (x.ln_1p() - x) / (x * x);
    }
    // −1/2 + x/3 − x²/4 + …; what is left out is below 0.1¹⁸/20
    (2..20)
        .rev()
        .fold(0.0, |sum, k| -x * sum - 1.0 / f64::from(k))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_elastic_contact_loses_nothing() {
        for rule in Rule::ALL {
            assert_eq!(rule.factor(1.0), 0.0, "{rule:?}");
        }
    }

    #[test]
    fn at_zero_the_factor_is_infinite_where_said() {
        for rule in Rule::ALL {
            assert_eq!(
                rule.factor(0.0).is_infinite(),
                rule.needs_rebound(),
                "{rule:?}"
            );
            assert!(
                !rule.factor(0.0).is_nan() && rule.factor(1e-6) > 0.0,
                "{rule:?}"
            );
        }
    }

    /// By hand at e = 0.5: 0.75, 3/3 = 1, 0.375, 0.5625, 1.6, –, 0.5625·e, 1.5.
    #[test]
    fn factors_at_one_half() {
        let factors = [
            0.75,
            1.0,
            0.375,
            0.5625,
            1.6,
            1.4327505,
            0.5625 * std::f64::consts::E,
            1.5,
        ];
        for (rule, factor) in Rule::ALL.into_iter().zip(factors) {
            assert!(
                (rule.factor(0.5) - factor).abs() < 5e-8,
                "{rule:?} {}",
                rule.factor(0.5)
            );
        }
    }

    /// Roots computed with SciPy's `brentq`.
    #[test]
    fn the_exact_factor_solves_its_equation() {
        let roots = [
            (0.95, 0.0789266),
            (0.9, 0.1664820),
            (0.8, 0.3731462),
            (0.7, 0.6348283),
            (0.5, 1.4327505),
            (0.46, 1.6635059),
            (0.3, 3.0870820),
            (0.1, 9.9981594),
        ];
        for (e, chi) in roots {
            let found = Rule::Gonthier.factor(e);
            assert!((found - chi).abs() < 6e-8, "{e}: {found}");
            let misses = found * (1.0 + e) - ((1.0 + found) / (1.0 - found * e)).ln();
            // 1 − χe loses digits for small e
            assert!(
                misses.abs() < 4e-16 * found / (1.0 - found * e) + 1e-15,
                "{e}: {misses:e}"
            );
        }
        // From ψ's series, −(1 − e²)/2 + χ(1 + e³)/3 = 0 to first order: χ → 3(1 − e)/2.
        let e = 1.0 - 1e-7;
        assert!(
            (Rule::Gonthier.factor(e) / 1.5e-7 - 1.0).abs() < 1e-6,
            "{}",
            Rule::Gonthier.factor(e)
        );
        assert!((Rule::Gonthier.factor(1e-9) * 1e-9 - 1.0).abs() < 1e-12);
    }
}
