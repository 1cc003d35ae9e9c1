//! All assemblies of a model at an instant of its drivers, and the circuits that a driver leads through.

use super::assembly::{assemble, dependent_and_free};
use super::control::Control;
use crate::element::{Axis, BodyId, Measure};
pub use crate::mechanism::assemblies::circuits::Turning;
use crate::mechanism::assemblies::circuits::{DriverValues, circuits};
use crate::mechanism::assemblies::{Assemblies, KnownPosition, assemblies, same};
use crate::system::{Block, DriverData, Inputs, System, compile::compile};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{AnalysisKind, Checked};
use std::f64::consts::TAU;

/// One way in which the mechanism closes.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundAssembly {
    /// x, y of its frame's origin \[m\] and angle \[rad\], by moving body.
    pub poses: Vec<[f64; 3]>,
    /// Whether it is proven that there is an assembly at this place, and one only.
    pub is_proven: bool,
    /// Whether it is the one that `run` begins with.
    pub is_drawn: bool,
}

/// Bodies that are placed together.
#[derive(Debug, Clone, PartialEq)]
pub struct AssemblyGroup {
    /// Their names.
    pub bodies: Vec<String>,
    /// Independent loops; `None` where the equations are no polynomials.
    pub loops: Option<usize>,
    /// Places in complex numbers, and the bound for them.
    pub complex: usize,
    /// Paths that were followed.
    pub paths: usize,
}

/// All assemblies.
#[derive(Debug, Clone, PartialEq)]
pub struct AllAssemblies {
    /// Names of the moving bodies.
    pub bodies: Vec<String>,
    /// Names and values of drivers \[m or rad\].
    pub drivers: Vec<(String, f64)>,
    /// The assemblies, that of `run` first.
    pub found: Vec<FoundAssembly>,
    /// In the order in which they are placed.
    pub groups: Vec<AssemblyGroup>,
    /// Coordinates that nothing determines and that stayed, `crank.angle`.
    pub held: Vec<String>,
    /// Why there may be more; empty where these are all.
    pub doubts: Vec<String>,
    /// What is to be known besides.
    pub notes: Vec<String>,
}

/// All assemblies of a model with ideal joints, where drivers are as at `time` \[s\]; at most so many.
///
/// # Errors
/// Faults of the input.
pub fn all_assemblies(
    model: &Checked,
    time: f64,
    most: usize,
    control: &Control,
) -> Result<AllAssemblies, Complaints> {
    let drawn = DrawnSystem::new(model, time)?;
    let all = drawn.assemblies(&drawn.inputs, most, control);
    Ok(answer(&drawn, &all))
}

/// A model, and its assembly as it is drawn.
pub(super) struct DrawnSystem {
    pub(super) system: System,
    pub(super) inputs: Inputs,
    /// The assembly; none where it can't be reached from the drawing.
    q: Option<Vec<f64>>,
    dependent: Vec<usize>,
    free: Vec<usize>,
}

impl DrawnSystem {
    pub(super) fn new(model: &Checked, time: f64) -> Result<Self, Complaints> {
        let mut system = compile(&model.with_clearances(|_| false), AnalysisKind::Assembly)?;
        // Initial values hold at t = 0 alone.
        if time != 0.0 {
            system.initial.clear();
            system.starts.clear();
        }
        let inputs = Inputs::at_time(&system, time);
        let q = assemble(&system, &inputs).ok().map(|drawn| drawn.q);
        let (dependent, free) = match &q {
            Some(q) => dependent_and_free(&system, q, &inputs),
            None => (Vec::new(), Vec::new()),
        };
        Ok(DrawnSystem {
            system,
            inputs,
            q,
            dependent,
            free,
        })
    }

    /// The same without initial values, which a driver that is led leaves: what they hold stays as it is.
    pub(super) fn without_initial(mut self) -> Self {
        self.system.initial.clear();
        self.system.starts.clear();
        if let Some(q) = &self.q {
            (self.dependent, self.free) = dependent_and_free(&self.system, q, &self.inputs);
        }
        self
    }

    fn blocks(&self) -> Vec<&Block> {
        self.system
            .blocks
            .iter()
            .chain(&self.system.initial)
            .collect()
    }

    pub(super) fn assemblies(&self, inputs: &Inputs, most: usize, control: &Control) -> Assemblies {
        let known = KnownPosition {
            q: self.q.as_ref().unwrap_or(&self.system.guess),
            dependent: &self.dependent,
            free: &self.free,
        };
        let stop = || control.stop().is_some();
        assemblies(&self.system, &self.blocks(), inputs, &known, most, &stop)
    }

    /// Two drivers by their names, or the only two.
    pub(super) fn two_drivers(
        &self,
        names: Option<&[String; 2]>,
    ) -> Result<[usize; 2], Complaints> {
        match (names, self.system.drivers.len()) {
            (Some([one, other]), _) => {
                let both = [self.driver(Some(one))?, self.driver(Some(other))?];
                match both[0] == both[1] {
                    true => {
                        let message = format!("{one:?} is named twice");
                        Err(vec![Complaint::new("drivers", message).hint("name two")].into())
                    }
                    false => Ok(both),
                }
            }
            (None, 2) => Ok([0, 1]),
            (None, count) => {
                let message = format!("the map is that of two drivers, and there are {count}");
                let complaint = Complaint::new("drivers", message);
                Err(vec![
                    complaint.hint("say --drivers A,B if there are more; `--circuits` is for one"),
                ]
                .into())
            }
        }
    }

    /// The driver of a name, or the only one.
    fn driver(&self, name: Option<&str>) -> Result<usize, Complaints> {
        let names: Vec<&str> = self
            .system
            .drivers
            .iter()
            .map(|driver| &driver.name[..])
            .collect();
        let refuse = |message: String, hint: &str| {
            Err(vec![Complaint::new("drivers", message).hint(hint)].into())
        };
        match (name, &names[..]) {
            (None, [_]) => Ok(0),
            (None, []) => refuse(
                "circuits are those of a driver, and there is none".into(),
                "add one of the freedom that moves",
            ),
            (None, several) => refuse(
                format!("there are several drivers: {}", several.join(", ")),
                "say --driver NAME",
            ),
            (Some(name), all) => match all.iter().position(|own| *own == name) {
                Some(driver) => Ok(driver),
                None => refuse(
                    format!("there is no driver {name:?}"),
                    &format!("the drivers: {}", all.join(", ")),
                ),
            },
        }
    }
}

/// Which circuits are asked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CircuitsQuestion {
    /// The driver; the only one where none is named.
    pub driver: Option<String>,
    /// The driver's values where all assemblies are looked for.
    pub count: usize,
    /// From where to where, in SI; a full turn of an angle, or what the motion of a length passes, where nothing is said.
    pub range: Option<[f64; 2]>,
    /// The most assemblies at each value.
    pub most: usize,
}

/// The circuits of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct AllCircuits {
    /// Names of the moving bodies.
    pub bodies: Vec<String>,
    /// The driver, and whether it turns \[rad\] or slides \[m\].
    pub driver: (String, Measure),
    /// Its values \[rad or m\].
    pub values: Vec<f64>,
    /// How many assemblies there are at each value.
    pub counts: Vec<usize>,
    /// The circuits, that of `run` first.
    pub circuits: Vec<FoundCircuit>,
    /// Why there may be more; empty where there are not.
    pub doubts: Vec<String>,
}

/// A circuit.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundCircuit {
    /// The driver's value, counted on \[rad or m\], and the poses of the bodies, along the curve.
    pub course: Vec<(f64, Vec<[f64; 3]>)>,
    /// Dead centres, change points, ends: kind, the driver's value, poses.
    pub turnings: Vec<(Turning, f64, Vec<[f64; 3]>)>,
    /// How many of the assemblies at the driver's values belong to it.
    pub members: usize,
    /// Whether it comes back to its start.
    pub is_closed: bool,
    /// Whether it is the one that `run` moves on.
    pub is_drawn: bool,
}

impl FoundCircuit {
    /// Ranges of the driver's value between dead centres, one for each branch.
    pub fn branches(&self) -> Vec<[f64; 2]> {
        let ends = self
            .turnings
            .iter()
            .filter(|(kind, ..)| *kind != Turning::ChangePoint);
        let mut values: Vec<f64> = ends.map(|(_, value, _)| *value).collect();
        match (self.is_closed, values.first().copied()) {
            (true, Some(first)) => values.push(first),
            (true, None) => values.extend(
                [self.course.first(), self.course.last()]
                    .into_iter()
                    .flatten()
                    .map(|(value, _)| *value),
            ),
            (false, _) => {}
        }
        let pairs = values.windows(2);
        pairs
            .map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])])
            .collect()
    }

    /// Whether the driver can turn on and on.
    pub fn turns_fully(&self) -> bool {
        self.is_closed
            && self
                .turnings
                .iter()
                .all(|(kind, ..)| *kind == Turning::ChangePoint)
    }
}

/// The circuits of a model with ideal joints, whose other drivers stand as at t = 0.
///
/// # Errors
/// Faults of the input.
pub fn all_circuits(
    model: &Checked,
    question: &CircuitsQuestion,
    control: &Control,
) -> Result<Option<AllCircuits>, Complaints> {
    let drawn = DrawnSystem::new(model, 0.0)?.without_initial();
    let driver = drawn.driver(question.driver.as_deref())?;
    let system = &drawn.system;
    let data = &system.drivers[driver];
    let start = drawn.inputs.drive[driver][0];
    let is_turn = data.measure == Measure::Angle && question.range.is_none();
    let count = question.count.max(2);
    let values: Vec<f64> = match question.range {
        None if is_turn => (0..count)
            .map(|k| start + TAU * k as f64 / count as f64)
            .collect(),
        range => {
            let Some([low, high]) = range.or_else(|| passed(model, data)) else {
                let complaint = Complaint::new(
                    "drivers",
                    format!("the motion of driver {:?} stands still", data.name),
                );
                return Err(vec![complaint.hint("say --range A:B")].into());
            };
            (0..count)
                .map(|k| low + (high - low) * k as f64 / (count - 1) as f64)
                .collect()
        }
    };
    let mut all = Vec::new();
    let mut inputs = drawn.inputs.clone();
    for value in &values {
        if control.stop().is_some() {
            return Ok(None);
        }
        inputs.drive[driver][0] = *value;
        all.push(drawn.assemblies(&inputs, question.most, control));
    }
    let values_of = DriverValues {
        driver,
        values: &values,
        is_turn,
    };
    let blocks = drawn.blocks();
    let found = circuits(
        system,
        &blocks,
        &drawn.inputs,
        values_of,
        &drawn.dependent,
        &mut all,
        &|| control.stop().is_some(),
    );
    let Some(found) = found else {
        return Ok(None);
    };
    let mut circuits: Vec<FoundCircuit> = found
        .iter()
        .map(|circuit| FoundCircuit {
            course: circuit
                .course
                .iter()
                .map(|(value, q)| (*value, system.frames(q)))
                .collect(),
            turnings: circuit
                .turnings
                .iter()
                .map(|one| (one.kind, one.value, system.frames(&one.q)))
                .collect(),
            members: circuit.members.len(),
            is_closed: circuit.is_closed,
            is_drawn: drawn.q.as_ref().is_some_and(|q| {
                let own = circuit
                    .members
                    .iter()
                    .map(|[number, index]| &all[*number].found[*index].q);
                own.clone().any(|one| same(system, one, q))
            }),
        })
        .collect();
    circuits.sort_by_key(|circuit| !circuit.is_drawn);
    let mut doubts: Vec<String> = all.iter().flat_map(|one| doubts(system, one)).collect();
    if circuits.is_empty() && all.iter().any(|one| !one.found.is_empty()) {
        doubts.push(
            "no assembly is proven to be isolated (redundant joints, or special dimensions), and from others no circuit is followed"
                .to_owned(),
        );
    }
    doubts.sort();
    doubts.dedup();
    Ok(Some(AllCircuits {
        bodies: system.bodies.iter().map(|body| body.name.clone()).collect(),
        driver: (data.name.clone(), data.measure),
        counts: all.iter().map(|one| one.found.len()).collect(),
        values,
        circuits,
        doubts,
    }))
}

/// What the motion of a driver passes in the analysis.
pub(super) fn passed(model: &Checked, data: &DriverData) -> Option<[f64; 2]> {
    let end = model.analysis.as_ref()?.end?;
    let times = [0.0, end].into_iter().chain(data.law.turning_times(end));
    let values = times.map(|time| data.law.value(time));
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    (high > low).then_some([low, high])
}

fn answer(model: &DrawnSystem, all: &Assemblies) -> AllAssemblies {
    let (system, inputs, drawn) = (&model.system, &model.inputs, model.q.as_deref());
    let name = |body: &BodyId| body_name(system, *body);
    let mut found: Vec<FoundAssembly> = all
        .found
        .iter()
        .map(|one| FoundAssembly {
            poses: system.frames(&one.q),
            is_proven: one.is_proven,
            is_drawn: drawn.is_some_and(|drawn| same(system, drawn, &one.q)),
        })
        .collect();
    if let Some(drawn) = drawn.filter(|_| found.iter().all(|one| !one.is_drawn)) {
        found.push(FoundAssembly {
            poses: system.frames(drawn),
            is_proven: false,
            is_drawn: true,
        });
    }
    found.sort_by_key(|one| !one.is_drawn);
    let mut notes = Vec::new();
    if all.is_singular {
        notes.push(
            "special dimensions: some assemblies are at a dead centre or change point, or are a point of a curve of assemblies that moves \
             while the drivers stand"
                .to_owned(),
        );
    }
    AllAssemblies {
        bodies: system.bodies.iter().map(|body| body.name.clone()).collect(),
        drivers: system
            .drivers
            .iter()
            .zip(&inputs.drive)
            .map(|(driver, jet)| (driver.name.clone(), jet[0]))
            .collect(),
        found,
        groups: all
            .groups
            .iter()
            .map(|group| AssemblyGroup {
                bodies: group.bodies.iter().map(name).collect(),
                loops: group.loops,
                complex: group.complex,
                paths: group.paths,
            })
            .collect(),
        held: all
            .held
            .iter()
            .map(|(body, axis)| {
                let axis = match axis {
                    Axis::X => "x",
                    Axis::Y => "y",
                    Axis::Theta => "angle",
                };
                format!("{}.{axis}", name(body))
            })
            .collect(),
        doubts: doubts(system, all),
        notes,
    }
}

fn body_name(system: &System, body: BodyId) -> String {
    let name = body
        .index()
        .map_or("ground", |index| &system.bodies[index].name);
    name.to_owned()
}

/// Why there may be more assemblies.
pub(super) fn doubts(system: &System, all: &Assemblies) -> Vec<String> {
    let mut doubts = Vec::new();
    if all.is_stopped {
        doubts.push("the search was interrupted".to_owned());
    }
    if all.is_cut {
        doubts.push("there are more than were asked for".to_owned());
    }
    let unsolved = all.groups.iter().filter(|group| group.loops.is_none());
    let unsolved: Vec<String> = unsolved
        .flat_map(|group| group.bodies.iter().map(|body| body_name(system, *body)))
        .collect();
    if all.is_searched {
        doubts.push(format!(
            "cams, racks, belts, rolling, gears within a loop and elastic links have no polynomials: {} searched for from many starts",
            match &unsolved[..] {
                [one] => format!("the place of {one} is"),
                several => format!("the places of {} are", several.join(", ")),
            }
        ));
    } else if !all.is_complete && !all.is_cut && !all.is_stopped {
        doubts.push("a path to a root was lost".to_owned());
    }
    doubts
}
