//! Figures of curves with a text each → a page without scripts.

use super::chart::Chart;
use super::fault::Fault;
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
    let mut main = String::from("<div class=\"many\">\n");
    for (words, chart) in charts {
        let drawing = svg::write(&chart.draw()?);
        main += &format!(
            "<figure class=\"card\">\n{drawing}<figcaption>{}</figcaption>\n</figure>\n",
            sheet::text(words)
        );
    }
    main += "</div>\n";
    Ok(sheet::page(heading, facts, &main))
}
