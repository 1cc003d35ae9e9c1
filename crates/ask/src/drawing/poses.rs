//! Where the bodies are, and how far slides go.

use linkdyn_engine::analysis::{Control, check};
use linkdyn_model::AnalysisKind;
use linkdyn_output::Status;
use linkdyn_picture::poses::{Pose, global};
use linkdyn_picture::shape::{Joint, JointKind, Shape};

use crate::check::pose_of;
use crate::run::unplaced;
use crate::shape::{moving, with_profiles};
use crate::{ModelFile, Unanswered};

/// Outputs on the way to a time: the path is followed from one to the next.
const OUTPUTS: usize = 101;

/// Poses of all bodies, the ground first.
#[derive(Debug)]
pub struct PlacedRows {
    /// What is drawn.
    pub pose: Vec<Pose>,
    /// The motion, where slides need it; else that pose alone.
    all: Vec<Vec<Pose>>,
}

/// The pose at a time, or as assembled; and the motion of a model with slides.
pub fn rows(
    file: &ModelFile,
    at: Option<f64>,
    control: &Control,
) -> Result<PlacedRows, Unanswered> {
    let model = file.model();
    let shape = with_profiles(model);
    let pose = match at.filter(|time| *time > 0.0) {
        Some(time) => at_time(file, time, control)?,
        None => {
            let found = check(model).map_err(|complaints| file.refused(complaints))?;
            if found.status != Status::Completed {
                let why = found.message.as_deref();
                return Err(Unanswered::Failed(
                    why.unwrap_or(found.status.word()).into(),
                ));
            }
            pose_of(model, &found.poses)
        }
    };
    let mut all = vec![pose.clone()];
    let slides =
        |joint: &Joint| joint.axis().is_some() || matches!(joint.kind, JointKind::Rack { .. });
    // Where the motion can't be computed, slides are as long as they are now.
    if model.analysis.is_some()
        && shape.joints.iter().any(slides)
        && let Ok(outcome) = unplaced(file, control)
        && let Some(motion) = moving(None, model, &outcome)
    {
        all.extend(frames(&motion.poses, shape.bodies.len()));
    }
    Ok(PlacedRows { pose, all })
}

/// The poses of an instant: of the ground, then those of the moving bodies in a row.
fn frames(poses: &[f64], bodies: usize) -> impl Iterator<Item = Vec<Pose>> {
    let rows = poses.chunks_exact(3 * (bodies - 1).max(1));
    rows.filter(|row| row.iter().all(|x| x.is_finite()))
        .map(|row| {
            let moving = row.chunks_exact(3).map(|pose| [pose[0], pose[1], pose[2]]);
            std::iter::once([0.0; 3]).chain(moving).collect()
        })
}

fn at_time(file: &ModelFile, time: f64, control: &Control) -> Result<Vec<Pose>, Unanswered> {
    let analysis = file.model().analysis.as_ref();
    let kind = analysis.map_or(AnalysisKind::Kinematics, |analysis| analysis.kind);
    let (type_, integrated) = match kind {
        AnalysisKind::Dynamics => ("dynamics", true),
        AnalysisKind::QuasiStatics => ("quasi_statics", true),
        AnalysisKind::Assembly
        | AnalysisKind::Kinematics
        | AnalysisKind::InverseDynamics
        | AnalysisKind::Statics => ("kinematics", false),
    };
    let puts = match integrated {
        true => vec![format!("analysis.end=\"{time} s\"")],
        false => vec![format!(
            "analysis={{\"type\":\"{type_}\",\"end\":\"{time} s\",\"outputs\":{OUTPUTS}}}"
        )],
    };
    let file = file.with(&puts)?;
    let model = file.model();
    let outcome = unplaced(&file, control).map_err(|complaints| file.refused(complaints))?;
    if outcome.report.status != Status::Completed {
        let why = outcome.report.message.clone();
        let why = why.unwrap_or_else(|| outcome.report.status.word().into());
        return Err(Unanswered::Failed(why));
    }
    let bodies = Shape::of_model(model).bodies.len();
    let motion = moving(None, model, &outcome);
    let last = motion.and_then(|motion| frames(&motion.poses, bodies).last());
    last.ok_or_else(|| Unanswered::Failed(format!("there is no pose at {time} s")))
}

impl PlacedRows {
    /// Least and greatest slide of the second point of a joint along an axis of its first body \[m\].
    pub fn reach(&self, shape: &Shape, joint: &Joint, axis: [f64; 2]) -> [f64; 2] {
        let slide = |pose: &Vec<Pose>| {
            let [first, second] = joint.between.map(|(body, point)| {
                let at = shape.point((body, point)).unwrap_or_default();
                global(pose[body], at)
            });
            let [u, v] = global([0.0, 0.0, pose[joint.between[0].0][2]], axis);
            u * (second[0] - first[0]) + v * (second[1] - first[1])
        };
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        self.all
            .iter()
            .map(slide)
            .fold(ends, |[low, high], s| [low.min(s), high.max(s)])
    }
}
