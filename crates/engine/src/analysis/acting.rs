//! Columns of forces and joints that are there when requested: they follow from the rows of a run.
//!
//! ```text
//! spring, actuator   l = |d|, l̇, F = u·f, f, P        d = P₂ − P₁, u = d/l, f the force on the second body, F > 0 pushes apart
//! torsion spring     β = θ₂ − θ₁, β̇, T, P              T on the second body
//! cable              L = Σ lᵢ, L̇, T, P = −T L̇          T pulls
//! force, torque      f or T on the body, P; of a motor the current i = T/(k g), too
//! any                P = Qᵀ v                          Q its generalized forces (n): work by time done on the mechanism
//! joint              θ₂ − θ₁, s = a·d, their rates, |f|
//! ```
//!
//! with l, β, s of [`crate::element::quantity`], as formulas have them. Points that coincide have no line, and F is none there, as
//! in the element. Power and its integral are held against energies, and the rest against geometry, in `tests/fast/acting`.

use super::channels::Contents;
use super::rows::{Columns, Replay};
use crate::element::quantity::Measured;
use crate::element::{Applied, direction};
use crate::system::{ForceRole, JointData, JointRole, System};
use linkdyn_linear::math::{Vec2, dot};
use linkdyn_output::{Channel, Column, JointQuantity, LoadQuantity, RelativeQuantity};

/// The columns that may be requested, in their order.
pub(super) fn offered(system: &System, contents: Contents) -> Vec<Column> {
    let mut columns = Vec::new();
    for (k, joint) in system.joints.iter().enumerate() {
        let of = |quantity: RelativeQuantity| {
            Column::of(Channel::Relative(k, quantity), &joint.name, quantity.unit())
        };
        columns.extend(of_joint(joint, contents).map(of));
    }
    for (k, force) in system.force_data.iter().enumerate() {
        let of = |quantity: LoadQuantity| {
            Column::of(Channel::Load(k, quantity), &force.name, quantity.unit())
        };
        columns.extend(of_force(&force.role, contents).map(of));
    }
    columns
}

/// Whether results have some of them without being asked.
pub(super) fn has_unasked(system: &System) -> bool {
    let mut forces = system.force_data.iter();
    forces.any(|force| force.role.is_actuator())
}

/// Whether a column is of an actuator, and in results without being requested.
pub(super) fn is_unasked(system: &System, column: &Column) -> bool {
    match column.channel {
        Some(Channel::Load(
            force,
            LoadQuantity::Length | LoadQuantity::Rate | LoadQuantity::F | LoadQuantity::Power,
        )) => system.force_data[force].role.is_actuator(),
        _ => false,
    }
}

fn of_joint(joint: &JointData, contents: Contents) -> impl Iterator<Item = RelativeQuantity> {
    let role = joint.role();
    let turns = matches!(
        role,
        JointRole::Revolute | JointRole::Slot { .. } | JointRole::Bushing | JointRole::Beam
    );
    let slides = role.axis().is_some();
    let all = RelativeQuantity::ALL.into_iter();
    all.filter(move |quantity| match quantity {
        RelativeQuantity::Angle => turns,
        RelativeQuantity::Omega => turns && contents.velocities,
        RelativeQuantity::Slide => slides,
        RelativeQuantity::Rate => slides && contents.velocities,
        RelativeQuantity::F => contents.reactions,
    })
}

fn of_force(role: &ForceRole, contents: Contents) -> impl Iterator<Item = LoadQuantity> {
    let is_cable = matches!(role, ForceRole::Cable { .. });
    let is_none = matches!(role, ForceRole::Stretch { .. });
    let (stretches, turns, pushes) = match role {
        ForceRole::Cable { .. } => (true, false, true),
        ForceRole::Stretch { .. } => (false, false, true),
        ForceRole::Spring { measured, .. } => match measured {
            Measured::Turn { .. } => (false, true, false),
            Measured::Distance { .. } | Measured::Along { .. } => (true, false, true),
        },
        ForceRole::Load { .. } => (false, false, true),
        ForceRole::Torque { .. } => (false, false, false),
    };
    let all = LoadQuantity::ALL.into_iter();
    all.filter(move |quantity| match quantity {
        _ if is_none => false,
        LoadQuantity::Fx | LoadQuantity::Fy if is_cable => false,
        LoadQuantity::Length | LoadQuantity::F => stretches,
        LoadQuantity::Rate => stretches && contents.velocities,
        LoadQuantity::Angle => turns,
        LoadQuantity::Omega => turns && contents.velocities,
        LoadQuantity::Fx | LoadQuantity::Fy => pushes,
        LoadQuantity::Torque => !pushes,
        LoadQuantity::Power => contents.velocities,
        LoadQuantity::Current => {
            matches!(role, ForceRole::Torque { by_current, .. } if by_current.is_some())
        }
        // it stands among the rows
        LoadQuantity::Stop => false,
    })
}

/// What a column reads.
enum ColumnReading {
    Force(usize, LoadQuantity),
    Value(Measured),
    Rate(Measured),
    /// The size of a force of which these columns are.
    Size([usize; 2]),
}

/// Columns of forces and joints beside the rows of a run.
pub(super) struct Acting<'s> {
    readings: Vec<ColumnReading>,
    replay: Replay<'s>,
    /// Generalized forces of the force with this number (n).
    pull: Vec<f64>,
    pulls: Option<usize>,
}

impl<'s> Acting<'s> {
    /// These columns beside rows; `None` if the rows lack what they follow from.
    pub fn new(system: &'s System, columns: &Columns, wanted: &[Column]) -> Option<Self> {
        let reading = |column: &Column| match column.channel? {
            Channel::Relative(joint, quantity) => relative(system, columns, joint, quantity),
            Channel::Load(force, quantity) => Some(load(system, force, quantity)),
            _ => None,
        };
        Some(Acting {
            readings: wanted.iter().map(reading).collect::<Option<_>>()?,
            replay: Replay::new(system, columns)?,
            pull: vec![0.0; system.n()],
            pulls: None,
        })
    }

    /// Numbers from outside have these values from now on.
    pub fn give(&mut self, numbers: &[f64]) {
        self.replay.give(numbers);
    }

    /// Appends the columns of a row, NaN where it has no position.
    pub fn push(&mut self, row: &[f64], line: &mut Vec<f64>) {
        self.replay.take(row);
        self.pulls = None;
        if !self.replay.is_there() {
            line.extend(self.readings.iter().map(|_| f64::NAN));
            return;
        }
        for k in 0..self.readings.len() {
            let at = self.replay.kinematics();
            let value = match self.readings[k] {
                ColumnReading::Value(measured) => measured.value(&at)[0],
                ColumnReading::Rate(measured) => measured.value(&at)[1],
                ColumnReading::Size([x, y]) => row[x].hypot(row[y]),
                ColumnReading::Force(force, quantity) => {
                    self.apply(force);
                    self.value(force, quantity)
                }
            };
            line.push(value);
        }
    }

    /// Takes the generalized forces of a force.
    fn apply(&mut self, force: usize) {
        if self.pulls.replace(force) == Some(force) {
            return;
        }
        let system = self.replay.system;
        self.pull.fill(0.0);
        let mut to = Applied::to(&mut self.pull, &system.layout);
        system.forces[force].apply(&self.replay.kinematics(), &mut to);
    }

    /// What a force does.
    fn value(&self, force: usize, quantity: LoadQuantity) -> f64 {
        let at = self.replay.kinematics();
        let system = self.replay.system;
        if let ForceRole::Cable { path, pull, .. } = &system.force_data[force].role {
            let sum = |order: usize| path.iter().map(|one| one.value(&at)[order]).sum::<f64>();
            return match quantity {
                LoadQuantity::Length => sum(0),
                LoadQuantity::Rate => sum(1),
                LoadQuantity::F => -pull.value(&at),
                LoadQuantity::Power => pull.value(&at) * sum(1),
                _ => f64::NAN,
            };
        }
        if let (
            LoadQuantity::Current,
            ForceRole::Torque {
                value,
                by_current: Some(by_current),
                ..
            },
        ) = (quantity, &system.force_data[force].role)
        {
            return value.value(&at) / by_current;
        }
        if quantity == LoadQuantity::Power {
            return dot(&self.pull, &self.replay.v);
        }
        let ([fx, fy, torque], along) = match &system.force_data[force].role {
            ForceRole::Spring {
                between, measured, ..
            } => {
                let on = |body| system.layout.columns(body).map(|own| own.read(&self.pull));
                let [first, second] = between.map(on);
                let back = first.map(|first| first.map(|part| -part));
                let wrench = second.or(back).unwrap_or_default();
                let along = match measured {
                    Measured::Distance { first, second } => {
                        direction(second.place(&at) - first.place(&at))
                    }
                    Measured::Along { .. } | Measured::Turn { .. } => None,
                };
                (wrench, along.map_or_else(Vec2::zeros, |(u, _)| u))
            }
            // these have no columns of their own
            ForceRole::Cable { .. } | ForceRole::Stretch { .. } => ([0.0; 3], Vec2::zeros()),
            ForceRole::Load {
                vector: [x, y],
                frame,
                ..
            } => {
                let given = Vec2::new(x.value(&at), y.value(&at));
                let force = at.poses[frame.0].turn(given);
                ([force.x, force.y, 0.0], Vec2::zeros())
            }
            ForceRole::Torque { value, .. } => ([0.0, 0.0, value.value(&at)], Vec2::zeros()),
        };
        match quantity {
            LoadQuantity::Fx => fx,
            LoadQuantity::Fy => fy,
            LoadQuantity::Torque => torque,
            LoadQuantity::F => along.x * fx + along.y * fy,
            // these are read as what they measure
            LoadQuantity::Length
            | LoadQuantity::Rate
            | LoadQuantity::Angle
            | LoadQuantity::Omega
            | LoadQuantity::Power
            | LoadQuantity::Current
            | LoadQuantity::Stop => f64::NAN,
        }
    }
}

fn relative(
    system: &System,
    columns: &Columns,
    joint: usize,
    quantity: RelativeQuantity,
) -> Option<ColumnReading> {
    let data = &system.joints[joint];
    let turn = Measured::Turn {
        first: data.bodies()[0],
        second: data.bodies()[1],
        from: 0.0,
    };
    let slide = || {
        let [first, second] = data.points();
        Some(Measured::Along {
            first,
            second,
            axis: data.role().axis()?,
        })
    };
    let force = |quantity| columns.find(Channel::Joint(joint, quantity));
    Some(match quantity {
        RelativeQuantity::Angle => ColumnReading::Value(turn),
        RelativeQuantity::Omega => ColumnReading::Rate(turn),
        RelativeQuantity::Slide => ColumnReading::Value(slide()?),
        RelativeQuantity::Rate => ColumnReading::Rate(slide()?),
        RelativeQuantity::F => {
            ColumnReading::Size([force(JointQuantity::Fx)?, force(JointQuantity::Fy)?])
        }
    })
}

fn load(system: &System, force: usize, quantity: LoadQuantity) -> ColumnReading {
    match (&system.force_data[force].role, quantity) {
        (ForceRole::Spring { measured, .. }, LoadQuantity::Length | LoadQuantity::Angle) => {
            ColumnReading::Value(*measured)
        }
        (ForceRole::Spring { measured, .. }, LoadQuantity::Rate | LoadQuantity::Omega) => {
            ColumnReading::Rate(*measured)
        }
        (_, quantity) => ColumnReading::Force(force, quantity),
    }
}
