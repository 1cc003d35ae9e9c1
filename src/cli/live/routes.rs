//! What is answered.

use std::fs;
use std::sync::Arc;

use linkdyn_ask::Unanswered;
use linkdyn_ask::run::{tuned, typed, with_values};
use linkdyn_ask::text::plain;
use linkdyn_engine::analysis::Control;
use linkdyn_picture::watch_page;
use serde_json::{Map, Value, json};

use super::state::{ShownRun, State};
use crate::cli::open::refuse;
use crate::cli::serve::http::{Answer, Request};

const JSON: &str = "application/json";
const HTML: &str = "text/html; charset=utf-8";
const TEXT: &str = "text/plain; charset=utf-8";

/// The answer to a request of a path.
pub fn answer(state: &State, request: &Request, path: &str) -> Answer {
    match (request.method.as_str(), path) {
        ("GET", "") => Answer::new(200, HTML, watch_page::page()),
        ("GET", "here.js") => Answer {
            is_open: true,
            ..Answer::new(200, "text/javascript", "")
        },
        ("GET", "report.html") => match fs::read(&state.report) {
            Ok(page) => Answer::new(200, HTML, page),
            Err(_) => Answer::bare(404),
        },
        ("GET", "state") => Answer::new(200, JSON, state.news(&request.query).to_string()),
        ("GET", "data") => match state.last() {
            Some(run) => Answer::new(200, TEXT, run.data.as_bytes()),
            None => Answer::bare(404),
        },
        ("POST", "try" | "read" | "write") => {
            let body: Option<Map<String, Value>> = serde_json::from_slice(&request.body).ok();
            match (body, state.last()) {
                (Some(body), Some(run)) => posted(state, path, &body, &run),
                (None, _) => Answer::bare(400),
                (Some(_), None) => Answer::bare(409),
            }
        }
        (_, "" | "here.js" | "report.html" | "state" | "data" | "try" | "read" | "write") => {
            Answer::bare(405)
        }
        _ => Answer::bare(404),
    }
}

fn posted(state: &State, path: &str, body: &Map<String, Value>, run: &ShownRun) -> Answer {
    if path == "read" {
        let Some((name, text)) = body
            .iter()
            .find_map(|(name, text)| Some((name, text.as_str()?)))
        else {
            return Answer::bare(400);
        };
        return match typed(&run.file, name, text) {
            Ok(value) => Answer::new(200, JSON, json!(value).to_string()),
            Err(why) => refused(run, why),
        };
    }
    let values = body.iter();
    let values = values.map(|(name, value)| Some((name.as_str(), value.as_f64()?)));
    let Some(values) = values.collect::<Option<Vec<_>>>() else {
        return Answer::bare(400);
    };
    if path == "write" {
        return match written(state, run, &values) {
            Ok(()) => Answer::new(200, JSON, "[]"),
            Err(why) => refused(run, why),
        };
    }
    state.newest(|interrupted| {
        if values.is_empty() {
            return Answer::new(200, TEXT, run.data.as_bytes());
        }
        let control = Control {
            interrupted: Arc::clone(interrupted),
            ..Control::default()
        };
        match control.stop() {
            Some(_) => Answer::bare(409),
            None => match tuned(&run.file, &values, &control) {
                Ok(data) => Answer::new(200, TEXT, data),
                Err(Unanswered::Interrupted) => Answer::bare(409),
                Err(why) => refused(run, why),
            },
        }
    })
}

/// Writes values into the model's file, where that is still the one that ran.
fn written(state: &State, run: &ShownRun, values: &[(&str, f64)]) -> Result<(), Unanswered> {
    let (path, label) = (&state.model, run.file.label());
    let fault = |why: &str| Unanswered::question(format!("{label}: {why}"));
    let unreadable = |why: std::io::Error| fault(&why.to_string());
    if fs::read(path).map_err(unreadable)? != run.file.text.bytes {
        return Err(fault(
            "the file is not the one of the run that is shown, and stays as it is (save it without mistakes first)",
        ));
    }
    let bytes = with_values(&run.file, values)?;
    fs::write(path, bytes).map_err(unreadable)
}

/// What is wrong, in lines.
fn refused(run: &ShownRun, why: Unanswered) -> Answer {
    let failure = refuse(run.file.label(), why.into());
    let lines: Vec<String> = failure
        .lines()
        .iter()
        .map(|line| plain(line).into_owned())
        .collect();
    Answer::new(422, JSON, json!(lines).to_string())
}
