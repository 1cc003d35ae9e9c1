//! Volumes and inertias of solid shapes, in the axes of their own frame.
//!
//! ```text
//! sphere     4/3 π r³      2/5 r²
//! ellipsoid  4/3 π a b c   (b² + c²)/5, …
//! box        8 a b c       (b² + c²)/3, …                        half edges a, b, c
//! cylinder   2 π r² h      (3 r² + 4 h²)/12 across, r²/2 along   half length h
//! capsule    a cylinder and two half balls, whose centres of mass are 3/8 r beyond its ends
//! ```

use std::f64::consts::PI;

/// How many numbers the size of a shape has; nothing where there is no such shape.
pub(super) fn size(kind: &str) -> Option<usize> {
    match kind {
        "sphere" => Some(1),
        "cylinder" | "capsule" => Some(2),
        "box" | "ellipsoid" => Some(3),
        _ => None,
    }
}

/// Volume \[m³\], and moments of inertia by the mass \[m²\], of a shape of this size.
pub(super) fn solid(kind: &str, size: &[f64]) -> (f64, [f64; 3]) {
    let ball = |r: f64| 4.0 / 3.0 * PI * r.powi(3);
    let across = |r: f64, h: f64| (3.0 * r * r + 4.0 * h * h) / 12.0;
    let edges = |[a, b, c]: [f64; 3], n: f64| {
        let [a, b, c] = [a * a, b * b, c * c];
        [(b + c) / n, (a + c) / n, (a + b) / n]
    };
    match (kind, size) {
        ("ellipsoid", &[a, b, c, ..]) => (4.0 / 3.0 * PI * a * b * c, edges([a, b, c], 5.0)),
        ("box", &[a, b, c, ..]) => (8.0 * a * b * c, edges([a, b, c], 3.0)),
        ("cylinder", &[r, h, ..]) => (
            2.0 * PI * r * r * h,
            [across(r, h), across(r, h), r * r / 2.0],
        ),
        ("capsule", &[r, h, ..]) => {
            let (tube, ends) = (2.0 * PI * r * r * h, ball(r));
            let along = tube * r * r / 2.0 + ends * 0.4 * r * r;
            let about = tube * across(r, h) + ends * (0.4 * r * r + h * h + 0.75 * h * r);
            let volume = tube + ends;
            (volume, [about / volume, about / volume, along / volume])
        }
        (_, &[r, ..]) => (ball(r), [0.4 * r * r; 3]),
        (_, []) => (0.0, [0.0; 3]),
    }
}
