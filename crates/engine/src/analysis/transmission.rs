//! Motion and force from a driver to an output body: velocity ratio, mechanical advantage, transmission angles.
//!
//! ```text
//! ratio        i = ∂y/∂s          y the output's angle or slide, s the driver's value, other drivers held
//! advantage    A = 1/i            output load per driver effort, without mass and friction (virtual work)
//! angle        sin μ = |f·v|/(|f||v|), 0 ≤ μ ≤ 90°
//! ```
//!
//! f is the force in a joint of the output body when the output carries a unit load and nothing has mass, v the velocity of the output
//! body's point there. Where one two-force coupler drives the output, f lies along it, and μ is Alt's transmission angle
//! between coupler and output link; with a slider, between coupler and the normal of the guide. For ternary links the same definition
//! holds (90° − pressure angle). i is found from J S = e, f from Jᵀ λ = b, by the factors of one Jacobian per row, so that
//! a driver at rest has a ratio, too. Where the point stands still (its carrier is welded to ground, held by another driver, or the
//! output turns back) or the joint carries nothing, v or f has no direction and μ does not exist: the cell is empty, and a note says why.
//! Checked against triangles, and against the same mechanism on ground, in `tests/transmission.rs` and `tests/report.rs`.

use super::rows::{Columns, Frame};
use super::shaking::axis;
use crate::element::{BodyId, Instant, Measure};
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, System};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::{GROUND, JointKind, Model, Transmission};
use linkdyn_output::{Column, Trajectory};

/// Forces below this part of the largest are none: round-off of the solve.
const NO_FORCE: f64 = 1e-9;
/// Velocities below this part of the mechanism's largest are none, for the same reason.
const NO_MOTION: f64 = 1e-9;

/// Coordinate of the output: its angle, or its slide along a direction fixed in the ground.
#[derive(Debug, Clone, Copy)]
struct Output {
    body: usize,
    slide: Option<Vec2>,
}

/// A joint of the output body that is not on ground: its name, its blocks' number, the side on the output.
struct Drawn<'m> {
    name: &'m str,
    joint: usize,
    side: usize,
    /// Rows in which the output's point there stands still.
    still: usize,
    /// Rows in which the joint carries nothing.
    idle: usize,
}

/// Columns and rows of the transmission that the analysis names, and what there is to say about empty cells.
///
/// # Errors
/// Why there is none, in a sentence.
pub fn transmission(
    model: &Model,
    system: &System,
    wanted: &Transmission,
    table: &Trajectory,
) -> Result<(Trajectory, Vec<String>), String> {
    let undetermined = || {
        "the drivers alone do not determine the motion, so that there is no transmission"
            .to_string()
    };
    let driver = match &wanted.driver {
        Some(name) => system
            .drivers
            .iter()
            .position(|driver| driver.name == *name),
        None => (system.drivers.len() == 1).then_some(0),
    };
    let (Some(driver), Some(output)) = (driver, output(model, system, &wanted.output)) else {
        return Err(undetermined());
    };
    if system.m() < system.n() {
        return Err(undetermined());
    }
    let columns = Columns::of(table);
    let frames: Option<Vec<Frame>> = system
        .bodies
        .iter()
        .map(|body| Frame::of(&columns, &body.name))
        .collect();
    let Some(frames) = frames else {
        return Err(undetermined());
    };
    let mut drawn: Vec<Drawn> = model
        .joints
        .iter()
        .zip(&system.joints)
        .enumerate()
        .filter_map(|(joint, ((name, words), data))| {
            let carries = matches!(
                words.kind,
                JointKind::Revolute { .. } | JointKind::Slot { .. }
            );
            let side = data
                .bodies
                .iter()
                .position(|&body| body == BodyId(output.body + 1))?;
            (carries && data.bodies[1 - side] != BodyId::GROUND).then_some(Drawn {
                name,
                joint,
                side,
                still: 0,
                idle: 0,
            })
        })
        .collect();
    let mut result = Trajectory::new(headings(system, driver, output, &drawn));
    let (n, m) = (system.n(), system.m());
    let inputs = Inputs::still(system);
    let mut unit = inputs.clone();
    unit.drive[driver][1] = 1.0;
    let (mut q, mut v, mut load, mut lambda) =
        (vec![0.0; n], vec![0.0; n], vec![0.0; n], vec![0.0; m]);
    let mut solver: Option<Driven> = None;
    let mut line = Vec::with_capacity(result.width());
    for row in table.rows() {
        line.clear();
        for (k, frame) in frames.iter().enumerate() {
            let (origin, angle) = frame.pose(row);
            let centre = origin - frame.turn(row, system.bodies[k].origin);
            let columns = system.layout.moving(k);
            columns.write(&mut q, [centre.x, centre.y, angle]);
        }
        let regular = q.iter().all(|q| q.is_finite()) && factored(&mut solver, system, &q, &inputs);
        if let Some(driven) = solver.as_mut().filter(|_| regular) {
            driven.velocity(&unit, &mut v);
            load.fill(0.0);
            let columns = system.layout.moving(output.body);
            let ratio = match output.slide {
                None => {
                    load[columns.theta()] = 1.0;
                    v[columns.theta()]
                }
                Some(u) => {
                    let rho = frames[output.body].turn(row, system.bodies[output.body].origin);
                    columns.write(&mut load, [u.x, u.y, rho.x * u.y - rho.y * u.x]);
                    u.x * v[columns.x()] + u.y * v[columns.y()]
                }
            };
            driven.multipliers(&load, &mut lambda);
            line.extend([ratio, 1.0 / ratio]);
            angles(system, driven, &mut drawn, &lambda, &mut line);
        }
        line.iter_mut()
            .filter(|value| !value.is_finite())
            .for_each(|value| *value = f64::NAN);
        line.resize(result.width(), f64::NAN);
        result.push_row(&line);
    }
    match solver {
        None if !table.is_empty() => Err(undetermined()),
        _ => {
            let notes = notes(
                &drawn,
                &wanted.output,
                &system.drivers[driver].name,
                result.len(),
            );
            Ok((result, notes))
        }
    }
}

/// Why cells of the angles are empty.
fn notes(drawn: &[Drawn], output: &str, driver: &str, rows: usize) -> Vec<String> {
    let within = |empty: usize| match empty {
        1 => format!("in 1 of {rows} rows"),
        _ if empty == rows => "in all rows".to_string(),
        _ => format!("in {empty} of {rows} rows"),
    };
    let mut notes = Vec::new();
    for Drawn {
        name, still, idle, ..
    } in drawn
    {
        if *still > 0 {
            notes.push(format!(
                "transmission.{name}.angle is empty {}: {output} stands still at this joint while {driver} alone moves, so that \
                 its velocity there has no direction",
                within(*still)
            ));
        }
        if *idle > 0 {
            notes.push(format!(
                "transmission.{name}.angle is empty {}: a load on {output} puts no force into this joint",
                within(*idle)
            ));
        }
    }
    notes
}

/// Factors J at `q`; whether it is regular there.
fn factored<'s>(
    solver: &mut Option<Driven<'s>>,
    system: &'s System,
    q: &[f64],
    inputs: &Inputs,
) -> bool {
    match solver {
        Some(driven) => {
            driven.evaluation.set_position(q);
            driven.reselect(inputs).is_ok() && driven.factor(inputs).is_ok()
        }
        None => {
            *solver = Driven::new(system, q, inputs).ok();
            solver.is_some()
        }
    }
}

/// Appends μ of each joint, and counts those that have none.
fn angles(
    system: &System,
    driven: &Driven,
    drawn: &mut [Drawn],
    lambda: &[f64],
    line: &mut Vec<f64>,
) {
    let still = Inputs::still(system);
    let at = driven.evaluation.instant(&still);
    let force = |joint: usize| {
        let block = &system.blocks[joint];
        block
            .constraint
            .reaction(&at, &lambda[block.row..block.row + block.rows])
            .0
    };
    let largest = (0..system.joints.len())
        .map(|joint| force(joint).norm())
        .fold(0.0, f64::max);
    let fastest = fastest(system, &at);
    for Drawn {
        joint,
        side,
        still,
        idle,
        ..
    } in drawn
    {
        let data = &system.joints[*joint];
        // The second body's point is where the force acts; the output's velocity there.
        let output = data.bodies[*side].0;
        let place = data.points[1].place(&at);
        let velocity =
            at.twists[output].v + perp(place - at.poses[output].r) * at.twists[output].omega;
        let force = force(*joint);
        line.push(if force.norm() <= NO_FORCE * largest {
            *idle += 1;
            f64::NAN
        } else if velocity.norm() <= NO_MOTION * fastest {
            *still += 1;
            f64::NAN
        } else {
            (force.dot(&velocity).abs() / (force.norm() * velocity.norm()))
                .min(1.0)
                .asin()
        });
    }
}

/// Largest velocity of the motion: of joints, and of bodies that turn, at the distance of the mechanism's size.
fn fastest(system: &System, at: &Instant) -> f64 {
    let joints = system
        .joints
        .iter()
        .flat_map(|joint| &joint.points)
        .map(|point| point.velocity(at).norm());
    let turning = at
        .twists
        .iter()
        .map(|twist| twist.omega.abs() * system.size);
    joints.chain(turning).fold(0.0, f64::max)
}

/// The output's coordinate: the slide on ground of a body that a prismatic joint holds there, the angle of any other.
fn output(model: &Model, system: &System, name: &str) -> Option<Output> {
    let body = system.bodies.iter().position(|body| body.name == name)?;
    let slide = model.joints.values().find_map(|joint| {
        let [first, second] = &joint.between;
        let holds = (first.body == GROUND && second.body == name)
            || (second.body == GROUND && first.body == name);
        let axis = axis(&joint.kind)
            .filter(|_| holds && matches!(joint.kind, JointKind::Prismatic { .. }))?;
        let (JointKind::Prismatic { angle, .. }, true) = (&joint.kind, second.body == GROUND)
        else {
            return Some(axis);
        };
        // The axis is fixed in the moving body, whose angle is −`angle`; it slides back as its axis goes on.
        let (sin, cos) = (-angle).sin_cos();
        Some(-Vec2::new(
            cos * axis.x - sin * axis.y,
            sin * axis.x + cos * axis.y,
        ))
    });
    Some(Output { body, slide })
}

fn headings(system: &System, driver: usize, output: Output, drawn: &[Drawn]) -> Vec<Column> {
    let (ratio, advantage) = match (system.drivers[driver].measure, output.slide) {
        (Measure::Angle, None) | (Measure::Length, Some(_)) => ("1", "1"),
        (Measure::Angle, Some(_)) => ("m/rad", "N/(N*m)"),
        (Measure::Length, None) => ("rad/m", "N*m/N"),
    };
    let mut columns = vec![
        Column::new("transmission.ratio", ratio),
        Column::new("transmission.advantage", advantage),
    ];
    columns.extend(
        drawn
            .iter()
            .map(|drawn| Column::new(format!("transmission.{}.angle", drawn.name), "rad")),
    );
    columns
}
