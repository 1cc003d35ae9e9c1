//! Locates where a continuous function becomes positive.

const MOST: usize = 200;

/// What is known of the function at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuardPoint {
    pub time: f64,
    pub value: f64,
}

/// Two times with a root between them: f(low) ≤ 0 < f(high).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    pub low: GuardPoint,
    pub high: GuardPoint,
}

impl Bracket {
    /// How far its ends are apart.
    pub fn width(&self) -> f64 {
        self.high.time - self.low.time
    }

    /// The part from the low end at which the function vanishes, if it is straight.
    fn secant(&self) -> f64 {
        match (self.low.value, self.high.value) {
            (low, high) if low < high => -low / (high - low),
            _ => 0.5,
        }
    }
}

/// A bracket of at most this width within another.
///
/// By inverse quadratic interpolation where three points promise that it is safe, and bisection elsewhere (Chandrupatla 1997).
/// A point is never nearer to the end it starts from than half the width that is wanted, so that the bracket closes from both
/// sides.
///
/// # Errors
/// Those of f.
pub fn locate<E>(
    mut bracket: Bracket,
    narrow: f64,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Bracket, E> {
    let mut part = bracket.secant();
    // The last point, which is an end, the other end, and the point that one of them has replaced.
    let (mut last, mut other) = (bracket.low, bracket.high);
    for _ in 0..MOST {
        let width = bracket.width();
        if width <= narrow || width <= 4.0 * f64::EPSILON * bracket.high.time.abs() {
            break;
        }
        let least = (0.5 * narrow / width).min(0.5);
        let time = last.time + part.clamp(least, 1.0 - least) * (other.time - last.time);
        let here = GuardPoint {
            time,
            value: f(time)?,
        };
        let replaced = if (here.value > 0.0) == (last.value > 0.0) {
            last
        } else {
            std::mem::replace(&mut other, last)
        };
        last = here;
        match here.value > 0.0 {
            true => bracket.high = here,
            false => bracket.low = here,
        }
        part = interpolated([last, other, replaced]).unwrap_or(0.5);
    }
    Ok(bracket)
}

/// The part of the way from the first to the second point at which the inverse quadratic through all three has its root, where
/// it is monotone between them.
fn interpolated([one, two, three]: [GuardPoint; 3]) -> Option<f64> {
    let place = (one.time - two.time) / (three.time - two.time);
    let height = (one.value - two.value) / (three.value - two.value);
    let is_monotone = height * height < place && (1.0 - height) * (1.0 - height) < 1.0 - place;
    is_monotone.then(|| {
        let (first, second) = (
            one.value / (two.value - one.value) * three.value / (two.value - three.value),
            one.value / (three.value - one.value) * two.value / (three.value - two.value),
        );
        first + (three.time - one.time) / (two.time - one.time) * second
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(low: f64, high: f64, narrow: f64, f: &dyn Fn(f64) -> f64) -> (Bracket, usize) {
        let mut calls = 0;
        let [low, high] = [low, high].map(|time| GuardPoint {
            time,
            value: f(time),
        });
        let found = locate(Bracket { low, high }, narrow, |x| -> Result<f64, ()> {
            calls += 1;
            Ok(f(x))
        });
        (found.expect("no errors"), calls)
    }

    #[test]
    fn roots_are_met_from_beyond() {
        let met = |low: f64, high: f64, expected: f64, most: usize, f: &dyn Fn(f64) -> f64| {
            for narrow in [1e-4, 1e-10] {
                let narrow = narrow * (high - low);
                let (found, calls) = root(low, high, narrow, f);
                assert!(f(found.low.time) <= 0.0 && f(found.high.time) > 0.0);
                assert!(found.low.time <= expected && expected <= found.high.time);
                assert!(found.width() <= narrow, "{found:?} for {expected}");
                assert!(calls <= most, "{calls} calls");
            }
        };
        met(0.0, 1.0, 0.3_f64.sqrt(), 7, &|x| x * x - 0.3);
        met(0.0, 2.0, 1.5_f64.ln(), 9, &|x| x.exp() - 1.5);
        met(0.0, 1.0, 0.9, 6, &|x| x - 0.9);
        met(0.0, 1.0, 1e-3, 20, &|x| (x / 1e-3).ln().max(-50.0));
        met(5.0, 6.0, 5.5, 36, &|x| if x > 5.5 { 1.0 } else { -1e-9 });
        // a journal that comes to rest as it arrives
        met(0.0, 1.0, 0.6, 60, &|x| (x - 0.6_f64).powi(3));
    }
}
