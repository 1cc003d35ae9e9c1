//! Lines of a program: sums, lists, and where they are broken.

use serde_json::json;

/// Characters of a line, at most.
const WIDTH: usize = 100;

/// Signed products.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SignedSum(pub Vec<(f64, String)>);

/// A number as Python reads it back: the same one.
pub fn number(value: f64) -> String {
    // −0 becomes 0.
    format!("{:?}", value + 0.0)
}

/// A text as Python writes it.
pub fn quoted(text: &str) -> String {
    json!(text).to_string()
}

/// A text for a comment: on one line, and no end of a text.
pub fn plain(text: &str) -> String {
    let plain = |c: char| match c {
        '"' => '\'',
        '\\' => '/',
        c if c.is_control() => ' ',
        c => c,
    };
    text.chars().map(plain).collect()
}

impl SignedSum {
    /// Adds a product of factors, of which there is one at least.
    pub fn add(&mut self, sign: f64, factors: &[&str]) {
        self.0.push((sign, factors.join(" * ")));
    }

    /// Adds a number times factors; one that is zero adds nothing.
    pub fn add_number(&mut self, value: f64, factors: &[&str]) {
        let size = number(value.abs());
        let all: Vec<&str> = match value.abs() {
            0.0 => return,
            1.0 if !factors.is_empty() => factors.to_vec(),
            _ => [&[size.as_str()], factors].concat(),
        };
        self.add(value.signum(), &all);
    }

    /// On one line.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for (index, (sign, product)) in self.0.iter().enumerate() {
            text += match (index, *sign < 0.0) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            text += product;
        }
        if text.is_empty() {
            text = "0.0".into();
        }
        text
    }

    /// The same as a factor or with something subtracted from it.
    pub fn enclosed(&self) -> String {
        match self.0.as_slice() {
            [] => self.text(),
            [(sign, _)] if *sign > 0.0 => self.text(),
            _ => format!("({})", self.text()),
        }
    }

    /// `before` sum `after`, broken into a line for each product where it is too long.
    pub fn lines(&self, indent: usize, before: &str, after: &str) -> String {
        let pad = " ".repeat(indent);
        let whole = format!("{pad}{before}{}{after}\n", self.text());
        if whole.chars().count() <= WIDTH || self.0.len() < 2 {
            return whole;
        }
        let mut text = format!("{pad}{before}(\n");
        for (index, (sign, product)) in self.0.iter().enumerate() {
            let sign = match (index, *sign < 0.0) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => "+ ",
                (_, true) => "- ",
            };
            text += &format!("{pad}    {sign}{product}\n");
        }
        text + &format!("{pad}){after}\n")
    }
}

/// A list of sums between brackets, a line each where it is too long.
pub fn list(items: &[SignedSum], indent: usize, before: &str, after: &str) -> String {
    let pad = " ".repeat(indent);
    let texts: Vec<String> = items.iter().map(SignedSum::text).collect();
    let whole = format!("{pad}{before}[{}]{after}\n", texts.join(", "));
    if whole.chars().count() <= WIDTH {
        return whole;
    }
    let lines = items.iter().map(|item| item.lines(indent + 4, "", ","));
    let lines: String = lines.collect();
    format!("{pad}{before}[\n{lines}{pad}]{after}\n")
}

/// Numbers in a list.
pub fn numbers(values: impl IntoIterator<Item = f64>) -> Vec<SignedSum> {
    let sum = |value: f64| {
        let mut sum = SignedSum::default();
        sum.add_number(value, &[]);
        sum
    };
    values.into_iter().map(sum).collect()
}

/// Words or numbers as they stand, in a list.
pub fn words(texts: impl IntoIterator<Item = String>) -> Vec<SignedSum> {
    let sum = |text: String| SignedSum(vec![(1.0, text)]);
    texts.into_iter().map(sum).collect()
}
