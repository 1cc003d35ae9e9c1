//! A page as one file: one frame for all pages, data that can't act, and a policy that lets nothing else act.

use std::fmt::Write as _;

use data_encoding::BASE64;
use sha2::{Digest, Sha256};

use super::palette;

pub(crate) use super::svg::escape as text;

const FRAME: &str = include_str!("page/frame.html");
const HEAD: &str = include_str!("page/head.html");
const LIVE: &str = include_str!("page/live.html");
pub const STYLE: &str = include_str!("page/page.css");
/// What all scripts of pages build on, in their order.
const SHARED: [&str; 7] = [
    include_str!("page/js/embedded.js"),
    include_str!("page/js/theme.js"),
    include_str!("page/js/units.js"),
    include_str!("page/js/page.js"),
    include_str!("page/js/axes.js"),
    include_str!("page/js/marks.js"),
    include_str!("page/js/tables.js"),
];
/// Where bodies and points are: after the data of a page.
pub const PLACES: &str = include_str!("page/js/places.js");
/// The instant that is shown; its time and rows may change.
pub const PLAYER: &str = include_str!("page/js/player.js");
/// The mechanism on a canvas.
pub const DRAWING: &str = include_str!("page/js/drawing.js");
const PLOT_STYLE: &str = include_str!("page/vendor/uPlot.min.css");
const PLOT_LIBRARY: &str = include_str!("page/vendor/uPlot.iife.min.js");
/// Its licence asks to stand in every copy.
const LICENCE: &str = include_str!("page/vendor/uPlot.LICENSE");

/// A page of text and pictures.
#[derive(Debug)]
pub struct Page<'a> {
    /// What its tab says, as plain text.
    pub title: &'a str,
    /// Its rules, in order; they may use the colours of the palette by name.
    pub styles: &'a [&'a str],
    /// What stands in it, as HTML.
    pub body: &'a str,
}

/// A page with data, and scripts that show them. It has the head, the rules and the scripts of all such pages, and its own after them.
/// Plots are drawn by uPlot.
#[derive(Debug)]
pub struct Live<'a> {
    /// What its tab says until the script knows better, as plain text.
    pub title: &'a str,
    /// Its own rules.
    pub style: &'a str,
    /// What stands below the head, as HTML.
    pub body: &'a str,
    /// Its own scripts, in the order in which they build on each other.
    pub scripts: &'a [&'a str],
    /// Words and numbers as JSON, made safe by [`escaped`].
    pub data: &'a str,
    /// Many numbers in base64.
    pub values: &'a str,
}

impl Page<'_> {
    /// The page as the text of a file, which needs nothing else.
    pub fn html(&self) -> String {
        let [before, after] = frame(self.title, self.styles, &[]);
        [&before, self.body, &after].concat()
    }
}

impl Live<'_> {
    /// The page as the text of a file, which needs nothing else.
    pub fn html(&self) -> String {
        let [before, between, after] = self.around();
        [&before, self.data, &between, self.values, &after].concat()
    }

    /// The text before the data, between these and the values, and after them: for whoever writes what is too much to stand in
    /// memory several times.
    pub fn around(&self) -> [String; 3] {
        let script = [&SHARED, self.scripts].concat().concat();
        let parts = [
            ("licence", LICENCE),
            ("plot_library", PLOT_LIBRARY),
            ("script", &script),
        ];
        let (open, rest) = halves(LIVE, "{{data}}");
        let (between, close) = halves(rest, "{{values}}");
        let [open, between, close] = [open, between, close].map(|piece| fill(piece, &parts));
        let styles = [PLOT_STYLE, STYLE, self.style];
        let [before, after] = frame(self.title, &styles, &[PLOT_LIBRARY, &script]);
        let head = [HEAD, self.body, "<footer id=\"foot\"></footer>\n"].concat();
        [
            [before, head, open].concat(),
            between,
            [close, after].concat(),
        ]
    }
}

/// A page with a script that talks with the server that it comes from, and with the pages of that server in its frames.
pub fn talking(title: &str, style: &str, body: &str, script: &str) -> String {
    let [before, after] = frame(title, &[style], &[script]);
    let allowed = "default-src 'none'; connect-src 'self'; frame-src 'self'";
    let before = before.replacen("default-src 'none'", allowed, 1);
    [&before, body, "<script>", script, "</script>\n", &after].concat()
}

/// What stands before the body of a page, and what after it.
fn frame(title: &str, styles: &[&str], scripts: &[&str]) -> [String; 2] {
    let style = [&[palette::style_sheet().as_str()], styles]
        .concat()
        .join("\n");
    let (before, after) = halves(FRAME, "{{body}}");
    let (policy, title) = (policy(scripts, &style), text(title));
    let parts = [("policy", &*policy), ("title", &title), ("style", &style)];
    [before, after].map(|piece| fill(piece, &parts))
}

/// What stands before a word of a template, and what after it.
fn halves<'t>(template: &'t str, word: &str) -> (&'t str, &'t str) {
    template.split_once(word).unwrap_or((template, ""))
}

/// A template with its `{{words}}` replaced, in one pass: what is put in is not looked at again.
fn fill(template: &str, parts: &[(&str, &str)]) -> String {
    let room: usize = parts.iter().map(|(_, part)| part.len()).sum();
    let mut text = String::with_capacity(template.len() + room);
    for (index, piece) in template.split("{{").enumerate() {
        let (word, rest) = match piece.split_once("}}") {
            Some(found) if index > 0 => found,
            Some(_) | None => ("", piece),
        };
        let part = parts.iter().find(|(name, _)| *name == word);
        text.extend(part.map(|(_, part)| *part));
        text.push_str(rest);
    }
    text
}

/// Only these scripts, this style and pictures that stand in the page; no network, no forms, no frames.
fn policy(scripts: &[&str], style: &str) -> String {
    let hash = |text: &str| {
        format!(
            "'sha256-{}'",
            BASE64.encode(&Sha256::digest(text.as_bytes()))
        )
    };
    let mut scripts: Vec<String> = scripts.iter().map(|script| hash(script)).collect();
    if scripts.is_empty() {
        scripts.push("'none'".into());
    }
    format!(
        "default-src 'none'; script-src {}; style-src {}; img-src data:; base-uri 'none'; form-action 'none'",
        scripts.join(" "),
        hash(style)
    )
}

/// JSON that can stand in a script element: no tag, comment or line separator in it can end or change anything.
pub fn escaped(json: &str) -> String {
    let mut text = String::with_capacity(json.len() + json.len() / 16);
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                // Writing to a String can't fail.
                let _ = write!(text, "\\u{:04x}", c as u32);
            }
            _ => text.push(c),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn can_stand_in_a_page(text: &str) -> bool {
        let text = text.to_lowercase();
        !text.contains("</script") && !text.contains("<!--") && !text.contains("</style")
    }

    #[test]
    fn what_is_put_in_is_not_looked_at_again() {
        let page = fill("<p>{{a}}</p>{{b}}", &[("a", "{{b}}"), ("b", "x }} y")]);
        assert_eq!(page, "<p>{{b}}</p>x }} y");
    }

    #[test]
    fn names_are_text() {
        assert_eq!(
            text("<b title=\"x\">&'</b>"),
            "&lt;b title=&quot;x&quot;&gt;&amp;&#39;&lt;/b&gt;"
        );
    }

    #[test]
    fn a_page_without_scripts_allows_none() {
        let page = Page {
            title: "<script>",
            styles: &["p { margin: 0; }"],
            body: "<p>{{data}}</p>\n",
        }
        .html();
        assert!(page.contains("script-src 'none'; style-src 'sha256-"));
        assert!(page.contains("<title>&lt;script&gt;</title>") && !page.contains("<script"));
        assert!(page.contains("<body>\n<p>{{data}}</p>\n</body>"));
    }

    #[test]
    fn a_live_page_holds_its_parts_and_allows_two_scripts() {
        let page = Live {
            title: "t",
            style: "",
            body: "<p>{{values}}</p>\n",
            data: "{\"a\":\"{{script}}\"}",
            values: "AAAA",
            scripts: &["acts();"],
        }
        .html();
        assert!(page.contains("id=\"data\">{\"a\":\"{{script}}\"}</script>"));
        assert!(page.contains("id=\"values\">AAAA</script>") && page.contains(LICENCE));
        let (_, rest) = page.split_once("script-src ").expect("a policy");
        let (sources, _) = rest.split_once(';').expect("an end");
        assert_eq!(sources.matches("'sha256-").count(), 2, "{sources}");
        for word in ["policy", "title", "style", "body", "licence"] {
            assert!(!page.contains(&format!("{{{{{word}}}}}")), "{word}");
        }
    }

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
    fn scripts_and_rules_can_stand_in_a_page() {
        let shared = SHARED.iter().chain(&[PLACES, PLAYER, DRAWING]);
        let own = crate::report::SCRIPTS
            .iter()
            .chain(crate::study_page::SCRIPTS);
        let own = own
            .chain(crate::accuracy_page::SCRIPTS)
            .chain(crate::compare_page::SCRIPTS)
            .chain(crate::optimise_page::SCRIPTS)
            .chain(crate::watch_page::SCRIPTS);
        let rules = [PLOT_LIBRARY, PLOT_STYLE, STYLE];
        for text in shared.chain(own).chain(&rules) {
            assert!(can_stand_in_a_page(text), "{text:.200}");
        }
        assert!(
            !LICENCE.contains("--"),
            "it would end the comment it stands in"
        );
    }
}
