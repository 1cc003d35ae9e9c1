//! Claims with their verdicts, and what a case that makes them is run with.

use std::path::PathBuf;

use linkdyn_engine::analysis::Control;
use linkdyn_output::WriteError;
use thiserror::Error;

/// What a case is run with.
#[derive(Debug, Clone, Default)]
pub struct Setting {
    /// Directory of this case for the files it may write.
    pub output: Option<PathBuf>,
    /// Interrupts and deadlines.
    pub control: Control,
}

/// What a case tells.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CaseReport {
    /// Tables and words for people, above the claims; may be empty.
    pub text: String,
    /// What was compared.
    pub claims: Vec<Claim>,
}

/// One compared quantity, as text for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// What is compared, with its unit.
    pub what: String,
    /// Of the source.
    pub reference: String,
    /// Of linkdyn.
    pub ours: String,
    /// How far they are apart, beside what is allowed.
    pub difference: String,
    /// What follows.
    pub verdict: Verdict,
}

/// What follows from a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Within the tolerance.
    Agrees,
    /// A claim that is not reproduced, without a fault of ours in it, and why: a sentence that the case's source bears out.
    Finding(&'static str),
    /// What must hold and does not.
    Fault,
}

impl Verdict {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Finding(_) => "finding",
            Verdict::Fault => "FAULT",
        }
    }

    /// Why it is a finding.
    pub fn reason(self) -> Option<&'static str> {
        match self {
            Verdict::Finding(reason) => Some(reason),
            Verdict::Agrees | Verdict::Fault => None,
        }
    }
}

/// Width of a claim that goes on in one line.
const LINE_WIDTH: usize = 120;

impl Claim {
    /// A number that must be another one, to a tolerance.
    pub(crate) fn near(what: &str, reference: f64, ours: f64, tolerance: f64) -> Self {
        let difference = ours - reference;
        let verdict = if difference.abs() <= tolerance {
            Verdict::Agrees
        } else {
            Verdict::Fault
        };
        Claim {
            what: what.into(),
            reference: reference.to_string(),
            ours: ours.to_string(),
            difference: format!("{difference:.1e}"),
            verdict,
        }
    }

    /// The claim in lines: what it is about with the verdict, then reference, ours and difference, in one line where they fit,
    /// and the reason of a finding.
    pub fn lines(&self) -> Vec<String> {
        let Claim {
            what,
            reference,
            ours,
            difference,
            verdict,
        } = self;
        let mut lines = vec![format!("  {:8}{what}", verdict.word())];
        let short =
            format!("          reference {reference}, ours {ours}, difference {difference}");
        if short.chars().count() <= LINE_WIDTH {
            lines.push(short);
        } else {
            for (name, text) in [
                ("reference", reference),
                ("ours", ours),
                ("difference", difference),
            ] {
                lines.extend(wrap(name, text));
            }
        }
        if let Some(reason) = verdict.reason() {
            lines.extend(wrap("why", reason));
        }
        lines
    }
}

/// `text` behind a name, broken between words.
fn wrap(name: &str, text: &str) -> Vec<String> {
    let mut lines = vec![format!("          {name:10}")];
    for (index, word) in text.split(' ').enumerate() {
        let Some(line) = lines.last_mut() else { break };
        if index > 0 && line.chars().count() + 1 + word.chars().count() > LINE_WIDTH {
            lines.push(format!("{:20} {word}", ""));
        } else {
            line.push(' ');
            line.push_str(word);
        }
    }
    lines
}

/// Why a case has no claims.
#[derive(Debug, Error)]
pub enum CaseError {
    /// The case itself can't be run: a fault of ours.
    #[error("{0}")]
    Broken(String),
    /// The user interrupts.
    #[error("interrupted")]
    Interrupted,
    /// A file can't be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}
