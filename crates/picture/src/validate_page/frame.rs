//! What pages of a validation have around their content.

use crate::html::{fill, policy, text};
use crate::palette;
use crate::report::PAGE_STYLE;

const TEMPLATE: &str = include_str!("page.html");
const OWN_STYLE: &str = include_str!("page.css");

/// A page with its title and content, which is HTML.
pub fn page(title: &str, content: &str) -> String {
    let style = [&palette::style_sheet(), PAGE_STYLE, OWN_STYLE].join("\n");
    let engine = env!("CARGO_PKG_VERSION");
    fill(
        TEMPLATE,
        &[
            ("policy", &policy(&[], &style)),
            ("style", &style),
            ("title", &text(title)),
            ("content", content),
            ("engine", engine),
        ],
    )
}
