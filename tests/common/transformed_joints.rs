//! Joints told otherwise: turned, mirrored, with their bodies exchanged.

use super::cams::mirror_cam;
use super::limits::{flip_limits, turn_limits};
use super::outlines::{mirror_outline, turn_contact};
use super::turned;
use linkdyn_model::{Bushing, GROUND, Joint, JointKind, PerAxis, Strands};

/// A joint of a mechanism that has turned about the ground's origin; `carrier` bears the wheels of a gear.
pub fn rotate(joint: &mut Joint, angle: f64, carrier: Option<&str>) {
    let [first, second] = [0, 1].map(|end: usize| joint.between[end].body == GROUND);
    // Relative angles against the ground, which has not turned.
    let relative = angle * (f64::from(u8::from(first)) - f64::from(u8::from(second)));
    match &mut joint.kind {
        JointKind::Revolute { .. } => turn_limits(&mut joint.stops, |limit| limit + relative),
        JointKind::Prismatic {
            axis,
            angle: relative_angle,
            ..
        } => {
            if first {
                *axis = turned(*axis, angle);
            }
            *relative_angle += relative;
        }
        JointKind::Slot { axis, .. } if first => *axis = turned(*axis, angle),
        JointKind::Gear {
            ratio, angle: mesh, ..
        } => {
            let turns = |fixed: bool| if fixed { 0.0 } else { angle };
            let carried = turns(carrier == Some(GROUND));
            if let Some(mesh) = mesh {
                *mesh += turns(second) - carried - *ratio * (turns(first) - carried);
            }
        }
        // A wheel that turns with the picture while the rack does not has rolled, and the other way round.
        JointKind::Rack {
            axis,
            radius,
            offset,
        } => {
            if second {
                *axis = turned(*axis, angle);
            }
            *offset = offset.map(|offset| offset - *radius * relative);
        }
        JointKind::Bushing(bushing) => {
            // The axes of the ground stay, and with them what yields otherwise along each.
            assert!(!first || knows_no_axes(bushing));
            bushing.free_angle += relative;
        }
        JointKind::Fixed {
            angle: relative_angle,
        } => *relative_angle += relative,
        // The cams here are of moving bodies, in whose frames everything stays.
        JointKind::Cam(_) => assert!(!first && !second),
        kind @ JointKind::Contact { .. } => turn_contact(kind, [first, second], angle),
        // As drawn.
        _ => {}
    }
}

/// A joint behind a mirror, x ↦ −x.
pub fn mirror(joint: &mut Joint) {
    let mirrored = |[x, y]: [f64; 2]| [-x, y];
    match &mut joint.kind {
        JointKind::Revolute { .. } => flip_limits(&mut joint.stops),
        JointKind::Prismatic { axis, angle, .. } => {
            *axis = mirrored(*axis);
            *angle = -*angle;
        }
        JointKind::Slot { axis, .. } => *axis = mirrored(*axis),
        JointKind::Gear { angle, .. } => *angle = angle.map(|angle| -angle),
        // The line stays, and the axis' left side becomes its right.
        JointKind::Rack { axis, radius, .. } => {
            *axis = mirrored(*axis);
            *radius = -*radius;
        }
        JointKind::Bushing(bushing) => bushing.free_angle = -bushing.free_angle,
        JointKind::Fixed { angle } => *angle = -*angle,
        JointKind::Cam(cam) => mirror_cam(cam),
        kind @ JointKind::Contact { .. } => mirror_outline(kind),
        // As drawn.
        _ => {}
    }
}

/// Its first and second body exchanged, where a joint knows no difference between them.
pub fn swap(joint: &mut Joint) {
    match &mut joint.kind {
        JointKind::Revolute { .. } => {
            flip_limits(&mut joint.stops);
            joint.between.reverse();
        }
        JointKind::Fixed { angle } => {
            *angle = -*angle;
            joint.between.reverse();
        }
        // θ₁ − θ_c = (θ₂ − θ_c)/r − angle/r.
        JointKind::Gear { ratio, angle, .. } => {
            *angle = angle.map(|angle| -angle / *ratio);
            *ratio = ratio.recip();
            joint.between.reverse();
        }
        JointKind::Bushing(bushing) if is_elastic(bushing) => {
            bushing.free_angle = -bushing.free_angle;
            joint.between.reverse();
        }
        JointKind::Belt { radii, .. } => {
            radii.reverse();
            joint.between.reverse();
        }
        _ => {}
    }
}

/// What [`swap`] makes of a joint's force and torque.
pub fn swapped_signs(joint: &Joint) -> [f64; 2] {
    match joint.kind {
        JointKind::Revolute { .. } | JointKind::Fixed { .. } => [-1.0, -1.0],
        JointKind::Bushing(ref bushing) if is_elastic(bushing) => [-1.0, -1.0],
        // The torque is the tooth force's moment on the other wheel, at the other radius.
        JointKind::Gear { ratio, .. } => [-1.0, -ratio],
        // The torque on the other pulley.
        JointKind::Belt { radii, strands, .. } => match strands {
            Strands::Open => [-1.0, -radii[0] / radii[1]],
            Strands::Crossed => [-1.0, radii[0] / radii[1]],
        },
        _ => [1.0, 1.0],
    }
}

/// Whether a bushing yields alike in all directions.
fn knows_no_axes(bushing: &Bushing) -> bool {
    let alike = |PerAxis([x, y]): PerAxis| x == y;
    alike(bushing.radial_stiffness) && alike(bushing.radial_damping)
}

/// Whether, besides, its force goes through both of its points: damping sees the axes of the first body turn.
fn is_elastic(bushing: &Bushing) -> bool {
    knows_no_axes(bushing) && bushing.radial_damping.0 == [0.0; 2]
}
