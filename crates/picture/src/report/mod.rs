//! `report.html`: the mechanism in motion, plots, tables; one file that needs nothing else and asks the network for nothing.
//!
//! The page is `page.html` with styles, scripts and data put in. Names of the model reach it only inside JSON in which `<`, `>` and
//! `&` are escaped, and get into the page as text alone (`textContent`). A content security policy lets only these scripts and
//! styles act, named by their SHA-256. Plots are drawn by uPlot (`vendor/`).

mod encode;
mod mechanism;

use std::fmt::Write as _;

use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use encode::{Source, Worth, base64, plan, values};
use linkdyn_output::{
    BodyQuantity, Channel, Column, DriverQuantity, PointQuantity, Summary, Trajectory, summary,
};
pub use mechanism::{
    Body, Clearance, Driver, Gear, Joint, Load, Mechanism, PointId, Spring, TorsionSpring,
};

/// Largest size of a page \[bytes\].
pub const LIMIT: usize = 5_000_000;
/// Room kept for what the page says about what it leaves out.
const MARGIN: usize = 20_000;
/// Events and warnings beyond these are counted only, longer texts are cut.
const MOST_EVENTS: usize = 2_000;
const MOST_WARNINGS: usize = 200;
const LONGEST_TEXT: usize = 2_000;
/// Drawings of more text than this are left out, and settings.
const LARGEST_DRAWING: usize = 3_500_000;
const LARGEST_SETTINGS: usize = 100_000;

const PAGE: &str = include_str!("page.html");
const STYLE: &str = concat!(
    include_str!("vendor/uPlot.min.css"),
    "\n",
    include_str!("page.css")
);
const PLOT_LIBRARY: &str = include_str!("vendor/uPlot.iife.min.js");
/// Its licence asks to stand in every copy.
const LICENCE: &str = include_str!("vendor/uPlot.LICENSE");
/// In the order in which they build on each other.
const SCRIPT: &str = concat!(
    include_str!("js/data.js"),
    include_str!("js/theme.js"),
    include_str!("js/units.js"),
    include_str!("js/player.js"),
    include_str!("js/shapes.js"),
    include_str!("js/drawing.js"),
    include_str!("js/stage.js"),
    include_str!("js/clearance.js"),
    include_str!("js/plot.js"),
    include_str!("js/plots.js"),
    include_str!("js/tables.js"),
    include_str!("js/controls.js"),
);

/// What a page is made of.
#[derive(Debug)]
pub struct Page<'a> {
    pub summary: &'a Summary<'a>,
    /// The model's `about` and `source`.
    pub about: Option<&'a str>,
    pub source: Option<&'a str>,
    pub mechanism: &'a Mechanism,
    /// All columns that were computed; those of `summary.trajectory` are the ones to show.
    pub complete: &'a Trajectory,
    /// Further columns of the same rows that are no results.
    pub derived: &'a Trajectory,
    /// What the reader should know about them.
    pub notes: Vec<String>,
}

/// The page as the text of the file.
pub fn to_text(page: &Page) -> String {
    let mut notes = page.notes.clone();
    let facts = escaped(&facts(page.summary, &mut notes).to_string());
    let mut mechanism = escaped(&json!(page.mechanism).to_string());
    if mechanism.len() > LARGEST_DRAWING {
        notes.push("The model is too large to be drawn here.".into());
        mechanism = escaped(&json!(Mechanism::default()).to_string());
    }
    let texts = [page.about, page.source].map(|text| escaped(&json!(text.map(cut)).to_string()));
    let fixed = PAGE.len() + STYLE.len() + LICENCE.len() + PLOT_LIBRARY.len() + SCRIPT.len();
    let used = fixed
        + facts.len()
        + mechanism.len()
        + texts[0].len()
        + texts[1].len()
        + notes.concat().len();
    let sources = sources(page);
    let rows = page.complete.len();
    let plan = plan(
        &sources,
        rows,
        LIMIT.saturating_sub(used + MARGIN),
        |source| heading(source).len() + 1,
    );
    let kept: Vec<&Source> = sources
        .iter()
        .filter(|source| source.worth <= plan.worth)
        .collect();
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
    if kept.len() < sources.len() {
        notes.push(format!(
            "Of {} columns {} are in this page, so that it stays below 5 MB. Columns that analysis.columns asks for come first.",
            sources.len(),
            kept.len()
        ));
    }
    if !plan.binary64 {
        notes.push("Numbers in this page have 7 digits; results.csv has all 16.".into());
    }
    let columns: Vec<String> = kept.iter().map(|source| heading(source)).collect();
    let values = values(kept.iter().copied(), &plan);
    let mut data = String::with_capacity(facts.len() + mechanism.len() + 1000);
    // Writing to a String can't fail.
    let _ = write!(
        data,
        "{{\"summary\":{facts},\"about\":{},\"source\":{},\"mechanism\":{mechanism},\"notes\":{},\"rows\":{},\"width\":{},\"bytes\":{},\"columns\":[{}]}}",
        texts[0],
        texts[1],
        escaped(&json!(notes).to_string()),
        plan.rows.len(),
        page.summary.trajectory.width(),
        if plan.binary64 { 8 } else { 4 },
        columns.join(",")
    );
    fill(&[
        ("policy", &policy()),
        ("style", STYLE),
        ("data", &data),
        ("values", &values),
        ("licence", LICENCE),
        ("plot_library", PLOT_LIBRARY),
        ("script", SCRIPT),
    ])
}

/// The template with its `{{words}}` replaced, in one pass: what is put in is not looked at again.
fn fill(parts: &[(&str, &str)]) -> String {
    let mut text =
        String::with_capacity(PAGE.len() + parts.iter().map(|(_, part)| part.len()).sum::<usize>());
    for (index, piece) in PAGE.split("{{").enumerate() {
        let (word, rest) = if index == 0 {
            ("", piece)
        } else {
            piece.split_once("}}").unwrap_or(("", piece))
        };
        text.extend(
            parts
                .iter()
                .find(|(name, _)| *name == word)
                .map(|(_, part)| *part),
        );
        text.push_str(rest);
    }
    text
}

/// Only our own scripts and styles, no network, no forms, no frames.
fn policy() -> String {
    let hash = |text: &str| format!("'sha256-{}'", base64(&Sha256::digest(text.as_bytes())));
    format!(
        "default-src 'none'; script-src {} {}; style-src {}; base-uri 'none'; form-action 'none'",
        hash(PLOT_LIBRARY),
        hash(SCRIPT),
        hash(STYLE)
    )
}

/// JSON that can stand in a script element: no tag, comment or line separator in it can end or change anything.
fn escaped(json: &str) -> String {
    let mut text = String::with_capacity(json.len() + json.len() / 16);
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                let _ = write!(text, "\\u{:04x}", c as u32);
            }
            _ => text.push(c),
        }
    }
    text
}

/// At most so much of a text.
fn cut(text: &str) -> String {
    match text.char_indices().nth(LONGEST_TEXT) {
        Some((end, _)) => format!("{} …", &text[..end]),
        None => text.to_string(),
    }
}

/// The summary without extremes and without the time of writing, which is not over yet.
fn facts(summary: &Summary, notes: &mut Vec<String>) -> Value {
    let mut facts = summary::facts(summary);
    if let Some(timing) = facts.get_mut("timing").and_then(Value::as_object_mut) {
        timing.remove("write");
    }
    if let Some(Value::Array(events)) = facts.get_mut("events")
        && events.len() > MOST_EVENTS
    {
        notes.push(format!(
            "The first {MOST_EVENTS} of {} events are shown; summary.json has all.",
            events.len()
        ));
        events.truncate(MOST_EVENTS);
    }
    if let Some(Value::Array(warnings)) = facts.get_mut("warnings")
        && warnings.len() > MOST_WARNINGS
    {
        notes.push(format!(
            "The first {MOST_WARNINGS} of {} warnings are shown.",
            warnings.len()
        ));
        warnings.truncate(MOST_WARNINGS);
    }
    if facts
        .get("settings")
        .is_some_and(|settings| settings.to_string().len() > LARGEST_SETTINGS)
    {
        facts.remove("settings");
        notes.push("The settings are too long to be shown; summary.json has them.".into());
    }
    for key in ["mobility", "equilibrium"] {
        if let Some(Value::Object(part)) = facts.get_mut(key) {
            shorten_lists(part);
        }
    }
    let mut facts = Value::Object(facts);
    shorten_texts(&mut facts);
    facts
}

fn shorten_lists(part: &mut Map<String, Value>) {
    for value in part.values_mut() {
        if let Value::Array(list) = value
            && list.len() > MOST_WARNINGS
        {
            let more = list.len() - MOST_WARNINGS;
            list.truncate(MOST_WARNINGS);
            list.push(format!("… and {more} more").into());
        }
    }
}

fn shorten_texts(value: &mut Value) {
    match value {
        Value::String(text) if text.len() > LONGEST_TEXT => *text = cut(text),
        Value::Array(list) => list.iter_mut().for_each(shorten_texts),
        Value::Object(map) => map.values_mut().for_each(shorten_texts),
        Value::String(_) | Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}

/// `[name, unit, wanted]`.
fn heading(source: &Source) -> String {
    let Column { name, unit, .. } = source.column;
    escaped(&json!([name, unit, u8::from(source.wanted)]).to_string())
}

/// All columns there are, with what they are worth.
fn sources<'a>(page: &Page<'a>) -> Vec<Source<'a>> {
    let shown = page.summary.trajectory;
    let chosen = shown.width() < page.complete.width();
    // The columns shown are a subsequence of all.
    let mut next = 0;
    let results = page
        .complete
        .columns
        .iter()
        .enumerate()
        .map(|(index, column)| {
            let wanted = shown.columns.get(next) == Some(column);
            next += usize::from(wanted);
            let worth = if chosen && wanted {
                Worth::Asked
            } else {
                worth(column.channel)
            };
            Source {
                column,
                table: page.complete,
                index,
                worth,
                wanted,
            }
        });
    let derived = page
        .derived
        .columns
        .iter()
        .enumerate()
        .map(|(index, column)| Source {
            column,
            table: page.derived,
            index,
            worth: Worth::Overall,
            wanted: true,
        });
    results.chain(derived).collect()
}

/// What a column is worth by what it is.
fn worth(channel: Option<Channel>) -> Worth {
    match channel {
        Some(Channel::Time | Channel::Driver(_, DriverQuantity::Value)) => Worth::Asked,
        Some(Channel::Body(_, BodyQuantity::X | BodyQuantity::Y | BodyQuantity::Angle)) => {
            Worth::Pose
        }
        Some(
            Channel::Body(_, BodyQuantity::Vx | BodyQuantity::Vy | BodyQuantity::Omega)
            | Channel::Point(_, PointQuantity::Vx | PointQuantity::Vy),
        ) => Worth::Velocity,
        Some(
            Channel::Body(_, BodyQuantity::Ax | BodyQuantity::Ay | BodyQuantity::Alpha)
            | Channel::Point(_, PointQuantity::Ax | PointQuantity::Ay),
        ) => Worth::Acceleration,
        Some(Channel::Joint(..)) => Worth::Joint,
        Some(
            Channel::Point(_, PointQuantity::X | PointQuantity::Y)
            | Channel::Driver(_, DriverQuantity::Effort)
            | Channel::Energy(_)
            | Channel::Load(..)
            | Channel::Shaking(_)
            | Channel::Transmission(_),
        )
        | None => Worth::Overall,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_output::JointQuantity;

    #[test]
    fn json_in_a_script_element_can_not_end_it() {
        let text = escaped(&json!("</script><!-- & \u{2028}\u{2029} \" ok").to_string());
        assert!(
            !text.contains(['<', '>', '&', '\u{2028}', '\u{2029}']),
            "{text}"
        );
        let back: String = serde_json::from_str(&text).expect("still JSON");
        assert_eq!(back, "</script><!-- & \u{2028}\u{2029} \" ok");
    }

    #[test]
    fn the_scripts_can_stand_in_a_page() {
        for text in [SCRIPT, PLOT_LIBRARY, STYLE] {
            assert!(
                !text.to_lowercase().contains("</script")
                    && !text.contains("<!--")
                    && !text.contains("</style")
            );
        }
    }

    #[test]
    fn every_word_of_the_template_is_filled_in() {
        let words: Vec<&str> = PAGE
            .split("{{")
            .skip(1)
            .filter_map(|piece| Some(piece.split_once("}}")?.0))
            .collect();
        assert_eq!(
            words,
            [
                "policy",
                "style",
                "data",
                "values",
                "licence",
                "plot_library",
                "script"
            ]
        );
        assert!(
            !LICENCE.contains("--"),
            "it would end the comment it stands in"
        );
    }

    #[test]
    fn columns_are_worth_what_they_show() {
        for (channel, expected) in [
            (Channel::Time, Worth::Asked),
            (Channel::Body(0, BodyQuantity::X), Worth::Pose),
            (Channel::Point(0, PointQuantity::X), Worth::Overall),
            (Channel::Joint(0, JointQuantity::Fx), Worth::Joint),
            (Channel::Joint(0, JointQuantity::Penetration), Worth::Joint),
            (Channel::Driver(0, DriverQuantity::Value), Worth::Asked),
            (Channel::Body(0, BodyQuantity::Alpha), Worth::Acceleration),
        ] {
            assert_eq!(worth(Some(channel)), expected, "{channel:?}");
        }
    }
}
