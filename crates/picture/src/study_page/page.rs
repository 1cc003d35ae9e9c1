//! The page.

use data_encoding::BASE64;
use serde_json::{Value, json};

use super::parts::{Played, StudyPage, Variable};
use super::values::Values;
use crate::accuracy_page::Unit;
use crate::html::{Live, Page, escaped};
use crate::palette;
use crate::report;
use crate::scripts;
use crate::shape::Shape;

const BODY: &str = include_str!("page.html");
const OWN_STYLE: &str = include_str!("page.css");
/// In the order in which they build on each other.
const SCRIPT: [&str; 16] = [
    scripts::EMBEDDED,
    scripts::THEME,
    scripts::UNITS,
    include_str!("js/data.js"),
    include_str!("js/choice.js"),
    scripts::SHAPES,
    scripts::SYMBOLS,
    scripts::DRAWING,
    include_str!("js/frame.js"),
    include_str!("js/heat.js"),
    include_str!("js/cards.js"),
    include_str!("js/matrix.js"),
    include_str!("js/parallel.js"),
    include_str!("js/table.js"),
    include_str!("js/motion.js"),
    include_str!("js/head.js"),
];
/// Reasons that are told by name.
const MOST_REASONS: usize = 100;
/// Shapes of more text than this are left out.
const LARGEST_SHAPE: usize = 300_000;

impl StudyPage<'_> {
    /// The page as the text of a file, which needs nothing else.
    pub fn html(&self) -> String {
        let mut reasons: Vec<&str> = Vec::new();
        for reason in self.rows.iter().filter_map(|row| row.reason.as_deref()) {
            if !reasons.contains(&reason) && reasons.len() < MOST_REASONS {
                reasons.push(reason);
            }
        }
        let mut values = Values::default();
        let middles = values.rows(self, &reasons);
        let (why, shape, played) = self.motions(&mut values);
        let (inputs, responses) = middles.split_at(self.inputs.len());
        let [length, angle] = self.units.each_ref().map(unit);
        let data = json!({
            "engine": env!("CARGO_PKG_VERSION"),
            "model": self.model,
            "method": self.method,
            "variants": self.variants,
            "rows": self.rows.len(),
            "units": { "m": length, "rad": angle },
            "inputs": variables(&self.inputs, inputs),
            "responses": variables(&self.responses, responses),
            "reasons": reasons,
            "summary": self.summary,
            "mechanism": shape,
            "played": played,
            "not_played": why,
            "bytes": 4,
            "palette": palette::to_json(),
        });
        Page {
            title: "linkdyn study",
            styles: &[report::STYLE, OWN_STYLE],
            body: BODY,
            live: Some(Live {
                data: &escaped(&data.to_string()),
                values: &BASE64.encode(values.bytes()),
                script: &SCRIPT.concat(),
            }),
        }
        .html()
    }

    /// Why there is none, the mechanism, and what of the motions the page must know.
    fn motions(&self, values: &mut Values) -> (Option<&str>, Value, Value) {
        let none = |why: &'static str| (Some(why), Shape::default().to_json(), Value::Null);
        let motions = match &self.played {
            Played::None(why) => return none(why),
            Played::Motions(motions) => motions,
        };
        let Some(first) = motions.first() else {
            return none("No variant has a motion that could be shown here.");
        };
        let shape = first.shape.to_json();
        if shape.to_string().len() > LARGEST_SHAPE {
            return none("The model is too large to be drawn here.");
        }
        (None, shape, values.motions(motions))
    }
}

fn variables(variables: &[Variable], middles: &[f64]) -> Value {
    let both = variables.iter().zip(middles);
    both.map(|(own, middle)| {
        json!({
            "name": own.name, "unit": own.unit, "shown": own.shown.as_ref().map(unit), "facts": own.facts, "middle": middle,
        })
    })
    .collect()
}

fn unit(unit: &Unit) -> Value {
    json!([unit.symbol, unit.size])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scripts_can_stand_in_a_page() {
        for text in SCRIPT.iter().chain([&OWN_STYLE]) {
            assert!(crate::html::can_stand_in_a_page(text));
        }
    }
}
