//! The page.

use serde_json::{Value, json};

use super::parts::{Played, StudyPage, Variable};
use super::values::Values;
use crate::accuracy_page::Unit;
use crate::html::{self, Live, escaped};
use crate::mechanism::Drawing;
use crate::palette;
use crate::shape::Shape;

const BODY: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
/// In the order in which they build on each other.
pub const SCRIPTS: &[&str] = &[
    include_str!("js/data.js"),
    include_str!("js/choice.js"),
    html::PLAYER,
    html::PLACES,
    html::DRAWING,
    include_str!("js/frame.js"),
    include_str!("js/heat.js"),
    include_str!("js/cards.js"),
    include_str!("js/matrix.js"),
    include_str!("js/parallel.js"),
    include_str!("js/table.js"),
    include_str!("js/motion.js"),
    include_str!("js/head.js"),
];
/// Most reasons that have a name of their own.
const MOST_REASONS: usize = 100;
/// Shapes and drawings of more text than this are left out.
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
        let (why, [shape, drawing], played) = self.motions(&mut values);
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
            "drawing": drawing,
            "played": played,
            "not_played": why,
            "bytes": 4,
            "palette": palette::to_json(),
        });
        Live {
            title: "linkdyn study",
            style: STYLE,
            body: BODY,
            scripts: SCRIPTS,
            data: &escaped(&data.to_string()),
            values: &values.text(),
        }
        .html()
    }

    /// Why there is none, the mechanism and its drawing, and what of the motions the page must know.
    fn motions(&self, values: &mut Values) -> (Option<&str>, [Value; 2], Value) {
        let none = |why: &'static str| {
            let nothing = [Shape::default().to_json(), Drawing::empty().0];
            (Some(why), nothing, Value::Null)
        };
        let motions = match &self.played {
            Played::None(why) => return none(why),
            Played::Motions(motions) => motions,
        };
        let Some(first) = motions.first() else {
            return none("No variant has a motion that could be shown here.");
        };
        let mechanism = first.drawn();
        if mechanism
            .iter()
            .map(|json| json.to_string().len())
            .sum::<usize>()
            > LARGEST_SHAPE
        {
            return none("The model is too large to be drawn here.");
        }
        let played = values.motions(motions);
        (None, mechanism, played)
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
