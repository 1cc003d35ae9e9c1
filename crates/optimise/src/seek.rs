//! Goal seek: one variable, one equation.
//!
//! ```text
//! no bracket   secant through the two best points, longer each time that it falls short, at most twice as far as what is known
//! bracket      inverse quadratic through three points where that is safe, else halving (Chandrupatla 1997)
//! ```
//!
//! A point without a value bounds the search: the next lies half way back. Source: Chandrupatla, A new hybrid quadratic/bisection
//! algorithm for finding the zero of a nonlinear function without using derivatives, Adv. Eng. Software 28, 1997.

/// What the equation gives at a value of the variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Side {
    /// Left minus right side.
    Value(f64),
    /// None there.
    Missing,
    /// Whoever asked wants no more.
    Stopped,
}

/// Where to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seek {
    /// First value.
    pub start: f64,
    /// The first step.
    pub step: f64,
    /// Where the variable may be.
    pub range: [f64; 2],
    /// A difference of the sides below this is as good as none.
    pub enough: f64,
    /// Evaluations at most.
    pub most: usize,
}

/// How it ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sought {
    /// Both sides agree.
    Reached,
    /// The difference changes its sign without passing zero.
    Jump,
    /// The difference has one sign wherever it was tried.
    NotBracketed,
    /// Evaluations are used up.
    Evaluations,
    /// No value anywhere.
    NoValues,
    /// Whoever asked wants no more.
    Stopped,
}

/// A point with its difference.
type Point = (f64, f64);

struct Search<'f> {
    f: &'f mut dyn FnMut(f64) -> Side,
    best: Option<Point>,
    left: usize,
    enough: f64,
}

/// What ends the search early.
type Early = Sought;

impl Search<'_> {
    fn at(&mut self, x: f64) -> Result<Option<f64>, Early> {
        if self.left == 0 {
            return Err(Sought::Evaluations);
        }
        self.left -= 1;
        match (self.f)(x) {
            Side::Stopped => Err(Sought::Stopped),
            Side::Value(value) if value.is_finite() => {
                if self.best.is_none_or(|(_, best)| value.abs() < best.abs()) {
                    self.best = Some((x, value));
                }
                match value.abs() <= self.enough {
                    true => Err(Sought::Reached),
                    false => Ok(Some(value)),
                }
            }
            Side::Value(_) | Side::Missing => Ok(None),
        }
    }
}

/// Searches; the value of the variable with the least difference, and that, where there is one.
pub fn seek(f: &mut dyn FnMut(f64) -> Side, settings: &Seek) -> (Sought, Option<Point>) {
    let mut search = Search {
        f,
        best: None,
        left: settings.most,
        enough: settings.enough,
    };
    let ended = match bracket(&mut search, settings) {
        Ok([a, b]) => narrow(&mut search, a, b).unwrap_or_else(|early| early),
        Err(early) => early,
    };
    let ended = match ended {
        Sought::Evaluations | Sought::NotBracketed if search.best.is_none() => Sought::NoValues,
        ended => ended,
    };
    (ended, search.best)
}

/// Two points between which the difference changes its sign.
fn bracket(search: &mut Search, settings: &Seek) -> Result<[Point; 2], Early> {
    let [mut lower, mut upper] = settings.range;
    let mut known: Vec<Point> = Vec::new();
    let mut next = settings.start.clamp(lower, upper);
    let mut stretch = 1.0;
    loop {
        match search.at(next)? {
            Some(value) => {
                let place = known.partition_point(|(x, _)| *x < next);
                known.insert(place, (next, value));
                let pair = known
                    .windows(2)
                    .find(|pair| (pair[0].1 < 0.0) != (pair[1].1 < 0.0));
                if let Some(pair) = pair {
                    return Ok([pair[0], pair[1]]);
                }
            }
            // Nothing is beyond it, as seen from what is known.
            None if known.is_empty() => {
                next = scan(settings, settings.most - search.left);
                continue;
            }
            None if next < known[0].0 => lower = next,
            None if next > known[known.len() - 1].0 => upper = next,
            None => return Err(Sought::NotBracketed),
        }
        next =
            propose(&known, [lower, upper], settings, &mut stretch).ok_or(Sought::NotBracketed)?;
    }
}

/// Points of the whole range, one after the other: halves, quarters, eighths.
fn scan(settings: &Seek, number: usize) -> f64 {
    let bits = usize::BITS - number.leading_zeros();
    let part = (0..bits).map(|bit| ((number >> bit) & 1) as f64 * 0.5_f64.powi(bit as i32 + 1));
    let [lower, upper] = settings.range;
    lower + (upper - lower) * part.sum::<f64>()
}

/// The next point outside of what is known; `None` if that is all there is.
fn propose(
    known: &[Point],
    [lower, upper]: [f64; 2],
    settings: &Seek,
    stretch: &mut f64,
) -> Option<f64> {
    let (first, last) = (known[0], known[known.len() - 1]);
    let span = (last.0 - first.0).max(settings.step.abs());
    // Room that is left on both sides; a point without value at its end is not tried again.
    let open = |end: f64, whole: f64, from: f64| {
        let room = (end - from).abs();
        match end == whole {
            true => room,
            false => 0.5 * room,
        }
    };
    let below = open(lower, settings.range[0], first.0);
    let above = open(upper, settings.range[1], last.0);
    let least = 4.0 * f64::EPSILON * first.0.abs().max(last.0.abs()).max(span);
    // Downhill where the secant through the ends leads, else to and fro.
    let falls_up = last.1.abs() < first.1.abs();
    let wanted = match known {
        [_] => settings.step.abs(),
        _ => {
            let (near, far) = if falls_up {
                (last, known[known.len() - 2])
            } else {
                (first, known[1])
            };
            let secant = (near.1 * (near.0 - far.0) / (near.1 - far.1)).abs();
            match secant.is_finite() && near.1.abs() < far.1.abs() {
                // A secant that fell short was too steep: the next goes further.
                true => {
                    let further = *stretch * secant;
                    *stretch *= 2.0;
                    further
                }
                false => 2.0 * span,
            }
        }
    };
    let reach = wanted.min(2.0 * span);
    let upwards = match known {
        [_] => settings.step >= 0.0,
        _ => falls_up,
    };
    let up = (above > least).then(|| (last.0 + reach.min(above)).min(upper));
    let down = (below > least).then(|| (first.0 - reach.min(below)).max(lower));
    if upwards { up.or(down) } else { down.or(up) }
}

/// Chandrupatla's method between two points.
fn narrow(search: &mut Search, mut a: Point, mut b: Point) -> Result<Sought, Early> {
    let width = (b.0 - a.0).abs();
    // The point before, on the side of a.
    let mut c;
    let mut part = secant_part(a, b);
    loop {
        let x = a.0 + part * (b.0 - a.0);
        let Some(value) = search.at(x)? else {
            return Err(Sought::Jump);
        };
        let here = (x, value);
        if (value < 0.0) == (a.1 < 0.0) {
            c = a;
        } else {
            c = b;
            b = a;
        }
        a = here;
        let best = if a.1.abs() < b.1.abs() { a } else { b };
        let least = 2.0 * f64::EPSILON * best.0.abs() + f64::MIN_POSITIVE;
        let length = (b.0 - a.0).abs();
        if length <= 2.0 * least {
            // Round-off is as steep as what was known of the function; a jump is steeper by far.
            let steep = (b.1 - a.1).abs() > 1e3 * search.enough && length < 1e-9 * width;
            return Ok(if steep { Sought::Jump } else { Sought::Reached });
        }
        part = quadratic_part(a, b, c).clamp(least / length, 1.0 - least / length);
    }
}

fn secant_part(a: Point, b: Point) -> f64 {
    (a.1 / (a.1 - b.1)).clamp(1e-6, 1.0 - 1e-6)
}

/// Where between a and b the inverse quadratic through three points is zero; the middle where that is not sure.
fn quadratic_part(a: Point, b: Point, c: Point) -> f64 {
    let xi = (a.0 - b.0) / (c.0 - b.0);
    let phi = (a.1 - b.1) / (c.1 - b.1);
    match phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi {
        true => {
            a.1 / (b.1 - a.1) * c.1 / (b.1 - c.1)
                + (c.0 - a.0) / (b.0 - a.0) * a.1 / (c.1 - a.1) * b.1 / (c.1 - b.1)
        }
        false => 0.5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: f64 = 1e300;

    fn run(
        f: impl Fn(f64) -> Option<f64>,
        start: f64,
        range: [f64; 2],
    ) -> (Sought, Option<Point>, usize) {
        let mut count = 0;
        let mut counted = |x: f64| {
            count += 1;
            assert!(range[0] <= x && x <= range[1], "{x} is not in {range:?}");
            f(x).map_or(Side::Missing, Side::Value)
        };
        let settings = Seek {
            start,
            step: 0.05 * start.abs().max(0.1),
            range,
            enough: 1e-13,
            most: 60,
        };
        let (ended, best) = seek(&mut counted, &settings);
        (ended, best, count)
    }

    #[test]
    fn a_straight_line_takes_three_evaluations() {
        let (ended, best, count) = run(|r| Some(2.0 * r - 0.08), 0.05, [0.0005, 5.0]);
        assert_eq!(ended, Sought::Reached);
        assert!(
            (best.unwrap().0 - 0.04).abs() < 1e-14 && count == 3,
            "{best:?} after {count}"
        );
    }

    /// Roots of functions with known ones, near and far from the start, with and without ranges.
    #[test]
    fn known_roots_are_found_in_few_evaluations() {
        type Case = (fn(f64) -> f64, f64, [f64; 2], f64);
        let cases: [Case; 7] = [
            (|x| x.cos() - x, 0.3, [-ALL, ALL], 0.739_085_133_215_160_6),
            (
                |x| x.exp() - 2.0,
                20.0,
                [-50.0, 50.0],
                std::f64::consts::LN_2,
            ),
            (
                |x| x.powi(3) - 2.0 * x - 5.0,
                1.0,
                [-ALL, ALL],
                2.094_551_481_542_326_5,
            ),
            (|x| x.ln() - 3.0, 1.0, [0.01, 100.0], 20.085_536_923_187_668),
            (|x| x.powi(9) - 1.0, 0.2, [0.0, 10.0], 1.0),
            (|x| (x * x + 3.0).sqrt() - 2.0, 9.0, [0.0, 100.0], 1.0),
            (|x| 1.0 / x - 50.0, 1.0, [0.001, 1.0], 0.02),
        ];
        for (number, (f, start, range, root)) in cases.into_iter().enumerate() {
            let (ended, best, count) = run(|x| Some(f(x)), start, range);
            let (x, _) = best.unwrap();
            assert_eq!(ended, Sought::Reached, "case {number}: {best:?}");
            assert!(
                (x / root - 1.0).abs() < 1e-12,
                "case {number}: {x} after {count}"
            );
            assert!(count <= 30, "case {number}: {count} evaluations");
        }
    }

    #[test]
    fn what_has_no_root_says_so_with_the_nearest() {
        let (ended, best, _) = run(|x| Some(x * x + 1.0), 1.0, [-2.0, 2.0]);
        assert_eq!(ended, Sought::NotBracketed);
        assert!(best.unwrap().1 <= 2.0, "{best:?}");
        let (ended, _, _) = run(|x| Some(if x < 0.3 { -1.0 } else { 2.0 }), 0.1, [0.0, 1.0]);
        assert_eq!(ended, Sought::Jump);
        let (ended, best, _) = run(|_| None, 0.1, [0.0, 1.0]);
        assert_eq!((ended, best), (Sought::NoValues, None));
    }

    /// The root lies just before the end of what has values.
    #[test]
    fn points_without_values_lead_back() {
        let f = |x: f64| (x <= 1.0).then(|| 0.1 - (1.0 - x).sqrt());
        let (ended, best, count) = run(f, 0.2, [0.0, 10.0]);
        assert_eq!(ended, Sought::Reached, "{best:?}");
        assert!(
            (best.unwrap().0 - 0.99).abs() < 1e-13,
            "{best:?} after {count}"
        );
        // Values begin somewhere in the range.
        let f = |x: f64| (x > 0.7).then_some(x - 0.8);
        let (ended, best, _) = run(f, 0.1, [0.0, 1.0]);
        assert_eq!(ended, Sought::Reached, "{best:?}");
    }
}
