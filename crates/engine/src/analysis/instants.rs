//! Output instants: equally spaced in time, or in a driver's value.

use crate::motion::Jet;
use crate::system::System;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Analysis, Sample};

/// One output instant; where outputs are spaced in a driver's value, that value exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputInstant {
    pub time: f64,
    pub exact: Option<(usize, f64)>,
}

impl OutputInstant {
    /// Drivers' values and derivatives at the instant.
    pub fn drive(&self, system: &System, drive: &mut [Jet]) {
        for (jet, driver) in drive.iter_mut().zip(&system.drivers) {
            *jet = driver.law.jet(self.time);
        }
        if let Some((driver, value)) = self.exact {
            drive[driver][0] = value;
        }
    }
}

/// The instants an analysis asks for.
///
/// # Errors
/// A sampled value that the driver does not reach on its first monotone stretch; more outputs than fit.
pub fn instants(
    system: &System,
    analysis: &Analysis,
) -> Result<Vec<OutputInstant>, Vec<Complaint>> {
    if let Some(sample) = &analysis.sample {
        return sampled(system, sample).map_err(|complaint| vec![complaint]);
    }
    let (Some(end), Some(outputs)) = (analysis.end, analysis.outputs) else {
        return Ok(vec![OutputInstant {
            time: 0.0,
            exact: None,
        }]);
    };
    if outputs > MOST_OUTPUTS {
        let message = format!("more than {MOST_OUTPUTS} outputs");
        return Err(vec![
            Complaint::new("analysis.outputs", message).found(outputs.to_string()),
        ]);
    }
    let last = (outputs - 1) as f64;
    Ok((0..outputs)
        .map(|k| OutputInstant {
            time: if k + 1 == outputs {
                end
            } else {
                end * (k as f64 / last)
            },
            exact: None,
        })
        .collect())
}

/// More rows than anybody can read or store.
pub(super) const MOST_OUTPUTS: usize = 10_000_000;

fn sampled(system: &System, sample: &Sample) -> Result<Vec<OutputInstant>, Complaint> {
    let driver = system.drivers.iter().position(|d| d.name == sample.driver);
    let Some(driver) = driver else {
        return Err(Complaint::new(
            "analysis.sample.driver",
            format!("no driver \"{}\"", sample.driver),
        ));
    };
    let law = &system.drivers[driver].law;
    let step = sample.step.abs() * (sample.to - sample.from).signum();
    // `to` is always the last value, also when the step does not divide the range: a remainder below a millionth of a
    // step is round-off.
    let intervals = ((sample.to - sample.from) / step - 1e-6).ceil().max(0.0);
    if intervals.is_nan() || intervals > MOST_OUTPUTS as f64 {
        let message = format!("more than {MOST_OUTPUTS} outputs");
        return Err(Complaint::new("analysis.sample.step", message).found(sample.step.to_string()));
    }
    let latest = horizon(law, &[sample.from, sample.to]);
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
                    "driver \"{}\" does not reach {value} on its first monotone stretch from {start}",
                    sample.driver
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
            format!(
                "driver \"{}\" passes the values in the other order",
                sample.driver
            ),
        )
        .hint("exchange from and to"));
    }
    Ok(instants)
}

/// A time by which the law has passed all `values` or turned back: doubling from 1 ms on.
fn horizon(law: &crate::motion::Law, values: &[f64]) -> Option<f64> {
    let mut end = 1e-3;
    while end < 1e9 {
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
