//! Derivatives: those that a function knows, and differences for all others.
//!
//! ```text
//! inside       (f(x + h) − f(x − h)) / 2h              error h² f‴/6 + ε f/h
//! at an end    (4 f(x + h) − 3 f(x) − f(x + 2h)) / 2h  h towards the inside
//! h = ∛ε L     L = max(|x|, range/100), at most the range: the length over which f changes
//! ```
//!
//! With h = ∛ε L both errors are about ε^⅔ f: ten digits where f is exact to round-off (Gill, Murray, Wright, Practical Optimization,
//! 1981, §8.6). Where a point has no value the other side is taken, then a shorter step.

use crate::outcome::{Bounds, Function, Outcome};

/// Part of the range below which a variable's own size says nothing of the function.
const LEAST_LENGTH: f64 = 1e-2;
/// How often a step is shortened where there is no value.
const SHORTER: usize = 2;
/// By what.
const SHORTENED: f64 = 1e-2;

/// Why there are no derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Underived {
    /// There are no values around.
    NoValues,
    /// Whoever asked wants no more.
    Stopped,
}

/// The Jacobian, a row for each value, by rows.
///
/// # Errors
/// [`Underived`].
pub fn jacobian(
    f: &mut Function,
    bounds: &Bounds,
    x: &[f64],
    values: &[f64],
) -> Result<Vec<f64>, Underived> {
    let (rows, columns) = (values.len(), x.len());
    let known = f.slopes(x).filter(|known| known.len() == rows * columns);
    let mut jacobian = known.unwrap_or_else(|| vec![f64::NAN; rows * columns]);
    for k in 0..columns {
        let mut own = jacobian.iter().skip(k).step_by(columns);
        if own.all(|entry| entry.is_finite()) {
            continue;
        }
        let column = column(f, bounds, x, values, k)?;
        for (row, entry) in column.into_iter().enumerate() {
            let slot = &mut jacobian[row * columns + k];
            if !slot.is_finite() {
                *slot = entry;
            }
        }
    }
    Ok(jacobian)
}

/// The derivatives by variable k.
fn column(
    f: &mut Function,
    bounds: &Bounds,
    x: &[f64],
    values: &[f64],
    k: usize,
) -> Result<Vec<f64>, Underived> {
    let [lower, upper] = bounds.of(k);
    let width = bounds.width(k);
    let length = x[k].abs().max(LEAST_LENGTH * width).min(width);
    let mut step = f64::EPSILON.cbrt() * length;
    let mut at = |to: f64| -> Result<Option<(f64, Vec<f64>)>, Underived> {
        if to < lower || to > upper {
            return Ok(None);
        }
        let mut moved = x.to_vec();
        moved[k] = to;
        match f.values(&moved) {
            // The step that was made, not the one that was meant.
            Outcome::Values(found) => Ok(Some((to - x[k], found))),
            Outcome::Missing => Ok(None),
            Outcome::Stopped => Err(Underived::Stopped),
        }
    };
    for _ in 0..=SHORTER {
        let (up, down) = (at(x[k] + step)?, at(x[k] - step)?);
        if let (Some((up, above)), Some((down, below))) = (&up, &down) {
            let slopes = above.iter().zip(below);
            return Ok(slopes
                .map(|(above, below)| (above - below) / (up - down))
                .collect());
        }
        let one = up.or(down);
        if let Some((near, first)) = one {
            let second = at(x[k] + 2.0 * near)?;
            return Ok(one_sided(values, near, &first, second));
        }
        step *= SHORTENED;
    }
    Err(Underived::NoValues)
}

/// From one or two points on the same side.
fn one_sided(
    values: &[f64],
    near: f64,
    first: &[f64],
    second: Option<(f64, Vec<f64>)>,
) -> Vec<f64> {
    let plain = |j: usize| (first[j] - values[j]) / near;
    let Some((far, second)) = second else {
        return (0..values.len()).map(plain).collect();
    };
    let slope = |j: usize| {
        let other = (second[j] - values[j]) / far;
        // Two secants, carried on to a step of zero.
        plain(j) + (plain(j) - other) * near / (far - near)
    };
    (0..values.len()).map(slope).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn powers(x: &[f64]) -> Outcome {
        if x[0] > 2.0 {
            return Outcome::Missing;
        }
        Outcome::of(vec![x[0].powi(3), x[0].exp() * x[1]])
    }

    #[test]
    fn derivatives_have_ten_digits_inside_and_seven_at_ends() {
        let bounds = Bounds::new(&[[1.0, 4.0], [-1.0, 1.0]]);
        for (x, error) in [([1.5, 0.5], 1e-9), ([1.0, 1.0], 1e-8), ([2.0, -1.0], 1e-8)] {
            let values = powers(&x).values().expect("values");
            let found = jacobian(&mut powers, &bounds, &x, &values).expect("derivatives");
            let exact = [3.0 * x[0] * x[0], 0.0, x[0].exp() * x[1], x[0].exp()];
            for (found, exact) in found.iter().zip(exact) {
                assert!(
                    (found - exact).abs() < error * 12.0,
                    "{x:?}: {found} is not {exact}"
                );
            }
        }
    }

    /// Knows the first derivative of its first value, and counts how often it is asked.
    struct Half(usize);

    impl crate::outcome::Evaluate for Half {
        fn values(&mut self, x: &[f64]) -> Outcome {
            self.0 += 1;
            Outcome::of(vec![x[0] * x[1], x[0] + x[1]])
        }

        fn slopes(&mut self, _x: &[f64]) -> Option<Vec<f64>> {
            Some(vec![7.0, f64::NAN, 1.0, 1.0])
        }
    }

    #[test]
    fn what_is_known_is_taken_and_the_rest_are_differences() {
        let bounds = Bounds::new(&[[0.0, 4.0], [0.0, 4.0]]);
        let mut half = Half(0);
        let found = jacobian(&mut half, &bounds, &[2.0, 3.0], &[6.0, 5.0]).expect("derivatives");
        assert_eq!([found[0], found[2], found[3]], [7.0, 1.0, 1.0]);
        assert!((found[1] - 2.0).abs() < 1e-9, "{found:?}");
        // only the second variable takes differences
        assert_eq!(half.0, 2);
    }

    #[test]
    fn there_is_no_derivative_where_there_are_no_values_around() {
        let bounds = Bounds::new(&[[0.0, 1.0]]);
        let mut alone = |x: &[f64]| match x[0] == 0.5 {
            true => Outcome::Values(vec![1.0]),
            false => Outcome::Missing,
        };
        let found = jacobian(&mut alone, &bounds, &[0.5], &[1.0]);
        assert_eq!(found, Err(Underived::NoValues));
    }
}
