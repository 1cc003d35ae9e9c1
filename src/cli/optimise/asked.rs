//! What the options ask for, put into the model's `optimise`, so that it is checked where the file is.

use super::Options;
use crate::cli::exit::{BadInput, Failure};
use crate::cli::open::{ModelOptions, Opened, bad_input};
use linkdyn_model::error::{Complaint, Complaints};
use serde_json::{Value, json};

/// What stands where in the model because of an option.
struct Put {
    /// `PATH=VALUE` of a `--set`.
    set: String,
    /// Where faults of it are found, and how the option was given.
    labels: Vec<(String, String)>,
}

fn bad(text: impl Into<String>) -> Failure {
    BadInput(vec![text.into()])
}

/// Reads a model with what the options ask for besides.
///
/// # Errors
/// When there is no such model, or it or an option has faults.
pub fn open(model: &ModelOptions, options: &Options) -> Result<(Opened, Vec<String>), Failure> {
    let written = written(model)?;
    let puts = puts(options, &written)?;
    complete(options, &written)?;
    let sets: Vec<String> = puts.iter().map(|put| put.set.clone()).collect();
    let opened = model.open_with(&sets)?;
    let opened =
        opened.map_err(|complaints| bad_input(&model.label(), relabelled(complaints, &puts)))?;
    if opened.loaded.model.optimise.is_none() {
        return Err(bad(NO_DESIGN));
    }
    Ok((opened, sets))
}

const NO_DESIGN: &str = "nothing may change: say --vary \"parameters.r=10 mm:60 mm\", or \"design\" in the model's \"optimise\"";
const NO_AIM: &str = "nothing is looked for: say --goal \"stroke = 80 mm\", --minimise EXPRESSION or --maximise EXPRESSION, or \"optimise\" in the model";

/// What the file has under `optimise`; nothing where it can't be read, which is said later.
fn written(model: &ModelOptions) -> Result<Value, Failure> {
    let file: Value = serde_json::from_slice(&model.bytes()?).unwrap_or_default();
    let mut written = file["optimise"].clone();
    // What is set is as good as written.
    for set in model.sets() {
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
    Ok(written)
}

/// There is something that may change, and something to look for.
fn complete(options: &Options, written: &Value) -> Result<(), Failure> {
    let has = |key: &str| !written[key].is_null();
    if !has("design") && options.vary.is_empty() {
        return Err(bad(NO_DESIGN));
    }
    let aims = [&options.minimise, &options.maximise, &options.goals];
    let is_asked = aims.iter().any(|all| !all.is_empty());
    if !is_asked && !["objective", "constraints", "curve"].into_iter().any(has) {
        return Err(bad(NO_AIM));
    }
    Ok(())
}

fn puts(options: &Options, written: &Value) -> Result<Vec<Put>, Failure> {
    let mut puts = Vec::new();
    for text in &options.vary {
        puts.push(vary(text)?);
    }
    let objectives = [
        ("minimise", &options.minimise),
        ("maximise", &options.maximise),
    ];
    let all: Vec<(&str, &String)> = objectives
        .iter()
        .flat_map(|(word, texts)| texts.iter().map(|text| (*word, text)))
        .collect();
    match all.as_slice() {
        [] => {}
        [(word, text)] => puts.push(Put {
            set: format!("optimise.objective={}", json!({ *word: text })),
            labels: vec![(
                "optimise.objective".to_owned(),
                format!("--{word} {text:?}"),
            )],
        }),
        [_, _, ..] => {
            let given: Vec<String> = all
                .iter()
                .map(|(word, text)| format!("--{word} {text:?}"))
                .collect();
            return Err(bad(format!(
                "{}: there is one objective; what else must hold is a --constraint",
                given.join(", ")
            )));
        }
    }
    puts.extend(constraints(options, written)?);
    let numbers = [
        ("robust", options.robust.map(|own| json!(own))),
        ("starts", options.starts.map(|own| json!(own))),
        ("seed", options.seed.map(|own| json!(own))),
    ];
    for (key, value) in numbers {
        if let Some(value) = value {
            puts.push(Put {
                set: format!("optimise.{key}={value}"),
                labels: vec![(format!("optimise.{key}"), format!("--{key} {value}"))],
            });
        }
    }
    Ok(puts)
}

/// Constraints of the file, and those of options behind them.
fn constraints(options: &Options, written: &Value) -> Result<Option<Put>, Failure> {
    let mut all = written["constraints"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    let mut labels = Vec::new();
    let goals = options.goals.iter().map(|text| ("goal", text));
    let others = options.constraints.iter().map(|text| ("constraint", text));
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

/// `parameters.r=10 mm:60 mm`, or `parameters.r` alone.
fn vary(text: &str) -> Result<Put, Failure> {
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
    Ok(Put {
        set: format!("optimise.design.{name}={value}"),
        labels: vec![(format!("optimise.design.{name}"), format!("--vary {text}"))],
    })
}

/// A number, or text with a unit.
fn number(text: &str) -> Value {
    let text = text.trim();
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => json!(number),
        Ok(_) | Err(_) => json!(text),
    }
}

/// Complaints about what an option asks for name the option.
fn relabelled(complaints: Complaints, puts: &[Put]) -> Complaints {
    let label = |complaint: &Complaint| {
        let is_set = complaint
            .found
            .as_deref()
            .is_some_and(|found| found.starts_with("--set "));
        let all = puts.iter().flat_map(|put| &put.labels);
        let is_it = |path: &String| {
            let rest = complaint.path.strip_prefix(path.as_str());
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let mut all = all.filter(|(path, _)| is_it(path));
        let found = all.next().map(|(_, label)| label.clone());
        found.filter(|_| is_set || complaint.place.is_none())
    };
    let told = complaints.into_iter().map(|mut complaint| {
        if let Some(label) = label(&complaint) {
            complaint.found = None;
            complaint.path = label;
        }
        complaint
    });
    // Both ends of a range may have the same fault.
    let mut told: Vec<Complaint> = told.collect();
    told.dedup();
    Complaints(told)
}
