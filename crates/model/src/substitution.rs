//! Other values of parameters in a model whose file is not read again.
//!
//! The numbers that follow from parameters are written over those of the model that was read. That this gives the model
//! that reading would is not believed but tried, at the values of the file and beside them; a file that says more than
//! the numbers known here has no substitution, and is read again for each set of values.

#[cfg(test)]
mod tests;

use std::cmp::Ordering;

use serde::Deserialize;

use crate::examples::fits;
use crate::expression::{Chain, Given, Program, Room};
use crate::gate::Checked;
use crate::source::Source;
use crate::tree::Tree;
use crate::walk::recorded;
use crate::{Model, Parameter};

/// Places of numbers on which there is no rule but one on their sign, and what a joint says of its own (`conflict`): of others only
/// reading can tell what is wrong.
const KNOWN: [&str; 23] = [
    "gravity.*",
    "bodies.*.mass",
    "bodies.*.inertia",
    "bodies.*.com.*",
    "bodies.*.points.**",
    "bodies.*.pose.**",
    "joints.*.axis.*",
    "joints.*.radii.*",
    "joints.*.face.*",
    "joints.*.radius|offset|angle|ratio|pretension|roller_radius|pin_radius",
    "joints.*.torsional_stiffness|torsional_damping|free_angle",
    "joints.*.clearance.radius|bearing_radius|axial_length",
    "joints.*.active|lock.release",
    "**.parameters.*.value",
    "drivers|forces.**.coefficients.*",
    "drivers|forces.**.start|rise|end|begin|duration|dwell",
    "drivers|forces.**.offset|amplitude|frequency|phase|velocity|acceleration|jerk",
    "forces.*.stiffness|damping|free_length|free_angle|value|force",
    "forces.*.vector.*",
    "forces.**.table.points.*.1",
    "tables.*.points.*.1",
    "inputs.*.start",
    "states.*.start",
];

/// What puts numbers into a model.
#[derive(Debug, Clone)]
pub struct Substitution {
    given: Given,
    /// The parameters that are given, by their index.
    inputs: Vec<usize>,
    chain: Chain,
    /// Parts of the model that numbers are put into, in SI.
    parts: Vec<Component>,
    leaves: Vec<LeafNumber>,
    /// Constants of responses.
    constants: Vec<NamedConstant>,
    nominal: Checked,
}

/// A number of the model.
#[derive(Debug, Clone)]
struct LeafNumber {
    path: String,
    /// The number of its part, and the steps from there.
    part: usize,
    steps: Vec<String>,
    program: Program,
    /// The SI value of a one there.
    factor: f64,
    /// What it is in the model that was read.
    nominal: f64,
    /// Whether it is a place, on whose sign there is no rule.
    is_place: bool,
}

/// A part of the model: a body, a joint, a driver and the like.
#[derive(Debug, Clone)]
struct Component {
    map: String,
    name: String,
    tree: Tree,
}

impl Component {
    /// Of a whole model.
    fn of(model: &Tree, map: &str, name: &str) -> Option<Component> {
        let tree = match map {
            "gravity" => model.get(map)?,
            map => model.get(map)?.get(name)?,
        };
        Some(Component {
            map: map.to_owned(),
            name: name.to_owned(),
            tree: tree.clone(),
        })
    }

    /// Makes the part of the model what a tree says.
    fn put(&self, tree: &Tree, model: &mut Model) -> Option<()> {
        fn set<'t, T: Deserialize<'t>>(place: Option<&mut T>, tree: &'t Tree) -> Option<()> {
            *place? = T::deserialize(tree).ok()?;
            Some(())
        }
        match self.map.as_str() {
            "gravity" => set(Some(&mut model.gravity), tree),
            "bodies" => set(model.bodies.get_mut(&self.name), tree),
            "joints" => {
                set(model.joints.get_mut(&self.name), tree)?;
                let fits = model.joints[&self.name].kind.conflict().is_none();
                fits.then_some(())
            }
            "drivers" => set(model.drivers.get_mut(&self.name), tree),
            "forces" => set(model.forces.get_mut(&self.name), tree),
            "tables" => set(model.tables.get_mut(&self.name), tree),
            "inputs" => set(model.inputs.get_mut(&self.name), tree),
            "states" => set(model.states.get_mut(&self.name), tree),
            _ => None,
        }
    }
}

/// Where the number at a path of the file stands in the tree of its part; `None` if that leads nowhere.
fn steps_to(mut tree: &Tree, path: &[&str]) -> Option<Vec<String>> {
    let mut steps = Vec::new();
    let mut enter = |tree: &mut &Tree, step: &str| {
        *tree = match *tree {
            Tree::List(items) => items.get(step.parse::<usize>().ok()?)?,
            map => map.get(step)?,
        };
        steps.push(step.to_owned());
        Some(())
    };
    for step in path {
        // the points of a formula stand in its table
        if tree.get("formula").is_some() && *step != "parameters" {
            enter(&mut tree, "table")?;
        }
        enter(&mut tree, step)?;
    }
    // a parameter has its dimension beside it
    if tree.get("powers").is_some() {
        enter(&mut tree, "value")?;
    }
    tree.number().map(|_| steps)
}

fn number<'t>(tree: &'t mut Tree, steps: &[String]) -> Option<&'t mut f64> {
    let found = steps.iter().try_fold(tree, |tree, step| match tree {
        Tree::Map(members) => members.get_mut(step),
        Tree::List(items) => items.get_mut(step.parse::<usize>().ok()?),
        Tree::Null | Tree::Number(_) | Tree::Count(_) | Tree::Flag(_) | Tree::Text(_) => None,
    });
    match found? {
        Tree::Number(number) => Some(number),
        Tree::Null
        | Tree::Count(_)
        | Tree::Flag(_)
        | Tree::Text(_)
        | Tree::List(_)
        | Tree::Map(_) => None,
    }
}

/// What rules ask of a number: its sign, and that it is no number of another world.
fn class(value: f64) -> Option<Ordering> {
    const LARGE: f64 = 1e100;
    // −0 is no less than 0
    (value.abs() < LARGE).then(|| value.partial_cmp(&0.0))?
}

/// A parameter that a response names, by their indexes.
#[derive(Debug, Clone, Copy)]
struct NamedConstant {
    response: usize,
    constant: usize,
    parameter: usize,
}

/// The steps of a path, `bodies.crank.points.A[0]`: names and indexes.
fn split(path: &str) -> Vec<&str> {
    let parts = path.split(['.', '[']);
    parts
        .map(|part| part.strip_suffix(']').unwrap_or(part))
        .collect()
}

/// Whether a path is that of a point of a body, or of where it is drawn.
fn is_place(path: &[&str]) -> bool {
    matches!(path, ["bodies", _, "points" | "pose", ..])
}

/// A model that numbers are put into, of one thread.
#[derive(Debug, Clone)]
pub struct Substituted {
    model: Checked,
    /// The parts as trees.
    trees: Vec<Tree>,
    room: Room,
    numbers: Vec<f64>,
}

/// Parts by which parameters are changed to see whether the model is the one that reading gives.
const BESIDE: [f64; 2] = [7.3e-4, -1.9e-3];

impl Substitution {
    /// Of a model, its parameters, and the source that both were read from; `None` if reading again is the only way.
    pub fn new(
        source: &Source,
        nominal: &Checked,
        known: &[Parameter],
        names: &[&str],
        given: Given,
    ) -> Option<Self> {
        let (parameters, recorded) = recorded(source);
        let inputs = names.iter().map(|name| parameters.index(name));
        let whole = Tree::of::<Model>(nominal);
        let mut parts: Vec<Component> = Vec::new();
        let mut leaves = Vec::new();
        for one in recorded {
            let Some(program) = parameters.program(&one.text) else {
                continue;
            };
            let path = split(&one.path);
            let beginning = if path[0] == "gravity" { 1 } else { 2 };
            let (of, rest) = path.split_at_checked(beginning)?;
            let (map, name) = (of[0], of.get(1).copied().unwrap_or_default());
            // The mass of an elastic body follows from its numbers, and there are rules on its points.
            let body = nominal.bodies.get(name).filter(|_| map == "bodies");
            if body.is_some_and(|body| body.elastic.is_some()) {
                return None;
            }
            let known = parts
                .iter()
                .position(|part| part.map == map && part.name == name);
            let part = known.unwrap_or(parts.len());
            if known.is_none() {
                parts.push(Component::of(&whole, map, name)?);
            }
            let steps = steps_to(&parts[part].tree, rest)?;
            let place: Vec<&str> = { of.iter().copied() }
                .chain(steps.iter().map(String::as_str))
                .collect();
            let mut known = KNOWN
                .iter()
                .map(|pattern| pattern.split('.').collect::<Vec<_>>());
            known.find(|pattern| fits(pattern, &place))?;
            leaves.push(LeafNumber {
                nominal: *number(&mut parts[part].tree, &steps)?,
                is_place: is_place(&path),
                path: one.path,
                part,
                steps,
                program,
                factor: one.factor,
            });
        }
        let mut constants = Vec::new();
        for (response, own) in nominal.responses.values().enumerate() {
            for (constant, name) in own.parameters.keys().enumerate() {
                constants.push(NamedConstant {
                    response,
                    constant,
                    parameter: parameters.index(name)?,
                });
            }
        }
        let substitution = Substitution {
            given,
            inputs: inputs.collect::<Option<_>>()?,
            chain: parameters.chain()?,
            parts,
            leaves,
            constants,
            nominal: nominal.clone(),
        };
        substitution
            .is_proven(source, known, names)
            .then_some(substitution)
    }

    /// Whether it gives what reading gives, at the values of the file and beside them.
    fn is_proven(&self, source: &Source, known: &[Parameter], names: &[&str]) -> bool {
        let value = |name: &&str| {
            let found = known.iter().find(|parameter| parameter.name == **name);
            found.map(|parameter| parameter.value)
        };
        let Some(values) = names.iter().map(value).collect::<Option<Vec<f64>>>() else {
            return false;
        };
        let mut place = self.begin();
        [0.0].into_iter().chain(BESIDE).all(|part| {
            // a part of its own for each, so that an exchange would be seen
            let given = values.iter().enumerate().map(|(k, value)| {
                let change = part * value * (1.0 + k as f64 / 16.0);
                match self.given {
                    Given::Values => value + change,
                    Given::Deviations => change,
                }
            });
            let given: Vec<f64> = given.collect();
            let pairs = names.iter().copied().zip(given.iter().copied());
            let pairs: Vec<(&str, f64)> = pairs.collect();
            let read = match self.given {
                Given::Values => source.with_parameters(&pairs),
                Given::Deviations => source.with_deviations(&pairs),
            };
            match read {
                Ok(read) => self.put(&given, &mut place) == Some(&read),
                // beside the values of the file there may be no model
                Err(_) => part != 0.0,
            }
        })
    }

    /// A model to put numbers into.
    pub fn begin(&self) -> Substituted {
        Substituted {
            model: self.nominal.clone(),
            trees: self.parts.iter().map(|part| part.tree.clone()).collect(),
            room: Room::default(),
            numbers: Vec::with_capacity(self.leaves.len()),
        }
    }

    /// Whether the places of a file whose paths begin so have numbers that follow from parameters.
    pub fn changes(&self, beginning: &str) -> bool {
        self.leaves
            .iter()
            .any(|leaf| leaf.path.starts_with(beginning))
    }

    /// The value of a parameter that a response names \[SI\], after [`Substitution::put`].
    pub fn value(&self, name: &str, place: &Substituted) -> Option<f64> {
        let of = |one: &&NamedConstant| {
            let (_, response) = self.nominal.responses.get_index(one.response)?;
            let (known, _) = response.parameters.get_index(one.constant)?;
            Some(known == name)
        };
        let constant = self.constants.iter().find(|one| of(one) == Some(true))?;
        place.room.values.get(constant.parameter).copied()
    }

    /// Works out the parameters with values, or deviations, in the order of the names, for [`Substitution::value`].
    pub fn evaluate(&self, given: &[f64], place: &mut Substituted) -> bool {
        self.chain
            .evaluate(self.given, &self.inputs, given, &mut place.room)
    }

    /// The model with values, or deviations, in the order of the names; `None` if only reading can tell what is wrong
    /// with them.
    pub fn put<'p>(&self, given: &[f64], place: &'p mut Substituted) -> Option<&'p Checked> {
        let mut numbers = std::mem::take(&mut place.numbers);
        let are_sound = self.numbers(given, place, &mut numbers);
        let found = are_sound
            .then(|| self.put_numbers(&numbers, place))
            .flatten();
        let is_put = found.is_some();
        place.numbers = numbers;
        is_put.then_some(&place.model)
    }

    /// The numbers of the model with values, in an order of its own; false if only reading can tell what is wrong with them.
    pub fn numbers(&self, given: &[f64], place: &mut Substituted, numbers: &mut Vec<f64>) -> bool {
        if !self.evaluate(given, place) {
            return false;
        }
        let room = &mut place.room;
        numbers.clear();
        self.leaves.iter().all(|leaf| {
            let value = leaf.program.sound_value(&room.values, &mut room.stack) * leaf.factor;
            numbers.push(value);
            // Rules on a number are on its sign: in the class of the nominal one it keeps them.
            let class = class(value);
            match leaf.is_place {
                true => class.is_some(),
                false => class == self::class(leaf.nominal),
            }
        })
    }

    /// Where the numbers of [`Substitution::numbers`] stand in the file, and what they are there.
    pub fn nominal_numbers(&self) -> impl Iterator<Item = (&str, f64)> {
        let leaves = self.leaves.iter();
        leaves.map(|leaf| (leaf.path.as_str(), leaf.nominal))
    }

    /// The model with these numbers.
    pub fn put_numbers<'p>(
        &self,
        numbers: &[f64],
        place: &'p mut Substituted,
    ) -> Option<&'p Checked> {
        let Substituted {
            model, trees, room, ..
        } = place;
        for (leaf, value) in self.leaves.iter().zip(numbers) {
            *number(&mut trees[leaf.part], &leaf.steps)? = *value;
        }
        let words = model.numbers();
        for (part, tree) in self.parts.iter().zip(trees) {
            part.put(tree, words)?;
        }
        for one in &self.constants {
            let value = room.values.get(one.parameter)?;
            words.responses[one.response].parameters[one.constant].value = *value;
        }
        Some(model)
    }
}
