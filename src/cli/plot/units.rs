//! Units of a figure: which column is drawn in which, and words for what is drawn.

use crate::cli::exit::{BadInput, Failure};
use linkdyn_model::Unit;
use linkdyn_output::read::ReadColumn;
use linkdyn_output::{
    BodyQuantity, Channel, DriverQuantity, EnergyQuantity, JointQuantity, LoadQuantity,
    RelativeQuantity, ShakingQuantity, TIME, Table,
};

/// A unit requested.
#[derive(Debug)]
struct Wanted {
    text: String,
    unit: Unit,
    is_used: bool,
}

/// The units requested.
#[derive(Debug)]
pub struct Units {
    wanted: Vec<Wanted>,
    x: Option<Wanted>,
    /// Units of the columns that were drawn.
    met: Vec<String>,
}

impl Units {
    /// Reads them.
    ///
    /// # Errors
    /// When a text is no unit.
    pub fn new(texts: &[String], x: Option<&str>) -> Result<Self, Failure> {
        let read = |option: &str, text: &str| match Unit::parse(text) {
            Ok(unit) => Ok(Wanted {
                text: text.trim().to_string(),
                unit,
                is_used: false,
            }),
            Err(_) => Err(BadInput(vec![format!(
                "{option} {text}: not a unit (such as deg, mm, rpm, kN, N*mm, deg/s^2)"
            )])),
        };
        let wanted = texts
            .iter()
            .map(|text| read("--units", text))
            .collect::<Result<_, _>>()?;
        let x = x.map(|text| read("--x-unit", text)).transpose()?;
        Ok(Units {
            wanted,
            x,
            met: Vec::new(),
        })
    }

    /// Unit and values of the x axis.
    ///
    /// # Errors
    /// When the column holds words, or its unit can't be changed into the one that was requested.
    pub fn x(&mut self, table: &Table, column: &ReadColumn) -> Result<(String, Vec<f64>), Failure> {
        let Some(wanted) = &mut self.x else {
            return self.y(table, column);
        };
        let values = table.values(column)?;
        wanted.is_used = true;
        convert(values, column, wanted).ok_or_else(|| {
            BadInput(vec![format!(
                "--x-unit {}: {} can't be told in it",
                wanted.text,
                column.label()
            )])
        })
    }

    /// Unit and values of a column.
    ///
    /// # Errors
    /// When the column holds words.
    pub fn y(&mut self, table: &Table, column: &ReadColumn) -> Result<(String, Vec<f64>), Failure> {
        let values = table.values(column)?;
        if !self.met.contains(&column.unit) {
            self.met.push(column.unit.clone());
        }
        for wanted in &mut self.wanted {
            if let Some(converted) = convert(values, column, wanted) {
                wanted.is_used = true;
                return Ok(converted);
            }
        }
        Ok((column.unit.clone(), values.to_vec()))
    }

    /// Units that no column can be told in, and why.
    pub fn unused(&self) -> Vec<String> {
        let unused = self.wanted.iter().filter(|wanted| !wanted.is_used);
        let words = |wanted: &Wanted| {
            format!(
                "{}: no column drawn can be told in it (they are in {})",
                wanted.text,
                self.met.join(", ")
            )
        };
        unused.map(words).collect()
    }
}

/// The values in another unit, where it is one of the same dimension.
fn convert(values: &[f64], column: &ReadColumn, wanted: &Wanted) -> Option<(String, Vec<f64>)> {
    let unit = Unit::parse(&column.unit).ok()?;
    unit.convert(0.0, wanted.unit)?;
    let values = values
        .iter()
        .map(|&value| unit.convert(value, wanted.unit).unwrap_or(f64::NAN));
    Some((wanted.text.clone(), values.collect()))
}

/// A number in another unit; the same where the units are.
pub fn convert_one(value: f64, from: &str, to: &str) -> Option<f64> {
    if from == to {
        Some(value)
    } else {
        Unit::parse(from)
            .ok()?
            .convert(value, Unit::parse(to).ok()?)
    }
}

/// What a result column shows, in words that columns of several owners share.
pub fn quantity_words(channel: Channel) -> &'static str {
    match channel {
        Channel::Time => TIME,
        Channel::Body(_, quantity) => motion(quantity),
        Channel::Point(_, quantity) => motion(quantity.of_body()),
        Channel::Joint(_, JointQuantity::Fx | JointQuantity::Fy)
        | Channel::Relative(_, RelativeQuantity::F)
        | Channel::Load(
            _,
            LoadQuantity::Fx | LoadQuantity::Fy | LoadQuantity::F | LoadQuantity::Stop,
        )
        | Channel::Shaking(ShakingQuantity::Fx | ShakingQuantity::Fy) => "force",
        Channel::Joint(_, JointQuantity::Ex | JointQuantity::Ey) => "eccentricity",
        Channel::Joint(_, other) => other.name(),
        Channel::Driver(_, DriverQuantity::Value) => "driver value",
        Channel::Driver(_, DriverQuantity::Effort) => DriverQuantity::Effort.name(),
        Channel::Energy(EnergyQuantity::Kinetic | EnergyQuantity::Potential) => "energy",
        Channel::Energy(other) => other.name(),
        Channel::Relative(_, RelativeQuantity::Omega) | Channel::Load(_, LoadQuantity::Omega) => {
            "angular velocity"
        }
        Channel::Relative(_, other) => other.name(),
        Channel::Load(_, other) => other.name(),
        Channel::Shaking(ShakingQuantity::Moment) => ShakingQuantity::Moment.name(),
        Channel::Transmission(quantity) => quantity.name(),
        Channel::Output(_) => "ratio",
        Channel::State(..) => "state",
        Channel::Measure(..) => "measure",
        Channel::Section(_, quantity) => quantity.kind(),
    }
}

fn motion(quantity: BodyQuantity) -> &'static str {
    match quantity {
        BodyQuantity::X | BodyQuantity::Y => "position",
        BodyQuantity::Angle => BodyQuantity::Angle.name(),
        BodyQuantity::Vx | BodyQuantity::Vy => "velocity",
        BodyQuantity::Omega => "angular velocity",
        BodyQuantity::Ax | BodyQuantity::Ay => "acceleration",
        BodyQuantity::Alpha => "angular acceleration",
    }
}
