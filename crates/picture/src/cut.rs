//! Where an axis is cut, so that a few peaks do not hide everything else.
//!
//! The one rule for pages and figures. The bulk of a curve is what lies between its 5th and 95th percentile. An end that is
//! farther from the bulk than six times the bulk's height is a peak or a pole (mechanical advantage at a dead centre, torque at
//! a change point): the axis ends one height beyond the bulk. Who draws a cut axis says what the peak is.

use serde_json::{Map, Value, json};

/// Part of the values at each end that does not belong to the bulk.
const TAIL: f64 = 0.05;
/// Distance from the bulk, in heights of it, beyond which an end is a peak.
const FAR: f64 = 6.0;
/// What is kept beyond the bulk, in heights of it.
const KEPT: f64 = 1.0;
/// A bulk this small compared with the largest value is round-off, not a curve.
const ROUND_OFF: f64 = 1e-9;
/// Values below which nothing can be said of percentiles.
const FEW: usize = 20;
/// Room beyond what an axis shows, as a part of it.
const MARGIN: f64 = 0.05;
/// The range of no value.
const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// Where to cut an axis; an end without peak is not cut.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cut {
    /// The lowest value to show.
    pub low: Option<f64>,
    /// The highest value to show.
    pub high: Option<f64>,
}

impl Cut {
    /// The cut of some values, of which those that are not finite do not count; none without peaks.
    pub fn of(values: impl Iterator<Item = f64>) -> Option<Cut> {
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        if values.len() < FEW {
            return None;
        }
        let last = values.len() - 1;
        let tail = (TAIL * last as f64) as usize;
        let mut ranked = |rank: usize| *values.select_nth_unstable_by(rank, f64::total_cmp).1;
        let [least, low, high, most] = [0, tail, last - tail, last].map(&mut ranked);
        let height = high - low;
        if height.is_nan() || height <= ROUND_OFF * least.abs().max(most.abs()) {
            return None;
        }
        let cut = Cut {
            low: (low - least > FAR * height).then_some(low - KEPT * height),
            high: (most - high > FAR * height).then_some(high + KEPT * height),
        };
        (cut != Cut::default()).then_some(cut)
    }

    /// The range of an axis that leaves out the peaks of some curves; `None` if everything is shown.
    ///
    /// What one curve cuts off another one may show, so each has its own cut, and the axis the widest.
    pub fn range(curves: impl Iterator<Item = Vec<f64>>) -> Option<[f64; 2]> {
        let [mut shown, mut all] = [NOTHING; 2];
        let wider = |range: &mut [f64; 2], [low, high]: [f64; 2]| {
            *range = [range[0].min(low), range[1].max(high)];
        };
        for values in curves {
            let mut own = NOTHING;
            for value in values.iter().filter(|value| value.is_finite()) {
                wider(&mut own, [*value; 2]);
            }
            wider(&mut all, own);
            let cut = Cut::of(values.into_iter()).unwrap_or_default();
            wider(
                &mut shown,
                [cut.low.unwrap_or(own[0]), cut.high.unwrap_or(own[1])],
            );
        }
        let margin = MARGIN * (shown[1] - shown[0]);
        let hides = shown[0] > all[0] || shown[1] < all[1];
        hides.then_some([shown[0] - margin, shown[1] + margin])
    }

    /// `[low, high]`, an end that is not cut as null.
    pub fn to_json(self) -> Value {
        json!([self.low, self.high])
    }
}

/// Cuts by the names of what is cut.
pub fn to_json<'a>(cuts: impl Iterator<Item = (String, Cut)> + 'a) -> Value {
    let cuts = cuts.map(|(name, cut)| (name, cut.to_json()));
    Value::Object(cuts.collect::<Map<_, _>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine() -> Vec<f64> {
        (0..1001).map(|k| (0.1 * f64::from(k)).sin()).collect()
    }

    #[test]
    fn a_peak_is_cut_and_the_rest_is_whole() {
        let mut values = sine();
        assert_eq!(Cut::of(values.iter().copied()), None);
        values[500] = 1e6;
        values[700] = f64::NAN;
        let cut = Cut::of(values.into_iter()).expect("a peak");
        assert_eq!(cut.low, None);
        let high = cut.high.expect("cut above");
        assert!((2.5..3.2).contains(&high), "{high}");
    }

    #[test]
    fn an_axis_shows_what_any_of_its_curves_keeps() {
        assert_eq!(Cut::range([sine()].into_iter()), None);
        let mut peaked = sine();
        (peaked[500], peaked[700]) = (1e6, f64::NAN);
        let [low, high] = Cut::range([peaked.clone(), sine()].into_iter()).expect("a peak");
        assert!(low < -1.0 && (1.4..3.5).contains(&high), "{low} {high}");
        // Another curve goes on up there.
        let tall = sine().into_iter().map(|y| 2e6 * y).collect();
        assert_eq!(Cut::range([peaked, tall].into_iter()), None);
        assert_eq!(Cut::range([vec![0.0, 1e9]].into_iter()), None);
        assert_eq!(Cut::range(std::iter::empty()), None);
    }

    #[test]
    fn both_ends_of_a_pole_are_cut() {
        let pole = (-180..180).map(|k| 1.0 / (f64::from(k) + 0.5));
        let cut = Cut::of(pole).expect("a pole");
        assert!(
            cut.low.is_some_and(|low| (-0.5..-0.1).contains(&low)),
            "{cut:?}"
        );
        assert!(
            cut.high.is_some_and(|high| (0.1..0.5).contains(&high)),
            "{cut:?}"
        );
    }

    #[test]
    fn what_has_no_bulk_is_not_cut() {
        let constant = (0..100).map(|k| if k == 50 { 1.0 } else { 0.0 });
        assert_eq!(Cut::of(constant), None);
        let round_off = (0..100).map(|k| if k == 50 { 1.0 } else { 1e-12 * f64::from(k) });
        assert_eq!(Cut::of(round_off), None);
        assert_eq!(Cut::of([0.0, 1e9].into_iter()), None);
        assert_eq!(Cut::of([f64::NAN; 40].into_iter()), None);
    }
}
