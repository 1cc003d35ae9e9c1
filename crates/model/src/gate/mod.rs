//! The one gate: every model passes it before it is compiled, wherever it comes from.
//!
//! Rules on one number come from the descriptions of the [words](crate::words); rules on names, and on values that belong
//! together, are functions of the typed model. Places in a file are looked up by path afterwards.

mod accuracy;
mod analysis;
mod cams;
mod clearance;
mod drivers;
mod elastic;
mod forces;
mod holes;
mod measures;
mod motions;
mod names;
mod optimise;
mod outlines;
mod outputs;
mod parts;
mod ranges;
mod responses;
mod sections;
mod states;
mod stops;
mod synthesise;
mod tables;
mod timed;

pub use holes::Holes;
pub use names::no_point;
pub use ranges::{length_fault, name_fault};

use std::ops::Deref;

use crate::error::{Complaint, Complaints};
use crate::tree::Tree;
use crate::{ClearanceModel, JointKind, Model, suggest};

/// Complaints after which no more names are looked up.
const ENOUGH: usize = 200;

/// A model that is legal: all names exist, all numbers are in their ranges, and what belongs together fits.
///
/// Only [`Model::check`] makes one. It can be read like a [`Model`]; to change it, take the model out and check it again.
///
/// # Examples
/// ```
/// let text = br#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "bar": { "mass": 1, "com": [0, 0] } } }"#;
/// let mut model = linkdyn_model::load(text, &[]).unwrap().model.into_model();
/// model.bodies["bar"].mass = Some(-1.0);
/// let said = model.check().unwrap_err();
/// assert_eq!(said.to_string(), "bodies.bar.mass: must not be negative");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Checked(Model);

impl Checked {
    /// The model, to be changed.
    pub fn into_model(self) -> Model {
        self.0
    }

    /// The model, for numbers that keep every rule that those in their places keep.
    pub(crate) fn numbers(&mut self) -> &mut Model {
        &mut self.0
    }

    /// The same with ideal pins where the model of a clearance is not `kept`; taking out a clearance breaks no rule.
    pub fn with_clearances(&self, kept: fn(ClearanceModel) -> bool) -> Checked {
        let mut model = self.0.clone();
        for joint in model.joints.values_mut() {
            if let JointKind::Revolute { clearance, .. } = &mut joint.kind {
                clearance.take_if(|clearance| !kept(clearance.model));
            }
        }
        Checked(model)
    }

    /// A changed copy, checked again.
    ///
    /// # Errors
    /// All faults of the changed model.
    pub fn edit(&self, change: impl FnOnce(&mut Model)) -> Result<Checked, Complaints> {
        let mut model = self.0.clone();
        change(&mut model);
        model.check()
    }
}

impl Deref for Checked {
    type Target = Model;

    fn deref(&self) -> &Model {
        &self.0
    }
}

impl Model {
    /// Passes the gate.
    ///
    /// # Errors
    /// All faults, each with the path of what is faulty.
    pub fn check(self) -> Result<Checked, Complaints> {
        let said = inspect(&self, Holes::default());
        if said.complaints.is_empty() {
            Ok(Checked(self))
        } else {
            Err(Complaints(said.complaints))
        }
    }
}

/// What the gate says; places are looked up later.
#[derive(Debug)]
pub struct Said {
    /// Faults.
    pub complaints: Vec<Complaint>,
    /// What is legal, and yet hardly meant.
    pub warnings: Vec<Complaint>,
}

/// Passes a model that a reader says is whole, with the warnings.
///
/// # Errors
/// All faults, and all warnings.
pub fn pass(model: Model, holes: Holes) -> (Result<Checked, Vec<Complaint>>, Vec<Complaint>) {
    let is_whole = holes.is_empty();
    let Said {
        complaints,
        warnings,
    } = inspect(&model, holes);
    if complaints.is_empty() && is_whole {
        (Ok(Checked(model)), warnings)
    } else {
        (Err(complaints), warnings)
    }
}

/// Looks at a model, but for what stands in holes.
fn inspect(model: &Model, holes: Holes) -> Said {
    let mut rules = Rules {
        model,
        holes,
        complaints: Vec::new(),
        warnings: Vec::new(),
    };
    // What is out of its range is looked at no further.
    let tree = Tree::of(model);
    let (complaints, named) = ranges::ranges(&tree, &rules.holes);
    for complaint in complaints {
        rules.holes.add(&complaint.path);
        rules.complaints.push(complaint);
    }
    if model.bodies.is_empty() && model.synthesise.is_none() && !rules.holes.has("bodies") {
        let complaint = Complaint::new("bodies", "it is empty, at least one is needed");
        rules.complaints.push(complaint);
        rules.holes.add("bodies");
    }
    names::references(&mut rules, &named);
    rules.bodies();
    sections::sections(&mut rules);
    sections::beams(&mut rules);
    elastic::links(&mut rules);
    rules.joints();
    elastic::outlines(&mut rules);
    drivers::drivers(&mut rules);
    forces::forces(&mut rules);
    motions::motions(&mut rules);
    tables::tables(&mut rules);
    forces::formulas(&mut rules);
    states::inputs(&mut rules);
    states::states(&mut rules);
    timed::events(&mut rules);
    names::initial(&mut rules);
    names::wanted_points(&mut rules);
    analysis::analysis(&mut rules);
    accuracy::accuracy(&mut rules);
    measures::measures(&mut rules);
    outputs::outputs(&mut rules);
    responses::responses(&mut rules);
    optimise::optimise(&mut rules);
    synthesise::synthesise(&mut rules);
    // A gear's carrier is found along joints, which must be whole for that.
    if rules.complaints.is_empty() && rules.holes.is_empty() {
        let joints = model.joints.iter();
        let carriers = joints.filter_map(|(name, joint)| model.carrier(name, joint));
        rules.complaints.extend(carriers.filter_map(Result::err));
    }
    Said {
        complaints: rules.complaints,
        warnings: rules.warnings,
    }
}

/// A model that is being looked at, and what was found.
struct Rules<'m> {
    model: &'m Model,
    holes: Holes,
    complaints: Vec<Complaint>,
    warnings: Vec<Complaint>,
}

impl Rules<'_> {
    /// Complains with a hint.
    fn complain(
        &mut self,
        path: impl Into<String>,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        self.complaints
            .push(Complaint::new(path, message).hint(hint));
    }

    /// Complains where no driver is named though there is not one alone; whether it did.
    fn lacks_driver(&mut self, path: &str, driver: Option<&String>, hint: &str) -> bool {
        let drivers = self.model.drivers.len();
        let lacks = driver.is_none() && drivers != 1 && !self.holes.has("drivers");
        if lacks {
            let message = format!("\"driver\" is missing, the model has {drivers} of them");
            self.complain(path, message, hint);
        }
        lacks
    }

    /// Limits have a width.
    fn width(&mut self, path: &str, limits: Option<[f64; 2]>, first: &str, such: &str) {
        let path = format!("{path}.limits");
        let known = |index: usize| !self.holes.has(&format!("{path}[{index}]"));
        let Some([lower, upper]) = limits.filter(|_| known(0) && known(1)) else {
            return;
        };
        if lower > upper {
            let hint = format!("{first} comes first, as in {such}");
            self.complain(path, "the limits are the wrong way round", hint);
        } else if lower == upper {
            let message = "between these limits there is nothing";
            self.complain(path, message, format!("as in {such}"));
        }
    }

    /// Bodies with mass have a centre of mass.
    fn bodies(&mut self) {
        for (name, body) in &self.model.bodies {
            let path = format!("bodies.{name}");
            let known = |key: &str| !self.holes.has(&format!("{path}.{key}"));
            if body.com.is_none()
                && body.mass.is_some_and(|mass| mass > 0.0)
                && known("mass")
                && known("com")
            {
                self.complain(
                    path.clone(),
                    "\"com\" is missing, it has no default where there is mass",
                    "give the centre of mass in the body's frame, as in \"com\": [0, 0]",
                );
            }
            let unknown = |name: &&String| !body.points.contains_key(*name);
            if let Some(point) = body.point_tolerances.keys().find(unknown) {
                let message =
                    format!("the body has no point {point:?} that could have a tolerance");
                let hint = format!("its points: {}", suggest::list(body.points.keys()));
                self.complain(format!("bodies.{name}.points"), message, hint);
            }
        }
    }

    /// Joints connect two bodies; clearances and friction have what they need.
    fn joints(&mut self) {
        let model = self.model;
        for (name, joint) in &model.joints {
            let path = format!("joints.{name}");
            let [first, second] = &joint.between;
            let known = |index: usize| !self.holes.has(&format!("{path}.between[{index}]"));
            if first.body == second.body && known(0) && known(1) {
                self.complain(
                    format!("{path}.between"),
                    format!("both points are of {:?}", first.body),
                    "a joint connects two bodies",
                );
            }
            if let Some([key, message, hint]) = joint.kind.conflict()
                && !self.holes.within(&path)
            {
                self.complain(format!("{path}.{key}"), message, hint);
            }
            clearance::joint(self, joint, &path);
            stops::stops(self, joint, &path);
            outlines::outline(self, joint, &path);
            cams::cam(self, joint, &path);
            timed::joint(self, joint, &path);
        }
    }
}
