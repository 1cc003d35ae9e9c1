//! Diagnosis of a model without running it.

mod page;
mod quote;
mod refused;
mod text;
mod tolerances;
mod words;

use indexmap::IndexMap;
use linkdyn_engine::analysis::{self, Check as Found, Control};
use linkdyn_model::AnalysisKind;
use linkdyn_model::error::Complaint;
use linkdyn_output::{Mobility, Status};
use linkdyn_picture::Scene;
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::time::Duration;
use web_time::Instant;

use crate::assemblies::Circuits;
use crate::text::responses::{Expression, expressions};
use crate::text::words::{analysis_words, status_words};
use crate::{ModelFile, Question, Subject, Unanswered};

pub(crate) use page::pose as pose_of;
pub use refused::html as refused_html;

/// Asks what is wrong or odd in a model: assembles it, and counts, without running it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Check;

/// What was found in a model.
#[derive(Debug, Clone)]
pub struct Diagnosis {
    /// The model.
    pub file: ModelFile,
    /// What the engine found.
    pub found: Found,
    /// What looks like a slip, with its place.
    pub suspicious: Vec<String>,
}

impl Question for Check {
    type Answer = Diagnosis;

    fn answer(&self, file: &ModelFile, _: &Control) -> Result<Diagnosis, Unanswered> {
        let found = analysis::check(file.model());
        let mut found = found.map_err(|complaints| file.refused(complaints))?;
        let suspicious = suspicious(file, &mut found);
        let warnings = file.loaded.warnings.iter().chain(&suspicious).cloned();
        found.warnings.splice(0..0, warnings);
        Ok(Diagnosis {
            file: file.clone(),
            found,
            suspicious,
        })
    }
}

/// What looks like a slip, with its place.
fn suspicious(file: &ModelFile, check: &mut Found) -> Vec<String> {
    let angle = file.loaded.document.pointer("/units/angle");
    let degrees = angle.and_then(Value::as_str) == Some("deg");
    let mut found = analysis::suspicious(file.model(), degrees);
    // In a mechanism of doubtful lengths springs are not blamed for theirs.
    let ends_with = |complaint: &Complaint, end: &str| complaint.path.ends_with(end);
    let doubtful = found.iter().any(|one| ends_with(one, ".points"));
    let mut others = std::mem::take(&mut check.suspicious);
    others.retain(|one| !(doubtful && ends_with(one, ".free_length")));
    found.extend(others);
    let placed = found.into_iter();
    placed
        .map(|complaint| file.loaded.source.place(complaint).to_string())
        .collect()
}

impl Diagnosis {
    /// The verdict in a word.
    pub fn verdict(&self) -> String {
        match self.found.status {
            _ if !self.found.refused.is_empty() => "refused".into(),
            Status::Completed if self.found.faults.is_empty() => "sound".into(),
            Status::Completed => "faulty".into(),
            other => status_words(other),
        }
    }

    /// The page that draws the model with what was found in it.
    pub fn html(&self) -> String {
        page::html(self, Vec::new())
    }

    /// The same with a map of its circuits, of a mechanism with one driver: which assemblies are connected by motion.
    pub fn html_with_circuits(&self, control: &Control) -> String {
        page::html(self, circuits(&self.file, control).into_iter().collect())
    }
}

#[derive(Serialize)]
struct FreeJournals<'a> {
    joints: &'a [String],
    grubler: i64,
    rank: i64,
}

#[derive(Serialize)]
struct MobilityJson<'a> {
    words: &'a str,
    grubler: i64,
    rank: i64,
    drivers: usize,
    redundant: &'a [String],
    reactions_not_unique: &'a [String],
    free_journals: Option<FreeJournals<'a>>,
}

#[derive(Serialize)]
struct LackJson<'a> {
    bodies: &'a [String],
    keys: &'a [&'static str],
    #[serde(rename = "for")]
    analyses: Vec<String>,
}

#[derive(Serialize)]
struct Document<'a> {
    status: &'a str,
    message: Option<&'a str>,
    model: Subject<'a>,
    parameters: IndexMap<&'a str, tolerances::ParameterJson<'a>>,
    responses: IndexMap<&'a str, Expression<'a>>,
    bodies: usize,
    joints: usize,
    drivers: usize,
    forces: usize,
    loops: &'a [String],
    loop_bodies: &'a [Vec<String>],
    mobility: MobilityJson<'a>,
    assembly_residual: f64,
    refused: Vec<String>,
    possible: Vec<String>,
    missing: IndexMap<String, &'a [String]>,
    lacks: Vec<LackJson<'a>>,
    suspicious: &'a [String],
    warnings: &'a [String],
    faults: &'a [String],
}

/// The diagnosis for programs.
impl Serialize for Diagnosis {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (model, check) = (self.file.model(), &self.found);
        let word = |kind: &AnalysisKind| analysis_words(*kind).replace([' ', '-'], "_");
        let parameters = self.file.loaded.parameters.iter();
        // What does not assemble has nothing to run.
        let assembles = check.status == Status::Completed || !check.poses.is_empty();
        let possible = check.possible().filter(|_| assembles);
        let possible = possible.map(|kind| word(&kind));
        let missing = check.missing.iter();
        let source = &self.file.loaded.source;
        let refused = check.refused.iter().cloned();
        let refused = refused.map(|complaint| source.place(complaint));
        let lacks = check.lacks.iter().map(|lack| LackJson {
            bodies: &lack.bodies,
            keys: &lack.keys,
            analyses: lack.analyses.iter().map(word).collect(),
        });
        let document = Document {
            status: check.status.word(),
            message: check.message.as_deref(),
            model: self.file.subject(),
            parameters: parameters
                .map(|own| (own.name.as_str(), own.into()))
                .collect(),
            responses: expressions(model),
            bodies: check.bodies,
            joints: check.joints,
            drivers: model.drivers.len(),
            forces: model.forces.len(),
            loops: &check.loops,
            loop_bodies: &check.loop_bodies,
            mobility: mobility(check),
            assembly_residual: check.assembly_residual,
            refused: refused.map(|complaint| complaint.to_string()).collect(),
            possible: possible.collect(),
            missing: missing
                .map(|(kind, what)| (word(kind), what.as_slice()))
                .collect(),
            lacks: lacks.collect(),
            suspicious: &self.suspicious,
            warnings: &check.warnings,
            faults: &check.faults,
        };
        document.serialize(serializer)
    }
}

fn mobility(check: &Found) -> MobilityJson<'_> {
    let Mobility {
        grubler,
        rank,
        drivers,
        redundant,
        reactions_not_unique,
    } = &check.mobility;
    MobilityJson {
        words: &check.words,
        grubler: *grubler,
        rank: *rank,
        drivers: *drivers,
        redundant,
        reactions_not_unique,
        free_journals: check.open.as_ref().map(|open| FreeJournals {
            joints: &open.joints,
            grubler: open.mobility.grubler,
            rank: open.mobility.rank,
        }),
    }
}

/// Values of the driver at which a map of the circuits looks for assemblies, most assemblies at each, and how long it may take.
const MAP_VALUES: usize = 36;
const MAP_ASSEMBLIES: usize = 64;
/// Larger mechanisms have thousands of assemblies.
const MAP_BODIES: usize = 16;
const MAP_TIME: Duration = Duration::from_secs(5);

/// The map; `None` of what has not one driver, and of what takes too long.
fn circuits(file: &ModelFile, control: &Control) -> Option<(String, Scene)> {
    if file.model().bodies.len() > MAP_BODIES {
        return None;
    }
    let own = Instant::now().checked_add(MAP_TIME);
    let control = Control {
        deadline: [control.deadline, own].into_iter().flatten().min(),
        ..control.clone()
    };
    let question = Circuits {
        values: Some(MAP_VALUES),
        most: Some(MAP_ASSEMBLIES),
        ..Circuits::default()
    };
    question.answer(file, &control).ok()?.map()?.ok()
}
