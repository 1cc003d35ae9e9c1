//! Linkages for a wanted path, motion or function: found, put through the engine, ranked.

mod front;
mod json;
mod judged;
mod listed;
mod page;
mod problem;
mod search;
mod text;
mod written;

use crate::{ModelFile, Question, Unanswered};
use front::{Ranked, ranked};
use judged::{Defect, FoundLinkage};
use linkdyn_engine::analysis::Control;
use problem::LinkageTask;
use rayon::prelude::*;
use search::{Gathered, SearchCounts};

pub use listed::{ListedChains, MOST_BODIES, all_chains};

/// Linkages that are kept, and starts, where nobody says.
pub const MOST: u64 = 20;
/// As above.
pub const STARTS: u64 = 200;

/// Asks for linkages that do what the task of the file, `synthesise`, wants.
#[derive(Debug, Clone, Copy, Default)]
pub struct Synthesise;

/// How candidates of a kind fared.
#[derive(Debug, Clone, Default)]
pub struct Tried {
    /// The kind, `four_bar`.
    pub kind: String,
    /// How they were found.
    pub method: String,
    /// Whether these are all.
    pub is_complete: bool,
    /// What is to be known.
    pub notes: Vec<String>,
    /// Of searches from starts, what they came to.
    searched: Option<SearchCounts>,
    /// Candidates, each driven at one of its pivots.
    pub candidates: usize,
    /// Those of them without a defect.
    pub good: usize,
    /// Pivots or lengths are not as wanted.
    pub outside: usize,
    /// Some positions are on another circuit.
    pub circuit: usize,
    /// The crank gets stuck on the way.
    pub branch: usize,
    /// Another order.
    pub order: usize,
    /// The angle of transmission is too small.
    pub transmission: usize,
    /// They do not run; the first reason.
    pub broken: (usize, Option<String>),
}

/// Linkages that do what was wanted.
#[derive(Debug, Clone)]
pub struct Synthesised {
    /// The task.
    pub file: ModelFile,
    problem: LinkageTask,
    /// How candidates fared.
    pub tried: Vec<Tried>,
    /// Whether it was stopped before all was tried.
    pub is_stopped: bool,
    ranked: Ranked,
}

impl Question for Synthesise {
    type Answer = Synthesised;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Synthesised, Unanswered> {
        let problem = LinkageTask::of(file)?;
        let mut all = Fared::default();
        let is_stopped = search(&problem, control, &mut all).is_none();
        if is_stopped && all.designs.is_empty() {
            return Err(Unanswered::Interrupted);
        }
        let Fared { tried, designs } = all;
        let most = problem.asked.most.unwrap_or(MOST) as usize;
        let ranked = ranked(designs, &problem, most);
        Ok(Synthesised {
            file: file.clone(),
            problem,
            tried,
            ranked,
            is_stopped,
        })
    }
}

/// Searches for all that is asked, and puts it through the engine; `None`: stopped.
fn search(problem: &LinkageTask, control: &Control, all: &mut Fared) -> Option<()> {
    for kind in problem.kinds() {
        let exact = problem.exact(kind, control)?;
        let good = exact.map_or(0, |own| all.take(problem, own, control));
        // Where none of them is of use, what comes near may be.
        if good == 0 {
            problem.sought(kind, control, &mut |own| {
                all.take(problem, own, control);
            })?;
        }
    }
    if let Some(bodies) = problem.asked.bodies {
        problem.sought_in_chains(bodies as usize, control, &mut |own| {
            all.take(problem, own, control);
        })?;
    }
    control.stop().is_none().then_some(())
}

/// How all candidates fared.
#[derive(Default)]
struct Fared {
    tried: Vec<Tried>,
    designs: Vec<FoundLinkage>,
}

impl Fared {
    /// Takes the candidates of a search; how many of them are good.
    fn take(&mut self, problem: &LinkageTask, own: Gathered, control: &Control) -> usize {
        let (one, found) = judge(problem, own, control);
        let good = one.good;
        // Several choices of crank and output of a kind are told as one.
        let like = |other: &&mut Tried| other.kind == one.kind && other.method == one.method;
        match self.tried.iter_mut().find(like) {
            Some(other) => other.add(one),
            None => self.tried.push(one),
        }
        self.designs.extend(found);
        good
    }
}

fn judge(problem: &LinkageTask, own: Gathered, control: &Control) -> (Tried, Vec<FoundLinkage>) {
    let verdicts: Vec<Result<FoundLinkage, Defect>> = own
        .candidates
        .par_iter()
        .filter(|_| control.stop().is_none())
        .map(|candidate| problem.judged(&own, candidate, control))
        .collect();
    let mut tried = Tried {
        kind: own.kind,
        method: own.method,
        is_complete: own.is_complete,
        notes: own.notes,
        searched: own.searched,
        candidates: verdicts.len(),
        ..Tried::default()
    };
    let mut designs = Vec::new();
    for verdict in verdicts {
        match verdict {
            Ok(design) => {
                tried.good += 1;
                designs.push(design);
            }
            Err(Defect::Limits) => tried.outside += 1,
            Err(Defect::Circuit) => tried.circuit += 1,
            Err(Defect::Branch) => tried.branch += 1,
            Err(Defect::Order) => tried.order += 1,
            Err(Defect::Transmission) => tried.transmission += 1,
            Err(Defect::Run(why)) => {
                tried.broken.0 += 1;
                tried.broken.1.get_or_insert(why);
            }
        }
    }
    (tried, designs)
}

impl Tried {
    fn add(&mut self, other: Tried) {
        self.is_complete &= other.is_complete;
        self.notes.extend(other.notes);
        self.searched = self.searched.zip(other.searched).map(|(a, b)| a.with(b));
        self.candidates += other.candidates;
        self.good += other.good;
        self.outside += other.outside;
        self.circuit += other.circuit;
        self.branch += other.branch;
        self.order += other.order;
        self.transmission += other.transmission;
        self.broken.0 += other.broken.0;
        self.broken.1 = self.broken.1.take().or(other.broken.1);
    }
}

impl Synthesised {
    /// How many linkages there are.
    pub fn count(&self) -> usize {
        self.ranked.designs.len()
    }

    /// The text of the model file of one of them, counted from 1.
    ///
    /// # Errors
    /// Where there is none of that number.
    pub fn print(&self, number: usize) -> Result<String, Unanswered> {
        let design = number
            .checked_sub(1)
            .and_then(|k| self.ranked.designs.get(k));
        let design = design.ok_or_else(|| {
            let count = self.count();
            Unanswered::question(format!("--take {number}: there are {count} linkages"))
        })?;
        Ok(format!("{:#}\n", design.model))
    }
}
