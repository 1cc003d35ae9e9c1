//! The top of a curve between rows, found by asking for more of its points.
//!
//! A polynomial through the nearest points known says where the top is, and how high. The curve is asked there. Where it has
//! the height that was said, the place is right as well: of an error ε in the height of a smooth curve, only ε² is lost at
//! a top. Else the point joins the others. Where no polynomial fits, as at a kink, golden sections close in. What has grown by
//! much more than any top between rows may when they have closed in has no top: a pole.

/// Points of a polynomial.
const NEAREST: usize = 6;
/// A polynomial is right whose height at its top is, to this part of the drop to the ends of the bracket, or to round-off.
const RIGHT: f64 = 1e-7;
const RIGHT_ANYWAY: f64 = 1e-14;
/// The curve's drop to the neighbours is round-off below this part of its values.
const ROUND_OFF: f64 = 1e-13;
/// A top is as good as the row beside it, by the polynomial, within this part of the drop.
const NO_HIGHER: f64 = 1e-12;
/// Points nearer than this, in parts of the bracket, are the same for a polynomial.
const SAME_PLACE: f64 = 1e-3;
/// Questions, at most; a kink needs about as many until the bracket is round-off.
const MOST: usize = 70;
/// Smallest bracket, in parts of the first.
const CLOSED: f64 = 1e-13;
/// Larger part of the golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Questions after which a smooth curve would have been met.
const SMOOTH: usize = 3;
/// Newton's steps to the top of a polynomial.
const STEPS: usize = 6;
/// Questions after which the bracket must have become this much smaller, or golden sections take over.
const PATIENCE: usize = 4;
const HALF: f64 = 0.5;
/// A rise of more than this many drops, on which sections close in, is a pole: a parabola rises by an eighth, a kink by a half.
const POLE: f64 = 2.0;
/// One in so many questions, at least, has a higher answer than all before where a pole is.
const RISING: usize = 4;

/// A point of a curve: place and height.
pub type CurvePoint = [f64; 2];

/// What is known around a top: points nearest to it first.
#[derive(Debug, Clone, Copy)]
struct KnownAround {
    points: [CurvePoint; NEAREST],
    count: usize,
}

impl KnownAround {
    /// Adds a point, in place of the farthest where there is no more room.
    fn add(&mut self, point: CurvePoint) {
        let far = |known: &CurvePoint| (known[0] - point[0]).abs();
        if self.count < NEAREST {
            self.points[self.count] = point;
            self.count += 1;
            return;
        }
        let farthest = (0..NEAREST).max_by(|&a, &b| {
            let [a, b] = [a, b].map(|k| far(&self.points[k]));
            a.total_cmp(&b)
        });
        if let Some(farthest) = farthest {
            self.points[farthest] = point;
        }
    }

    /// Newton's form: the divided differences.
    fn differences(&self) -> [f64; NEAREST] {
        let mut table = [0.0; NEAREST];
        for (entry, point) in table.iter_mut().zip(&self.points[..self.count]) {
            *entry = point[1];
        }
        for order in 1..self.count {
            for k in (order..self.count).rev() {
                let width = self.points[k][0] - self.points[k - order][0];
                table[k] = (table[k] - table[k - 1]) / width;
            }
        }
        table
    }

    /// Value, slope and bend of the polynomial.
    fn at(&self, table: &[f64; NEAREST], x: f64) -> [f64; 3] {
        let [mut value, mut slope, mut bend] = [0.0; 3];
        for k in (0..self.count).rev() {
            let width = x - self.points[k][0];
            bend = bend * width + 2.0 * slope;
            slope = slope * width + value;
            value = value * width + table[k];
        }
        [value, slope, bend]
    }

    /// Place and height of the polynomial's top between two places, from a place near it.
    fn top(&self, from: f64, [low, high]: [f64; 2]) -> Option<CurvePoint> {
        let table = self.differences();
        let mut x = from;
        for _ in 0..STEPS {
            let [_, slope, bend] = self.at(&table, x);
            if bend.is_nan() || bend >= 0.0 {
                return None;
            }
            let next = (x - slope / bend).clamp(low, high);
            let is_there = (next - x).abs() <= 1e-9 * (high - low);
            x = next;
            if is_there {
                break;
            }
        }
        let [height, slope, bend] = self.at(&table, x);
        let is_top = bend < 0.0 && (slope / bend).abs() <= SAME_PLACE * (high - low);
        is_top.then_some([x, height])
    }
}

/// A place between two others that is known to be the highest so far.
#[derive(Debug, Clone, Copy)]
struct TopBracket {
    low: CurvePoint,
    best: CurvePoint,
    high: CurvePoint,
}

impl TopBracket {
    fn width(&self) -> f64 {
        self.high[0] - self.low[0]
    }

    /// Takes a point between.
    fn take(&mut self, point: CurvePoint) {
        let [x, height] = point;
        let is_left = x < self.best[0];
        match (height > self.best[1], is_left) {
            (true, true) => (self.high, self.best) = (self.best, point),
            (true, false) => (self.low, self.best) = (self.best, point),
            (false, true) => self.low = point,
            (false, false) => self.high = point,
        }
    }

    /// The golden section of its larger part.
    fn section(&self) -> f64 {
        let (left, right) = (self.best[0] - self.low[0], self.high[0] - self.best[0]);
        match left > right {
            true => self.best[0] - (1.0 - GOLDEN) * left,
            false => self.best[0] + (1.0 - GOLDEN) * right,
        }
    }

    /// A place at some distance from the best, on the wider side.
    fn beside(&self, near: f64) -> f64 {
        let (left, right) = (self.best[0] - self.low[0], self.high[0] - self.best[0]);
        match right > left {
            true => self.best[0] + near.max(0.1 * right),
            false => self.best[0] - near.max(0.1 * left),
        }
    }

    /// How much higher the best is than the ends, the nearer one that is not the best itself.
    fn drop(&self) -> f64 {
        let ends = [self.low, self.high].into_iter();
        let others = ends.filter(|end| end[0] != self.best[0]);
        others.fold(f64::INFINITY, |least, end| least.min(self.best[1] - end[1]))
    }
}

/// How much higher the curve may be near a row than there, at most; `None` if it can't be: the row is lower than its neighbours.
pub fn promise(rows: &[CurvePoint], index: usize) -> Option<f64> {
    let drop = drop(rows, index)?;
    // A parabola has an eighth at most, a kink a half.
    (drop >= 0.0).then_some(0.5 * drop)
}

/// How much lower the neighbours are: the larger drop, negative where one of them is higher.
fn drop(rows: &[CurvePoint], index: usize) -> Option<f64> {
    let height = rows[index][1];
    let left = index.checked_sub(1).map(|left| height - rows[left][1]);
    let right = rows.get(index + 1).map(|right| height - right[1]);
    match (left, right) {
        (Some(left), Some(right)) if left < 0.0 || right < 0.0 => Some(left.min(right)),
        (Some(left), Some(right)) => Some(left.max(right)),
        (one, other) => one.or(other),
    }
}

/// Looks for the top near a row that is no lower than its neighbours. `curve` gives the height at a place, and keeps what it gave.
///
/// # Errors
/// Where the curve grows without end.
pub fn find(
    rows: &[CurvePoint],
    index: usize,
    mut curve: impl FnMut(f64) -> Option<f64>,
) -> Result<(), f64> {
    let Some(drop) = drop(rows, index).filter(|drop| *drop > 0.0) else {
        return Ok(());
    };
    if drop <= ROUND_OFF * rows[index][1].abs() {
        return Ok(());
    }
    let mut known = nearest(rows, index);
    let last = rows.len() - 1;
    let mut bracket = TopBracket {
        low: rows[index.saturating_sub(1)],
        best: rows[index],
        high: rows[(index + 1).min(last)],
    };
    let is_end = index == 0 || index == last;
    let width = bracket.width();
    let (mut before, mut asked) = (width, 0);
    let [mut questions, mut higher] = [0, 0];
    for round in 0..MOST {
        let best = bracket.best[0];
        let told = known.top(best, [bracket.low[0], bracket.high[0]]);
        if is_end && round == 0 {
            // Outside there is no row: where the polynomial does not rise from the end, the end is the top.
            let rises = told.is_some_and(|[_, height]| height - rows[index][1] > NO_HIGHER * drop);
            if !rises {
                return Ok(());
            }
        }
        asked += 1;
        let is_slow = asked > PATIENCE && bracket.width() > HALF * before;
        let told = told.filter(|_| !is_slow);
        if asked > PATIENCE {
            (before, asked) = (bracket.width(), 0);
        }
        let near = SAME_PLACE * bracket.width();
        let x = match told {
            // Where the best is where the polynomial has its top, a place beside it shows whether that is right.
            Some([x, _]) if (x - best).abs() <= near => bracket.beside(near),
            Some([x, _]) => x,
            None => bracket.section(),
        };
        let Some(height) = curve(x) else { break };
        let error = told.map(|_| known.at(&known.differences(), x)[0] - height);
        // Later the curve is a kink as likely, beside whose tip a polynomial may be right by chance.
        let scale = if round < SMOOTH { drop } else { bracket.drop() };
        let right = (RIGHT * scale).max(RIGHT_ANYWAY * drop);
        if error.is_some_and(|error| error.abs() <= right) {
            let higher =
                told.filter(|told| told[0] != x && told[1] - bracket.best[1] > NO_HIGHER * drop);
            let _ = higher.and_then(|[top, _]| curve(top));
            return Ok(());
        }
        known.add([x, height]);
        questions += 1;
        higher += usize::from(height > bracket.best[1]);
        bracket.take([x, height]);
        if bracket.width() <= CLOSED * width {
            break;
        }
    }
    // Towards a pole every other section is higher than all before, of round-off few are.
    let is_pole = bracket.best[1] - rows[index][1] > POLE * drop && RISING * higher >= questions;
    match is_pole {
        true => Err(bracket.best[0]),
        false => Ok(()),
    }
}

/// The rows nearest to one.
fn nearest(rows: &[CurvePoint], index: usize) -> KnownAround {
    let count = rows.len().min(NEAREST);
    let first = index.saturating_sub(NEAREST / 2).min(rows.len() - count);
    let mut known = KnownAround {
        points: [[0.0; 2]; NEAREST],
        count: 0,
    };
    rows[first..first + count]
        .iter()
        .for_each(|row| known.add(*row));
    known
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(curve: &dyn Fn(f64) -> f64, from: f64, to: f64, count: usize) -> Vec<CurvePoint> {
        let place = |k: usize| from + (to - from) * k as f64 / (count - 1) as f64;
        (0..count).map(|k| [place(k), curve(place(k))]).collect()
    }

    /// The largest height found, and how often the curve was asked.
    fn largest(curve: &dyn Fn(f64) -> f64, rows: &[CurvePoint]) -> (f64, usize) {
        let best = (0..rows.len()).max_by(|&a, &b| rows[a][1].total_cmp(&rows[b][1]));
        let index = best.expect("rows");
        let (mut most, mut asked) = (rows[index][1], 0);
        find(rows, index, |x| {
            asked += 1;
            most = most.max(curve(x));
            Some(curve(x))
        })
        .expect("a top");
        (most, asked)
    }

    #[test]
    fn smooth_tops_take_few_questions() {
        for shift in [0.0, 0.01, 0.1, 0.3, 0.77] {
            let curve = |t: f64| (t - shift).cos() + 0.3 * (2.0 * (t - shift)).cos();
            let (found, asked) = largest(&curve, &rows(&curve, -3.0, 3.0, 36));
            assert!((found - 1.3).abs() < 1e-13, "{shift}: {found}");
            assert!(asked <= 4, "{shift}: {asked}");
        }
    }

    #[test]
    fn few_rows_and_kinks_do() {
        let curve = |t: f64| (t - 0.3).cos();
        let (found, _) = largest(&curve, &rows(&curve, -1.5, 1.5, 4));
        assert!((found - 1.0).abs() < 1e-12, "{found}");
        let kink = |t: f64| -(t - 0.123_4).abs();
        let (found, asked) = largest(&kink, &rows(&kink, -1.0, 1.0, 11));
        assert!(found.abs() < 1e-12, "{found}");
        assert!(asked <= MOST);
    }

    #[test]
    fn a_top_beside_the_first_row_is_found_and_a_falling_start_is_left() {
        let curve = |t: f64| (t - 0.04).cos();
        let (found, _) = largest(&curve, &rows(&curve, 0.0, 1.5, 16));
        assert!((found - 1.0).abs() < 1e-13, "{found}");
        let falling = |t: f64| (-t).exp();
        assert_eq!(largest(&falling, &rows(&falling, 0.0, 2.0, 16)), (1.0, 0));
        let constant = |_: f64| 2.0;
        assert_eq!(largest(&constant, &rows(&constant, 0.0, 1.0, 9)), (2.0, 0));
    }

    #[test]
    fn a_curve_that_is_not_there_leaves_the_rows() {
        let rows = rows(&f64::sin, 0.0, 3.0, 9);
        assert_eq!(find(&rows, 5, |_| None), Ok(()));
    }

    #[test]
    fn round_off_has_no_pole() {
        for seed in 1..200_u64 {
            let noise = |t: f64| {
                let bits = (t.to_bits() ^ seed.wrapping_mul(0x9e37_79b9_7f4a_7c15))
                    .wrapping_mul(0xbf58_476d_1ce4_e5b9);
                1e-16 * ((bits ^ (bits >> 29)) % 7) as f64
            };
            let rows = rows(&noise, 0.0, 1.0, 12);
            for index in 0..rows.len() {
                assert_eq!(
                    find(&rows, index, |t| Some(noise(t))),
                    Ok(()),
                    "{seed} {index}"
                );
            }
        }
    }

    #[test]
    fn poles_have_no_top_and_peaks_do() {
        let best = |rows: &[CurvePoint]| {
            let best = (0..rows.len()).max_by(|&a, &b| rows[a][1].total_cmp(&rows[b][1]));
            best.expect("rows")
        };
        let pole = 0.123_4;
        let odd = |t: f64| 1.0 / (t - pole);
        let even = |t: f64| (t - pole).powi(-2);
        let slow = |t: f64| -(t - pole).abs().ln();
        let curves: [&dyn Fn(f64) -> f64; 3] = [&odd, &even, &slow];
        for curve in curves {
            let rows = rows(curve, -1.0, 1.0, 11);
            let found = find(&rows, best(&rows), |t| Some(curve(t)));
            let at = found.expect_err("a pole");
            assert!((at - pole).abs() < 1e-9, "{at}");
            // nor where nothing is known near it
            let blind = |t: f64| ((t - pole).abs() > 1e-6).then(|| curve(t));
            assert!(find(&rows, best(&rows), blind).is_err());
        }
        for sharp in [1e1, 1e2, 1e3] {
            let peak = |t: f64| 1.0 / (1.0 + (sharp * (t - pole)).powi(2));
            let mut most = 0.0_f64;
            let rows = rows(&peak, -1.0, 1.0, 11);
            let found = find(&rows, best(&rows), |t| {
                most = most.max(peak(t));
                Some(peak(t))
            });
            assert_eq!(found, Ok(()), "{sharp}");
            assert!((most - 1.0).abs() < 1e-12, "{sharp}: {most}");
        }
    }
}
