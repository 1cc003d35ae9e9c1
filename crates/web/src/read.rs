//! What reading a text says.

use linkdyn_ask::run::parameters;
use linkdyn_ask::{ModelFile, Text, Unanswered};
use linkdyn_model::error::{Complaint, Complaints, Place};
use linkdyn_model::{FileAccess, Knob};
use serde::Serialize;
use serde_json::{Value, json};

#[derive(Serialize)]
struct Fault {
    path: String,
    text: String,
    /// UTF-16 units of the text.
    from: usize,
    to: usize,
    line: usize,
    column: usize,
}

/// A model's text, read.
pub fn read(text: &str, name: &str) -> Result<ModelFile, Complaints> {
    let bytes = text.as_bytes().to_vec();
    let text = Text::new(name.into(), name.into(), bytes, FileAccess::default());
    ModelFile::read(text, Vec::new())
}

/// What is right and wrong with a text.
pub fn told(text: &str, read: &Result<ModelFile, Complaints>) -> Value {
    let (faults, file) = match read {
        Ok(file) => (Vec::new(), Some(file)),
        Err(found) => (found.iter().map(|one| fault(text, one)).collect(), None),
    };
    let model = file.map(|file| file.model());
    json!({
        "ok": file.is_some(),
        "faults": faults,
        "warnings": file.map_or(&[][..], |file| &file.loaded.warnings),
        "parameters": file.map_or_else(Vec::<Knob>::new, parameters),
        "name": file.map_or("", |file| file.name()),
        "analysis": model.and_then(|model| Some(model.analysis.as_ref()?.kind)),
        // Sizes of the file's units.
        "length": model.map_or(1.0, |model| model.display.length.size),
        "angle": model.map_or(1.0, |model| model.display.angle.size),
    })
}

/// Lines of why something has no answer, as faults of a text.
pub fn faults(text: &str, why: Unanswered) -> Value {
    let lines = |lines: Vec<String>| {
        let lines = lines.into_iter();
        lines
            .map(|line| json!({ "text": line }))
            .collect::<Vec<_>>()
    };
    match why {
        Unanswered::Model(found) => {
            let found: Vec<Fault> = found.iter().map(|one| fault(text, one)).collect();
            json!({ "faults": found })
        }
        Unanswered::Question(all) => json!({ "faults": lines(all) }),
        Unanswered::Failed(_) | Unanswered::Interrupted | Unanswered::Rows(_) => {
            json!({ "faults": lines(vec![why.to_string()]) })
        }
    }
}

fn fault(text: &str, complaint: &Complaint) -> Fault {
    let Place { line, column } = complaint.place.unwrap_or(Place { line: 1, column: 1 });
    let (from, to) = span(text, line, column);
    Fault {
        path: complaint.path.clone(),
        text: complaint.to_string(),
        from,
        to,
        line,
        column,
    }
}

/// From a line and column, in characters, to the end of what stands there, in UTF-16 units.
fn span(text: &str, line: usize, column: usize) -> (usize, usize) {
    let start: usize = text
        .split_inclusive('\n')
        .take(line - 1)
        .map(str::len)
        .sum();
    let rest = text.get(start..).unwrap_or_default();
    let chars = rest.char_indices().nth(column - 1);
    let at = start + chars.map_or(rest.trim_end_matches(['\r', '\n']).len(), |(at, _)| at);
    let size = |text: &str| text.encode_utf16().count();
    let from = size(&text[..at]);
    (from, from + size(node(&text[at..])))
}

/// A string, a number or word, or the bracket that opens.
fn node(rest: &str) -> &str {
    let mut escaped = false;
    let is_end = |(k, c): &(usize, char)| {
        if rest.starts_with('"') {
            let ends = *k > 0 && *c == '"' && !escaped;
            escaped = *c == '\\' && !escaped;
            ends
        } else {
            *k > 0 && (c.is_whitespace() || ",]}:".contains(*c))
        }
    };
    if rest.starts_with(['{', '[']) {
        return &rest[..1];
    }
    let end = rest.char_indices().find(is_end);
    let end = end.map_or(
        rest.len(),
        |(k, _)| if rest.starts_with('"') { k + 1 } else { k },
    );
    &rest[..end]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_in_units_of_the_page() {
        let text = "{\r\n  \"näme 😀\": \"a\\\"b\", \"x\": 12.5 }";
        let units: Vec<u16> = text.encode_utf16().collect();
        let cut = |from: usize, to: usize| String::from_utf16_lossy(&units[from..to]);
        let (from, to) = span(text, 2, 13);
        assert_eq!(cut(from, to), "\"a\\\"b\"");
        let (from, to) = span(text, 2, 26);
        assert_eq!(cut(from, to), "12.5");
        assert_eq!(span(text, 9, 9), (units.len(), units.len()));
    }
}
