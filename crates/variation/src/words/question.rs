//! A model and its parameters as a question in numbers: what may be off, and what is asked about.

use super::super::corners::Corners;
use super::super::poses::{Halt, Unmet};
use super::super::source::Acts;
use super::super::{Accuracy, Levels, Question, forces, run};
use super::dimensions::{dimension_values, dimensions};
use super::forces::{making, refuse, scales};
use super::names::Names;
use super::outputs::{along, wanted};
use super::parameters::{Followed, Parameters, Straightness};
use super::sources::{levels, pins, sources};
use linkdyn_engine::analysis::question::instants;
use linkdyn_engine::analysis::{Control, Stop};
use linkdyn_engine::system::compile::compile_geometry;
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{AnalysisKind, Checked, DriverKind, Joint, JointKind, Model, PointRef};
use std::num::NonZeroUsize;

/// Why there is no answer.
#[derive(Debug)]
pub enum Refusal {
    /// Faults of the input.
    Input(Complaints),
    /// The mechanism can't be had: no assembly, a singular start.
    Failed(String),
}

impl From<Stop> for Refusal {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Input(complaints) => Refusal::Input(complaints.into()),
            Stop::Failed { message, .. } => Refusal::Failed(message),
        }
    }
}

impl From<Complaint> for Refusal {
    fn from(complaint: Complaint) -> Self {
        Refusal::Input(complaint.into())
    }
}

impl From<Complaints> for Refusal {
    fn from(complaints: Complaints) -> Self {
        Refusal::Input(complaints)
    }
}

/// Which outputs are wanted.
#[derive(Debug, Clone, Copy)]
pub enum Of<'a> {
    /// Those of the model's `accuracy`, by name; empty: all.
    Outputs(&'a [String]),
    /// Places of points along directions over half a turn, x·cos kπ/n + y·sin kπ/n for k = 0 … n − 1, at every instant: point after point.
    Points(&'a [PointRef], usize),
}

impl Default for Of<'_> {
    fn default() -> Self {
        Of::Outputs(&[])
    }
}

/// What of a model's question is wanted.
#[derive(Debug, Clone, Copy, Default)]
pub struct Scope<'a> {
    /// Which outputs.
    pub of: Of<'a>,
    /// None: those that the model says.
    pub levels: Option<Levels>,
    /// Threads that share the poses of a stroke; none: one. The answer does not hang on it.
    pub threads: Option<NonZeroUsize>,
}

/// What tolerances and clearances do to the outputs of a model.
///
/// # Errors
/// [`Refusal`]: nothing asked, outputs that do not exist, poses that the motion does not have, nothing that is off, joints that
/// hold the same freedom.
pub fn accuracy(
    model: &Checked,
    parameters: &Parameters,
    scope: Scope,
    control: &Control,
) -> Result<Accuracy, Refusal> {
    uncounted(model)?;
    let ideal = model.with_clearances(|_| false);
    let system = compile_geometry(&ideal)?;
    let names = Names::new(&ideal);
    let outputs = match scope.of {
        Of::Outputs(only) => wanted(&ideal, &system, &names, only)?,
        Of::Points(points, directions) => along(&names, points, directions),
    };
    let Some(analysis) = &ideal.analysis else {
        let hint = "add \"analysis\": { \"type\": \"kinematics\", \"end\": 1, \"outputs\": 101 }";
        return Err(Complaint::new(
            "analysis",
            "accuracy is asked along a motion, and the model says none",
        )
        .hint(hint)
        .into());
    };
    let at_rest = matches!(
        analysis.kind,
        AnalysisKind::Statics | AnalysisKind::QuasiStatics
    );
    if !outputs.forces.is_empty() {
        refuse(model, &ideal, &system, at_rest)?;
    }
    let all = dimensions(&ideal, &names, &system);
    let followed = Followed::new(&all, parameters, !outputs.forces.is_empty());
    let levels = scope.levels.unwrap_or_else(|| levels(model));
    // The first order asks for no bounds.
    let straightness = (levels > Levels::First).then(|| Straightness::new(&followed));
    let curved = straightness
        .as_ref()
        .map(|known| known.is_curved.as_slice());
    let sources = sources(model, &system, &names, &followed, curved)?;
    let nominal = dimension_values(&ideal, &system);
    let tolerated = followed.parameters.iter().map(|(index, _)| *index);
    let tolerated: Vec<usize> = tolerated.collect();
    let corners = |deviations: &[f64]| -> Option<Vec<f64>> {
        let given = tolerated
            .iter()
            .zip(deviations)
            .filter(|(_, by)| **by != 0.0);
        let given: Vec<(usize, f64)> = given.map(|(&index, by)| (index, *by)).collect();
        let steps = |values: Vec<f64>| values.iter().zip(&nominal).map(|(v, n)| v - n).collect();
        if given.is_empty() {
            return Some(vec![0.0; nominal.len()]);
        }
        let varied = (parameters.with)(&given)?.with_clearances(|_| false);
        Some(steps(dimension_values(&varied, &system)))
    };
    let instants = instants(&system, analysis)?.list(&system)?;
    let bears_wheel = |acts: &Acts| match acts {
        Acts::Point(point) => all.points[point.0].bears_wheel,
        Acts::Row(_) | Acts::Dimensions { .. } => false,
    };
    let zone_bears_wheel = sources.iter().any(|source| bears_wheel(&source.acts));
    let making = making(&ideal, &followed);
    let question = Question {
        slack: straightness
            .filter(|_| !zone_bears_wheel)
            .and_then(|known| known.slack),
        outputs: outputs.positions,
        forces: forces::ForceQuestion {
            outputs: outputs.forces,
            at_rest,
            scales: scales(&system, &sources, &followed),
            making: &*making,
        },
        sources,
        dimensions: &all,
        pins: pins(model),
        levels,
        instants,
        corners: &Corners::new(&corners),
    };
    let threads = scope.threads.unwrap_or(NonZeroUsize::MIN);
    run(&system, &question, threads, control).map_err(|halt| match halt {
        Halt::Stop(stop) => stop.into(),
        Halt::Unreached(all) => {
            let faults = all.iter().map(|unmet| outside(&ideal, unmet));
            Refusal::Input(Complaints(faults.collect()))
        }
    })
}

/// Joints and drivers of which it is not known what their dimensions do.
fn uncounted(model: &Model) -> Result<(), Complaint> {
    let kind = |kind: &JointKind| match kind {
        JointKind::Revolute { .. }
        | JointKind::Prismatic { .. }
        | JointKind::Slot { .. }
        | JointKind::Gear { .. }
        | JointKind::Fixed { .. }
        | JointKind::Contact { .. } => None,
        other => Some(format!("a joint of type {:?}", other.word())),
    };
    let mut joints = model.joints.iter();
    let open = |joint: &Joint| {
        let is_open = joint.stops.active.is_some() || joint.stops.lock.is_some();
        is_open.then(|| "what closes and opens".to_owned())
    };
    let found =
        joints.find_map(|(name, joint)| Some((name, kind(&joint.kind).or_else(|| open(joint))?)));
    let found = found.map(|(name, kind)| (format!("joints.{name}"), kind));
    let mut drivers = model.drivers.iter();
    let driven = drivers.find_map(|(name, driver)| {
        let kind = match driver.kind {
            DriverKind::Length { .. } => "a driven length",
            DriverKind::Point { .. } => "a driven point",
            DriverKind::Rotation { .. } | DriverKind::Translation { .. } => return None,
        };
        Some((format!("drivers.{name}"), kind.to_owned()))
    });
    let Some((path, kind)) = found.or(driven) else {
        return Ok(());
    };
    let message = format!(
        "accuracy does not count yet what is off in {kind}, and gives no answer that leaves it out"
    );
    let hint = "vary its numbers as parameters of a `study`, which runs the model with each";
    Err(Complaint::new(path, message).hint(hint))
}

/// What is said of a pose that the motion does not have.
fn outside(model: &Model, unmet: &Unmet) -> Complaint {
    let by = &unmet.by;
    let (name, driver) = model.drivers.get_index(by.driver).expect("a driver");
    let text = |value: f64| match driver.kind {
        DriverKind::Rotation { .. } => model.display.angle_to(value, 6),
        DriverKind::Translation { .. } | DriverKind::Length { .. } | DriverKind::Point { .. } => {
            model.display.length_to(value, 6)
        }
    };
    let [low, high] = by.range.map(text);
    let message = if by.is_stopped {
        format!("the mechanism locks before {name:?} has this value")
    } else {
        format!("{name:?} does not have this value in its motion")
    };
    Complaint::new(
        format!("accuracy.outputs.{}.at.value", unmet.output),
        message,
    )
    .found(text(unmet.value))
    .hint(format!("it goes from {low} to {high}"))
}
