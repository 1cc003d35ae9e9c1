//! Values → polylines: interrupted at gaps, clipped to the panel, without places that look the same.

use super::scale::Scale;
use super::scene::Place;

/// Neighbouring places nearer than this are one \[pt\]; 0.01 mm.
const SAME: f64 = 0.03;
/// Width of the columns that a very dense curve is thinned to, lowest and highest kept \[pt\].
const COLUMN: f64 = 0.1;

/// A curve on the page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trace {
    pub lines: Vec<Vec<Place>>,
    /// Values with a gap on both sides: no line shows them.
    pub dots: Vec<Place>,
}

/// The curve through the values, inside the rectangle of the scales.
pub fn trace(x: &[f64], y: &[f64], x_scale: &Scale, y_scale: &Scale) -> Trace {
    let bounds = [
        ordered(x_scale.start, x_scale.end),
        ordered(y_scale.start, y_scale.end),
    ];
    let mut trace = Trace::default();
    let mut run: Vec<Place> = Vec::new();
    for (&x, &y) in x.iter().zip(y) {
        match x_scale.place(x).zip(y_scale.place(y)) {
            Some((x, y)) => run.push([x, y]),
            None => trace.end_run(&mut run, bounds),
        }
    }
    trace.end_run(&mut run, bounds);
    trace
}

fn ordered(a: f64, b: f64) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

impl Trace {
    /// Takes a run of places without gaps.
    fn end_run(&mut self, run: &mut Vec<Place>, bounds: [[f64; 2]; 2]) {
        let places = std::mem::take(run);
        if let [place] = places[..] {
            let inside =
                (0..2).all(|axis| (bounds[axis][0]..=bounds[axis][1]).contains(&place[axis]));
            self.dots.extend(inside.then_some(place));
            return;
        }
        clip(&thin(places), bounds, &mut self.lines);
    }

    /// Places for markers, about `spacing` apart along x \[pt\], the first one `offset` behind the start.
    pub fn markers(&self, spacing: f64, offset: f64) -> Vec<Place> {
        let mut places = Vec::new();
        for line in &self.lines {
            let Some(first) = line.first() else { continue };
            let mut travelled = -offset;
            let mut last = *first;
            for &place in line {
                travelled += (place[0] - last[0])
                    .abs()
                    .max(0.25 * (place[1] - last[1]).abs());
                last = place;
                if travelled >= 0.0 {
                    places.push(place);
                    travelled = -spacing;
                }
            }
        }
        places
    }
}

/// Fewer places that look the same.
fn thin(places: Vec<Place>) -> Vec<Place> {
    let rises = places.windows(2).all(|pair| pair[1][0] >= pair[0][0]);
    let width = places
        .last()
        .zip(places.first())
        .map_or(0.0, |(last, first)| last[0] - first[0]);
    if rises && places.len() as f64 > 4.0 * (width / COLUMN).max(1.0) + 4.0 {
        return columns(&places);
    }
    let mut thinned: Vec<Place> = Vec::with_capacity(places.len());
    for (index, &place) in places.iter().enumerate() {
        let is_last = index + 1 == places.len();
        let is_far = |last: &Place| (place[0] - last[0]).hypot(place[1] - last[1]) >= SAME;
        if is_last || thinned.last().is_none_or(is_far) {
            thinned.push(place);
        }
    }
    thinned
}

/// First, lowest, highest and last place of each column.
fn columns(places: &[Place]) -> Vec<Place> {
    let column = |place: &Place| (place[0] / COLUMN).floor();
    let mut thinned = Vec::new();
    for group in places.chunk_by(|a, b| column(a) == column(b)) {
        let by_height = |a: &&Place, b: &&Place| a[1].total_cmp(&b[1]);
        let mut kept: Vec<Place> = [
            group.first(),
            group.iter().min_by(by_height),
            group.iter().max_by(by_height),
            group.last(),
        ]
        .into_iter()
        .flatten()
        .copied()
        .collect();
        kept.sort_by(|a, b| a[0].total_cmp(&b[0]));
        kept.dedup();
        thinned.extend(kept);
    }
    thinned
}

/// The parts of a polyline inside the bounds (Liang and Barsky 1984, a segment at a time).
fn clip(places: &[Place], bounds: [[f64; 2]; 2], lines: &mut Vec<Vec<Place>>) {
    let mut line: Vec<Place> = Vec::new();
    for pair in places.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let Some([enter, leave]) = inside(from, to, bounds) else {
            lines.extend((line.len() > 1).then(|| std::mem::take(&mut line)));
            line.clear();
            continue;
        };
        let at = |part: f64| -> Place {
            std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))
        };
        if line.is_empty() || enter > 0.0 {
            lines.extend((line.len() > 1).then(|| std::mem::take(&mut line)));
            line = vec![if enter > 0.0 { at(enter) } else { from }];
        }
        line.push(if leave < 1.0 { at(leave) } else { to });
        if leave < 1.0 {
            lines.push(std::mem::take(&mut line));
        }
    }
    lines.extend((line.len() > 1).then_some(line));
}

/// Where a segment enters and leaves, as parts of its way.
fn inside(from: Place, to: Place, bounds: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let [low, high] = bounds[axis];
        let way = to[axis] - from[axis];
        if way == 0.0 {
            if !(low..=high).contains(&from[axis]) {
                return None;
            }
            continue;
        }
        let [a, b] = ordered((low - from[axis]) / way, (high - from[axis]) / way);
        enter = enter.max(a);
        leave = leave.min(b);
    }
    (enter <= leave).then_some([enter, leave])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(low: f64, high: f64, start: f64, end: f64) -> Scale {
        Scale {
            low,
            high,
            log: false,
            start,
            end,
        }
    }

    fn traced(x: &[f64], y: &[f64]) -> Trace {
        trace(
            x,
            y,
            &scale(0.0, 10.0, 0.0, 100.0),
            &scale(0.0, 1.0, 50.0, 0.0),
        )
    }

    #[test]
    fn gaps_interrupt_and_single_values_are_dots() {
        let nan = f64::NAN;
        let found = traced(
            &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
            &[0.0, 1.0, nan, 0.5, nan, 0.2, 0.4],
        );
        assert_eq!(
            found.lines,
            [[[0.0, 50.0], [10.0, 0.0]], [[50.0, 40.0], [60.0, 30.0]]]
        );
        assert_eq!(found.dots, [[30.0, 25.0]]);
    }

    #[test]
    fn lines_end_at_the_frame() {
        let found = traced(&[0.0, 2.0, 4.0, 6.0], &[0.0, 2.0, 2.0, 0.0]);
        assert_eq!(
            found.lines,
            [[[0.0, 50.0], [10.0, 0.0]], [[50.0, 0.0], [60.0, 50.0]]]
        );
        // Through the whole panel, from one side to the other.
        let found = traced(&[4.0, 6.0], &[1e300, -1e300]);
        let all: Vec<&Place> = found.lines.iter().flatten().collect();
        assert!(
            all.iter()
                .all(|place| (0.0..=50.0).contains(&place[1]) && (40.0..=60.0).contains(&place[0])),
            "{all:?}"
        );
    }

    #[test]
    fn a_million_values_are_few_places_with_the_same_extremes() {
        let n = 1_000_000;
        let x: Vec<f64> = (0..n).map(|i| 10.0 * f64::from(i) / f64::from(n)).collect();
        let y: Vec<f64> = x.iter().map(|x| 0.5 + 0.5 * (1e4 * x).sin()).collect();
        let found = traced(&x, &y);
        let heights = || found.lines.iter().flatten().map(|place| place[1]);
        assert!(heights().count() < 5000, "{}", heights().count());
        assert!(
            heights().fold(50.0, f64::min) < 1e-3 && heights().fold(0.0, f64::max) > 50.0 - 1e-3
        );
    }
}
