//! What a response turned out to be, or why it has no value.

use super::Responses;
use super::reason::Reason;
use linkdyn_model::response::Fact;
use serde_json::{Value, json};

/// A response of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Its name.
    pub name: String,
    /// In SI; `None` if there is none.
    pub value: Option<f64>,
    /// Its unit in SI; empty of a plain number.
    pub unit: String,
    /// The unit in which it is shown, with its size in SI.
    pub shown: Option<(String, f64)>,
    /// Lower and upper limit in SI.
    pub limits: Option<[f64; 2]>,
    /// Why there is no value.
    pub reason: Option<String>,
}

/// Responses as `summary.json` has them; null where there are none.
pub fn to_json(answers: &[Answer]) -> Value {
    if answers.is_empty() {
        return Value::Null;
    }
    let all = answers.iter().map(|answer| {
        let mut json = json!({ "value": answer.value, "unit": answer.unit });
        if let Some(limits) = answer.limits {
            json["limits"] = json!(limits);
        }
        if let Some(reason) = &answer.reason {
            json["reason"] = json!(reason);
        }
        (answer.name.clone(), json)
    });
    Value::Object(all.collect())
}

impl Reason {
    /// The same, of a reducer.
    pub(super) fn of(self, index: usize) -> Self {
        match self {
            Reason::NeverReached(_) => Reason::NeverReached(index),
            Reason::Nothing(_) => Reason::Nothing(index),
            Reason::Early(_)
            | Reason::Gap(..)
            | Reason::Empty(_)
            | Reason::NotFinite(_)
            | Reason::Endless(_)
            | Reason::NoItem(_)
            | Reason::NoFact(_) => self,
        }
    }
}

impl Responses {
    /// A reason in words.
    pub(super) fn words(&self, reason: Reason) -> String {
        let text = |index: usize| self.reducers.get(index).map_or("", |one| one.text.as_str());
        match reason {
            Reason::Early(status) => format!("the run ended early: {status}"),
            Reason::Gap(time, input) => {
                let column = self.columns.get(input).map_or("a column", String::as_str);
                format!("{column} has no value at {time} s")
            }
            Reason::Empty(input) => {
                let column = self.columns.get(input).map_or("a column", String::as_str);
                format!("{column} is empty where its value counts")
            }
            Reason::NotFinite(Some(time)) => format!("it has no finite value at {time} s"),
            Reason::NotFinite(None) => "its value is not finite".to_owned(),
            Reason::Endless(time) => {
                format!("it has no extreme: it grows without end near {time} s")
            }
            Reason::NeverReached(index) => format!("{}: this never happens", text(index)),
            Reason::Nothing(index) => format!("{}: there is nothing of this kind", text(index)),
            Reason::NoItem(time) => {
                format!("a contact that begins at {time} s has no such value")
            }
            Reason::NoFact(Fact::Clearance(joint, _)) => {
                let joint = self.joints.get(joint).map_or("", String::as_str);
                format!("joint {joint:?} has no contacts in this run")
            }
            Reason::NoFact(fact) => format!("this run has no {}", fact.name()),
        }
    }
}
