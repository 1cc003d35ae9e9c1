//! The fastest motion along a stroke: the driver's law of time with which limits of effort, speed and joint forces are just kept.
//!
//! | file           | does                                                    |
//! | -------------- | ------------------------------------------------------- |
//! | `asked`        | the stroke in words                                     |
//! | `bounds`       | limits in words, and their columns                      |
//! | `coefficients` | limited numbers by ẍ and ẋ², from the engine            |
//! | `law`          | the convex problem, with limits between nodes           |
//! | `written`      | the model with the law, and what a run of it shows      |
//! | `text`, `json`, `page` | the answer                                      |

mod asked;
mod bounds;
mod coefficients;
mod json;
mod law;
mod page;
mod text;
mod written;

use linkdyn_engine::analysis::{AlongStroke, Control, Prepared, Stop};
use linkdyn_output::{Column, Status, Stopwatch, Trajectory};

use crate::put::{Put, read};
use crate::{ModelFile, Question, Unanswered};
use asked::{Stroke, steady};
use bounds::{Bound, Of, bounds};
use coefficients::Coefficients;
use law::{Law, places, stands};

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

/// The fastest motion.
pub struct FastestMotion {
    /// The model.
    pub file: ModelFile,
    stroke: Stroke,
    /// Unit of the driver's value: rad or m.
    unit: &'static str,
    bounds: Vec<Bound>,
    coefficients: Coefficients,
    law: Law,
    /// The model with the law.
    written: ModelFile,
    run: Trajectory,
    /// The largest excess over a limit in a run of it, by the limit, with its bound and instant.
    excess: (f64, usize, f64),
    /// Time for the coefficients and for the law \[s\].
    seconds: [f64; 2],
}

impl Question for PathTime {
    type Answer = FastestMotion;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<FastestMotion, Unanswered> {
        let stroke = self.stroke(file)?;
        let unit = unit(file, &stroke)?;
        let analysis = r#"{"type":"inverse_dynamics","end":"1 s","outputs":2}"#;
        let puts = [
            steady(&stroke, unit),
            Put::new("analysis".into(), analysis, "the stroke".into()),
        ];
        let moving = read(&file.text, &file.sets, &puts)?;
        let prepared = Prepared::new(moving.model()).map_err(|why| file.refused(why))?;
        let stop = |stop: Stop| match stop {
            Stop::Input(complaints) => file.refused(complaints.into()),
            Stop::Failed {
                status: Status::Interrupted,
                ..
            } => Unanswered::Interrupted,
            Stop::Failed { message, .. } => Unanswered::Failed(message),
        };
        let driver = prepared.system().drivers.iter();
        let driver = driver
            .map(|own| &own.name)
            .position(|own| *own == stroke.driver);
        let clock = Stopwatch::start();
        let mut along =
            AlongStroke::new(&prepared, driver.unwrap_or_default(), control).map_err(stop)?;
        let bounds = self.bounds(&stroke, unit, along.columns(), &moving)?;
        let places = places(stroke.intervals);
        let coefficients = Coefficients::new(&mut along, &stroke, &bounds, places)?;
        let display = &file.model().display;
        let place = |value: f64| match unit {
            "rad" => display.angle(value),
            _ => display.length(value),
        };
        stands(&stroke, &bounds, &coefficients, place)?;
        let of_coefficients = clock.read().wall;
        let clock = Stopwatch::start();
        let law = Law::new(&stroke, &bounds, &coefficients)?;
        let seconds = [of_coefficients, clock.read().wall];
        let written = written::model(file, &stroke, unit, &law)?;
        let (run, excess) = written::check(&written, &bounds, &law, control)?;
        Ok(FastestMotion {
            file: file.clone(),
            stroke,
            unit,
            bounds,
            coefficients,
            law,
            written,
            run,
            excess,
            seconds,
        })
    }
}

/// The SI unit of the driver's value.
fn unit(file: &ModelFile, stroke: &Stroke) -> Result<&'static str, Unanswered> {
    use linkdyn_model::DriverKind;
    let driver = file.model().drivers.get(&stroke.driver);
    let driver = driver.ok_or_else(|| Unanswered::question("the driver is lost"))?;
    Ok(match driver.kind {
        DriverKind::Rotation { .. } => "rad",
        DriverKind::Translation { .. } | DriverKind::Length { .. } | DriverKind::Point { .. } => {
            "m"
        }
    })
}

impl PathTime {
    /// All limits; there is at least one.
    fn bounds(
        &self,
        stroke: &Stroke,
        unit: &str,
        columns: &[Column],
        file: &ModelFile,
    ) -> Result<Vec<Bound>, Unanswered> {
        let mut all = Vec::new();
        for text in &self.limits {
            all.extend(bounds(text, columns, file)?);
        }
        let [speed, acceleration] = match unit {
            "rad" => ["rad/s", "rad/s^2"],
            _ => ["m/s", "m/s^2"],
        };
        let most = stroke
            .speed
            .map(|most| Bound::of("speed", speed, Of::Speed, most));
        all.extend(most);
        let most = stroke.acceleration;
        all.extend(
            most.map(|most| Bound::of("acceleration", acceleration, Of::Acceleration, most)),
        );
        match all.is_empty() {
            true => Err(Unanswered::question(
                "nothing is limited: say --limit \"driver.motor.effort=5 N*m\", --speed or --acceleration",
            )),
            false => Ok(all),
        }
    }
}

impl FastestMotion {
    /// The model with the law of motion, and an analysis that runs it.
    pub fn model(&self) -> &ModelFile {
        &self.written
    }

    /// How long the motion takes \[s\].
    pub fn time(&self) -> f64 {
        self.law.found.time
    }
}

#[cfg(test)]
mod tests;
