//! A clearance as a file has it: a radius, a range of it, or a fit.

use super::{Clearance, ClearanceModel, Friction, Impact, Normal, Surface};
use crate::fit::Fit;
use crate::tolerance::Limits;

/// A clearance as a file has it.
#[derive(serde::Deserialize, serde::Serialize)]
pub struct ClearanceWords {
    model: ClearanceModel,
    radius: Option<Limits>,
    fit: Option<String>,
    bearing_radius: Option<f64>,
    axial_length: Option<f64>,
    normal: Option<Normal>,
    friction: Option<Friction>,
    surface: Option<Surface>,
    impact: Option<Impact>,
}

/// The radius that counts where only one does.
pub fn mean([least, most]: [f64; 2]) -> f64 {
    0.5 * (least + most)
}

impl From<ClearanceWords> for Clearance {
    fn from(words: ClearanceWords) -> Self {
        // a fit that can't be read, or is tight, is refused by the gate
        let fitted = || Fit::parse(words.fit.as_deref()?).ok()?.radial().ok();
        let (radius, range) = match words.radius {
            Some(Limits::One(radius)) => (Some(radius), None),
            Some(Limits::Both(range)) => (Some(mean(range)), Some(range)),
            None => {
                let range = fitted();
                (range.map(mean), range)
            }
        };
        Clearance {
            model: words.model,
            radius,
            range,
            fit: words.fit,
            bearing_radius: words.bearing_radius,
            axial_length: words.axial_length,
            normal: words.normal,
            friction: words.friction,
            surface: words.surface,
            impact: words.impact,
        }
    }
}

impl Clearance {
    /// What a file says of the radius.
    fn radius_words(&self) -> (Option<Limits>, Option<&str>) {
        let range = self.range.filter(|range| Some(mean(*range)) == self.radius);
        let fitted = || self.read_fit()?.radial().ok();
        match (&self.fit, self.radius) {
            // one that says nothing else, or whose fault is to be found
            (Some(fit), radius) if fitted() == range || radius.is_none() => (None, Some(fit)),
            (_, radius) => (range.map(Limits::Both).or(radius.map(Limits::One)), None),
        }
    }
}

impl From<Clearance> for ClearanceWords {
    fn from(clearance: Clearance) -> Self {
        let (radius, fit) = clearance.radius_words();
        ClearanceWords {
            fit: fit.map(str::to_owned),
            radius,
            model: clearance.model,
            bearing_radius: clearance.bearing_radius,
            axial_length: clearance.axial_length,
            normal: clearance.normal,
            friction: clearance.friction,
            surface: clearance.surface,
            impact: clearance.impact,
        }
    }
}
