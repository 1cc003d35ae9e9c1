//! Where a difference between two rows becomes zero, found by asking for more of its points.
//!
//! False position, the older end counting half each time it stays (Illinois; Dowell and Jarratt 1971), and bisection after
//! questions that did not close the bracket.

/// The difference is zero below this part of its change from row to row.
const ZERO: f64 = 1e-13;
/// Questions, at most.
const MOST: usize = 100;
/// Questions after which the bracket must be half of what it was.
const PATIENCE: usize = 4;
/// Smallest bracket, in parts of its place.
const CLOSED: f64 = 4.0 * f64::EPSILON;

/// What is known at a place: the place, the difference there, and a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// The place.
    pub at: f64,
    /// The difference, zero at the crossing.
    pub above: f64,
    /// The value that is wanted at the crossing.
    pub value: f64,
}

/// The value where the difference is zero, between two places where it has different signs; `None` if `ask` gives none.
pub fn value(
    [mut low, mut high]: [Known; 2],
    mut ask: impl FnMut(f64) -> Option<Known>,
) -> Option<f64> {
    let change = (high.above - low.above).abs();
    // What the false position takes the ends for.
    let mut weights = [low.above, high.above];
    let (mut before, mut asked, mut stayed) = (high.at - low.at, 0, None);
    for _ in 0..MOST {
        let width = high.at - low.at;
        if width <= CLOSED * high.at.abs() {
            break;
        }
        let is_slow = asked >= PATIENCE && width > 0.5 * before;
        if asked >= PATIENCE && !is_slow {
            (before, asked) = (width, 0);
        }
        asked += 1;
        let x = match is_slow {
            true => low.at + 0.5 * width,
            false => low.at + width * (weights[0] / (weights[0] - weights[1])),
        };
        let here = ask(x.clamp(low.at, high.at))?;
        if here.above.abs() <= ZERO * change {
            return Some(here.value);
        }
        let is_low = (here.above < 0.0) == (low.above < 0.0);
        // the weight of an end that stays again
        let less = if stayed == Some(is_low) { 0.5 } else { 1.0 };
        stayed = Some(is_low);
        if is_low {
            low = here;
            weights = [here.above, less * weights[1]];
        } else {
            high = here;
            weights = [less * weights[0], here.above];
        }
    }
    let part = low.above / (low.above - high.above);
    Some(low.value + part * (high.value - low.value))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(at: f64, difference: &dyn Fn(f64) -> f64) -> Known {
        Known {
            at,
            above: difference(at),
            value: at,
        }
    }

    #[test]
    fn crossings_are_met() {
        let met = |low: f64, high: f64, expected: f64, most: usize, f: &dyn Fn(f64) -> f64| {
            let mut asked = 0;
            let found = value([known(low, f), known(high, f)], |x| {
                asked += 1;
                Some(known(x, f))
            });
            let found = found.expect("asked");
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
            assert!(asked <= most, "{asked} questions");
        };
        met(0.0, 1.0, 0.3, 1, &|x| x - 0.3);
        met(0.0, 1.0, 0.3_f64.sqrt(), 8, &|x| x * x - 0.3);
        met(0.2, 0.4, (0.3_f64).acos() - 1.0, 6, &|x| {
            (x + 1.0).cos() - 0.3
        });
        met(1.0, 2.0, 1.5, MOST, &|x| if x > 1.5 { 1.0 } else { -1e-9 });
    }

    #[test]
    fn what_is_not_there_is_none() {
        let ends = [known(0.0, &|_| -1.0), known(1.0, &|_| 1.0)];
        assert_eq!(value(ends, |_| None), None);
    }
}
