//! `report.html` of a study.

use std::path::PathBuf;

use super::asked::Column;
use super::display::{Display, Named};
use super::head::{Asked, Head};
use super::motions::Again;
use super::sample::Sample;
use super::totals::Totals;
use crate::cli::exit::Failure;
use crate::cli::replaced;
use linkdyn_output::Directory;
use linkdyn_picture::StudyPage;
use linkdyn_picture::accuracy_page::Unit;
use linkdyn_picture::study_page::{Played, Variable};
use serde_json::json;

const PAGE: &str = "report.html";

/// What is wanted besides the rows.
#[derive(Clone, Copy)]
pub struct Wish<'a> {
    /// `--no-report` leaves the page out.
    pub is_wanted: bool,
    /// `--parquet` writes the rows by columns, too.
    pub parquet: bool,
    pub display: &'a Display,
    /// Runs variants again; none where the model is not at hand.
    pub again: Option<Again<'a>>,
}

/// Writes the page, or takes an older one away; its path where it is written.
pub fn write(
    directory: &Directory,
    head: &Head,
    totals: &Totals,
    sample: Sample,
    wish: Wish,
) -> Result<Option<PathBuf>, Failure> {
    let does = if wish.is_wanted {
        "replaced"
    } else {
        "removed"
    };
    replaced::tell(directory.path(), "study", does);
    if wish.is_wanted {
        let html = html(head, totals, sample, wish);
        return Ok(Some(directory.write(PAGE, html.as_bytes())?));
    }
    directory.remove(PAGE)?;
    Ok(None)
}

fn html(head: &Head, totals: &Totals, sample: Sample, wish: Wish) -> String {
    let rows = sample.rows();
    let display = wish.display;
    let shown = |named: &Named| Unit {
        symbol: named.0.clone(),
        size: named.1,
    };
    let input = |own: &Column| Variable {
        name: own.name.clone(),
        unit: own.unit.clone(),
        shown: None,
        facts: json!(own.how),
    };
    let response = |own: &Asked| Variable {
        name: own.name.clone(),
        unit: own.unit.clone(),
        shown: display.responses.get(&own.name).map(shown),
        facts: json!({ "value": own.value, "limits": own.limits }),
    };
    let played = match wish.again {
        Some(again) => again.motions(&rows),
        None => Played::None(
            "No variant can be played: the chunks were joined without the model. The command of the study, given again, writes a page with motions.",
        ),
    };
    StudyPage {
        model: head.model["name"].as_str().unwrap_or_default(),
        method: super::text::method(head),
        variants: head.variants,
        units: [shown(&display.length), shown(&display.angle)],
        inputs: head.inputs.iter().map(input).collect(),
        responses: head.responses.iter().map(response).collect(),
        summary: &json!(totals.told()),
        rows,
        played,
    }
    .html()
}
