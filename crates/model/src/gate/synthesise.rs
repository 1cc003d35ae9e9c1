//! Synthesis: what belongs together.

use super::Rules;
use crate::synthesise::{LinkageKind, Synthesise};

/// All rules.
pub(super) fn synthesise(rules: &mut Rules<'_>) {
    let Some(asked) = &rules.model.synthesise else {
        return;
    };
    // Half of what was written may be missing.
    if rules.holes.has("synthesise") || rules.holes.within("synthesise") {
        return;
    }
    crank(rules, asked);
    ranges(rules, asked);
    linkages(rules, asked);
    places(rules, asked);
}

/// As many angles of the crank as positions, and only where they are not said already.
fn crank(rules: &mut Rules<'_>, asked: &Synthesise) {
    if let Some(crank) = &asked.crank {
        let (angles, count) = (crank.len(), asked.count());
        if asked.function.is_some() {
            let message = "the angles of \"function\" already say where the crank is";
            rules.complain("synthesise.crank", message, "leave it out");
        } else if angles != count {
            let message = format!("{angles} angles of the crank do not fit {count} positions");
            let hint = "one for each; left out, it does not matter where the crank is";
            rules.complain("synthesise.crank", message, hint);
        } else if crank.windows(2).any(|two| two[0] == two[1]) {
            let message = "the crank stands still between two positions";
            rules.complain(
                "synthesise.crank",
                message,
                "each angle differs from the one before",
            );
        }
    }
    if asked.directions && asked.function.is_none() {
        let message = "only the angles of a \"function\" can be directions";
        rules.complain("synthesise.directions", message, "leave it out");
    }
    if asked.base.is_some() && asked.function.is_none() {
        let message = "the distance of the pivots is only given for a \"function\"";
        let hint = "a path or positions find it; \"pivots\" says where they may be";
        rules.complain("synthesise.base", message, hint);
    }
    if asked.pivots.is_some() && asked.function.is_some() {
        let message = "a \"function\" has its pivots at the origin and beside it, \"base\" apart";
        rules.complain("synthesise.pivots", message, "leave it out");
    }
}

fn ranges(rules: &mut Rules<'_>, asked: &Synthesise) {
    let mut range = |path: &str, of: Option<[f64; 2]>, least: Option<f64>| {
        let Some([lower, upper]) = of else {
            return;
        };
        if least.is_some_and(|least| lower < least) {
            let message = "lengths are not negative";
            rules.complain(path, message, "as in [\"10 mm\", \"200 mm\"]");
        } else if lower >= upper {
            let message = "the least must be below the greatest";
            rules.complain(path, message, "as in [\"10 mm\", \"200 mm\"]");
        }
    };
    range("synthesise.lengths", asked.lengths, Some(0.0));
    range("synthesise.pivots.x", asked.pivots.map(|own| own.x), None);
    range("synthesise.pivots.y", asked.pivots.map(|own| own.y), None);
    if asked
        .transmission
        .is_some_and(|angle| angle >= std::f64::consts::FRAC_PI_2)
    {
        let message = "an angle of transmission is below 90°";
        rules.complain("synthesise.transmission", message, "40° is usual");
    }
}

fn linkages(rules: &mut Rules<'_>, asked: &Synthesise) {
    if let Some(bodies) = asked.bodies
        && bodies % 2 == 1
    {
        let message = format!("{bodies} bodies with pins alone have no single freedom");
        rules.complain("synthesise.bodies", message, "4, 6, 8 or 10");
    }
    for (k, kind) in asked.linkages.iter().enumerate() {
        let path = format!("synthesise.linkages[{k}]");
        if asked.linkages[..k].contains(kind) {
            rules.complain(path, "it is there twice", "leave one out");
        } else if *kind == LinkageKind::SliderCrank && asked.function.is_some() {
            let message = "the output of a slider-crank does not turn";
            rules.complain(
                path,
                message,
                "a \"path\" of its slider, with \"crank\", says how far it slides",
            );
        }
    }
}

/// Positions differ, and there is some size to go by.
fn places(rules: &mut Rules<'_>, asked: &Synthesise) {
    let points: Vec<[f64; 2]> = match (&asked.path, &asked.positions) {
        (Some(path), _) => path.clone(),
        (_, Some(positions)) => positions.iter().map(|own| own.point).collect(),
        (None, None) => return pairs(rules, asked),
    };
    let name = if asked.path.is_some() {
        "path"
    } else {
        "positions"
    };
    let positions = asked.positions.as_deref().unwrap_or_default();
    if positions.iter().any(|own| own.angle.is_some()) && positions[0].angle.is_none() {
        let message = "\"angle\" is missing, though others have one";
        let hint = "angles are counted from that of the first position";
        rules.complain("synthesise.positions[0]", message, hint);
    }
    let angle = |k: usize| asked.positions.as_ref().and_then(|own| own[k].angle);
    for k in 1..points.len() {
        if points[k] == points[k - 1] && angle(k) == angle(k - 1) {
            let path = format!("synthesise.{name}[{k}]");
            rules.complain(path, "it is the same as the one before", "leave one out");
        }
    }
    if points.iter().all(|point| *point == points[0]) {
        let message = "all are at one place, so that nothing says how large the linkage is";
        let hint = "a body that turns about a fixed point is pinned there";
        rules.complain(format!("synthesise.{name}"), message, hint);
    }
}

/// Both bodies turn from pair to pair.
fn pairs(rules: &mut Rules<'_>, asked: &Synthesise) {
    for (k, two) in asked
        .function
        .iter()
        .flat_map(|own| own.windows(2))
        .enumerate()
    {
        if two[0][0] == two[1][0] {
            let path = format!("synthesise.function[{}][0]", k + 1);
            let message = "the crank stands still between two positions";
            rules.complain(path, message, "each angle differs from the one before");
        }
    }
}
