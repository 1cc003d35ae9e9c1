//! The page of a study.

use linkdyn_engine::analysis::Control;
use linkdyn_picture::StudyPage;
use linkdyn_picture::accuracy_page::Unit;
use linkdyn_picture::study_page::{Played, Variable};
use serde_json::json;

use super::display::Named;
use super::head::Asked;
use super::inputs::Column;
use super::{Studied, Variants};

impl Studied {
    /// The page. Variants that are at hand are run again, and move in it.
    pub fn html(&self, again: Option<(&Variants, &Control)>) -> String {
        let (head, display) = (&self.head, &self.display);
        let shown = |named: &Named| Unit {
            symbol: named.0.clone(),
            size: named.1,
        };
        let input = |own: &Column| Variable {
            name: own.name.clone(),
            unit: own.unit.clone(),
            shown: None,
            facts: json!(own.how),
        };
        let response = |own: &Asked| Variable {
            name: own.name.clone(),
            unit: own.unit.clone(),
            shown: display.responses.get(&own.name).map(shown),
            facts: json!({ "value": own.value, "limits": own.limits }),
        };
        let played = match again {
            Some((variants, control)) => variants.motions(&self.rows, control),
            None => Played::None(
                "No variant can be played: the chunks were joined without the model. The command of the study, given again, writes a page with motions.",
            ),
        };
        StudyPage {
            model: &head.model.name,
            method: head.method_words(),
            variants: head.variants,
            units: [shown(&display.length), shown(&display.angle)],
            inputs: head.inputs.iter().map(input).collect(),
            responses: head.responses.iter().map(response).collect(),
            summary: &json!(self.totals),
            rows: self.rows.clone(),
            played,
        }
        .html()
    }
}
