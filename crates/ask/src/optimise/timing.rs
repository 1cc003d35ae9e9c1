//! The analysis that gives the path of a point: the model's own motion, or one in which the driver moves evenly.

use std::f64::consts::TAU;

use linkdyn_engine::analysis::{Control, Prepared};
use linkdyn_model::{DriverKind, Model, PointRef};
use serde_json::json;

use super::target::Target;
use crate::{ModelFile, Unanswered};

/// A driver that turns or slides by one unit a second, so that time says where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Timing {
    driver: String,
    unit: &'static str,
    /// Where it starts [rad or m].
    start: f64,
    /// −1 where it goes down.
    sign: f64,
    /// When it is at each of the wanted values [s].
    pub times: Vec<f64>,
}

/// Values behind the start by less than this part of the whole are at the start.
const AT_START: f64 = 1e-9;

impl Timing {
    /// Of a curve with values of the driver; `None` if it does not matter when.
    ///
    /// # Errors
    /// A model that can't be put together as it is, and values that lie on both sides of where a slide starts.
    pub fn new(file: &ModelFile, target: &Target) -> Result<Option<Self>, Unanswered> {
        let Some((curve, at)) = target
            .curve
            .as_ref()
            .and_then(|own| Some((own, own.at.as_ref()?)))
        else {
            return Ok(None);
        };
        let drivers = &file.model().drivers;
        let named = curve.driver.as_ref().or(drivers.keys().next());
        let Some((name, driver)) = named.and_then(|name| drivers.get_key_value(name)) else {
            return Ok(None);
        };
        let start = start(file, name)?;
        let turns = matches!(driver.kind, DriverKind::Rotation { .. });
        let mut off: Vec<f64> = at.iter().map(|value| value - start).collect();
        let size = off.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        let is_ahead = |own: &f64| *own >= -AT_START * size;
        let sign = match off.iter().all(|own| is_ahead(&-own)) {
            true if size > 0.0 => -1.0,
            _ => 1.0,
        };
        for own in &mut off {
            *own *= sign;
            // A shaft comes there again, a turn later.
            while turns && !is_ahead(own) {
                *own += TAU;
            }
        }
        if let Some(place) = off.iter().position(|own| !is_ahead(own)) {
            return Err(Unanswered::question(format!(
                "optimise.curve.at[{place}]: driver {name:?} starts at {start} m and moves one way: give values on one side of it"
            )));
        }
        Ok(Some(Timing {
            driver: name.clone(),
            unit: if turns { "rad" } else { "m" },
            start,
            sign,
            times: off.into_iter().map(|own| own.max(0.0)).collect(),
        }))
    }
}

/// Where a driver stands at first.
fn start(file: &ModelFile, name: &str) -> Result<f64, Unanswered> {
    let with = file.with(&alone("{\"type\":\"assembly\"}"));
    let with = with.map_err(|said| file.refused(said))?;
    let run = Prepared::new(with.model()).and_then(|own| own.run(&Control::default()));
    let outcome = run.map_err(|said| with.refused(said))?;
    let value = outcome.all().values(&format!("driver.{name}.value"));
    let value = value.and_then(|values| values.first().copied());
    value.ok_or_else(|| {
        let why = outcome.report.message;
        let why = why.unwrap_or_else(|| "it has no position".to_owned());
        let label = file.label();
        Unanswered::question(format!("{label}: it can't be put together as it is: {why}"))
    })
}

/// What is set for an analysis without what other analyses may not have: responses, and the question itself.
fn alone(analysis: impl std::fmt::Display) -> Vec<String> {
    vec![
        format!("analysis={analysis}"),
        "responses={}".to_owned(),
        "optimise=null".to_owned(),
    ]
}

/// What is set for a path with so many rows.
pub fn sets(model: &Model, point: &PointRef, timing: Option<&Timing>, rows: usize) -> Vec<String> {
    let mut sets = Vec::new();
    if !model.points.contains(point) {
        let all = model.points.iter().chain([point]).map(ToString::to_string);
        sets.push(format!("points={}", json!(all.collect::<Vec<_>>())));
    }
    let seconds = |time: f64| format!("{time:e} s");
    let sample = model.analysis.as_ref().and_then(|own| own.sample.as_ref());
    let analysis = match (timing, sample) {
        (Some(timing), _) => {
            let (start, sign, unit) = (timing.start, timing.sign, timing.unit);
            let motion = json!({ "type": "polynomial",
                "coefficients": [format!("{start:e} {unit}"), format!("{sign:e} {unit}/s")] });
            sets.push(format!("drivers.{}.motion={motion}", timing.driver));
            let end = timing.times.iter().copied().fold(0.0, f64::max);
            json!({ "type": "kinematics", "end": seconds(end), "outputs": rows })
        }
        (None, Some(sample)) => {
            let unit = match model.drivers.get(&sample.driver).map(|own| &own.kind) {
                Some(
                    DriverKind::Translation { .. }
                    | DriverKind::Length { .. }
                    | DriverKind::Point { .. },
                ) => "m",
                Some(DriverKind::Rotation { .. }) | None => "rad",
            };
            let step = (sample.to - sample.from).abs() / (rows - 1) as f64;
            let value = |value: f64| format!("{value:e} {unit}");
            json!({ "type": "kinematics", "sample": { "driver": sample.driver,
                "from": value(sample.from), "to": value(sample.to), "step": value(step) } })
        }
        (None, None) => {
            let end = model
                .analysis
                .as_ref()
                .and_then(|own| own.end)
                .unwrap_or(0.0);
            json!({ "type": "kinematics", "end": seconds(end), "outputs": rows })
        }
    };
    sets.extend(alone(analysis));
    sets
}
