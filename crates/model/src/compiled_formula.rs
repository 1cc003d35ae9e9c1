//! Formulas and events by the names of a model: how they are evaluated.

use std::cell::RefCell;

use crate::dimension::{Dimension, Powers};
use crate::error::Complaint;
use crate::event::Event;
use crate::expression::{Known, Misfit, Moving, Place, Results};
use crate::formula::{Argument, Coordinate, Formula, Order};
use crate::node::excerpt;
use crate::response::Catalogue;
use crate::suggest;

/// A formula that can be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct CompiledFormula {
    /// Its arithmetic; inputs are indexes of the arguments.
    pub moving: Moving,
    /// Values of its parameters, in SI.
    pub parameters: Vec<f64>,
    /// What it takes.
    pub arguments: Vec<Argument>,
}

impl Formula {
    /// Finds out how to evaluate it in a model.
    ///
    /// # Errors
    /// What is wrong with the text, at no path.
    pub fn compile(&self, catalogue: &Catalogue) -> Result<CompiledFormula, Complaint> {
        let parameters = self.parameters.iter();
        let parameters: Vec<_> = parameters
            .map(|(name, constant)| (name.as_str(), constant.quantity()))
            .collect();
        let arguments = Arguments::of(catalogue);
        let said = |misfit: Misfit| misfit.fault.at("");
        let mut moving =
            Moving::read(&self.formula, &parameters, &arguments, false).map_err(said)?;
        if let Some(table) = &self.table {
            // behind those that have names
            let number = catalogue.tables().len();
            let through = moving.through(number, table.columns()?);
            moving = through.map_err(|fault| fault.at(""))?;
        }
        Ok(CompiledFormula {
            moving,
            parameters: self.parameters.values().map(|one| one.value).collect(),
            arguments: arguments.found.into_inner(),
        })
    }

    /// What is wrong with it where a quantity of a dimension is wanted.
    pub(crate) fn fault(&self, catalogue: &Catalogue, wanted: Dimension) -> Option<Complaint> {
        match self.compile(catalogue) {
            Ok(compiled) => misfit(&compiled.moving, wanted),
            Err(complaint) => Some(complaint),
        }
    }
}

impl Event {
    /// Finds out how to evaluate it in a model.
    ///
    /// # Errors
    /// What is wrong with the text, at no path.
    pub(crate) fn compile(&self, catalogue: &Catalogue) -> Result<CompiledFormula, Complaint> {
        self.formula()?.compile(catalogue)
    }
}

/// Why an expression of the motion can't stand where a dimension is wanted.
pub(crate) fn misfit(moving: &Moving, wanted: Dimension) -> Option<Complaint> {
    if moving.fits(wanted.powers()) {
        return None;
    }
    let place = crate::expression::with_article(wanted.name(), wanted.si());
    let message = format!(
        "this is {}, where {place} is wanted",
        moving.quantity.words()
    );
    let complaint = Complaint::new("", message);
    Some(complaint.hint("its factors carry units, as in -0.5 N*s/m * slider.vx"))
}

/// The names of what moves, and which of them a text has named.
pub(crate) struct Arguments<'a> {
    catalogue: &'a Catalogue,
    found: RefCell<Vec<Argument>>,
}

impl<'a> Arguments<'a> {
    /// Of a model.
    pub fn of(catalogue: &'a Catalogue) -> Self {
        Arguments {
            catalogue,
            found: RefCell::default(),
        }
    }
}

impl Results for Arguments<'_> {
    fn find(&self, name: &str) -> Option<Known> {
        let argument = self.catalogue.argument(name)?;
        let powers = argument.powers(self.catalogue);
        let mut found = self.found.borrow_mut();
        let known = found.iter().position(|one| *one == argument);
        let index = known.unwrap_or_else(|| {
            found.push(argument);
            found.len() - 1
        });
        Some(Known {
            place: Place::Row(index),
            powers,
        })
    }

    fn table(&self, name: &str) -> Option<(usize, [Powers; 2])> {
        let mut tables = self.catalogue.tables().iter().enumerate();
        let (index, (_, columns)) = tables.find(|(_, one)| one.0 == name)?;
        Some((index, *columns))
    }

    fn tables(&self) -> Vec<String> {
        let tables = self.catalogue.tables().iter();
        tables.map(|(name, _)| name.clone()).collect()
    }

    fn missing(&self, name: &str, parameters: &[String]) -> Complaint {
        if Results::find(self.catalogue, name).is_some() {
            let message = format!("{name} follows from the forces, and can't be in one");
            return Complaint::new("", message).hint("places, angles and their rates can, and t");
        }
        let message = format!(
            "there is no parameter, and nothing that moves, called {:?}",
            excerpt(name)
        );
        let said = Complaint::new("", message);
        let names = self.catalogue.arguments();
        let all = names.iter().chain(parameters).map(String::as_str);
        match suggest::nearest(name, all) {
            Some(near) => said.hint(format!("did you mean {near:?}?")),
            None => said.hint(
                "as in crank.angle, slider.vx, rod.B.y, joint.guide.slide, force.shock.length or t",
            ),
        }
    }
}

impl Argument {
    /// Its dimension.
    pub(crate) fn powers(&self, catalogue: &Catalogue) -> Powers {
        let (is_angle, order) = match self {
            Argument::Time => return Dimension::Time.powers(),
            Argument::Input(name) => return catalogue.input(name).unwrap_or_default(),
            Argument::State(name) => return catalogue.state(name).unwrap_or_default(),
            Argument::Driver(name) => {
                let driven = catalogue.drives(name);
                return driven.unwrap_or(Dimension::Angle).powers();
            }
            Argument::Body(_, coordinate, order) | Argument::Point(_, coordinate, order) => {
                (*coordinate == Coordinate::Angle, order)
            }
            Argument::Spring(name, order) => (catalogue.spring_turns(name) == Some(true), order),
            Argument::Turn(_, order) => (true, order),
            Argument::Slide(_, order) => (false, order),
            Argument::Measure(name, order) => (catalogue.measures_angle(name) == Some(true), order),
        };
        let dimension = match (is_angle, order) {
            (true, Order::Value) => Dimension::Angle,
            (true, Order::Rate) => Dimension::AngularVelocity,
            (false, Order::Value) => Dimension::Length,
            (false, Order::Rate) => Dimension::Velocity,
        };
        dimension.powers()
    }
}
