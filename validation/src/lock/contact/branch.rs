//! Which branch a motion follows beyond the change point.
//!
//! At the change point two branches of the ideal first loop cross. On the smooth one its coupler c goes through between links 3 and 4
//! (θ4 − θ3 passes 180°); on the other one it turns back (θ4 − θ3 stays below 180°), and that branch ends in a dead centre of
//! its own a little further on, so that at the end of the stroke the smooth branch is the only one near.

use serde_json::{Value, json};

use super::super::document::broken;
use super::super::models::{Request, Stroke, run};
use super::super::table::NEAR_CHANGE_POINT;
use super::strokes::is_whole;
use crate::CaseError;
use linkdyn_engine::analysis::Control;
use linkdyn_linear::math::Vec2;
use linkdyn_output::{EventKind, Status};

/// Where the other branch ends \[deg\]: 50 digits, `other_branch` in validation/generate/lock.py.
pub const OTHER_END: f64 = 118.162_183_358_957_5;
/// Largest difference allowed to it \[deg\], that of every dead centre here.
pub const OTHER_END_WITHIN: f64 = 1e-6;
/// A pose of the other branch: θ2 … θ6 \[deg\], rounded; the assembly closes it.
const OTHER: [f64; 5] = [184.659, 3.236, 178.475, 155.801, 118.0];
/// θ2 within this of the ideal one at the end of the stroke counts as on the smooth branch \[deg\]; clearances of 100 µm move
/// links of 200 mm by a hundredth of this.
pub const NEAR: f64 = 3.0;
/// θ4 − θ3 within this of 180° at the last output of a stroke that stops counts as collinear \[deg\]: outputs are 0.1° of θ6 apart,
/// and it changes by some 2° per degree of θ6.
pub const IN_LINE: f64 = 1.0;

/// Where a motion went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// Whether it came to the end of the stroke.
    pub is_whole: bool,
    /// Its last output \[deg\].
    pub last: f64,
    /// θ2 there, and the ideal one \[deg\].
    pub theta2: [f64; 2],
    /// θ4 − θ3 there \[deg\]: 180° where the first loop is collinear.
    pub between: f64,
    /// Largest |Δθ2| from the change point on \[deg\], and where \[deg\]; none without an output there.
    pub farthest: Option<[f64; 2]>,
}

impl Branch {
    /// Of a stroke with clearance.
    ///
    /// # Errors
    /// When columns or rows are missing.
    pub fn of(stroke: &Stroke, ideal: &Stroke) -> Result<Self, CaseError> {
        let angles = |stroke: &Stroke, link: &str| {
            stroke
                .trajectory
                .values(&format!("{link}.angle"))
                .ok_or_else(|| broken(format!("{link} has no angle")))
        };
        let (with, without) = (angles(stroke, "link2")?, angles(ideal, "link2")?);
        let (three, four) = (angles(stroke, "link3")?, angles(stroke, "link4")?);
        let last = stroke
            .theta6
            .len()
            .checked_sub(1)
            .ok_or_else(|| broken("a stroke without rows"))?;
        let away = stroke
            .theta6
            .iter()
            .enumerate()
            .filter(|(_, theta6)| **theta6 > NEAR_CHANGE_POINT);
        let away =
            away.map(|(row, &theta6)| [(with[row] - without[row]).to_degrees().abs(), theta6]);
        Ok(Branch {
            is_whole: is_whole(stroke),
            last: stroke.theta6[last],
            theta2: [with[last], without[last]].map(f64::to_degrees),
            between: (four[last] - three[last]).to_degrees(),
            farthest: away.max_by(|a, b| a[0].total_cmp(&b[0])),
        })
    }

    /// Whether it came to the end, on the smooth branch.
    pub fn is_smooth(&self) -> bool {
        self.is_whole && (self.theta2[0] - self.theta2[1]).abs() <= NEAR && self.between > 180.0
    }

    /// Whether it stopped where the first loop is collinear.
    pub fn stops_in_line(&self) -> bool {
        !self.is_whole && (self.between - 180.0).abs() <= IN_LINE
    }

    /// In a word.
    pub fn word(&self) -> &'static str {
        if self.is_smooth() {
            "smooth"
        } else if self.is_whole {
            "another"
        } else if self.stops_in_line() {
            "stops in line"
        } else {
            "stops"
        }
    }
}

/// Where the ideal lock stops on the other branch \[deg\].
///
/// # Errors
/// When it does not end in a dead centre.
pub fn other_end(control: &Control) -> Result<f64, CaseError> {
    let mut document = Request::ideal(0.1).document()?;
    pose(&mut document)?;
    document["drivers"]["motor"]["motion"]["start"] = json!(format!("{} deg", OTHER[4]));
    document["analysis"]["sample"]["from"] = json!(format!("{} deg", OTHER[4]));
    let (_, outcome) = run(&document, control)?;
    let dead = outcome
        .report
        .events
        .iter()
        .find(|event| event.kind == EventKind::DeadCentre)
        .and_then(|event| event.value);
    match (outcome.report.status, dead) {
        (Status::DeadCentre, Some(value)) => Ok(value.to_degrees()),
        (status, _) => Err(broken(format!(
            "the other branch ended otherwise: {status:?}"
        ))),
    }
}

/// Puts the links where the other branch has them.
fn pose(document: &mut Value) -> Result<(), CaseError> {
    let point = |document: &Value, body: &str, name: &str| -> Result<Vec2, CaseError> {
        let [x, y] = serde_json::from_value(document["bodies"][body]["points"][name].clone())
            .map_err(broken)?;
        Ok(Vec2::new(x, y))
    };
    let turned = |v: Vec2, degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
    };
    let b = turned(point(document, "link2", "b")?, OTHER[0]);
    let f = b + turned(point(document, "link3", "f")?, OTHER[1]);
    let e = f + turned(point(document, "link6", "e")?, OTHER[4]);
    let g = point(document, "ground", "g")?;
    for (body, place, angle) in [
        ("link2", Vec2::zeros(), OTHER[0]),
        ("link3", b, OTHER[1]),
        ("link4", g, OTHER[2]),
        ("link5", e, OTHER[3]),
        ("link6", f, OTHER[4]),
    ] {
        document["bodies"][body]["pose"] =
            json!({ "position": [place.x, place.y], "angle": angle });
    }
    Ok(())
}
