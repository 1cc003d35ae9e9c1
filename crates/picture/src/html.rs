//! A page as one file: a template with its parts put in, and a policy that lets nothing else act.

use sha2::{Digest, Sha256};

use super::report::base64;

/// A template with its `{{words}}` replaced, in one pass: what is put in is not looked at again.
pub fn fill(template: &str, parts: &[(&str, &str)]) -> String {
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
pub fn policy(scripts: &[&str], style: &str) -> String {
    let hash = |text: &str| format!("'sha256-{}'", base64(&Sha256::digest(text.as_bytes())));
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

/// Text that can stand between tags and in attributes.
pub fn text(plain: &str) -> String {
    let mut safe = String::with_capacity(plain.len());
    for c in plain.chars() {
        match c {
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '&' => safe.push_str("&amp;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            _ => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert!(policy(&[], "").contains("script-src 'none'; style-src"));
    }
}
