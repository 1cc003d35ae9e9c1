//! The page over all cases.

use std::fmt::Write as _;

use super::frame::page;
use super::words::{Counts, Judged, MEANINGS};
use crate::html::text;

/// What the page is made of.
#[derive(Debug, Clone, Default)]
pub struct IndexPage {
    /// The cases that were run.
    pub cases: Vec<IndexRow>,
}

/// A case.
#[derive(Debug, Clone)]
pub struct IndexRow {
    /// Its name, which is that of its folder.
    pub name: String,
    /// A line about it.
    pub about: String,
    /// How its comparisons ended, or why it can't be run.
    pub ended: Result<Counts, String>,
}

impl IndexPage {
    /// The page as the text of a file, which needs nothing else.
    pub fn html(&self) -> String {
        let counts = self
            .cases
            .iter()
            .filter_map(|case| case.ended.as_ref().ok());
        let sum = Counts::sum(counts.copied());
        let broken = self.cases.iter().filter(|case| case.ended.is_err()).count();
        let (class, more) = match broken {
            0 => (sum.class(), String::new()),
            1 => ("bad", " 1 case can't be run.".to_string()),
            _ => ("bad", format!(" {broken} cases can't be run.")),
        };
        let mut content = String::new();
        // Writing to a String can't fail.
        let _ = write!(
            content,
            "<header id=\"head\"><h1>Validation</h1><p>linkdyn beside answers that are not its own.</p>\
             <p class=\"sentence {}\">{}{more}</p><p class=\"muted\">{MEANINGS}</p></header>\
             <main><section class=\"table\"><div class=\"scroll\"><table id=\"cases\"><thead><tr><th scope=\"col\">case</th>\
             <th scope=\"col\" class=\"wide\">what is compared</th><th scope=\"col\" class=\"number\">agree</th>\
             <th scope=\"col\" class=\"number\">explained</th><th scope=\"col\" class=\"number\">errors</th></tr></thead><tbody>",
            class,
            sum.sentence()
        );
        for case in &self.cases {
            row(&mut content, case);
        }
        content.push_str("</tbody></table></div></section></main>");
        page("all cases", &content)
    }
}

fn row(content: &mut String, case: &IndexRow) {
    let IndexRow { name, about, ended } = case;
    let number = |count: usize, judged: Judged| match count {
        0 => "<td class=\"number muted\">–</td>".to_string(),
        _ => format!("<td class=\"number {}\">{count}</td>", judged.class()),
    };
    let _ = match ended {
        Ok(counts) => write!(
            content,
            "<tr><td><a href=\"{0}/report.html\">{0}</a></td><td class=\"wide\">{1}</td>{2}{3}{4}</tr>",
            text(name),
            text(about),
            number(counts.agreed, Judged::Agrees),
            number(counts.findings, Judged::Finding),
            number(counts.faults, Judged::Fault)
        ),
        Err(why) => write!(
            content,
            "<tr><td>{}</td><td colspan=\"4\" class=\"bad\">The case can't be run: {}</td></tr>",
            text(name),
            text(why)
        ),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_summed_and_linked() {
        let case = |name: &str, ended| IndexRow {
            name: name.into(),
            about: "<about>".into(),
            ended,
        };
        let counts = Counts {
            agreed: 3,
            findings: 1,
            faults: 0,
        };
        let mut page = IndexPage {
            cases: vec![case("lock", Ok(counts)), case("crank", Ok(counts))],
        };
        let html = page.html();
        assert!(
            html.contains("6 of 8 comparisons agree, 2 differ for reasons that are explained.")
        );
        assert!(html.contains("href=\"lock/report.html\"") && html.contains("&lt;about&gt;"));
        page.cases.push(case("torn", Err("no file".into())));
        let html = page.html();
        assert!(html.contains("sentence bad") && html.contains("1 case can't be run."));
    }
}
