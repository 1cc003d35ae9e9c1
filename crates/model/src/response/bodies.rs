//! Names of the columns that bodies have, and elastic links beside: amplitudes, sections at points, nodes of chains.

use crate::dimension::{Dimension, Powers};
use crate::node::{Kind, Node};
use crate::{ElasticLink, Model};

pub(super) const BODY: [(&str, Dimension); 9] = [
    ("x", Dimension::Length),
    ("y", Dimension::Length),
    ("angle", Dimension::Angle),
    ("vx", Dimension::Velocity),
    ("vy", Dimension::Velocity),
    ("omega", Dimension::AngularVelocity),
    ("ax", Dimension::Acceleration),
    ("ay", Dimension::Acceleration),
    ("alpha", Dimension::AngularAcceleration),
];

/// Derivatives of an amplitude, by what stands behind its number.
const ORDERS: [(&str, Dimension); 3] = [
    ("", Dimension::Length),
    ("_rate", Dimension::Velocity),
    ("_acceleration", Dimension::Acceleration),
];

/// An elastic link, as far as columns are named after it. How many amplitudes it has is known when it is compiled.
#[derive(Debug, Clone)]
pub(super) struct ElasticNames {
    body: String,
    points: Vec<String>,
    is_chain: bool,
}

impl ElasticNames {
    /// All of a model.
    pub fn of(model: &Model) -> Vec<Self> {
        let elastic = |(name, body): (&String, &crate::Body)| {
            let link: &ElasticLink = body.elastic.as_deref()?;
            Some(ElasticNames {
                body: name.clone(),
                points: body.points.keys().cloned().collect(),
                is_chain: link.elements.is_some(),
            })
        };
        model.bodies.iter().filter_map(elastic).collect()
    }

    /// Of a body of a file, before it is a model.
    pub fn of_file(name: &str, body: &Node) -> Option<Self> {
        let elastic = body.get("elastic")?;
        let points = match body.get("points").map(|node| &node.kind) {
            Some(Kind::Object(points)) => points.keys().cloned().collect(),
            _ => Vec::new(),
        };
        Some(ElasticNames {
            body: name.to_owned(),
            points,
            is_chain: elastic.get("elements").is_some(),
        })
    }

    /// The dimension of a column that it can have.
    pub fn column(&self, owner: &str, word: &str) -> Option<Powers> {
        let rest = owner.strip_prefix(&self.body)?;
        if rest.is_empty() {
            return self.amplitude(word);
        }
        let part = rest.strip_prefix('.')?;
        let is_part = match self.is_chain {
            true => part.strip_prefix("node").is_some_and(is_number),
            false => part
                .strip_prefix("section_")
                .is_some_and(|point| self.points.iter().any(|own| own == point)),
        };
        of(&BODY, word).filter(|_| is_part)
    }

    /// `q1`, `q1_rate`, `q1_acceleration`.
    fn amplitude(&self, word: &str) -> Option<Powers> {
        let word = word.strip_prefix('q').filter(|_| !self.is_chain)?;
        let digits = word.split('_').next().filter(|text| is_number(text))?;
        of(&ORDERS, &word[digits.len()..])
    }

    /// Names that a slip of the pen may have meant.
    pub fn names(&self) -> Vec<String> {
        let body = &self.body;
        if self.is_chain {
            return BODY.map(|row| format!("{body}.node1.{}", row.0)).into();
        }
        let amplitudes = (1..=2).flat_map(|k| ORDERS.map(|row| format!("{body}.q{k}{}", row.0)));
        let of = |point: &String| BODY.map(|row| format!("{body}.section_{point}.{}", row.0));
        amplitudes.chain(self.points.iter().flat_map(of)).collect()
    }
}

/// The dimension of a word of a table.
pub(super) fn of(table: &[(&str, Dimension)], word: &str) -> Option<Powers> {
    let row = table.iter().find(|row| row.0 == word)?;
    Some(row.1.powers())
}

/// Whether it counts something from 1.
fn is_number(text: &str) -> bool {
    let digits = text.bytes().all(|byte| byte.is_ascii_digit());
    digits && !text.is_empty() && !text.starts_with('0')
}
