//! `synthesis.json`, in SI.

use super::{Synthesised, Tried};
use crate::{ENGINE, Subject};
use serde::{Serialize, Serializer};
use serde_json::Value;

#[derive(Serialize)]
struct TriedJson<'a> {
    kind: &'a str,
    method: &'a str,
    complete: bool,
    notes: &'a [String],
    starts: Option<u64>,
    exact: Option<usize>,
    candidates: usize,
    good: usize,
    outside_limits: usize,
    other_circuit: usize,
    other_branch: usize,
    other_order: usize,
    transmission_too_small: usize,
    broken: usize,
    why_broken: Option<&'a str>,
}

#[derive(Serialize)]
struct LinkageJson<'a> {
    kind: &'a str,
    front: usize,
    largest_distance: Option<f64>,
    largest_angle: Option<f64>,
    transmission: Option<f64>,
    size: f64,
    effort: Option<f64>,
    spread: f64,
    angle_spread: f64,
    turns_fully: bool,
    crank: &'a [f64],
    model: &'a Value,
}

#[derive(Serialize)]
struct SynthesisJson<'a> {
    engine: &'a str,
    model: Subject<'a>,
    complete: bool,
    interrupted: bool,
    tried: Vec<TriedJson<'a>>,
    further_off: usize,
    more: usize,
    linkages: Vec<LinkageJson<'a>>,
}

impl<'a> From<&'a Tried> for TriedJson<'a> {
    fn from(own: &'a Tried) -> Self {
        TriedJson {
            kind: &own.kind,
            method: &own.method,
            complete: own.is_complete,
            notes: &own.notes,
            starts: own.searched.map(|own| own.starts),
            exact: own.searched.map(|own| own.exact),
            candidates: own.candidates,
            good: own.good,
            outside_limits: own.outside,
            other_circuit: own.circuit,
            other_branch: own.branch,
            other_order: own.order,
            transmission_too_small: own.transmission,
            broken: own.broken.0,
            why_broken: own.broken.1.as_deref(),
        }
    }
}

/// `synthesis.json`.
impl Serialize for Synthesised {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fn design(own: &super::FoundLinkage) -> LinkageJson<'_> {
            LinkageJson {
                kind: &own.kind,
                front: own.front,
                largest_distance: own.off,
                largest_angle: own.off_angle,
                transmission: own.transmission,
                size: own.size,
                effort: own.effort,
                spread: own.spread[0],
                angle_spread: own.spread[1],
                turns_fully: own.turns_fully,
                crank: &own.candidate.turns,
                model: &own.model,
            }
        }
        SynthesisJson {
            engine: ENGINE,
            model: self.file.subject(),
            complete: !self.is_stopped && self.tried.iter().all(|own| own.is_complete),
            interrupted: self.is_stopped,
            tried: self.tried.iter().map(TriedJson::from).collect(),
            further_off: self.ranked.further_off,
            more: self.ranked.more,
            linkages: self.ranked.designs.iter().map(design).collect(),
        }
        .serialize(serializer)
    }
}
