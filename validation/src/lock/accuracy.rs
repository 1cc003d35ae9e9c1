//! How far clearances can carry θ2 at all, and what that says of the paper's table: a bound that depends on no load and no
//! model of clearance.
//!
//! At each output of the stroke every hinge may stand anywhere in its clearance. The mean over the stroke of the farthest
//! |Δθ2| is the greatest possible mean deviation; `validation/accuracy-lock` has it with 40 digits.

use serde_json::{Value, json};

use super::document::{broken, bundled};
use super::models::{JOINTS, Quantity, RADII};
use super::table::Paper;
use crate::{CaseError, Claim, Verdict};
use linkdyn_engine::analysis::Control;
use linkdyn_variation::{Accuracy, Parameters, Refusal, Scope, accuracy};

/// Relative difference from the reference that is allowed. At a few of the 1751 poses beside the change point several stationary
/// positions compete: at 118° with 10 µm and at 119° with 100 µm ours is the farther one, by 0.3 and 4.6 %, elsewhere the
/// reference's. Where the largest are, both agree to round-off.
const ALLOWED: f64 = 2e-4;
const REASON: &str = "It is above the mean of the farthest positions that the hinges allow at all, whatever presses them: how the \
     paper's mean is formed is not known.";

/// The greatest possible mean and the largest |Δθ2| \[rad\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    pub mean: f64,
    pub largest: f64,
}

/// The claims about both clearances.
///
/// # Errors
/// When the engine or the reference can't be had.
pub fn claims(paper: &Paper, control: &Control) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for (index, radius) in RADII.into_iter().enumerate() {
        let ours = bound(radius, control)?;
        let reference = reference(index)?;
        for (word, ours, reference) in [
            ("mean", ours.mean, reference.mean),
            ("largest", ours.largest, reference.largest),
        ] {
            let off = (ours / reference - 1.0).abs();
            claims.push(Claim {
                what: format!("greatest possible |deviation| of theta2 [rad], {word} over the stroke, at {radius} um, against the calculation with 40 digits"),
                reference: format!("{reference:.10}"),
                ours: format!("{ours:.10}"),
                difference: format!("{off:.1e} (allowed {ALLOWED:.0e})"),
                verdict: if off <= ALLOWED { Verdict::Agrees } else { Verdict::Fault },
            });
        }
        let [largest, mean] = paper.deviation(index, Quantity::Theta2);
        for (word, printed, possible) in [("mean", mean, ours.mean), ("max", largest, ours.largest)]
        {
            claims.push(Claim {
                what: format!("printed {word} |deviation| of theta2 [rad] at {radius} um is possible, whatever presses the hinges"),
                reference: format!("{printed}"),
                ours: format!("at most {possible:.5}"),
                difference: format!("factor {:.2} of what is possible", printed / possible),
                verdict: if printed <= possible { Verdict::Agrees } else { Verdict::Finding(REASON) },
            });
        }
    }
    Ok(claims)
}

/// Of the bundled lock with clearances of `radius` \[µm\] in all hinges, nothing else being off.
fn bound(radius: f64, control: &Control) -> Result<Bound, CaseError> {
    let mut document = bundled()?;
    for joint in JOINTS {
        document["joints"][joint]["clearance"]["radius"] = json!(format!("{radius} um"));
    }
    if let Some(driver) = document["drivers"]["motor"].as_object_mut() {
        driver.remove("tolerance");
    }
    document["accuracy"] = json!({ "outputs": { "theta2": { "column": "link2.angle" } } });
    let loaded = linkdyn_model::load(document.to_string().as_bytes(), &[]);
    let loaded = loaded.map_err(|said| broken(format!("{said:?}")))?;
    let dependence = loaded.source.dependence();
    let parameters = Parameters {
        all: &loaded.parameters,
        derivatives: &dependence.at(&[]),
        enclosed: &|| dependence.within(&[]),
        with: &|_| None,
    };
    let found = accuracy(&loaded.model, &parameters, Scope::default(), control);
    let found: Accuracy = found.map_err(|refusal| match refusal {
        Refusal::Input(complaints) => broken(format!("{complaints:?}")),
        Refusal::Failed(message) => broken(message),
    })?;
    let poses = &found.outputs[0].poses;
    let farthest = |found: [Option<f64>; 2]| match found {
        [Some(low), Some(high)] => Ok(high.max(-low)),
        _ => Err(broken("a pose without a farthest position")),
    };
    let all: Vec<f64> = poses
        .iter()
        .map(|pose| farthest(pose.found))
        .collect::<Result<_, _>>()?;
    Ok(Bound {
        mean: all.iter().sum::<f64>() / all.len() as f64,
        largest: all.iter().copied().fold(0.0, f64::max),
    })
}

/// The reference of clearance `index`.
fn reference(index: usize) -> Result<Bound, CaseError> {
    let text = include_str!("../../accuracy-lock/expected.json");
    let value: Value = serde_json::from_str(text).map_err(broken)?;
    let number = |key: &str| -> Result<f64, CaseError> {
        let digits = value["stroke"][index][key]
            .as_str()
            .ok_or_else(|| broken(key))?;
        digits.parse().map_err(broken)
    };
    Ok(Bound {
        mean: number("mean")?,
        largest: number("largest")?,
    })
}
