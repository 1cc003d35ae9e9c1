//! Values that are allowed and still look like a slip: of units, of a factor of thousand, of degrees and radians.
//!
//! Each bound is generous: what lies beyond it is rarely meant, what lies within it may be wrong all the same.

mod angles;
mod bodies;
mod lengths;
mod pressures;
mod times;

use std::f64::consts::TAU;

use crate::analysis::instants::MOST_OUTPUTS;
use crate::system::compile::law;
use bodies::{DIGITS, extent, moving};
use linkdyn_model::display::number;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Analysis, AnalysisKind, DriverKind, GROUND, JointKind, Model, Motion, Value};
pub(super) use times::tables;

/// One mass of all may be this times larger or smaller than the middle one [–].
const MASS_SPREAD: f64 = 300.0;
/// Radius of gyration against the distance of the points, squared: kg·mm² taken for kg·cm² lie within, for kg·m² do not [–].
const INERTIA_SPREAD: f64 = 1000.0;
/// Gravity from that of a small moon to that of a large planet [m/s²].
const GRAVITY: [f64; 2] = [0.05, 30.0];
/// Outputs per turn or period below this show another motion than there is.
const LEAST_OUTPUTS: f64 = 8.0;

/// What looks like a slip in the model; `degrees`: plain angles are in degrees.
pub fn suspicious(model: &Model, degrees: bool) -> Vec<Complaint> {
    let whole = lengths::whole(model);
    let all_doubtful = whole.is_some();
    let lengths = whole.map_or_else(|| lengths::lengths(model), |complaint| vec![complaint]);
    let mut found = Vec::new();
    masses(model, &mut found);
    inertias(model, &mut found);
    gravity(model, &mut found);
    angles::angles(model, degrees, &mut found);
    clearances(model, &mut found);
    found.extend(pressures::pressures(model));
    if let Some(analysis) = &model.analysis {
        speeds(model, analysis, &mut found);
    }
    // A body of doubtful lengths is not blamed for its inertia.
    let doubtful = |body: &str| {
        all_doubtful
            || lengths
                .iter()
                .any(|slip| slip.path.rsplit_once('.').is_some_and(|(of, _)| of == body))
    };
    found.retain(|complaint| {
        !complaint
            .path
            .strip_suffix(".inertia")
            .is_some_and(doubtful)
    });
    [lengths, found].concat()
}

/// The middle one of some positive values.
fn middle(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len().checked_sub(1)? / 2).copied()
}

fn masses(model: &Model, found: &mut Vec<Complaint>) {
    let masses: Vec<(&String, f64)> = moving(model)
        .filter_map(|(name, body)| Some((name, body.mass?)))
        .filter(|(_, mass)| *mass > 0.0)
        .collect();
    let Some(middle) = middle(masses.iter().map(|(_, mass)| *mass).collect()) else {
        return;
    };
    let text = |mass: f64| model.display.mass_to(mass, DIGITS);
    for (name, mass) in masses {
        let ratio = mass / middle;
        if !(1.0 / MASS_SPREAD..=MASS_SPREAD).contains(&ratio) {
            let than = if ratio > 1.0 { "heavy" } else { "light" };
            found.push(
                Complaint::new(
                    format!("bodies.{name}.mass"),
                    format!(
                        "the body is {than}, {}, where others weigh near {}",
                        text(mass),
                        text(middle)
                    ),
                )
                .hint("check the unit: a plain mass is in kg unless \"units\" names another"),
            );
        }
    }
}

fn inertias(model: &Model, found: &mut Vec<Complaint>) {
    let size = moving(model)
        .map(|(_, body)| extent(body))
        .fold(0.0, f64::max);
    for (name, body) in moving(model) {
        let (Some(mass), Some(inertia), Some(com)) = (body.mass, body.inertia, body.com) else {
            continue;
        };
        let radius = body
            .points
            .values()
            .map(|p| (p[0] - com[0]).hypot(p[1] - com[1]))
            .fold(0.0, f64::max);
        // Without mass or inertia it is a massless rod or a point mass, and meant.
        if mass == 0.0 || inertia == 0.0 || size == 0.0 {
            continue;
        }
        let gyration = (inertia / mass).sqrt();
        let (than, of) = if inertia * INERTIA_SPREAD < mass * radius * radius {
            ("small", radius)
        } else if inertia > INERTIA_SPREAD * mass * size * size {
            ("large", size)
        } else {
            continue;
        };
        found.push(
            Complaint::new(
                format!("bodies.{name}.inertia"),
                format!(
                    "the inertia is {than}: that of the mass at {}, where the body reaches {}",
                    model.display.length_to(gyration, DIGITS),
                    model.display.length_to(of, DIGITS)
                ),
            )
            .hint("check the unit: a plain inertia is in kg*m^2 unless \"units\" names another"),
        );
    }
}

fn gravity(model: &Model, found: &mut Vec<Complaint>) {
    let g = model.gravity[0].hypot(model.gravity[1]);
    if g > 0.0 && !(GRAVITY[0]..=GRAVITY[1]).contains(&g) {
        let message = format!(
            "gravity is {} m/s^2, that of the earth is 9.81 m/s^2",
            number(g, DIGITS)
        );
        found.push(Complaint::new("gravity", message).hint(
            "a plain number is in m/s^2 whatever the unit of length; write 9.81, or its unit, as in \"9810 mm/s^2\"",
        ));
    }
}

fn clearances(model: &Model, found: &mut Vec<Complaint>) {
    let text = |length: f64| model.display.length_to(length, DIGITS);
    for (name, joint) in &model.joints {
        let JointKind::Revolute {
            clearance: Some(clearance),
            ..
        } = &joint.kind
        else {
            continue;
        };
        let Some(radius) = clearance.radius else {
            continue;
        };
        let path = format!("joints.{name}.clearance.radius");
        if let Some(bearing) = clearance
            .bearing_radius
            .filter(|bearing| radius >= *bearing)
        {
            let message = format!(
                "the radial clearance, {}, leaves no journal in a bearing of {}",
                text(radius),
                text(bearing)
            );
            found.push(
                Complaint::new(path, message)
                    .hint("radius is the bearing's radius minus the journal's"),
            );
            continue;
        }
        let ends = joint
            .between
            .iter()
            .filter(|end| end.body != GROUND)
            .filter_map(|end| model.bodies.get(&end.body));
        let shortest = ends
            .map(extent)
            .filter(|extent| *extent > 0.0)
            .fold(f64::INFINITY, f64::min);
        if radius >= shortest {
            let message = format!(
                "the radial clearance, {}, is longer than the link, {}",
                text(radius),
                text(shortest)
            );
            found.push(
                Complaint::new(path, message)
                    .hint("check its unit: clearances are mostly some micrometres"),
            );
        }
    }
}

/// Motions that go further between two outputs than they can show.
fn speeds(model: &Model, analysis: &Analysis, found: &mut Vec<Complaint>) {
    if matches!(
        analysis.kind,
        AnalysisKind::Assembly | AnalysisKind::Statics
    ) {
        return;
    }
    if let Some(sample) = &analysis.sample {
        let turns = model
            .drivers
            .get(&sample.driver)
            .is_some_and(|d| matches!(d.kind, DriverKind::Rotation { .. }));
        let per_turn = TAU / sample.step.abs();
        if turns && per_turn < LEAST_OUTPUTS {
            let message = format!(
                "{} outputs per turn show another motion than there is",
                number(per_turn, DIGITS)
            );
            found.push(Complaint::new("analysis.sample.step", message).hint("take a smaller step"));
        }
        return;
    }
    let (Some(end), Some(outputs)) = (analysis.end, analysis.outputs) else {
        return;
    };
    let step = end / (outputs.max(2) - 1) as f64;
    let mut look = |path: String, per_turn: f64, what: &str| {
        if per_turn < LEAST_OUTPUTS {
            let message = format!(
                "{} outputs per {what}, one every {}: they show another motion than there is",
                number(per_turn, DIGITS),
                model.display.time_to(step, DIGITS)
            );
            let enough = (LEAST_OUTPUTS / per_turn * outputs as f64).ceil();
            let more = if enough <= MOST_OUTPUTS as f64 {
                format!("\"outputs\" of {enough} or more, ")
            } else {
                String::new()
            };
            let hint = format!("take {more}a shorter \"end\", or check the unit of the motion");
            found.push(Complaint::new(path, message).hint(hint));
        }
    };
    for (name, driver) in &model.drivers {
        let path = format!("drivers.{name}.motion");
        if let Motion::Harmonic { frequency, .. } = &driver.motion {
            look(path, 1.0 / (frequency.abs() * step), "period");
        } else if matches!(driver.kind, DriverKind::Rotation { .. }) {
            let law = law(&driver.motion);
            let fastest = (0..=64)
                .map(|k| law.jet(end * f64::from(k) / 64.0)[1].abs())
                .fold(0.0, f64::max);
            look(path, TAU / (fastest * step), "turn");
        }
    }
    for (name, force) in &model.forces {
        for (_, value, _) in force.kind.values() {
            if let Value::Motion(Motion::Harmonic { frequency, .. }) = value {
                look(
                    format!("forces.{name}"),
                    1.0 / (frequency.abs() * step),
                    "period",
                );
            }
        }
    }
}
