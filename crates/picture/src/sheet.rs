//! A page without scripts: a title, facts, drawings and texts, in one file.

use super::html::{self, Page};
use super::words;

/// The page's own rules, as those of pages with scripts. Figures are on white paper: in the dark their light is turned round, and the
/// hues stay.
const STYLE: &str = "\
:root { color-scheme: light dark; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--bg); color: var(--ink); font: 14px/1.45 system-ui, -apple-system, \"Segoe UI\", Roboto, \"Noto Sans\", Arial, sans-serif; }
header { padding: 10px 16px 8px; } main { padding: 0 16px 16px; }
h1 { font-size: 19px; line-height: 1.25; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 15px; margin: 16px 0 6px; }
p, ul, ol { margin: 4px 0; overflow-wrap: anywhere; }
.muted { color: var(--muted); }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 12px; margin: 0; }
.card svg { width: 100%; height: auto; display: block; max-height: 62vh; }
.card svg > rect:first-of-type { fill: transparent; }
input[type=\"checkbox\"] { accent-color: var(--accent); }
.many { display: grid; gap: 16px; grid-template-columns: repeat(auto-fit, minmax(min(420px, 100%), 1fr)); }
.beside { display: grid; gap: 16px; grid-template-columns: minmax(0, 3fr) minmax(280px, 2fr); align-items: start; }
figcaption { margin-top: 8px; }
.finding { display: grid; grid-template-columns: 28px 1fr; gap: 8px; padding: 8px 0; border-top: 1px solid var(--line); }
.number { width: 24px; height: 24px; border-radius: 12px; color: #fff; text-align: center; font-weight: bold; line-height: 24px; }
.wrong .number { background: var(--bad); } .doubt .number { background: var(--warn); } .note .number { background: var(--muted); }
.key { width: 22px; height: 4px; vertical-align: middle; margin-right: 8px; }
@media (prefers-color-scheme: dark) { .card svg { filter: invert(1) hue-rotate(180deg); } }
@media (max-width: 900px) { .beside { grid-template-columns: minmax(0, 1fr); } .beside > .first { order: -1; } }
@media (max-width: 600px) { header { padding: 8px 12px 6px; } main { padding: 0 10px 14px; } h1 { font-size: 17px; } .card { padding: 4px; } }
@media print { :root { color-scheme: light; } .card svg { filter: none; } body { font-size: 11px; } .card { break-inside: avoid; } }
";

/// Text as it may stand in a page.
pub fn text(plain: &str) -> String {
    html::text(&words::printable(plain))
}

/// A drawing with a title and further lines below it.
pub fn figure(drawing: &str, texts: &[String]) -> String {
    let texts: String = texts
        .iter()
        .enumerate()
        .map(|(k, words)| match k {
            0 => format!("<strong>{}</strong>", text(words)),
            _ => format!("<br>{}", text(words)),
        })
        .collect();
    format!("<figure class=\"card\">\n{drawing}<figcaption>{texts}</figcaption>\n</figure>\n")
}

/// The whole page; `title` and `facts` are plain text, `main` is what stands below.
pub fn page(title: &str, facts: &[String], main: &str) -> String {
    styled_page(title, facts, main, "")
}

/// The same with rules of its own.
pub fn styled_page(title: &str, facts: &[String], main: &str, rules: &str) -> String {
    let heading = text(title);
    let facts: String = facts
        .iter()
        .map(|fact| format!("<p class=\"muted\">{}</p>\n", text(fact)))
        .collect();
    Page {
        title: &words::printable(title),
        styles: &[STYLE, rules],
        body: &format!("<header>\n<h1>{heading}</h1>\n{facts}</header>\n<main>\n{main}</main>\n"),
    }
    .html()
}
