//! The page that draws a model with what was found in it.

use linkdyn_engine::analysis::Check;
use linkdyn_model::Checked;
use linkdyn_model::error::Complaint;
use linkdyn_output::Status;
use linkdyn_picture::diagnosis::{Finding, Loop, Severity, page};
use linkdyn_picture::poses::Pose;
use linkdyn_picture::shape::{DriverKind, PointId};
use linkdyn_picture::{Scene, Shape};

use super::Diagnosis;
use super::quote::quote;
use super::text::lack_words;
use crate::shape::at_pose;
use crate::text::words::mobility;

/// The page of a model that was checked.
pub fn html(diagnosis: &Diagnosis, figures: Vec<(String, Scene)>) -> String {
    let (model, check) = (diagnosis.file.model(), &diagnosis.found);
    let pose = pose(model, &check.poses);
    let shape = at_pose(model, &pose);
    let mut found = Finder {
        shape: &shape,
        loops: &check.loops,
        findings: Vec::new(),
    };
    for fault in &check.faults {
        found.add(Severity::Wrong, fault);
    }
    for refused in &check.refused {
        let placed = diagnosis.file.loaded.source.place(refused.clone());
        found.complain(&placed, &diagnosis.file.text.bytes);
    }
    if check.status != Status::Completed {
        let why = check.message.as_deref().unwrap_or(check.status.word());
        found.add(Severity::Wrong, why);
    }
    for warning in &check.warnings {
        found.add(Severity::Doubt, warning);
    }
    found.add_redundant(check);
    for lack in &check.lacks {
        let words = lack_words(lack);
        found.add(Severity::Note, &format!("There is no {words}"));
        let number = |name: &String| shape.bodies.iter().position(|body| body.name == *name);
        if let Some(last) = found.findings.last_mut() {
            last.bodies = lack.bodies.iter().filter_map(number).collect();
        }
    }
    let joint = |name: &String| shape.joints.iter().position(|joint| joint.name == *name);
    let loops = check.loops.iter().zip(&check.loop_bodies).enumerate();
    let loops = loops.map(|(k, (text, bodies))| Loop {
        joints: check.loop_joints[k].iter().filter_map(joint).collect(),
        text: format!("{text}  (through {})", bodies.join(", ")),
    });
    let told = linkdyn_picture::diagnosis::Diagnosis {
        title: format!("{}: {}", diagnosis.file.name(), diagnosis.verdict()),
        facts: vec![check.words.clone(), mobility(&check.mobility)],
        loops: loops.collect(),
        findings: found.findings,
        figures,
    };
    page(shape.clone(), &pose, &told)
}

/// Places of all bodies, the ground first: as they assemble, else as they are drawn in the model.
pub fn pose(model: &Checked, assembled: &[(String, Pose)]) -> Vec<Pose> {
    let moving = Shape::of_model(model).bodies.into_iter().skip(1);
    let of = |name: &str| {
        let assembled = assembled.iter().find(|(body, _)| body == name);
        let drawn = model.bodies.get(name).map(|body| {
            let [x, y] = body.pose.position;
            [x, y, body.pose.angle]
        });
        assembled
            .map(|(_, pose)| *pose)
            .or(drawn)
            .unwrap_or_default()
    };
    let moving = moving.map(|body| of(&body.name));
    std::iter::once([0.0; 3]).chain(moving).collect()
}

/// Finds what texts are about.
pub struct Finder<'a> {
    /// What is drawn.
    pub shape: &'a Shape,
    /// Its loops in words.
    pub loops: &'a [String],
    /// What was found so far.
    pub findings: Vec<Finding>,
}

impl Finder<'_> {
    /// Adds a text, with what it names: bodies, joints, loops, and where named forces and drivers act.
    pub fn add(&mut self, severity: Severity, text: &str) {
        let bodies = (1..self.shape.bodies.len())
            .filter(|&body| names(text, "bodies", &self.shape.bodies[body].name));
        let joints = (0..self.shape.joints.len())
            .filter(|&joint| names(text, "joints", &self.shape.joints[joint].name));
        let [driven_bodies, driven_joints] = self.driven(text);
        let (points, pushed) = self.pushed(text);
        let bodies = bodies.chain(driven_bodies).chain(pushed);
        let joints = joints.chain(driven_joints);
        let loops = (0..self.loops.len()).filter(|&one| text.contains(&self.loops[one]));
        self.findings.push(Finding {
            severity,
            text: text.to_string(),
            bodies: bodies.collect(),
            joints: joints.collect(),
            loops: loops.collect(),
            points,
            quote: None,
        });
    }

    /// Adds a complaint, with its line of the file.
    pub fn complain(&mut self, complaint: &Complaint, file: &[u8]) {
        self.add(Severity::Wrong, &complaint.to_string());
        if let Some(last) = self.findings.last_mut() {
            last.quote = complaint.place.and_then(|place| quote(file, place));
        }
    }

    /// Bodies and joints at which the drivers stand that a text names.
    fn driven(&self, text: &str) -> [Vec<usize>; 2] {
        let mut found = [Vec::new(), Vec::new()];
        let drivers = self.shape.drivers.iter();
        for driver in drivers.filter(|driver| names(text, "drivers", &driver.name)) {
            match driver.kind {
                DriverKind::Rotation {
                    pin: Some(joint), ..
                }
                | DriverKind::Translation { joint } => found[1].push(joint),
                DriverKind::Rotation {
                    body, pin: None, ..
                } => found[0].push(body),
                DriverKind::Point { point, .. } => found[0].push(point.0),
                DriverKind::Length { between } => {
                    found[0].extend(
                        between
                            .map(|(body, _)| body)
                            .into_iter()
                            .filter(|body| *body > 0),
                    );
                }
            }
        }
        found
    }

    /// Points and bodies at which the forces act that a text names.
    fn pushed(&self, text: &str) -> (Vec<PointId>, Vec<usize>) {
        let is_named = |name: &str| names(text, "forces", name);
        let Shape {
            springs,
            torsion_springs,
            loads,
            ..
        } = self.shape;
        let springs = springs.iter().filter(|spring| is_named(&spring.name));
        let loads = || loads.iter().filter(|load| is_named(&load.name));
        let twisted = torsion_springs
            .iter()
            .filter(|spring| is_named(&spring.name));
        let points = springs.map(|spring| spring.between[1]);
        let torques = loads().filter(|load| load.at.is_none());
        (
            points.chain(loads().filter_map(|load| load.at)).collect(),
            twisted
                .map(|spring| spring.bodies[1])
                .chain(torques.map(|load| load.body))
                .collect(),
        )
    }

    /// Joints without which the motion would be the same.
    fn add_redundant(&mut self, check: &Check) {
        let redundant = &check.mobility.redundant;
        if redundant.is_empty() {
            return;
        }
        let loads = &check.mobility.reactions_not_unique;
        let loads = match loads.is_empty() {
            true => String::new(),
            false => format!("; the reactions in {} are not unique", loads.join(", ")),
        };
        self.add(
            Severity::Note,
            &format!("Redundant: {}{loads}", redundant.join(", ")),
        );
        let joint = |name: &String| {
            let mut joints = self.shape.joints.iter();
            joints.position(|joint| joint.name == *name)
        };
        let joints = redundant.iter().filter_map(joint).collect();
        if let Some(last) = self.findings.last_mut() {
            last.joints = joints;
        }
    }
}

/// Whether a text names a thing: by its path `bodies.crank`, or in quotes.
fn names(text: &str, kind: &str, name: &str) -> bool {
    let path = format!("{kind}.{name}");
    let by_path = text.match_indices(&path).any(|(at, _)| {
        let rest = text[at + path.len()..].chars().next();
        rest.is_none_or(|c| !c.is_alphanumeric() && c != '_' && c != '-')
    });
    by_path || text.contains(&format!("\"{name}\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_name_what_they_are_about() {
        for (text, named) in [
            ("line 3: bodies.rod.points: long", true),
            ("bodies.rod", true),
            ("bodies.rod2.points: long", false),
            ("joints.rod: odd", false),
            ("\"mass\" of \"rod\" stays", true),
            ("rod", false),
        ] {
            assert_eq!(names(text, "bodies", "rod"), named, "{text}");
        }
    }
}
