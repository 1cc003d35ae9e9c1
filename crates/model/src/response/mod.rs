//! Responses: named numbers of a run, such as a stroke or a peak.

mod arguments;
mod bodies;
mod catalogue;
mod facts;
mod names;

pub use crate::expression::{
    Compiled, DEEPEST_STACK, Dual, Fixed, Input, Known, Look, MOST_ARGUMENTS, Moving, Number, Over,
    Place, Program, Reduce, Reduction, Results, Tangent, Values,
};
pub use catalogue::Catalogue;
pub use facts::{ClearanceSum, EVENTS, Fact, Item, List};

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::error::Complaint;
use crate::expression::{Expression, Misfit, Quantity};

/// A named number of a run.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
pub struct Response {
    /// The expression, `max(piston.x) - min(piston.x)`.
    pub value: String,
    /// Lower and upper limit, in SI.
    pub limits: Option<[f64; 2]>,
    /// The unit in which it is shown; ignored for anything else.
    pub unit: Option<String>,
    /// The parameters that the expression names.
    #[serde(default)]
    pub parameters: IndexMap<String, Constant>,
}

/// A parameter as a response knows it.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize)]
pub struct Constant {
    /// In SI.
    pub value: f64,
    /// Exponents of length, mass, time and angle.
    pub powers: [f64; 4],
}

impl Response {
    /// A response that names no parameters.
    pub fn new(value: impl Into<String>) -> Self {
        Response {
            value: value.into(),
            limits: None,
            unit: None,
            parameters: IndexMap::new(),
        }
    }

    /// Finds out how to evaluate it where results have these names.
    ///
    /// # Errors
    /// What is wrong with the text, at no path.
    pub fn compile(&self, results: &dyn Results) -> Result<Compiled, Complaint> {
        let parameters = self.parameters.iter();
        let parameters: Vec<_> = parameters
            .map(|(name, constant)| (name.as_str(), constant.quantity()))
            .collect();
        let compiled = Compiled::read(&self.value, &parameters, results, false);
        compiled.map_err(|misfit: Misfit| misfit.fault.at(""))
    }
}

/// An expression with the values of parameters in the place of their names.
pub(crate) fn self_contained(text: &str, parameters: &IndexMap<String, Constant>) -> String {
    let mut whole = text.to_owned();
    let names: Vec<String> = parameters.keys().cloned().collect();
    let find = |name: &str| parameters.get_index_of(name);
    // whatever else is named stays as it is
    let Ok(expression) = Expression::response(text, &find, &names, &Anything) else {
        return whole;
    };
    for (at, index) in expression.places().into_iter().rev() {
        let value = parameters[index].text();
        whole.replace_range(at..at + names[index].len(), &value);
    }
    whole
}

/// Takes any name for that of a column.
struct Anything;

impl Results for Anything {
    fn find(&self, _: &str) -> Option<Known> {
        Some(Known {
            place: Place::Row(0),
            powers: crate::Powers::default(),
        })
    }

    fn table(&self, _: &str) -> Option<(usize, [crate::Powers; 2])> {
        Some((0, Default::default()))
    }

    fn missing(&self, name: &str, _: &[String]) -> Complaint {
        Complaint::new("", name)
    }
}

impl Constant {
    /// As an expression writes it.
    fn text(&self) -> String {
        let quantity = self.quantity();
        match quantity.dimension() {
            _ if quantity.is_pure() => format!("({:?})", self.value),
            Some(dimension) => format!("({:?} {})", self.value, dimension.si()),
            None => {
                let units = ["m", "kg", "s", "rad"].into_iter().zip(self.powers);
                let units = units.filter(|(_, power)| *power != 0.0);
                let units = units.map(|(unit, power)| format!("*(1 {unit})^({power:?})"));
                format!("({:?}{})", self.value, units.collect::<String>())
            }
        }
    }

    pub(crate) fn new(quantity: Quantity) -> Self {
        Constant {
            value: quantity.value,
            powers: quantity.powers(),
        }
    }

    pub(crate) fn quantity(&self) -> Quantity {
        Quantity::of_powers(self.value, self.powers)
    }
}
