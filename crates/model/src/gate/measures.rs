//! Measures: how many points they have, and of which bodies.

use super::Rules;
use crate::response::Catalogue;
use crate::{Measurement, PointRef};

/// All rules of measures but those on names.
pub(super) fn measures(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, measure) in &model.measures {
        if Catalogue::is_of_bodies(name) {
            let message = format!("measure.{name} would be a column of a body called \"measure\"");
            rules.complain(
                format!("measures.{name}"),
                message,
                "give the measure another name",
            );
            continue;
        }
        let path = format!("measures.{name}.{}", measure.key());
        if rules.holes.has(&path) {
            continue;
        }
        match measure {
            Measurement::Distance([first, second]) => apart(rules, &path, first, second),
            Measurement::Angle(points) => {
                let [a, b, c, d] = points.as_slice() else {
                    let message = format!("an angle has 4 points, and here are {}", points.len());
                    let hint = "two of a direction, two of the other: [\"a.P\", \"a.Q\", \"b.R\", \"b.S\"]";
                    rules.complain(path, message, hint);
                    continue;
                };
                line(rules, &path, a, b);
                line(rules, &path, c, d);
                apart(rules, &path, a, c);
            }
            Measurement::DistanceToLine(points) => {
                let [point, from, to] = points.as_slice() else {
                    let message = format!(
                        "a point and a line have 3 points, and here are {}",
                        points.len()
                    );
                    rules.complain(
                        path,
                        message,
                        "the point, then two of the line: [\"a.P\", \"b.Q\", \"b.R\"]",
                    );
                    continue;
                };
                line(rules, &path, from, to);
                apart(rules, &path, point, from);
            }
        }
    }
}

/// What is measured is between two bodies.
fn apart(rules: &mut Rules<'_>, path: &str, first: &PointRef, second: &PointRef) {
    let bends = rules.model.bodies.get(&first.body);
    let bends = bends.is_some_and(|body| body.elastic.is_some());
    if first.body == second.body && !bends {
        let message = format!("both are of {:?}", first.body);
        let hint = "what is measured within a body does not depend on the mechanism";
        rules.complain(path, message, hint);
    }
}

/// A direction is that of two points of one body, at two places.
fn line(rules: &mut Rules<'_>, path: &str, first: &PointRef, second: &PointRef) {
    if first.body != second.body {
        let message = format!("{first} and {second} are of two bodies");
        let hint = "a direction is that of two points of one body; \"distance\" is between bodies";
        rules.complain(path, message, hint);
        return;
    }
    let place = |point: &PointRef| {
        let body = rules.model.bodies.get(&point.body)?;
        body.points.get(&point.point).copied()
    };
    if let (Some(a), Some(b)) = (place(first), place(second))
        && a == b
    {
        let message = format!("{first} and {second} are at one place, and have no direction");
        rules.complain(path, message, "name two points that are apart");
    }
}
