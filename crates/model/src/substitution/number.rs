//! The numbers of a model by the paths of their places in a file.

use crate::Model;
use crate::force::{ForceKind, Value};
use crate::joint::{Joint, JointKind, Timed};
use crate::motion::Motion;
use crate::table::Table;

/// The steps of a path, `bodies.crank.points.A[0]`: names and indexes.
pub fn steps(path: &str) -> impl Iterator<Item = &str> {
    let parts = path.split(['.', '[']);
    parts.map(|part| part.strip_suffix(']').unwrap_or(part))
}

/// What rules ask of a number: its sign, and that it is no number of another world.
pub fn class(value: f64) -> Option<std::cmp::Ordering> {
    const LARGE: f64 = 1e100;
    (value.abs() < LARGE)
        .then(|| value.total_cmp(&0.0))
        .map(|sign| {
            // −0 is no less than 0
            if value == 0.0 {
                std::cmp::Ordering::Equal
            } else {
                sign
            }
        })
}

/// A number of the model; none where the path leads to none that is known.
pub fn number<'m, 'p>(
    model: &'m mut Model,
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    match path.next()? {
        "gravity" => of_list(&mut model.gravity, path),
        "bodies" => body(model.bodies.get_mut(path.next()?)?, path),
        "joints" => joint(model.joints.get_mut(path.next()?)?, path),
        "drivers" => {
            let driver = model.drivers.get_mut(path.next()?)?;
            (path.next()? == "motion").then_some(())?;
            motion(&mut driver.motion, path)
        }
        "states" => {
            let state = model.states.get_mut(path.next()?)?;
            match path.next()? {
                "start" => Some(&mut state.start),
                "rate" if path.next()? == "parameters" => {
                    let constant = state.rate.parameters.get_mut(path.next()?)?;
                    Some(&mut constant.value)
                }
                _ => None,
            }
        }
        "tables" => table(model.tables.get_mut(path.next()?)?, path),
        "forces" => force(&mut model.forces.get_mut(path.next()?)?.kind, path),
        _ => None,
    }
}

fn of_list<'m, 'p>(
    list: &'m mut [f64],
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    list.get_mut(path.next()?.parse::<usize>().ok()?)
}

fn body<'m, 'p>(
    body: &'m mut crate::Body,
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    match path.next()? {
        "mass" => body.mass.as_mut(),
        "inertia" => body.inertia.as_mut(),
        "com" => of_list(body.com.as_mut()?, path),
        "points" => {
            let point = body.points.get_mut(path.next()?)?;
            match path.next()? {
                "position" => of_list(point, path),
                index => of_list(point, &mut std::iter::once(index)),
            }
        }
        "pose" => match path.next()? {
            "position" => of_list(&mut body.pose.position, path),
            "angle" => Some(&mut body.pose.angle),
            _ => None,
        },
        _ => None,
    }
}

fn joint<'m, 'p>(
    joint: &'m mut Joint,
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    let stops = &mut joint.stops;
    match (&mut joint.kind, path.next()?) {
        (_, "active") => timed(stops.active.as_deref_mut()?, path),
        (_, "lock") => timed(stops.lock.as_deref_mut()?, path),
        (
            JointKind::Prismatic { axis, .. }
            | JointKind::Slot { axis, .. }
            | JointKind::Rack { axis, .. },
            "axis",
        ) => of_list(axis, path),
        (JointKind::Rack { radius, .. }, "radius") => Some(radius),
        (JointKind::Belt { radii, .. }, "radii") => of_list(radii, path),
        (JointKind::Belt { pretension, .. }, "pretension") => pretension.as_mut(),
        (JointKind::Rack { offset, .. }, "offset") => offset.as_mut(),
        (JointKind::Prismatic { angle, .. } | JointKind::Fixed { angle }, "angle") => Some(angle),
        (JointKind::Bushing(bushing), key) => match key {
            "torsional_stiffness" => Some(&mut bushing.torsional_stiffness),
            "torsional_damping" => Some(&mut bushing.torsional_damping),
            "free_angle" => Some(&mut bushing.free_angle),
            // one number may stand for both axes
            _ => None,
        },
        (JointKind::Gear { ratio, .. }, "ratio") => Some(ratio),
        (JointKind::Gear { angle, .. }, "angle") => angle.as_mut(),
        (JointKind::Contact { radius, .. }, "radius") => Some(radius),
        // on segments there are rules beyond signs
        (JointKind::Cam(cam), "roller_radius") => cam.roller_radius.as_mut(),
        (JointKind::Cam(cam), "face") => of_list(cam.face.as_mut()?, path),
        (JointKind::Revolute { pin_radius, .. }, "pin_radius") => pin_radius.as_mut(),
        (JointKind::Revolute { clearance, .. }, "clearance") => {
            let clearance = clearance.as_mut()?;
            match path.next()? {
                "radius" => clearance.radius.as_mut(),
                "bearing_radius" => clearance.bearing_radius.as_mut(),
                "axial_length" => clearance.axial_length.as_mut(),
                _ => None,
            }
        }
        _ => None,
    }
}

fn timed<'m, 'p>(
    timed: &'m mut Timed,
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    let event = match path.next()? {
        "release" => return timed.release.as_mut(),
        "from" => timed.from.as_mut()?,
        "until" => timed.until.as_mut()?,
        _ => return None,
    };
    (path.next()? == "parameters").then_some(())?;
    let constant = event.parameters.get_mut(path.next()?)?;
    Some(&mut constant.value)
}

fn motion<'m, 'p>(
    motion: &'m mut Motion,
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    match (motion, path.next()?) {
        (Motion::Polynomial { coefficients }, "coefficients") => of_list(coefficients, path),
        (Motion::Harmonic { offset, .. }, "offset") => Some(offset),
        (Motion::Harmonic { amplitude, .. }, "amplitude") => Some(amplitude),
        (Motion::Harmonic { frequency, .. }, "frequency") => Some(frequency),
        (Motion::Harmonic { phase, .. }, "phase") => Some(phase),
        (Motion::ConstantVelocity { start, .. }, "start") => Some(start),
        (Motion::ConstantVelocity { velocity, .. }, "velocity") => Some(velocity),
        (Motion::ConstantAcceleration { start, .. }, "start") => Some(start),
        (Motion::ConstantAcceleration { velocity, .. }, "velocity") => Some(velocity),
        (Motion::ConstantAcceleration { acceleration, .. }, "acceleration") => Some(acceleration),
        (
            Motion::Cycloidal(rise)
            | Motion::Polynomial345(rise)
            | Motion::Polynomial4567(rise)
            | Motion::ModifiedSine(rise)
            | Motion::ModifiedTrapezoid(rise),
            key,
        ) => match key {
            "start" => Some(&mut rise.start),
            "rise" => rise.rise.as_mut(),
            "end" => rise.end.as_mut(),
            "begin" => Some(&mut rise.begin),
            "duration" => Some(&mut rise.duration),
            _ => None,
        },
        // on ramps there are rules beyond signs
        (Motion::TrapezoidalVelocity(rise) | Motion::SCurve(rise), key) => match key {
            "start" => Some(&mut rise.start),
            "rise" => rise.rise.as_mut(),
            "end" => rise.end.as_mut(),
            "begin" => Some(&mut rise.begin),
            "duration" => rise.duration.as_mut(),
            "velocity" => rise.velocity.as_mut(),
            "acceleration" => rise.acceleration.as_mut(),
            "jerk" => rise.jerk.as_mut(),
            _ => None,
        },
        (Motion::Sequence { start, .. }, "start") => Some(start),
        (Motion::Sequence { begin, .. }, "begin") => Some(begin),
        (Motion::Sequence { segments, .. }, "segments") => {
            let segment = segments.get_mut(path.next()?.parse::<usize>().ok()?)?;
            match path.next()? {
                "rise" => segment.rise.as_mut(),
                "end" => segment.end.as_mut(),
                "duration" => segment.duration.as_mut(),
                "dwell" => segment.dwell.as_mut(),
                _ => None,
            }
        }
        _ => None,
    }
}

fn force<'m, 'p>(
    kind: &'m mut ForceKind,
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    match (kind, path.next()?) {
        (
            ForceKind::Spring { stiffness, .. }
            | ForceKind::Cable { stiffness, .. }
            | ForceKind::TorsionSpring { stiffness, .. },
            "stiffness",
        ) => Some(stiffness),
        (
            ForceKind::Spring { damping, .. }
            | ForceKind::Cable { damping, .. }
            | ForceKind::TorsionSpring { damping, .. },
            "damping",
        ) => Some(damping),
        (
            ForceKind::Spring {
                free_length: value, ..
            }
            | ForceKind::Cable {
                free_length: value, ..
            },
            "free_length",
        )
        | (
            ForceKind::TorsionSpring {
                free_angle: value, ..
            },
            "free_angle",
        )
        | (ForceKind::Torque { value, .. }, "value")
        | (ForceKind::Actuator { force: value, .. }, "force") => self::value(value, path),
        (ForceKind::Load { vector, .. }, "vector") => {
            let index = path.next()?.parse::<usize>().ok()?;
            value(vector.get_mut(index)?, path)
        }
        _ => None,
    }
}

fn value<'m, 'p>(
    value: &'m mut Value,
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    match value {
        Value::Constant(value) => path.next().is_none().then_some(value),
        Value::Motion(law) => motion(law, path),
        Value::Formula(formula) => {
            let key = path.next()?;
            if key != "parameters" {
                return table(
                    formula.table.as_mut()?,
                    &mut std::iter::once(key).chain(path),
                );
            }
            let constant = formula.parameters.get_mut(path.next()?)?;
            Some(&mut constant.value)
        }
    }
}

fn table<'m, 'p>(
    table: &'m mut Table,
    path: &mut impl Iterator<Item = &'p str>,
) -> Option<&'m mut f64> {
    // on places there are rules beyond signs
    (path.next()? == "points").then_some(())?;
    let point = table.points.get_mut(path.next()?.parse::<usize>().ok()?)?;
    (path.next()? == "1").then_some(&mut point[1])
}
