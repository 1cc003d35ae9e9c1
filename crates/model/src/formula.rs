//! Formulas: forces as functions of what moves, `"value": "=stall*(1 - crank.omega/idle)"`.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::point::PointRef;
use crate::response::Constant;
use crate::table::Table;

/// A force, or a part of one, as a function of time and of quantities that move.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
pub struct Formula {
    /// The expression with its sign, `=-c*slider.vx`.
    pub formula: String,
    /// The parameters that it names.
    #[serde(default)]
    pub parameters: IndexMap<String, Constant>,
    /// Through which its value goes.
    pub table: Option<Table>,
}

/// What a formula takes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Argument {
    /// Time \[s\].
    Time,
    /// Value of a driver \[rad or m\].
    Driver(String),
    /// A number from outside.
    Input(String),
    /// An integrated state.
    State(String),
    /// A coordinate of a body's frame \[m or rad\].
    Body(String, Coordinate, Order),
    /// A coordinate of a point, never an angle \[m\].
    Point(PointRef, Coordinate, Order),
    /// Distance of a spring's points or length of a cable's path \[m\], or angle of the second body of a torsion spring in the first
    /// \[rad\].
    Spring(String, Order),
    /// Angle of a joint's second body in the first \[rad\].
    Turn(String, Order),
    /// Slide of a joint along its axis, first point to second \[m\].
    Slide(String, Order),
    /// A measure [m or rad].
    Measure(String, Order),
}

/// A coordinate of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinate {
    /// \[m\]
    X,
    /// \[m\]
    Y,
    /// \[rad\]
    Angle,
}

/// A quantity or its rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// The quantity.
    Value,
    /// Its derivative by time.
    Rate,
}

impl Formula {
    /// A formula that names no parameters.
    pub fn new(formula: impl Into<String>) -> Self {
        Formula {
            formula: formula.into(),
            parameters: IndexMap::new(),
            table: None,
        }
    }
}

impl Argument {
    /// Whether it is a quantity or a rate.
    pub(crate) fn order(&self) -> Order {
        match self {
            Argument::Time | Argument::Driver(_) | Argument::Input(_) | Argument::State(_) => {
                Order::Value
            }
            Argument::Body(_, _, order)
            | Argument::Point(_, _, order)
            | Argument::Spring(_, order)
            | Argument::Turn(_, order)
            | Argument::Slide(_, order)
            | Argument::Measure(_, order) => *order,
        }
    }
}
