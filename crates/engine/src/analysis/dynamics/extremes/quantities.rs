//! What is watched for its extremes: columns, and sizes of forces.

use linkdyn_output::{Channel, Column, DriverQuantity, EnergyQuantity, JointQuantity, Selection};

/// Columns that are watched at most: in a large mechanism those of joints and drivers.
const MOST_WATCHED: usize = 1000;

/// What is watched: a column, or the size of a joint's force, of whose components the columns are.
#[derive(Debug, Clone, Copy)]
pub enum WatchedQuantity {
    /// By number.
    Column(usize),
    /// Of these two columns.
    Size([usize; 2]),
}

/// A quantity and what is known of it beforehand.
#[derive(Debug, Clone, Copy)]
pub struct Watched {
    /// What it is.
    pub quantity: WatchedQuantity,
    /// Number of its unit.
    pub unit: usize,
    /// Column of its rate.
    pub rate: Option<usize>,
    /// It only grows as a rule, or is prescribed, or changes at events alone: a first step is no reason to look closer.
    pub steady: bool,
    /// It belongs to a joint with contact.
    pub of_contact: bool,
}

impl WatchedQuantity {
    /// Its value in a row.
    pub fn of(self, row: &[f64]) -> f64 {
        match self {
            WatchedQuantity::Column(column) => row[column],
            WatchedQuantity::Size([x, y]) => row[x].hypot(row[y]),
        }
    }
}

/// The quantities of these columns, and how many units they have.
pub fn watched(columns: &[Column], patterns: &[String]) -> (Vec<Watched>, usize) {
    let at = |channel: Channel| {
        let is_it = |column: &Column| column.channel == Some(channel);
        columns.iter().position(is_it)
    };
    let mut units: Vec<&'static str> = Vec::new();
    let mut unit = |column: &Column| {
        units
            .iter()
            .position(|unit| *unit == column.unit)
            .unwrap_or_else(|| {
                units.push(column.unit);
                units.len() - 1
            })
    };
    let mut found: Vec<(usize, Watched)> = Vec::new();
    let selected = Selection::new(columns, patterns).columns;
    for id in &selected {
        let index = id.index();
        let column = &columns[index];
        let Some(channel) = column.channel.filter(|channel| *channel != Channel::Time) else {
            continue;
        };
        // Those that count most come first where there are too many.
        let (rank, steady, joint) = match channel {
            Channel::Joint(joint, quantity) => (0, quantity == JointQuantity::State, Some(joint)),
            Channel::Driver(_, quantity) => (1, quantity == DriverQuantity::Value, None),
            Channel::Energy(quantity) => (1, quantity == EnergyQuantity::Dissipated, None),
            Channel::Time
            | Channel::Body(..)
            | Channel::Point(..)
            | Channel::Load(..)
            | Channel::Shaking(_)
            | Channel::Transmission(_)
            | Channel::Relative(..)
            | Channel::State(..)
            | Channel::Measure(..)
            | Channel::Section(..)
            | Channel::Output(_) => (2, false, None),
        };
        let of_joint = |quantity| at(Channel::Joint(joint?, quantity));
        let of_contact = of_joint(JointQuantity::Eccentricity).is_some();
        let unit = unit(column);
        found.push((
            rank,
            Watched {
                quantity: WatchedQuantity::Column(index),
                unit,
                rate: channel.rate().and_then(at),
                steady,
                of_contact,
            },
        ));
        let across = match channel {
            Channel::Joint(_, JointQuantity::Fx) => of_joint(JointQuantity::Fy),
            _ => None,
        };
        if let Some(across) =
            across.filter(|across| selected.iter().any(|id| id.index() == *across))
        {
            let quantity = WatchedQuantity::Size([index, across]);
            found.push((
                0,
                Watched {
                    quantity,
                    unit,
                    rate: None,
                    steady: false,
                    of_contact,
                },
            ));
        }
    }
    found.sort_by_key(|(rank, _)| *rank);
    found.truncate(MOST_WATCHED);
    (
        found.into_iter().map(|(_, watched)| watched).collect(),
        units.len(),
    )
}
