//! Value → place on the page; ticks at round values.

use super::scene::Run;
use super::words::minus;

/// Exponents of tick labels up to which numbers are written out.
const PLAIN: std::ops::Range<i32> = -2..5;
/// Most ticks of an axis, whatever its length.
const MOST_TICKS: usize = 400;
/// Largest end of an axis. Differences of ends need not be finite: only parts of them are formed.
pub const LARGEST: f64 = f64::MAX;

/// An axis: `low` lies at `start`, `high` at `end` \[pt\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    pub low: f64,
    pub high: f64,
    pub log: bool,
    pub start: f64,
    pub end: f64,
}

/// Ticks of an axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ticks {
    pub major: Vec<(f64, Vec<Run>)>,
    pub minor: Vec<f64>,
    /// Labels are to be multiplied by 10^exponent.
    pub exponent: i32,
}

impl Scale {
    /// Part of the way from `low` to `high`; not finite where the axis has no place for the value.
    fn part(&self, value: f64) -> f64 {
        if self.log {
            (value.log10() - self.low.log10()) / (self.high.log10() - self.low.log10())
        } else {
            let half = if (self.high - self.low).is_finite() {
                1.0
            } else {
                0.5
            };
            (half * value - half * self.low) / (half * self.high - half * self.low)
        }
    }

    /// Place of a value \[pt\]; `None` if it has none (not finite, or not positive on a logarithmic axis).
    pub fn place(&self, value: f64) -> Option<f64> {
        let place = self.start + self.part(value) * (self.end - self.start);
        place.is_finite().then_some(place)
    }

    /// Ticks at least `spacing` apart \[pt\]; `turns`: the unit is a degree, halves and quarters of turns are round.
    pub fn ticks(&self, spacing: f64, turns: bool) -> Ticks {
        let most = ((self.end - self.start).abs() / spacing).max(1.0);
        if self.log {
            self.log_ticks(most)
        } else {
            self.linear_ticks(most, turns)
        }
    }

    fn linear_ticks(&self, most: f64, turns: bool) -> Ticks {
        let span = self.high - self.low;
        let (raw, slack) = match span.is_finite() {
            true => (span / most, 1e-9 * span),
            false => (
                self.high / most - self.low / most,
                1e-9 * self.high - 1e-9 * self.low,
            ),
        };
        let (step, parts) = round_step(raw, turns);
        let largest = self.low.abs().max(self.high.abs());
        let magnitude = order(largest);
        // Powers of a thousand, as for units.
        let exponent = if PLAIN.contains(&magnitude) {
            0
        } else {
            magnitude.div_euclid(3) * 3
        };
        let digits = exponent - order(step) + i32::from(!is_multiple(step, order(step)));
        let decimals = usize::try_from(digits).unwrap_or(0).min(17);
        let label = |value: f64| {
            let text = format!("{:.*}", decimals, shift(value, -exponent));
            // No −0.
            let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
            vec![Run::plain(minus(if is_zero {
                text.trim_start_matches('-')
            } else {
                &text
            }))]
        };
        let within = |step: f64| {
            let (first, last) = (
                (self.low / step - 1e-9).ceil(),
                (self.high / step + 1e-9).floor(),
            );
            let count = if last >= first {
                (last - first) as usize
            } else {
                0
            };
            (0..=count.min(MOST_TICKS))
                .map(move |k| (first + k as f64) * step)
                .filter(|value| value.is_finite())
        };
        let inside = |value: &f64| *value >= self.low - slack && *value <= self.high + slack;
        Ticks {
            major: within(step)
                .filter(inside)
                .map(|value| (value, label(value)))
                .collect(),
            minor: within(step / f64::from(parts)).filter(inside).collect(),
            exponent,
        }
    }

    fn log_ticks(&self, most: f64) -> Ticks {
        let (first, last) = (self.low.log10(), self.high.log10());
        if last - first < 1.0 {
            // Less than a decade: the round values of a linear axis.
            let linear = Scale {
                log: false,
                ..*self
            }
            .linear_ticks(most * 0.7, false);
            return Ticks {
                minor: Vec::new(),
                ..linear
            };
        }
        let decades = (first - 1e-9).ceil() as i32..=(last + 1e-9).floor() as i32;
        let stride = ((last - first) / most).ceil().max(1.0) as i32;
        let label = |decade: i32| match decade {
            0..=3 => vec![Run::plain(format!("{}", 10_i32.pow(decade.unsigned_abs())))],
            -2..0 => vec![Run::plain(format!(
                "{:.*}",
                decade.unsigned_abs() as usize,
                shift(1.0, decade)
            ))],
            _ => vec![Run::plain("10"), Run::raised(minus(&decade.to_string()))],
        };
        let major = decades
            .clone()
            .filter(|decade| decade.rem_euclid(stride) == 0);
        let major = major.map(|decade| (shift(1.0, decade), label(decade)));
        let steps: &[f64] = if stride == 1 {
            &[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]
        } else {
            &[1.0]
        };
        let minor = (first.floor() as i32..=*decades.end())
            .flat_map(|decade| steps.iter().map(move |k| k * shift(1.0, decade)));
        Ticks {
            major: major.collect(),
            minor: minor
                .filter(|value| (self.low..=self.high).contains(value))
                .collect(),
            exponent: 0,
        }
    }
}

/// Order of magnitude, floor(log10).
fn order(value: f64) -> i32 {
    let text = format!("{value:e}");
    text.split_once('e')
        .and_then(|(_, exponent)| exponent.parse().ok())
        .unwrap_or(0)
}

/// value · 10^exponent, rounded once.
fn shift(value: f64, exponent: i32) -> f64 {
    let text = format!("{value:e}");
    let Some((mantissa, own)) = text.split_once('e') else {
        return value;
    };
    let own: i32 = own.parse().unwrap_or(0);
    format!("{mantissa}e{}", own + exponent)
        .parse()
        .unwrap_or(value)
}

/// Whether the step has one digit.
fn is_multiple(step: f64, order: i32) -> bool {
    let digits = shift(step, -order);
    (digits - digits.round()).abs() < 1e-6
}

/// The least round step of at least `raw`, and the parts that minor ticks divide it into.
fn round_step(raw: f64, turns: bool) -> (f64, u8) {
    const ANGLES: [(f64, u8); 8] = [
        (10.0, 2),
        (15.0, 3),
        (30.0, 3),
        (45.0, 3),
        (60.0, 4),
        (90.0, 3),
        (180.0, 4),
        (360.0, 4),
    ];
    if turns
        && (5.0..=360.0).contains(&raw)
        && let Some(&step) = ANGLES.iter().find(|(step, _)| *step >= raw)
    {
        return step;
    }
    let raw = if raw.is_finite() && raw > 0.0 {
        raw
    } else {
        f64::MIN_POSITIVE
    };
    let magnitude = order(raw);
    let digits = shift(raw, -magnitude);
    // A step of 9.99… because of round-off is 10.
    let (step, parts) = match digits {
        d if d <= 1.0 + 1e-9 => (1.0, 5),
        d if d <= 2.0 + 1e-9 => (2.0, 4),
        d if d <= 2.5 + 1e-9 && !turns => (2.5, 5),
        d if d <= 5.0 + 1e-9 => (5.0, 5),
        _ => (10.0, 5),
    };
    (shift(step, magnitude), parts)
}

/// A range that holds all values, with `margin` of its width on both sides; `None` if there is no value.
pub fn range(values: impl Iterator<Item = f64>, log: bool, margin: f64) -> Option<[f64; 2]> {
    let usable = values.filter(|value| value.is_finite() && (!log || *value > 0.0));
    let usable = usable.map(|value| value.clamp(-LARGEST, LARGEST));
    let [low, high] = usable.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
        [low.min(v), high.max(v)]
    });
    if low > high {
        return None;
    }
    if log {
        let factor = if high / low < 1.0 + 1e-9 {
            2.0
        } else {
            (high / low).powf(margin)
        };
        return Some([
            (low / factor).max(f64::MIN_POSITIVE),
            (high * factor).min(LARGEST),
        ]);
    }
    let size = low.abs().max(high.abs());
    let half = 0.5 * high - 0.5 * low;
    // Round-off is no curve: a constant is shown as one.
    if half <= 0.5e-12 * size || half < f64::MIN_POSITIVE {
        let room = if size > 1e-300 { 0.1 * size } else { 1.0 };
        return Some([(low - room).max(-LARGEST), (high + room).min(LARGEST)]);
    }
    let room = 2.0 * margin * half;
    Some([(low - room).max(-LARGEST), (high + room).min(LARGEST)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn linear(low: f64, high: f64) -> Scale {
        Scale {
            low,
            high,
            log: false,
            start: 0.0,
            end: 200.0,
        }
    }

    fn labels(ticks: &Ticks) -> Vec<String> {
        ticks
            .major
            .iter()
            .map(|(_, runs)| runs.iter().map(|run| run.text.clone()).collect())
            .collect()
    }

    #[test]
    fn ticks_are_round() {
        for (low, high, expected) in [
            (0.0, 1.0, "0.0 0.2 0.4 0.6 0.8 1.0"),
            (-50.0, 125.0, "−50 0 50 100"),
            (0.0, 0.0035, "0 1 2 3"),
            (-61_000.0, 61_000.0, "−50000 −25000 0 25000 50000"),
            (-3.0e6, 5.0e6, "−2 0 2 4"),
            (117.51, 117.514, "117.510 117.511 117.512 117.513 117.514"),
        ] {
            assert_eq!(
                labels(&linear(low, high).ticks(35.0, false)).join(" "),
                expected,
                "{low} {high}"
            );
        }
        assert_eq!(
            labels(&linear(0.0, 360.0).ticks(35.0, true)).join(" "),
            "0 90 180 270 360"
        );
        assert_eq!(linear(-3.0e6, 5.0e6).ticks(35.0, false).exponent, 6);
    }

    #[test]
    fn decades_are_labelled() {
        let scale = Scale {
            log: true,
            ..linear(0.03, 2e5)
        };
        assert_eq!(
            labels(&scale.ticks(20.0, false)).join(" "),
            "0.1 1 10 100 1000 104 105"
        );
        let wide = Scale {
            log: true,
            ..linear(1e-300, 1e300)
        };
        assert!(wide.ticks(20.0, false).major.len() < 12);
        let narrow = Scale {
            log: true,
            ..linear(20.0, 90.0)
        };
        assert_eq!(labels(&narrow.ticks(30.0, false)).join(" "), "20 40 60 80");
    }

    #[test]
    fn no_range_makes_ticks_run_away() {
        for (low, high) in [
            (-LARGEST, LARGEST),
            (0.0, 5e-324),
            (1.0, 1.0 + 4e-16),
            (1e300, 1.1e300),
            (-1e-300, 1e-300),
        ] {
            let ticks = linear(low, high).ticks(30.0, false);
            assert!(
                ticks.major.len() < 40 && ticks.minor.len() <= MOST_TICKS + 1,
                "{low} {high}: {ticks:?}"
            );
            assert!(
                ticks.major.iter().all(|(value, _)| value.is_finite()),
                "{low} {high}"
            );
        }
    }

    #[test]
    fn ranges_hold_their_values() {
        assert_eq!(range([].into_iter(), false, 0.05), None);
        assert_eq!(range([f64::NAN, -1.0].into_iter(), true, 0.05), None);
        assert_eq!(range([2.0].into_iter(), false, 0.05), Some([1.8, 2.2]));
        assert_eq!(range([0.0].into_iter(), false, 0.05), Some([-1.0, 1.0]));
        let [low, high] = range([-f64::MAX, f64::MAX].into_iter(), false, 0.05).expect("values");
        assert_eq!([low, high], [-LARGEST, LARGEST]);
    }

    #[test]
    fn the_largest_numbers_have_ticks_where_they_are() {
        let [low, high] = range([-1e308, 1e308].into_iter(), false, 0.05).expect("values");
        assert!(
            (low / -1.1e308 - 1.0).abs() < 1e-12 && high == -low,
            "{low} {high}"
        );
        let ticks = linear(low, high).ticks(35.0, false);
        assert_eq!(
            (labels(&ticks).join(" "), ticks.exponent),
            ("−100 −50 0 50 100".into(), 306)
        );
        assert_eq!(linear(low, high).place(0.0), Some(100.0));
    }

    #[test]
    fn the_whole_axis_is_used() {
        let scale = Scale {
            low: 1.0,
            high: 100.0,
            log: true,
            start: 300.0,
            end: 100.0,
        };
        for (value, place) in [
            (1.0, Some(300.0)),
            (10.0, Some(200.0)),
            (100.0, Some(100.0)),
            (0.0, None),
            (-1.0, None),
        ] {
            assert_eq!(scale.place(value), place);
        }
        let scale = linear(-LARGEST, LARGEST);
        assert_eq!(scale.place(0.0), Some(100.0));
    }
}
