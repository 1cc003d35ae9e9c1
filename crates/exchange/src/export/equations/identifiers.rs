//! Identifiers of a program, from names that may hold anything.

use std::collections::HashSet;

/// Identifiers that are taken.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Identifiers(HashSet<String>);

/// Letters, digits and `_` of a name, as they are in an identifier: other characters stand as `_`.
pub fn legal(name: &str) -> String {
    let legal = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let text: String = name.chars().map(legal).collect();
    text.trim_matches('_').to_owned()
}

impl Identifiers {
    /// With those of the text itself.
    pub fn with(reserved: &[&str]) -> Self {
        Identifiers(reserved.iter().map(|&name| name.to_owned()).collect())
    }

    /// A new identifier from this wish, which begins with a letter.
    pub fn take(&mut self, wish: &str) -> String {
        let numbered = (2..).map(|k| format!("{wish}_{k}"));
        let mut wishes = std::iter::once(wish.to_owned()).chain(numbered);
        let free = wishes.find(|wish| !self.0.contains(wish));
        let free = free.unwrap_or_default();
        self.0.insert(free.clone());
        free
    }

    /// A new constant of these words, `ROD_A_B`; the first may begin with anything.
    pub fn constant(&mut self, words: &[&str]) -> String {
        let words: Vec<String> = words.iter().map(|word| legal(word)).collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let joined = words.join("_").to_ascii_uppercase();
        let joined = joined.trim_matches('_');
        match joined.chars().next() {
            Some(first) if first.is_ascii_alphabetic() => self.take(joined),
            _ => self.take(format!("N_{joined}").trim_end_matches('_')),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_legal_and_new() {
        let mut taken = Identifiers::with(&["START"]);
        assert_eq!(taken.constant(&["lambda", "mass"]), "LAMBDA_MASS");
        assert_eq!(taken.constant(&["1a", "mass"]), "N_1A_MASS");
        assert_eq!(taken.constant(&["ä_b", "mass"]), "B_MASS");
        assert_eq!(taken.constant(&["b", "mass"]), "B_MASS_2");
        assert_eq!(taken.constant(&["曲柄"]), "N");
        assert_eq!(taken.constant(&["start"]), "START_2");
        assert_eq!(taken.take("phi_class"), "phi_class");
    }
}
