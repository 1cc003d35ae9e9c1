//! A model on the desk, and what is asked of it.

use std::time::Duration;

use linkdyn_ask::accuracy::Accuracy;
use linkdyn_ask::check::Check;
use linkdyn_ask::modes::Modes;
use linkdyn_ask::run::{self, Run, typed, with_values};
use linkdyn_ask::text::Page;
use linkdyn_ask::{ModelFile, Question, Unanswered};
use linkdyn_engine::analysis::hand::Hand;
use linkdyn_engine::analysis::{Control, Outcome};
use linkdyn_output::{Stage, csv};
use linkdyn_picture::report::around;
use serde_json::{Map, Value, json};
use wasm_bindgen::prelude::wasm_bindgen;
use web_time::Instant;

use crate::picture::{self, Picture};
use crate::read;
use crate::what::listen;

/// What is said where nothing was read yet.
const NOTHING: &str = "there is no model";

/// A model, and its last run.
#[wasm_bindgen]
#[derive(Default)]
pub struct Desk {
    text: String,
    file: Option<ModelFile>,
    ran: Option<(ModelFile, Outcome)>,
    pub(crate) hand: Option<Hand>,
}

/// What a page asks while it is edited.
#[wasm_bindgen]
impl Desk {
    /// An empty one.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        listen();
        Desk::default()
    }

    /// Reads a model, and says what is right and wrong with it, as JSON. One with faults leaves the model before.
    pub fn read(&mut self, text: &str, name: &str) -> String {
        let read = read::read(text, name);
        let told = read::told(text, &read);
        if let Ok(file) = read {
            (self.text, self.file, self.ran) = (text.to_owned(), Some(file), None);
            self.hand = None;
        }
        told.to_string()
    }

    /// Runs the model's analysis, for so many seconds and with so many outputs at most; a model without one is drawn as it is assembled.
    pub fn run(&mut self, seconds: f64, outputs: usize) -> Picture {
        self.drawn(|file| {
            let fewer = picture::thinned(file, outputs);
            picture::run(fewer.as_ref().unwrap_or(file), &limited(seconds))
        })
    }

    /// The file's text with other values of parameters, in the file's units: JSON with `text`, or with `faults`.
    pub fn set(&self, values: &str) -> String {
        let values: Map<String, Value> = serde_json::from_str(values).unwrap_or_default();
        let values = values.iter();
        let values = values.filter_map(|(name, value)| Some((name.as_str(), value.as_f64()?)));
        let values: Vec<_> = values.collect();
        self.told(|file| {
            let bytes = with_values(file, &values)?;
            Ok(json!({ "text": String::from_utf8_lossy(&bytes) }))
        })
    }

    /// What is typed for a parameter, as a number in the file's unit, or with `faults`.
    pub fn typed(&self, name: &str, text: &str) -> String {
        self.told(|file| Ok(json!(typed(file, name, text)?)))
    }
}

/// What a page asks when it is told to.
#[wasm_bindgen]
impl Desk {
    /// Mobility, loops and what is odd, in the words of the command.
    #[wasm_bindgen(js_name = checkText)]
    pub fn check_text(&self) -> String {
        self.words(|file| Ok(Check.answer(file, &Control::default())?.text()))
    }

    /// The equilibrium, in the words of the command.
    #[wasm_bindgen(js_name = staticsText)]
    pub fn statics_text(&self) -> String {
        self.words(|file| {
            let file = file.with(&["analysis={\"type\":\"statics\"}".to_owned()])?;
            let outcome = Run.answer(&file, &Control::default())?;
            Ok(run::text(&file, &outcome))
        })
    }

    /// Modes, in the words of the command.
    #[wasm_bindgen(js_name = modesText)]
    pub fn modes_text(&self) -> String {
        let control = Control::default();
        self.words(|file| Ok(Modes::default().answer(file, &control)?.text()))
    }

    /// What tolerances do to outputs, in the words of the command.
    #[wasm_bindgen(js_name = accuracyText)]
    pub fn accuracy_text(&self) -> String {
        let control = Control::default();
        self.words(|file| Ok(Accuracy::default().answer(file, &control)?.text()))
    }

    /// `results.csv` of the last run.
    pub fn csv(&self) -> String {
        let mut text = Vec::new();
        if let Some((_, outcome)) = &self.ran {
            csv::write(&outcome.trajectory, &mut text).expect("memory takes it");
        }
        String::from_utf8_lossy(&text).into_owned()
    }

    /// `summary.json` of the last run.
    pub fn summary(&self) -> String {
        let ran = self.ran.as_ref();
        ran.map_or_else(String::new, |(file, outcome)| {
            file.origin().summary(outcome, Stage::default())
        })
    }

    /// `report.html` of the last run.
    #[wasm_bindgen(js_name = reportPage)]
    pub fn report_page(&self) -> String {
        let ran = self.ran.as_ref();
        ran.map_or_else(String::new, |(file, outcome)| file.origin().html(outcome))
    }

    /// The page of a report without its data: what stands before the data, between them and the numbers, and after these, as JSON.
    pub fn frame() -> String {
        json!(around()).to_string()
    }
}

impl Desk {
    pub(crate) fn file(&self) -> Result<&ModelFile, Unanswered> {
        self.file
            .as_ref()
            .ok_or_else(|| Unanswered::question(NOTHING))
    }

    fn drawn(
        &mut self,
        run: impl FnOnce(&ModelFile) -> Result<(ModelFile, Outcome), Unanswered>,
    ) -> Picture {
        match self.file().and_then(run) {
            Ok((file, outcome)) => {
                let picture = Picture::new(&file, &outcome);
                self.ran = Some((file, outcome));
                picture
            }
            Err(why) => Picture::without(why.to_string()),
        }
    }

    pub(crate) fn told(
        &self,
        answer: impl FnOnce(&ModelFile) -> Result<Value, Unanswered>,
    ) -> String {
        let told = self.file().and_then(answer);
        told.unwrap_or_else(|why| read::faults(&self.text, why))
            .to_string()
    }

    fn words(&self, answer: impl FnOnce(&ModelFile) -> Result<Page, Unanswered>) -> String {
        let told = self.file().and_then(answer);
        told.map_or_else(|why| why.to_string(), |page| page.text().to_owned())
    }
}

/// A control that ends a run after so many seconds.
fn limited(seconds: f64) -> Control {
    let wait = Duration::try_from_secs_f64(seconds).ok();
    Control {
        deadline: wait.and_then(|wait| Instant::now().checked_add(wait)),
        ..Control::default()
    }
}
