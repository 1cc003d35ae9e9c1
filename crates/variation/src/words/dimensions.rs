//! The dimensions of a model, their values, and where in the file they stand.

use super::super::geometry::{Dimension, Dimensions, Hold, Point, PointId, driver_block};
use super::gears::{add_mesh, add_wheels, carrier, drawn, mesh};
use super::motions::{add_motions, motion_values};
use super::names::Names;
use linkdyn_engine::system::{DriverRole, System};
use linkdyn_model::{JointKind, Model};

/// All dimensions of a model, and where in the file they stand.
pub(super) fn dimensions(model: &Model, names: &Names, system: &System) -> Dimensions {
    let mut found = Dimensions::default();
    add_points(&mut found, model, names, system);
    add_joints(&mut found, model, system);
    add_motions(&mut found, model);
    found
}

impl Dimensions {
    pub(super) fn add(&mut self, dimension: Dimension) -> usize {
        self.all.push(dimension);
        self.all.len() - 1
    }

    pub(super) fn tell(&mut self, path: String, of: usize, factor: f64) {
        self.by_path.entry(path).or_default().push((of, factor));
    }
}

fn add_points(found: &mut Dimensions, model: &Model, names: &Names, system: &System) {
    for (body, data) in &model.bodies {
        for point in data.points.keys() {
            let id = PointId(found.points.len());
            found.points.push(Point {
                body: names.bodies[body.as_str()],
                holds: Vec::new(),
                bears_wheel: false,
            });
            for axis in 0..2 {
                let dimension = found.add(Dimension::Point(id, axis));
                // With a tolerance a point is an object.
                for own in ["", ".position"] {
                    let path = format!("bodies.{body}.points.{point}{own}[{axis}]");
                    found.tell(path, dimension, 1.0);
                }
            }
        }
    }
    for (index, joint) in model.joints.values().enumerate() {
        if let JointKind::Gear { .. } = joint.kind {
            add_wheels(found, model, names, (system, index));
            continue;
        }
        let mut blocks = vec![&system.blocks[index]];
        blocks.extend(driver_of(system, index).map(|id| driver_block(system, id)));
        for end in &joint.between {
            let Some((id, marker)) = names.points.get(&(end.body.as_str(), end.point.as_str()))
            else {
                continue;
            };
            let data = &system.joints[index];
            let guide = data.role().axis().map(|_| data.points()[0].body);
            let holds = blocks.iter().map(|block| Hold {
                guide,
                ..Hold::of(block, marker.body)
            });
            found.points[id.0].holds.extend(holds);
        }
    }
}

/// The driver that moves along the guide of a joint.
fn driver_of(system: &System, joint: usize) -> Option<usize> {
    let of =
        |role: DriverRole| matches!(role, DriverRole::Translation { joint: own } if own.0 == joint);
    system.drivers.iter().position(|driver| of(driver.role))
}

fn add_joints(found: &mut Dimensions, model: &Model, system: &System) {
    for (index, (name, joint)) in model.joints.iter().enumerate() {
        let row = system.blocks[index].row();
        let angle = |found: &mut Dimensions, row: usize| {
            let dimension = found.add(Dimension::Angle { row });
            found.tell(format!("joints.{name}.angle"), dimension, 1.0);
        };
        match &joint.kind {
            JointKind::Prismatic { axis, .. } | JointKind::Slot { axis, .. } => {
                let dimension = found.add(Dimension::Direction {
                    joint: index,
                    driver: driver_of(system, index),
                });
                let square = axis[0] * axis[0] + axis[1] * axis[1];
                found.tell(
                    format!("joints.{name}.axis[0]"),
                    dimension,
                    -axis[1] / square,
                );
                found.tell(
                    format!("joints.{name}.axis[1]"),
                    dimension,
                    axis[0] / square,
                );
                if let JointKind::Prismatic { .. } = joint.kind {
                    angle(found, row + 1);
                }
            }
            JointKind::Fixed { .. } => angle(found, row + 2),
            JointKind::Gear { angle: own, .. } => {
                let Some(carrier) = carrier(system, index) else {
                    continue;
                };
                let bodies = system.joints[index].bodies();
                let as_drawn = drawn(system, bodies[0]) - drawn(system, carrier);
                let dimension = found.add(Dimension::Ratio {
                    joint: index,
                    carrier,
                    drawn: if own.is_none() { as_drawn } else { 0.0 },
                });
                found.tell(format!("joints.{name}.ratio"), dimension, 1.0);
                match own {
                    Some(_) => angle(found, row),
                    None => add_mesh(found, model, joint, (row, carrier)),
                }
            }
            // A pin has none, an outline holds nothing if nothing touches, and other kinds are refused.
            _ => {}
        }
    }
}

/// The values of all dimensions of a model, in the order of [`dimensions`]; of motions the numbers that stand in the file.
pub(super) fn dimension_values(model: &Model, system: &System) -> Vec<f64> {
    let mut values = Vec::new();
    for data in model.bodies.values() {
        values.extend(data.points.values().flatten());
    }
    for (index, joint) in model.joints.values().enumerate() {
        match &joint.kind {
            JointKind::Prismatic { axis, angle, .. } => {
                values.extend([axis[1].atan2(axis[0]), *angle]);
            }
            JointKind::Slot { axis, .. } => values.push(axis[1].atan2(axis[0])),
            JointKind::Fixed { angle } => values.push(*angle),
            JointKind::Gear { ratio, angle, .. } => {
                if let Some(carrier) = carrier(system, index) {
                    values.push(*ratio);
                    values.push(angle.unwrap_or_else(|| mesh(model, system, index, carrier)));
                }
            }
            _ => {}
        }
    }
    for data in model.drivers.values() {
        values.extend(motion_values(&data.motion));
    }
    values
}
