//! The outputs of a question: positions, and forces.

use super::super::Wanted;
use super::super::forces::{Force, Owner};
use super::super::output::Output;
use super::names::Names;
use linkdyn_engine::analysis::channels::{Channels, Contents};
use linkdyn_engine::system::System;
use linkdyn_linear::math::Vec2;
use linkdyn_model::error::Complaint;
use linkdyn_model::{AccuracyOutput, Measured, Model, PointRef, nearest};
use linkdyn_output::Channel;
use std::f64::consts::PI;

/// The request.
#[derive(Default)]
pub(super) struct Outputs {
    pub positions: Vec<Wanted<Output>>,
    /// Forces with their places among all outputs.
    pub forces: Vec<(usize, Wanted<Force>)>,
}

/// The outputs requested.
pub(super) fn wanted(
    model: &Model,
    system: &System,
    names: &Names,
    only: &[String],
) -> Result<Outputs, Complaint> {
    let outputs = model.accuracy.as_ref().map(|accuracy| &accuracy.outputs);
    let Some(outputs) = outputs.filter(|outputs| !outputs.is_empty()) else {
        let hint =
            "add \"accuracy\": { \"outputs\": { \"NAME\": { \"column\": \"rocker.angle\" } } }";
        return Err(Complaint::new(
            "accuracy.outputs",
            "the model says no output whose accuracy is asked",
        )
        .hint(hint));
    };
    if let Some(unknown) = only
        .iter()
        .find(|name| !outputs.contains_key(name.as_str()))
    {
        let near = nearest(unknown, outputs.keys().map(String::as_str));
        let complaint = Complaint::new(
            "accuracy.outputs",
            format!("there is no output {unknown:?}"),
        );
        let listed: Vec<&str> = outputs.keys().map(String::as_str).collect();
        return Err(complaint.hint(match near {
            Some(near) => format!("did you mean {near:?}?"),
            None => format!("the outputs: {}", listed.join(", ")),
        }));
    }
    let asked = outputs
        .iter()
        .filter(|(name, _)| only.is_empty() || only.contains(name));
    let mut found = Outputs::default();
    for (place, (name, output)) in asked.enumerate() {
        let of = match &output.of {
            Measured::Column(column) => column.clone(),
            Measured::Distance([from, to]) => format!("distance of {from} and {to}"),
        };
        let at = pose(system, name, output)?;
        let (name, limits) = (name.to_owned(), output.limits);
        match quantity((model, system, names), &name, output)? {
            Quantity::Position(output) => {
                let unit = if output.is_angle() { "rad" } else { "m" };
                found.positions.push(Wanted {
                    name,
                    of,
                    output,
                    unit,
                    at,
                    limits,
                });
            }
            Quantity::Force(output) => {
                let unit = output.unit;
                found.forces.push((
                    place,
                    Wanted {
                        name,
                        of,
                        output,
                        unit,
                        at,
                        limits,
                    },
                ));
            }
        }
    }
    Ok(found)
}

/// Points along directions over half a turn; a point that there is not is left out.
pub(super) fn along(names: &Names, points: &[PointRef], directions: usize) -> Outputs {
    let mut found = Outputs::default();
    for point in points {
        for k in 0..directions {
            let angle = PI * k as f64 / directions as f64;
            let direction = Vec2::new(angle.cos(), angle.sin());
            let Some(output) = names.along(&point.body, &point.point, direction) else {
                continue;
            };
            found.positions.push(Wanted {
                name: point.to_string(),
                of: point.to_string(),
                output,
                unit: "m",
                at: None,
                limits: None,
            });
        }
    }
    found
}

/// A number that is asked about.
enum Quantity {
    Position(Output),
    Force(Force),
}

fn quantity(
    (model, system, names): (&Model, &System, &Names),
    name: &str,
    asked: &AccuracyOutput,
) -> Result<Quantity, Complaint> {
    let path = format!("accuracy.outputs.{name}");
    let length = |column: &str| {
        let force = column.strip_prefix("force.")?.strip_suffix(".length")?;
        let [from, to] = model.forces.get(force)?.kind.ends()?;
        names.distance([from, to].map(|end| (end.body.as_str(), end.point.as_str())))
    };
    match &asked.of {
        Measured::Column(column) => match names.column(system, column).or_else(|| length(column)) {
            Some(output) => Ok(Quantity::Position(output)),
            None => force(system, column).map(Quantity::Force).map_err(|hint| {
                let message =
                    "the results have no such column of a position, an effort or a joint force";
                let complaint = Complaint::new(format!("{path}.column"), message);
                complaint.found(format!("{column:?}")).hint(hint)
            }),
        },
        Measured::Distance([from, to]) => {
            let points = [
                (from.body.as_str(), from.point.as_str()),
                (to.body.as_str(), to.point.as_str()),
            ];
            let output = names.distance(points);
            let output = output.map(Quantity::Position);
            output.ok_or_else(|| {
                Complaint::new(format!("{path}.distance"), "there are no such points")
            })
        }
    }
}

/// The effort or joint force of a column; else a hint which there are.
fn force(system: &System, name: &str) -> Result<Force, String> {
    let contents = Contents {
        velocities: true,
        accelerations: true,
        reactions: true,
        friction: true,
    };
    let channels = Channels::new(system, contents);
    let columns = channels.columns();
    let owner = |channel: Channel| match channel {
        Channel::Driver(driver, quantity) => Some(Owner::Driver(driver, quantity)),
        Channel::Joint(joint, quantity) => Some(Owner::Joint(joint, quantity)),
        Channel::Time
        | Channel::Body(..)
        | Channel::Point(..)
        | Channel::Energy(_)
        | Channel::Load(..)
        | Channel::Shaking(_)
        | Channel::Transmission(_)
        | Channel::Relative(..)
        | Channel::State(..)
        | Channel::Measure(..)
        | Channel::Section(..)
        | Channel::Output(_) => None,
    };
    let forces = columns.iter().filter(|column| column.unit.starts_with('N'));
    let forces = forces.filter_map(|column| {
        let owner = owner(column.channel?)?;
        Some((
            column.name.as_str(),
            Force {
                owner,
                unit: column.unit,
            },
        ))
    });
    let forces: Vec<(&str, Force)> = forces.collect();
    if let Some((_, force)) = forces.iter().find(|(own, _)| *own == name) {
        return Ok(*force);
    }
    let of = name.rsplit_once('.').map_or(name, |(owner, _)| owner);
    let near = forces.iter().map(|(own, _)| *own);
    let near: Vec<&str> = near
        .filter(|own| own.rsplit_once('.').is_some_and(|(own, _)| own == of))
        .collect();
    Err(match &near[..] {
        [] => "as in \"rocker.angle\", \"coupler.P.x\", \"joint.b.fx\" or \"driver.motor.effort\""
            .into(),
        near => format!("there are {}", near.join(", ")),
    })
}

/// Driver and value that say the pose; none over the whole stroke.
fn pose(
    system: &System,
    name: &str,
    asked: &AccuracyOutput,
) -> Result<Option<(usize, f64)>, Complaint> {
    let Some(at) = &asked.at else {
        return Ok(None);
    };
    let driver = match &at.driver {
        Some(driver) => system.drivers.iter().position(|own| own.name == *driver),
        None => (system.drivers.len() == 1).then_some(0),
    };
    let driver = driver.ok_or_else(|| {
        Complaint::new(
            format!("accuracy.outputs.{name}.at.driver"),
            "which driver has the value?",
        )
        .hint("name it, as in \"driver\": \"motor\"")
    })?;
    Ok(Some((driver, at.value)))
}
