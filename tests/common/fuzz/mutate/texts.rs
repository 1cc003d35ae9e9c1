//! Mutants of tokens and bytes.

use super::*;

/// Tokens deleted, inserted, doubled or exchanged.
pub fn tokens(rng: &mut Rng, model: &str) -> Vec<u8> {
    let mut tokens = split(model);
    for _ in 0..=rng.below(3) {
        if tokens.is_empty() {
            break;
        }
        let (here, there) = (rng.below(tokens.len()), rng.below(tokens.len()));
        match rng.below(5) {
            0 => drop(tokens.remove(here)),
            1 => tokens.swap(here, there),
            2 => tokens[here] = tokens[there].clone(),
            3 => tokens.insert(here, tokens[there].clone()),
            _ => {
                let odd = [
                    "{",
                    "}",
                    "[",
                    "]",
                    ",",
                    ":",
                    "null",
                    "true",
                    "NaN",
                    "1e999",
                    "-",
                    "01",
                    "//",
                    "'a'",
                    "\"\\u0000\"",
                    "\"\\ud800\"",
                    "0x10",
                    "1.",
                    "+1",
                    "\"x\"",
                ];
                tokens[here] = odd[rng.below(odd.len())].to_string();
            }
        }
    }
    tokens.concat().into_bytes()
}

/// Texts, numbers and words, marks, blanks.
fn split(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        let mut token = String::from(c);
        if c == '"' {
            let mut escaped = false;
            for c in chars.by_ref() {
                token.push(c);
                if c == '"' && !escaped {
                    break;
                }
                escaped = c == '\\' && !escaped;
            }
        } else if c.is_alphanumeric() || c == '-' {
            while let Some(c) = chars.next_if(|c| c.is_alphanumeric() || "+-.".contains(*c)) {
                token.push(c);
            }
        }
        tokens.push(token);
    }
    tokens
}
