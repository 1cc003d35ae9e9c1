//! What of a model is not written as equations: all of it, each with what is.

use linkdyn_model::error::Complaint;
use linkdyn_model::{
    ClearanceModel, DriverKind, ForceKind, FrictionLaw, GROUND, Joint, JointKind, Model, Motion,
    Value,
};
use serde::Serialize;

use super::law::TimeLaw;

/// Bodies that move, at most: text that nobody reads is of no use.
const MOST_BODIES: usize = 40;

const JOINTS: &str = "revolute, prismatic and fixed joints are";
const DRIVERS: &str = "drivers of type rotation and translation are";
const FORCES: &str = "spring, torsion_spring, actuator, force and torque are";
const LAWS: &str = "polynomial, constant_velocity, constant_acceleration and harmonic motions are";

/// A complaint that something is not written.
fn not_written(path: impl Into<String>, what: &str, is: &str) -> Complaint {
    Complaint::new(path, format!("{what} is not written as equations")).hint(is)
}

/// All that is not written.
pub fn refused(model: &Model) -> Vec<Complaint> {
    let mut complaints = Vec::new();
    let moving = model.bodies.keys().filter(|name| *name != GROUND).count();
    if moving == 0 {
        complaints.push(
            Complaint::new("bodies", "no body moves, so that there is nothing to write")
                .hint("add a body other than \"ground\""),
        );
    }
    if moving > MOST_BODIES {
        let message = format!("{moving} moving bodies are too many to be written as equations");
        complaints.push(Complaint::new("bodies", message).hint(format!("{MOST_BODIES} at most")));
    }
    for (name, body) in &model.bodies {
        if body.elastic.is_some() {
            let path = format!("bodies.{name}.elastic");
            complaints.push(not_written(path, "a body that bends", "rigid bodies are"));
        }
    }
    for (name, joint) in &model.joints {
        complaints.extend(of_joint(&format!("joints.{name}"), joint));
    }
    for (name, driver) in &model.drivers {
        let path = format!("drivers.{name}");
        match driver.kind {
            DriverKind::Rotation { .. } | DriverKind::Translation { .. } => {}
            DriverKind::Length { .. } | DriverKind::Point { .. } => {
                let what = format!("a driver of type {}", word(&driver.kind));
                complaints.push(not_written(&path, &what, DRIVERS));
            }
        }
        complaints.extend(of_motion(&format!("{path}.motion"), &driver.motion));
    }
    for (name, force) in &model.forces {
        let path = format!("forces.{name}");
        match &force.kind {
            ForceKind::Spring { .. }
            | ForceKind::Actuator { .. }
            | ForceKind::TorsionSpring { .. }
            | ForceKind::Load { .. }
            | ForceKind::Torque { .. } => {
                for (key, value, _) in force.kind.values() {
                    complaints.extend(of_value(&format!("{path}.{key}"), value));
                }
            }
            ForceKind::GasSpring { .. }
            | ForceKind::Cylinder { .. }
            | ForceKind::DcMotor { .. }
            | ForceKind::Cable { .. } => {
                let what = format!("a force of type {}", word(&force.kind));
                complaints.push(not_written(&path, &what, FORCES));
                continue;
            }
        }
        if force.stroke.limits.is_some() {
            let path = format!("{path}.limits");
            complaints.push(not_written(
                path,
                "a stroke that ends",
                "strokes without limits are",
            ));
        }
    }
    for name in model.states.keys() {
        let path = format!("states.{name}");
        complaints.push(not_written(
            path,
            "a state with a rate of its own",
            "mechanisms are",
        ));
    }
    complaints
}

/// What of a joint is not written.
fn of_joint(path: &str, joint: &Joint) -> Vec<Complaint> {
    let mut complaints = Vec::new();
    match &joint.kind {
        JointKind::Revolute { clearance, .. } => {
            let is_ideal = |model| model == ClearanceModel::Ideal;
            if clearance.as_deref().is_some_and(|own| !is_ideal(own.model)) {
                let path = format!("{path}.clearance");
                let is = "clearances with the model \"ideal\" are";
                complaints.push(not_written(path, "a clearance", is));
            }
        }
        JointKind::Prismatic { .. } | JointKind::Fixed { .. } => {}
        JointKind::Slot { .. }
        | JointKind::Gear { .. }
        | JointKind::Cam(_)
        | JointKind::Rack { .. }
        | JointKind::Rolling { .. }
        | JointKind::Belt { .. }
        | JointKind::Bushing(_)
        | JointKind::Beam(_)
        | JointKind::Contact { .. } => {
            let what = format!("a joint of type {:?}", joint.kind.word());
            return vec![not_written(path, &what, JOINTS)];
        }
    }
    let has_friction = |law| law != FrictionLaw::None;
    if joint
        .kind
        .friction()
        .is_some_and(|own| has_friction(own.law))
    {
        let path = format!("{path}.friction");
        complaints.push(not_written(path, "friction", "joints without it are"));
    }
    let stops = &joint.stops;
    let more = [
        ("limits", stops.limits.is_some(), "a way that ends"),
        ("latch", stops.latch.is_some(), "a latch"),
        (
            "active",
            stops.active.is_some(),
            "a joint that opens or closes",
        ),
        ("lock", stops.lock.is_some(), "a lock"),
        ("one_way", stops.one_way.is_some(), "a one-way clutch"),
    ];
    let more = more.into_iter().filter(|(_, is_there, _)| *is_there);
    let more = more.map(|(key, _, what)| {
        let is = "joints that hold all the time and move without end are";
        not_written(format!("{path}.{key}"), what, is)
    });
    complaints.extend(more);
    complaints
}

fn of_value(path: &str, value: &Value) -> Option<Complaint> {
    match value {
        Value::Constant(_) => None,
        Value::Motion(motion) => of_motion(path, motion),
        Value::Formula(_) => {
            let is = "constants and laws of time are";
            Some(not_written(path, "a formula of the motion", is))
        }
    }
}

fn of_motion(path: &str, motion: &Motion) -> Option<Complaint> {
    let what = || format!("a motion of type {}", word(motion));
    let is_known = TimeLaw::of_motion(motion).is_some();
    (!is_known).then(|| not_written(path, &what(), LAWS))
}

/// The `type` of something in a file, as it is quoted.
fn word(kind: &impl Serialize) -> String {
    let written = serde_json::to_value(kind).unwrap_or_default();
    written["type"].to_string()
}
