//! The path of a point: the model whose motion gives it, and its nodes.

use linkdyn_engine::analysis::Prepared;
use linkdyn_model::error::Complaints;
use linkdyn_model::{Given, Loaded, Source, Substituted, Substitution};
use linkdyn_optimise::curve::Node;
use linkdyn_output::Trajectory;

/// A model whose motion gives the path.
pub struct Path {
    source: Source,
    /// `None` if its file must be read for each variant.
    pub substitution: Option<Substitution>,
    names: Vec<String>,
}

impl Path {
    /// Of a model with the analysis of a path.
    pub fn new(loaded: &Loaded, names: &[&str]) -> Self {
        let (source, model) = (&loaded.source, &loaded.model);
        Path {
            source: source.clone(),
            substitution: Substitution::new(
                source,
                model,
                &loaded.parameters,
                names,
                Given::Values,
            ),
            names: names.iter().map(|name| (*name).to_owned()).collect(),
        }
    }

    /// The variant with values, ready to run.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn prepared(
        &self,
        x: &[f64],
        place: Option<&mut Substituted>,
    ) -> Result<Prepared, Complaints> {
        let put = self.substitution.as_ref().zip(place);
        if let Some(model) = put.and_then(|(substitution, place)| substitution.put(x, place)) {
            return Prepared::new(model);
        }
        let names = self.names.iter().map(String::as_str);
        let values: Vec<(&str, f64)> = names.zip(x.iter().copied()).collect();
        Prepared::new(&self.source.with_parameters(&values)?)
    }
}

/// The path of a point over time.
pub fn nodes(rows: &Trajectory, point: &str) -> Option<Vec<Node>> {
    let column = |name: &str| rows.column_index(name);
    let of = |word: &str| column(&format!("{point}.{word}"));
    let time = column(linkdyn_output::TIME)?;
    let all = ["x", "y", "vx", "vy", "ax", "ay"].map(of);
    let [Some(x), Some(y), Some(vx), Some(vy), Some(ax), Some(ay)] = all else {
        return None;
    };
    let node = |row: &[f64]| Node {
        s: row[time],
        p: [row[x], row[y]],
        d: [row[vx], row[vy]],
        dd: [row[ax], row[ay]],
    };
    let nodes: Vec<Node> = rows.rows().map(node).collect();
    let is_whole = nodes
        .iter()
        .all(|node| node.p.iter().chain(&node.dd).all(|own| own.is_finite()));
    is_whole.then_some(nodes)
}
