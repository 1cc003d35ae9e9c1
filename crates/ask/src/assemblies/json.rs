//! Assemblies and circuits for programs: `assemblies.json` and `circuits.json`, in SI.

use super::grashof::{FourBarClass, turning};
use super::{AssembliesFound, CircuitsFound};
use crate::{ENGINE, Subject};
use indexmap::IndexMap;
use linkdyn_engine::analysis::Turning;
use serde::{Serialize, Serializer};

#[derive(Serialize)]
struct BodyPose {
    x: f64,
    y: f64,
    angle: f64,
}

/// By the names of bodies.
fn poses<'a>(names: &'a [String], poses: &[[f64; 3]]) -> IndexMap<&'a str, BodyPose> {
    let pose = |[x, y, angle]: &[f64; 3]| BodyPose {
        x: *x,
        y: *y,
        angle: *angle,
    };
    let names = names.iter().map(String::as_str);
    names.zip(poses.iter().map(pose)).collect()
}

#[derive(Serialize)]
struct GroupJson<'a> {
    bodies: &'a [String],
    loops: Option<usize>,
    complex: usize,
    paths: usize,
}

#[derive(Serialize)]
struct AssemblyJson<'a> {
    drawn: bool,
    proven: bool,
    bodies: IndexMap<&'a str, BodyPose>,
}

#[derive(Serialize)]
struct AssembliesJson<'a> {
    engine: &'a str,
    model: Subject<'a>,
    at: f64,
    drivers: IndexMap<&'a str, f64>,
    complete: bool,
    doubts: &'a [String],
    notes: &'a [String],
    held: &'a [String],
    groups: Vec<GroupJson<'a>>,
    assemblies: Vec<AssemblyJson<'a>>,
}

/// `assemblies.json`.
impl Serialize for AssembliesFound {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let found = &self.found;
        let groups = found.groups.iter().map(|group| GroupJson {
            bodies: &group.bodies,
            loops: group.loops,
            complex: group.complex,
            paths: group.paths,
        });
        let assemblies = found.found.iter().map(|one| AssemblyJson {
            drawn: one.is_drawn,
            proven: one.is_proven,
            bodies: poses(&found.bodies, &one.poses),
        });
        let drivers = found.drivers.iter();
        AssembliesJson {
            engine: ENGINE,
            model: self.file.subject(),
            at: self.asked.at,
            drivers: drivers
                .map(|(name, value)| (name.as_str(), *value))
                .collect(),
            complete: found.doubts.is_empty(),
            doubts: &found.doubts,
            notes: &found.notes,
            held: &found.held,
            groups: groups.collect(),
            assemblies: assemblies.collect(),
        }
        .serialize(serializer)
    }
}

#[derive(Serialize)]
struct TurningJson<'a> {
    kind: &'static str,
    value: f64,
    bodies: IndexMap<&'a str, BodyPose>,
}

#[derive(Serialize)]
struct CircuitJson<'a> {
    drawn: bool,
    closed: bool,
    turns_fully: bool,
    turning: Vec<&'a str>,
    branches: Vec<[f64; 2]>,
    members: usize,
    turnings: Vec<TurningJson<'a>>,
    course: CourseJson<'a>,
}

/// Columns along a circuit.
#[derive(Serialize)]
struct CourseJson<'a> {
    value: Vec<f64>,
    bodies: IndexMap<&'a str, [Vec<f64>; 3]>,
}

#[derive(Serialize)]
struct CircuitsJson<'a> {
    engine: &'a str,
    model: Subject<'a>,
    driver: &'a str,
    unit: &'static str,
    values: &'a [f64],
    assemblies: &'a [usize],
    complete: bool,
    doubts: &'a [String],
    four_bar: Option<FourBarClass>,
    circuits: Vec<CircuitJson<'a>>,
}

/// The word of a turning point in files.
pub(super) fn word(kind: Turning) -> &'static str {
    match kind {
        Turning::DeadCentre => "dead_centre",
        Turning::ChangePoint => "change_point",
        Turning::End => "end",
        Turning::Lost => "lost",
    }
}

/// `circuits.json`.
impl Serialize for CircuitsFound {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let found = &self.found;
        let names = &found.bodies;
        let circuit = |one: &'_ linkdyn_engine::analysis::FoundCircuit| CircuitJson {
            drawn: one.is_drawn,
            closed: one.is_closed,
            turns_fully: one.turns_fully(),
            turning: turning(one)
                .into_iter()
                .map(|body| &names[body][..])
                .collect(),
            branches: one.branches(),
            members: one.members,
            turnings: one
                .turnings
                .iter()
                .map(|(kind, value, own)| TurningJson {
                    kind: word(*kind),
                    value: *value,
                    bodies: poses(names, own),
                })
                .collect(),
            course: CourseJson {
                value: one.course.iter().map(|(value, _)| *value).collect(),
                bodies: names
                    .iter()
                    .enumerate()
                    .map(|(body, name)| {
                        let column = |part: usize| {
                            one.course
                                .iter()
                                .map(|(_, poses)| poses[body][part])
                                .collect()
                        };
                        (name.as_str(), [0, 1, 2].map(column))
                    })
                    .collect(),
            },
        };
        CircuitsJson {
            engine: ENGINE,
            model: self.file.subject(),
            driver: &found.driver.0,
            unit: self.unit(),
            values: &found.values,
            assemblies: &found.counts,
            complete: found.doubts.is_empty(),
            doubts: &found.doubts,
            four_bar: self.four_bar,
            circuits: found.circuits.iter().map(circuit).collect(),
        }
        .serialize(serializer)
    }
}
