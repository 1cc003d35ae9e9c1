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
//! Where the output stands still, A is infinite: its cell is empty as well.
//! Checked against triangles, and against the same mechanism on ground, in `tests/fast/transmission.rs`.

use super::rows::{Columns, States};
use crate::element::{BodyId, Kinematics, Measure};
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, JointRole, System};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_output::{Channel, Column, TransmissionQuantity};

/// Forces below this part of the largest are none: round-off of the solve.
const NO_FORCE: f64 = 1e-9;
/// Velocities below this part of the mechanism's largest are none, for the same reason.
const NO_MOTION: f64 = 1e-9;

/// From which driver to which moving body motion and force are transmitted, by number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Transmission {
    /// The driver.
    pub driver: usize,
    /// The driven body.
    pub output: usize,
}

/// Coordinate of the output: its angle, or its slide along a direction fixed in the ground.
#[derive(Debug, Clone, Copy)]
struct Output {
    body: usize,
    slide: Option<Vec2>,
}

/// A joint of the output body that is not on ground: its number, and which of its sides is on the output.
struct Drawn {
    joint: usize,
    side: usize,
    /// Rows in which the output's point there stands still.
    still: usize,
    /// Rows in which the joint carries nothing.
    idle: usize,
}

/// A transmission beside the rows of a run.
pub struct Transmitted<'s> {
    pub headings: Vec<Column>,
    solver: TransmissionSolver<'s>,
    driver: usize,
    rows: usize,
}

impl<'s> Transmitted<'s> {
    /// Where its driver and body are known, beside rows with these columns.
    ///
    /// # Errors
    /// Why there is none, in a sentence.
    pub fn new(
        system: &'s System,
        wanted: Option<Transmission>,
        columns: &Columns,
    ) -> Result<Self, String> {
        let Transmission { driver, output } = wanted.ok_or_else(undetermined)?;
        let output = Output::of(system, output);
        if system.m() < system.n() {
            return Err(undetermined());
        }
        let states = States::of(system, columns).ok_or_else(undetermined)?;
        let solver = TransmissionSolver::new(system, states, driver, output);
        Ok(Transmitted {
            headings: headings(system, driver, output, &solver.drawn),
            solver,
            driver,
            rows: 0,
        })
    }

    /// Appends ratio, advantage and angles of a row, NaN where there are none.
    pub fn push(&mut self, row: &[f64], line: &mut Vec<f64>) {
        let begin = line.len();
        self.solver.solve(row, line);
        line[begin..]
            .iter_mut()
            .filter(|value| !value.is_finite())
            .for_each(|value| *value = f64::NAN);
        line.resize(begin + self.headings.len(), f64::NAN);
        self.rows += 1;
    }

    /// What there is to say about empty cells of the rows so far.
    ///
    /// # Errors
    /// That there was nothing in any row, in a sentence.
    pub fn notes(&self) -> Result<Vec<String>, String> {
        if self.solver.driven.is_none() && self.rows > 0 {
            return Err(undetermined());
        }
        Ok(notes(&self.solver, self.driver, self.rows))
    }
}

fn undetermined() -> String {
    "the drivers alone do not determine the motion, so that there is no transmission".to_owned()
}

/// Joints of the output body that carry a force at a point, not on ground.
fn drawn(system: &System, output: Output) -> Vec<Drawn> {
    let of = |(joint, data): (usize, &crate::system::JointData)| {
        let carries = matches!(data.role(), JointRole::Revolute | JointRole::Slot { .. });
        let own = BodyId(output.body + 1);
        let side = data.bodies().iter().position(|&body| body == own)?;
        (carries && data.bodies()[1 - side] != BodyId::GROUND).then_some(Drawn {
            joint,
            side,
            still: 0,
            idle: 0,
        })
    };
    system.joints.iter().enumerate().filter_map(of).collect()
}

/// Solves row after row for unit speed of the driver and unit load of the output.
struct TransmissionSolver<'s> {
    system: &'s System,
    states: States,
    output: Output,
    drawn: Vec<Drawn>,
    /// Rows in which the output stands still.
    at_rest: usize,
    /// Everything still, and the same with the driver at unit speed.
    still: Inputs,
    unit: Inputs,
    /// None until a row is regular.
    driven: Option<Driven<'s>>,
    q: Vec<f64>,
    v: Vec<f64>,
    load: Vec<f64>,
    lambda: Vec<f64>,
}

impl<'s> TransmissionSolver<'s> {
    fn new(system: &'s System, states: States, driver: usize, output: Output) -> Self {
        let still = Inputs::still(system);
        let mut unit = still.clone();
        unit.drive[driver][1] = 1.0;
        let zero = vec![0.0; system.n()];
        TransmissionSolver {
            system,
            states,
            output,
            drawn: drawn(system, output),
            at_rest: 0,
            still,
            unit,
            driven: None,
            q: zero.clone(),
            v: zero.clone(),
            load: zero,
            lambda: vec![0.0; system.m()],
        }
    }

    /// Appends ratio, advantage and angles of a row; nothing where its position is singular or missing.
    fn solve(&mut self, row: &[f64], line: &mut Vec<f64>) {
        let system = self.system;
        self.states.position(system, row, &mut self.q);
        if !self.q.iter().all(|q| q.is_finite()) || !self.factored() {
            return;
        }
        let Some(driven) = &mut self.driven else {
            return;
        };
        driven.velocity(&self.unit, &mut self.v);
        self.load.fill(0.0);
        let body = self.output.body;
        let columns = system.layout.moving(body);
        // The ratio, and in what length the output moves by it.
        let (ratio, reach) = match self.output.slide {
            None => {
                self.load[columns.theta()] = 1.0;
                (self.v[columns.theta()], system.size)
            }
            Some(u) => {
                let rho = self
                    .states
                    .frame(body)
                    .turn(row, system.bodies[body].origin);
                let torque = rho.x * u.y - rho.y * u.x;
                columns.write(&mut self.load, [u.x, u.y, torque]);
                (u.x * self.v[columns.x()] + u.y * self.v[columns.y()], 1.0)
            }
        };
        driven.multipliers(&self.load, &mut self.lambda);
        let at = driven.evaluation.kinematics(&self.still);
        let slowest = NO_MOTION * fastest(system, &at);
        let is_at_rest = ratio.abs() * reach <= slowest;
        self.at_rest += usize::from(is_at_rest);
        line.extend([ratio, if is_at_rest { f64::NAN } else { 1.0 / ratio }]);
        angles(system, &at, slowest, &mut self.drawn, &self.lambda, line);
    }

    /// Factors J at the position; whether it is regular there.
    fn factored(&mut self) -> bool {
        match &mut self.driven {
            Some(driven) => {
                driven.evaluation.set_position(&self.q);
                driven.reselect(&self.still).is_ok() && driven.factor(&self.still).is_ok()
            }
            None => {
                self.driven = Driven::new(self.system, &self.q, &self.still).ok();
                self.driven.is_some()
            }
        }
    }
}

/// Why cells are empty.
fn notes(solver: &TransmissionSolver, driver: usize, rows: usize) -> Vec<String> {
    let TransmissionSolver {
        system,
        drawn,
        output,
        at_rest,
        ..
    } = solver;
    let within = |empty: usize| match empty {
        1 => format!("in 1 of {rows} rows"),
        _ if empty == rows => "in all rows".to_string(),
        _ => format!("in {empty} of {rows} rows"),
    };
    let (output, driver) = (
        &system.bodies[output.body].name,
        &system.drivers[driver].name,
    );
    let mut notes = Vec::new();
    if *at_rest > 0 {
        notes.push(format!(
            "transmission.advantage is empty {}: {output} stands still there while {driver} alone moves, so that a load on it \
             takes no effort, and the advantage is infinite",
            within(*at_rest)
        ));
    }
    for Drawn {
        joint, still, idle, ..
    } in drawn
    {
        let name = &system.joints[*joint].name;
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

/// Appends μ of each joint, and counts those that have none; velocities of the slowest and below are none.
fn angles(
    system: &System,
    at: &Kinematics,
    slowest: f64,
    drawn: &mut [Drawn],
    lambda: &[f64],
    line: &mut Vec<f64>,
) {
    let force = |joint: usize| {
        let block = &system.blocks[joint];
        block.constraint.reaction(at, &lambda[block.rows()]).0
    };
    let largest = (0..system.joints.len())
        .map(|joint| force(joint).norm())
        .fold(0.0, f64::max);
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
        let output = data.bodies()[*side].0;
        let place = data.points()[1].place(at);
        let velocity =
            at.twists[output].v + perp(place - at.poses[output].r) * at.twists[output].omega;
        let force = force(*joint);
        line.push(if force.norm() <= NO_FORCE * largest {
            *idle += 1;
            f64::NAN
        } else if velocity.norm() <= slowest {
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
fn fastest(system: &System, at: &Kinematics) -> f64 {
    let joints = system
        .joints
        .iter()
        .flat_map(|joint| joint.points())
        .map(|point| point.velocity(at).norm());
    let turning = at
        .twists
        .iter()
        .map(|twist| twist.omega.abs() * system.size);
    joints.chain(turning).fold(0.0, f64::max)
}

impl Output {
    /// The slide on ground of a body that a prismatic joint holds there, the angle of any other.
    fn of(system: &System, body: usize) -> Self {
        let own = BodyId(body + 1);
        let slide = system.joints.iter().find_map(|joint| match joint.role() {
            JointRole::Prismatic { axis, .. } if joint.bodies() == [BodyId::GROUND, own] => {
                Some(axis)
            }
            JointRole::Prismatic { axis, angle } if joint.bodies() == [own, BodyId::GROUND] => {
                // The axis is fixed in the moving body, whose angle is −`angle`; it slides back as its axis goes on.
                let (sin, cos) = (-angle).sin_cos();
                Some(-Vec2::new(
                    cos * axis.x - sin * axis.y,
                    sin * axis.x + cos * axis.y,
                ))
            }
            _ => None,
        });
        Output { body, slide }
    }
}

fn headings(system: &System, driver: usize, output: Output, drawn: &[Drawn]) -> Vec<Column> {
    let (ratio, advantage) = match (system.drivers[driver].measure, output.slide) {
        (Measure::Angle, None) | (Measure::Length, Some(_)) => ("1", "1"),
        (Measure::Angle, Some(_)) => ("m/rad", "N/(N*m)"),
        (Measure::Length, None) => ("rad/m", "N*m/N"),
    };
    let column =
        |quantity, owner: &str, unit| Column::of(Channel::Transmission(quantity), owner, unit);
    let mut columns = vec![
        column(TransmissionQuantity::Ratio, "", ratio),
        column(TransmissionQuantity::Advantage, "", advantage),
    ];
    columns.extend(drawn.iter().map(|&Drawn { joint, .. }| {
        let quantity = TransmissionQuantity::Angle(joint);
        column(quantity, &system.joints[joint].name, "rad")
    }));
    columns
}
