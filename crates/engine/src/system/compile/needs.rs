//! What joints and analyses need beyond the words of a joint itself, and the complaints where it is not there.

use super::cam_curves::touches;
use super::contact_parameters::{Words, compared, friction_law, need};
use crate::contact::impact::Sense;
use crate::contact::{friction, normal};
use crate::element::cam::Touch;
use crate::element::journal::Bearing;
use crate::element::pair::{Compliant, Rigid, Surface};
use linkdyn_model::error::Complaint;
use linkdyn_model::{
    AnalysisKind, Carrier, ClearanceModel, FrictionLaw, GROUND, Joint, JointKind, Model,
};
use std::collections::{HashMap, HashSet};

/// Speed of sliding below which a motion of a radian or the mechanism's size a second does not slide but for round-off [m/s].
const SLOW: f64 = 1e-12;

/// What joints need beyond their own words, by their names.
pub(super) struct Joints<'a> {
    /// Of gears.
    pub carriers: HashMap<&'a str, Carrier<'a>>,
    /// Of clearances by contact.
    pub surfaces: HashMap<&'a str, Surface>,
    /// Of ideal joints.
    pub frictions: HashMap<&'a str, friction::Law>,
    /// Of cams.
    pub touches: HashMap<&'a str, Touch>,
}

impl<'a> Joints<'a> {
    pub fn new(model: &'a Model, complaints: &mut Vec<Complaint>) -> Self {
        Joints {
            carriers: carriers(model, complaints),
            surfaces: surfaces(model, complaints),
            frictions: frictions(model, complaints),
            touches: touches(model, complaints),
        }
    }

    /// Makes friction that of a slow motion.
    pub fn slow(&mut self) {
        for law in self.frictions.values_mut() {
            *law = law.slow(SLOW);
        }
    }
}

/// Surfaces of the joints whose clearance is modelled by contact.
fn surfaces<'a>(model: &'a Model, complaints: &mut Vec<Complaint>) -> HashMap<&'a str, Surface> {
    let mut surfaces = HashMap::new();
    for (name, joint) in &model.joints {
        match of_outline(name, joint) {
            Some(Ok(surface)) => {
                surfaces.insert(name.as_str(), surface);
            }
            Some(Err(complaint)) => complaints.push(complaint),
            None => {}
        }
        let Some(clearance) = joint.kind.clearance() else {
            continue;
        };
        let path = format!("joints.{name}.clearance");
        let words = Words {
            clearance,
            path: &path,
        };
        let compliant = |normal: Result<normal::Law, Complaint>| {
            Ok(Surface::Compliant(Compliant {
                normal: normal?,
                friction: words.friction_law()?,
            }))
        };
        let surface = match clearance.model {
            ClearanceModel::Ideal | ClearanceModel::MasslessLink => continue,
            ClearanceModel::TwoState => compliant(words.surface_law()),
            ClearanceModel::Contact => compliant(words.normal_law()),
            ClearanceModel::ThreeState => words.impact_parameters().map(Surface::Rigid),
        };
        match surface {
            Ok(surface) => {
                surfaces.insert(name.as_str(), surface);
            }
            Err(complaint) => complaints.push(complaint),
        }
    }
    surfaces
}

/// The surface of a joint that is a contact; none of other joints.
fn of_outline(name: &str, joint: &Joint) -> Option<Result<Surface, Complaint>> {
    let JointKind::Contact { friction, .. } = &joint.kind else {
        return None;
    };
    let path = format!("joints.{name}");
    let Some(words) = friction.as_deref() else {
        return Some(Ok(outline_surface(joint, friction::Law::None, 0.0)));
    };
    let coefficient = match words.law {
        FrictionLaw::None => Ok(0.0),
        _ => need(&path, "friction.coefficient", words.coefficient, |mu| {
            mu >= 0.0
        }),
    };
    // What is rigid sticks and slides by Coulomb's law itself.
    let law = match joint.stops.stiffness {
        None => Ok(friction::Law::None),
        Some(_) => friction_law(words, &path),
    };
    let both = law.and_then(|law| Ok((law, coefficient?)));
    Some(both.map(|(law, coefficient)| outline_surface(joint, law, coefficient)))
}

/// Friction laws of ideal joints.
fn frictions<'a>(
    model: &'a Model,
    complaints: &mut Vec<Complaint>,
) -> HashMap<&'a str, friction::Law> {
    let mut frictions = HashMap::new();
    for (name, joint) in &model.joints {
        let path = format!("joints.{name}");
        let (words, pin) = match &joint.kind {
            JointKind::Revolute { pin_radius, .. } => (joint.kind.friction(), Some(*pin_radius)),
            // that of a contact belongs to its surface
            JointKind::Contact { .. } => continue,
            kind => (kind.friction(), None),
        };
        let Some(words) = words else { continue };
        let radius = pin.map_or(Ok(0.0), |radius| {
            need(&path, "pin_radius", radius, |radius| radius > 0.0)
        });
        match friction_law(words, &path).and_then(|law| {
            if law == friction::Law::None {
                Ok(law)
            } else {
                radius.map(|_| law)
            }
        }) {
            Ok(friction::Law::None) => {}
            Ok(law) => {
                frictions.insert(name.as_str(), law);
            }
            Err(complaint) => complaints.push(complaint),
        }
    }
    frictions
}

/// Without a bearing radius the journal is taken for a point.
pub(super) fn bearing(clearance: &linkdyn_model::Clearance) -> Bearing {
    let radius = clearance.radius.unwrap_or(0.0);
    Bearing {
        clearance: radius,
        bearing_radius: clearance.bearing_radius.unwrap_or(radius),
    }
}

/// What the analysis needs and the model lacks.
pub(super) fn missing(model: &Model, analysis: AnalysisKind) -> Vec<Complaint> {
    let mut complaints = Vec::new();
    let mut linked = None;
    for (name, joint) in &model.joints {
        let Some(clearance) = joint.kind.clearance() else {
            continue;
        };
        match clearance.model {
            ClearanceModel::Ideal => {}
            ClearanceModel::MasslessLink => {
                linked = linked.or(Some(format!(
                    "the massless clearance link of joint \"{name}\", whose direction is that of the joint force,"
                )));
            }
            ClearanceModel::TwoState | ClearanceModel::ThreeState | ClearanceModel::Contact => {
                linked = linked.or(Some(format!(
                    "the journal of joint \"{name}\", which moves freely in its bearing,"
                )));
            }
        }
    }
    let why = match (analysis, linked) {
        (AnalysisKind::InverseDynamics, _) => Some("inverse dynamics".to_string()),
        (AnalysisKind::Dynamics, _) => Some("dynamics".to_string()),
        (AnalysisKind::Statics, _) if model.gravity.iter().any(|g| *g != 0.0) => {
            Some("statics under gravity".to_string())
        }
        (AnalysisKind::Kinematics, Some(who)) => Some(who),
        // Gravity acts on the bodies whose mass is given.
        (AnalysisKind::Kinematics, None)
        | (AnalysisKind::Assembly | AnalysisKind::Statics | AnalysisKind::QuasiStatics, _) => None,
    };
    if let Some(why) = why {
        let ends = model.joints.values().flat_map(|joint| &joint.between);
        let held: HashSet<&str> = ends.map(|end| end.body.as_str()).collect();
        for (name, body) in model.bodies.iter().filter(|(name, _)| *name != GROUND) {
            let (stray, hint) = if held.contains(name.as_str()) {
                ("", "")
            } else {
                (
                    ", which no joint holds",
                    "; or take the body out, or connect it by a joint",
                )
            };
            // At rest nothing is turned.
            let inertia = body.inertia.is_none() && analysis != AnalysisKind::Statics;
            for (key, lacks) in [("mass", body.mass.is_none()), ("inertia", inertia)] {
                if lacks {
                    complaints.push(
                        Complaint::new(
                            format!("bodies.{name}"),
                            format!("{why} needs the {key} of body \"{name}\"{stray}"),
                        )
                        .hint(format!("give \"{key}\"; 0 is allowed where the joints determine its motion{hint}")),
                    );
                }
            }
        }
    }
    complaints
}

/// The carrier of each gear.
fn carriers<'a>(
    model: &'a Model,
    complaints: &mut Vec<Complaint>,
) -> HashMap<&'a str, Carrier<'a>> {
    let mut carriers = HashMap::new();
    for (name, joint) in &model.joints {
        match model.carrier(name, joint) {
            Some(Ok(carrier)) => {
                carriers.insert(name.as_str(), carrier);
            }
            Some(Err(complaint)) => complaints.push(complaint),
            None => {}
        }
    }
    carriers
}

/// What an outline and a tip are made of; friction as it stands in the file.
fn outline_surface(joint: &Joint, friction: friction::Law, coefficient: f64) -> Surface {
    let stops = &joint.stops;
    match stops.stiffness {
        Some(stiffness) => Surface::Compliant(Compliant {
            normal: normal::Law::KelvinVoigt {
                stiffness,
                damping: stops.damping.unwrap_or(0.0),
            },
            friction,
        }),
        None => Surface::Rigid(Rigid {
            restitution: stops.restitution.unwrap_or(0.0),
            friction: coefficient,
            sense: stops.sense.map_or(Sense::Kinematic, compared),
            latch: None,
        }),
    }
}
