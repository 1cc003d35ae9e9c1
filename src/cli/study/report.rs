//! `report.html` of a study.

use std::fs;
use std::path::{Path, PathBuf};

use super::asked::Column;
use super::head::{Asked, Head};
use super::motions::Again;
use super::sample::Sample;
use super::totals::Totals;
use crate::cli::exit::BadInput;
use crate::cli::open::Opened;
use crate::cli::replaced;
use linkdyn_engine::analysis::Family;
use linkdyn_model::display::Shown;
use linkdyn_output::Directory;
use linkdyn_picture::StudyPage;
use linkdyn_picture::accuracy_page::Unit;
use linkdyn_picture::study_page::{Played, Variable};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

const PAGE: &str = "report.html";

/// Symbol of a unit, and its size in SI.
type Named = (String, f64);

/// The units of the model file, in which the page shows its numbers; `study.json` keeps them for `merge`.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Display {
    length: Named,
    angle: Named,
    /// Of responses that have one of their own.
    responses: indexmap::IndexMap<String, Named>,
}

impl Default for Display {
    fn default() -> Self {
        Display {
            length: ("m".into(), 1.0),
            angle: ("rad".into(), 1.0),
            responses: indexmap::IndexMap::new(),
        }
    }
}

impl Display {
    /// Of a model and its responses.
    pub fn of(opened: &Opened, family: &Family) -> Self {
        let display = &opened.loaded.model.display;
        let named = |shown: &Shown| (shown.symbol.clone(), shown.size);
        let responses = family.responses().list().iter();
        Display {
            length: named(&display.length),
            angle: named(&display.angle),
            responses: responses
                .filter_map(|own| Some((own.name.clone(), own.shown.clone()?)))
                .collect(),
        }
    }
}

/// What is wanted besides the rows.
#[derive(Clone, Copy)]
pub struct Wish<'a> {
    /// `--no-report` leaves the page out.
    pub is_wanted: bool,
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
) -> Result<Option<PathBuf>, BadInput> {
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

/// The units that the directory of a study keeps; SI where it keeps none.
pub fn kept_display(directory: &Path) -> Display {
    let text = fs::read(directory.join(super::HEAD)).unwrap_or_default();
    let all: Value = serde_json::from_slice(&text).unwrap_or_default();
    serde_json::from_value(all["display"].clone()).unwrap_or_default()
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
