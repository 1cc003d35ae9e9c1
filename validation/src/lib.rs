//! Validation: answers that are not ours, each beside what the engine says.
//!
//! A *coded* case is a function that makes its claims; a *reference* case is a folder `validation/<case>/` with
//! `case.json`, `reference.csv` and `SOURCE.md` (see [`mod@reference`]). Both give claims with a verdict. A claim of a paper that is
//! not reproduced is a finding; only what must hold and does not is a fault.

mod beams;
mod cases;
mod claim;
mod elastic_clearance;
mod elastic_links;
mod flores_slider_crank;
mod four_bar_spring;
mod journal_billiard;
mod lock;
mod lock_elastic;
mod page;
mod path_synthesis;
pub mod reference;
mod restitution;
mod slider_crank_clearance;
pub mod table;
mod tolerance_ladder;

use std::path::Path;

use linkdyn_engine::analysis::{Control, Outcome};
use linkdyn_model::error::Complaints;
use linkdyn_output::{Directory, Status};
use reference::ReferenceCase;

pub use cases::CASES;
pub use claim::{CaseError, CaseReport, Claim, Setting, Verdict};

/// One case.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// As `linkdyn validate` calls it.
    pub name: &'static str,
    /// Where its claims come from.
    pub kind: CaseKind,
}

/// Where a case's claims come from.
#[derive(Debug, Clone, Copy)]
pub enum CaseKind {
    /// A function, with a line about it.
    Coded {
        /// What it shows, in a line.
        about: &'static str,
        /// The function.
        run: fn(&Setting) -> Result<CaseReport, CaseError>,
    },
    /// A model and a table of what it must give.
    Reference(ReferenceCase),
}

impl Case {
    /// A line about the case.
    pub fn about(&self) -> String {
        match self.kind {
            CaseKind::Coded { about, .. } => about.to_string(),
            CaseKind::Reference(case) => case.read().map(|words| words.about).unwrap_or_default(),
        }
    }

    /// Runs the case; with `output`, its files and its claims go into a directory of its name there.
    ///
    /// # Errors
    /// When it can't be run or written.
    pub fn run(&self, output: Option<&Path>, control: &Control) -> Result<CaseReport, CaseError> {
        let output = output.map(|output| output.join(self.name));
        let setting = Setting {
            output,
            control: control.clone(),
        };
        let report = match self.kind {
            CaseKind::Coded { run, .. } => run(&setting)?,
            CaseKind::Reference(case) => CaseReport {
                text: String::new(),
                claims: case.run(&setting)?,
            },
        };
        if let Some(output) = &setting.output {
            let directory = Directory::open(output)?;
            directory.write("claims.json", claims_json(&report.claims).as_bytes())?;
            if !report.text.is_empty() {
                directory.write("report.md", self.page(&report).as_bytes())?;
            }
            let page = page::html(self, &report, output);
            directory.write("report.html", page.as_bytes())?;
        }
        Ok(report)
    }

    /// The report as text.
    fn page(&self, report: &CaseReport) -> String {
        let mut page = format!(
            "# {}: {}\n\n```text\n{}",
            self.name,
            self.about(),
            report.text
        );
        for line in report.claims.iter().flat_map(Claim::lines) {
            page.push_str(line.trim_end());
            page.push('\n');
        }
        page + "```\n"
    }
}

/// Reason of a finding whose cause is not known.
const UNKNOWN: &str = "Why is not known.";

/// A claim that a value does not exceed what is allowed.
fn at_most(what: String, value: f64, most: f64) -> Claim {
    Claim {
        what,
        reference: format!("at most {most:.0e}"),
        ours: format!("{value:.1e}"),
        difference: format!("{:.1e}", value - most),
        verdict: verdict(value <= most),
    }
}

/// Of what must hold.
fn verdict(holds: bool) -> Verdict {
    if holds {
        Verdict::Agrees
    } else {
        Verdict::Fault
    }
}

fn broken(what: impl Into<String>) -> CaseError {
    CaseError::Broken(what.into())
}

/// A run that must have come to its end.
fn finished(run: Result<Outcome, Complaints>) -> Result<Outcome, CaseError> {
    let outcome = run.map_err(|said| broken(said.to_string()))?;
    match outcome.report.status {
        Status::Completed => Ok(outcome),
        Status::Interrupted => Err(CaseError::Interrupted),
        status => Err(broken(format!(
            "{}: {:?}",
            status.word(),
            outcome.report.message
        ))),
    }
}

/// Claims as the text of `claims.json`.
fn claims_json(claims: &[Claim]) -> String {
    let claim = |claim: &Claim| {
        let mut told = serde_json::json!({
            "what": claim.what,
            "reference": claim.reference,
            "ours": claim.ours,
            "difference": claim.difference,
            "verdict": claim.verdict.word().to_lowercase(),
        });
        if let Some(reason) = claim.verdict.reason() {
            told["reason"] = reason.into();
        }
        told
    };
    format!(
        "{:#}\n",
        claims.iter().map(claim).collect::<serde_json::Value>()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn one_claim(_: &Setting) -> Result<CaseReport, CaseError> {
        let claim = Claim {
            what: "π [–]".into(),
            reference: "3.14".into(),
            ours: "3.1416".into(),
            difference: "1.6e-3".into(),
            verdict: Verdict::Finding("Three digits are not all of it."),
        };
        Ok(CaseReport {
            text: String::new(),
            claims: vec![claim],
        })
    }

    #[test]
    fn a_coded_case_writes_its_claims() {
        let case = Case {
            name: "dummy",
            kind: CaseKind::Coded {
                about: "a number",
                run: one_claim,
            },
        };
        let output =
            std::env::temp_dir().join(format!("linkdyn-validation-{}", std::process::id()));
        let report = case.run(Some(&output), &Control::default()).expect("runs");
        assert_eq!(
            (report.claims.len(), case.about().as_str()),
            (1, "a number")
        );
        let written = std::fs::read_to_string(output.join("dummy/claims.json")).expect("written");
        let written: serde_json::Value = serde_json::from_str(&written).expect("valid JSON");
        assert_eq!(written[0]["verdict"], "finding");
        assert_eq!(written[0]["reason"], "Three digits are not all of it.");
        let lines = report.claims[0].lines();
        assert_eq!(
            lines[2],
            "          why        Three digits are not all of it."
        );
        std::fs::remove_dir_all(output).expect("removed");
    }

    #[test]
    fn every_case_folder_is_bundled_and_has_a_source() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf();
        let entries = std::fs::read_dir(&folder)
            .into_iter()
            .flatten()
            .filter_map(Result::ok);
        let cases = entries
            .map(|entry| entry.path())
            .filter(|path| path.join("case.json").exists());
        let mut folders = BTreeSet::new();
        for case in cases {
            assert!(case.join("SOURCE.md").exists(), "{case:?}");
            folders.extend(
                case.file_name()
                    .and_then(|name| name.to_str())
                    .map(String::from),
            );
        }
        let is_reference = |case: &&Case| matches!(case.kind, CaseKind::Reference(_));
        let bundled: BTreeSet<String> = CASES
            .iter()
            .filter(is_reference)
            .map(|case| case.name.to_string())
            .collect();
        assert_eq!(folders, bundled);
    }
}
