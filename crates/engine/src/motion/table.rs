//! Tables beside the natural spline: straight lines, cubics that do not overshoot, and the periodic spline.
//!
//! Between two points, of distance h and slope δ between them, the cubic with the slopes d₀ and d₁ at its ends is
//! f₀ + h(d₀ x + (3δ − 2d₀ − d₁) x² + (d₀ + d₁ − 2δ) x³), x = (t − t₀)/h.
//!
//! Monotone slopes are the weighted harmonic mean of the slopes beside, none where these differ in sign (Fritsch and Butland 1984,
//! of the class of Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980); at the ends those of the parabola through three points,
//! limited likewise. Those of the periodic spline solve h₁ d₋ + 2(h₀ + h₁) d + h₀ d₊ = 3(h₁ δ₀ + h₀ δ₁), round and round (de Boor, A
//! Practical Guide to Splines, 2001, ch. IV).

use super::pieces::{Cycle, LawPiece, Pieces, TERMS};

impl Pieces {
    /// Straight lines through points with increasing times, and on beyond them.
    pub fn linear(points: &[[f64; 2]]) -> Self {
        let slopes = secants(points);
        let ends = slopes.iter().map(|&slope| [slope; 2]).collect();
        Pieces::through(points, ends, false)
    }

    /// Cubics through points with increasing times that turn where the points do, straight beyond the ends.
    pub fn monotone(points: &[[f64; 2]]) -> Self {
        let slopes = monotone_slopes(points);
        Pieces::sloped(points, &slopes)
    }

    /// Cubics through points with increasing times that have these slopes there, straight beyond the ends.
    pub fn sloped(points: &[[f64; 2]], slopes: &[f64]) -> Self {
        let ends = slopes.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        Pieces::through(points, ends, false)
    }

    /// The periodic spline through points with increasing times, the last of them the first of the next period.
    pub fn periodic(points: &[[f64; 2]]) -> Self {
        let slopes = periodic_slopes(points);
        let next = |k: usize| slopes[(k + 1) % slopes.len()];
        let ends = (0..slopes.len()).map(|k| [slopes[k], next(k)]).collect();
        let last = points.len() - 1;
        Pieces::through(points, ends, true).repeating(Cycle {
            advance: points[last][1] - points[0][1],
            numbers: [f64::NEG_INFINITY, f64::INFINITY],
        })
    }

    /// Cubics with these slopes at both ends of each.
    fn through(points: &[[f64; 2]], slopes: Vec<[f64; 2]>, is_smooth: bool) -> Self {
        let piece = |(pair, ends): (&[[f64; 2]], &[f64; 2])| {
            let [[from, value], [to, next]] = [pair[0], pair[1]];
            let h = to - from;
            let (delta, [d0, d1]) = ((next - value) / h, *ends);
            let mut terms = [0.0; TERMS];
            terms[..4].copy_from_slice(&[
                value,
                h * d0,
                h * (3.0 * delta - 2.0 * d0 - d1),
                h * (d0 + d1 - 2.0 * delta),
            ]);
            LawPiece {
                from,
                origin: from,
                span: h,
                terms,
                wave: [0.0; 3],
                is_smooth,
            }
        };
        let pieces = points.windows(2).zip(&slopes).map(piece).collect();
        let (first, last) = (points[0], points[points.len() - 1]);
        let outward = [slopes[0][0], slopes[slopes.len() - 1][1]];
        Pieces::new(
            pieces,
            last[0],
            [first[1], outward[0]],
            [last[1], outward[1]],
        )
    }
}

/// The slopes at all points of the cubics that turn where these do.
pub(super) fn monotone_slopes(points: &[[f64; 2]]) -> Vec<f64> {
    let delta = secants(points);
    let h = |k: usize| points[k + 1][0] - points[k][0];
    let last = delta.len();
    let slope = |k: usize| match k {
        _ if last == 1 => delta[0],
        0 => end_slope([h(0), h(1)], [delta[0], delta[1]]),
        k if k == last => end_slope([h(k - 1), h(k - 2)], [delta[k - 1], delta[k - 2]]),
        k if delta[k - 1] * delta[k] <= 0.0 => 0.0,
        k => {
            let (before, after) = (h(k - 1), h(k));
            let (first, second) = (2.0 * after + before, after + 2.0 * before);
            (first + second) / (first / delta[k - 1] + second / delta[k])
        }
    };
    (0..=last).map(slope).collect()
}

/// Slopes between points.
fn secants(points: &[[f64; 2]]) -> Vec<f64> {
    let pairs = points.windows(2);
    pairs
        .map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]))
        .collect()
}

/// The slope at an end, of the two intervals beside it.
fn end_slope([h0, h1]: [f64; 2], [d0, d1]: [f64; 2]) -> f64 {
    let slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if slope * d0 <= 0.0 {
        0.0
    } else if d0 * d1 <= 0.0 && slope.abs() > 3.0 * d0.abs() {
        3.0 * d0
    } else {
        slope
    }
}

/// The slopes of the periodic spline at all points but the last, which has that of the first.
pub(super) fn periodic_slopes(points: &[[f64; 2]]) -> Vec<f64> {
    let delta = secants(points);
    let n = delta.len();
    let h: Vec<f64> = points
        .windows(2)
        .map(|pair| pair[1][0] - pair[0][0])
        .collect();
    let before = |k: usize| (k + n - 1) % n;
    let right = |k: usize| 3.0 * (h[k] * delta[before(k)] + h[before(k)] * delta[k]);
    match n {
        1 => return delta,
        2 => {
            let [r0, r1] = [0, 1].map(|k| right(k) / (h[0] + h[1]));
            return vec![(2.0 * r0 - r1) / 3.0, (2.0 * r1 - r0) / 3.0];
        }
        _ => {}
    }
    // The corners of the matrix are taken out as a product of two vectors (Sherman and Morrison), and put back afterwards.
    let (first, last) = (h[0], h[before(n - 1)]);
    let corner = -2.0 * (h[n - 1] + h[0]);
    let mut diagonal: Vec<f64> = (0..n).map(|k| 2.0 * (h[before(k)] + h[k])).collect();
    diagonal[0] -= corner;
    diagonal[n - 1] -= first * last / corner;
    let mut solved: Vec<[f64; 2]> = (0..n).map(|k| [right(k), 0.0]).collect();
    solved[0][1] = corner;
    solved[n - 1][1] = last;
    for k in 1..n {
        let factor = h[k] / diagonal[k - 1];
        diagonal[k] -= factor * h[before(k - 1)];
        let above = solved[k - 1];
        for (value, above) in solved[k].iter_mut().zip(above) {
            *value -= factor * above;
        }
    }
    for k in (0..n).rev() {
        let below = solved.get(k + 1).copied().unwrap_or_default();
        for (value, below) in solved[k].iter_mut().zip(below) {
            *value = (*value - h[before(k)] * below) / diagonal[k];
        }
    }
    let along = |column: usize| solved[0][column] + first / corner * solved[n - 1][column];
    let part = along(0) / (1.0 + along(1));
    solved
        .iter()
        .map(|[own, other]| own - part * other)
        .collect()
}
