//! IFToMM's four-bar with a diagonal spring: its equilibrium and small motions against closed forms.
//!
//! Formulas and source stand in `validation/four-bar-spring/SOURCE.md`.

use std::f64::consts::{PI, SQRT_2};

use super::{CaseError, CaseReport, Claim, Setting};
use linkdyn_engine::analysis::{self, Linearised};
use linkdyn_model::{self, Checked};
use linkdyn_output::Status;

/// A line about the case.
pub const ABOUT: &str = "IFToMM's four-bar with a diagonal spring: equilibrium, stiffness, frequency, damped eigenvalue";

const MODEL: &str = include_str!("../four-bar-spring/model.json");
/// m g \[N\], k [N/m], c [N·s/m], and the effective inertia [kg·m²].
const WEIGHT: f64 = 9.81;
const STIFFNESS: f64 = 25.0;
const DAMPING: f64 = 1.0;
const INERTIA: f64 = 5.0 / 3.0;
/// The equilibrium as published \[rad\], and half its last digit.
const PUBLISHED: f64 = 2.23433101898;
const PUBLISHED_TO: f64 = 5e-11;
/// Round-off of the formulas and of the engine's stiffness, with room for another libm.
const EXACT: f64 = 1e-11;

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let damped = linearise(&read(&[])?, setting)?;
    let undamped = linearise(&read(&["forces.diagonal.damping=0"])?, setting)?;
    let phi = equilibrium();
    let stiffness = curvature(phi);
    let damping = DAMPING * (0.5 * phi).sin().powi(2);
    let decay = -0.5 * damping / INERTIA;
    let angle = damped.bodies[0].1[2];
    let ours = damped.modes[0].eigenvalue;
    let claims = vec![
        Claim::near(
            "equilibrium as published [rad]",
            PUBLISHED,
            angle,
            PUBLISHED_TO,
        ),
        Claim::near("equilibrium by bisection [rad]", phi, angle, EXACT),
        Claim::near(
            "reduced stiffness by the rod's angle [N·m]",
            stiffness,
            damped.stiffness[0][0],
            EXACT * STIFFNESS,
        ),
        Claim::near(
            "effective inertia [kg·m²]",
            INERTIA,
            damped.mass[0][0],
            EXACT,
        ),
        Claim::near(
            "natural frequency without damping [rad/s]",
            (stiffness / INERTIA).sqrt(),
            undamped.modes[0].frequency(),
            EXACT,
        ),
        Claim::near("real part of the eigenvalue [1/s]", decay, ours[0], EXACT),
        Claim::near(
            "imaginary part [rad/s]",
            (stiffness / INERTIA - decay * decay).sqrt(),
            ours[1],
            EXACT,
        ),
    ];
    Ok(CaseReport {
        text: String::new(),
        claims,
    })
}

fn read(sets: &[&str]) -> Result<Checked, CaseError> {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_string()).collect();
    let loaded = linkdyn_model::load(MODEL.as_bytes(), &sets)
        .map_err(|said| CaseError::Broken(format!("{said:?}")))?;
    Ok(loaded.model)
}

fn linearise(model: &Checked, setting: &Setting) -> Result<Linearised, CaseError> {
    let found = analysis::modes(model, false, &setting.control)
        .map_err(|said| CaseError::Broken(format!("{said:?}")))?;
    if found.status == Status::Interrupted {
        return Err(CaseError::Interrupted);
    }
    // Of the parallelogram's equal motions the first angle is the coordinate.
    let by_angle = found
        .equilibrium
        .as_ref()
        .is_some_and(|found| found.coordinates[0].ends_with(".angle"));
    match (&found.message, found.modes.len(), by_angle) {
        (None, 1, true) => Ok(found),
        (Some(message), ..) => Err(CaseError::Broken(message.clone())),
        (None, modes, _) => Err(CaseError::Broken(format!(
            "{modes} modes, by {:?}",
            found.equilibrium
        ))),
    }
}

/// V′(φ) [N·m].
fn slope(phi: f64) -> f64 {
    2.0 * WEIGHT * phi.cos() - STIFFNESS * (2.0 * (0.5 * phi).cos() - SQRT_2) * (0.5 * phi).sin()
}

/// V″(φ) [N·m].
fn curvature(phi: f64) -> f64 {
    let (sin, cos) = (0.5 * phi).sin_cos();
    -2.0 * WEIGHT * phi.sin() + STIFFNESS * sin * sin - 0.5 * STIFFNESS * (2.0 * cos - SQRT_2) * cos
}

/// The root of V′ between the square and the flat linkage, beyond the one at the square itself.
fn equilibrium() -> f64 {
    let (mut left, mut right) = (2.0, 0.9 * PI);
    while right - left > f64::EPSILON * right {
        let middle = 0.5 * (left + right);
        if (slope(middle) > 0.0) == (slope(left) > 0.0) {
            left = middle
        } else {
            right = middle
        }
    }
    0.5 * (left + right)
}
