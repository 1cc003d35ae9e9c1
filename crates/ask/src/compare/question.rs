//! Which joints and which clearance models are compared.

use linkdyn_model::JointKind;
use linkdyn_model::error::Complaint;

use crate::near::nearest;
use crate::{ModelFile, Unanswered};

/// Asks how far the models of a clearance are apart.
#[derive(Debug, Clone, Default)]
pub struct Compare {
    /// Joints whose clearance model changes; `all` that have a clearance.
    pub joints: Vec<String>,
    /// Clearance models, the first is what the others are compared with; none: the whole ladder, as far as it can be run.
    pub models: Vec<String>,
    /// Patterns of the columns that are compared; none: the usual ones.
    pub columns: Vec<String>,
}

/// The ladder of clearance models, simple ones first.
const LADDER: [&str; 5] = [
    "ideal",
    "massless_link",
    "two_state",
    "three_state",
    "contact",
];
/// All joints that have a clearance.
const ALL: &str = "all";

/// The joints of these names, each with a clearance.
pub fn joints(file: &ModelFile, names: &[String]) -> Result<Vec<String>, Unanswered> {
    let known = &file.model().joints;
    let has_clearance = |kind: &JointKind| matches!(kind, JointKind::Revolute { clearance, .. } if clearance.is_some());
    let mut found: Vec<String> = Vec::new();
    let mut complaints = Vec::new();
    for name in names {
        match known.get(name) {
            Some(joint) if has_clearance(&joint.kind) => found.push(name.clone()),
            Some(joint) => complaints.push(without(name, &joint.kind)),
            None if name == ALL => {
                let all = known.iter().filter(|(_, joint)| has_clearance(&joint.kind));
                found.extend(all.map(|(name, _)| name.clone()));
                if found.is_empty() {
                    let said = Complaint::new(
                        "joints",
                        "no joint has a \"clearance\" whose model could be changed",
                    );
                    complaints.push(said.hint(ADD));
                }
            }
            None => {
                let said = Complaint::new(
                    "joints",
                    format!("there is no joint {name:?}, as --joint says"),
                );
                complaints.push(match nearest(name, known.keys().map(String::as_str)) {
                    Some(near) => said.hint(format!("did you mean {near:?}?")),
                    None => said.hint(format!(
                        "there are {}",
                        known.keys().cloned().collect::<Vec<_>>().join(", ")
                    )),
                });
            }
        }
    }
    let mut seen = std::collections::HashSet::new();
    found.retain(|name| seen.insert(name.clone()));
    if complaints.is_empty() {
        Ok(found)
    } else {
        Err(file.refused(complaints.into()))
    }
}

const ADD: &str = "add \"clearance\": { \"model\": \"ideal\", \"radius\": …, and the parameters of the models to compare: \
\"bearing_radius\" and \"normal\" for contact, \"surface\" for two_state, \"impact\" for three_state }";

fn without(name: &str, kind: &JointKind) -> Complaint {
    let path = format!("joints.{name}");
    match kind {
        JointKind::Revolute { .. } => {
            Complaint::new(path, "has no \"clearance\" whose model could be changed").hint(ADD)
        }
        _ => Complaint::new(path, "only a revolute joint can have a clearance")
            .hint("name another joint"),
    }
}

/// The models of these names, each once, or the whole ladder.
pub fn models(names: &[String]) -> Result<Vec<&'static str>, Unanswered> {
    if names.is_empty() {
        return Ok(LADDER.to_vec());
    }
    let mut models = Vec::new();
    for name in names {
        let Some(model) = LADDER.into_iter().find(|model| model == name) else {
            let hint =
                nearest(name, LADDER.into_iter()).map(|near| format!(" (did you mean {near:?}?)"));
            let known = LADDER.join(", ");
            let hint = hint.unwrap_or_default();
            return Err(Unanswered::question(format!(
                "--models: there is no clearance model {name:?}, only {known}{hint}"
            )));
        };
        if !models.contains(&model) {
            models.push(model);
        }
    }
    Ok(models)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_are_known_by_name_and_taken_once() {
        let models = |names: &[&str]| {
            models(
                &names
                    .iter()
                    .map(|name| (*name).to_string())
                    .collect::<Vec<_>>(),
            )
        };
        assert_eq!(models(&[]).expect("all"), LADDER);
        let twice = models(&["contact", "ideal", "contact"]).expect("known");
        assert_eq!(twice, ["contact", "ideal"]);
        let said = models(&["contacts"]).expect_err("unknown").to_string();
        assert!(said.ends_with("(did you mean \"contact\"?)"), "{said:?}");
    }
}
