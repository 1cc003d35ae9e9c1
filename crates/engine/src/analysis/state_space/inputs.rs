//! What the inputs of a linear system are, by their names.

use super::answer::NoLinearSystem;
use crate::analysis::words::listed;
use crate::element::formula::Strength;
use crate::element::quantity::Measured;
use crate::element::{Applied, BodyId, Kinematics, Marker, Measure};
use crate::system::{ForceRole, System};
use linkdyn_linear::math::Vec2;
use linkdyn_model::{Checked, GROUND, nearest};

/// An input.
#[derive(Debug, Clone, PartialEq)]
pub enum Input {
    /// The driving torque or force of a driver that is let go.
    Effort(usize),
    /// The acceleration of a driver that goes on to prescribe its motion.
    Acceleration(usize),
    /// A force on the mechanism: that of size 1 (n).
    Force(Vec<f64>),
    /// A number that formulas name.
    Number(usize),
}

/// An input with its name and unit.
pub struct NamedInput {
    pub name: String,
    pub unit: String,
    pub input: Input,
}

impl NamedInput {
    /// Those of these names, at a point of the motion.
    ///
    /// # Errors
    /// Names of nothing, and what has no direction there.
    pub fn all(
        (model, system): (&Checked, &System),
        at: &Kinematics,
        names: &[String],
    ) -> Result<Vec<Self>, NoLinearSystem> {
        let mut inputs: Vec<NamedInput> = Vec::with_capacity(names.len());
        for name in names {
            let said = |why: String| NoLinearSystem::Question(format!("input {name:?}: {why}"));
            let found = named((model, system), at, name).map_err(said)?;
            let driver = |input: &Input| match input {
                Input::Effort(driver) | Input::Acceleration(driver) => Some(*driver),
                Input::Force(_) | Input::Number(_) => None,
            };
            let own = driver(&found.input);
            let twice = |other: &NamedInput| {
                other.name == found.name || own.is_some() && driver(&other.input) == own
            };
            if let Some(other) = inputs.iter().find(|other| twice(other)) {
                return Err(said(match other.name == found.name {
                    true => "it is an input already".into(),
                    false => format!("its driver is an input already, {:?}", other.name),
                }));
            }
            inputs.push(found);
        }
        Ok(inputs)
    }
}

fn named(
    (model, system): (&Checked, &System),
    at: &Kinematics,
    name: &str,
) -> Result<NamedInput, String> {
    let words: Vec<&str> = name.split('.').collect();
    let (name, unit, input) = match words[..] {
        ["driver", own] | ["driver", own, "effort"] => {
            let driver = driver(system, own)?;
            let unit = match system.drivers[driver].measure {
                Measure::Angle => "N*m",
                Measure::Length => "N",
            };
            (format!("driver.{own}.effort"), unit, Input::Effort(driver))
        }
        ["driver", own, "acceleration"] => {
            let driver = driver(system, own)?;
            let unit = match system.drivers[driver].measure {
                Measure::Angle => "rad/s^2",
                Measure::Length => "m/s^2",
            };
            (name.to_owned(), unit, Input::Acceleration(driver))
        }
        ["input", own] => {
            let known = model.inputs.keys().map(String::as_str);
            let found = model.inputs.get_full(own);
            let (index, _, input) = found.ok_or_else(|| none("input", own, known))?;
            let unit = match input.unit.as_str() {
                "" => "1",
                unit => unit,
            };
            (name.to_owned(), unit, Input::Number(index))
        }
        ["force", own] => {
            let (unit, force) = force(system, at, own)?;
            (name.to_owned(), unit, Input::Force(force))
        }
        [body, "torque"] => {
            let body = body_of(model, system, body)?;
            let torque = unit_force(system, |to| to.add(body, Vec2::zeros(), 1.0));
            (name.to_owned(), "N*m", Input::Force(torque))
        }
        [body, point, axis @ ("fx" | "fy")] => {
            let marker = marker((model, system), body, point)?;
            let direction = match axis {
                "fx" => Vec2::x(),
                _ => Vec2::y(),
            };
            let force = unit_force(system, |to| to.add_force(at, &marker, direction));
            (name.to_owned(), "N", Input::Force(force))
        }
        _ => {
            return Err(
                "inputs are called driver.NAME, driver.NAME.acceleration, input.NAME, force.NAME, BODY.POINT.fx, BODY.POINT.fy or BODY.torque"
                    .into(),
            );
        }
    };
    Ok(NamedInput {
        name,
        unit: unit.to_owned(),
        input,
    })
}

/// What to say of a name that nothing has.
fn none<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    match nearest(name, known.clone()) {
        Some(near) => format!("there is no {what} {name:?} (did you mean {near:?}?)"),
        None => {
            let known: Vec<&str> = known.collect();
            match known.is_empty() {
                true => format!("there is no {what} {name:?}, the model has none"),
                false => {
                    let known = listed(&known, ", ");
                    format!("there is no {what} {name:?} (there are: {known})")
                }
            }
        }
    }
}

fn driver(system: &System, name: &str) -> Result<usize, String> {
    let mut drivers = system.drivers.iter();
    let found = drivers.position(|driver| driver.name == name);
    let known = system.drivers.iter().map(|driver| driver.name.as_str());
    found.ok_or_else(|| none("driver", name, known))
}

fn body_of(model: &Checked, system: &System, name: &str) -> Result<BodyId, String> {
    let mut bodies = system.bodies.iter();
    let found = bodies.position(|body| body.name == name);
    let known = model.bodies.keys().map(String::as_str);
    let known = known.filter(|body| *body != GROUND);
    found.map(BodyId::moving).ok_or_else(|| match name {
        GROUND => "the ground does not move".into(),
        _ => none("body", name, known),
    })
}

fn marker((model, system): (&Checked, &System), body: &str, point: &str) -> Result<Marker, String> {
    let id = body_of(model, system, body)?;
    let own = model.bodies.get(body);
    let points = || own.iter().flat_map(|own| own.points.keys());
    let place = own.and_then(|own| own.points.get(point)).ok_or_else(|| {
        let known = points().map(String::as_str);
        none(&format!("point of {body:?} called"), point, known)
    })?;
    let full = format!("{body}.{point}");
    let mut listed = system.points.iter();
    if let Some(listed) = listed.find(|listed| listed.name == full) {
        return Ok(listed.marker);
    }
    if own.is_some_and(|own| own.elastic.is_some()) {
        return Err(format!(
            "of elastic links the points among the results can be pushed (add {full:?} to \"points\")"
        ));
    }
    let origin = id
        .index()
        .map_or(Vec2::zeros(), |index| system.bodies[index].origin);
    Ok(Marker {
        body: id,
        s: Vec2::from(*place) + origin,
    })
}

/// A generalized force (n).
fn unit_force(system: &System, apply: impl FnOnce(&mut Applied)) -> Vec<f64> {
    let mut force = vec![0.0; system.n()];
    apply(&mut Applied::to(&mut force, &system.layout));
    force
}

/// The generalized force (n) of a force element of size 1: where it acts, in the direction that it has at the point.
fn force(system: &System, at: &Kinematics, name: &str) -> Result<(&'static str, Vec<f64>), String> {
    let mut all = system.force_data.iter();
    let stretch = |role: &ForceRole| matches!(role, ForceRole::Stretch { .. });
    let found = all.find(|data| data.name == name && !stretch(&data.role));
    let known = system.force_data.iter().filter(|data| !stretch(&data.role));
    let known = known.map(|data| data.name.as_str());
    let data = found.ok_or_else(|| none("force", name, known))?;
    let along = |measured: &Measured, by: f64, to: &mut Applied| {
        let slopes = measured.gradient(at);
        for (body, [x, y, theta]) in slopes {
            to.add(body, Vec2::new(x, y) * by, theta * by);
        }
    };
    Ok(match &data.role {
        ForceRole::Spring { measured, .. } => {
            let unit = match measured {
                Measured::Turn { .. } => "N*m",
                Measured::Along { .. } | Measured::Distance { .. } => "N",
            };
            (unit, unit_force(system, |to| along(measured, 1.0, to)))
        }
        ForceRole::Cable { path, .. } => {
            let pull = unit_force(system, |to| {
                path.iter().for_each(|stretch| along(stretch, -1.0, to));
            });
            ("N", pull)
        }
        ForceRole::Torque { body, between, .. } => {
            let torque = unit_force(system, |to| {
                to.add(*body, Vec2::zeros(), 1.0);
                let others = between.iter().flatten().filter(|other| *other != body);
                others.for_each(|other| to.add(*other, Vec2::zeros(), -1.0));
            });
            ("N*m", torque)
        }
        ForceRole::Load {
            at: marker,
            vector,
            frame,
        } => {
            let [x, y] = vector.each_ref().map(|own: &Strength| own.value(at));
            let vector = at.poses[frame.0].turn(Vec2::new(x, y));
            let size = vector.norm();
            if size == 0.0 {
                return Err(
                    "the force is zero at this point and has no direction (push the point itself, BODY.POINT.fx or .fy)"
                        .into(),
                );
            }
            let push = |to: &mut Applied| to.add_force(at, marker, vector / size);
            ("N", unit_force(system, push))
        }
        ForceRole::Stretch { .. } => return Err("it is a stretch of a cable".into()),
    })
}
