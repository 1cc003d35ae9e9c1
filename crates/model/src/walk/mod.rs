//! The tree of a file against the descriptions of its words: all faults of syntax, shape and units at once, and every
//! quantity turned into SI on the way.
//!
//! What is faulty becomes something of the right kind, and its path a hole, so that later checks know not to blame
//! anything else for it.

mod filler;
mod formula;
mod input;
mod lists;
mod object;
mod optimise;
mod otherwise;
mod parameter;
mod quantity;
mod response;
mod state;
mod table;
mod units;

pub use lists::{COLUMNS, entry_driven};
pub use object::{NOTE, body_of, shape_of};
pub use otherwise::{recorded, walk_deviating, walk_given};
pub use units::{Driven, Units, display};

use std::collections::HashMap;

use crate::tree::Tree;

use crate::dimension::{Dimension, Powers};
use crate::error::Complaint;
use crate::examples;
use crate::expression::{Found, Parameter, Parameters, Recorded};
use crate::gate::Holes;
use crate::input::ModelInput;
use crate::node::{Kind, Node, Origin, members};
use crate::response::Catalogue;
use crate::shape::{Bound, Choice, Shape};
use crate::source::Source;
use crate::state::State;
use crate::suggest;
use crate::table::Table;
use crate::tolerance::Tolerance;
use crate::words;

/// Complaints after which the rest is only counted; placing them takes time.
const ENOUGH: usize = 200;

/// A text without a dot, where a point is wanted.
pub struct Undotted {
    /// Where it stands.
    pub path: String,
    /// The text.
    pub text: String,
}

/// What the walk found.
pub struct Findings {
    /// The model in SI units.
    pub value: Tree,
    /// Where it holds nothing that counts.
    pub holes: Holes,
    /// Faults.
    pub complaints: Vec<Complaint>,
    /// How many more there would be.
    pub more: usize,
    /// Texts that should be points.
    pub undotted: Vec<Undotted>,
    /// What is legal, and yet hardly meant.
    pub warnings: Vec<String>,
    /// The parameters as resolved.
    pub parameters: Vec<Parameter>,
}

/// Reads the whole file.
pub fn walk(source: &Source) -> Findings {
    let units = Units::read(source.root.get("units"));
    let written = source.root.get("parameters");
    let (parameters, faults) = Parameters::read(written, !units.in_radians());
    walk_with(source, units, parameters, faults)
}

fn walk_with(
    source: &Source,
    units: Units,
    parameters: Parameters,
    faults: Vec<Found<'_>>,
) -> Findings {
    let written = source.root.get("parameters");
    let mut walk = Walk::new(source, units, parameters, driven(&source.root));
    for fault in faults {
        walk.complain_at(fault.node, fault.at, fault.complaint);
    }
    let value = walk.file();
    let mut warnings = walk.units.warnings(source);
    warnings.extend(walk.idle_tables());
    // what nothing uses may stay in a file, but a --set would be in vain
    let unused = walk.parameters.unused(written);
    let (in_vain, idle): (Vec<_>, Vec<_>) = unused.into_iter().partition(|(_, is_set)| *is_set);
    warnings.extend(
        idle.into_iter()
            .map(|(complaint, _)| source.place(complaint).to_string()),
    );
    if walk.complaints.is_empty() {
        walk.complaints.extend(
            in_vain
                .into_iter()
                .map(|(complaint, _)| source.place(complaint)),
        );
    }
    let mut parameters = walk.parameters.resolved(written);
    for parameter in &mut parameters {
        parameter.tolerance = walk.tolerances.remove(&parameter.name);
    }
    Findings {
        value,
        holes: walk.holes,
        complaints: walk.complaints,
        more: walk.more,
        undotted: walk.undotted,
        warnings,
        parameters,
    }
}

/// What each driver of a file drives, by its name.
fn driven(root: &Node) -> HashMap<String, Dimension> {
    let known = members(root.get("drivers")).filter_map(|(name, driver)| {
        let dimension = match driver.node.get("type")?.as_str()? {
            "rotation" => Dimension::Angle,
            "translation" | "length" => Dimension::Length,
            _ => return None,
        };
        Some((name.clone(), dimension))
    });
    known.collect()
}

/// The state of the walk.
pub struct Walk<'a> {
    source: &'a Source,
    units: Units,
    parameters: Parameters,
    /// What drivers drive.
    driven: HashMap<String, Dimension>,
    holes: Holes,
    complaints: Vec<Complaint>,
    more: usize,
    undotted: Vec<Undotted>,
    /// Of parameters, by their names.
    tolerances: HashMap<String, Tolerance>,
    /// The tables, which are read before everything else, and whether a formula calls each.
    tables: Vec<(String, Option<Table>, bool)>,
    /// The inputs, which are read before everything else; of one with a fault there is none.
    inputs: Vec<(String, Option<ModelInput>)>,
    /// The states, which are read before everything else, with their dimensions as far as they are known.
    states: Vec<Early>,
    /// The names of results, once they were needed.
    catalogue: Option<Catalogue>,
    /// The expressions that were met, if that is requested.
    record: Option<Vec<Recorded>>,
}

/// A state while the file is read.
struct Early {
    /// Its name.
    name: String,
    /// Its dimension, once it is known.
    powers: Option<Powers>,
    /// It, where nothing is wrong with it.
    state: Option<State>,
}

impl<'a> Walk<'a> {
    /// Before the first step.
    pub fn new(
        source: &'a Source,
        units: Units,
        parameters: Parameters,
        driven: HashMap<String, Dimension>,
    ) -> Self {
        Walk {
            source,
            units,
            parameters,
            driven,
            holes: Holes::default(),
            complaints: Vec::new(),
            more: 0,
            undotted: Vec::new(),
            tolerances: HashMap::new(),
            tables: Vec::new(),
            inputs: Vec::new(),
            states: Vec::new(),
            catalogue: None,
            record: None,
        }
    }

    /// The value in SI units, where nothing is wrong with it.
    pub fn sound(&mut self, node: &Node, shape: &Shape, driven: Driven) -> Option<Tree> {
        let before = self.complaints.len() + self.more + self.undotted.len();
        let value = self.value(node, shape, "", driven);
        (self.complaints.len() + self.more + self.undotted.len() == before).then_some(value)
    }

    /// The units of plain numbers.
    pub fn units(&self) -> &Units {
        &self.units
    }

    /// All of the file.
    fn file(&mut self) -> Tree {
        let source = self.source;
        self.read_tables(source.root.get("tables"));
        self.read_inputs(source.root.get("inputs"));
        self.read_states(source.root.get("states"));
        self.value(
            &source.root,
            &Shape::Object(words::file()),
            "",
            Driven::Nothing,
        )
    }

    /// Complains about a value.
    fn complain(&mut self, node: &Node, complaint: Complaint) {
        let found = self.source.found(node);
        self.add(node.origin, found, complaint);
    }

    /// Complains about a value, at a byte of its text.
    fn complain_at(&mut self, node: &Node, at: Option<usize>, complaint: Complaint) {
        let origin = at.map_or(node.origin, |at| self.source.within(node, at));
        let found = self.source.found(node);
        self.add(origin, found, complaint);
    }

    /// Complains about a key.
    fn complain_key(&mut self, origin: Origin, key: &str, complaint: Complaint) {
        let key = format!("{:?}", crate::node::excerpt(key));
        self.add(origin, Some(key), complaint);
    }

    fn add(&mut self, origin: Origin, found: Option<String>, complaint: Complaint) {
        if self.complaints.len() < ENOUGH {
            self.complaints
                .push(self.source.complain(origin, found, complaint));
        } else {
            self.more += 1;
        }
    }

    /// The value in SI units; where it is faulty a complaint, a hole, and something of the right kind.
    fn value(&mut self, node: &Node, shape: &Shape, path: &str, driven: Driven) -> Tree {
        self.read(node, shape, path, driven)
            .unwrap_or_else(|| self.hole(shape, path))
    }

    /// Something of the right kind, which does not count.
    fn hole(&mut self, shape: &Shape, path: &str) -> Tree {
        self.holes.add(path);
        filler::filler(shape)
    }

    fn read(&mut self, node: &Node, shape: &Shape, path: &str, driven: Driven) -> Option<Tree> {
        match shape {
            Shape::Format => self.choice(node, &[crate::FORMAT], path),
            Shape::Units => self.units_of_file(node, path),
            // their values are read already
            Shape::Parameters => {
                self.tolerances(node, path);
                Some(Tree::Null)
            }
            Shape::Nominal => Some(Tree::Null),
            Shape::Deviations => self.deviations(node, path, driven),
            Shape::Alike(bound) => self.alike(node, *bound, path, driven),
            Shape::Range(measure, bound) | Shape::PerAxis(measure, bound) => {
                self.range(node, &Shape::Quantity(*measure, *bound), path, driven)
            }
            Shape::End(_) if matches!(node.kind, Kind::Null) => Some(Tree::Null),
            Shape::End(measure) => self
                .quantity(node, *measure, path, driven)
                .map(Tree::Number),
            Shape::Place => self.place(node, path, driven),
            Shape::Text | Shape::Name(_) => self.text(node, path).map(Tree::Text),
            Shape::Point => {
                let text = self.text(node, path)?;
                if text.contains('.') {
                    return Some(Tree::Text(text));
                }
                self.undotted.push(Undotted {
                    path: path.to_owned(),
                    text,
                });
                None
            }
            Shape::Choice(choice) => self.choice(node, &texts(choice), path),
            Shape::Quantity(measure, _) => self
                .quantity(node, *measure, path, driven)
                .map(Tree::Number),
            Shape::Number(_) | Shape::Coefficient(_) | Shape::ContactStiffness => {
                self.plain_number(node, path).map(Tree::Number)
            }
            Shape::Count(least, most) => {
                let bound = Bound::Between(*least as f64, *most as f64);
                self.whole(node, bound, path).map(Tree::Count)
            }
            Shape::Flag => match node.kind {
                Kind::Bool(flag) => Some(Tree::Flag(flag)),
                _ => {
                    self.complain(node, wrong_kind(path, "true or false", node));
                    None
                }
            },
            Shape::Direction => {
                self.list(node, &Shape::Number(Bound::Any), (2, Some(2)), path, driven)
            }
            Shape::Pair(of) => self.list(node, of, (2, Some(2)), path, driven),
            Shape::List(of, least) => self.list(node, of, (*least, None), path, driven),
            Shape::Table => self.table(node, path, driven),
            Shape::Curve(_) => self.curve(node, path),
            Shape::Input => self.input(node, path),
            Shape::State(_) => self.state(node, path),
            Shape::Event => self.event(node, path),
            // whoever knows the units reads them
            Shape::Entries | Shape::Entry => Some(Tree::Null),
            Shape::Formula(dimension) => match self.formula(node, *dimension, path) {
                Some(read) => read,
                None => self.varying(node, *dimension, path),
            },
            Shape::Varying(dimension) => self.varying(node, *dimension, path),
            Shape::Materials => {
                let keys = |object: &crate::shape::Object| match &node.kind {
                    Kind::Object(members) => members.keys().filter(|key| object.has(key)).count(),
                    _ => 0,
                };
                let (separate, one) = (words::object("Separate"), words::object("Material"));
                let is_separate = keys(separate) >= keys(one);
                let object = if is_separate { separate } else { one };
                self.object(node, object, None, path, driven)
            }
            Shape::Responses => self.responses(node, path, driven),
            Shape::Response => self.response(node, path),
            Shape::Limit => self.limit(node, path, driven).map(Tree::Number),
            Shape::Asked(asked) => self.asked(*asked, node, path),
            Shape::Map(of) => self.map(node, of, path, driven),
            Shape::Bodies => self.bodies(node, path, driven),
            Shape::Object(object) => self.object(node, object, None, path, driven),
            Shape::Tagged(tagged) => self.tagged(node, tagged, path, driven),
        }
    }

    fn choice(&mut self, node: &Node, choices: &[&str], path: &str) -> Option<Tree> {
        let any = || suggest::any_of(choices.iter().copied());
        let Some(text) = node.as_str() else {
            let complaint = wrong_kind(path, "text", node);
            self.complain(node, complaint.hint(format!("one of {}", any())));
            return None;
        };
        if choices.contains(&text) {
            return Some(Tree::from(text));
        }
        let word = match path.ends_with(']') {
            true => "word",
            false => path.rsplit('.').next().unwrap_or(path),
        };
        let hint = match (choices, suggest::meant(text, choices)) {
            (["SI"], _) => format!("write {}", examples::example("units").unwrap_or_default()),
            ([only], _) if word != "type" => format!("{only:?} is expected"),
            (_, Some(near)) => format!("did you mean {near:?}?"),
            (_, None) => format!("one of {}", any()),
        };
        let complaint = Complaint::new(path, format!("unknown {word}"));
        self.complain(node, complaint.hint(hint));
        None
    }

    fn text(&mut self, node: &Node, path: &str) -> Option<String> {
        let text = node.as_str().map(str::to_owned);
        if text.is_none() {
            self.complain(node, wrong_kind(path, "text", node));
        }
        text
    }
}

/// The words of a choice.
fn texts(choice: &Choice) -> Vec<&'static str> {
    choice.words.iter().map(|one| one.word).collect()
}

/// Something else is expected here.
fn wrong_kind(path: &str, wanted: &str, node: &Node) -> Complaint {
    let hint = examples::example(path).map(|example| format!("as in {example}"));
    Complaint {
        hint,
        ..Complaint::new(
            path,
            format!("{wanted} is expected, not {}", node.kind_name()),
        )
    }
}
