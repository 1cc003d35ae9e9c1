//! What touches in cams: curves, by the model alone.

use super::laws;
use crate::element::cam::{Curve, Support, Touch, curve};
use crate::motion::Pieces;
use linkdyn_linear::math::{Vec2, perp, unit};
use linkdyn_model::error::Complaint;
use linkdyn_model::{Follower, JointKind, Model, Profile, cam};
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::sync::Arc;

/// What touches in each cam.
pub(super) fn touches<'a>(
    model: &'a Model,
    complaints: &mut Vec<Complaint>,
) -> HashMap<&'a str, Touch> {
    let mut touches = HashMap::new();
    for (name, joint) in &model.joints {
        let JointKind::Cam(cam) = &joint.kind else {
            continue;
        };
        match touch(cam) {
            Ok(touch) => {
                touches.insert(name.as_str(), touch);
            }
            Err((key, message, hint)) => {
                let path = format!("joints.{name}.profile{key}");
                complaints.push(Complaint::new(path, message).hint(hint));
            }
        }
    }
    touches
}

/// Key from the profile on, message and hint.
type ProfileFault = (&'static str, &'static str, &'static str);

/// What touches; a face that lies as the follower's x axis where a hole was in the file.
fn touch(cam: &cam::Cam) -> Result<Touch, ProfileFault> {
    let roller = cam.roller_radius.unwrap_or(0.0);
    let radius = match cam.follower {
        Follower::Flat => {
            let normal = perp(unit(Vec2::from(cam.face.unwrap_or([1.0, 0.0]))));
            let support = Arc::new(face(&cam.profile, normal)?);
            return Ok(Touch::Face { normal, support });
        }
        Follower::Roller => roller,
        Follower::Knife => 0.0,
    };
    let form = match &cam.profile {
        Profile::Circle { centre, radius } => curve::Form::Circle {
            centre: Vec2::from(*centre),
            radius: *radius,
        },
        Profile::Points { .. } => curve::Form::Polar(polar(&cam.profile)),
        Profile::Law {
            base_radius,
            axis,
            offset,
            begin,
            segments,
        } => {
            let pitch = base_radius + radius;
            curve::Form::Slide {
                law: laws::turn(*begin, segments),
                axis: unit(Vec2::from(axis.unwrap_or([0.0, 1.0]))),
                height: (pitch * pitch - offset * offset).sqrt(),
                offset: *offset,
            }
        }
        Profile::Swing {
            arm,
            distance,
            axis,
            angle,
            begin,
            segments,
        } => curve::Form::Swing {
            law: laws::turn(*begin, segments),
            axis: unit(Vec2::from(*axis)),
            distance: *distance,
            arm: *arm,
            angle: *angle,
        },
    };
    let curve = Curve::new(form).ok_or(LOOP)?;
    Ok(Touch::Round {
        radius,
        curve: Arc::new(curve),
    })
}

const LOOP: ProfileFault = (
    "",
    "the cam of this motion makes a loop: seen from its point, the follower does not go once around in one sense",
    "slower rises, a larger base radius or less offset; for a curve through points more of them",
);

const HOLLOW: ProfileFault = (
    "",
    "the curve through the points is hollow somewhere, where a flat face can't touch it",
    "take a roller, or points of a convex curve",
);

/// What a face touches.
fn face(profile: &Profile, normal: Vec2) -> Result<Support, ProfileFault> {
    match profile {
        Profile::Circle { centre, radius } => {
            Ok(Support::circle(Vec2::from(*centre), *radius, normal))
        }
        Profile::Law {
            base_radius,
            begin,
            segments,
            ..
        } => Ok(Support::law(
            *base_radius,
            laws::turn(*begin, segments),
            normal,
        )),
        // the gate lets no face have the motion of an arm
        Profile::Points { .. } | Profile::Swing { .. } => {
            let curve = Curve::new(curve::Form::Polar(polar(profile))).ok_or(LOOP)?;
            Support::curve(curve, normal).ok_or(HOLLOW)
        }
    }
}

/// The radius over the angle of a curve through points.
fn polar(profile: &Profile) -> Pieces {
    let mut points = profile.polar().unwrap_or_else(|| vec![[0.0, 1.0]]);
    let [angle, radius] = points[0];
    points.push([angle + TAU, radius]);
    Pieces::periodic(&points)
}
