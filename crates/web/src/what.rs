//! What the engine knows, whatever the model.

use std::panic;
use std::sync::{Mutex, Once, PoisonError};

use linkdyn_ask::ENGINE;
use linkdyn_exchange::{Imported, LeftOut, Options};
use linkdyn_model::bundled;
use serde_json::{Value, json};
use wasm_bindgen::prelude::wasm_bindgen;

static SAID: Mutex<String> = Mutex::new(String::new());

/// Keeps the words of a panic, which ends in a trap that has none.
pub fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        panic::set_hook(Box::new(|info| {
            let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
            *said = info.to_string();
        }));
    });
}

/// What the last panic said.
#[wasm_bindgen(js_name = lastPanic)]
pub fn last_panic() -> String {
    SAID.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// The bundled models: name, title and what they are about, as JSON.
#[wasm_bindgen]
pub fn models() -> String {
    let told = |model: &bundled::Bundled| {
        let file: Value = serde_json::from_str(model.text).unwrap_or_default();
        json!({ "name": model.name, "title": file["name"], "about": file["about"] })
    };
    let all: Vec<Value> = bundled::MODELS.iter().map(told).collect();
    json!(all).to_string()
}

/// The file of a bundled model; empty where there is none of that name.
#[wasm_bindgen(js_name = modelText)]
pub fn model_text(name: &str) -> String {
    bundled::text(name).map_or_else(|_| String::new(), |text| text.into_owned())
}

/// A file of another program as a model: its text and what it lacks, or why it can't be read, as JSON. `name` is that of the file.
#[wasm_bindgen]
pub fn imported(name: &str, bytes: &[u8]) -> String {
    let told = match linkdyn_exchange::import(name, bytes, None, &Options::default()) {
        Ok(Imported { draft, left_out }) => {
            let left_out: Vec<String> = left_out.iter().map(LeftOut::to_string).collect();
            json!({ "text": draft.text(), "left_out": left_out })
        }
        Err(refused) => json!({ "fault": refused.to_string() }),
    };
    told.to_string()
}

/// The JSON Schema of the format.
#[wasm_bindgen]
pub fn schema() -> String {
    linkdyn_model::schema().to_string()
}

/// The version of the engine.
#[wasm_bindgen]
pub fn version() -> String {
    ENGINE.to_owned()
}
