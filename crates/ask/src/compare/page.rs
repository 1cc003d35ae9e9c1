//! The page of a comparison: the runs over each other.

use linkdyn_picture::{ComparePage, ComparedRun};

use super::{Compared, Rung};
use crate::text::words::status_words;

impl Compared {
    /// The page.
    pub fn html(&self) -> String {
        let notes: Vec<Vec<String>> = self.rungs.iter().map(notes).collect();
        let runs = self.rungs.iter().zip(&notes);
        let (of, joints) = (self.joint_word(), self.joints.join(", "));
        let page = ComparePage {
            model: self.file.name(),
            about: self.file.model().about.as_deref(),
            changes: format!("models of the clearance of {of} {joints}"),
            comparison: &self.comparison,
            runs: runs.map(|(rung, notes)| self.run(rung, notes)).collect(),
        };
        page.html()
    }

    fn run<'a>(&'a self, rung: &'a Rung, notes: &'a [String]) -> ComparedRun<'a> {
        let mut run = ComparedRun {
            name: rung.model,
            status: None,
            ended: self.refusal().to_string(),
            facts: String::new(),
            notes,
            table: None,
            events: &[],
        };
        match &rung.ran {
            Err(why) => run.facts.clone_from(why),
            Ok((_, outcome)) => {
                let curves = self.curves.iter().find(|(model, _)| *model == rung.model);
                run.status = Some(outcome.report.status);
                run.ended = status_words(outcome.report.status);
                run.facts = self.went(outcome);
                run.table = curves.map(|(_, table)| table);
                run.events = &outcome.report.events;
            }
        }
        run
    }
}

fn notes(rung: &Rung) -> Vec<String> {
    let Ok((_, outcome)) = &rung.ran else {
        return Vec::new();
    };
    let message = outcome.report.message.iter();
    message.chain(&outcome.report.warnings).cloned().collect()
}
