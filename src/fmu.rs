//! What a functional mock-up unit (FMI) shows of a mechanism: the command writes it down, and the unit's library answers by it. It
//! changes without notice.
//!
//! ```text
//! value reference    0      1 …                       …                 …                  last
//! variable           time   parameters.NAME (fixed)   input.NAME        result columns     events
//! ```
//!
//! The order follows from the model alone, so that both sides agree. All numbers are in SI units.

use linkdyn_output::{BodyQuantity, Channel, DriverQuantity, PointQuantity, StateQuantity};
use sha2::{Digest, Sha256};

use crate::handles::{Column, Parameter};
use crate::mechanism::Mechanism;

/// The name of the model in the folder `resources` of a unit.
pub const MODEL: &str = "model.json";

/// The variables of a unit; their places are their value references.
#[derive(Debug, Clone)]
pub struct Interface {
    /// `time` first, `events` last.
    pub variables: Vec<Variable>,
}

/// A variable of a unit.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Its name, unique in the unit.
    pub name: String,
    /// Its SI unit; empty of a plain number.
    pub unit: String,
    /// What it is.
    pub role: Role,
}

/// What a variable is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Role {
    /// The instant.
    Time,
    /// A parameter of the model, to be set before the motion begins.
    Parameter(Parameter),
    /// A result column; inputs may change it at once, without a step.
    Output {
        /// Which.
        column: Column,
        /// Whether it depends on the inputs of the instant.
        is_direct: bool,
    },
    /// How many events there have been.
    Events,
}

impl Interface {
    /// Of a mechanism: all its parameters and inputs, and all its result columns.
    pub fn new(mechanism: &Mechanism) -> Self {
        let named = |name: &str, unit: &str, role| Variable {
            name: name.to_owned(),
            unit: unit.to_owned(),
            role,
        };
        let parameters = mechanism.parameters().map(|(name, handle)| {
            let name = format!("parameters.{name}");
            named(&name, &handle.unit(), Role::Parameter(handle))
        });
        let columns = mechanism.headings().filter_map(|(heading, column)| {
            let is_direct = match heading.channel? {
                Channel::Time => return None,
                channel => is_direct(channel),
            };
            let role = Role::Output { column, is_direct };
            Some(named(&heading.name, heading.unit, role))
        });
        let time = named("time", "s", Role::Time);
        let events = named("events", "", Role::Events);
        let all = std::iter::once(time).chain(parameters).chain(columns);
        Interface {
            variables: all.chain([events]).collect(),
        }
    }

    /// Its parameters.
    pub fn parameters(&self) -> impl Iterator<Item = &Variable> {
        let variables = self.variables.iter();
        variables.filter(|variable| matches!(variable.role, Role::Parameter(_)))
    }

    /// Its result columns.
    pub fn outputs(&self) -> impl Iterator<Item = &Variable> {
        let variables = self.variables.iter();
        variables.filter(|variable| matches!(variable.role, Role::Output { .. }))
    }

    /// The value that a variable has before it is set, if it can be set.
    pub fn start(&self, reference: usize) -> Option<f64> {
        match self.variables.get(reference)?.role {
            Role::Parameter(handle) => Some(handle.nominal().si()),
            Role::Time | Role::Output { .. } | Role::Events => None,
        }
    }
}

/// Whether a quantity depends on the forces of the instant, and so on the inputs.
fn is_direct(channel: Channel) -> bool {
    match channel {
        Channel::Time | Channel::Output(_) | Channel::Measure(..) => false,
        Channel::Body(_, quantity) => matches!(
            quantity,
            BodyQuantity::Ax | BodyQuantity::Ay | BodyQuantity::Alpha
        ),
        Channel::Point(_, quantity) => matches!(quantity, PointQuantity::Ax | PointQuantity::Ay),
        Channel::Driver(_, quantity) => quantity != DriverQuantity::Value,
        Channel::State(_, quantity) => quantity != StateQuantity::Value,
        Channel::Joint(..)
        | Channel::Relative(..)
        | Channel::Energy(_)
        | Channel::Load(..)
        | Channel::Shaking(_)
        | Channel::Transmission(_)
        | Channel::Section(..) => true,
    }
}

/// The columns that a unit has if none are requested: places of the points of interest, drivers, measures, states and outputs; of a
/// model without them the poses of its bodies.
pub fn default_outputs(mechanism: &Mechanism) -> Vec<String> {
    let chosen = |wanted: fn(Channel) -> bool| -> Vec<String> {
        let headings = mechanism.headings();
        let chosen = headings.filter(|(heading, _)| heading.channel.is_some_and(wanted));
        chosen.map(|(heading, _)| heading.name.clone()).collect()
    };
    let own = chosen(|channel| match channel {
        Channel::Point(_, quantity) => {
            matches!(quantity, PointQuantity::X | PointQuantity::Y)
        }
        Channel::Driver(..) | Channel::Output(_) => true,
        Channel::State(_, quantity) | Channel::Measure(_, quantity) => {
            quantity == StateQuantity::Value
        }
        Channel::Time
        | Channel::Body(..)
        | Channel::Joint(..)
        | Channel::Relative(..)
        | Channel::Energy(_)
        | Channel::Load(..)
        | Channel::Shaking(_)
        | Channel::Transmission(_)
        | Channel::Section(..) => false,
    });
    if !own.is_empty() {
        return own;
    }
    chosen(|channel| {
        matches!(
            channel,
            Channel::Body(_, BodyQuantity::X | BodyQuantity::Y | BodyQuantity::Angle)
        )
    })
}

/// What tells a unit from others: the hash of its model, hexadecimal.
pub fn token(model: &[u8]) -> String {
    format!("linkdyn-{:x}", Sha256::digest(model))
}
