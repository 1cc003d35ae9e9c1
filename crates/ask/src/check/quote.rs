//! The line of a file that a complaint is about.

use linkdyn_model::error::Place;
use linkdyn_picture::diagnosis::Quote;

/// Characters that are shown before the place, of it, and after it.
const BEFORE: usize = 32;
const AT: usize = 40;
const AFTER: usize = 40;

/// The line, with the word, number or text at the place apart.
pub fn quote(file: &[u8], place: Place) -> Option<Quote> {
    let text = String::from_utf8_lossy(file);
    let line: Vec<char> = text
        .lines()
        .nth(place.line.checked_sub(1)?)?
        .chars()
        .collect();
    let (before, rest) = line.split_at_checked(place.column.checked_sub(1)?)?;
    let (at, after) = rest.split_at(length(rest));
    let written: String = before.iter().collect();
    let written: Vec<char> = written.trim_start().chars().collect();
    let hidden = written.len().saturating_sub(BEFORE);
    let ellipsis = if hidden > 0 { "…" } else { "" };
    let before = written[hidden..].iter().collect::<String>();
    Some(Quote {
        line: place.line,
        parts: [
            ellipsis.to_string() + &before,
            cut(at, AT),
            cut(after, AFTER),
        ],
    })
}

/// How many characters belong together.
fn length(rest: &[char]) -> usize {
    match rest {
        ['"', inside @ ..] => {
            let mut is_escaped = false;
            let end = inside.iter().position(|c| {
                let ends = *c == '"' && !is_escaped;
                is_escaped = *c == '\\' && !is_escaped;
                ends
            });
            end.map_or(rest.len(), |end| end + 2)
        }
        _ => {
            let word = |c: &&char| c.is_alphanumeric() || ['-', '+', '.', '_'].contains(*c);
            rest.iter().take_while(word).count().max(1).min(rest.len())
        }
    }
}

fn cut(text: &[char], most: usize) -> String {
    let shown = text.iter().take(most).collect::<String>();
    shown + if text.len() > most { "…" } else { "" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_word_at_the_place_stands_apart() {
        let file = "{\n  \"é\": { \"mas\": 12, \"b\": -1.5e3 },\n  [\n".as_bytes();
        let parts = |line, column| quote(file, Place { line, column }).map(|quote| quote.parts);
        let of = |parts: [&str; 3]| Some(parts.map(str::to_owned));
        assert_eq!(
            parts(2, 10),
            of(["\"é\": { ", "\"mas\"", ": 12, \"b\": -1.5e3 },"])
        );
        assert_eq!(
            parts(2, 26),
            of(["\"é\": { \"mas\": 12, \"b\": ", "-1.5e3", " },"])
        );
        assert_eq!(parts(3, 3), of(["", "[", ""]));
        assert_eq!(parts(3, 4), of(["[", "", ""]));
        assert_eq!((parts(3, 9), parts(9, 1)), (None, None));
    }
}
