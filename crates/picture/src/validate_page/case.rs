//! The page of a case: verdict in words, figures, what differs and why, what agrees, and what the case reports.

use std::fmt::Write as _;

use data_encoding::BASE64;

use super::frame::page;
use super::words::{Counts, Judged, MEANINGS};
use crate::html::text;

/// What the page is made of.
#[derive(Debug, Clone, Default)]
pub struct CasePage<'a> {
    /// As `linkdyn validate` calls it.
    pub name: &'a str,
    /// A line about the case.
    pub about: &'a str,
    /// Who measured, published or computed the reference.
    pub source: Option<&'a str>,
    /// Tables and words for people; headings begin with `## `.
    pub text: &'a str,
    /// What was compared.
    pub compared: Vec<Compared<'a>>,
    /// Figures of the case.
    pub figures: Vec<Figure>,
}

/// One compared quantity.
#[derive(Debug, Clone, Copy)]
pub struct Compared<'a> {
    /// What is compared, with its unit.
    pub what: &'a str,
    /// Of the source.
    pub reference: &'a str,
    /// Of linkdyn.
    pub ours: &'a str,
    /// How far they are apart, or by which rule it was judged.
    pub difference: &'a str,
    /// What follows.
    pub judged: Judged,
    /// Why it differs, where that is explained.
    pub reason: Option<&'a str>,
}

/// A figure.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Name of its file.
    pub file: String,
    /// The drawing.
    pub svg: String,
}

impl CasePage<'_> {
    /// The page as the text of a file, which needs nothing else.
    pub fn html(&self) -> String {
        let mut counts = Counts::default();
        self.compared.iter().for_each(|row| counts.add(row.judged));
        let mut content = String::new();
        // Writing to a String can't fail.
        let _ = write!(
            content,
            "<header id=\"head\"><p><a href=\"../index.html\">All cases</a></p><h1 class=\"text\">{}</h1><p>{}</p>\
             <p class=\"sentence {}\">{}</p>",
            text(self.name),
            text(self.about),
            counts.class(),
            counts.sentence()
        );
        if counts.findings > 0 {
            let _ = write!(
                content,
                "<p class=\"muted\">{MEANINGS} The reasons stand below, and in <code>linkdyn docs validation</code>.</p>"
            );
        }
        if let Some(source) = self.source {
            let _ = write!(
                content,
                "<p class=\"muted\">Reference: {}</p>",
                text(source)
            );
        }
        content.push_str("</header><main>");
        self.figures(&mut content);
        for (judged, title, open) in [
            (Judged::Fault, "Errors of linkdyn", true),
            (Judged::Finding, "What differs, and why", true),
            (
                Judged::Agrees,
                "What agrees",
                counts.findings + counts.faults == 0,
            ),
        ] {
            self.table(&mut content, judged, title, open);
        }
        self.words(&mut content);
        content.push_str("</main>");
        page(self.name, &content)
    }

    fn figures(&self, content: &mut String) {
        if self.figures.is_empty() {
            return;
        }
        content.push_str("<section id=\"figures\">");
        for Figure { file, svg } in &self.figures {
            // The case's own words about the figure, where it has some.
            let about = self
                .text
                .lines()
                .find_map(|line| line.strip_prefix(file.as_str()));
            let about = about.map_or(String::new(), |about| format!(": {}", about.trim()));
            let _ = write!(
                content,
                "<figure><img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\"><figcaption>{}{}</figcaption></figure>",
                text(file),
                BASE64.encode(svg.as_bytes()),
                text(file),
                text(&about)
            );
        }
        content.push_str("</section>");
    }

    fn table(&self, content: &mut String, judged: Judged, title: &str, open: bool) {
        let rows: Vec<&Compared> = self
            .compared
            .iter()
            .filter(|row| row.judged == judged)
            .collect();
        if rows.is_empty() {
            return;
        }
        let _ = write!(
            content,
            "<section class=\"table\"><details{}><summary><h2>{title}</h2> <span class=\"muted\">{}</span></summary>\
             <div class=\"scroll\"><table class=\"claims\"><thead><tr><th scope=\"col\">what</th><th scope=\"col\">reference</th>\
             <th scope=\"col\">linkdyn</th><th scope=\"col\">difference</th><th scope=\"col\">verdict</th></tr></thead><tbody>",
            if open { " open" } else { "" },
            rows.len()
        );
        for row in rows {
            let _ = write!(
                content,
                "<tr><td>{}{}</td><td data-of=\"reference\">{}</td><td data-of=\"linkdyn\">{}</td><td data-of=\"difference\">{}</td>\
                 <td class=\"verdict {}\">{}</td></tr>",
                text(row.what),
                row.reason.map_or(String::new(), |reason| format!(
                    "<p class=\"reason\">{}</p>",
                    text(reason)
                )),
                text(row.reference),
                text(row.ours),
                text(row.difference),
                judged.class(),
                judged.word()
            );
        }
        content.push_str("</tbody></table></div></details></section>");
    }

    /// The words of the case, headings as headings.
    fn words(&self, content: &mut String) {
        if self.text.trim().is_empty() {
            return;
        }
        content.push_str("<section class=\"table\" id=\"detail\"><h2>In detail</h2>");
        for (index, part) in format!("\n{}", self.text).split("\n## ").enumerate() {
            let (heading, body) = match part.split_once('\n') {
                Some((heading, body)) if index > 0 => (heading, body),
                Some(_) | None => ("", part),
            };
            if !heading.is_empty() {
                let _ = write!(content, "<h3>{}</h3>", text(heading));
            }
            if !body.trim().is_empty() {
                let _ = write!(content, "<pre>{}</pre>", text(body.trim_matches('\n')));
            }
        }
        content.push_str("</section>");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_come_first_and_names_are_text() {
        let row = |what, judged| Compared {
            what,
            reference: "1",
            ours: "2",
            difference: "<1",
            judged,
            reason: (judged == Judged::Finding).then_some("It is <open>."),
        };
        let page = CasePage {
            name: "a <b>",
            text: "First.\n## Table\n 1 < 2\nf.svg  all values\n",
            compared: vec![row("same", Judged::Agrees), row("other", Judged::Finding)],
            figures: vec![Figure {
                file: "f.svg".into(),
                svg: "<svg/>".into(),
            }],
            ..CasePage::default()
        };
        let html = page.html();
        let at = |words: &str| {
            html.find(words)
                .unwrap_or_else(|| panic!("{words}: {html}"))
        };
        assert!(at("What differs, and why") < at("What agrees"));
        assert!(at("<h3>Table</h3><pre> 1 &lt; 2") > at("<pre>First.</pre>"));
        at("a &lt;b&gt;");
        at("other<p class=\"reason\">It is &lt;open&gt;.</p>");
        at("f.svg: all values</figcaption>");
        at("1 of 2 comparisons agree, 1 differs for a reason that is explained.");
        assert!(!html.contains("<b>") && !html.contains("<script"));
    }
}
