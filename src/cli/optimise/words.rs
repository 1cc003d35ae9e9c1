//! What a model asks of an optimisation, in words.

use crate::cli::open::Opened;
use crate::cli::page::{Page, count};
use crate::cli::responses::value;
use linkdyn_model::optimise::Range;

/// What a model looks for, a row each.
pub fn rows(page: &mut Page, opened: &Opened) {
    let Some(asked) = &opened.loaded.model.optimise else {
        return;
    };
    let display = &opened.loaded.model.display;
    let mut rows = Vec::new();
    for (name, range) in &asked.design {
        let parameter = opened
            .loaded
            .parameters
            .iter()
            .find(|own| own.name == *name);
        let unit = parameter.map_or("", |own| own.unit.as_str());
        rows.push(match range {
            Range::Within([lower, upper]) => {
                let ends = [lower, upper].map(|end| value(*end, unit, display));
                format!("{name} within {} … {}", ends[0], ends[1])
            }
            Range::Free(_) => format!("{name} around its value"),
        });
    }
    if let Some(objective) = &asked.objective {
        let least = objective
            .minimise
            .as_ref()
            .map(|own| format!("least {}", own.text));
        let most = objective
            .maximise
            .as_ref()
            .map(|own| format!("greatest {}", own.text));
        rows.extend(least.or(most));
    }
    if let Some(curve) = &asked.curve {
        let points = count(curve.through.len(), "point");
        rows.push(format!("{} through {points}", curve.point));
    }
    rows.extend(asked.constraints.iter().map(|one| one.text.clone()));
    page.rows("optimise", rows);
}
