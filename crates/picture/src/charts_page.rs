//! Figures of curves with a text each → a page without scripts.

use super::chart::Chart;
use super::fault::Fault;
use super::scene::Scene;
use super::{sheet, svg};

/// The page with a heading, facts below it, and the figures.
///
/// # Errors
/// When a figure can't be drawn.
pub fn charts_page(
    heading: &str,
    facts: &[String],
    charts: &[(String, Chart)],
) -> Result<String, Fault> {
    let drawn = charts.iter();
    let drawn = drawn.map(|(words, chart)| Ok((words.clone(), chart.draw()?)));
    let drawn: Vec<(String, Scene)> = drawn.collect::<Result<_, Fault>>()?;
    Ok(sheet::page(heading, facts, &figures(&drawn)))
}

/// Several drawings abreast.
const NARROW: &str =
    ".many { grid-template-columns: repeat(auto-fill, minmax(min(100%, 19rem), 1fr)); }";

/// The same with drawings, more of them abreast.
pub fn scenes_page(heading: &str, facts: &[String], scenes: &[(String, Scene)]) -> String {
    sheet::styled_page(heading, facts, &figures(scenes), NARROW)
}

fn figures(scenes: &[(String, Scene)]) -> String {
    let mut main = String::from("<div class=\"many\">\n");
    for (words, scene) in scenes {
        let drawing = svg::write(scene);
        main += &format!(
            "<figure class=\"card\">\n{drawing}<figcaption>{}</figcaption>\n</figure>\n",
            sheet::text(words)
        );
    }
    main += "</div>\n";
    main
}
