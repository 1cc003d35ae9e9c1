//! Derivatives of what can only be evaluated, each value with a step of its own.
//!
//! ```text
//! T(h, 0) = (f(h) − f(−h))/2h,   T(h, k) = T(h, k−1) + (T(h, k−1) − T(2h, k−1))/(4ᵏ − 1)
//! ```
//!
//! The entry is taken that differs least from its neighbours, with the round-off of f(±h) over h added to the difference (Ridders,
//! Accurate computation of F′(x) and F′(x)F″(x), Adv. Eng. Software 4 (1982) 75): long steps serve what is smooth, short ones what
//! is not, as springs much shorter than the mechanism.

/// The longest step, and how often it is halved.
const LONGEST: f64 = 1.0 / 16.0;
const HALVINGS: usize = 12;
/// Round-off of a value, in parts of its size.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// A derivative, and how far it may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Derivative {
    pub value: f64,
    pub error: f64,
}

/// Derivatives of `count` values by a number, which changes in steps of parts of `length`. `eval` puts the values there; false where
/// there are none, as beyond a singular position: shorter steps are tried then. `None` if there are none at all.
pub fn derivatives(
    count: usize,
    length: f64,
    mut eval: impl FnMut(f64, &mut Vec<f64>) -> bool,
) -> Option<Vec<Derivative>> {
    let none = Derivative {
        value: 0.0,
        error: f64::INFINITY,
    };
    let mut best = vec![none; count];
    let mut row: Vec<Vec<f64>> = Vec::new();
    let (mut ahead, mut behind) = (Vec::new(), Vec::new());
    for halving in 0..=HALVINGS {
        let h = length * LONGEST / f64::from(1 << halving);
        ahead.clear();
        behind.clear();
        if !eval(h, &mut ahead) || !eval(-h, &mut behind) {
            row.clear();
            continue;
        }
        let both = || ahead.iter().zip(&behind);
        let mut next = vec![both().map(|(a, b)| (a - b) / (2.0 * h)).collect::<Vec<_>>()];
        let noise: Vec<f64> = both()
            .map(|(a, b)| ROUND_OFF * a.abs().max(b.abs()) / h)
            .collect();
        let mut power = 1.0;
        for (k, coarse) in row.iter().enumerate() {
            power *= 4.0;
            let mut improved = vec![0.0; count];
            for i in 0..count {
                let fine = next[k][i];
                let value = fine + (fine - coarse[i]) / (power - 1.0);
                let error = (value - fine).abs().max((value - coarse[i]).abs()) + noise[i];
                if error < best[i].error {
                    best[i] = Derivative { value, error };
                }
                improved[i] = value;
            }
            next.push(improved);
        }
        row = next;
    }
    best.iter().all(|own| own.error.is_finite()).then_some(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_value_has_its_own_step() {
        let found = derivatives(4, 1.0, |h, to| {
            to.extend([
                (0.3 + h).sin(),
                (1000.0 * h).sin(),
                7.0 + 2.0 * h,
                (1.0 + h).powi(3) * 1e9,
            ]);
            true
        });
        let found = found.expect("there");
        for (own, exact) in found.iter().zip([0.3_f64.cos(), 1000.0, 2.0, 3e9]) {
            let off = (own.value - exact).abs();
            assert!(
                off <= own.error.max(f64::EPSILON * exact),
                "{own:?} {exact}"
            );
            assert!(off <= 1e-12 * exact.abs(), "{own:?} {exact}: {off:e}");
        }
    }

    #[test]
    fn steps_stay_where_there_are_values() {
        let sqrt = |h: f64, to: &mut Vec<f64>| {
            to.push((0.01 + h).sqrt());
            0.01 + h >= 0.0
        };
        let found = derivatives(1, 1.0, sqrt).expect("there");
        assert!((found[0].value - 5.0).abs() < 1e-10, "{found:?}");
        assert_eq!(derivatives(1, 1.0, |_, _| false), None);
    }
}
