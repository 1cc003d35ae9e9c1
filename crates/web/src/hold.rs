//! What a hand does to the model on the desk.

use linkdyn_ask::{Unanswered, hand};
use linkdyn_engine::analysis::Stop;
use linkdyn_engine::analysis::hand::Hand;
use linkdyn_model::PointRef;
use linkdyn_model::error::Complaints;
use serde_json::{Value, json};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::Desk;

/// What a hand asks while it moves.
#[wasm_bindgen]
impl Desk {
    /// Takes hold of the mechanism at poses of its moving bodies, x, y \[m\] and angle \[rad\] each; drivers let go. JSON: `{}`, or
    /// `faults`.
    pub fn hold(&mut self, poses: &[f64]) -> String {
        let model = self.file().map(|file| file.model().clone());
        let held = model.and_then(|model| {
            let hand = Hand::new(&model);
            let mut hand = hand.map_err(|stop| match stop {
                Stop::Input(found) => Unanswered::Model(Complaints(found)),
                Stop::Failed { message, .. } => Unanswered::Failed(message),
            })?;
            hand.take(&each(poses)).map_err(Unanswered::Failed)?;
            Ok(hand)
        });
        let told = held.map(|hand| {
            self.hand = Some(hand);
            json!({})
        });
        self.said(told)
    }

    /// Pulls a point of a moving body, counted from 1, in its frame \[m\], towards a place \[m\]. JSON: `poses`, `distance`, `singular`,
    /// `stopped`; or `faults`.
    pub fn pull(&mut self, body: usize, local: &[f64], target: &[f64]) -> String {
        let ends = (self.hand.as_mut(), body.checked_sub(1), local, target);
        let (Some(hand), Some(body), &[lx, ly], &[x, y]) = ends else {
            return self.said(Err(Unanswered::question("nothing is held")));
        };
        let pulled = hand.pull(body, [lx, ly], [x, y]);
        let told = json!({
            "poses": pulled.poses.as_flattened(),
            "distance": pulled.distance,
            "singular": pulled.singular,
            "stopped": pulled.stopped,
        });
        self.said(Ok(told))
    }

    /// The assembly that continues poses \[m, rad\] at a time \[s\], drivers in force: JSON, a list of poses, or null.
    pub fn beside(&self, poses: &[f64], time: f64) -> String {
        let found = self.file().ok();
        let found = found.and_then(|file| Hand::new(file.model()).ok()?.beside(&each(poses), time));
        json!(found.map(|poses| poses.into_flattened())).to_string()
    }

    /// Moves points that lie together, `[["body", "point"], …]`, to a place \[m\], in the bodies at their poses; numbers are written to
    /// a grain \[m\]. JSON: `text`, `changed`, `place`, `poses`; or `faults`.
    pub fn moved(&self, poses: &[f64], ends: &str, target: &[f64], grain: f64) -> String {
        let ends: Vec<(String, String)> = serde_json::from_str(ends).unwrap_or_default();
        let ends = ends.into_iter();
        let ends: Vec<PointRef> = ends.map(|(body, point)| PointRef { body, point }).collect();
        let told = self.file().and_then(|file| {
            let (&[x, y], false) = (target, ends.is_empty()) else {
                return Err(Unanswered::question("there is no point"));
            };
            let moved = hand::moved(file, &each(poses), &ends, [x, y], grain)?;
            Ok(json!({
                "text": moved.text,
                "changed": moved.changed,
                "place": moved.place,
                "poses": moved.poses.as_flattened(),
            }))
        });
        self.said(told)
    }
}

impl Desk {
    fn said(&self, told: Result<Value, Unanswered>) -> String {
        self.told(|_| told)
    }
}

fn each(poses: &[f64]) -> Vec<[f64; 3]> {
    let (poses, _) = poses.as_chunks();
    poses.to_vec()
}
