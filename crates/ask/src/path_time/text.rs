//! The fastest motion in words.

use super::FastestMotion;
use super::bounds::{Bound, Of};
use super::coefficients::quantity;
use crate::text::{Page, count, number, seconds};

/// Digits of numbers.
const DIGITS: usize = 6;
const FEW: usize = 3;

impl FastestMotion {
    /// The motion in words.
    pub fn text(&self) -> Page {
        let mut page = Page::default();
        let stroke = &self.stroke;
        page.line(format!(
            "{}: fastest motion of driver \"{}\" from {} to {}: {} s",
            self.file.name(),
            stroke.driver,
            self.place(stroke.from),
            self.place(stroke.to),
            number(self.time(), DIGITS)
        ));
        page.rows(
            "limits",
            self.shares()
                .iter()
                .enumerate()
                .map(|(k, own)| self.limit(k, own)),
        );
        let law = &self.law;
        page.row(
            "law",
            format!(
                "{} of constant acceleration; duality gap {} of the time, {} in {}",
                count(stroke.intervals, "interval"),
                number(law.found.gap, 2),
                count(law.iterations, "iteration"),
                count(law.rounds, "round")
            ),
        );
        page.row("check", self.checked());
        let [coefficients, of_law] = self.seconds;
        page.row(
            "computed",
            format!(
                "coefficients in {}, law in {}",
                seconds(coefficients),
                seconds(of_law)
            ),
        );
        page
    }

    /// A value of the driver.
    pub(super) fn place(&self, value: f64) -> String {
        let display = &self.file.model().display;
        match self.unit {
            "rad" => display.angle(value),
            _ => display.length(value),
        }
    }

    /// In how many intervals each limit is reached.
    pub(super) fn shares(&self) -> Vec<usize> {
        let mut shares = vec![0; self.bounds.len()];
        for interval in 0..self.stroke.intervals {
            if let Some(k) = self.binding(interval) {
                shares[k] += 1;
            }
        }
        shares
    }

    /// The limit that an interval reaches.
    pub(super) fn binding(&self, interval: usize) -> Option<usize> {
        self.law.binding(&self.bounds, &self.coefficients, interval)
    }

    /// The largest part of its limit that a bound reaches.
    pub(super) fn largest(&self, bound: usize) -> f64 {
        let parts = (0..self.stroke.intervals).map(|interval| {
            self.law
                .reached(&self.bounds, &self.coefficients, interval, bound)
        });
        parts.fold(f64::NEG_INFINITY, f64::max)
    }

    fn limit(&self, k: usize, reached: &usize) -> String {
        let bound = &self.bounds[k];
        let what = format!("{} {}", bound.name, range(bound));
        if *reached == 0 {
            let most = number(100.0 * self.largest(k).max(0.0), FEW);
            return format!("{what}: not reached, {most} % of it at most");
        }
        // By a hundredth of the limit.
        let saved = 0.01 * self.law.worth(k);
        format!(
            "{what}: reached in {reached} of {} intervals; 1 % more of it saves {}",
            self.stroke.intervals,
            seconds(saved.max(0.0))
        )
    }

    /// What a run of the law shows.
    pub(super) fn checked(&self) -> String {
        let (excess, bound, time) = self.excess;
        let outputs = count(self.run.len(), "output");
        if excess <= 0.0 {
            return format!("inverse dynamics with the law, {outputs}: all limits are kept");
        }
        format!(
            "inverse dynamics with the law, {outputs}: beyond a limit by {} of it at most ({} at t = {})",
            number(excess, 2),
            self.bounds[bound].name,
            self.file.model().display.time(time)
        )
    }
}

/// `within ±5 N·m`, `at most 300 N`.
pub(super) fn range(bound: &Bound) -> String {
    let [lower, upper] = bound.range;
    let value = |value: f64| quantity(value, bound.unit, DIGITS);
    match bound.of {
        Of::Size(_) | Of::Speed => format!("at most {}", value(upper)),
        Of::Column(_) | Of::Acceleration if lower == -upper => format!("within ±{}", value(upper)),
        Of::Column(_) | Of::Acceleration => format!("within {} … {}", value(lower), value(upper)),
    }
}
