//! Outlines of contacts, told otherwise.

use linkdyn_model::JointKind;

/// The outline of a contact at other places of the first body's frame.
pub fn move_outline(kind: &mut JointKind, moved: impl Fn([f64; 2]) -> [f64; 2]) {
    if let JointKind::Contact { outline, .. } = kind {
        for node in outline {
            let place = moved([node[0], node[1]]);
            node[..2].copy_from_slice(&place);
        }
    }
}

/// A contact with the outline or the tip on the ground, about whose origin all is turned.
pub fn turn_contact(kind: &mut JointKind, [first, second]: [bool; 2], by: f64) {
    if first {
        let (sin, cos) = by.sin_cos();
        move_outline(kind, |[x, y]| [cos * x - sin * y, sin * x + cos * y]);
    }
    if let (true, JointKind::Contact { arc: Some(arc), .. }) = (second, kind) {
        *arc = arc.map(|angle| angle + by);
    }
}

/// A contact behind a mirror, x ↦ −x: its outline runs the other way, and the material is on the left again.
pub fn mirror_outline(kind: &mut JointKind) {
    move_outline(kind, |[x, y]| [-x, y]);
    let JointKind::Contact { outline, arc, .. } = kind else {
        return;
    };
    // The arc that led to a point leads to the one before it.
    let radii: Vec<Option<f64>> = outline.iter().map(|node| node.get(2).copied()).collect();
    outline.reverse();
    for (node, radius) in outline.iter_mut().skip(1).zip(radii.iter().skip(1).rev()) {
        node.truncate(2);
        node.extend(radius);
    }
    outline[0].truncate(2);
    *arc = arc.map(|[from, to]| [std::f64::consts::PI - to, std::f64::consts::PI - from]);
}
