//! The parameters of a model: read, put in the order in which they follow from each other, evaluated.

mod circles;
mod responses;

pub use responses::Moved;

use std::collections::HashMap;

use super::super::node::{Kind, Node, Origin};
use super::super::suggest;
use super::written::{Written, quantity, refused_name};
use super::{Expression, Fault, Misfit, Number, Quantity, is_expression};
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::tolerance::Tolerance;

/// A parameter as resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// In SI.
    pub value: f64,
    /// SI unit; empty of a plain number.
    pub unit: String,
    /// Its dimension; none of a plain number, nor of what has no name among the dimensions.
    pub dimension: Option<Dimension>,
    /// What the file says: a number, text with a unit, or an expression.
    pub text: String,
    /// Its own deviation; what it follows from has that of its own.
    pub tolerance: Option<Tolerance>,
}

/// A fault, and the node and byte of its text at which it stands.
pub struct Found<'a> {
    pub node: &'a Node,
    /// None: the value as a whole.
    pub at: Option<usize>,
    pub complaint: Complaint,
}

/// All parameters.
pub struct Parameters {
    pub(super) names: Vec<String>,
    places: HashMap<String, usize>,
    pub(super) written: Vec<Written>,
    values: Vec<Option<Quantity>>,
    /// Whether the value stands in an object, beside its tolerance.
    keyed: Vec<bool>,
    /// Values in the place of written ones.
    given: HashMap<usize, f64>,
    /// Own deviations, on top of what they are without.
    deviations: HashMap<usize, f64>,
    used: Vec<bool>,
    /// Whether plain numbers of angles are in another unit than radians.
    pub(super) degrees: bool,
}

impl Parameters {
    /// Reads and evaluates them; the faults come with it.
    pub fn read(node: Option<&Node>, degrees: bool) -> (Parameters, Vec<Found<'_>>) {
        let mut faults = Vec::new();
        let mut nodes = Vec::new();
        let mut parameters = Parameters {
            names: Vec::new(),
            places: HashMap::new(),
            written: Vec::new(),
            values: Vec::new(),
            keyed: Vec::new(),
            given: HashMap::new(),
            deviations: HashMap::new(),
            used: Vec::new(),
            degrees,
        };
        match node.map(|node| (&node.kind, node)) {
            None => {}
            Some((Kind::Object(members), _)) => {
                let members = members
                    .iter()
                    .filter(|(key, member)| *key != "note" || member.node.as_str().is_none());
                for (key, member) in members {
                    if let Some((message, hint)) = refused_name(key) {
                        let complaint = Complaint::new(path(key), message).hint(hint);
                        faults.push(Found {
                            node: &member.node,
                            at: None,
                            complaint,
                        });
                    }
                    parameters
                        .places
                        .insert(key.clone(), parameters.names.len());
                    parameters.names.push(key.clone());
                    let (node, is_keyed) = nominal(&member.node);
                    nodes.push(node);
                    parameters.keyed.push(is_keyed);
                }
            }
            Some((_, node)) => {
                let message = format!("an object is expected, not {}", node.kind_name());
                faults.push(Found {
                    node,
                    at: None,
                    complaint: Complaint::new("parameters", message),
                });
            }
        }
        parameters.used = vec![false; nodes.len()];
        parameters.written = nodes
            .iter()
            .enumerate()
            .map(|(index, node)| parameters.read_one(node, index, &mut faults))
            .collect();
        parameters.evaluate_all(&nodes, &mut faults);
        (parameters, faults)
    }

    /// Gives parameters other values \[SI\], each in the dimension that it has, and evaluates what follows from them.
    ///
    /// # Errors
    /// A name that no parameter has, a value that is not finite, and what can't be evaluated with it.
    pub fn give(
        &mut self,
        node: Option<&Node>,
        values: &[(&str, f64)],
    ) -> Result<(), Vec<Complaint>> {
        self.given = self.by_place(values)?;
        self.again(node)
    }

    /// Lets parameters deviate \[SI\], on top of the values that they have or follow from.
    ///
    /// # Errors
    /// As [`Parameters::give`].
    pub fn deviate(
        &mut self,
        node: Option<&Node>,
        deviations: &[(&str, f64)],
    ) -> Result<(), Vec<Complaint>> {
        self.deviations = self.by_place(deviations)?;
        self.again(node)
    }

    fn by_place(&self, values: &[(&str, f64)]) -> Result<HashMap<usize, f64>, Vec<Complaint>> {
        let mut places = HashMap::new();
        for (name, value) in values {
            let Some(&place) = self.places.get(*name) else {
                let complaint =
                    Complaint::new("parameters", format!("there is no parameter {name:?}"));
                let hint = format!("the parameters: {}", suggest::list(self.names.iter()));
                return Err(vec![complaint.hint(hint)]);
            };
            if !value.is_finite() {
                let complaint = Complaint::new(path(name), "a finite number is expected");
                return Err(vec![complaint.found(value.to_string())]);
            }
            places.insert(place, *value);
        }
        Ok(places)
    }

    fn again(&mut self, node: Option<&Node>) -> Result<(), Vec<Complaint>> {
        let found = |name: &String| node.and_then(|node| Some(nominal(node.get(name)?).0));
        let nodes: Vec<&Node> = self.names.iter().filter_map(found).collect();
        let mut faults = Vec::new();
        self.evaluate_all(&nodes, &mut faults);
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults.into_iter().map(|fault| fault.complaint).collect())
        }
    }

    fn read_one<'a>(&self, node: &'a Node, index: usize, faults: &mut Vec<Found<'a>>) -> Written {
        let mut add = |at: Option<usize>, fault: Fault| {
            let complaint = fault.at(self.path(index));
            faults.push(Found {
                node,
                at,
                complaint,
            });
            Written::Faulty
        };
        match &node.kind {
            Kind::Number(number) => match number.as_f64() {
                Some(value) if value.is_finite() => Written::Value(Quantity::plain(value)),
                Some(_) | None => add(None, Fault::new("the number is too large for a double")),
            },
            Kind::String(text) if is_expression(text) => match self.parse(text) {
                Ok(expression) => Written::Expression(expression),
                Err(misfit) => add(Some(misfit.at), misfit.fault),
            },
            Kind::String(text) => {
                quantity(text).map_or_else(|fault| add(None, fault), Written::Value)
            }
            // that its value is missing is complained about with its other keys
            Kind::Object(_) if !self.keyed[index] => Written::Faulty,
            Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => {
                let message = format!("a number is expected, not {}", node.kind_name());
                add(
                    None,
                    Fault::new(message)
                        .hint("or text: with a unit, such as \"5 mm\", or an expression, \"=2*r\""),
                )
            }
        }
    }

    pub(super) fn parse(&self, text: &str) -> Result<Expression, Misfit> {
        Expression::parse(text, &|name| self.places.get(name).copied(), &self.names)
    }

    /// Evaluates each after those that it names, and complains about circles.
    fn evaluate_all<'a>(&mut self, nodes: &[&'a Node], faults: &mut Vec<Found<'a>>) {
        let nominal = std::mem::replace(&mut self.values, vec![None; self.written.len()]);
        for written in &self.written {
            if let Written::Expression(expression) = written {
                expression
                    .parameters()
                    .for_each(|named| self.used[named] = true);
            }
        }
        let (values, waits) = self.follow(|index, value| {
            let nominal = nominal.get(index).copied().flatten();
            let value = match (self.given.get(&index).zip(nominal), value) {
                (Some((&value, nominal)), _) => Some(nominal.with_value(value)),
                (None, Ok(value)) => value,
                (None, Err(Misfit { at, fault })) => {
                    faults.push(Found {
                        node: nodes[index],
                        at: Some(at),
                        complaint: fault.at(self.path(index)),
                    });
                    None
                }
            };
            match self.deviations.get(&index) {
                Some(deviation) => value.map(|one| one.with_value(one.value + deviation)),
                None => value,
            }
        });
        self.values = values;
        self.circles(nodes, &waits, faults);
    }

    /// All values, each after those that it names, as `own` keeps them; and how many each one still waits for.
    pub(super) fn follow<N: Number>(
        &self,
        mut own: impl FnMut(usize, Result<Option<Quantity<N>>, Misfit>) -> Option<Quantity<N>>,
    ) -> (Vec<Option<Quantity<N>>>, Vec<usize>) {
        let (order, waits) = self.order();
        let mut values = vec![None; self.written.len()];
        for index in order {
            let value = match &self.written[index] {
                Written::Value(value) => Ok(Some(value.with_value(N::of(value.value)))),
                Written::Faulty => Ok(None),
                Written::Expression(expression) => expression.evaluate(&values, self.degrees),
            };
            values[index] = own(index, value);
        }
        (values, waits)
    }

    /// Each after those that it names, and how many each one still waits for.
    pub(super) fn order(&self) -> (Vec<usize>, Vec<usize>) {
        let written = &self.written;
        let mut followers: Vec<Vec<usize>> = vec![Vec::new(); written.len()];
        let mut waits = vec![0_usize; written.len()];
        for (index, written) in written.iter().enumerate() {
            if let Written::Expression(expression) = written {
                for named in expression.parameters() {
                    followers[named].push(index);
                    waits[index] += 1;
                }
            }
        }
        let mut ready: Vec<usize> = (0..written.len())
            .filter(|&index| waits[index] == 0)
            .collect();
        let mut order = Vec::with_capacity(written.len());
        while let Some(index) = ready.pop() {
            order.push(index);
            for &follower in &followers[index] {
                waits[follower] -= 1;
                if waits[follower] == 0 {
                    ready.push(follower);
                }
            }
        }
        (order, waits)
    }

    /// The value of an expression somewhere in the model; `None` if a parameter has none.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn evaluate(&mut self, text: &str) -> Result<Option<Quantity>, Misfit> {
        let expression = self.parse(text)?;
        expression
            .parameters()
            .for_each(|index| self.used[index] = true);
        expression.evaluate(&self.values, self.degrees)
    }

    /// All names, in the order of the file.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether there is one of this name.
    pub fn has(&self, name: &str) -> bool {
        self.places.contains_key(name)
    }

    /// The value of a parameter, where it has one.
    pub fn value(&self, name: &str) -> Option<Quantity> {
        *self.values.get(*self.places.get(name)?)?
    }

    /// Where the value of a parameter stands.
    fn path(&self, index: usize) -> String {
        let path = path(&self.names[index]);
        if self.keyed[index] {
            format!("{path}.value")
        } else {
            path
        }
    }

    /// All that have a value, as written in a node.
    pub fn resolved(&self, node: Option<&Node>) -> Vec<Parameter> {
        let found = self.names.iter().zip(&self.values);
        let resolved = found.filter_map(|(name, value)| {
            let value = (*value)?;
            let text = match &nominal(node?.get(name)?).0.kind {
                Kind::Number(number) => number.to_string(),
                Kind::String(text) => text.clone(),
                Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => return None,
            };
            Some(Parameter {
                name: name.clone(),
                value: value.value,
                unit: value.unit(),
                dimension: value.dimension(),
                text,
                tolerance: None,
            })
        });
        resolved.collect()
    }

    /// A complaint per parameter that nothing uses, and whether `--set` brought it.
    pub fn unused(&self, node: Option<&Node>) -> Vec<(Complaint, bool)> {
        let Some(Kind::Object(members)) = node.map(|node| &node.kind) else {
            return Vec::new();
        };
        let unused = self
            .names
            .iter()
            .zip(&self.used)
            .filter(|(_, used)| !**used);
        let complaints = unused.filter_map(|(name, _)| {
            let complaint = Complaint::new(path(name), "no expression uses this parameter");
            let others = self
                .names
                .iter()
                .map(String::as_str)
                .filter(|other| other != name);
            let complaint = match suggest::nearest(name, others) {
                Some(near) => complaint.hint(format!("did you mean {near:?}?")),
                None => complaint,
            };
            Some((complaint, matches!(members.get(name)?.key, Origin::Set(_))))
        });
        complaints.collect()
    }
}

/// The node of a parameter's value, and whether it stands in an object.
fn nominal(node: &Node) -> (&Node, bool) {
    node.get("value")
        .map_or((node, false), |value| (value, true))
}

fn path(name: &str) -> String {
    format!("parameters.{name}")
}
