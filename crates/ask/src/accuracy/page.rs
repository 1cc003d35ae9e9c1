//! Accuracy as a page.

use linkdyn_model::JointKind;
use linkdyn_model::display::Shown;
use linkdyn_picture::Shape;
use linkdyn_picture::accuracy_page::{AccuracyPage, Output, Pose, Slider, Source, Unit};
use linkdyn_picture::shape::{Clearance, JointKind as Drawn};
use linkdyn_variation::{Levels, OutputAccuracy, PoseAccuracy};

use super::Deviations;
use super::text::assumed;
use crate::ModelFile;

/// How far a parameter without tolerance can be moved, as a part of its value.
const WITHOUT_TOLERANCE: f64 = 0.01;

impl Deviations {
    /// The page.
    pub fn html(&self) -> String {
        let (file, found) = (&self.file, &self.found);
        let model = file.model();
        let unit = |shown: &Shown| Unit {
            symbol: shown.symbol.clone(),
            size: shown.size,
        };
        let first = found.outputs.iter().flat_map(|output| &output.poses).next();
        let units = first.map_or(&[][..], |pose| &pose.driver_units);
        let drivers = model.drivers.keys().zip(units);
        let sources = found.sources.iter();
        AccuracyPage {
            model: file.name(),
            about: model.about.as_deref(),
            assumed: assumed(file),
            level: match found.levels {
                Levels::First => 0,
                Levels::Worst => 1,
                Levels::Certified => 2,
            },
            length: unit(&model.display.length),
            angle: unit(&model.display.angle),
            drivers: drivers.map(|(name, unit)| (name.clone(), *unit)).collect(),
            shape: shape(file),
            sources: sources.map(|name| source(file, name)).collect(),
            outputs: found.outputs.iter().map(output).collect(),
            notes: &file.loaded.warnings,
        }
        .html()
    }
}

/// The mechanism, with the largest clearance that each pin may have, whatever its model.
fn shape(file: &ModelFile) -> Shape {
    let model = file.model();
    let mut shape = Shape::of_model(model);
    for (drawn, joint) in shape.joints.iter_mut().zip(model.joints.values()) {
        let (
            Drawn::Revolute { clearance },
            JointKind::Revolute {
                clearance: said, ..
            },
        ) = (&mut drawn.kind, &joint.kind)
        else {
            continue;
        };
        let most = said.as_ref().and_then(|said| said.limits());
        *clearance = most.filter(|[_, most]| *most > 0.0).map(|[_, radius]| {
            let model = String::from("accuracy");
            Clearance { model, radius }
        });
    }
    shape
}

/// What deviates; a parameter can be moved within its tolerance.
fn source(file: &ModelFile, name: &str) -> Source {
    let parameters = &file.loaded.parameters;
    let known = name
        .strip_prefix("parameters.")
        .and_then(|own| parameters.iter().find(|parameter| parameter.name == own));
    let slider = known.map(|parameter| {
        let range = match &parameter.tolerance {
            Some(tolerance) => [tolerance.lower.min(0.0), tolerance.upper.max(0.0)],
            None => [-1.0, 1.0].map(|side| side * WITHOUT_TOLERANCE * parameter.value.abs()),
        };
        Slider {
            value: parameter.value,
            unit: parameter.unit.clone(),
            range,
            is_tolerance: parameter.tolerance.is_some(),
        }
    });
    Source {
        name: name.to_owned(),
        slider: slider.filter(|slider| slider.range[0] < slider.range[1]),
    }
}

fn output(output: &OutputAccuracy) -> Output<'_> {
    Output {
        name: &output.name,
        of: &output.of,
        unit: output.unit,
        limits: output.limits,
        poses: output.poses.iter().map(pose).collect(),
    }
}

fn pose(pose: &PoseAccuracy) -> Pose<'_> {
    let capability = pose.capability.as_ref();
    let contributions = pose.contributions.iter();
    Pose {
        time: pose.time,
        drivers: &pose.drivers,
        nominal: pose.nominal,
        first: pose.first,
        found: pose.found,
        certified: pose.certified,
        needed: [&pose.needed[0], &pose.needed[1]],
        moments: pose.moments,
        capability: capability.map(|found| [found.within, found.cp, found.cpk]),
        pressed: pose.pressed,
        position: &pose.position,
        displaced: [0, 1].map(|side: usize| pose.displaced[side].as_deref()),
        contributions: contributions
            .map(|by| [by.sensitivity, by.reach[0], by.reach[1], by.variance])
            .collect(),
    }
}
