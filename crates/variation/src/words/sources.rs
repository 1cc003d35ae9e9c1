//! What may be off: joints, points, drivers, parameters.

use super::super::Levels;
use super::super::source::Scatter;
use super::super::source::{Acts, Kind, Room, Source};
use super::super::statistics::Pins;
use super::gears::gear_curvature;
use super::names::Names;
use super::parameters::{Followed, Parameters, idle, kinks, times};
use linkdyn_engine::system::{DriverId, System};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{Distribution, JointKind, Model};

/// All that may be off; what is curved (by parameter) is asked where worst cases are.
pub(super) fn sources(
    model: &Model,
    system: &System,
    names: &Names,
    followed: &Followed,
    curved: Option<&[bool]>,
) -> Result<Vec<Source>, Complaints> {
    let mut sources = Vec::new();
    for (index, (name, joint)) in model.joints.iter().enumerate() {
        let is_counted =
            pins(model) != Pins::None || !matches!(joint.kind, JointKind::Revolute { .. });
        let clearance = clearance(&joint.kind, system, index).filter(|_| is_counted);
        sources.extend(clearance.map(|(least, room)| Source {
            name: format!("joints.{name}"),
            kind: Kind::Clearance { least },
            room,
            acts: Acts::Row(system.blocks[index].row()),
        }));
    }
    for (body, data) in &model.bodies {
        for (point, diameter) in &data.point_tolerances {
            sources.extend(names.point(body, point).map(|id| Source {
                name: format!("bodies.{body}.points.{point}"),
                kind: Kind::Zone,
                room: Room::Disc(0.5 * diameter),
                acts: Acts::Point(id),
            }));
        }
    }
    for (index, (name, driver)) in model.drivers.iter().enumerate() {
        let half = driver.tolerance.filter(|half| *half > 0.0);
        sources.extend(half.map(|half| Source {
            name: format!("drivers.{name}"),
            kind: Kind::Driver,
            room: Room::Line([-half, half]),
            acts: Acts::Row(system.driver_row(DriverId(index))),
        }));
    }
    for (index, steps) in &followed.parameters {
        let parameter = &followed.of.all[*index];
        let (ends, scatter) = match &parameter.tolerance {
            None => ([0.0; 2], Scatter::Uniform),
            Some(own) => ([own.lower, own.upper], own.distribution.into()),
        };
        sources.push(Source {
            name: format!("parameters.{}", parameter.name),
            kind: Kind::Parameter(scatter),
            room: Room::Line(ends),
            acts: Acts::Dimensions {
                steps: steps.clone(),
                is_curved: curved.is_some_and(|curved| curved[*index]),
            },
        });
    }
    let faults = faults(&sources, followed);
    if faults.is_empty() {
        Ok(sources)
    } else {
        Err(Complaints(faults))
    }
}

/// What is wrong with the parameters as sources.
fn faults(sources: &[Source], followed: &Followed) -> Vec<Complaint> {
    let parameters: &Parameters = followed.of;
    let mut faults = kinks(followed);
    faults.extend(times(parameters));
    if faults.is_empty() {
        // Behind a kink nothing is known to follow.
        faults.extend(idle(followed));
    }
    // A tolerance of zero is one that is still to be chosen.
    let is_said = parameters.all.iter().any(|own| own.tolerance.is_some());
    if faults.is_empty() && !is_said && !sources.iter().any(Source::is_off) {
        let message = "nothing may be off: no parameter has a tolerance, and no joint a clearance";
        let hint = "as in \"parameters\": { \"rod\": { \"value\": \"200 mm\", \"tolerance\": \"0.05 mm\" } }, or \"clearance\": { \"model\": \"ideal\", \"radius\": \"10 um\" } of a joint";
        faults.push(Complaint::new("parameters", message).hint(hint));
    }
    faults
}

/// What a joint may be off: the least, and what is allowed.
fn clearance(kind: &JointKind, system: &System, index: usize) -> Option<(f64, Room)> {
    let line = |half: f64| Room::Line([-half, half]);
    match kind {
        JointKind::Revolute { clearance, .. } => {
            let [least, most] = clearance.as_ref()?.limits()?;
            (most > 0.0).then_some((least, Room::Disc(most)))
        }
        JointKind::Prismatic {
            play, guide_length, ..
        } => {
            let play = play.as_ref().filter(|play| play.most > 0.0)?;
            let gap = play.most;
            let guided = guide_length.map(|length| Room::Guide { gap, length });
            Some((play.least, guided.unwrap_or_else(|| line(gap))))
        }
        JointKind::Slot { play, .. } => {
            let play = play.as_ref().filter(|play| play.most > 0.0)?;
            Some((play.least, line(play.most)))
        }
        JointKind::Gear { backlash, .. } => {
            let backlash = backlash.filter(|backlash| *backlash > 0.0)?;
            // An arc at the pitch circle as an angle of the second wheel, half of it to either side.
            let half = 0.5 * backlash * gear_curvature(system, index);
            Some((half, line(half)))
        }
        _ => None,
    }
}

/// Which levels the model asks for.
pub(super) fn levels(model: &Model) -> Levels {
    let said = model.accuracy.as_ref().map(|accuracy| accuracy.levels);
    match said.unwrap_or_default() {
        linkdyn_model::Levels::First => Levels::First,
        linkdyn_model::Levels::Worst => Levels::Worst,
        linkdyn_model::Levels::Certified => Levels::Certified,
    }
}

/// How the pins are taken.
pub(super) fn pins(model: &Model) -> Pins {
    let said = model.accuracy.as_ref().map(|accuracy| accuracy.pins);
    match said.unwrap_or_default() {
        linkdyn_model::Pins::Worst | linkdyn_model::Pins::Rim => Pins::Rim,
        linkdyn_model::Pins::Disc => Pins::Disc,
        linkdyn_model::Pins::Load => Pins::Load,
        linkdyn_model::Pins::None => Pins::None,
    }
}

impl From<Distribution> for Scatter {
    fn from(distribution: Distribution) -> Self {
        match distribution {
            Distribution::Normal { sigma } => Scatter::Normal(sigma),
            Distribution::Uniform => Scatter::Uniform,
            Distribution::Triangular => Scatter::Triangular,
        }
    }
}
