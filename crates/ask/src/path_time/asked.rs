//! The stroke in words, put into the model so that it is read where the file is.

use linkdyn_engine::system::compile::law;
use linkdyn_model::{Checked, Driver, Motion};
use serde_json::{Value, json};

use crate::near::did_you_mean;
use crate::put::{Put, number, read};
use crate::{ModelFile, Unanswered};

/// Asks for the fastest motion along a stroke. Texts are numbers in the units of the file, or bring their own.
#[derive(Debug, Clone, Default)]
pub struct PathTime {
    /// The driver that moves; there may be one alone.
    pub driver: Option<String>,
    /// Where the stroke begins; where the driver's own motion does.
    pub from: Option<String>,
    /// Where it ends; where the driver's own motion does.
    pub to: Option<String>,
    /// Limits of columns, `driver.motor.effort=5 N*m` or `joint.*=300 N`.
    pub limits: Vec<String>,
    /// The driver's greatest speed.
    pub speed: Option<String>,
    /// Its greatest acceleration.
    pub acceleration: Option<String>,
    /// Its speed at the start; none: at rest.
    pub start_speed: Option<String>,
    /// Its speed at the end; none: at rest.
    pub end_speed: Option<String>,
    /// Intervals of constant acceleration; 400 where nothing is said.
    pub intervals: Option<u64>,
}

/// Fewest and most intervals.
const INTERVALS: std::ops::RangeInclusive<u64> = 2..=20_000;
/// Intervals where nobody says how many.
const USUAL: u64 = 400;

/// A stroke of a driver, in SI units.
#[derive(Debug, Clone)]
pub(super) struct Stroke {
    pub driver: String,
    pub from: f64,
    pub to: f64,
    /// Speeds along it at both ends.
    pub ends: [f64; 2],
    /// The greatest speed and acceleration.
    pub speed: Option<f64>,
    pub acceleration: Option<f64>,
    pub intervals: usize,
}

fn bad(text: impl Into<String>) -> Unanswered {
    Unanswered::question(text)
}

/// The path of a key of a driver's motion.
fn key(driver: &str, key: &str) -> String {
    format!("drivers.{driver}.motion{key}")
}

/// A motion in the place of the driver's own.
fn motion(driver: &str, motion: &Value, labels: Vec<(String, String)>) -> Put {
    Put {
        set: format!("{}={motion}", key(driver, "")),
        labels,
    }
}

/// A motion at constant velocity along a stroke, from t = 0 to 1 s.
pub(super) fn steady(stroke: &Stroke, unit: &str) -> Put {
    let at = |time: &str, value: f64| json!([time, format!("{value:?} {unit}")]);
    let points = [at("0 s", stroke.from), at("1 s", stroke.to)];
    let steady = json!({ "type": "table", "interpolation": "monotone", "points": points });
    motion(&stroke.driver, &steady, Vec::new())
}

impl PathTime {
    /// Reads the stroke.
    pub(super) fn stroke(&self, file: &ModelFile) -> Result<Stroke, Unanswered> {
        let (name, driver) = self.driver_of(file.model())?;
        let intervals = self.intervals.unwrap_or(USUAL);
        if !INTERVALS.contains(&intervals) {
            return Err(bad(format!(
                "--intervals {intervals}: {} to {} are possible",
                INTERVALS.start(),
                INTERVALS.end()
            )));
        }
        let own = law(&driver.motion);
        let end = file.model().analysis.as_ref().and_then(|own| own.end);
        let read_with = |put: Put| -> Result<Motion, Unanswered> {
            let read = read(&file.text, &file.sets, &[put])?;
            let driver = read.model().drivers.get(name);
            driver
                .map(|driver| driver.motion.clone())
                .ok_or_else(|| bad("the driver is lost"))
        };
        let given = [
            ("start", "from", &self.from),
            ("end", "to", &self.to),
            ("velocity", "speed", &self.speed),
            ("acceleration", "acceleration", &self.acceleration),
        ];
        let mut wanted =
            json!({ "type": "trapezoidal_velocity", "end": 0, "velocity": 1, "acceleration": 1 });
        let mut labels = Vec::new();
        for (word, option, text) in given {
            if let Some(text) = text {
                wanted[word] = number(text);
                labels.push((
                    key(name, &format!(".{word}")),
                    format!("--{option} {text:?}"),
                ));
            }
        }
        let Motion::TrapezoidalVelocity(read) = read_with(motion(name, &wanted, labels))? else {
            return Err(bad("the stroke can't be read"));
        };
        let mut stroke = Stroke {
            driver: name.to_owned(),
            from: if self.from.is_some() {
                read.start
            } else {
                own.value(0.0)
            },
            to: match (&self.to, end) {
                (Some(_), _) => read.start + read.height(),
                (None, Some(end)) => own.value(end),
                (None, None) => {
                    return Err(bad(
                        "where does the stroke end? The model's analysis has no \"end\": say --to, as in --to \"90 deg\"",
                    ));
                }
            },
            ends: [0.0; 2],
            speed: self.speed.as_ref().and(read.velocity),
            acceleration: self.acceleration.as_ref().and(read.acceleration),
            intervals: intervals as usize,
        };
        if stroke.from == stroke.to {
            return Err(bad(
                "the stroke has no length: its ends are the same; say --from and --to, as in --from \"0 deg\" --to \"90 deg\"",
            ));
        }
        if self.start_speed.is_some() || self.end_speed.is_some() {
            stroke.ends = self.speeds(name, read_with)?;
        }
        let is_over = |speed: &&f64| stroke.speed.is_some_and(|most| **speed > most);
        if stroke.ends.iter().any(|speed| is_over(&speed)) {
            return Err(bad(
                "the speed at an end of the stroke is more than --speed",
            ));
        }
        Ok(stroke)
    }

    fn speeds(
        &self,
        name: &str,
        read: impl Fn(Put) -> Result<Motion, Unanswered>,
    ) -> Result<[f64; 2], Unanswered> {
        let given = [
            ("start-speed", &self.start_speed),
            ("end-speed", &self.end_speed),
        ];
        let values = given.map(|(_, text)| text.as_deref().map_or(json!(0), number));
        let labels = given.iter().enumerate().filter_map(|(k, (option, text))| {
            let label = format!("--{option} {:?}", text.as_ref()?);
            Some((key(name, &format!(".velocities[{k}]")), label))
        });
        let points = [["0 s"; 1], ["1 s"; 1]].map(|[time]| json!([time, 0]));
        let wanted = json!({ "type": "table", "points": points, "velocities": values });
        let read = read(motion(name, &wanted, labels.collect()))?;
        let Motion::Table {
            velocities: Some(speeds),
            ..
        } = read
        else {
            return Err(bad("the speeds can't be read"));
        };
        for (speed, (option, text)) in speeds.iter().zip(given) {
            if *speed < 0.0 {
                let text = text.as_deref().unwrap_or_default();
                return Err(bad(format!(
                    "--{option} {text:?}: a speed along the stroke is not negative"
                )));
            }
        }
        Ok([0, 1].map(|k| speeds.get(k).copied().unwrap_or_default()))
    }

    /// The driver that moves along the stroke; others stand still.
    fn driver_of<'m>(&self, model: &'m Checked) -> Result<(&'m str, &'m Driver), Unanswered> {
        let all = &model.drivers;
        let names = || all.keys().map(String::as_str);
        let listed = || {
            names()
                .map(|name| format!("{name:?}"))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let (name, driver) = match (&self.driver, all.len()) {
            (_, 0) => {
                return Err(bad(
                    "the model has no driver, whose stroke the motion would go along; add one under \"drivers\"",
                ));
            }
            (Some(name), _) => {
                let found = all.get_key_value(name.as_str());
                let hint = || did_you_mean(name, names(), &format!("there are {}", listed()));
                found.ok_or_else(|| {
                    bad(format!(
                        "--driver {name:?}: no driver {name:?} ({})",
                        hint()
                    ))
                })?
            }
            (None, 1) => all.first().ok_or_else(|| bad("the driver is lost"))?,
            (None, _) => {
                return Err(bad(format!(
                    "which driver moves along the stroke? Say --driver: there are {}",
                    listed()
                )));
            }
        };
        let moves =
            |(other, own): &(&String, &Driver)| *other != name && !law(&own.motion).is_constant();
        match all.iter().find(moves) {
            None => Ok((name, driver)),
            Some((other, _)) => Err(bad(format!(
                "driver {other:?} moves, too, by its own motion over time, which is not known before the answer; let it stand still, as in \
                 --set \"drivers.{other}.motion={{\\\"type\\\":\\\"constant_velocity\\\",\\\"velocity\\\":0}}\""
            ))),
        }
    }
}
