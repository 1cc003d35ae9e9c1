//! What a variant of the model gives: the one place where the search meets the engine.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use linkdyn_engine::analysis::{Control, Family, Member, Outcome};
use linkdyn_model::error::Complaints;
use linkdyn_model::{Given, Loaded, Substituted, Substitution};
use linkdyn_optimise::curve::Node;
use linkdyn_output::Status;

use super::path::{Path, nodes};
use super::target::{OWN, Target};
use super::timing::{Timing, sets};
use crate::text::words::input_fault;
use crate::{ModelFile, Unanswered};

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

/// The variants of a model by the values of its parameters [SI]; what they give depends on these alone. Read and compiled once.
pub struct Runs {
    values: Family,
    /// By deviations of all parameters that change or scatter.
    deviations: Option<Deviations>,
    /// The model with an analysis for the path: coarse, fine.
    paths: Option<[Path; 2]>,
    /// The same by its parameters, for derivatives.
    path: Option<Family>,
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

/// Rows of a path: one turn in steps of 3.75°, and of a quarter of it, which the quintics between them make 1e-12 and 1e-15 of it.
const ROWS: [usize; 2] = [97, 385];

impl Runs {
    /// Of a model with the responses of the search; the path is that of the model without them.
    ///
    /// # Errors
    /// A path that the model does not have.
    pub fn new(
        target: &Target,
        file: &ModelFile,
        plain: &ModelFile,
        timing: Option<&Timing>,
        interrupted: Arc<AtomicBool>,
    ) -> Result<Self, Unanswered> {
        let variables = target.variables.iter().map(|own| &own.parameter);
        let names: Vec<&str> = variables.clone().map(|own| own.name.as_str()).collect();
        let refuse = |complaints| file.refused(complaints);
        let mut paths = Vec::new();
        let mut path_family = None;
        if let Some(point) = target.point() {
            let of_path = |rows: usize| sets(file.model(), point, timing, rows);
            let places = ["x", "y"].into_iter().enumerate();
            let places = places.map(|(k, axis)| format!("responses.{OWN}{k}=last({point}.{axis})"));
            let with_places: Vec<String> = of_path(ROWS[0]).into_iter().chain(places).collect();
            let with = plain.with(&with_places).map_err(refuse)?;
            path_family = Family::new(&with.loaded, &names, Given::Values).ok();
            for rows in ROWS {
                let with = plain.with(&of_path(rows)).map_err(refuse)?;
                paths.push(Path::new(&with.loaded, &names));
            }
        }
        let values = Family::new(&file.loaded, &names, Given::Values).map_err(refuse)?;
        let all = values.responses().list().iter().enumerate();
        let (own, others): (Vec<_>, Vec<_>) = all.partition(|(_, one)| one.name.starts_with(OWN));
        let nominal = variables.map(|own| own.value).collect();
        let deviations = Deviations::new(&file.loaded, &names, nominal, target).map_err(refuse)?;
        Ok(Runs {
            own: own.into_iter().map(|(place, _)| place).collect(),
            others: others.into_iter().map(|(place, _)| place).collect(),
            values,
            deviations,
            path: path_family,
            paths: paths.try_into().ok(),
            point: target.point().map_or_else(String::new, ToString::to_string),
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
    /// `None` if nothing scatters.
    fn new(
        loaded: &Loaded,
        names: &[&str],
        nominal: Vec<f64>,
        target: &Target,
    ) -> Result<Option<Self>, Complaints> {
        let Some(robust) = &target.robust else {
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
            family: Family::new(loaded, &all, Given::Deviations)?,
            nominal,
            scatter,
            count: all.len(),
        }))
    }
}

impl Deviations {
    /// Of all parameters, where one deviates besides.
    fn values(&self, x: &[f64], (number, by): (usize, f64)) -> Vec<f64> {
        let mut values = vec![0.0; self.count];
        for (value, (x, nominal)) in values.iter_mut().zip(x.iter().zip(&self.nominal)) {
            *value = x - nominal;
        }
        values[self.scatter[number]] += by;
        values
    }
}

/// The share of one start.
pub struct Share<'r> {
    runs: &'r Runs,
    values: Member<'r>,
    deviations: Option<Member<'r>>,
    /// Models of the path: coarse, fine.
    places: [Option<Substituted>; 2],
    path: Option<Member<'r>>,
    /// The path found last.
    motion: Option<Outcome>,
}

impl Runs {
    /// Begins, for one start.
    pub fn begin(&self) -> Share<'_> {
        let place = |k: usize| {
            let path = self.paths.as_ref().map(|paths| &paths[k])?;
            path.substitution.as_ref().map(Substitution::begin)
        };
        let mut values = self.values.begin();
        values.keep_motion();
        Share {
            runs: self,
            values,
            path: self.path.as_ref().map(Family::begin),
            motion: None,
            deviations: self.deviations.as_ref().map(|own| {
                let mut member = own.family.begin();
                member.keep_motion();
                member
            }),
            places: [place(0), place(1)],
        }
    }
}

impl Share<'_> {
    /// The numbers that the search needs, then the responses of the model, NaN where these have no value.
    pub fn numbers(&mut self, x: &[f64], call: Call) -> Found<Vec<f64>> {
        self.runs.member(&mut self.values, x, call)
    }

    /// The same where a parameter that scatters deviates from what it has there: its number, and by how much.
    pub fn deviating(
        &mut self,
        x: &[f64],
        (number, by): (usize, f64),
        call: Call,
    ) -> Found<Vec<f64>> {
        let both = self.runs.deviations.as_ref().zip(self.deviations.as_mut());
        let Some((deviations, member)) = both else {
            return Found::None("nothing scatters".to_owned());
        };
        let values = deviations.values(x, (number, by));
        self.runs.member(member, &values, call)
    }

    /// The first of these numbers there, and its derivatives by the parameters.
    pub fn deviating_slopes(
        &mut self,
        x: &[f64],
        deviation: (usize, f64),
        lengths: &[f64],
    ) -> Option<(f64, Vec<f64>)> {
        let Found::Some(numbers) = self.deviating(x, deviation, Call::OfSearch) else {
            return None;
        };
        let (deviations, member) = self
            .runs
            .deviations
            .as_ref()
            .zip(self.deviations.as_mut())?;
        let values = deviations.values(x, deviation);
        // Those that only scatter have no length, and so no derivatives.
        let mut all = vec![f64::NAN; deviations.count];
        all[..lengths.len()].copy_from_slice(lengths);
        let responses = self.runs.own.len() + self.runs.others.len();
        let mut gradient = vec![f64::NAN; responses * all.len()];
        member.slopes(&values, &all, &mut gradient);
        let row = self.runs.own.first()? * all.len();
        Some((*numbers.first()?, gradient[row..row + x.len()].to_vec()))
    }

    /// The path of the point.
    pub fn path(&mut self, x: &[f64], detail: Detail, call: Call) -> Found<Vec<Node>> {
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
            Some(nodes) => {
                self.motion = Some(outcome);
                Found::Some(nodes)
            }
            None => Found::None("the path has gaps".to_owned()),
        }
    }

    /// Derivatives of the numbers that the search needs by the parameters, which matter over some lengths, where these numbers
    /// were worked out last: a row for each, NaN where one is not known.
    pub fn slopes(&mut self, x: &[f64], lengths: &[f64]) -> Vec<f64> {
        let count = self.runs.own.len() + self.runs.others.len();
        let mut gradient = vec![f64::NAN; count * x.len()];
        self.values.slopes(x, lengths, &mut gradient);
        let rows = self.runs.own.iter();
        let row = |place: &usize| &gradient[place * x.len()..(place + 1) * x.len()];
        rows.flat_map(row).copied().collect()
    }

    /// Derivatives of the place of the point at times of the path that was found last: x, then y, of each time.
    pub fn path_slopes(&mut self, x: &[f64], lengths: &[f64], times: &[f64]) -> Option<Vec<f64>> {
        let (member, motion) = (self.path.as_mut()?, self.motion.as_ref()?);
        let responses = self.runs.path.as_ref()?.responses();
        let all = member.slopes_along(x, lengths, motion.all(), times)?;
        // Among the columns may be the time, too.
        let columns: Vec<&str> = responses.columns().collect();
        let place = |axis: &str| {
            let name = format!("{}.{axis}", self.runs.point);
            columns.iter().position(|own| *own == name)
        };
        let places = [place("x")?, place("y")?];
        let of = |time: usize, column: usize| {
            let from = (time * columns.len() + column) * x.len();
            &all[from..from + x.len()]
        };
        let each = (0..times.len()).flat_map(|time| places.map(|column| of(time, column)));
        Some(each.flatten().copied().collect())
    }
}
