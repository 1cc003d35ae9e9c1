//! Numbers that stand in the text of a file, and other numbers in their places.

use super::node::{Kind, Node, Origin};
use super::source::Source;
use super::units::{Unit, split_quantity};

/// A number in the text, plain or before a unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Literal {
    /// Its first byte, and how many it has.
    at: usize,
    length: usize,
    /// Digits behind its point.
    decimals: usize,
    /// Size of its unit \[SI\].
    size: f64,
}

impl Literal {
    /// That of a node, where it is one; `plain` is the size of the unit of a plain number.
    pub(super) fn of(source: &Source, node: &Node, plain: f64) -> Option<Self> {
        let Origin::Text(start, end) = node.origin else {
            return None;
        };
        let text = source.text().get(start..end)?;
        let (number, unit) = match &node.kind {
            Kind::Number(_) => (text, ""),
            Kind::String(_) => split_quantity(text.get(1..text.len().saturating_sub(1))?)?,
            Kind::Null | Kind::Bool(_) | Kind::Array(_) | Kind::Object(_) => return None,
        };
        let size = match unit {
            "" => plain,
            unit => Unit::parse(unit).ok()?.to_si("1"),
        };
        let decimals = number.split_once('.').map_or(0, |(_, fraction)| {
            fraction.bytes().take_while(u8::is_ascii_digit).count()
        });
        Some(Literal {
            at: text.find(number)? + start,
            length: number.len(),
            decimals,
            size,
        })
    }

    /// A value \[SI\] as it would be written here: to a grain \[SI\], or as finely as what is there.
    pub fn written(&self, value: f64, grain: f64) -> String {
        let fine = (self.size / grain).log10().ceil();
        let decimals = (fine.clamp(0.0, 12.0) as usize).max(self.decimals);
        let text = format!("{:.decimals$}", value / self.size);
        let text = match text.split_once('.') {
            Some(_) => text.trim_end_matches('0').trim_end_matches('.'),
            None => &text,
        };
        if text == "-0" { "0" } else { text }.to_owned()
    }
}

impl Source {
    /// The number at a path such as `bodies.crank.points.A[0]`; `plain` is the size of the unit of a plain number \[SI\].
    pub fn literal(&self, path: &str, plain: f64) -> Option<Literal> {
        let (node, _, exact) = self.find(path);
        exact.then(|| Literal::of(self, node, plain)).flatten()
    }

    /// The text with others in the place of some numbers; every other byte stays.
    pub fn replaced(&self, mut edits: Vec<(Literal, String)>) -> String {
        edits.sort_by_key(|(literal, _)| literal.at);
        let mut text = self.text().to_owned();
        for (literal, number) in edits.into_iter().rev() {
            text.replace_range(literal.at..literal.at + literal.length, &number);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    const FILE: &str = r#"{ "format": "linkdyn/1", "units": { "length": "mm" }, "bodies": { "a":{"points": { "P" : [ 10,"2.50 in"] ,
        "Q": { "position": [1e1 , "=3 mm"] } } } } }"#;

    #[test]
    fn numbers_are_replaced_in_their_own_style() {
        let loaded = crate::load(FILE.as_bytes(), &[]).expect("legal");
        let literal = |path: &str| loaded.source.literal(path, 1e-3);
        let [x, y, q] = ["P[0]", "P[1]", "Q.position[0]"]
            .map(|end| literal(&format!("bodies.a.points.{end}")).expect("a number"));
        assert_eq!(literal("bodies.a.points.Q.position[1]"), None);
        assert_eq!(x.written(0.012_34, 1e-3), "12");
        assert_eq!(x.written(0.012_34, 1e-5), "12.34");
        assert_eq!(y.written(0.0254, 1e-3), "1");
        assert_eq!(y.written(0.025, 1e-3), "0.98");
        assert_eq!(q.written(-1e-9, 1e-5), "0");
        let text = loaded.source.replaced(vec![
            (y, "0.9".into()),
            (x, "-7.5".into()),
            (q, "11".into()),
        ]);
        let expected = FILE
            .replace("10,", "-7.5,")
            .replace("2.50", "0.9")
            .replace("1e1", "11");
        assert_eq!(text, expected);
    }
}
