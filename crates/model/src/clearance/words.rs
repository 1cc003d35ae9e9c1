//! A clearance as a file has it: a radius, a range of it, or a fit.

use serde::ser::{Serialize, SerializeStruct, Serializer};

use super::{Clearance, ClearanceModel, Friction, Impact, Normal, Surface};
use crate::fit::Fit;
use crate::tolerance::Limits;

/// A clearance as a file has it.
#[derive(serde::Deserialize)]
pub struct ClearanceWords {
    model: ClearanceModel,
    #[serde(default)]
    radius: Option<Limits>,
    #[serde(default)]
    fit: Option<String>,
    #[serde(default)]
    bearing_radius: Option<f64>,
    #[serde(default)]
    axial_length: Option<f64>,
    #[serde(default)]
    normal: Option<Normal>,
    #[serde(default)]
    friction: Option<Friction>,
    #[serde(default)]
    surface: Option<Surface>,
    #[serde(default)]
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

impl Serialize for Clearance {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (radius, fit) = self.radius_words();
        let mut clearance = serializer.serialize_struct("Clearance", 9)?;
        clearance.serialize_field("model", &self.model)?;
        clearance.serialize_field("radius", &radius)?;
        clearance.serialize_field("fit", &fit)?;
        clearance.serialize_field("bearing_radius", &self.bearing_radius)?;
        clearance.serialize_field("axial_length", &self.axial_length)?;
        clearance.serialize_field("normal", &self.normal)?;
        clearance.serialize_field("friction", &self.friction)?;
        clearance.serialize_field("surface", &self.surface)?;
        clearance.serialize_field("impact", &self.impact)?;
        clearance.end()
    }
}
