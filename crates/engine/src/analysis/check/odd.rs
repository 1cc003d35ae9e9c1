//! What is allowed and yet probably a slip, seen at the assembled position.

use std::f64::consts::FRAC_PI_2;

use crate::system::System;
use linkdyn_linear::math::Vec2;
use linkdyn_model::error::Complaint;
use linkdyn_model::{ForceKind, Model, PointRef, Pose, Value};

/// Bodies that were drawn somewhere and assemble turned by more than a right angle from there.
pub fn turned_over(model: &Model, system: &System, q: &[f64]) -> Vec<Complaint> {
    let mut found = Vec::new();
    for (body, columns) in system.bodies.iter().zip(system.layout.bodies()) {
        let Some(pose) = model.bodies.get(&body.name).map(|body| body.pose) else {
            continue;
        };
        let turned = q[columns.theta()] - pose.angle;
        let off = turned.sin().atan2(turned.cos());
        if pose != Pose::default() && off.abs() > FRAC_PI_2 {
            let off = model.display.angle_to(off, 3);
            let message = format!(
                "it assembles turned by {off} from this drawing, perhaps on the other branch"
            );
            let hint = "draw the pose nearer to the assembly that you want";
            found.push(Complaint::new(format!("bodies.{}.pose", body.name), message).hint(hint));
        }
    }
    found
}

/// Springs whose ends coincide at the assembled position or belong to one body, or whose free length is another by far.
pub fn odd_springs(model: &Model, system: &System, q: &[f64]) -> Vec<Complaint> {
    let place = |end: &PointRef| -> Option<Vec2> {
        let point = Vec2::from(*model.bodies.get(&end.body)?.points.get(&end.point)?);
        let Some(k) = system.bodies.iter().position(|body| body.name == end.body) else {
            return Some(point);
        };
        let [x, y, theta] = system.layout.moving(k).read(q);
        let ((sin, cos), s) = (theta.sin_cos(), point + system.bodies[k].origin);
        Some(Vec2::new(
            x + cos * s.x - sin * s.y,
            y + sin * s.x + cos * s.y,
        ))
    };
    let mut found = Vec::new();
    for (name, force) in &model.forces {
        let ForceKind::Spring {
            between,
            free_length,
            ..
        } = &force.kind
        else {
            continue;
        };
        let path = format!("forces.{name}.between");
        if between[0].body == between[1].body {
            let message = format!(
                "both ends are on {:?}: the spring moves nothing",
                between[0].body
            );
            found.push(Complaint::new(path, message).hint("a spring acts between two bodies"));
            continue;
        }
        let (Some(first), Some(second)) = (place(&between[0]), place(&between[1])) else {
            continue;
        };
        let length = (second - first).norm();
        if length <= CLOSED * system.size {
            let message = "the spring's ends coincide at the start: it has no direction there";
            found.push(Complaint::new(path, message).hint("check its two points"));
            continue;
        }
        let Value::Constant(free) = *free_length else {
            continue;
        };
        let odd = if free > STRETCHED * length.max(system.size) {
            Some("long")
        } else {
            (free > 0.0 && free * STRETCHED < length).then_some("short")
        };
        found.extend(odd.map(|than| {
            let [free, length] = [free, length].map(|length| model.display.length_to(length, LENGTH_DIGITS));
            let message =
                format!("the free length is very {than}, {free}: the two points are {length} apart at the start");
            Complaint::new(format!("forces.{name}.free_length"), message).hint("check its unit")
        }));
    }
    found
}

/// A spring shorter than this times the mechanism's size has no length [–].
const CLOSED: f64 = 1e-9;
/// Digits of lengths in messages that compare them.
const LENGTH_DIGITS: usize = 4;
/// No spring is stretched or pressed together to this many times its length [–].
const STRETCHED: f64 = 100.0;
