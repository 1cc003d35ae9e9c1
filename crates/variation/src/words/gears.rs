//! What gears take from a model: centres of their wheels, ratio, and the angle at which they mesh as drawn.

use super::super::geometry::{Dimension, Dimensions, Hold};
use super::names::Names;
use linkdyn_engine::element::{BodyId, Kinematics, Pose, Twist};
use linkdyn_engine::system::{JointRole, System};
use linkdyn_model::{GROUND, Joint, JointKind, Model};

/// What a gear takes from the points of its centres: its term t·d/ℓ from those of the wheels, t and ℓ from those that bear them.
pub(super) fn add_wheels(
    found: &mut Dimensions,
    model: &Model,
    names: &Names,
    (system, index): (&System, usize),
) {
    let Some((name, joint)) = model.joints.get_index(index) else {
        return;
    };
    let Some(Ok(carrier)) = model.carrier(name, joint) else {
        return;
    };
    let block = &system.blocks[index];
    let curvature = gear_curvature(system, index);
    let pinned = |point: &str| {
        let mut ends = model.joints.values().flat_map(|joint| &joint.between);
        ends.any(|end| end.body == carrier.body && end.point == point)
    };
    for (end, centre) in joint.between.iter().zip(carrier.centres) {
        let wheel = names.bodies[end.body.as_str()];
        if let Some(id) = names.point(&end.body, &end.point) {
            let most = curvature;
            let hold = Hold::of(block, wheel);
            found.points[id.0].holds.push(Hold { most, ..hold });
        }
        let mut points = model.bodies[carrier.body].points.iter();
        let bearing = points.find(|(point, place)| **place == centre && pinned(point));
        if let Some(id) = bearing.and_then(|(point, _)| names.point(carrier.body, point)) {
            let (sign, most) = (-1.0, curvature);
            let hold = Hold::of(block, wheel);
            found.points[id.0].holds.push(Hold { sign, most, ..hold });
            found.points[id.0].bears_wheel = true;
        }
    }
}

/// Angle of a body as drawn \[rad\].
pub(super) fn drawn(system: &System, body: BodyId) -> f64 {
    let columns = system.layout.columns(body);
    columns.map_or(0.0, |columns| system.guess[columns.theta()])
}

/// β of a gear that meshes as drawn: (θ₂ − θ_c) − r (θ₁ − θ_c) of the poses.
pub(super) fn add_mesh(
    found: &mut Dimensions,
    model: &Model,
    joint: &Joint,
    (row, carrier): (usize, BodyId),
) {
    let JointKind::Gear { ratio, .. } = &joint.kind else {
        return;
    };
    let dimension = found.add(Dimension::Mesh { row });
    let [first, second] = &joint.between;
    let mut factors = vec![(first.body.as_str(), -ratio), (second.body.as_str(), 1.0)];
    factors.extend(moving_name(model, carrier).map(|name| (name, ratio - 1.0)));
    for (body, factor) in factors {
        found.tell(format!("bodies.{body}.pose.angle"), dimension, factor);
    }
}

/// Name of a body that moves.
fn moving_name(model: &Model, body: BodyId) -> Option<&str> {
    let mut names = model.bodies.keys().filter(|name| *name != GROUND);
    names.nth(body.index()?).map(String::as_str)
}

/// |1/R₂| of a gear [1/m]: an arc at the pitch circle times it is an angle of the second wheel.
pub(super) fn gear_curvature(system: &System, joint: usize) -> f64 {
    let block = &system.blocks[joint];
    let still = vec![Pose::GROUND; system.bodies.len() + 1];
    let twists = vec![Twist::default(); still.len()];
    let at = Kinematics {
        poses: &still,
        twists: &twists,
        drive: &[],
        offset: &[],
        sides: &[],
        states: &[],
        contacts: &[],
        time: 0.0,
    };
    let mut values = vec![0.0; block.entries().len()];
    block.constraint.jacobian(&at, &mut values);
    // k t stands in the entries of the second centre.
    values[3].hypot(values[4])
}

/// β of the poses of a model, less what its ratio adds to that of the nominal poses: that follows from the ratio.
pub(super) fn mesh(model: &Model, system: &System, index: usize, carrier: BodyId) -> f64 {
    let joint = &model.joints[index];
    let JointKind::Gear { ratio, .. } = &joint.kind else {
        return 0.0;
    };
    let angle = |name: &str| match name {
        GROUND => 0.0,
        name => model.bodies[name].pose.angle,
    };
    let borne = moving_name(model, carrier).map_or(0.0, angle);
    let [first, second] = [0, 1].map(|end: usize| angle(&joint.between[end].body) - borne);
    let nominal = drawn(system, system.joints[index].bodies()[0]) - drawn(system, carrier);
    second - ratio * (first - nominal)
}

/// The body that bears both wheels of a gear.
pub(super) fn carrier(system: &System, joint: usize) -> Option<BodyId> {
    debug_assert!(system.joints[joint].role() == JointRole::Gear);
    let entries = system.blocks[joint].constraint.entries();
    entries.last().map(|(_, body, _)| *body)
}
