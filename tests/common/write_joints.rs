//! Joints that roll, press and touch, in units of choice.

use super::Scale;
use linkdyn_model::{Bushing, Cam, CamSegment, Joint, JointKind, Profile, Strands};
use serde_json::{Value, json};

impl Scale {
    pub(super) fn rack(&self, joint: &Joint, between: &[String; 2]) -> Value {
        let JointKind::Rack {
            axis,
            radius,
            offset,
        } = &joint.kind
        else {
            panic!("no rack");
        };
        let radius = radius * self.length;
        let mut words =
            json!({ "type": "rack", "between": between, "axis": axis, "radius": radius });
        if let Some(offset) = offset {
            words["offset"] = json!(offset * self.length);
        }
        words
    }

    pub(super) fn contact(&self, joint: &Joint, between: &[String; 2]) -> Value {
        let JointKind::Contact {
            outline,
            repeat,
            radius,
            arc,
            friction,
        } = &joint.kind
        else {
            panic!("no contact");
        };
        let scaled =
            |node: &Vec<f64>| -> Vec<f64> { node.iter().map(|x| x * self.length).collect() };
        let outline: Vec<Vec<f64>> = outline.iter().map(scaled).collect();
        let mut words = json!({ "type": "contact", "between": between, "outline": outline, "radius": radius * self.length });
        if let Some(repeat) = repeat {
            words["repeat"] = json!(repeat);
        }
        if let Some(arc) = arc {
            words["arc"] = json!(arc.map(|angle| angle * self.angle));
        }
        if let Some(restitution) = joint.stops.restitution {
            words["restitution"] = json!(restitution);
        }
        assert!(
            joint.stops.sense.is_none() && joint.stops.stiffness.is_none() && friction.is_none()
        );
        words
    }

    pub(super) fn cam(&self, cam: &Cam, between: &[String; 2]) -> Value {
        let mut words = json!({ "type": "cam", "between": between, "follower": cam.follower });
        if let Some(face) = cam.face {
            words["face"] = json!(face);
        }
        if let Some(radius) = cam.roller_radius {
            words["roller_radius"] = json!(radius * self.length);
        }
        let segments = |segments: &[CamSegment], scale: f64| -> Value {
            let segments = segments.iter().map(|segment| match segment.law {
                Some(law) => json!({
                    "law": law, "rise": segment.rise.expect("a rise") * scale,
                    "angle": segment.angle.expect("an angle") * self.angle,
                }),
                None => json!({ "dwell": segment.dwell.expect("a dwell") * self.angle }),
            });
            segments.collect()
        };
        let place = |place: &[f64; 2]| place.map(|part| part * self.length);
        words["profile"] = match &cam.profile {
            Profile::Circle { centre, radius } => {
                json!({ "type": "circle", "centre": place(centre), "radius": radius * self.length })
            }
            Profile::Points { points } => {
                let points: Vec<_> = points.iter().map(place).collect();
                json!({ "type": "points", "points": points })
            }
            Profile::Law {
                base_radius,
                axis,
                offset,
                begin,
                segments: parts,
            } => {
                let mut law = json!({
                    "type": "law", "base_radius": base_radius * self.length, "offset": offset * self.length,
                    "begin": begin * self.angle, "segments": segments(parts, self.length),
                });
                if let Some(axis) = axis {
                    law["axis"] = json!(axis);
                }
                law
            }
            Profile::Swing {
                arm,
                distance,
                axis,
                angle,
                begin,
                segments: parts,
            } => json!({
                "type": "swing", "arm": arm * self.length, "distance": distance * self.length, "axis": axis,
                "angle": angle * self.angle, "begin": begin * self.angle, "segments": segments(parts, self.angle),
            }),
        };
        words
    }

    pub(super) fn bushing(&self, bushing: &Bushing, between: &[String; 2]) -> Value {
        let turning = self.mass * self.length * self.length / self.angle;
        json!({
            "type": "bushing", "between": between,
            "radial_stiffness": bushing.radial_stiffness.0.map(|each| each * self.mass),
            "radial_damping": bushing.radial_damping.0.map(|each| each * self.mass),
            "torsional_stiffness": bushing.torsional_stiffness * turning,
            "torsional_damping": bushing.torsional_damping * turning,
            "free_angle": bushing.free_angle * self.angle,
        })
    }

    pub(super) fn belt(&self, joint: &Joint, between: &[String; 2]) -> Value {
        let JointKind::Belt {
            radii,
            strands,
            pretension,
            carrier,
        } = joint.kind.clone()
        else {
            panic!("no belt");
        };
        let radii = radii.map(|radius| radius * self.length);
        let strands = match strands {
            Strands::Open => "open",
            Strands::Crossed => "crossed",
        };
        let mut words =
            json!({ "type": "belt", "between": between, "radii": radii, "strands": strands });
        if let Some(carrier) = carrier {
            words["carrier"] = json!(carrier);
        }
        let force = self.mass * self.length;
        for (key, value, scale) in [
            ("pretension", pretension, force),
            ("stiffness", joint.stops.stiffness, self.mass),
            ("damping", joint.stops.damping, self.mass),
        ] {
            if let Some(value) = value {
                words[key] = json!(value * scale);
            }
        }
        words
    }
}
