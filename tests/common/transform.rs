//! The same mechanism told otherwise: turned, moved, mirrored, renamed, in other units.
//!
//! Each function changes the words of a model so that its results must change in a known way.

mod cams;
#[path = "transformed_joints.rs"]
mod joints;
mod limits;
mod outlines;
mod rename;

use indexmap::IndexMap;
use linkdyn_model::{
    Driver, DriverKind, Force, ForceKind, Frame, GROUND, Model, Motion, Paced, Rise, Segment, Value,
};

pub use joints::swapped_signs;
use outlines::move_outline;
pub use rename::{rename_and_reverse, renamed};

/// A plane vector turned by an angle.
pub fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

fn rise(one: &Rise, factor: f64, offset: f64) -> Rise {
    Rise {
        start: one.start * factor + offset,
        rise: one.rise.map(|rise| rise * factor),
        end: one.end.map(|end| end * factor + offset),
        ..*one
    }
}

fn paced(one: &Paced, factor: f64, offset: f64) -> Paced {
    let limit = |limit: Option<f64>| limit.map(|limit| limit * factor.abs());
    Paced {
        start: one.start * factor + offset,
        rise: one.rise.map(|rise| rise * factor),
        end: one.end.map(|end| end * factor + offset),
        velocity: limit(one.velocity),
        acceleration: limit(one.acceleration),
        jerk: limit(one.jerk),
        ..*one
    }
}

fn segment(one: &Segment, factor: f64, offset: f64) -> Segment {
    Segment {
        rise: one.rise.map(|rise| rise * factor),
        end: one.end.map(|end| end * factor + offset),
        ..*one
    }
}

/// f(t) ↦ factor·f(t) + offset.
fn affine(motion: &Motion, factor: f64, offset: f64) -> Motion {
    let all = |values: &[f64]| {
        values
            .iter()
            .map(|value| value * factor)
            .collect::<Vec<f64>>()
    };
    match motion {
        Motion::Polynomial { coefficients } => {
            let mut coefficients = all(coefficients);
            coefficients[0] += offset;
            Motion::Polynomial { coefficients }
        }
        Motion::Harmonic {
            offset: mean,
            amplitude,
            frequency,
            phase,
        } => Motion::Harmonic {
            offset: mean * factor + offset,
            amplitude: amplitude * factor,
            frequency: *frequency,
            phase: *phase,
        },
        Motion::Table {
            points,
            interpolation,
            velocities,
        } => Motion::Table {
            points: points
                .iter()
                .map(|[t, value]| [*t, value * factor + offset])
                .collect(),
            interpolation: *interpolation,
            velocities: velocities
                .as_ref()
                .map(|all| all.iter().map(|slope| slope * factor).collect()),
        },
        Motion::Cycloidal(one) => Motion::Cycloidal(rise(one, factor, offset)),
        Motion::Polynomial345(one) => Motion::Polynomial345(rise(one, factor, offset)),
        Motion::Polynomial4567(one) => Motion::Polynomial4567(rise(one, factor, offset)),
        Motion::ModifiedSine(one) => Motion::ModifiedSine(rise(one, factor, offset)),
        Motion::ModifiedTrapezoid(one) => Motion::ModifiedTrapezoid(rise(one, factor, offset)),
        Motion::TrapezoidalVelocity(one) => Motion::TrapezoidalVelocity(paced(one, factor, offset)),
        Motion::SCurve(one) => Motion::SCurve(paced(one, factor, offset)),
        Motion::Sequence {
            start,
            begin,
            segments,
            repeat,
        } => Motion::Sequence {
            start: start * factor + offset,
            begin: *begin,
            segments: segments
                .iter()
                .map(|one| segment(one, factor, offset))
                .collect(),
            repeat: *repeat,
        },
        Motion::ConstantVelocity { start, velocity } => Motion::ConstantVelocity {
            start: start * factor + offset,
            velocity: velocity * factor,
        },
        Motion::ConstantAcceleration {
            start,
            velocity,
            acceleration,
        } => Motion::ConstantAcceleration {
            start: start * factor + offset,
            velocity: velocity * factor,
            acceleration: acceleration * factor,
        },
    }
}

fn affine_value(value: &Value, factor: f64, offset: f64) -> Value {
    match value {
        Value::Constant(value) => Value::Constant(value * factor + offset),
        Value::Motion(motion) => Value::Motion(affine(motion, factor, offset)),
        // relative to other bodies, or it would have to be turned as well
        Value::Formula(formula) => {
            assert_eq!(offset, 0.0, "a formula of a force");
            let mut formula = formula.clone();
            match &mut formula.table {
                Some(table) => {
                    let points = table.points.iter_mut();
                    points.for_each(|point| point[1] *= factor);
                }
                None => {
                    let text = formula.formula.trim_start().trim_start_matches('=');
                    formula.formula = format!("={factor:?}*({text})");
                }
            }
            Value::Formula(formula)
        }
    }
}

fn each_sampled_angle(model: &mut Model, change: impl Fn(f64) -> f64) {
    let Some(sample) = model
        .analysis
        .as_mut()
        .and_then(|analysis| analysis.sample.as_mut())
    else {
        return;
    };
    let is_rotation = matches!(
        &model.drivers[&sample.driver].kind,
        DriverKind::Rotation { .. }
    );
    if is_rotation {
        sample.from = change(sample.from);
        sample.to = change(sample.to);
    }
}

/// Whether a driver's value is an angle against the ground.
pub fn is_absolute(driver: &Driver) -> bool {
    match &driver.kind {
        DriverKind::Rotation { relative_to, .. } => {
            relative_to.as_deref().is_none_or(|body| body == GROUND)
        }
        DriverKind::Translation { .. } | DriverKind::Length { .. } | DriverKind::Point { .. } => {
            false
        }
    }
}

/// The body on which the wheels of a gear turn; none for other joints.
fn carrier(model: &Model, name: &str) -> Option<String> {
    let carrier = model.carrier(name, &model.joints[name])?;
    Some(carrier.expect("a carrier").body.to_string())
}

/// The whole mechanism turned about the ground's origin; the ground's frame stays.
pub fn rotate(model: &Model, angle: f64) -> Model {
    assert!(
        model.initial.is_empty(),
        "exact initial values can't be turned one by one"
    );
    let original = model;
    let mut model = model.clone();
    model.gravity = turned(model.gravity, angle);
    for (name, body) in &mut model.bodies {
        if name == GROUND {
            body.points
                .values_mut()
                .for_each(|point| *point = turned(*point, angle));
        } else {
            body.pose.position = turned(body.pose.position, angle);
            body.pose.angle += angle;
        }
    }
    for (name, joint) in &mut model.joints {
        let carrier = carrier(original, name);
        joints::rotate(joint, angle, carrier.as_deref());
    }
    for driver in model
        .drivers
        .values_mut()
        .filter(|driver| is_absolute(driver))
    {
        driver.motion = affine(&driver.motion, 1.0, angle);
    }
    if let Some(sample) = model
        .analysis
        .as_ref()
        .and_then(|analysis| analysis.sample.as_ref())
        && is_absolute(&model.drivers[&sample.driver])
    {
        each_sampled_angle(&mut model, |value| value + angle);
    }
    let mut forces = IndexMap::new();
    for (name, force) in &model.forces {
        for (suffix, kind) in rotate_force(&force.kind, angle) {
            let stroke = force.stroke.clone();
            forces.insert(format!("{name}{suffix}"), Force { kind, stroke });
        }
    }
    model.forces = forces;
    model
}

/// A force turned; one with a direction in space becomes two, one per component, since each may have its own law of time.
fn rotate_force(kind: &ForceKind, angle: f64) -> Vec<(&'static str, ForceKind)> {
    let mut kind = kind.clone();
    match &mut kind {
        ForceKind::Spring { .. }
        | ForceKind::Actuator { .. }
        | ForceKind::GasSpring { .. }
        | ForceKind::Cylinder { .. }
        | ForceKind::DcMotor { .. }
        | ForceKind::Cable { .. }
        | ForceKind::Torque { .. } => {}
        ForceKind::TorsionSpring {
            between,
            free_angle,
            ..
        } => {
            let [first, second] =
                [0, 1].map(|end: usize| f64::from(u8::from(between[end] == GROUND)));
            *free_angle = affine_value(free_angle, 1.0, angle * (first - second));
        }
        ForceKind::Load { at, vector, frame } => match frame {
            Frame::Body => {}
            Frame::Ground => {
                let (sin, cos) = angle.sin_cos();
                let part = |k: usize, by: [f64; 2]| ForceKind::Load {
                    at: at.clone(),
                    vector: by.map(|factor| affine_value(&vector[k], factor, 0.0)),
                    frame: Frame::Ground,
                };
                return vec![(" x", part(0, [cos, sin])), (" y", part(1, [-sin, cos]))];
            }
        },
    }
    vec![("", kind)]
}

/// The whole mechanism moved.
pub fn translate(model: &Model, by: [f64; 2]) -> Model {
    assert!(
        model.initial.is_empty(),
        "exact initial values are not moved"
    );
    let mut model = model.clone();
    let moved = |[x, y]: [f64; 2]| [x + by[0], y + by[1]];
    for (name, body) in &mut model.bodies {
        if name == GROUND {
            body.points
                .values_mut()
                .for_each(|point| *point = moved(*point));
        } else {
            body.pose.position = moved(body.pose.position);
        }
    }
    for joint in model.joints.values_mut() {
        if joint.between[0].body == GROUND {
            move_outline(&mut joint.kind, moved);
        }
    }
    model
}

/// The mechanism behind a mirror, x ↦ −x, body frames mirrored too: angles and torques change their sign.
pub fn mirror(model: &Model) -> Model {
    assert!(
        model.initial.is_empty(),
        "exact initial values are not mirrored"
    );
    let mut model = model.clone();
    let mirrored = |[x, y]: [f64; 2]| [-x, y];
    model.gravity = mirrored(model.gravity);
    for body in model.bodies.values_mut() {
        body.points
            .values_mut()
            .for_each(|point| *point = mirrored(*point));
        body.com = body.com.map(mirrored);
        body.pose.position = mirrored(body.pose.position);
        body.pose.angle = -body.pose.angle;
    }
    model.joints.values_mut().for_each(joints::mirror);
    for driver in model.drivers.values_mut() {
        if matches!(driver.kind, DriverKind::Rotation { .. }) {
            driver.motion = affine(&driver.motion, -1.0, 0.0);
        }
    }
    each_sampled_angle(&mut model, |value| -value);
    for force in model.forces.values_mut() {
        match &mut force.kind {
            ForceKind::Spring { .. }
            | ForceKind::Actuator { .. }
            | ForceKind::GasSpring { .. }
            | ForceKind::Cylinder { .. }
            | ForceKind::Cable { .. } => {}
            ForceKind::DcMotor { voltage, .. } => *voltage = affine_value(voltage, -1.0, 0.0),
            ForceKind::TorsionSpring {
                free_angle: value, ..
            }
            | ForceKind::Torque { value, .. } => {
                *value = affine_value(value, -1.0, 0.0);
            }
            ForceKind::Load { vector, .. } => vector[0] = affine_value(&vector[0], -1.0, 0.0),
        }
    }
    model
}

/// First and second body of every revolute and fixed joint and of every gear exchanged.
pub fn swap(model: &Model) -> Model {
    let mut model = model.clone();
    model.joints.values_mut().for_each(joints::swap);
    model
}
