//! Locates where a continuous function becomes positive.

/// Width, as a part of the first bracket, at which the root is located.
const NARROW: f64 = 1e-10;
const MOST: usize = 200;

/// The end, where f > 0, of a narrow bracket around a root in (low, high]; f(low) ≤ 0 < f(high).
///
/// False position, with points a little to both sides of it so that the bracket closes from both, and bisection where that
/// is slow.
///
/// # Errors
/// Those of f.
pub fn locate<E>(
    (mut low, mut at_low): (f64, f64),
    (mut high, mut at_high): (f64, f64),
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let narrow = NARROW * (high - low);
    for round in 0..MOST {
        let width = high - low;
        if width <= narrow || width <= 4.0 * f64::EPSILON * high.abs() {
            break;
        }
        let x = if round % 3 == 2 || at_high <= at_low {
            0.5 * (low + high)
        } else {
            let estimate = low - at_low * width / (at_high - at_low);
            // Towards the end that is farther from the estimate, which comes near so.
            let aside = (0.02 * width).max(0.5 * narrow);
            let shifted = if estimate - low > high - estimate {
                estimate - aside
            } else {
                estimate + aside
            };
            shifted.clamp(low + 0.01 * width, high - 0.01 * width)
        };
        let at_x = f(x)?;
        if at_x > 0.0 {
            (high, at_high) = (x, at_x);
        } else {
            (low, at_low) = (x, at_x);
        }
    }
    Ok(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(low: f64, high: f64, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut calls = 0;
        let found = locate((low, f(low)), (high, f(high)), |x| -> Result<f64, ()> {
            calls += 1;
            Ok(f(x))
        });
        (found.expect("no errors"), calls)
    }

    #[test]
    fn roots_are_met_from_beyond() {
        let met = |low: f64, high: f64, expected: f64, f: &dyn Fn(f64) -> f64| {
            let (found, calls) = root(low, high, f);
            assert!(
                found >= expected && found - expected <= 1.01e-10 * (high - low),
                "{found} for {expected}"
            );
            assert!(f(found) > 0.0 && calls <= 100, "{calls} calls");
        };
        met(0.0, 1.0, 0.3_f64.sqrt(), &|x| x * x - 0.3);
        met(0.0, 1.0, 1e-3, &|x| (x / 1e-3).ln().max(-50.0));
        met(5.0, 6.0, 5.5, &|x| if x > 5.5 { 1.0 } else { -1e-9 });
    }
}
