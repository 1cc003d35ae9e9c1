//! Output instants: equally spaced in time, or in a driver's value.

use crate::motion::Jet;
use crate::system::System;
use linkdyn_model::error::Complaint;

/// One output instant; where outputs are spaced in a driver's value, that value exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputInstant {
    /// When \[s\].
    pub time: f64,
    /// Number of the driver and its value [rad or m].
    pub exact: Option<(usize, f64)>,
}

impl OutputInstant {
    /// Drivers' values and derivatives at the instant.
    pub fn drive(&self, system: &System, drive: &mut [Jet]) {
        system.drive(self.time, drive);
        if let Some((driver, value)) = self.exact {
            drive[driver][0] = value;
        }
    }
}

/// When there are outputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Instants {
    /// At t = 0 alone.
    Start,
    /// Equally spaced in time.
    Equidistant(Equidistant),
    /// Equally spaced in the value of a driver.
    Sampled(Sampled),
}

/// Outputs from 0 to `end`, both included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equidistant {
    /// The last instant \[s\].
    pub end: f64,
    /// Their number.
    pub outputs: usize,
}

/// Outputs where a driver passes `from`, `from ± step` … `to`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampled {
    /// Its number.
    pub driver: usize,
    /// First value [rad or m].
    pub from: f64,
    /// Last value [rad or m].
    pub to: f64,
    /// Distance of two values, of whatever sign [rad or m].
    pub step: f64,
}

impl Instants {
    /// How many there are, about.
    pub fn count(&self) -> f64 {
        match self {
            Instants::Start => 1.0,
            Instants::Equidistant(wanted) => wanted.outputs as f64,
            Instants::Sampled(wanted) => ((wanted.to - wanted.from) / wanted.step).abs() + 1.0,
        }
    }

    /// What in the file says how many.
    pub fn word(&self) -> &'static str {
        match self {
            Instants::Start | Instants::Equidistant(_) => "analysis.outputs",
            Instants::Sampled(_) => "analysis.sample.step",
        }
    }

    /// All of them, in the order of outputs.
    ///
    /// # Errors
    /// A sampled value that the driver does not reach on its first monotone stretch; more outputs than fit.
    pub fn list(&self, system: &System) -> Result<Vec<OutputInstant>, Complaint> {
        match self {
            Instants::Start => Ok(vec![OutputInstant {
                time: 0.0,
                exact: None,
            }]),
            Instants::Equidistant(wanted) => equidistant(*wanted),
            Instants::Sampled(wanted) => sampled(system, *wanted),
        }
    }
}

fn equidistant(Equidistant { end, outputs }: Equidistant) -> Result<Vec<OutputInstant>, Complaint> {
    if outputs > MOST_OUTPUTS {
        let message = format!("more than {MOST_OUTPUTS} outputs");
        return Err(Complaint::new("analysis.outputs", message).found(outputs.to_string()));
    }
    let last = (outputs - 1) as f64;
    let instant = |k: usize| OutputInstant {
        time: if k + 1 == outputs {
            end
        } else {
            end * (k as f64 / last)
        },
        exact: None,
    };
    Ok((0..outputs).map(instant).collect())
}

/// More rows than anybody can read or store.
pub(super) const MOST_OUTPUTS: usize = 10_000_000;

fn sampled(system: &System, sample: Sampled) -> Result<Vec<OutputInstant>, Complaint> {
    let driver = sample.driver;
    let (name, law) = (&system.drivers[driver].name, &system.drivers[driver].law);
    let step = sample.step.abs() * (sample.to - sample.from).signum();
    // `to` is always the last value, also when the step does not divide the range: a remainder below a millionth of a
    // step is round-off.
    let intervals = ((sample.to - sample.from) / step - 1e-6).ceil().max(0.0);
    if intervals.is_nan() || intervals > MOST_OUTPUTS as f64 {
        let message = format!("more than {MOST_OUTPUTS} outputs");
        return Err(Complaint::new("analysis.sample.step", message).found(sample.step.to_string()));
    }
    let rate = law.rate(system.measure_scale(system.drivers[driver].measure));
    let latest = horizon(law, rate, &[sample.from, sample.to]);
    let count = intervals as usize;
    let stretch = latest.map(|latest| law.first_stretch(latest));
    let mut guess = 0.0;
    let mut instants = Vec::with_capacity(count + 1);
    for k in 0..=count {
        let value = if k == count {
            sample.to
        } else {
            sample.from + step * k as f64
        };
        let Some(time) = stretch.and_then(|stretch| stretch.invert(value, guess)) else {
            let [value, start] =
                [value, law.jet(0.0)[0]].map(|value| system.driver_value(driver, value));
            return Err(Complaint::new(
                if k == 0 { "analysis.sample.from" } else { "analysis.sample.to" },
                format!(
                    "driver \"{name}\" does not reach {value} on its first monotone stretch from {start}"
                ),
            )
            .hint("sample within the values the motion passes before it first turns back"));
        };
        guess = time;
        instants.push(OutputInstant {
            time,
            exact: Some((driver, value)),
        });
    }
    if instants.windows(2).any(|w| w[1].time < w[0].time) {
        return Err(Complaint::new(
            "analysis.sample",
            format!("driver \"{name}\" passes the values in the other order"),
        )
        .hint("exchange from and to"));
    }
    Ok(instants)
}

/// Part of the time in which a law moves by a radian or the mechanism's size, in which it has not passed anything yet.
const SOON: f64 = 1e-6;

/// Doublings of it after which a value is never reached: by then the law would have passed 10¹³ of them.
const DOUBLINGS: u32 = 64;

/// A time by which the law, of this rate [1/s], has passed all `values` or turned back: by doubling.
fn horizon(law: &crate::motion::Law, rate: f64, values: &[f64]) -> Option<f64> {
    let rate = if rate.is_normal() { rate } else { 1.0 };
    // Among 2ᵏ ms, so that it does not depend on where the search begins.
    let mut end = 1e-3;
    while end * rate < SOON {
        end *= 2.0;
    }
    while end * rate > SOON {
        end *= 0.5;
    }
    for _ in 0..DOUBLINGS {
        if values.iter().all(|&value| law.invert(value, end).is_some()) {
            return Some(end);
        }
        if law.turning_times(end).next().is_some() {
            return None;
        }
        end *= 2.0;
    }
    None
}
