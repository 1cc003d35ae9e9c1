//! What a variant of the model gives: the one place where the search meets the engine.

use super::question::Question;
use crate::cli::exit::BadInput;
use crate::cli::open::{ModelOptions, Opened};
use linkdyn_engine::analysis::{Control, Family, Member, Prepared};
use linkdyn_model::error::Complaints;
use linkdyn_model::{Given, Loaded, Source, Substituted, Substitution};
use linkdyn_optimise::curve::Node;
use linkdyn_output::{Status, Trajectory};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What names of responses begin with that the search adds.
pub const OWN: &str = "number of the search ";

/// What a variant gives.
#[derive(Debug, Clone, PartialEq)]
pub enum Found<T> {
    Some(T),
    /// Nothing, and why.
    None(String),
    /// Ctrl-C.
    Stopped,
}

/// How finely a path is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// For the search.
    Coarse,
    /// For the last digits.
    Fine,
}

/// Whether an interrupt counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Call {
    /// It does: this is one of many.
    OfSearch,
    /// It does not: this says what the search found.
    Last,
}

/// The variants of a model by the values of its parameters [SI]; what they give depends on these alone.
pub trait Variants: Sync {
    /// Begins, for one start.
    fn begin(&self) -> Box<dyn Variant + '_>;
}

/// One start's share of them.
pub trait Variant {
    /// The numbers that the search needs, then the responses of the model, NaN where these have no value.
    fn numbers(&mut self, x: &[f64], call: Call) -> Found<Vec<f64>>;
    /// The same where a parameter that scatters deviates from what it has there: its number, and by how much.
    fn deviating(&mut self, x: &[f64], deviation: (usize, f64), call: Call) -> Found<Vec<f64>>;
    /// The path of the point.
    fn path(&mut self, x: &[f64], detail: Detail, call: Call) -> Found<Vec<Node>>;
}

/// Families of the model: read and compiled once.
pub struct Runs {
    values: Family,
    /// By deviations of all parameters that change or scatter.
    deviations: Option<Deviations>,
    /// The model with an analysis for the path: coarse, fine.
    paths: Option<[Path; 2]>,
    point: String,
    /// Where the numbers of the search stand among the responses, and those of the model.
    own: Vec<usize>,
    others: Vec<usize>,
    interrupted: Arc<AtomicBool>,
}

/// The family of deviations.
struct Deviations {
    family: Family,
    /// Values of the file of those that change, which come first.
    nominal: Vec<f64>,
    /// Where each that scatters stands.
    scatter: Vec<usize>,
    count: usize,
}

/// A model whose motion gives the path.
struct Path {
    source: Source,
    /// None where its file must be read for each variant.
    substitution: Option<Substitution>,
    names: Vec<String>,
}

/// Rows of a path: one turn in steps of 3.75°, and of a quarter of it, which the quintics between them make 1e-12 and 1e-15 of it.
const ROWS: [usize; 2] = [97, 385];

impl Runs {
    /// Of a model that has the responses of the search.
    ///
    /// # Errors
    /// A path that the model does not have.
    pub fn new(
        model: &ModelOptions,
        sets: &[String],
        question: &Question,
        opened: &Opened,
        timing: Option<&super::timing::Timing>,
        interrupted: Arc<AtomicBool>,
    ) -> Result<Self, BadInput> {
        let variables = question.variables.iter().map(|own| &own.parameter);
        let names: Vec<&str> = variables.clone().map(|own| own.name.as_str()).collect();
        let refuse = |complaints| opened.bad_input(complaints);
        let mut paths = Vec::new();
        if let Some(point) = question.point() {
            for rows in ROWS {
                let path = super::timing::sets(opened, point, timing, rows);
                let with = model.open_with(&[sets, &path].concat())?.map_err(refuse)?;
                paths.push(Path::new(&with.loaded, &names));
            }
        }
        let values = Family::new(&opened.loaded, &names, Given::Values).map_err(refuse)?;
        let all = values.responses().list().iter().enumerate();
        let (own, others): (Vec<_>, Vec<_>) = all.partition(|(_, one)| one.name.starts_with(OWN));
        let nominal = variables.map(|own| own.value).collect();
        let deviations = Deviations::new(opened, &names, nominal, question).map_err(refuse)?;
        Ok(Runs {
            own: own.into_iter().map(|(place, _)| place).collect(),
            others: others.into_iter().map(|(place, _)| place).collect(),
            values,
            deviations,
            paths: paths.try_into().ok(),
            point: question
                .point()
                .map_or_else(String::new, ToString::to_string),
            interrupted,
        })
    }

    /// No deadline: what is found does not depend on the machine.
    fn control(&self, call: Call) -> Control {
        Control {
            interrupted: match call {
                Call::OfSearch => Arc::clone(&self.interrupted),
                Call::Last => Arc::default(),
            },
            ..Control::default()
        }
    }

    /// What a member of a family gives.
    fn member(&self, member: &mut Member, values: &[f64], call: Call) -> Found<Vec<f64>> {
        let control = self.control(call);
        if control.interrupted.load(Ordering::Relaxed) {
            return Found::Stopped;
        }
        let mut all = vec![f64::NAN; self.own.len() + self.others.len()];
        let status = match member.run(values, &control, &mut all) {
            Err(complaints) => return Found::None(input_fault(&complaints)),
            Ok(ended) => ended.status,
        };
        if let Some(missing) = missing(status) {
            return missing;
        }
        if let Some(place) = self.own.iter().find(|place| !all[**place].is_finite()) {
            let text = &self.values.responses().list()[*place].text;
            return Found::None(format!("no value of {text}"));
        }
        let places = self.own.iter().chain(&self.others);
        Found::Some(places.map(|place| all[*place]).collect())
    }
}

/// What there is instead of numbers where a run does not come to its end.
fn missing<T>(status: Status) -> Option<Found<T>> {
    match status {
        Status::Completed => None,
        Status::Interrupted => Some(Found::Stopped),
        Status::CompletedWithGaps
        | Status::DeadCentre
        | Status::AssemblyFailed
        | Status::StepTooSmall
        | Status::Singular
        | Status::TimeLimit => Some(Found::None(status.word().to_owned())),
    }
}

impl Deviations {
    /// None where nothing scatters.
    fn new(
        opened: &Opened,
        names: &[&str],
        nominal: Vec<f64>,
        question: &Question,
    ) -> Result<Option<Self>, Complaints> {
        let Some(robust) = &question.robust else {
            return Ok(None);
        };
        let mut all = names.to_vec();
        let mut scatter = Vec::new();
        for (name, _) in &robust.scatter {
            let known = all.iter().position(|own| own == name);
            scatter.push(known.unwrap_or(all.len()));
            if known.is_none() {
                all.push(name);
            }
        }
        Ok(Some(Deviations {
            family: Family::new(&opened.loaded, &all, Given::Deviations)?,
            nominal,
            scatter,
            count: all.len(),
        }))
    }
}

impl Path {
    fn new(loaded: &Loaded, names: &[&str]) -> Self {
        let (source, model) = (&loaded.source, &loaded.model);
        Path {
            source: source.clone(),
            substitution: Substitution::new(
                source,
                model,
                &loaded.parameters,
                names,
                Given::Values,
            ),
            names: names.iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    fn prepared(&self, x: &[f64], place: Option<&mut Substituted>) -> Result<Prepared, Complaints> {
        let put = self.substitution.as_ref().zip(place);
        if let Some(model) = put.and_then(|(substitution, place)| substitution.put(x, place)) {
            return Prepared::new(model);
        }
        let names = self.names.iter().map(String::as_str);
        let values: Vec<(&str, f64)> = names.zip(x.iter().copied()).collect();
        Prepared::new(&self.source.with_parameters(&values)?)
    }
}

/// The share of one start.
struct Share<'r> {
    runs: &'r Runs,
    values: Member<'r>,
    deviations: Option<Member<'r>>,
    /// Models of the path: coarse, fine.
    places: [Option<Substituted>; 2],
}

impl Variants for Runs {
    fn begin(&self) -> Box<dyn Variant + '_> {
        let place = |k: usize| {
            let path = self.paths.as_ref().map(|paths| &paths[k])?;
            path.substitution.as_ref().map(Substitution::begin)
        };
        Box::new(Share {
            runs: self,
            values: self.values.begin(),
            deviations: self.deviations.as_ref().map(|own| own.family.begin()),
            places: [place(0), place(1)],
        })
    }
}

impl Variant for Share<'_> {
    fn numbers(&mut self, x: &[f64], call: Call) -> Found<Vec<f64>> {
        self.runs.member(&mut self.values, x, call)
    }

    fn deviating(&mut self, x: &[f64], (number, by): (usize, f64), call: Call) -> Found<Vec<f64>> {
        let both = self.runs.deviations.as_ref().zip(self.deviations.as_mut());
        let Some((deviations, member)) = both else {
            return Found::None("nothing scatters".to_owned());
        };
        let mut values = vec![0.0; deviations.count];
        for (value, (x, nominal)) in values.iter_mut().zip(x.iter().zip(&deviations.nominal)) {
            *value = x - nominal;
        }
        values[deviations.scatter[number]] += by;
        self.runs.member(member, &values, call)
    }

    fn path(&mut self, x: &[f64], detail: Detail, call: Call) -> Found<Vec<Node>> {
        let Some(paths) = &self.runs.paths else {
            return Found::None("no path is looked for".to_owned());
        };
        let number = match detail {
            Detail::Coarse => 0,
            Detail::Fine => 1,
        };
        let control = self.runs.control(call);
        if control.interrupted.load(Ordering::Relaxed) {
            return Found::Stopped;
        }
        let prepared = paths[number].prepared(x, self.places[number].as_mut());
        let outcome = match prepared.and_then(|own| own.run(&control)) {
            Err(complaints) => return Found::None(input_fault(&complaints)),
            Ok(outcome) => outcome,
        };
        if let Some(missing) = missing(outcome.report.status) {
            return missing;
        }
        match nodes(outcome.all(), &self.runs.point) {
            Some(nodes) => Found::Some(nodes),
            None => Found::None("the path has gaps".to_owned()),
        }
    }
}

/// The path of a point over time.
fn nodes(rows: &Trajectory, point: &str) -> Option<Vec<Node>> {
    let column = |name: &str| rows.column_index(name);
    let of = |word: &str| column(&format!("{point}.{word}"));
    let time = column(linkdyn_output::TIME)?;
    let all = ["x", "y", "vx", "vy", "ax", "ay"].map(of);
    let [Some(x), Some(y), Some(vx), Some(vy), Some(ax), Some(ay)] = all else {
        return None;
    };
    let node = |row: &[f64]| Node {
        s: row[time],
        p: [row[x], row[y]],
        d: [row[vx], row[vy]],
        dd: [row[ax], row[ay]],
    };
    let nodes: Vec<Node> = rows.rows().map(node).collect();
    let is_whole = nodes
        .iter()
        .all(|node| node.p.iter().chain(&node.dd).all(|own| own.is_finite()));
    is_whole.then_some(nodes)
}

/// What is wrong with a model, without its values: many variants have the same fault.
fn input_fault(complaints: &Complaints) -> String {
    let first = complaints.0.first();
    first.map_or_else(
        || "bad_input".to_owned(),
        |complaint| format!("bad_input: {}: {}", complaint.path, complaint.message),
    )
}
