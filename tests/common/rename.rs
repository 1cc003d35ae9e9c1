//! Every name of a model changed.

use indexmap::IndexMap;
use linkdyn_model::{DriverKind, ForceKind, GROUND, JointKind, Measured, Model, PointRef};

/// A name no model has.
pub fn renamed(name: &str) -> String {
    if name == GROUND {
        name.to_string()
    } else {
        format!("{name} ♣")
    }
}

/// Every name changed, everything in the opposite order.
pub fn rename_and_reverse(model: &Model) -> Model {
    let mut model = model.clone();
    let reference = |point: &mut PointRef| {
        point.body = renamed(&point.body);
        point.point = renamed(&point.point);
    };
    model.bodies = reversed(model.bodies);
    for body in model.bodies.values_mut() {
        body.points = reversed(std::mem::take(&mut body.points));
        body.point_tolerances = reversed(std::mem::take(&mut body.point_tolerances));
    }
    model.joints = reversed(model.joints);
    for joint in model.joints.values_mut() {
        joint.between.iter_mut().for_each(reference);
        if let JointKind::Gear { carrier, .. } | JointKind::Belt { carrier, .. } = &mut joint.kind {
            *carrier = carrier.as_deref().map(renamed);
        }
    }
    model.drivers = reversed(model.drivers);
    for driver in model.drivers.values_mut() {
        match &mut driver.kind {
            DriverKind::Rotation { body, relative_to } => {
                *body = renamed(body);
                *relative_to = relative_to.as_deref().map(renamed);
            }
            DriverKind::Translation { joint } => *joint = renamed(joint),
            DriverKind::Length { between } => between.iter_mut().for_each(reference),
            DriverKind::Point { point, .. } => reference(point),
        }
    }
    model.forces = reversed(model.forces);
    for force in model.forces.values_mut() {
        match &mut force.kind {
            ForceKind::Spring { between, .. }
            | ForceKind::Actuator { between, .. }
            | ForceKind::GasSpring { between, .. }
            | ForceKind::Cylinder { between, .. } => {
                between.iter_mut().for_each(reference);
            }
            ForceKind::Cable { through, .. } => through.iter_mut().for_each(reference),
            ForceKind::TorsionSpring { between, .. } => {
                between.iter_mut().for_each(|body| *body = renamed(body));
            }
            ForceKind::Load { at, .. } => reference(at),
            ForceKind::Torque {
                body, relative_to, ..
            }
            | ForceKind::DcMotor {
                body, relative_to, ..
            } => {
                *body = renamed(body);
                *relative_to = relative_to.as_deref().map(renamed);
            }
        }
    }
    model.points.reverse();
    model.points.iter_mut().for_each(reference);
    if let Some(sample) = model
        .analysis
        .as_mut()
        .and_then(|analysis| analysis.sample.as_mut())
    {
        sample.driver = renamed(&sample.driver);
    }
    for output in model
        .accuracy
        .iter_mut()
        .flat_map(|accuracy| accuracy.outputs.values_mut())
    {
        match &mut output.of {
            Measured::Column(column) => *column = renamed_column(column),
            Measured::Distance(points) => points.iter_mut().for_each(reference),
        }
        if let Some(at) = &mut output.at {
            at.driver = at.driver.as_deref().map(renamed);
        }
    }
    model
}

/// The column of the same quantity where every name is changed.
fn renamed_column(column: &str) -> String {
    let parts: Vec<&str> = column.split('.').collect();
    match parts.as_slice() {
        [kind @ ("joint" | "driver"), name, quantity] => {
            format!("{kind}.{}.{quantity}", renamed(name))
        }
        [body, point, quantity] => format!("{}.{}.{quantity}", renamed(body), renamed(point)),
        [body, quantity] => format!("{}.{quantity}", renamed(body)),
        _ => panic!("no column: {column}"),
    }
}

fn reversed<T>(map: IndexMap<String, T>) -> IndexMap<String, T> {
    map.into_iter()
        .rev()
        .map(|(name, value)| (renamed(&name), value))
        .collect()
}
