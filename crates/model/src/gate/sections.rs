//! Cross-sections of links and beams: their points, their dimensions, what they are made of, and that they are no heavier than their bodies.

use super::Rules;
use crate::suggest;
use crate::{Beam, Body, JointKind, LinkSection, PointRef, SectionShape};

/// Masses and places that differ by less are the same, relative to the mass and the length of the axis.
const SAME: f64 = 1e-9;

/// All rules of links and beams but those on one number.
pub(super) fn sections(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, body) in &model.bodies {
        let path = format!("bodies.{name}.section");
        if let Some(section) = &body.section
            && !rules.holes.within(&path)
            && !rules.holes.has(&path)
        {
            of_shape(rules, &path, section.shape);
            of_material(rules, &path, section);
            let axis = axis(rules, &path, body, [&section.from, &section.to]);
            let known = |key: &str| !rules.holes.has(&format!("bodies.{name}.{key}"));
            if let Some(axis) = axis.filter(|_| ["mass", "com"].into_iter().all(known)) {
                mass(rules, &path, body, section, axis);
            }
        }
    }
}

/// All rules of beams but those on one number.
pub(super) fn beams(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, joint) in &model.joints {
        let path = format!("joints.{name}");
        let JointKind::Beam(beam) = &joint.kind else {
            continue;
        };
        if !rules.holes.within(&path) && !rules.holes.has(&path) {
            made_of(rules, &format!("{path}.section"), beam);
            if beam.length.is_none() && apart(model, &joint.between) == Some(0.0) {
                rules.complain(
                    path,
                    "the beam has no length: both points are in the same place as drawn",
                    "give its \"length\", and the \"angles\" of its ends in both bodies, or draw the bodies apart by their \"pose\"",
                );
            }
        }
    }
}

/// A beam needs one modulus.
fn made_of(rules: &mut Rules<'_>, path: &str, beam: &Beam) {
    let section = &beam.section;
    of_shape(rules, path, section.shape);
    match (section.material, section.young_modulus) {
        (Some(_), Some(_)) => rules.complain(
            format!("{path}.young_modulus"),
            "the \"material\" has its own young_modulus",
            "give either the material, or \"young_modulus\"",
        ),
        (None, None) => rules.complain(
            path,
            "it is not known what the beam is made of",
            "add \"material\": \"steel\", or \"young_modulus\": \"210 GPa\"",
        ),
        (Some(_), None) | (None, Some(_)) => {}
    }
}

/// How far two points are apart as drawn \[m\]; nothing where one does not exist.
fn apart(model: &crate::Model, between: &[PointRef; 2]) -> Option<f64> {
    let place = |end: &PointRef| {
        let body = model.bodies.get(&end.body)?;
        let ([x, y], pose) = (*body.points.get(&end.point)?, &body.pose);
        let (sin, cos) = pose.angle.sin_cos();
        let [px, py] = pose.position;
        Some([px + cos * x - sin * y, py + sin * x + cos * y])
    };
    let [a, b] = [place(&between[0])?, place(&between[1])?];
    Some((b[0] - a[0]).hypot(b[1] - a[1]))
}

pub(super) fn of_shape(rules: &mut Rules<'_>, path: &str, shape: SectionShape) {
    if let SectionShape::Tube { diameter, wall } = shape
        && wall > diameter / 2.0
    {
        rules.complain(
            format!("{path}.wall"),
            "the wall is thicker than half the diameter",
            "a full bar is a \"circle\"",
        );
    }
}

fn of_material(rules: &mut Rules<'_>, path: &str, section: &LinkSection) {
    let given = [
        ("density", section.density),
        ("young_modulus", section.young_modulus),
    ];
    let key = given.iter().find(|one| one.1.is_some());
    if let (Some(_), Some((key, _))) = (section.material, key) {
        rules.complain(
            format!("{path}.{key}"),
            format!("the \"material\" has its own {key}"),
            "give either the material, or \"young_modulus\" and \"density\"",
        );
    }
}

/// The ends of the axis, in the frame of the body \[m\].
pub(super) fn axis(
    rules: &mut Rules<'_>,
    path: &str,
    body: &Body,
    [begins, ends]: [&String; 2],
) -> Option<[[f64; 2]; 2]> {
    let mut end = |key: &str, point: &String| {
        let place = body.points.get(point);
        if place.is_none() {
            let names = || body.points.keys().map(String::as_str);
            let near = suggest::nearest(point, names());
            let near = near.map_or_else(String::new, |near| format!("did you mean {near:?}? "));
            rules.complain(
                format!("{path}.{key}"),
                format!("the body has no point {point:?}"),
                format!("{near}its points: {}", suggest::list(body.points.keys())),
            );
        }
        place.copied()
    };
    let [Some(from), Some(to)] = [end("from", begins), end("to", ends)] else {
        return None;
    };
    let hint = "give two points apart from each other, between which the link is straight";
    if begins == ends {
        let message = format!("the axis begins and ends at {begins:?}");
        rules.complain(format!("{path}.to"), message, hint);
        return None;
    }
    if from == to {
        let message =
            format!("the axis has no length: {begins:?} and {ends:?} are in the same place");
        rules.complain(format!("{path}.to"), message, hint);
        return None;
    }
    Some([from, to])
}

/// A bar along the axis is part of the body.
fn mass(
    rules: &mut Rules<'_>,
    path: &str,
    body: &Body,
    section: &LinkSection,
    [from, to]: [[f64; 2]; 2],
) {
    let (Some(mass), Some(com)) = (body.mass.filter(|mass| *mass > 0.0), body.com) else {
        return;
    };
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    if let Some(density) = section.density() {
        let bar = density * section.shape.area() * length;
        if bar > mass * (1.0 + SAME) {
            let display = &rules.model.display;
            rules.complain(
                path,
                format!(
                    "a bar of this cross-section weighs {}, more than the body's {}",
                    display.mass_to(bar, 5),
                    display.mass_to(mass, 5)
                ),
                "correct the dimensions, the material or the body's \"mass\"",
            );
        }
    } else {
        let off = |k: usize| com[k] - (from[k] + to[k]) / 2.0;
        if off(0).hypot(off(1)) > SAME * length {
            rules.complain(
                path,
                "the mass cannot be spread evenly along the axis, as the centre of mass is not in its middle",
                "give a \"material\" or a \"density\": what the bar does not have is then a lump at its own centre of mass",
            );
        }
    }
}
