//! What a question about forces needs of a model: masses, laws without a history, and the model with its sources off.

use super::super::forces::Making;
use super::super::source::{Acts, Room, Source};
use super::parameters::Followed;
use linkdyn_engine::analysis::Stop;
use linkdyn_engine::analysis::driven;
use linkdyn_engine::system::{
    System,
    compile::{compile, compile_geometry},
};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{AnalysisKind, Checked, ClearanceModel, JointKind, Model};

/// What forces can't be asked of.
///
/// # Errors
/// Journals that move freely, friction with a history or of a slow motion, masses that are missing.
pub(super) fn refuse(
    model: &Model,
    ideal: &Checked,
    system: &System,
    at_rest: bool,
) -> Result<(), Complaints> {
    let contact = |(name, joint): (&String, &linkdyn_model::Joint)| {
        let JointKind::Revolute { clearance, .. } = &joint.kind else {
            return None;
        };
        match clearance.as_ref()?.model {
            ClearanceModel::Ideal | ClearanceModel::MasslessLink => None,
            ClearanceModel::TwoState | ClearanceModel::ThreeState | ClearanceModel::Contact => {
                let path = format!("joints.{name}.clearance.model");
                let message = "a journal that moves freely in its bearing has impacts: forces with it have no derivative";
                let hint = "use \"ideal\" or \"massless_link\" here, or many runs for the scatter";
                Some(Complaint::new(path, message).hint(hint))
            }
        }
    };
    let is_slow = (ideal.analysis.as_ref())
        .is_some_and(|analysis| analysis.kind == AnalysisKind::QuasiStatics);
    let rubs = |(name, joint): (&String, &linkdyn_model::Joint)| {
        joint.kind.friction().filter(|_| is_slow)?;
        let path = format!("joints.{name}.friction");
        let message =
            "accuracy of forces at rest leaves friction out, and \"quasi_statics\" has it";
        let hint = "ask in \"inverse_dynamics\", or take the friction out";
        Some(Complaint::new(path, message).hint(hint))
    };
    let mut faults: Vec<Complaint> = model.joints.iter().filter_map(contact).collect();
    faults.extend(model.joints.iter().filter_map(rubs));
    if !faults.is_empty() {
        return Err(Complaints(faults));
    }
    let kind = if at_rest {
        AnalysisKind::Statics
    } else {
        AnalysisKind::InverseDynamics
    };
    compile(ideal, kind)?;
    match driven::refuse(system, !at_rest, false) {
        Err(Stop::Input(faults)) => Err(faults.into()),
        Ok(()) | Err(Stop::Failed { .. }) => Ok(()),
    }
}

/// The system with parameters and zones off.
pub(super) fn making<'a>(ideal: &'a Checked, followed: &'a Followed<'a>) -> Box<Making<'a>> {
    let zones = ideal.bodies.iter();
    let zones = zones.flat_map(|(body, data)| {
        let points = data.point_tolerances.keys();
        points.map(move |point| (body.as_str(), point.as_str()))
    });
    let zones: Vec<(&str, &str)> = zones.collect();
    Box::new(move |deviations, shifts| {
        let given = followed.parameters.iter().zip(deviations);
        let given = given.filter(|(_, by)| **by != 0.0);
        let given: Vec<(usize, f64)> = given.map(|((index, _), by)| (*index, *by)).collect();
        let mut off = if given.is_empty() {
            ideal.clone()
        } else {
            (followed.of.with)(&given)?.with_clearances(|_| false)
        };
        if shifts.iter().flatten().any(|shift| *shift != 0.0) {
            let move_points = |model: &mut Model| {
                for (&(body, point), shift) in zones.iter().zip(shifts) {
                    let place = model
                        .bodies
                        .get_mut(body)
                        .and_then(|body| body.points.get_mut(point));
                    if let Some(place) = place {
                        *place = [place[0] + shift[0], place[1] + shift[1]];
                    }
                }
            };
            off = off.edit(move_points).ok()?;
        }
        compile_geometry(&off).ok()
    })
}

/// What the number of each source is measured by [SI]: a step of a small part of it changes little.
pub(super) fn scales(system: &System, sources: &[Source], followed: &Followed) -> Vec<f64> {
    let mut parameters = followed.parameters.iter();
    let scale = |source: &Source| match (&source.acts, source.room) {
        (Acts::Row(row), Room::Line(_)) => system.row_scale(*row),
        (Acts::Row(_) | Acts::Point(_), _) => system.size,
        (Acts::Dimensions { .. }, _) => {
            let own = parameters.next().map(|(index, _)| &followed.of.all[*index]);
            let (size, unit) = own.map_or((0.0, ""), |own| (own.value.abs(), own.unit.as_str()));
            match unit {
                "m" if size < 0.1 * system.size => size.max(0.05 * system.size),
                "rad" => 1.0,
                _ if size > 0.0 => size,
                _ => 1.0,
            }
        }
    };
    sources.iter().map(scale).collect()
}
