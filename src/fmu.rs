//! What a functional mock-up unit (FMI) shows of a mechanism: the command writes it down, and the unit's library answers by it. It
//! changes without notice.
//!
//! ```text
//! value reference    0      1 …                       …                 …                  last
//! variable           time   parameters.NAME (fixed)   input.NAME,       result columns     events
//!                                                     driver.NAME.acceleration
//! ```
//!
//! The order follows from the model alone, so that both sides agree. All numbers are in SI units.

use linkdyn_model::driver::DriverKind;
use linkdyn_output::{
    BodyQuantity, Channel, DriverQuantity, PointQuantity, RelativeQuantity, StateQuantity, matches,
};
use sha2::{Digest, Sha256};

use crate::error::Error;
use crate::handles::{Column, Parameter};
use crate::mechanism::{Mechanism, unknown};

/// The name of the model in the folder `resources` of a unit.
pub const MODEL: &str = "model.json";
/// The name of a file there, a list of the drivers whose acceleration is an input, as JSON.
pub const STEERED: &str = "steered.json";

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
    /// The name of what it is of: an input, a driver; otherwise empty.
    pub owner: String,
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
    /// An input of the model, with its value until it is set.
    Input(f64),
    /// The acceleration of a driver.
    Acceleration,
    /// A result column.
    Output {
        /// Which.
        column: Column,
        /// Whether inputs change it at once, without a step.
        is_direct: bool,
    },
    /// How many events there have been.
    Events,
}

impl Interface {
    /// Of a mechanism: all its parameters and inputs, and the result columns of its analysis; with drivers whose acceleration is an input.
    ///
    /// # Errors
    /// [`Error::Unknown`] where there is no such driver.
    pub fn new(mechanism: &Mechanism, steered: &[String]) -> Result<Self, Error> {
        let named = |name: &str, unit: &str, role| Variable {
            name: name.to_owned(),
            owner: String::new(),
            unit: unit.to_owned(),
            role,
        };
        let mut variables = vec![named("time", "s", Role::Time)];
        variables.extend(mechanism.parameters().map(|(name, handle)| {
            let name = format!("parameters.{name}");
            named(&name, &handle.unit(), Role::Parameter(handle))
        }));
        variables.extend(
            mechanism
                .model()
                .inputs
                .iter()
                .map(|(name, input)| Variable {
                    owner: name.clone(),
                    ..named(
                        &format!("input.{name}"),
                        &input.unit,
                        Role::Input(input.start),
                    )
                }),
        );
        for owner in steered {
            let drivers = &mechanism.model().drivers;
            let driver = drivers
                .get(owner)
                .ok_or_else(|| unknown("driver", owner, drivers.keys().map(String::as_str)))?;
            let unit = match driver.kind {
                DriverKind::Rotation { .. } => "rad/s^2",
                DriverKind::Translation { .. }
                | DriverKind::Length { .. }
                | DriverKind::Point { .. } => "m/s^2",
            };
            let name = format!("driver.{owner}.acceleration");
            variables.push(Variable {
                owner: owner.clone(),
                ..named(&name, unit, Role::Acceleration)
            });
        }
        let patterns = mechanism.model().analysis.iter();
        let patterns: Vec<&String> = patterns.flat_map(|analysis| &analysis.columns).collect();
        let is_wanted = |name: &str| {
            patterns.is_empty() || patterns.iter().any(|pattern| matches(pattern, name))
        };
        variables.extend(mechanism.headings().filter_map(|(heading, column)| {
            if !is_wanted(&heading.name) {
                return None;
            }
            let is_direct = match heading.channel? {
                Channel::Time => return None,
                channel => is_direct(channel),
            };
            let role = Role::Output { column, is_direct };
            Some(named(&heading.name, heading.unit, role))
        }));
        variables.push(named("events", "", Role::Events));
        Ok(Interface { variables })
    }

    /// Its parameters.
    pub fn parameters(&self) -> impl Iterator<Item = &Variable> {
        let variables = self.variables.iter();
        variables.filter(|variable| matches!(variable.role, Role::Parameter(_)))
    }

    /// Its inputs.
    pub fn inputs(&self) -> impl Iterator<Item = &Variable> {
        let variables = self.variables.iter();
        variables.filter(|variable| matches!(variable.role, Role::Input(_) | Role::Acceleration))
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
            Role::Input(start) => Some(start),
            Role::Acceleration => Some(0.0),
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
        Channel::Relative(_, quantity) => quantity == RelativeQuantity::F,
        Channel::Joint(..)
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

/// What tells a unit from others: the hash of its model and its steered drivers, hexadecimal.
pub fn token(model: &[u8], steered: &[u8]) -> String {
    let mut hash = Sha256::new();
    for part in [model, steered] {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    format!("linkdyn-{:x}", hash.finalize())
}
