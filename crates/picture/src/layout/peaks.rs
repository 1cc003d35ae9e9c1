//! Peaks that a panel cuts off: a mark where the curve leaves it, and the value above the panel.

use super::labels::legend_labels;
use super::measures::{EDGE, LINE};
use crate::chart::{Chart, Panel};
use crate::font;
use crate::scale::Scale;
use crate::scene::{Anchor, Ink, Pen, Place, Run, Scene};
use crate::style::style;
use crate::words::{minus, printable, unit};

/// Size of the texts, as a part of the font size.
pub const SIZE: f64 = 0.85;
/// Between neighbouring texts, and room for the mark before each, as parts of their size.
const BETWEEN: f64 = 1.2;
const SIGN: f64 = 1.0;
/// Half the width of a mark, and its height, as parts of the font size.
const MARK: [f64; 2] = [0.32, 0.55];
/// What lies beyond the end of an axis by less, as a part of its height, is seen at the end.
const SEEN: f64 = 0.01;
/// Longest name of a curve in a text, as a part of its size.
const LONGEST_NAME: f64 = 10.0;

/// The farthest value of a curve beyond one end of an axis.
#[derive(Debug, Clone)]
pub struct Peak {
    /// Where it is on the x axis.
    x: f64,
    /// Whether it lies above the panel.
    is_above: bool,
    /// How far it lies beyond the end, in heights of the axis.
    beyond: f64,
    /// Colour of its curve.
    ink: Ink,
    /// Its curve, where the panel has several.
    name: String,
    /// `628.6 N·m at 1.748 s`.
    value: String,
    /// What is written: both.
    text: String,
}

/// Peaks of a panel.
#[derive(Debug, Clone, Default)]
pub struct Peaks {
    /// All of them.
    all: Vec<Peak>,
    /// Those with a text, row by row from above.
    rows: Vec<Vec<Peak>>,
}

impl Peaks {
    /// Peaks of a panel with these ranges, and texts of the farthest, in so many rows at most.
    pub fn of(chart: &Chart, panel: &Panel, ranges: [[f64; 2]; 2], most_rows: usize) -> Peaks {
        let labels = legend_labels(chart);
        let found = panel.curves.iter().flat_map(|curve| {
            let number = labels.iter().position(|label| *label == curve.label);
            let ink = style(number.unwrap_or(0), chart.line_width).pen.ink;
            let name = match panel.curves.len() {
                1 => String::new(),
                _ => printable(&curve.label),
            };
            beyond(curve.within(ranges[0]), ranges[1], panel.axis.log)
                .into_iter()
                .flatten()
                .map(move |(beyond, [x, y], is_above)| {
                    let value = measured(y, &panel.axis.unit);
                    let value = format!("{value} at {}", measured(x, &chart.x.unit));
                    Peak {
                        x,
                        is_above,
                        beyond,
                        ink,
                        text: text(&name, &value),
                        name: name.clone(),
                        value,
                    }
                })
        });
        let all: Vec<Peak> = found.collect();
        let room = (chart.width() - 2.0 * EDGE * chart.font_size) / (SIZE * chart.font_size);
        let mut told = all.clone();
        // The farthest first; what has no room is marked only.
        told.sort_by(|a, b| b.beyond.total_cmp(&a.beyond));
        let mut rows = in_rows(&told, room);
        while rows.len() > most_rows && told.pop().is_some() {
            rows = in_rows(&told, room);
        }
        Peaks { all, rows }
    }

    /// All of them in words; a curve without a name has that of its axis.
    pub fn words<'p>(&'p self, axis: &'p str) -> impl Iterator<Item = String> + 'p {
        self.all.iter().map(move |peak| match peak.name.as_str() {
            "" => format!("{axis}: {}", peak.value),
            name => format!("{name}: {}", peak.value),
        })
    }

    /// Height of the texts above the panel \[pt\].
    pub fn height(&self, em: f64) -> f64 {
        self.rows.len() as f64 * LINE * SIZE * em
    }

    /// Marks at the ends of the axis.
    pub fn marks(&self, [x_scale, scale]: [&Scale; 2], em: f64, scene: &mut Scene) {
        for peak in &self.all {
            let end = if peak.is_above {
                scale.end
            } else {
                scale.start
            };
            if let Some(x) = x_scale.place(peak.x) {
                sign(scene, ([x, end], peak.is_above), em, peak.ink);
            }
        }
    }

    /// The texts, of which the lowest row stands on `bottom`.
    pub fn texts(&self, bottom: f64, x_scale: &Scale, em: f64, scene: &mut Scene) {
        let size = SIZE * em;
        for (index, row) in self.rows.iter().rev().enumerate() {
            let foot = bottom - index as f64 * LINE * size;
            let widths: Vec<f64> = row.iter().map(|peak| size * width(peak)).collect();
            let wanted: Vec<f64> = row
                .iter()
                .zip(&widths)
                .map(|(peak, width)| x_scale.place(peak.x).unwrap_or(0.0) - width / 2.0)
                .collect();
            let ends = [EDGE * em, scene.width - EDGE * em];
            let lefts = beside(&wanted, &widths, BETWEEN * size, ends);
            for ((peak, left), width) in row.iter().zip(lefts).zip(widths) {
                let box_of = [[left, foot - LINE * size], [left + width, foot]];
                write(scene, peak, box_of, size);
            }
        }
    }
}

/// The farthest places beyond the upper and the lower end, with how far they lie in heights of the axis, and whether above. What
/// a logarithmic axis leaves out below are values near zero, not peaks.
fn beyond(
    places: impl Iterator<Item = [f64; 2]>,
    [low, high]: [f64; 2],
    log: bool,
) -> [Option<(f64, [f64; 2], bool)>; 2] {
    let mut found = [None, None];
    let height = if log { high } else { 0.5 * high - 0.5 * low };
    for place in places.filter(|[_, y]| y.is_finite()) {
        let above = (place[1] - high) / height;
        let below = (low - place[1]) / height;
        for (end, far, is_above) in [(0, above, true), (1, below, false)] {
            let farthest: Option<(f64, _, _)> = found[end];
            let is_left_out = far > SEEN && (is_above || !log);
            if is_left_out && farthest.is_none_or(|(before, _, _)| far > before) {
                found[end] = Some((far, place, is_above));
            }
        }
    }
    found
}

/// `spring: 628.6 N·m at 1.748 s`; a long name is cut.
fn text(name: &str, value: &str) -> String {
    match name {
        "" => value.to_string(),
        name => format!("{}: {value}", font::fit(name, 1.0, LONGEST_NAME)),
    }
}

/// A number of four digits with its unit.
fn measured(value: f64, in_unit: &str) -> String {
    let number = minus(&four_digits(value));
    match unit(in_unit) {
        unit if unit.is_empty() || unit == "1" => number,
        unit if unit.starts_with('°') => format!("{number}{unit}"),
        unit => format!("{number} {unit}"),
    }
}

/// A number of four digits, written out where it is neither tiny nor huge.
fn four_digits(x: f64) -> String {
    let short = format!("{x:.3e}");
    // Rounded first, since 0.99999 has another order than 1.
    let x: f64 = short.parse().unwrap_or(x);
    if x == 0.0 {
        return "0".into();
    }
    if (1e-3..1e6).contains(&x.abs()) {
        let digits = (3.0 - x.abs().log10().floor()).clamp(0.0, 6.0) as usize;
        return format!("{x:.digits$}");
    }
    short
}

/// Width of a text with its mark, as a part of its size.
fn width(peak: &Peak) -> f64 {
    SIGN + font::width(&peak.text, 1.0)
}

/// The peaks from left to right, in rows that have room for them.
fn in_rows(peaks: &[Peak], room: f64) -> Vec<Vec<Peak>> {
    let mut ordered = peaks.to_vec();
    ordered.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut rows: Vec<Vec<Peak>> = Vec::new();
    let mut free = 0.0;
    for peak in ordered {
        let wide = width(&peak) + BETWEEN;
        match rows.last_mut() {
            Some(row) if wide - BETWEEN <= free => row.push(peak),
            Some(_) | None => {
                free = room;
                rows.push(vec![peak]);
            }
        }
        free -= wide;
    }
    rows
}

/// Left ends of texts near where they are wanted, `gap` apart and inside the ends: from left to right, then back.
fn beside(wanted: &[f64], widths: &[f64], gap: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    let mut lefts = Vec::with_capacity(wanted.len());
    let mut free = low;
    for (wanted, width) in wanted.iter().zip(widths) {
        let left = wanted.max(free);
        lefts.push(left);
        free = left + width + gap;
    }
    let mut free = high;
    for (left, width) in lefts.iter_mut().zip(widths).rev() {
        *left = left.min(free - width);
        free = *left - gap;
    }
    lefts
}

/// A text with its mark in a box; white behind it keeps it apart from lines of marks.
fn write(scene: &mut Scene, peak: &Peak, [[left, top], [right, foot]]: [Place; 2], size: f64) {
    let corners = [[left, top], [right, top], [right, foot], [left, foot]];
    scene.area("peak-back", corners, Some(Ink::grey(255)), None);
    let baseline = foot - 0.3 * size;
    let middle = left + 0.4 * size;
    let tip = if peak.is_above {
        baseline - MARK[1] * size - 0.05 * size
    } else {
        baseline
    };
    sign(scene, ([middle, tip], peak.is_above), size, peak.ink);
    let runs = vec![Run::plain(peak.text.as_str())];
    let at = [left + SIGN * size, baseline];
    scene.label("peak", at, runs, size, Anchor::Start);
}

/// A triangle with its tip at a place, upwards or downwards; its edge keeps it apart from curves.
fn sign(scene: &mut Scene, ([x, y], is_up): (Place, bool), em: f64, ink: Ink) {
    let [half, high] = MARK.map(|part| part * em);
    let foot = if is_up { y + high } else { y - high };
    let corners = [[x, y], [x + half, foot], [x - half, foot]];
    let edge = Pen::new(Ink::grey(255), 0.08 * em);
    scene.area("peak-mark", corners, Some(ink), Some(edge));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stand_side_by_side() {
        let lefts = beside(&[5.0, 90.0, 92.0], &[10.0, 20.0, 20.0], 2.0, [0.0, 100.0]);
        assert_eq!(lefts, [5.0, 58.0, 80.0]);
        assert_eq!(beside(&[-5.0], &[20.0], 2.0, [1.0, 100.0]), [1.0]);
    }

    #[test]
    fn numbers_have_four_digits() {
        for (value, text) in [
            (628.58, "628.6"),
            (-0.01234, "-0.01234"),
            (17730.4, "17730"),
            (2e9, "2.000e9"),
            (0.99997, "1.000"),
            (0.0, "0"),
        ] {
            assert_eq!(four_digits(value), text);
        }
        assert_eq!(measured(-3.0, "N*m"), "−3.000 N·m");
        assert_eq!(measured(117.512, "deg"), "117.5°");
    }

    #[test]
    fn the_farthest_value_beyond_each_end_is_found() {
        let places = [
            [0.0, 0.5],
            [1.0, 3.0],
            [2.0, 9.0],
            [3.0, -4.0],
            [4.0, 1.001],
        ];
        let [above, below] = beyond(places.into_iter(), [0.0, 1.0], false);
        assert_eq!(above.map(|(_, place, _)| place), Some([2.0, 9.0]));
        assert_eq!(below.map(|(_, place, _)| place), Some([3.0, -4.0]));
        let [_, below] = beyond(places.into_iter(), [0.1, 10.0], true);
        assert!(below.is_none());
    }
}
