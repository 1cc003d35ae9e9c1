//! The columns that responses need, and how they are read from a mechanism at an instant.
//!
//! Only the channels that responses name are read, and those that `derived` takes where they name what follows from rows:
//! applied forces the poses of bodies (and their rates, where they follow from what moves), transmission and outputs the poses,
//! what forces and joints show the rates besides, and shaking forces joint forces and efforts as well.

use super::super::channels::Channels;
use super::super::derived::{Derived, DerivedWanted};
use super::super::needed::behind;
use super::super::responses::Dual;
use super::super::run::Prepared;
use super::super::sample::Sample;
use crate::system::{Evaluation, Inputs, System};
use linkdyn_output::{
    BodyQuantity, Channel, Column, DriverQuantity, JointQuantity, LoadQuantity, RelativeQuantity,
};

/// How much of an instant is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// Positions.
    Positions,
    /// Velocities and accelerations, too.
    Motion,
    /// Multipliers, too.
    Forces,
}

/// The columns that responses need.
pub struct Needs {
    channels: Channels,
    /// What is wanted of what follows from rows; `None` if none of it is needed.
    wanted: Option<DerivedWanted>,
    /// Place of each need in a row of the channels, and of what follows behind them.
    places: Vec<usize>,
    /// Which of them are of what joints and drivers carry.
    carried: Vec<bool>,
}

/// Room for a row.
#[derive(Debug, Default)]
pub struct Room {
    row: Vec<f64>,
    follows: Vec<f64>,
    /// The needed columns.
    pub values: Vec<f64>,
}

/// A mechanism at an instant.
#[derive(Clone, Copy)]
pub struct State<'a> {
    pub system: &'a System,
    pub evaluation: &'a Evaluation,
    pub inputs: &'a Inputs,
    pub sample: &'a Sample,
}

/// What follows from rows that a response names.
#[derive(Debug, Default)]
struct Follows {
    /// It takes poses.
    any: bool,
    /// It takes rates.
    rates: bool,
    /// It takes what joints carry.
    reactions: bool,
    /// It takes efforts of drivers.
    efforts: bool,
    transmission: bool,
}

impl Follows {
    fn of<'c>(system: &System, columns: impl Iterator<Item = &'c Column>) -> Self {
        let mut follows = Follows::default();
        for column in columns {
            match column.channel {
                // applied forces follow from rates where they are formulas
                Some(Channel::Load(
                    force,
                    LoadQuantity::Fx | LoadQuantity::Fy | LoadQuantity::Torque,
                )) if system.force_data[force].role.is_applied() => {
                    follows.rates |= !system.formulas.is_empty();
                }
                Some(Channel::Load(_, LoadQuantity::Stop)) => follows.reactions = true,
                Some(Channel::Load(..)) => follows.rates = true,
                Some(Channel::Relative(_, RelativeQuantity::F)) => {
                    (follows.rates, follows.reactions) = (true, true);
                }
                Some(Channel::Relative(..)) => follows.rates = true,
                Some(Channel::Output(_)) => {}
                Some(Channel::Shaking(_)) => {
                    (follows.rates, follows.reactions, follows.efforts) = (true, true, true);
                }
                Some(Channel::Transmission(_)) => follows.transmission = true,
                Some(
                    Channel::Time
                    | Channel::Body(..)
                    | Channel::Point(..)
                    | Channel::Joint(..)
                    | Channel::Driver(..)
                    | Channel::State(..)
                    | Channel::Measure(..)
                    | Channel::Section(..)
                    | Channel::Energy(_),
                )
                | None => continue,
            }
            follows.any = true;
        }
        follows
    }

    /// Whether it takes a channel.
    fn takes(&self, channel: Channel) -> bool {
        match channel {
            Channel::Time
            | Channel::Body(_, BodyQuantity::X | BodyQuantity::Y | BodyQuantity::Angle) => self.any,
            Channel::Body(_, BodyQuantity::Vx | BodyQuantity::Vy | BodyQuantity::Omega) => {
                self.rates
            }
            Channel::Joint(_, JointQuantity::Fx | JointQuantity::Fy | JointQuantity::Torque) => {
                self.reactions
            }
            Channel::Driver(_, DriverQuantity::Effort) => self.efforts,
            Channel::Body(..)
            | Channel::Joint(..)
            | Channel::Relative(..)
            | Channel::Driver(..)
            | Channel::Point(..)
            | Channel::Energy(_)
            | Channel::Load(..)
            | Channel::Shaking(_)
            | Channel::Transmission(_)
            | Channel::State(..)
            | Channel::Measure(..)
            | Channel::Section(..)
            | Channel::Output(_) => false,
        }
    }
}

impl Needs {
    /// Of the responses of a prepared model; `None` if a column is not there.
    pub fn new(prepared: &Prepared) -> Option<Needs> {
        let (system, question) = prepared.parts();
        let all = Channels::new(system, question.contents);
        let all = all.columns();
        let behind = behind(system, question);
        let needed = prepared.responses().needed().iter();
        let find = |index: usize| all.get(index).or_else(|| behind.get(index - all.len()));
        let needed: Vec<&Column> = needed
            .map(|column| find(column.index()))
            .collect::<Option<_>>()?;
        let follows = Follows::of(system, needed.iter().copied());
        let is_wanted = |column: &&Column| {
            let is_taken = column.channel.is_some_and(|own| follows.takes(own));
            is_taken || needed.iter().any(|own| own.channel == column.channel)
        };
        let mut columns: Vec<Column> = all.iter().filter(is_wanted).cloned().collect();
        let channels = Channels::of(columns.clone());
        let whole = DerivedWanted::all(system, question);
        let wanted = follows.any.then(|| DerivedWanted {
            transmission: whole.transmission.filter(|_| follows.transmission),
            following: (whole.following).of(|column| needed.contains(&column)),
        });
        if let Some(wanted) = &wanted {
            let derived = Derived::new(system, channels.columns(), wanted);
            columns.extend(derived.headings);
        }
        let place = |own: &&Column| columns.iter().position(|one| one.channel == own.channel);
        Some(Needs {
            carried: needed.iter().map(|column| is_carried(column)).collect(),
            places: needed.iter().map(place).collect::<Option<_>>()?,
            wanted,
            channels,
        })
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// Whether something follows from rows.
    pub fn follow(&self) -> bool {
        self.wanted.is_some()
    }

    /// How much of an instant they need, where forces are known.
    pub fn depth(&self, reactions: bool) -> Depth {
        match (self.channels.are_positions(), self.channels.have_forces()) {
            (true, _) => Depth::Positions,
            (false, true) if reactions => Depth::Forces,
            (false, _) => Depth::Motion,
        }
    }

    /// Whether a column is of what joints and drivers carry.
    pub fn is_carried(&self, index: usize) -> bool {
        self.carried[index]
    }

    /// Room for the rows of one thread.
    pub fn room(&self) -> Room {
        Room {
            row: Vec::with_capacity(self.channels.columns().len()),
            follows: Vec::new(),
            values: Vec::with_capacity(self.places.len()),
        }
    }

    /// What makes of a row of a mechanism what follows from it; `None` if no response needs that.
    pub fn derived<'s>(&self, system: &'s System) -> Option<Derived<'s>> {
        let columns = self.channels.columns();
        let wanted = self.wanted.as_ref()?;
        Some(Derived::new(system, columns, wanted))
    }

    /// Reads the needed columns of a state, with what makes what follows of the rows of its mechanism.
    pub fn read(&self, state: State, derived: Option<&mut Derived>, room: &mut Room) {
        let Room {
            row,
            follows,
            values,
        } = room;
        let State {
            system,
            evaluation,
            inputs,
            sample,
        } = state;
        row.clear();
        self.channels
            .push_row(system, evaluation, inputs, sample, row);
        if let Some(derived) = derived {
            follows.clear();
            derived.push(row, follows);
            row.extend_from_slice(follows);
        }
        values.clear();
        values.extend(self.places.iter().map(|&place| row[place]));
    }
}

fn is_carried(column: &Column) -> bool {
    match column.channel {
        Some(
            Channel::Joint(..)
            | Channel::Section(..)
            | Channel::Relative(_, RelativeQuantity::F)
            | Channel::Driver(_, DriverQuantity::Effort)
            | Channel::Shaking(_),
        ) => true,
        Some(
            Channel::Time
            | Channel::Body(..)
            | Channel::Point(..)
            | Channel::Driver(_, DriverQuantity::Value)
            | Channel::Energy(_)
            | Channel::Relative(..)
            | Channel::Load(..)
            | Channel::Transmission(_)
            | Channel::State(..)
            | Channel::Measure(..)
            | Channel::Output(_),
        )
        | None => false,
    }
}

/// Columns with their derivatives along each thing, NaN where they are not known.
pub fn duals(values: &[f64], slopes: &[Option<Vec<f64>>]) -> Vec<Dual<f64>> {
    let columns = values.iter().enumerate();
    let columns = columns.map(|(column, &value)| {
        let of = |own: &Option<Vec<f64>>| own.as_ref().map_or(f64::NAN, |own| own[column]);
        let slopes = slopes.iter().map(of).enumerate();
        Dual {
            value,
            slope: Ok(slopes.filter(|(_, slope)| *slope != 0.0).collect()),
        }
    });
    columns.collect()
}
