//! Small motions about rest: the equations of motion linearised in minimal coordinates, and their eigenvalues.
//!
//! ```text
//! M̂ ü + Ĉ u̇ + K̂ u = 0       u = x e^{s t},   (s² M̂ + s Ĉ + K̂) x = 0
//! ω₀ = |s|                   natural frequency [rad/s]
//! ζ = −Re s / |s|            damping ratio [–]
//! ```
//!
//! M̂, Ĉ, K̂ as in [`crate::mechanism::linearised_system`], drivers held. About the equilibrium, or about the assembled position as it is: what
//! is linearised there is the motion relative to the one that the unbalanced forces begin.

use super::assembly::Assembled;
use super::bent::straightened;
use super::control::{Control, Stop};
use super::equilibrium::{balance, start};
use super::sample::ContactSample;
use super::statics::{described, refuse, warning};
use super::words::friction_left_out;
use super::{ends, leaning};
use crate::element::Axis;
use crate::mechanism::equilibrium::{Balance, judge};
use crate::mechanism::linearised_system::LinearisedSystem;
use crate::system::{BodyPart, System, compile::compile_about_rest};
use linkdyn_linear::eigen::{EigenFault, Eigenpair, quadratic};
use linkdyn_model::Checked;
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_output::{Equilibrium, Mobility, Status};

/// A mechanism linearised.
#[derive(Debug, Clone, Default)]
pub struct Linearised {
    /// How it ended.
    pub status: Status,
    /// Why there are no modes.
    pub message: Option<String>,
    /// Degrees of freedom.
    pub mobility: Mobility,
    /// The position that it is linearised about.
    pub equilibrium: Option<Equilibrium>,
    /// Moving bodies, with x, y, angle of their frames where the mechanism rests [m, m, rad].
    pub bodies: Vec<(String, [f64; 3])>,
    /// Mass matrix M̂ by rows, by the coordinates of `equilibrium`.
    pub mass: Vec<Vec<f64>>,
    /// Damping matrix Ĉ, likewise.
    pub damping: Vec<Vec<f64>>,
    /// Stiffness matrix K̂, likewise.
    pub stiffness: Vec<Vec<f64>>,
    /// Slowest first.
    pub modes: Vec<Mode>,
    /// What to doubt.
    pub warnings: Vec<String>,
}

/// One mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// s: real part [1/s] and imaginary part [rad/s], the latter not negative.
    pub eigenvalue: [f64; 2],
    /// Per body x, y of its frame's origin \[m\] and angle \[rad\], each with real and imaginary part; the largest rotation, or
    /// displacement by the mechanism's size, is 1.
    pub shape: Vec<[[f64; 2]; 3]>,
}

impl Mode {
    /// ω₀ = |s| [rad/s].
    pub fn frequency(&self) -> f64 {
        self.eigenvalue[0].hypot(self.eigenvalue[1])
    }

    /// ζ [–]; `None` if nothing pulls back.
    pub fn damping_ratio(&self) -> Option<f64> {
        let frequency = self.frequency();
        (frequency > 0.0).then(|| {
            if self.eigenvalue[0] == 0.0 {
                0.0
            } else {
                -self.eigenvalue[0] / frequency
            }
        })
    }
}

/// Linearises a model about its equilibrium or, with `pose`, about its assembled position.
///
/// # Errors
/// Faults of the input; everything else ends in the status.
pub fn modes(model: &Checked, pose: bool, control: &Control) -> Result<Linearised, Complaints> {
    let system = straightened(model, compile_about_rest(model)?);
    match linearise(&system, pose, control) {
        Ok(found) => Ok(found),
        Err(Stop::Input(complaints)) => Err(complaints.into()),
        Err(Stop::Failed { status, message }) => Ok(Linearised {
            status,
            message: Some(message),
            mobility: super::assembly::counted(&system),
            ..Linearised::default()
        }),
    }
}

fn linearise(system: &System, pose: bool, control: &Control) -> Result<Linearised, Stop> {
    at_rest(system, pose, control, |assembled, held, balance, _| {
        about(assembled, held, balance, pose)
    })?
}

/// Calls `told` with the mechanism in its equilibrium or, with `pose`, where it is assembled, and with its contacts there.
///
/// # Errors
/// As of statics.
pub(super) fn at_rest<T>(
    system: &System,
    pose: bool,
    control: &Control,
    told: impl FnOnce(&Assembled, &mut LinearisedSystem, &Balance, &[ContactSample]) -> T,
) -> Result<T, Stop> {
    refuse(system)?;
    let (assembled, mut held) = start(system, 0.0, pose)?;
    if !system.contacts.is_empty() {
        let turned = ends::at_rest(system, &assembled.q);
        let system = turned.as_ref().unwrap_or(system);
        ends::check_start(system, &assembled.q)?;
        if !pose {
            // Stops that press at rest are springs, or hold.
            return leaning::rest(system, (&assembled.q, 0.0), control, told);
        }
        if let Some(latched) = leaning::latched_system(system, &assembled.q) {
            let (assembled, mut held) = start(&latched, 0.0, pose)?;
            let balance = judge(&mut held);
            return Ok(told(&assembled, &mut held, &balance, &[]));
        }
    }
    let balance = if pose {
        judge(&mut held)
    } else {
        balance(&mut held, &assembled, control, None)?
    };
    Ok(told(&assembled, &mut held, &balance, &[]))
}

/// Refuses a mechanism in which nothing is free to move.
fn free(held: &LinearisedSystem) -> Result<(), Stop> {
    if held.freedom() > 0 {
        return Ok(());
    }
    Err(Stop::Input(vec![
        Complaint::new(
            "drivers",
            "modes need something that is free to move; drivers and joints hold everything",
        )
        .hint("leave out a driver"),
    ]))
}

/// Small motions about where a mechanism is held.
fn about(
    assembled: &Assembled,
    held: &mut LinearisedSystem,
    balance: &Balance,
    pose: bool,
) -> Result<Linearised, Stop> {
    free(held)?;
    let system = held.driven.system;
    let (mass, damping, stiffness) = (held.mass(), held.damping(), held.stiffness());
    let f = held.freedom();
    let pairs = quadratic(&mass, &damping, &stiffness, f).map_err(|fault| match fault {
        EigenFault::Massless => Stop::Input(vec![
            Complaint::new(
                "bodies",
                "something free to move has neither mass nor inertia",
            )
            .hint("give mass and inertia to what the joints leave free"),
        ]),
        EigenFault::NoConvergence => {
            Stop::failed(Status::Singular, "the eigenvalues do not converge".into())
        }
    })?;
    let by_rows = |a: &[f64]| a.chunks_exact(f).map(<[f64]>::to_vec).collect();
    let mut warnings = assembled.warnings.clone();
    warnings.extend(warning(balance).filter(|_| !pose));
    warnings.extend(friction_left_out(system));
    Ok(Linearised {
        mobility: assembled.mobility.clone(),
        equilibrium: Some(described(held, balance)),
        bodies: bodies(held),
        mass: by_rows(&mass),
        damping: by_rows(&damping),
        stiffness: by_rows(&stiffness),
        modes: pairs.iter().map(|pair| mode(held, pair)).collect(),
        warnings,
        ..Linearised::default()
    })
}

/// Names and places of the moving bodies' frames.
fn bodies(held: &LinearisedSystem) -> Vec<(String, [f64; 3])> {
    let system = held.driven.system;
    let bodies = system.bodies.iter().zip(system.layout.bodies());
    bodies
        .filter(|(body, _)| body.part() != BodyPart::MassPoint)
        .map(|(body, columns)| {
            let [x, y, theta] = columns.read(&held.q);
            let rho = crate::element::Pose::new(x, y, theta).turn(body.origin);
            (body.name.clone(), [x + rho.x, y + rho.y, theta])
        })
        .collect()
}

/// An eigenvector as motions of the bodies' frames.
fn mode(held: &LinearisedSystem, pair: &Eigenpair) -> Mode {
    let [re, im] =
        [0, 1].map(|part| held.along(&pair.vector.iter().map(|x| x[part]).collect::<Vec<_>>()));
    let system = held.driven.system;
    let mut shape: Vec<[[f64; 2]; 3]> = Vec::with_capacity(system.bodies.len());
    let bodies = system.bodies.iter().zip(system.layout.bodies());
    for (body, columns) in bodies.filter(|(body, _)| body.part() != BodyPart::MassPoint) {
        let angle = held.q[columns.theta()];
        let rho = crate::element::Pose::new(0.0, 0.0, angle).turn(body.origin);
        let of = |s: &[f64]| {
            let [x, y, theta] = columns.read(s);
            [x - theta * rho.y, y + theta * rho.x, theta]
        };
        let (re, im) = (of(&re), of(&im));
        shape.push([0, 1, 2].map(|axis| [re[axis], im[axis]]));
    }
    normalise(&mut shape, system);
    Mode {
        eigenvalue: pair.value,
        shape,
    }
}

/// Divides by the largest component, so that it becomes 1.
fn normalise(shape: &mut [[[f64; 2]; 3]], system: &System) {
    let mut largest = ([1.0, 0.0], 0.0);
    for place in shape.iter() {
        for (value, axis) in place.iter().zip(Axis::ALL) {
            let scale = system.axis_scale(axis);
            let size = value[0].hypot(value[1]) / scale;
            // Of equal ones the first, whatever the round-off.
            if size > largest.1 * (1.0 + 1e-9) {
                largest = (value.map(|part| part / scale), size);
            }
        }
    }
    let ([re, im], size) = largest;
    if size > 0.0 {
        let square = size * size;
        for value in shape.iter_mut().flatten() {
            let [a, b] = *value;
            // Adding zero turns −0 into 0.
            *value = [
                (a * re + b * im) / square + 0.0,
                (b * re - a * im) / square + 0.0,
            ];
        }
    }
}
