//! Elastic links: what they are made of, that their points are on their axis, and that their bodies weigh what they weigh.

use super::{Rules, sections};
use crate::display::number;
use crate::elastic::{ElasticLink, ModalData};
use crate::error::Complaint;
use crate::{Body, JointKind, SectionShape, suggest};

/// Masses and places that differ by less are the same, relative to the bar's.
const SAME: f64 = 1e-6;
/// Height by length beyond which a bar is no slender one.
const THICK: f64 = 0.1;

/// All rules of elastic links but those on one number.
pub(super) fn links(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, body) in &model.bodies {
        let path = format!("bodies.{name}.elastic");
        let Some(elastic) = &body.elastic else {
            continue;
        };
        if rules.holes.within(&path) || rules.holes.has(&path) {
            continue;
        }
        let before = rules.complaints.len();
        if !belongs(rules, &path, elastic) {
            continue;
        }
        if let Some(shape) = elastic.section {
            sections::of_shape(rules, &format!("{path}.section"), shape);
        }
        let axis = sections::axis(rules, &path, body, [&elastic.from, &elastic.to]);
        if let Some(modal) = &elastic.modal {
            matrices(rules, &path, body, modal);
        } else {
            made_of(rules, &path, elastic);
            if let Some(axis) = axis {
                points(rules, name, body, axis);
                slender(rules, &path, elastic, axis);
                cracks(rules, &path, elastic, axis);
            }
        }
        let known = ["mass", "inertia", "com", "points"]
            .iter()
            .all(|key| !rules.holes.within(&format!("bodies.{name}.{key}")));
        if rules.complaints.len() == before && known {
            weight(rules, name, body);
            cut(rules, name, body, elastic);
        }
    }
}

/// Outlines of contacts and profiles of cams keep their shape.
pub(super) fn outlines(rules: &mut Rules<'_>) {
    let model = rules.model;
    for (name, joint) in &model.joints {
        let what = if matches!(joint.kind, JointKind::Contact { .. }) {
            "outline"
        } else if matches!(joint.kind, JointKind::Cam(_)) {
            "profile"
        } else {
            continue;
        };
        let path = format!("joints.{name}.between[0]");
        let owner = &joint.between[0].body;
        let body = model.bodies.get(owner);
        if body.is_some_and(|body| body.elastic.is_some())
            && !rules.holes.has(&path)
            && !rules.holes.has(&format!("joints.{name}.type"))
        {
            rules.complain(
                path,
                format!("{owner:?} is elastic, and would bend the {what}"),
                format!("give the {what} to a rigid body, which a fixed joint holds at a point of {owner:?}"),
            );
        }
    }
}

/// Keys that mean nothing beside what describes the link; whether all fit.
fn belongs(rules: &mut Rules<'_>, path: &str, elastic: &ElasticLink) -> bool {
    let of_bar = [
        ("material", elastic.material.is_some()),
        ("young_modulus", elastic.young_modulus.is_some()),
        ("density", elastic.density.is_some()),
    ];
    let of_numbers = [
        ("axial_stiffness", elastic.axial_stiffness.is_some()),
        ("mass_per_length", elastic.mass_per_length.is_some()),
    ];
    let of_modes = [
        ("modes", elastic.modes.is_some()),
        ("frame", elastic.frame.is_some()),
        ("axial", elastic.axial.is_some()),
        ("foreshortening", elastic.foreshortening.is_some()),
        ("cracks", elastic.cracks.is_some()),
    ];
    let of_start = [
        ("amplitudes", elastic.amplitudes.is_some()),
        ("rates", elastic.rates.is_some()),
    ];
    let mut fits = true;
    let mut refuse = |keys: &[(&str, bool)], why: &str, hint: &str| {
        for (key, _) in keys.iter().filter(|(_, is_there)| *is_there) {
            rules.complain(format!("{path}.{key}"), format!("{why} {key:?}"), hint);
            fits = false;
        }
    };
    if elastic.modal.is_some() {
        let elements = [("elements", elastic.elements.is_some())];
        for keys in [&of_bar[..], &of_numbers, &of_modes, &elements] {
            let hint = "leave it out: the matrices of \"modal\" say all of this";
            refuse(keys, "beside \"modal\" there is no", hint);
        }
        return fits;
    }
    if elastic.section.is_some() {
        let hint =
            "leave it out: it follows from the cross-section and from what the link is made of";
        refuse(&of_numbers, "beside \"section\" there is no", hint);
    } else {
        let hint = "give \"mass_per_length\" and, where it stretches, \"axial_stiffness\"; or a \"section\" instead of \"bending_stiffness\"";
        refuse(&of_bar, "beside \"bending_stiffness\" there is no", hint);
    }
    if elastic.elements.is_some() {
        let hint = "elements bend and stretch between nodes with places of their own; leave it out, or give \"modes\" instead of \"elements\"";
        refuse(&of_modes, "a chain of elements has no", hint);
        refuse(&of_start, "a chain of elements has no", hint);
    }
    fits
}

/// A bar needs a modulus and a density, or its stiffness and its mass.
fn made_of(rules: &mut Rules<'_>, path: &str, elastic: &ElasticLink) {
    let given = [
        ("young_modulus", elastic.young_modulus.is_some()),
        ("density", elastic.density.is_some()),
    ];
    if elastic.section.is_none() {
        if elastic.mass_per_length.is_none() {
            rules.complain(
                path,
                "\"mass_per_length\" is missing beside \"bending_stiffness\"",
                "as in \"mass_per_length\": \"0.5 kg/m\"",
            );
        }
        let stretches = elastic.axial == Some(true) || elastic.elements.is_some();
        if stretches && elastic.axial_stiffness.is_none() {
            rules.complain(
                path,
                "\"axial_stiffness\" is missing for a link that stretches",
                "as in \"axial_stiffness\": \"1e7 N\"",
            );
        }
    } else if elastic.material.is_some() {
        for (key, _) in given.iter().filter(|(_, is_there)| *is_there) {
            rules.complain(
                format!("{path}.{key}"),
                format!("the \"material\" has its own {key}"),
                "give either the material, or \"young_modulus\" and \"density\"",
            );
        }
    } else if let Some((key, _)) = given.iter().find(|(_, is_there)| !is_there) {
        rules.complain(
            path,
            format!("it is not known what the link is made of: {key:?} is missing"),
            "add \"material\": \"steel\", or \"young_modulus\": \"210 GPa\" and \"density\": \"7850 kg/m^3\"",
        );
    }
}

/// Cracks are in a rectangle, between its ends.
fn cracks(rules: &mut Rules<'_>, path: &str, elastic: &ElasticLink, [from, to]: [[f64; 2]; 2]) {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let Some(cracks) = &elastic.cracks else {
        return;
    };
    if !matches!(elastic.section, Some(SectionShape::Rectangle { .. })) {
        rules.complain(
            format!("{path}.cracks"),
            "how much a crack yields is known of a rectangle alone",
            "give the \"section\" as a \"rectangle\"",
        );
    }
    for (index, crack) in cracks.iter().enumerate() {
        if crack.at >= length {
            let length = rules.model.display.length_to(length, 5);
            rules.complain(
                format!("{path}.cracks[{index}].at"),
                format!("the link ends at {length}"),
                "give the place of the crack between both ends",
            );
        }
    }
}

/// A thick bar shears, which it does not here.
fn slender(rules: &mut Rules<'_>, path: &str, elastic: &ElasticLink, [from, to]: [[f64; 2]; 2]) {
    let Some(shape) = elastic.section else { return };
    let (area, moment) = (shape.area(), shape.second_moment());
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    // Of a rectangle its height.
    let height = (12.0 * moment / area).sqrt();
    if height > THICK * length {
        rules.warnings.push(
            Complaint::new(
                path,
                format!(
                    "the link is {} times as long as it is high, and shears, which is left out",
                    number(length / height, 3)
                ),
            )
            .hint("a link ten times as long as it is high is about right to 3 %"),
        );
    }
}

/// Points of an elastic bar are on its axis.
fn points(rules: &mut Rules<'_>, name: &str, body: &Body, [from, to]: [[f64; 2]; 2]) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    for (point, place) in &body.points {
        let off = [place[0] - from[0], place[1] - from[1]];
        let s = (off[0] * along[0] + off[1] * along[1]) / length;
        let across = (along[0] * off[1] - along[1] * off[0]) / length;
        let display = &rules.model.display;
        let message = if across.abs() > SAME * length {
            format!(
                "the point is {} beside the axis of the elastic link",
                display.length_to(across.abs(), 5)
            )
        } else if s < -SAME * length || s > (1.0 + SAME) * length {
            "the point is beyond the ends of the elastic link".to_owned()
        } else {
            continue;
        };
        rules.complain(
            format!("bodies.{name}.points.{point}"),
            message,
            "give it to a rigid body, which a fixed joint holds at a point of the axis",
        );
    }
}

/// What a body says of its mass is what the bar weighs.
fn weight(rules: &mut Rules<'_>, name: &str, body: &Body) {
    let Some((mass, inertia, com)) = body.of_bar() else {
        return;
    };
    let display = &rules.model.display;
    let is_off =
        |given: Option<f64>, own: f64| given.filter(|given| (given - own).abs() > SAME * own.abs());
    let mut said = Vec::new();
    if let Some(given) = is_off(body.mass, mass) {
        let [own, given] = [mass, given].map(|mass| display.mass_to(mass, 7));
        said.push((
            "mass",
            format!("the elastic link weighs {own}, and not {given}"),
        ));
    }
    if let Some(given) = is_off(body.inertia, inertia) {
        let [own, given] = [inertia, given].map(|inertia| number(inertia, 7));
        said.push((
            "inertia",
            format!("the elastic link has an inertia of {own} kg·m², and not of {given} kg·m²"),
        ));
    }
    let length = body
        .elastic
        .as_deref()
        .and_then(|elastic| elastic.ends(body))
        .map_or(0.0, |[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]));
    let off = body
        .com
        .map_or(0.0, |given| (given[0] - com[0]).hypot(given[1] - com[1]));
    if off > SAME * length {
        let off = display.length_to(off, 5);
        let message = format!("it is {off} away from the middle of the elastic link");
        said.push(("com", message));
    }
    let hint = "leave it out, or correct what the link is made of; further masses are bodies of their own, held by fixed joints";
    for (key, message) in said {
        rules.complain(format!("bodies.{name}.{key}"), message, hint);
    }
}

/// Internal forces are those of the bar that bends.
fn cut(rules: &mut Rules<'_>, name: &str, body: &Body, elastic: &ElasticLink) {
    let Some(section) = &body.section else { return };
    let path = format!("bodies.{name}.section");
    if elastic.elements.is_some() || elastic.modal.is_some() {
        let what = if elastic.modal.is_some() {
            "modal data"
        } else {
            "a chain of elements"
        };
        rules.complain(
            path,
            format!("the internal forces of {what} are not computed"),
            "leave out \"section\", or describe the elastic link by a cross-section and \"modes\"",
        );
    } else if [&section.from, &section.to] != [&elastic.from, &elastic.to] {
        rules.complain(
            path,
            "the axis of \"section\" is not that of \"elastic\"",
            "give both the same \"from\" and \"to\"",
        );
    }
}

/// Matrices have one size, and points are points of the body.
fn matrices(rules: &mut Rules<'_>, path: &str, body: &Body, modal: &ModalData) {
    let n = modal.mass.len();
    let path = format!("{path}.modal");
    let square = |matrix: &[Vec<f64>]| matrix.len() == n && matrix.iter().all(|row| row.len() == n);
    let symmetric = |matrix: &[Vec<f64>], sign: f64| {
        let largest = matrix
            .iter()
            .flatten()
            .fold(0.0, |m: f64, x| m.max(x.abs()));
        let entries = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let off = entries.map(|(i, j)| (matrix[i][j] - sign * matrix[j][i]).abs());
        off.fold(0.0, f64::max) <= 1e-9 * largest
    };
    let all = [
        ("mass", Some(&modal.mass), 1.0),
        ("stiffness", Some(&modal.stiffness), 1.0),
        ("damping", modal.damping.as_ref(), 1.0),
        ("gyroscopic", modal.gyroscopic.as_ref(), -1.0),
    ];
    for (key, matrix, sign) in all {
        let Some(matrix) = matrix else { continue };
        if !square(matrix) {
            rules.complain(
                format!("{path}.{key}"),
                format!("the matrix is not {n} by {n}"),
                "all matrices have as many rows and columns as \"mass\" has rows",
            );
        } else if !symmetric(matrix, sign) {
            let (what, hint) = match sign > 0.0 {
                true => ("symmetric", "entry [i][j] equals entry [j][i]"),
                false => ("antisymmetric", "entry [i][j] is minus entry [j][i]"),
            };
            rules.complain(
                format!("{path}.{key}"),
                format!("the matrix is not {what}"),
                hint,
            );
        }
    }
    let mut lists = vec![
        ("momentum".to_owned(), modal.momentum.len()),
        ("radial".to_owned(), modal.radial.len()),
        ("angular_momentum".to_owned(), modal.angular_momentum.len()),
    ];
    for (point, own) in &modal.points {
        lists.push((
            format!("points.{point}.displacement"),
            own.displacement.len(),
        ));
        lists.push((format!("points.{point}.rotation"), own.rotation.len()));
        if !body.points.contains_key(point) {
            rules.complain(
                format!("{path}.points.{point}"),
                format!("the body has no point {point:?}"),
                format!("its points: {}", suggest::list(body.points.keys())),
            );
        }
    }
    for (key, count) in lists.iter().filter(|(_, count)| *count != n) {
        rules.complain(
            format!("{path}.{key}"),
            format!("a list of {n} is expected, this one has {count}"),
            "there is one amplitude for each row of \"mass\"",
        );
    }
    for (key, lacks) in [
        ("mass", body.mass.is_none()),
        ("inertia", body.inertia.is_none()),
    ] {
        if lacks {
            let owner = path.trim_end_matches(".elastic.modal");
            rules.complain(
                owner,
                format!("{key:?} is missing beside the modal data"),
                "give mass, inertia and centre of mass of the body where it is not deflected",
            );
        }
    }
}
