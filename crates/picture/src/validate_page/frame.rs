//! What pages of a validation have around their content.

use crate::html::{self, Page};

const OWN_STYLE: &str = include_str!("page.css");

/// A page with its title and content, which is HTML.
pub fn page(title: &str, content: &str) -> String {
    let engine = env!("CARGO_PKG_VERSION");
    Page {
        title: &format!("{title} – validation – linkdyn"),
        styles: &[html::STYLE, OWN_STYLE],
        body: &format!("{content}\n<footer id=\"foot\"><p>linkdyn {engine}.</p></footer>\n"),
    }
    .html()
}
