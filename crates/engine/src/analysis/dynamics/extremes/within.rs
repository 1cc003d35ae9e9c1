//! The largest value of a smooth function within a step, from its values at a few points.
//!
//! ```text
//! s_k = (1 − cos(π k/6))/2,  k = 0 … 6              points of the step, from its beginning (0) to its end (1)
//! p(s) = Σ w_k/(s − s_k) f_k / Σ w_k/(s − s_k)      w = ½, −1, 1, −1, 1, −1, ½
//! ```
//!
//! J.-P. Berrut, L. N. Trefethen, *Barycentric Lagrange Interpolation*, SIAM Review 46, 2004.

use std::f64::consts::PI;

/// Points of a step, both ends included.
pub const POINTS: usize = 7;
/// Intervals, beside the largest value, in which a larger one is looked for.
const INTERVALS: usize = 8;
/// Parabolas that follow it up, and how much narrower each is.
const PARABOLAS: usize = 3;
const NARROWER: f64 = 0.03;

/// The points.
pub fn points() -> [f64; POINTS] {
    std::array::from_fn(|k| 0.5 * (1.0 - (PI * k as f64 / (POINTS - 1) as f64).cos()))
}

/// p(s) through the values at the points.
fn value(values: &[f64; POINTS], points: &[f64; POINTS], s: f64) -> f64 {
    let (mut above, mut below) = (0.0, 0.0);
    for (k, (&f, &at)) in values.iter().zip(points).enumerate() {
        if s == at {
            return f;
        }
        let end = if k == 0 || k + 1 == POINTS { 0.5 } else { 1.0 };
        let weight = if k % 2 == 0 { end } else { -end } / (s - at);
        above += weight * f;
        below += weight;
    }
    above / below
}

/// Where p is largest on [0, 1], and how large: beside the point where it is largest of all, for it bends little from one point to
/// the next.
pub fn top(values: &[f64; POINTS]) -> (f64, f64) {
    let points = points();
    let at = |s: f64| value(values, &points, s);
    let largest = (0..POINTS).fold(0, |best, k| if values[k] > values[best] { k } else { best });
    let (from, to) = (
        points[largest.saturating_sub(1)],
        points[(largest + 1).min(POINTS - 1)],
    );
    let mut width = (to - from) / INTERVALS as f64;
    let mut best = (points[largest], values[largest]);
    for k in 0..=INTERVALS {
        let s = from + k as f64 * width;
        let here = at(s);
        if here > best.1 {
            best = (s, here);
        }
    }
    for _ in 0..PARABOLAS {
        let s = vertex(
            [at(best.0 - width), best.1, at(best.0 + width)],
            best.0,
            width,
        )
        .clamp(0.0, 1.0);
        let there = at(s);
        if there > best.1 {
            best = (s, there);
        }
        width *= NARROWER;
    }
    best
}

/// Where the parabola through values at `middle` − `width`, `middle` and `middle` + `width` is largest, no farther than that
/// from its middle.
pub fn vertex([before, here, after]: [f64; 3], middle: f64, width: f64) -> f64 {
    let bend = before - 2.0 * here + after;
    let shift = if bend < 0.0 {
        (0.5 * (before - after) / bend).clamp(-1.0, 1.0)
    } else {
        0.0
    };
    middle + width * shift
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(f: impl Fn(f64) -> f64) -> (f64, f64) {
        top(&points().map(f))
    }

    #[test]
    fn the_top_of_a_polynomial_is_met() {
        let (s, value) = of(|s| 3.0 - (s - 0.3).powi(2) * (1.0 + s));
        assert!(
            (s - 0.3).abs() < 1e-7 && (value - 3.0).abs() < 1e-14,
            "{s} {value}"
        );
    }

    #[test]
    fn the_top_of_a_wave_is_met() {
        // A step of half a radian, as those of an impact are: only the place has to be good, the value is evaluated there.
        for phase in [0.05, 0.2, 0.3, 0.45] {
            let (s, value) = of(|s| (0.5 * s - phase).cos());
            assert!(
                (s - phase / 0.5).abs() < 1e-6 && (value - 1.0).abs() < 1e-10,
                "{s} {value}"
            );
        }
    }

    #[test]
    fn what_only_rises_is_largest_at_its_end() {
        assert_eq!(of(|s| s), (1.0, 1.0));
        assert_eq!(of(|s| 2.0 - s).0, 0.0);
    }
}
