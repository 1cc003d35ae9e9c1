//! `report.html` of a case: its claims, words and figures as a page.

use std::fs;
use std::path::Path;

use super::{Case, CaseKind, CaseReport, Claim, Verdict};
use linkdyn_picture::validate_page::{CasePage, Compared, Figure, Judged};

/// Files of figures in the folder of a case.
const FIGURES: &str = "svg";

impl From<Verdict> for Judged {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Agrees => Judged::Agrees,
            Verdict::Finding(_) => Judged::Finding,
            Verdict::Fault => Judged::Fault,
        }
    }
}

/// The page of a case whose files stand in a folder.
pub fn html(case: &Case, report: &CaseReport, folder: &Path) -> String {
    let source = match case.kind {
        CaseKind::Coded { .. } => None,
        CaseKind::Reference(reference) => reference.read().ok().map(|words| words.source),
    };
    let page = CasePage {
        name: case.name,
        about: &case.about(),
        source: source.as_deref(),
        text: &report.text,
        compared: report.claims.iter().map(compared).collect(),
        figures: figures(folder),
    };
    page.html()
}

fn compared(claim: &Claim) -> Compared<'_> {
    Compared {
        what: &claim.what,
        reference: &claim.reference,
        ours: &claim.ours,
        difference: &claim.difference,
        judged: claim.verdict.into(),
        reason: claim.verdict.reason(),
    }
}

/// The figures that the case has drawn, by name; without those that can't be read.
fn figures(folder: &Path) -> Vec<Figure> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|ending| ending == FIGURES));
    let mut figures: Vec<Figure> = paths
        .filter_map(|path| {
            let file = path.file_name()?.to_str()?.to_string();
            let svg = fs::read_to_string(&path).ok()?;
            Some(Figure { file, svg })
        })
        .collect();
    figures.sort_by(|a, b| a.file.cmp(&b.file));
    figures
}
