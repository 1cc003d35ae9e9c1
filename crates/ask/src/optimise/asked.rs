//! The request, put into the model's `optimise`, so that it is checked where the file is.

use std::sync::Arc;

use serde_json::{Value, json};

use super::Optimise;
use crate::put::{Put, number, read};
use crate::{ModelFile, Text, Unanswered};

fn bad(text: impl Into<String>) -> Unanswered {
    Unanswered::question(text)
}

impl Optimise {
    /// Reads a model with the request.
    pub(super) fn read(&self, text: &Arc<Text>, sets: &[String]) -> Result<ModelFile, Unanswered> {
        let written = written(text, sets);
        let puts = self.puts(&written)?;
        self.expect_complete(&written)?;
        let file = read(text, sets, &puts)?;
        match file.model().optimise {
            Some(_) => Ok(file),
            None => Err(bad(NO_DESIGN)),
        }
    }

    /// There is something that may change, and something to look for.
    fn expect_complete(&self, written: &Value) -> Result<(), Unanswered> {
        let has = |key: &str| !written[key].is_null();
        if !has("design") && self.vary.is_empty() {
            return Err(bad(NO_DESIGN));
        }
        let aims = [&self.minimise, &self.maximise, &self.goals];
        let is_asked = aims.iter().any(|all| !all.is_empty());
        if !is_asked && !["objective", "constraints", "curve"].into_iter().any(has) {
            return Err(bad(NO_AIM));
        }
        Ok(())
    }

    fn puts(&self, written: &Value) -> Result<Vec<Put>, Unanswered> {
        let mut puts = Vec::new();
        for text in &self.vary {
            puts.push(vary(text)?);
        }
        let least = self.minimise.iter().map(|text| ("minimise", text));
        let greatest = self.maximise.iter().map(|text| ("maximise", text));
        let all: Vec<(&str, &String)> = least.chain(greatest).collect();
        let label = |(word, text): &(&str, &String)| format!("--{word} {text:?}");
        match all.as_slice() {
            [] => {}
            [one] => puts.push(Put::new(
                "optimise.objective".to_owned(),
                json!({ one.0: one.1 }),
                label(one),
            )),
            [_, _, ..] => {
                let given: Vec<String> = all.iter().map(label).collect();
                return Err(bad(format!(
                    "{}: there is one objective; what else must hold is a --constraint",
                    given.join(", ")
                )));
            }
        }
        puts.extend(self.put_constraints(written)?);
        let numbers = [
            ("robust", self.robust.map(|own| json!(own))),
            ("starts", self.starts.map(|own| json!(own))),
            ("seed", self.seed.map(|own| json!(own))),
        ];
        for (key, value) in numbers {
            let put = value.map(|value| {
                let label = format!("--{key} {value}");
                Put::new(format!("optimise.{key}"), value, label)
            });
            puts.extend(put);
        }
        Ok(puts)
    }

    /// Constraints of the file, and after them those of the request.
    fn put_constraints(&self, written: &Value) -> Result<Option<Put>, Unanswered> {
        let there = written["constraints"].as_array();
        let mut all = there.cloned().unwrap_or_default();
        let mut labels = Vec::new();
        let goals = self.goals.iter().map(|text| ("goal", text));
        let others = self.constraints.iter().map(|text| ("constraint", text));
        for (word, text) in goals.chain(others) {
            let label = format!("--{word} {text:?}");
            let outside = text.split('(').next().unwrap_or(text);
            let compares = |text: &str| text.contains(['<', '>', '≤', '≥']);
            if word == "goal" && (!text.contains('=') || compares(outside)) {
                return Err(bad(format!(
                    "{label}: a goal is an equation, as in \"stroke = 80 mm\"; an inequality is a --constraint"
                )));
            }
            labels.push((format!("optimise.constraints[{}]", all.len()), label));
            all.push(json!(text));
        }
        Ok((!labels.is_empty()).then(|| Put {
            set: format!("optimise.constraints={}", Value::Array(all)),
            labels,
        }))
    }
}

const NO_DESIGN: &str = "nothing may change: say --vary \"parameters.r=10 mm:60 mm\", or \"design\" in the model's \"optimise\"";
const NO_AIM: &str = "nothing is looked for: say --goal \"stroke = 80 mm\", --minimise EXPRESSION or --maximise EXPRESSION, or \"optimise\" in the model";

/// What the file has under `optimise`; nothing where it can't be read, which is said later.
fn written(text: &Text, sets: &[String]) -> Value {
    let file: Value = serde_json::from_slice(&text.bytes).unwrap_or_default();
    let mut written = file["optimise"].clone();
    for set in sets {
        let path = set.split('=').next().unwrap_or_default().trim();
        if let Some(key) = path.strip_prefix("optimise.") {
            let key = key.split(['.', '[']).next().unwrap_or(key);
            if written[key].is_null() {
                written[key] = json!({});
            }
        } else if path == "optimise" {
            written = json!({ "design": {}, "objective": {} });
        }
    }
    written
}

/// `parameters.r=10 mm:60 mm`, or `parameters.r` alone.
fn vary(text: &str) -> Result<Put, Unanswered> {
    let (path, range) = match text.split_once('=') {
        Some((path, range)) => (path.trim(), Some(range)),
        None => (text.trim(), None),
    };
    let name = path.strip_prefix("parameters.").unwrap_or(path);
    let form = "write it as in \"parameters.r=10 mm:60 mm\", lower and upper bound";
    if name.is_empty() || name.contains(['.', '[', ']']) {
        return Err(bad(format!(
            "--vary {text}: only parameters can be varied; {form}"
        )));
    }
    let value = match range.map(|range| range.split(':').collect::<Vec<_>>()) {
        None => json!("free"),
        Some(ends) => match ends[..] {
            [lower, upper] => json!([number(lower), number(upper)]),
            _ => return Err(bad(format!("--vary {text}: {form}"))),
        },
    };
    let path = format!("optimise.design.{name}");
    Ok(Put::new(path, value, format!("--vary {text}")))
}
