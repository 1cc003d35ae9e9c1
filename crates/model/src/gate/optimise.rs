//! Optimisation: what belongs together.

use super::Rules;
use crate::optimise::{Curve, Optimise, Range, Relation};

/// All rules but those on names.
pub(super) fn optimise(rules: &mut Rules<'_>) {
    let Some(optimise) = &rules.model.optimise else {
        return;
    };
    if let Some(curve) = &optimise.curve {
        timing(rules, curve);
    }
    // Half of what was written may be missing.
    let is_whole = !rules.holes.has("optimise") && !rules.holes.within("optimise");
    if is_whole {
        aim(rules, optimise);
        ranges(rules, optimise);
    }
}

/// There is something to look for.
fn aim(rules: &mut Rules<'_>, optimise: &Optimise) {
    let has_aim = optimise.objective.is_some() || optimise.curve.is_some();
    let constraints = &optimise.constraints;
    let are_goals = constraints
        .iter()
        .all(|one| one.relation == Relation::Equal);
    if !has_aim && (constraints.is_empty() || !are_goals) {
        let message = "\"objective\" is missing";
        let hint = "as in \"objective\": { \"minimise\": \"max(abs(driver.motor.effort))\" }; equations alone are goals, and need none";
        rules.complain("optimise".to_owned(), message, hint);
    }
    if optimise.robust.is_some() && optimise.objective.is_none() {
        let message = "only an objective can be robust, and there is none";
        let hint = "as in \"objective\": { \"minimise\": \"max(abs(driver.motor.effort))\" }";
        rules.complain("optimise.robust".to_owned(), message, hint);
    }
}

/// Only a goal of one parameter is found without bounds.
fn ranges(rules: &mut Rules<'_>, optimise: &Optimise) {
    if optimise.goal().is_some() {
        return;
    }
    for (name, range) in &optimise.design {
        if matches!(range, Range::Free(_)) {
            let path = format!("optimise.design.{name}");
            let message = "a range is missing: only a goal of one parameter goes without";
            rules.complain(path, message, "as in [\"10 mm\", \"60 mm\"]");
        }
    }
}

/// Values of one driver, as many as points.
fn timing(rules: &mut Rules<'_>, curve: &Curve) {
    let path = "optimise.curve".to_owned();
    let Some(at) = &curve.at else {
        return;
    };
    if rules.holes.has(&path) || rules.holes.within(&path) {
        return;
    }
    let hint = "name the driver whose values are meant";
    if rules.lacks_driver(&path, curve.driver.as_ref(), hint) {
        return;
    }
    let (points, values) = (curve.through.len(), at.len());
    if points != values {
        let message = format!("{values} values of the driver do not fit {points} points");
        let hint = "one for each point; left out, it does not matter when the path passes them";
        rules.complain(format!("{path}.at"), message, hint);
    }
}
