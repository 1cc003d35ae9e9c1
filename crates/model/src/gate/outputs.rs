//! Outputs: names that no body's columns have, and texts that name two things that move.

use super::Rules;
use crate::error::Complaint;
use crate::ratio::OutputText;
use crate::response::Catalogue;

/// All rules of outputs.
pub(super) fn outputs(rules: &mut Rules<'_>) {
    let model = rules.model;
    if model.outputs.is_empty() {
        return;
    }
    let catalogue = Catalogue::of(model);
    // a name that is faulty elsewhere is not blamed once more
    let is_whole = rules.complaints.is_empty() && rules.holes.is_empty();
    for (name, text) in &model.outputs {
        let path = format!("outputs.{name}");
        if rules.holes.has(&path) {
            continue;
        }
        if Catalogue::is_of_bodies(name) {
            let message = format!("output.{name} would be a column of a body called \"output\"");
            rules.complain(path, message, "give the output another name");
            continue;
        }
        if let Err(complaint) = OutputText::read(text, &catalogue)
            && is_whole
        {
            rules.complaints.push(Complaint { path, ..complaint });
        }
    }
}
