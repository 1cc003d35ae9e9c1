//! What a page is made of, and the page.

use std::io::{self, Write};

use serde_json::{Value, json};

use super::columns::{cuts, heading, sources};
use super::encode::{Plan, Source, plan, write_values};
use super::facts::{cut, facts};
use crate::html::{self, Live, escaped};
use crate::mechanism::Drawing;
use crate::palette;
use crate::shape::Shape;
use linkdyn_model::Model;
use linkdyn_output::{Summary, Trajectory};

const BODY: &str = include_str!("page.html");
/// What only pages need on which links bend.
const BENT: &str = include_str!("js/bent.js");
/// In the order in which they build on each other.
pub const SCRIPTS: &[&str] = &[
    include_str!("js/data.js"),
    html::PLAYER,
    html::PLACES,
    html::DRAWING,
    include_str!("js/ghost.js"),
    include_str!("js/labels.js"),
    include_str!("js/forces.js"),
    include_str!("js/moments.js"),
    BENT,
    include_str!("js/stage.js"),
    include_str!("js/mini.js"),
    include_str!("js/choices.js"),
    include_str!("js/clearance.js"),
    include_str!("js/plot_marks.js"),
    include_str!("js/plot.js"),
    include_str!("js/plots.js"),
    include_str!("js/hits.js"),
    include_str!("js/headline.js"),
    include_str!("js/answers.js"),
    include_str!("js/tables.js"),
    include_str!("js/diagnosis.js"),
    include_str!("js/head.js"),
    include_str!("js/svg_pen.js"),
    include_str!("js/figure.js"),
    include_str!("js/export.js"),
    include_str!("js/transport.js"),
    include_str!("js/drawer.js"),
    include_str!("js/kept.js"),
    include_str!("js/keys.js"),
];

/// Largest size of a page \[bytes\].
pub const LIMIT: usize = 5_000_000;
/// Room kept for what the page says about what it leaves out.
const MARGIN: usize = 20_000;
/// Most instants from which the extent of a mechanism is computed.
const MOST_ROWS: usize = 400;
/// Shapes and drawings of more text than this are left out.
const LARGEST_SHAPE: usize = 3_500_000;

/// What a page is made of.
#[derive(Debug)]
pub struct Report<'a> {
    /// The mechanism to draw.
    pub shape: Shape,
    /// What the model is about.
    pub about: Option<&'a str>,
    /// Where the model comes from.
    pub source: Option<&'a str>,
    /// How the run went; its columns are the ones to show.
    pub summary: &'a Summary<'a>,
    /// All columns that were computed, those of bodies among them: the page draws the mechanism from their poses.
    pub table: &'a Trajectory,
    /// Further columns of the same rows that are no results, such as applied forces.
    pub derived: Option<&'a Trajectory>,
    /// What the reader should know.
    pub notes: Vec<String>,
}

impl<'a> Report<'a> {
    /// A page about a run of a model: how it went, and all columns that were computed.
    pub fn new(model: &'a Model, summary: &'a Summary<'a>, table: &'a Trajectory) -> Self {
        Report {
            shape: Shape::of_model(model),
            about: model.about.as_deref(),
            source: model.source.as_deref(),
            summary,
            table,
            derived: None,
            notes: Vec::new(),
        }
    }

    /// Writes the page, piece by piece: the text of a file which needs nothing else.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let bends = self.shape.bodies.iter().any(|body| body.bending.is_some());
        let page = with_scripts(bends);
        self.fill(&page.each_ref().map(String::as_str), out)
    }

    /// Writes its data alone, with which a page of the same mechanism shows this run: JSON, a line feed, and the numbers in base64.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_data(&self, out: &mut impl Write) -> io::Result<()> {
        self.fill(&["", "\n", ""], out)
    }

    /// The same for a page that takes the numbers as they are, and has no limit: JSON, and column after column.
    pub fn data(&self) -> (String, Vec<f64>) {
        self.planned(usize::MAX, |data, sources, _| {
            let columns = sources.iter();
            let values =
                columns.flat_map(|source| source.table.rows().map(|row| row[source.index]));
            (data.to_owned(), values.collect())
        })
    }

    /// Writes the data and the numbers, with texts around them.
    fn fill(&self, [before, between, after]: &[&str; 3], out: &mut impl Write) -> io::Result<()> {
        let around = before.len() + between.len() + after.len();
        let room = LIMIT.saturating_sub(around + MARGIN);
        self.planned(room, |data, sources, plan| {
            for text in [before, data, between] {
                out.write_all(text.as_bytes())?;
            }
            write_values(sources.iter().copied(), plan, out)?;
            out.write_all(after.as_bytes())
        })
    }

    /// Lets `write` have the data as JSON, the columns and rows that there is room for, in so many bytes.
    fn planned<T>(&self, room: usize, write: impl FnOnce(&str, &[&Source], &Plan) -> T) -> T {
        let mut notes = self.notes.clone();
        let facts = escaped(&facts(self.summary, &mut notes).to_string());
        let rows = self.shape.poses_in(self.table, MOST_ROWS);
        let [mut shape, mut drawing] = [self.shape.for_page(), Drawing::of(&self.shape, &rows).0]
            .map(|json| escaped(&json.to_string()));
        if shape.len() + drawing.len() > LARGEST_SHAPE {
            notes.push("The model is too large to be drawn here.".into());
            shape = Shape::default().to_json().to_string();
            drawing = Drawing::empty().0.to_string();
        }
        let [about, source] =
            [self.about, self.source].map(|text| escaped(&json!(text.map(cut)).to_string()));
        let sources = sources(self.summary.trajectory, self.table, self.derived);
        let cuts = escaped(&cuts(&sources).to_string());
        let used = [&facts, &shape, &drawing, &about, &source, &cuts].map(|text| text.len());
        let used = used.iter().sum::<usize>() + notes.concat().len();
        let rows = self.table.len();
        let room = room.saturating_sub(used);
        let plan = plan(&sources, rows, room, |source| heading(source).len() + 1);
        let kept: Vec<&Source> = sources
            .iter()
            .filter(|source| source.worth <= plan.worth)
            .collect();
        notes.extend(left_out(&plan, rows, kept.len(), sources.len()));
        let columns: Vec<String> = kept.iter().map(|source| heading(source)).collect();
        let parts = [
            ("summary", facts),
            ("about", about),
            ("source", source),
            ("mechanism", shape),
            ("drawing", drawing),
            ("palette", palette::to_json().to_string()),
            ("notes", escaped(&json!(notes).to_string())),
            ("cuts", cuts),
            ("rows", plan.rows.len().to_string()),
            ("width", self.summary.trajectory.width().to_string()),
            ("bytes", if plan.binary64 { "8" } else { "4" }.into()),
            ("columns", format!("[{}]", columns.join(","))),
        ];
        let data = parts.map(|(name, json)| format!("{}:{json}", Value::from(name)));
        write(&format!("{{{}}}", data.join(",")), &kept, &plan)
    }
}

/// The page around its data, which are JSON that is escaped, and its values: for a page that holds it in a frame and hands data over.
pub fn around() -> [String; 3] {
    with_scripts(true)
}

fn with_scripts(bends: bool) -> [String; 3] {
    let scripts = SCRIPTS.iter().copied();
    let scripts: Vec<&str> = scripts.filter(|text| bends || *text != BENT).collect();
    Live {
        title: "linkdyn report",
        style: "",
        body: BODY,
        scripts: &scripts,
        data: "",
        values: "",
    }
    .around()
}

/// What to say about rows, columns and digits that are not in the page.
fn left_out(plan: &Plan, rows: usize, columns: usize, all_columns: usize) -> Vec<String> {
    let mut notes = Vec::new();
    if plan.rows.len() < rows {
        let extremes = match plan.all_extremes {
            true => "All extremes are among them",
            false => "What lies between does not count among the extremes below",
        };
        notes.push(format!(
            "Of {rows} instants every {}th is in this page, and some with extremes, {} in all, so that it stays below 5 MB. \
             {extremes}; results.csv has all outputs.",
            plan.step,
            plan.rows.len()
        ));
    }
    if columns < all_columns {
        notes.push(format!(
            "Of {all_columns} columns {columns} are in this page, so that it stays below 5 MB. Columns that analysis.columns asks for come first.",
        ));
    }
    if !plan.binary64 {
        notes.push("Numbers in this page have 7 digits; results.csv has all 16.".into());
    }
    notes
}
