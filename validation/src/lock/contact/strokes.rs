//! The runs: which hinges are bearings, their clearance, and the tolerance of the integration; on two threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use serde_json::{Value, json};

use super::super::document::broken;
use super::super::models::{JOINTS, RADII, Request, STEPS, Stroke, run};
use crate::CaseError;
use linkdyn_engine::analysis::Control;
use linkdyn_output::Status;

/// Tolerances rtol of the integration [–].
pub const TOLERANCES: [f64; 3] = [1e-5, 1e-6, 1e-7];
/// Index of the tolerance of the runs with one bearing.
pub const USUAL: usize = 1;
/// Clearance of the runs with one bearing \[µm\].
pub const SINGLE: f64 = RADII[1];
/// Outputs are the finest of [`STEPS`] apart \[deg\]: the coarser ones are among them.
pub const STEP: f64 = STEPS[3];
/// Runs at a time.
const THREADS: usize = 2;

/// A run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The hinge with clearance; none: all seven.
    pub joint: Option<&'static str>,
    /// Clearance e \[µm\].
    pub radius: f64,
    pub rtol: f64,
}

impl Contact {
    /// `all, 100 um`.
    pub fn bearings(&self) -> String {
        let joint = self
            .joint
            .map_or("all".into(), |joint| format!("{joint} alone"));
        format!("{joint}, {} um", self.radius)
    }

    /// `all, 100 um, 1e-6`.
    pub fn name(&self) -> String {
        format!("{}, {:e}", self.bearings(), self.rtol)
    }

    /// The bundled model with one word changed per hinge.
    fn document(&self) -> Result<Value, CaseError> {
        let mut document = Request::ideal(STEP).document()?;
        for joint in JOINTS
            .iter()
            .filter(|joint| self.joint.is_none_or(|only| only == **joint))
        {
            let clearance = &mut document["joints"][*joint]["clearance"];
            clearance["model"] = json!("contact");
            clearance["radius"] = json!(format!("{} um", self.radius));
        }
        document["analysis"]["solver"] = json!({ "rtol": self.rtol });
        Ok(document)
    }

    /// A stroke that stops early keeps its rows, its status and its message.
    fn run(&self, control: &Control) -> Result<Stroke, CaseError> {
        let (model, outcome) = run(&self.document()?, control)?;
        let stroke = Stroke::new(
            Request::clearance(self.radius, STEP),
            model,
            outcome.trajectory,
            outcome.report,
        )?;
        if stroke.theta6.is_empty() {
            let message = stroke.report.message.unwrap_or_default();
            return Err(broken(format!("{} has no rows: {message}", self.name())));
        }
        Ok(stroke)
    }
}

/// Whether a stroke came to its end.
pub fn is_whole(stroke: &Stroke) -> bool {
    stroke.report.status == Status::Completed
}

/// All runs.
pub struct Strokes {
    /// All seven hinges, by radius and tolerance.
    pub all: Vec<Vec<Stroke>>,
    /// One hinge each.
    pub single: Vec<Stroke>,
}

impl Strokes {
    /// Runs all of them.
    ///
    /// # Errors
    /// When one can't be run at all.
    pub fn new(control: &Control) -> Result<Self, CaseError> {
        let mut strokes = each(&Self::requests(), control)?.into_iter();
        let all = RADII
            .map(|_| strokes.by_ref().take(TOLERANCES.len()).collect())
            .to_vec();
        Ok(Strokes {
            all,
            single: strokes.collect(),
        })
    }

    /// In the order of [`Strokes::named`].
    fn requests() -> Vec<Contact> {
        let all = RADII.iter().flat_map(|&radius| {
            TOLERANCES.map(|rtol| Contact {
                joint: None,
                radius,
                rtol,
            })
        });
        let single = JOINTS.map(|joint| Contact {
            joint: Some(joint),
            radius: SINGLE,
            rtol: TOLERANCES[USUAL],
        });
        all.chain(single).collect()
    }

    /// Every run with what was requested.
    pub fn named(&self) -> impl Iterator<Item = (Contact, &Stroke)> {
        Self::requests()
            .into_iter()
            .zip(self.all.iter().flatten().chain(&self.single))
    }

    /// Both clearances at a tolerance.
    pub fn at(&self, tolerance: usize) -> Vec<&Stroke> {
        self.all.iter().map(|strokes| &strokes[tolerance]).collect()
    }
}

/// Each request's stroke, in order; every thread takes the next one that nobody has.
fn each(requests: &[Contact], control: &Control) -> Result<Vec<Stroke>, CaseError> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(request) = requests.get(index) else {
                return done;
            };
            done.push((index, request.run(control)));
        }
    };
    let mut done = thread::scope(|scope| {
        let threads: Vec<_> = (0..THREADS).map(|_| scope.spawn(work)).collect();
        let join = |thread: thread::ScopedJoinHandle<'_, _>| match thread.join() {
            Ok(done) => done,
            Err(panic) => std::panic::resume_unwind(panic),
        };
        threads.into_iter().flat_map(join).collect::<Vec<_>>()
    });
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, stroke)| stroke).collect()
}
