//! What a diagnosis means, in a sentence.

use super::clearances::journals_move;
use super::found::{ANALYSES, Check, Lack, Open, Undriven};
use crate::analysis::words::listed;
use linkdyn_model::{AnalysisKind, Model};

/// `1 degree of freedom`.
pub fn freedom_text(freedom: i64) -> String {
    match freedom {
        0 => "no degree of freedom".into(),
        1 => "1 degree of freedom".into(),
        n => format!("{n} degrees of freedom"),
    }
}

/// The analysis as a sentence calls it.
fn spoken(kind: AnalysisKind) -> &'static str {
    match kind {
        AnalysisKind::Assembly => "assembly",
        AnalysisKind::Kinematics => "kinematics",
        AnalysisKind::InverseDynamics => "inverse dynamics",
        AnalysisKind::Dynamics => "forward dynamics",
        AnalysisKind::Statics => "statics",
        AnalysisKind::QuasiStatics => "quasi-statics",
    }
}

/// `a`, `a and b`, `a, b and c`.
fn and<S: AsRef<str>>(words: &[S]) -> String {
    match words {
        [] => String::new(),
        [only] => only.as_ref().into(),
        [first @ .., last] => format!("{} and {}", listed(first, ", "), last.as_ref()),
    }
}

/// What the mobility means: `1 degree of freedom, driven by motor: kinematics and inverse dynamics are possible; …`.
pub fn words(model: &Model, undriven: Option<&Undriven>, check: &Check) -> String {
    let freedom = check.mobility.rank;
    let drivers: Vec<&str> = model.drivers.keys().map(String::as_str).collect();
    let count = drivers.len() as i64;
    let mut text = if check.open.is_some() {
        "with ideal pins ".to_string()
    } else {
        String::new()
    };
    text += &freedom_text(freedom);
    text += &match (count, freedom) {
        (0, 0) if check.open.is_some() => String::new(),
        (0, 0) => ", a structure: nothing in it can move".into(),
        (0, _) => ", none driven".into(),
        (_, _) if count > freedom => {
            format!(" and {count} drivers, {}", and(&drivers)).replace(" 1 drivers", " 1 driver")
        }
        (_, _) if count < freedom => format!(", {count} driven by {}", and(&drivers)),
        (_, _) => format!(", driven by {}", and(&drivers)),
    };
    let possible = check.possible().map(spoken).collect::<Vec<_>>();
    text += &match possible.len() {
        0 => ": no analysis but the assembly is possible".into(),
        1 => format!(": {} is possible", possible[0]),
        _ => format!(": {} are possible", and(&possible)),
    };
    text += &missing_drivers(undriven, check, count);
    let held = freedom == count && !journals_move(model);
    let bends = model.bodies.values().any(|body| body.elastic.is_some());
    if bends {
        text += "; its elastic links bend in dynamics, statics and modes";
    } else if held && freedom > 0 {
        text += "; forward dynamics has nothing free";
    }
    if let Some(Open { joints, mobility }) = &check.open {
        let free = match joints.as_slice() {
            [joint] => format!("the journal of {joint} is free in its bearing"),
            joints => format!("the journals of {} are free in their bearings", and(joints)),
        };
        text += &format!("; {free}: {} in motion", freedom_text(mobility.rank));
    }
    text += &missing_data(check, held);
    let weightless = |lack: &Lack| lack.analyses.contains(&AnalysisKind::Statics);
    if check.lacks.iter().any(weightless)
        && check
            .possible()
            .any(|kind| kind == AnalysisKind::QuasiStatics)
    {
        text += "; in quasi-statics a body without mass has no weight";
    }
    text
}

/// What the drivers lack for a prescribed motion, behind a semicolon.
fn missing_drivers(undriven: Option<&Undriven>, check: &Check, count: i64) -> String {
    let freedom = check.mobility.rank;
    match undriven {
        Some(Undriven::TooFew(_)) if freedom > count => {
            let more = if freedom - count == 1 {
                "1 driver".into()
            } else {
                format!("{} drivers", freedom - count)
            };
            let more = if count == 0 {
                more
            } else {
                format!("{more} more")
            };
            format!("; kinematics and inverse dynamics need {more}")
        }
        Some(Undriven::TooMany(_)) => {
            let freedom = check
                .open
                .as_ref()
                .map_or(freedom, |open| open.mobility.rank);
            format!("; take {} of the drivers out", (count - freedom).max(1))
        }
        Some(Undriven::TooFew(said) | Undriven::Singular(said)) => format!("; {said}"),
        None => String::new(),
    }
}

/// The analyses that need data that bodies lack, behind a semicolon.
fn missing_data(check: &Check, held: bool) -> String {
    let lacking = |kind: &AnalysisKind| {
        let mut needing = check.lacks.iter().flat_map(|lack| &lack.analyses);
        needing.any(|needed| needed == kind)
    };
    let data: Vec<&str> = ANALYSES
        .into_iter()
        .filter(|kind| *kind != AnalysisKind::Dynamics || !held)
        .filter(lacking)
        .map(spoken)
        .collect();
    if data.is_empty() {
        return String::new();
    }
    format!(
        "; {} {} data that bodies lack",
        and(&data),
        if data.len() == 1 { "needs" } else { "need" }
    )
}
