//! What may be off: joints, points, drivers, parameters.

use super::super::source::Play;
use super::super::statistics::{Pins, Scatter};
use super::super::{Levels, Named};
use super::gears::gear_curvature;
use super::names::Names;
use super::parameters::{Followed, Parameters, Straightness, idle, kinks, times};
use crate::system::System;
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{Distribution, JointKind, Model};

/// All that may be off; what bends is asked where worst cases are.
pub(super) fn sources(
    model: &Model,
    system: &System,
    names: &Names,
    (parameters, followed): (&Parameters, &Followed),
    straightness: Option<&Straightness>,
) -> Result<Vec<Named>, Complaints> {
    let mut sources = Vec::new();
    for (index, (name, joint)) in model.joints.iter().enumerate() {
        let row = system.blocks[index].row();
        let play = joint_play(&joint.kind, row, system, index);
        sources.extend(
            play.filter(|_| {
                pins(model) != Pins::None || !matches!(joint.kind, JointKind::Revolute { .. })
            })
            .map(|play| Named {
                name: format!("joints.{name}"),
                play,
            }),
        );
    }
    sources.extend(zones(model, names));
    for (index, (name, driver)) in model.drivers.iter().enumerate() {
        sources.extend(
            driver
                .tolerance
                .filter(|half| *half > 0.0)
                .map(|half| Named {
                    name: format!("drivers.{name}"),
                    play: Play::Driver {
                        row: system.driver_row(crate::system::DriverId(index)),
                        half,
                    },
                }),
        );
    }
    for (index, steps) in &followed.parameters {
        let parameter = &parameters.all[*index];
        let (lower, upper, scatter) = match &parameter.tolerance {
            None => (0.0, 0.0, Scatter::Uniform),
            Some(own) => (own.lower, own.upper, own.distribution.into()),
        };
        sources.push(Named {
            name: format!("parameters.{}", parameter.name),
            play: Play::Parameter {
                lower,
                upper,
                scatter,
                steps: steps.clone(),
                bends: straightness.is_some_and(|known| known.bends[*index]),
            },
        });
    }
    let faults = faults(&sources, followed, parameters);
    if faults.is_empty() {
        Ok(sources)
    } else {
        Err(Complaints(faults))
    }
}

/// What is wrong with the parameters as sources.
fn faults(sources: &[Named], followed: &Followed, parameters: &Parameters) -> Vec<Complaint> {
    let mut faults = Vec::new();
    faults.extend(kinks(followed, parameters));
    faults.extend(times(parameters));
    if faults.is_empty() {
        // Behind a kink nothing is known to follow.
        faults.extend(idle(followed, parameters));
    }
    let off = |named: &Named| named.play.is_off();
    // A tolerance of zero is one that is still to be chosen.
    let is_said = parameters
        .all
        .iter()
        .any(|parameter| parameter.tolerance.is_some());
    if faults.is_empty() && !is_said && !sources.iter().any(off) {
        let message = "nothing may be off: no parameter has a tolerance, and no joint a clearance";
        let hint = "as in \"parameters\": { \"rod\": { \"value\": \"200 mm\", \"tolerance\": \"0.05 mm\" } }, or \"clearance\": { \"model\": \"ideal\", \"radius\": \"10 um\" } of a joint";
        faults.push(Complaint::new("parameters", message).hint(hint));
    }
    faults
}

/// Zones of points.
pub(super) fn zones(model: &Model, names: &Names) -> Vec<Named> {
    let mut zones = Vec::new();
    for (body, data) in &model.bodies {
        for (point, diameter) in &data.point_tolerances {
            zones.extend(names.point(body, point).map(|id| Named {
                name: format!("bodies.{body}.points.{point}"),
                play: Play::Zone {
                    point: id,
                    radius: 0.5 * diameter,
                },
            }));
        }
    }
    zones
}

/// What a joint may be off.
fn joint_play(kind: &JointKind, row: usize, system: &System, index: usize) -> Option<Play> {
    match kind {
        JointKind::Revolute { clearance, .. } => {
            let clearance = clearance.as_ref()?.limits()?;
            (clearance[1] > 0.0).then_some(Play::Pin { row, clearance })
        }
        JointKind::Prismatic {
            play, guide_length, ..
        } => {
            let play = play.as_ref().filter(|play| play.most > 0.0)?;
            let half = [play.least, play.most];
            Some(match guide_length {
                Some(length) => Play::Guided {
                    row,
                    half,
                    length: *length,
                },
                None => Play::Sides { row, half },
            })
        }
        JointKind::Slot { play, .. } => {
            let play = play.as_ref().filter(|play| play.most > 0.0)?;
            Some(Play::Sides {
                row,
                half: [play.least, play.most],
            })
        }
        JointKind::Gear { backlash, .. } => {
            let backlash = backlash.filter(|backlash| *backlash > 0.0)?;
            // An arc at the pitch circle as an angle of the second wheel, half of it to either side.
            let half = 0.5 * backlash * gear_curvature(system, index);
            Some(Play::Sides {
                row,
                half: [half, half],
            })
        }
        JointKind::Fixed { .. }
        | JointKind::Contact { .. }
        | JointKind::Cam(_)
        | JointKind::Rack { .. }
        | JointKind::Belt { .. }
        | JointKind::Bushing(_) => None,
    }
}

/// Which levels the model asks for.
pub(super) fn levels(model: &Model) -> Levels {
    let said = model.accuracy.as_ref();
    match said.map_or_else(Default::default, |accuracy| accuracy.levels) {
        linkdyn_model::Levels::First => Levels::First,
        linkdyn_model::Levels::Worst => Levels::Worst,
        linkdyn_model::Levels::Certified => Levels::Certified,
    }
}

/// How the pins are taken.
pub(super) fn pins(model: &Model) -> Pins {
    let said = model
        .accuracy
        .as_ref()
        .map_or_else(Default::default, |accuracy| accuracy.pins);
    match said {
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
