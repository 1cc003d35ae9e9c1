//! Diagnosis of a model without running it.

use std::f64::consts::FRAC_PI_2;

use super::assembly::{Assembled, assemble, check_driven, listed, ranked, topology};
use super::instants::instants;
use super::{Stop, suspicious};
use crate::system::{Evaluation, Inputs, System, compile::compile, compile::compile_geometry};
use linkdyn_linear::math::Vec2;
use linkdyn_model::error::Complaint;
use linkdyn_model::{
    AnalysisKind, Checked, ClearanceModel, ForceKind, GROUND, JointKind, Model, PointRef, Pose,
    Sample, Value,
};
use linkdyn_output::{Mobility, Status};

/// What `check` finds.
#[derive(Debug, Clone, Default)]
pub struct Check {
    /// `Completed` where the model assembles.
    pub status: Status,
    /// Why it does not.
    pub message: Option<String>,
    /// Moving bodies.
    pub bodies: usize,
    pub joints: usize,
    /// Each as the names of its joints.
    pub loops: Vec<String>,
    /// The bodies that each loop goes through, ground left out.
    pub loop_bodies: Vec<Vec<String>>,
    /// With ideal pins.
    pub mobility: Mobility,
    /// With journals free in their bearings, where some are.
    pub open: Option<Open>,
    /// What the mobility means for each analysis, in a sentence.
    pub words: String,
    /// Largest constraint residual after assembly, divided by the mechanism's size [–]; NaN where there is none.
    pub assembly_residual: f64,
    /// What each analysis that can't be run lacks; an analysis that is not listed can be run.
    pub missing: Vec<(AnalysisKind, Vec<String>)>,
    /// The data among that, by what is missing.
    pub lacks: Vec<Lack>,
    /// Allowed, and yet probably a slip.
    pub suspicious: Vec<Complaint>,
    pub warnings: Vec<String>,
    /// Faults of the model that do not keep it from being read (exit status 1).
    pub faults: Vec<String>,
}

/// A mechanism whose journals move freely in their bearings.
#[derive(Debug, Clone)]
pub struct Open {
    /// The joints of these journals.
    pub joints: Vec<String>,
    pub mobility: Mobility,
}

/// Bodies that lack the same data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lack {
    pub bodies: Vec<String>,
    /// `mass`, `inertia`.
    pub keys: Vec<&'static str>,
    /// The analyses that need it.
    pub analyses: Vec<AnalysisKind>,
}

/// Why a motion is not prescribed.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Undriven {
    TooFew(String),
    TooMany(String),
    /// Nothing can start from here.
    Singular(String),
}

/// Diagnoses a model.
///
/// # Errors
/// Faults of the input.
pub fn check(model: &Checked) -> Result<Check, Vec<Complaint>> {
    let system = compile(&model.with_clearances(|_| false), AnalysisKind::Assembly)?;
    let topology = topology(&system);
    let names: Vec<&str> = system
        .joints
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    let mut check = Check {
        bodies: system.bodies.len(),
        joints: system.joints.len(),
        loops: topology.loop_names(&names),
        loop_bodies: topology
            .loops()
            .iter()
            .map(|one| moving_names(&system, &one.bodies))
            .collect(),
        ..Check::default()
    };
    check.mobility.grubler = topology.mobility();
    check.mobility.drivers = system.drivers.len();
    let unheld: Vec<&str> = topology
        .unheld_bodies()
        .iter()
        .map(|&body| system.bodies[body - 1].name.as_str())
        .collect();
    check.suspicious.extend(unheld.first().map(|first| {
        let others = if unheld.len() > 1 {
            format!(", nor {}", listed(&unheld[1..], ", "))
        } else {
            String::new()
        };
        Complaint::new(
            format!("bodies.{first}"),
            format!("no joint holds it{others}"),
        )
        .hint("connect it by a joint or take it out, unless it is to move freely")
    }));
    let end = end_of_run(model, &system)?;
    check.suspicious.extend(
        end.into_iter()
            .flat_map(|end| suspicious::tables(model, end)),
    );
    let inputs = Inputs::at_time(&system, 0.0);
    let assembled = match assemble(&system, &inputs) {
        Ok(assembled) => assembled,
        Err(Stop::Input(complaints)) => return Err(complaints),
        Err(Stop::Failed { status, message }) => {
            check.status = status;
            check.mobility = super::assembly::counted(&system);
            check.message = Some(message);
            check.assembly_residual = f64::NAN;
            check.words = format!(
                "{}; it can't be assembled",
                freedom_text(check.mobility.rank)
            );
            return Ok(check);
        }
    };
    let mut evaluation = Evaluation::new(&system);
    evaluation.set_position(&assembled.q);
    evaluation.eval_phi(&system, &inputs);
    check.assembly_residual = system.scaled_residual(&evaluation.phi);
    check.mobility = assembled.mobility.clone();
    check.warnings.extend(assembled.warnings.iter().cloned());
    let q = assembled.q.clone();
    let undriven = if journals_move(model) {
        let (open, undriven) = open(model, assembled)?;
        check.open = Some(open);
        undriven
    } else {
        undriven(&system, &assembled, &inputs)
    };
    check.lacks = lacks(model);
    check.missing = missing(
        model,
        undriven.as_ref(),
        &check.lacks,
        check.mobility.rank as usize,
    );
    check.words = words(model, undriven.as_ref(), &check);
    check.suspicious.extend(turned_over(model, &system, &q));
    check.suspicious.extend(odd_springs(model, &system, &q));
    Ok(check)
}

/// Why the drivers do not prescribe the motion.
fn undriven(system: &System, assembled: &Assembled, inputs: &Inputs) -> Option<Undriven> {
    match check_driven(system, assembled, inputs) {
        Ok(()) => None,
        Err(Stop::Input(complaints)) => complaints.first().map(|complaint| {
            let message = complaint.message.clone();
            if complaint.message.starts_with("too many") {
                Undriven::TooMany(message)
            } else {
                Undriven::TooFew(message)
            }
        }),
        Err(Stop::Failed { message, .. }) => Some(Undriven::Singular(message)),
    }
}

/// The mechanism with its journals free, at the position that it has with ideal pins, as a run has it. Its motion is
/// integrated whatever the analysis, so that only too many drivers are in the way.
fn open(model: &Checked, closed: Assembled) -> Result<(Open, Option<Undriven>), Vec<Complaint>> {
    let system = compile_geometry(&model.with_clearances(is_open))?;
    let inputs = Inputs::at_time(&system, 0.0);
    let assembled = ranked(&system, closed, &inputs);
    let undriven =
        undriven(&system, &assembled, &inputs).filter(|why| matches!(why, Undriven::TooMany(_)));
    let joints = clearances(model)
        .filter(|(_, model)| is_open(*model))
        .map(|(name, _)| name.to_string())
        .collect();
    Ok((
        Open {
            joints,
            mobility: assembled.mobility,
        },
        undriven,
    ))
}

/// When the run that the model asks for ends \[s\]; where a driver is sampled, it must pass the first and the last value, in this order.
fn end_of_run(model: &Model, system: &System) -> Result<Option<f64>, Vec<Complaint>> {
    let Some(analysis) = &model.analysis else {
        return Ok(None);
    };
    if matches!(
        analysis.kind,
        AnalysisKind::Assembly | AnalysisKind::Statics
    ) {
        return Ok(None);
    }
    let Some(sample) = &analysis.sample else {
        return Ok(analysis.end);
    };
    let mut ends = analysis.clone();
    let whole = sample.to - sample.from;
    ends.sample = Some(Sample {
        step: if whole == 0.0 { sample.step } else { whole },
        ..sample.clone()
    });
    instants(system, &ends).map(|instants| instants.last().map(|last| last.time))
}

fn moving_names(system: &System, bodies: &[usize]) -> Vec<String> {
    bodies
        .iter()
        .filter(|&&body| body > 0)
        .map(|&body| system.bodies[body - 1].name.clone())
        .collect()
}

/// Joints whose clearance is modelled.
fn clearances(model: &Model) -> impl Iterator<Item = (&str, ClearanceModel)> {
    model
        .joints
        .iter()
        .filter_map(|(name, joint)| match &joint.kind {
            JointKind::Revolute {
                clearance: Some(clearance),
                ..
            } if clearance.model != ClearanceModel::Ideal => Some((name.as_str(), clearance.model)),
            JointKind::Revolute { .. }
            | JointKind::Prismatic { .. }
            | JointKind::Slot { .. }
            | JointKind::Gear { .. }
            | JointKind::Fixed { .. } => None,
        })
}

/// Whether journals move freely in their bearings with this model.
fn is_open(model: ClearanceModel) -> bool {
    match model {
        ClearanceModel::Ideal | ClearanceModel::MasslessLink => false,
        ClearanceModel::TwoState | ClearanceModel::ThreeState | ClearanceModel::Contact => true,
    }
}

/// Whether journals move freely in their bearings, however the mechanism is driven.
fn journals_move(model: &Model) -> bool {
    clearances(model).any(|(_, model)| is_open(model))
}

/// Data that bodies lack, and for what.
fn lacks(model: &Model) -> Vec<Lack> {
    let heavy = model.gravity.iter().any(|g| *g != 0.0);
    let linked = clearances(model).next().is_some();
    let mut lacks: Vec<Lack> = Vec::new();
    for (name, body) in model.bodies.iter().filter(|(name, _)| *name != GROUND) {
        let keys = [
            ("mass", body.mass.is_none()),
            ("inertia", body.inertia.is_none()),
        ];
        let keys: Vec<&str> = keys
            .iter()
            .filter(|(_, lacks)| *lacks)
            .map(|(key, _)| *key)
            .collect();
        if keys.is_empty() {
            continue;
        }
        if let Some(same) = lacks.iter_mut().find(|lack| lack.keys == keys) {
            same.bodies.push(name.clone());
            continue;
        }
        let statics = heavy && keys.contains(&"mass");
        let analyses = [
            // The direction of a massless link is that of a force; a journal in contact moves by forces.
            (AnalysisKind::Kinematics, linked),
            (AnalysisKind::InverseDynamics, true),
            (AnalysisKind::Dynamics, true),
            (AnalysisKind::Statics, statics),
        ];
        let analyses = analyses
            .into_iter()
            .filter(|(_, needs)| *needs)
            .map(|(kind, _)| kind)
            .collect();
        lacks.push(Lack {
            bodies: vec![name.clone()],
            keys,
            analyses,
        });
    }
    lacks
}

/// The analyses that a model may be asked for.
const ANALYSES: [AnalysisKind; 4] = [
    AnalysisKind::Kinematics,
    AnalysisKind::InverseDynamics,
    AnalysisKind::Dynamics,
    AnalysisKind::Statics,
];

/// What keeps each analysis from running.
fn missing(
    model: &Model,
    undriven: Option<&Undriven>,
    lacks: &[Lack],
    freedom: usize,
) -> Vec<(AnalysisKind, Vec<String>)> {
    let of = |kind: AnalysisKind| {
        let mut missing = Vec::new();
        match (kind, undriven) {
            (
                AnalysisKind::Kinematics | AnalysisKind::InverseDynamics,
                Some(Undriven::TooFew(text) | Undriven::TooMany(text) | Undriven::Singular(text)),
            ) => missing.push(text.clone()),
            (AnalysisKind::Dynamics, _)
                if freedom == model.drivers.len() && !journals_move(model) =>
            {
                missing.push("every degree of freedom is driven: nothing is free to move".into());
            }
            (AnalysisKind::Dynamics | AnalysisKind::Statics, Some(Undriven::TooMany(text))) => {
                missing.push(text.clone())
            }
            (AnalysisKind::Kinematics | AnalysisKind::InverseDynamics, None)
            | (AnalysisKind::Assembly | AnalysisKind::Dynamics | AnalysisKind::Statics, _) => {}
        }
        if kind == AnalysisKind::Statics {
            missing.extend(
                clearances(model)
                    .map(|(name, _)| format!("an ideal clearance of joint \"{name}\"")),
            );
        }
        for lack in lacks.iter().filter(|lack| lack.analyses.contains(&kind)) {
            // At rest nothing is turned.
            let keys = if kind == AnalysisKind::Statics {
                "mass".to_string()
            } else {
                lack.keys.join(" and ")
            };
            missing.extend(
                lack.bodies
                    .iter()
                    .map(|body| format!("{keys} of body \"{body}\"")),
            );
        }
        (kind, missing)
    };
    ANALYSES
        .map(of)
        .into_iter()
        .filter(|(_, missing)| !missing.is_empty())
        .collect()
}

/// `1 degree of freedom`.
fn freedom_text(freedom: i64) -> String {
    match freedom {
        0 => "no degree of freedom".into(),
        1 => "1 degree of freedom".into(),
        n => format!("{n} degrees of freedom"),
    }
}

/// The analysis as a sentence calls it.
fn spoken(kind: AnalysisKind) -> &'static str {
    match kind {
        AnalysisKind::Assembly => "assembly",
        AnalysisKind::Kinematics => "kinematics",
        AnalysisKind::InverseDynamics => "inverse dynamics",
        AnalysisKind::Dynamics => "forward dynamics",
        AnalysisKind::Statics => "statics",
    }
}

/// `a`, `a and b`, `a, b and c`.
fn and<S: AsRef<str>>(words: &[S]) -> String {
    match words {
        [] => String::new(),
        [only] => only.as_ref().into(),
        [first @ .., last] => format!("{} and {}", listed(first, ", "), last.as_ref()),
    }
}

/// What the mobility means: `1 degree of freedom, driven by motor: kinematics and inverse dynamics are possible; …`.
fn words(model: &Model, undriven: Option<&Undriven>, check: &Check) -> String {
    let freedom = check.mobility.rank;
    let drivers: Vec<&str> = model.drivers.keys().map(String::as_str).collect();
    let count = drivers.len() as i64;
    let mut text = if check.open.is_some() {
        "with ideal pins ".to_string()
    } else {
        String::new()
    };
    text += &freedom_text(freedom);
    text += &match (count, freedom) {
        (0, 0) if check.open.is_some() => String::new(),
        (0, 0) => ", a structure: nothing in it can move".into(),
        (0, _) => ", none driven".into(),
        (_, _) if count > freedom => {
            format!(" and {count} drivers, {}", and(&drivers)).replace(" 1 drivers", " 1 driver")
        }
        (_, _) if count < freedom => format!(", {count} driven by {}", and(&drivers)),
        (_, _) => format!(", driven by {}", and(&drivers)),
    };
    let lacking = |kind: AnalysisKind| check.missing.iter().any(|(lacking, _)| *lacking == kind);
    let possible: Vec<&str> = ANALYSES
        .into_iter()
        .filter(|kind| !lacking(*kind))
        .map(spoken)
        .collect();
    text += &match possible.len() {
        0 => ": no analysis but the assembly is possible".into(),
        1 => format!(": {} is possible", possible[0]),
        _ => format!(": {} are possible", and(&possible)),
    };
    match undriven {
        Some(Undriven::TooFew(_)) if freedom > count => {
            let more = if freedom - count == 1 {
                "1 driver".into()
            } else {
                format!("{} drivers", freedom - count)
            };
            let more = if count == 0 {
                more
            } else {
                format!("{more} more")
            };
            text += &format!("; kinematics and inverse dynamics need {more}");
        }
        Some(Undriven::TooMany(_)) => {
            let freedom = check
                .open
                .as_ref()
                .map_or(freedom, |open| open.mobility.rank);
            text += &format!("; take {} of the drivers out", (count - freedom).max(1));
        }
        Some(Undriven::TooFew(said) | Undriven::Singular(said)) => text += &format!("; {said}"),
        None => {}
    }
    let held = freedom == count && !journals_move(model);
    if held && freedom > 0 {
        text += "; forward dynamics has nothing free";
    }
    if let Some(Open { joints, mobility }) = &check.open {
        let free = match joints.as_slice() {
            [joint] => format!("the journal of {joint} is free in its bearing"),
            joints => format!("the journals of {} are free in their bearings", and(joints)),
        };
        text += &format!("; {free}: {} in motion", freedom_text(mobility.rank));
    }
    let mut data: Vec<AnalysisKind> = check
        .lacks
        .iter()
        .flat_map(|lack| lack.analyses.iter().copied())
        .collect();
    data.retain(|kind| *kind != AnalysisKind::Dynamics || !held);
    let data: Vec<&str> = ANALYSES
        .into_iter()
        .filter(|kind| data.contains(kind))
        .map(spoken)
        .collect();
    if !data.is_empty() {
        text += &format!(
            "; {} {} data that bodies lack",
            and(&data),
            if data.len() == 1 { "needs" } else { "need" }
        );
    }
    text
}

/// Bodies that were drawn somewhere and assemble turned by more than a right angle from there.
fn turned_over(model: &Model, system: &System, q: &[f64]) -> Vec<Complaint> {
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
fn odd_springs(model: &Model, system: &System, q: &[f64]) -> Vec<Complaint> {
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
