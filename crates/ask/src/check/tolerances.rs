//! What `check` says of tolerances, ranges of clearance, and outputs whose accuracy is requested.

use linkdyn_model::display::DisplayUnits;
use linkdyn_model::{
    AccuracyOutput, Clearance, Dimension, Distribution, Driver, DriverKind, Joint, JointKind,
    Loaded, Measured, Model, Parameter, Pins,
};
use serde::Serialize;

use crate::text::{Page, number, shorten, wrapped};

/// Width of long texts on the page.
const WIDTH: usize = 96;
/// Digits of deviations.
const DIGITS: usize = 6;

/// Rows of a model that has such words, none of another.
pub fn rows(page: &mut Page, loaded: &Loaded) {
    let model: &Model = &loaded.model;
    let units = &model.display;
    let drivers = model.drivers.iter();
    let points = model.bodies.iter().flat_map(|(body, words)| {
        let zones = words.point_tolerances.iter();
        zones.map(move |(point, zone)| format!("{body}.{point} ⌀{}", units.length(*zone)))
    });
    let tolerances = loaded.parameters.iter();
    let tolerances = tolerances
        .filter_map(|parameter| of_parameter(parameter, units))
        .chain(drivers.filter_map(|(name, driver)| of_driver(name, driver, units)))
        .chain(points);
    page.rows("tolerances", folded(tolerances));
    let joints = model.joints.iter();
    page.rows(
        "clearances",
        folded(joints.filter_map(|(name, joint)| of_joint(name, joint, units))),
    );
    let Some(accuracy) = &model.accuracy else {
        return;
    };
    let outputs = accuracy.outputs.iter();
    let outputs = outputs.map(|(name, output)| format!("{name}: {}", of_output(output, model)));
    let pins = match accuracy.pins {
        Pins::Worst => "where they move the output most",
        Pins::Load => "on the side of the load",
        Pins::Rim => "anywhere on the rim",
        Pins::Disc => "anywhere in their clearance",
        Pins::None => "in the middle",
    };
    let pins = format!("pins: {pins}");
    page.rows("accuracy", folded(outputs.chain([pins])));
}

/// A parameter for programs.
#[derive(Serialize)]
pub struct ParameterJson<'a> {
    value: f64,
    unit: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<ToleranceJson>,
}

#[derive(Serialize)]
struct ToleranceJson {
    lower: f64,
    upper: f64,
    distribution: &'static str,
    sigma: Option<f64>,
    cost: Option<f64>,
}

impl<'a> From<&'a Parameter> for ParameterJson<'a> {
    fn from(parameter: &'a Parameter) -> Self {
        let tolerance = parameter.tolerance.map(|tolerance| {
            let (distribution, sigma) = match tolerance.distribution {
                Distribution::Normal { sigma } => ("normal", Some(sigma)),
                Distribution::Uniform => ("uniform", None),
                Distribution::Triangular => ("triangular", None),
            };
            ToleranceJson {
                lower: tolerance.lower,
                upper: tolerance.upper,
                distribution,
                sigma,
                cost: tolerance.cost,
            }
        });
        ParameterJson {
            value: parameter.value,
            unit: &parameter.unit,
            tolerance,
        }
    }
}

fn folded(rows: impl Iterator<Item = String>) -> Vec<String> {
    let rows = shorten(rows.collect());
    rows.iter().flat_map(|row| wrapped(row, WIDTH)).collect()
}

/// A quantity in the unit of the file, or in SI.
fn text(value: f64, dimension: Option<Dimension>, unit: &str, units: &DisplayUnits) -> String {
    match dimension {
        Some(Dimension::Length) => units.length(value),
        Some(Dimension::Angle) => units.angle(value),
        Some(_) | None => format!("{} {unit}", number(value, DIGITS))
            .trim_end()
            .to_owned(),
    }
}

/// Deviations, to either side or both.
fn deviations([lower, upper]: [f64; 2], text: impl Fn(f64) -> String) -> String {
    let signed = |value: f64| {
        let sign = if value > 0.0 { "+" } else { "" };
        format!("{sign}{}", text(value))
    };
    if lower == -upper {
        format!("±{}", text(upper))
    } else {
        format!("{} to {}", signed(lower), signed(upper))
    }
}

fn of_parameter(parameter: &Parameter, units: &DisplayUnits) -> Option<String> {
    let tolerance = parameter.tolerance?;
    let text = |value: f64| text(value, parameter.dimension, &parameter.unit, units);
    let mut row = format!(
        "{} {}",
        parameter.name,
        deviations([tolerance.lower, tolerance.upper], text)
    );
    row += &match tolerance.distribution {
        Distribution::Normal { sigma } => format!(", normal, {} σ", number(sigma, DIGITS)),
        Distribution::Uniform => ", uniform".to_owned(),
        Distribution::Triangular => ", triangular".to_owned(),
    };
    if let Some(cost) = tolerance.cost {
        row += &format!(", costs {} / t", text(cost));
    }
    Some(row)
}

fn of_driver(name: &str, driver: &Driver, units: &DisplayUnits) -> Option<String> {
    let tolerance = driver.tolerance?;
    let text = match driver.kind {
        DriverKind::Rotation { .. } => units.angle(tolerance),
        DriverKind::Translation { .. } | DriverKind::Length { .. } | DriverKind::Point { .. } => {
            units.length(tolerance)
        }
    };
    Some(format!("driver {name} ±{text}"))
}

/// A range of clearance, play or backlash; a radius alone shows elsewhere.
fn of_joint(name: &str, joint: &Joint, units: &DisplayUnits) -> Option<String> {
    match &joint.kind {
        JointKind::Revolute { clearance, .. } => of_clearance(name, clearance.as_deref()?),
        JointKind::Prismatic { play, .. } | JointKind::Slot { play, .. } => {
            let play = (*play)?;
            Some(format!("{name} ±{} of play", range(play.least, play.most)))
        }
        JointKind::Gear { backlash, .. } => {
            let backlash = units.length((*backlash)?);
            Some(format!("{name} {backlash} of backlash"))
        }
        _ => None,
    }
}

/// Lengths \[m\] in micrometres, as clearances are reported.
fn range(least: f64, most: f64) -> String {
    let [first, last] = [least, most].map(|value| number(value * 1e6, DIGITS));
    if least == most {
        format!("{first} µm")
    } else {
        format!("{first} to {last} µm")
    }
}

fn of_clearance(name: &str, clearance: &Clearance) -> Option<String> {
    clearance.range?;
    let [least, most] = clearance.limits()?;
    let row = format!("{name} {}", range(least, most));
    let Some(fit) = clearance.read_fit() else {
        return Some(row);
    };
    let [hole, shaft] =
        [fit.hole, fit.shaft].map(|both| both.map(|value| format!("{}", value + 0.0)).join(" to "));
    let words = clearance.fit.as_deref().unwrap_or_default();
    Some(format!("{row} ({words}: hole {hole} µm, shaft {shaft} µm)"))
}

fn of_output(output: &AccuracyOutput, model: &Model) -> String {
    let units = &model.display;
    let (what, dimension) = match &output.of {
        Measured::Column(column) => (column.clone(), output.of.dimension(model)),
        Measured::Distance([first, second]) => (
            format!("distance of {first} and {second}"),
            Some(Dimension::Length),
        ),
    };
    let place = match &output.at {
        None => "over the stroke".to_owned(),
        Some(at) => {
            let alone = || model.drivers.keys().next().cloned().unwrap_or_default();
            let name = at.driver.clone().unwrap_or_else(alone);
            let value = match model.drivers.get(&name).map(|driver| &driver.kind) {
                Some(
                    DriverKind::Translation { .. }
                    | DriverKind::Length { .. }
                    | DriverKind::Point { .. },
                ) => units.length(at.value),
                Some(DriverKind::Rotation { .. }) | None => units.angle(at.value),
            };
            format!("at {name} {value}")
        }
    };
    let unit = dimension.map(Dimension::si).unwrap_or_default();
    let limits = output.limits.map(|limits| {
        let limits = deviations(limits, |value| text(value, dimension, unit, units));
        format!(", limits {limits}")
    });
    format!("{what} {place}{}", limits.unwrap_or_default())
}
