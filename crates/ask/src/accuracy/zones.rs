//! Where tolerances and clearances can carry a point, to first order.
//!
//! The deviations of all sources move the point by a sum of segments (dimensions) and discs (pins), a convex zone. Along a direction u it
//! reaches h(u), the sum of what each source does to the coordinate u·r. A zone is given as the polygon of the lines u·d = h(u) for
//! [`SIDES`] directions: it holds the zone, touches it on each side, and is larger by 1/cos(π/[`SIDES`]) at most, 2 %.

use std::f64::consts::PI;

use linkdyn_engine::analysis::Control;
use linkdyn_variation::{Levels, OutputAccuracy, Scope};
use serde::Serialize;

use super::{Of, found};
use crate::editor::thinned;
use crate::{ModelFile, Unanswered};

/// Sides of the polygon of a zone.
const SIDES: usize = 16;
/// Instants at most: enough to draw.
const INSTANTS: usize = 73;

/// The zones of a point.
#[derive(Debug, Serialize)]
pub struct Zone {
    /// `body.point`.
    pub point: String,
    /// \[s\]
    pub times: Vec<f64>,
    /// Corners by instant, as deviations \[m\]; none where no first order exists.
    pub corners: Vec<Vec<[f64; 2]>>,
}

/// The zones of the points that the model lists, along its motion, at some of its instants; none where nothing is off.
///
/// # Errors
/// Why they can't be had.
pub fn zones(file: &ModelFile, control: &Control) -> Result<Vec<Zone>, Unanswered> {
    let points = &file.model().points;
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let few = thinned(file, INSTANTS);
    let file = few.as_ref().unwrap_or(file);
    let scope = Scope {
        of: Of::Points(points, SIDES / 2),
        levels: Some(Levels::First),
        threads: None,
    };
    let found = found(file, &file.loaded.parameters, scope, control)?;
    Ok(found.outputs.chunks(SIDES / 2).map(zone).collect())
}

/// The zone of a point by its coordinates along directions over half a turn.
fn zone(along: &[OutputAccuracy]) -> Zone {
    let poses = &along[0].poses;
    let reach = |k: usize, instant: usize| {
        let [down, up] = along[k % along.len()].poses[instant].first?;
        Some(if k < along.len() { up } else { -down })
    };
    let corners = |instant: usize| -> Option<Vec<[f64; 2]>> {
        let reach: Option<Vec<f64>> = (0..SIDES).map(|k| reach(k, instant)).collect();
        Some(polygon(&reach?))
    };
    let instants = 0..poses.len();
    Zone {
        point: along[0].name.clone(),
        times: poses.iter().map(|pose| pose.time).collect(),
        corners: instants.map(|k| corners(k).unwrap_or_default()).collect(),
    }
}

/// Corners of the polygon of the lines x·cos φ + y·sin φ = h(φ), φ = 2πk/n: two neighbours meet at h u + (h′ − h cos δ)/sin δ · u⊥, δ = 2π/n.
fn polygon(reach: &[f64]) -> Vec<[f64; 2]> {
    let step = 2.0 * PI / reach.len() as f64;
    let corner = |(k, &own): (usize, &f64)| {
        let next = reach[(k + 1) % reach.len()];
        let (s, c) = (step * k as f64).sin_cos();
        let beside = (next - own * step.cos()) / step.sin();
        [own * c - beside * s, own * s + beside * c]
    };
    reach.iter().enumerate().map(corner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Text;
    use linkdyn_model::FileAccess;

    /// A crank of 100 mm ± 0.2 mm, driven; a pin of clearance 0.05 mm where asked.
    fn crank(pin: &str) -> Vec<Zone> {
        let text = format!(
            r#"{{ "format": "linkdyn/1", "units": {{ "length": "mm", "angle": "deg" }}, "parameters": {{ "l": {{ "value": "100 mm", "tolerance": "0.2 mm" }} }},
            "bodies": {{ "ground": {{ "points": {{ "O": [0, 0] }} }}, "crank": {{ "points": {{ "O": [0, 0], "A": ["=l", 0] }} }} }},
            "joints": {{ "o": {{ "type": "revolute", "between": ["ground.O", "crank.O"]{pin} }} }},
            "drivers": {{ "m": {{ "type": "rotation", "body": "crank", "motion": {{ "type": "constant_velocity", "velocity": "60 rpm" }} }} }},
            "points": ["crank.A"], "analysis": {{ "type": "kinematics", "end": 1, "outputs": 9 }} }}"#
        );
        let text = Text::new(
            "a".into(),
            "a".into(),
            text.into_bytes(),
            FileAccess::default(),
        );
        let file = ModelFile::read(text, Vec::new()).expect("sound");
        zones(&file, &Control::default()).expect("zones")
    }

    #[test]
    fn the_zone_of_a_length_is_a_segment_along_the_crank() {
        let [zone] = &crank("")[..] else {
            panic!("one point")
        };
        assert_eq!(
            (&*zone.point, zone.times.len(), zone.corners.len()),
            ("crank.A", 9, 9)
        );
        for (time, corners) in zone.times.iter().zip(&zone.corners) {
            let (s, c) = (2.0 * PI * time).sin_cos();
            for [x, y] in corners {
                assert!((x * c + y * s).abs() < 2e-4 * 1.03, "{x} {y} at {time}");
                // The nearest of 16 directions is π/16 away at most.
                assert!((y * c - x * s).abs() < 2e-4 * (PI / 16.0).tan() + 1e-12);
            }
            let far = corners.iter().map(|[x, y]| x * c + y * s);
            assert!((far.fold(0.0, f64::max) - 2e-4).abs() < 5e-6);
        }
    }

    #[test]
    fn a_pin_adds_a_disc() {
        let pin = r#", "clearance": { "model": "massless_link", "radius": "50 um" }"#;
        let [plain, loose] = [crank(""), crank(pin)].map(|mut zones| zones.remove(0));
        let area = |corners: &[[f64; 2]]| -> f64 {
            let next = corners.iter().cycle().skip(1);
            let cross = corners
                .iter()
                .zip(next)
                .map(|(a, b)| a[0] * b[1] - a[1] * b[0]);
            cross.sum::<f64>() / 2.0
        };
        // A polygon around a disc of radius r has n r² tan(π/n); around the sum with a segment of length l, 2 r l more (along an axis).
        let (r, l) = (5e-5, 4e-4);
        let sum = 16.0 * r * r * (PI / 16.0).tan() + 2.0 * r * l;
        let found = area(&loose.corners[0]);
        assert!((found / sum - 1.0).abs() < 1e-9, "{found:e} {sum:e}");
        assert!(area(&plain.corners[0]).abs() < 1e-15);
    }
}
