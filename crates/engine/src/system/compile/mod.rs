//! Words → numbers: the only place where a [`Model`] and a [`System`] meet.

mod cam_curves;
mod cams;
mod contact_parameters;
mod drivers;
mod edges;
mod elastic;
mod forces;
mod formulas;
mod joints;
mod laws;
mod links;
mod needs;
mod parts;
mod profiles;
mod roles;
mod stops;
mod wheels;

pub use laws::{law, value_law};
pub use profiles::{Profile, profiles};

use super::rows::{reach, size, spread};
use super::{BodyData, Extent, Mass, Origin, OutputPoint, Scale, SectionData, StateData, System};
use crate::element::pair::ContactId;
use crate::element::{BodyId, Constraint, Force, Layout, Marker, Pose};
use linkdyn_linear::math::{Vec2, unit};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::response::{Catalogue, Look};
use linkdyn_model::{AnalysisKind, Body, Checked, GROUND, LinkSection, Model, PointRef, Timed};
use links::Elastic;
use needs::{Joints, missing};
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// Compiles a model for an analysis, once: joints whose clearance is modelled by contact are open, for an assembly closed.
///
/// # Errors
/// Data that the analysis needs and the file lacks, all at once.
pub fn compile(model: &Checked, analysis: AnalysisKind) -> Result<System, Complaints> {
    let currents = match analysis {
        AnalysisKind::Dynamics => Currents::Integrated,
        _ => Currents::Steady,
    };
    compile_with(model, analysis, currents)
}

/// The same for small motions about a position at rest: with what dynamics needs, and currents that follow at once.
///
/// # Errors
/// Those of [`compile`].
pub fn compile_about_rest(model: &Checked) -> Result<System, Complaints> {
    compile_with(model, AnalysisKind::Dynamics, Currents::Steady)
}

/// What the currents of motors with an inductance do.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Currents {
    /// They are states of the motion.
    Integrated,
    /// They have no rate, as at rest.
    Steady,
}

fn compile_with(
    model: &Checked,
    analysis: AnalysisKind,
    currents: Currents,
) -> Result<System, Complaints> {
    let mut complaints = missing(model, analysis);
    let mut joints = Joints::new(model, &mut complaints);
    if analysis == AnalysisKind::QuasiStatics {
        joints.slow();
    }
    // Where it is not moved by forces, a link is rigid.
    let elastic = match analysis {
        AnalysisKind::Dynamics | AnalysisKind::Statics => Elastic::new(model, &mut complaints),
        AnalysisKind::Assembly
        | AnalysisKind::Kinematics
        | AnalysisKind::InverseDynamics
        | AnalysisKind::QuasiStatics => Elastic::default(),
    };
    let system = lower(model, (joints, elastic), complaints, currents)?;
    Ok(match analysis {
        AnalysisKind::QuasiStatics => System {
            is_slow: true,
            ..system
        },
        AnalysisKind::Assembly => system.closed(),
        AnalysisKind::Kinematics
        | AnalysisKind::InverseDynamics
        | AnalysisKind::Dynamics
        | AnalysisKind::Statics => system,
    })
}

/// Compiles a model for what needs no masses, with its journals free.
///
/// # Errors
/// Parameters that its joints need and the file lacks.
pub fn compile_geometry(model: &Checked) -> Result<System, Complaints> {
    let mut complaints = Vec::new();
    let joints = Joints::new(model, &mut complaints);
    let parts = (joints, Elastic::default());
    lower(model, parts, complaints, Currents::Steady)
}

fn lower<'a>(
    model: &'a Model,
    parts: (Joints<'a>, Elastic<'a>),
    mut complaints: Vec<Complaint>,
    currents: Currents,
) -> Result<System, Complaints> {
    // A task has none yet.
    if model.bodies.is_empty() {
        let complaint = Complaint::new("bodies", "there are none");
        complaints.push(complaint.hint("`linkdyn synthesise` finds linkages for a task"));
    }
    if complaints.is_empty() {
        Ok(Compiler::new(model, parts, currents).build())
    } else {
        Err(complaints.into())
    }
}

struct Compiler<'a> {
    model: &'a Model,
    joints: Joints<'a>,
    elastic: Elastic<'a>,
    /// What elastic links exert inside, behind all forces of the model.
    elastic_forces: Vec<Arc<dyn Force>>,
    ids: HashMap<&'a str, BodyId>,
    /// Centre of mass in the body's frame, by body id.
    com: Vec<Vec2>,
    /// The names of what moves, once a formula has requested them.
    catalogue: Option<Catalogue>,
    /// The model's tables, once a formula has requested them.
    curves: Option<Vec<Arc<dyn Look>>>,
    /// Exponents of what the formulas' kinks compare.
    kinks: Vec<[f64; 4]>,
    /// Joints that close and open, as they are when they are closed.
    closed: HashMap<usize, Arc<dyn Constraint>>,
    /// What events close and open.
    timed: Vec<(ContactId, &'a Timed)>,
    /// What the currents of motors with an inductance do.
    currents: Currents,
    /// Those that are integrated, which stand behind the states of the model.
    integrated: Vec<StateData>,
    system: System,
}

impl<'a> Compiler<'a> {
    fn new(
        model: &'a Model,
        (joints, elastic): (Joints<'a>, Elastic<'a>),
        currents: Currents,
    ) -> Self {
        let mut ids = HashMap::from([(GROUND, BodyId::GROUND)]);
        let mut com = vec![Vec2::zeros()];
        for (name, body) in model.bodies.iter().filter(|(name, _)| *name != GROUND) {
            ids.insert(name, BodyId(com.len()));
            let centre = || body.com.map_or(Vec2::zeros(), Vec2::from);
            com.push(elastic.origin(name, body).unwrap_or_else(centre));
        }
        let system = System {
            layout: Layout::rigid(com.len() - 1),
            bodies: Vec::new(),
            sections: BTreeMap::new(),
            axes: Vec::new(),
            joints: Vec::new(),
            drivers: Vec::new(),
            points: Vec::new(),
            blocks: Vec::new(),
            initial: Vec::new(),
            starts: Vec::new(),
            initial_rates: Vec::new(),
            branch: Vec::new(),
            forces: Vec::new(),
            force_data: Vec::new(),
            measured: Vec::new(),
            outputs: Vec::new(),
            formulas: Vec::new(),
            inputs: Vec::new(),
            states: Vec::new(),
            kinks: Vec::new(),
            dependent_forces: Vec::new(),
            contacts: Arc::default(),
            contact_rows: Arc::default(),
            enclosures: Vec::new(),
            timed: Vec::new(),
            broken: laws::broken(model),
            gravity: Vec2::from(model.gravity),
            mass: Mass::default(),
            masses_known: true,
            entries: Vec::new(),
            measures: Vec::new(),
            links: 0,
            guess: Vec::new(),
            size: 1.0,
            scale: Scale::SI,
            is_pushed: false,
            is_slow: false,
            display: model.display.clone(),
            reach: 0.0,
            extents: Vec::new(),
        };
        Compiler {
            model,
            joints,
            elastic,
            elastic_forces: Vec::new(),
            ids,
            com,
            catalogue: None,
            curves: None,
            kinks: Vec::new(),
            closed: HashMap::new(),
            timed: Vec::new(),
            currents,
            integrated: Vec::new(),
            system,
        }
    }

    fn build(mut self) -> System {
        self.add_bodies();
        self.system.extents = self.extents();
        self.system.size = size(&self.system.extents);
        self.system.reach = reach(&self.system.extents);
        self.place_elastic();
        self.add_joints();
        self.hold_elastic();
        self.add_drivers();
        self.add_stops();
        self.add_edges();
        self.add_initial();
        self.add_forces();
        self.add_states();
        self.add_events();
        self.add_strands();
        self.add_measures();
        self.add_outputs();
        self.system.scale = Scale::of(&self.system);
        self.system.kinks = self.kinks();
        for point in &self.model.points {
            let marker = self.marker(point);
            self.system.points.push(OutputPoint {
                name: format!("{}.{}", point.body, point.point),
                marker,
            });
        }
        self.system.shrink();
        self.system
    }

    fn body(&self, name: &str) -> BodyId {
        self.ids[name]
    }

    fn marker(&self, point: &PointRef) -> Marker {
        if let Some(marker) = self.elastic.place(&point.body, &point.point) {
            return marker;
        }
        let body = self.body(&point.body);
        let place = self.model.bodies[&point.body].points[&point.point];
        Marker {
            body,
            s: Vec2::from(place) - self.com[body.0],
        }
    }

    fn add_bodies(&mut self) {
        for (name, body) in self.model.bodies.iter().filter(|(name, _)| *name != GROUND) {
            let com = self.com[self.body(name).0];
            let pose = Pose::new(
                body.pose.position[0],
                body.pose.position[1],
                body.pose.angle,
            );
            let centre = pose.r + pose.turn(com);
            self.system
                .guess
                .extend([centre.x, centre.y, body.pose.angle]);
            // The mass of an elastic body is in its sections.
            let (mass, inertia) = match self.elastic.origin(name, body) {
                Some(_) => (0.0, 0.0),
                None => (body.mass.unwrap_or(0.0), body.inertia.unwrap_or(0.0)),
            };
            self.system.mass.push_rigid(mass, inertia);
            self.system.masses_known &= body.mass.is_some() && body.inertia.is_some();
            if let Some(own) = &body.section {
                let index = self.system.bodies.len();
                let mut own = section(body, own, com);
                if self.elastic.origin(name, body).is_some() {
                    own.bar = body.mass.unwrap_or(0.0) / own.length;
                }
                self.system.sections.insert(index, own);
            }
            self.system.bodies.push(BodyData {
                name: name.clone(),
                origin: -com,
                is_light: body.mass == Some(0.0) || body.inertia == Some(0.0),
                inner: None,
            });
        }
    }

    /// How far each body reaches, ground first.
    fn extents(&self) -> Vec<Extent> {
        let extent = |(name, body): (&String, &Body)| {
            let mut points: Vec<Vec2> = body.points.values().map(|&p| Vec2::from(p)).collect();
            points.extend(body.com.map(Vec2::from));
            let places = points.iter().flat_map(|point| point.iter());
            let profile = self.profiles(name);
            let spread = spread(&points).max(2.0 * profile);
            let origin = Vec2::from(body.pose.position);
            Extent {
                spread,
                reach: places.fold(profile, |most: f64, x| most.max(x.abs())),
                origin: (spread <= 0.0).then(|| Box::new(origin)),
            }
        };
        let ground = self.model.bodies.get_key_value(GROUND);
        let moving = self.model.bodies.iter();
        let moving = moving.filter(|(name, _)| *name != GROUND);
        [ground.map_or(Extent::default(), extent)]
            .into_iter()
            .chain(moving.map(extent))
            .collect()
    }

    fn push_block(&mut self, constraint: Arc<dyn Constraint>, origin: Origin) {
        self.system.push_block(constraint, origin);
    }
}

/// The numbers of a cross-section.
fn section(body: &Body, section: &LinkSection, com: Vec2) -> SectionData {
    let [from, to] = [&section.from, &section.to].map(|end| Vec2::from(body.points[end]));
    let (length, area) = ((to - from).norm(), section.shape.area());
    let mass = body.mass.unwrap_or(0.0);
    let bar = match section.density() {
        // what has no mass has none along its axis
        _ if mass == 0.0 => 0.0,
        Some(density) => density * area,
        None => mass / length,
    };
    let euler = |modulus: f64| {
        let stiffness = modulus * section.shape.least_second_moment();
        stiffness * (std::f64::consts::PI / length).powi(2)
    };
    SectionData {
        from: from - com,
        axis: unit(to - from),
        length,
        area,
        modulus: section.shape.modulus(),
        bar,
        buckling_load: section.stiffness().map(euler),
        stations: section.stations.unwrap_or(5),
    }
}
