//! A model on the desk, and what is asked of it.

use std::time::Duration;

use linkdyn_ask::Question;
use linkdyn_ask::accuracy::zones;
use linkdyn_ask::assemblies::Assemblies;
use linkdyn_ask::editor::{drawn, thinned, words};
use linkdyn_ask::run::{typed, with_values};
use linkdyn_ask::{ModelFile, Unanswered};
use linkdyn_engine::analysis::hand::Hand;
use linkdyn_engine::analysis::{Control, Outcome};
use linkdyn_output::{Stage, csv};
use linkdyn_picture::report::around;
use serde_json::{Map, Value, json};
use wasm_bindgen::prelude::wasm_bindgen;
use web_time::Instant;

use crate::picture::Picture;
use crate::read;
use crate::what::listen;

/// Longest time for what nobody asked for \[s\].
const ZONE_SECONDS: f64 = 2.0;
/// The same for all assemblies, and how many are looked for, and drawn.
const ASSEMBLY_SECONDS: f64 = 5.0;
const MOST_ASSEMBLIES: usize = 200;
const MOST_DRAWINGS: usize = 24;
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
        let ran = self.file().and_then(|file| {
            let fewer = thinned(file, outputs);
            drawn(fewer.as_ref().unwrap_or(file), &limited(seconds))
        });
        match ran {
            Ok((file, outcome)) => {
                let picture = Picture::new(&file, &outcome);
                self.ran = Some((file, outcome));
                picture
            }
            Err(why) => Picture::without(why.to_string()),
        }
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
    /// The answer to a question by name, in the words of its command (`linkdyn_ask::editor::words`).
    pub fn words(&self, name: &str) -> String {
        let told = self
            .file()
            .and_then(|file| words(file, name, &Control::default()));
        match told {
            Ok(page) => page.map_or_else(String::new, |page| page.text().to_owned()),
            Err(why) => why.to_string(),
        }
    }

    /// All assemblies at the start: JSON with `words`, the names of the moving `bodies`, and `found`, a list of `poses` \[m, rad\] and `drawn`;
    /// or `faults`.
    pub fn assemblies(&self) -> String {
        self.told(|file| {
            let question = Assemblies {
                at: 0.0,
                most: MOST_ASSEMBLIES,
            };
            let found = question.answer(file, &limited(ASSEMBLY_SECONDS))?;
            let all = found.found.found.iter().take(MOST_DRAWINGS);
            let all = all.map(|one| json!({ "poses": one.poses, "drawn": one.is_drawn }));
            Ok(json!({
                "words": found.text().text().lines().next(),
                "bodies": found.found.bodies,
                "found": all.collect::<Vec<_>>(),
            }))
        })
    }

    /// Where tolerances and clearances can carry the listed points, to first order: JSON, a list of zones.
    pub fn zones(&self) -> String {
        let zones = self
            .file()
            .and_then(|file| zones(file, &limited(ZONE_SECONDS)));
        json!(zones.unwrap_or_default()).to_string()
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

    pub(crate) fn told(
        &self,
        answer: impl FnOnce(&ModelFile) -> Result<Value, Unanswered>,
    ) -> String {
        let told = self.file().and_then(answer);
        told.unwrap_or_else(|why| read::faults(&self.text, why))
            .to_string()
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
