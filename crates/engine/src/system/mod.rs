//! The equations as numbers: an immutable [`System`], the state it is evaluated at, and the evaluation itself.
//!
//! ```text
//! φ(q, t) = 0                     (m)    rows in the order joints, drivers
//! J v = −φ_t,  J a = γ            J (m, n), n coordinates of moving bodies
//! M a + Jᵀ λ = Q                  M in blocks, see `mass`
//! ```
//!
//! J is kept as a list of entries in element order: each element writes its own stretch, whoever needs a matrix scatters
//! that list by slots worked out once ([`Selection`](crate::mechanism::driven)).

mod block;
pub mod compile;
mod contacts;
mod eval;
mod joint;
mod led;
mod mass;
mod matrices;
mod numbers;
mod pushes;
mod roles;
mod rows;
mod scale;
mod section;
mod slopes;
mod standing;
mod states;
mod timed;

pub use block::Block;
pub(crate) use contacts::{LOCK, ONE_WAY};
pub(crate) use eval::Steered;
pub use eval::{Evaluation, Inputs};
pub use joint::JointData;
pub use mass::Mass;
pub use matrices::{Terms, write_matrix_market};
pub use pushes::{ForceLaw, Pushes};
pub(crate) use roles::MeasuredColumn;
pub use roles::{
    ClearanceLink, DriverRole, ForceData, ForceRole, JointFriction, JointRole, OutputKind,
    OutputRatio,
};
pub use rows::{ContactRows, Extent, Owner};
pub use scale::Scale;
pub(crate) use scale::larger;
pub use section::SectionData;
pub(crate) use slopes::Slopes;
pub(crate) use standing::Standing;
pub(crate) use states::{InputData, StateData};
pub(crate) use timed::{TimedData, Trigger};

use crate::element::cam::Cam;
use crate::element::enclosure::Enclosure;
use crate::element::formula::Formula;
use crate::element::pair::{ContactId, Pair};
use crate::element::station::{Amplitude, CarriedSection};
use crate::element::{Axis, ConstraintDependentForce, Force, Layout, Marker, Measure};
use crate::motion::{Jet, Law};
use linkdyn_linear::math::Vec2;
use linkdyn_model::display::DisplayUnits;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Index of a joint in the model's order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct JointId(pub usize);

/// Index of a driver in the model's order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct DriverId(pub usize);

/// What a constraint came from, for naming it.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// A joint.
    Joint(JointId),
    /// A driver.
    Driver(DriverId),
    /// A stop of a joint, or a piece of its outline.
    Stop(ContactId),
    /// An `initial` value, `crank.angle`.
    Initial(Box<String>),
}

/// A force that depends on the multipliers of a block.
#[derive(Clone)]
pub struct DependentForce {
    /// The force.
    pub(crate) force: Arc<dyn ConstraintDependentForce>,
    /// Index into [`System::blocks`].
    pub(crate) block: usize,
}

/// A moving body's numbers.
#[derive(Debug, Clone)]
pub struct BodyData {
    /// As the file names it.
    pub name: String,
    /// The frame's origin from the centre of mass, body frame \[m\].
    pub origin: Vec2,
    /// Whether the file says that its mass or its inertia is zero.
    pub(crate) is_light: bool,
    /// Of what is inside an elastic link.
    pub(crate) inner: Option<Box<InnerBody>>,
}

impl BodyData {
    /// What it is to the user.
    pub fn part(&self) -> BodyPart {
        self.inner
            .as_ref()
            .map_or(BodyPart::Own, |inner| inner.part)
    }

    /// The body of the file to which it belongs.
    pub fn link(&self) -> &str {
        self.inner.as_ref().map_or(&self.name, |inner| &inner.link)
    }

    /// How it follows from an elastic link, of a section or a mass point of one.
    pub(crate) fn carried(&self) -> Option<&CarriedSection> {
        self.inner.as_ref()?.carried.as_deref()
    }
}

/// A body inside an elastic link.
#[derive(Debug, Clone)]
pub struct InnerBody {
    /// The body of the file to which it belongs.
    pub(crate) link: String,
    /// What it is there.
    pub(crate) part: BodyPart,
    /// How it follows from the link.
    pub(crate) carried: Option<Arc<CarriedSection>>,
}

/// The axis of an elastic link by few amplitudes, at equally spaced places from one end to the other.
#[derive(Debug, Clone)]
pub struct ElasticAxis {
    /// The body whose frame carries it, by its number.
    pub body: usize,
    /// Its amplitudes: bodies by their number, and which of both.
    pub amplitudes: Vec<Amplitude>,
    /// How the places move, in the frame of the body from its origin of deflections.
    pub stations: Vec<CarriedSection>,
    /// w″ of the places by the amplitudes [1/m²]; empty of modal data.
    pub curvatures: Vec<Vec<f64>>,
    /// Mass \[kg\], and ρI L [kg·m²].
    pub(crate) heavy: [f64; 2],
    /// Slowest and fastest frequency of its modes [rad/s].
    pub(crate) frequencies: [f64; 2],
    /// Whether it stretches.
    pub(crate) stretches: bool,
    /// Whether bending shortens it.
    pub(crate) shortens: bool,
}

/// What a body of the equations is to the user.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyPart {
    /// A body of the file.
    Own,
    /// No body: its x and y are amplitudes of an elastic link.
    Amplitudes {
        /// The number of the first among those of the link.
        first: usize,
        /// How many there are, 1 or 2.
        count: usize,
    },
    /// A section of an elastic link, at a point of the file.
    Section,
    /// What stands for a part of the mass of an elastic link.
    MassPoint,
    /// A rigid part of a chain of elements, by its number.
    Node(usize),
}

/// A driver's numbers beyond its constraint.
#[derive(Debug, Clone)]
pub struct DriverData {
    /// As the file names it.
    pub name: String,
    /// What it drives, for results and pictures.
    pub role: DriverRole,
    /// Its value over time.
    pub law: Law,
    /// What its value is measured in.
    pub measure: Measure,
    /// Its part of the work that drivers share \[–\].
    pub share: f64,
    /// Whether its acceleration may be set while a motion goes on.
    pub is_steered: bool,
}

impl DriverData {
    /// Whether it never moves.
    pub fn is_still(&self) -> bool {
        !self.is_steered && self.law.is_constant()
    }
}

/// A body point among the results.
#[derive(Debug, Clone)]
pub struct OutputPoint {
    /// As the file names it.
    pub name: String,
    /// The point.
    pub(crate) marker: Marker,
}

/// One entry of J: row and column (global).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JacobianEntry {
    /// Row.
    pub row: u32,
    /// [`GROUND`] for ground.
    column: u32,
}

/// The column of what has none.
const GROUND: u32 = u32::MAX;

impl JacobianEntry {
    /// Its column; none for ground.
    pub fn column(&self) -> Option<u32> {
        (self.column != GROUND).then_some(self.column)
    }
}

/// A compiled model. Immutable, shared by analyses and threads.
#[derive(Clone)]
pub struct System {
    /// Where the coordinates of the bodies stand.
    pub layout: Layout,
    /// Moving bodies.
    pub bodies: Vec<BodyData>,
    /// Cross-sections of those that have one, by number.
    pub sections: BTreeMap<usize, SectionData>,
    /// Axes of elastic links by few amplitudes.
    pub axes: Vec<ElasticAxis>,
    /// Joints, in the order of the file.
    pub joints: Vec<JointData>,
    /// Drivers, in the order of the file.
    pub drivers: Vec<DriverData>,
    /// Points among the results.
    pub(crate) points: Vec<OutputPoint>,
    /// Blocks of joints, then of drivers, then of stops.
    pub blocks: Vec<Block>,
    /// `initial` coordinates, as blocks of their own for the assembly.
    pub(crate) initial: Vec<Block>,
    /// The coordinates that these hold.
    pub(crate) starts: Vec<crate::element::coordinate::Coordinate>,
    /// `initial` velocities: name, row over the coordinates as (column, factor) at the assembled pose is in `eval`.
    pub(crate) initial_rates: Vec<(String, crate::element::coordinate::Coordinate)>,
    /// How bodies turn, by each other, on the branch on which a singular start is left.
    pub(crate) branch: Vec<(crate::element::BodyId, f64)>,
    /// Springs, dampers, loads and torques.
    pub(crate) forces: Vec<Arc<dyn Force>>,
    /// What each of them is.
    pub(crate) force_data: Vec<ForceData>,
    /// Those that are functions of what moves, in their order.
    pub(crate) formulas: Vec<Arc<Formula>>,
    /// Numbers from outside that formulas name.
    pub(crate) inputs: Vec<InputData>,
    /// Integrated states, whose rates are formulas, too.
    pub(crate) states: Vec<StateData>,
    /// Scales of their kinks, in SI, and behind them of those of cams.
    pub(crate) kinks: Vec<f64>,
    /// Forces that depend on multipliers; no part of [`Evaluation::eval_force`].
    pub(crate) dependent_forces: Vec<DependentForce>,
    /// Joints with clearance by contact force, in the order of the joints; then the stops of joints and the pieces of outlines.
    /// They are shared by the systems of all phases.
    pub(crate) contacts: Arc<Vec<Pair>>,
    /// Rows that may come into force for each of them.
    pub(crate) contact_rows: Arc<Vec<ContactRows>>,
    /// What closed outlines enclose.
    pub(crate) enclosures: Vec<Arc<Enclosure>>,
    /// Which of them events close and open.
    pub(crate) timed: Vec<TimedData>,
    /// Laws of drivers and forces that have breaks.
    pub(crate) broken: Vec<Law>,
    /// Lengths and angles among the results.
    pub(crate) measured: Vec<MeasuredColumn>,
    /// Ratios of velocities among the results.
    pub(crate) outputs: Vec<OutputRatio>,
    /// [m/s²]
    pub(crate) gravity: Vec2,
    /// M; zero where unknown.
    pub(crate) mass: Mass,
    /// All masses (and inertias) are known.
    pub masses_known: bool,
    /// Where the entries of J stand.
    pub entries: Vec<JacobianEntry>,
    /// What each row is measured in (m).
    pub measures: Vec<Measure>,
    /// Number of massless clearance links.
    pub(crate) links: usize,
    /// Guess of the coordinates (n).
    pub guess: Vec<f64>,
    /// Characteristic length of the mechanism \[m\].
    pub size: f64,
    /// Its length, mass and time, by which tolerances are measured.
    pub(crate) scale: Scale,
    /// Forces may come from outside the model, see [`Pushes`].
    pub(crate) is_pushed: bool,
    /// Whether it moves so slowly that nothing has inertia or damping, and velocities count by their direction alone.
    pub(crate) is_slow: bool,
    /// How messages speak of it.
    pub(crate) display: DisplayUnits,
    /// Largest coordinate of a point or centre of mass in the frame of its body \[m\].
    pub(crate) reach: f64,
    /// The same by body, ground first, for systems of some bodies alone.
    pub(crate) extents: Vec<Extent>,
}

impl System {
    /// Whether anything but constraints and weights looks at places or velocities while a motion goes on.
    pub(crate) fn looks_at_places(&self) -> bool {
        let nobody = !self.is_pushed
            && self.forces.is_empty()
            && self.contacts.is_empty()
            && self.dependent_forces.is_empty()
            && self.states.is_empty()
            && self.timed.is_empty()
            && self.formulas.is_empty()
            && self.kinks.is_empty();
        !nobody
    }

    /// Values and rates of the drivers at a time. Where a slow motion stops, its direction is the next one, or else the last.
    pub(crate) fn drive(&self, time: f64, drive: &mut [Jet]) {
        let mut take = |time: f64, from: usize| {
            for (jet, driver) in drive.iter_mut().zip(&self.drivers) {
                jet[from..].copy_from_slice(&driver.law.jet(time)[from..]);
            }
            drive.iter().any(|jet| jet[1] != 0.0)
        };
        if !take(time, 0) && self.is_slow {
            let beside = [1e-6, 1e-3, 1.0].into_iter().flat_map(|by| [by, -by]);
            let mut times = beside.map(|by| time + by * time.abs().max(1.0));
            times.find(|beside| take(*beside, 1));
        }
    }

    /// The rows of the drivers.
    pub(crate) fn driver_rows(&self) -> Range<usize> {
        let first = self.joint_rows();
        first..first + self.drivers.len()
    }

    /// Gives back the room into which its lists have grown.
    fn shrink(&mut self) {
        self.bodies.shrink_to_fit();
        self.blocks.shrink_to_fit();
        self.entries.shrink_to_fit();
        self.measures.shrink_to_fit();
        self.guess.shrink_to_fit();
        self.extents.shrink_to_fit();
        self.mass.shrink();
    }

    /// The first time after `t` at which a law of time has a break.
    pub(crate) fn next_break(&self, t: f64) -> Option<f64> {
        let breaks = self.broken.iter().filter_map(|law| law.next_break(t));
        breaks.reduce(f64::min)
    }

    /// Number of guards of a motion: of contacts, and of formulas and cams whose sides it holds.
    pub(crate) fn guards(&self) -> usize {
        let sides = match self.kinks.is_empty() {
            true => 0,
            false => self.formulas.len() + self.cams().count(),
        };
        self.contacts.len() + sides
    }

    /// The formula whose guard this is, with the numbers of its arguments among those of all; none of a contact or a cam.
    pub(crate) fn formula_of(&self, guard: usize) -> Option<(usize, Range<usize>)> {
        let number = guard.checked_sub(self.contacts.len())?;
        let own = self.formulas.get(number)?.arguments.len();
        let before = self.formulas[..number].iter();
        let first = before.map(|formula| formula.arguments.len()).sum();
        Some((number, first..first + own))
    }

    /// Number of the arguments of all formulas, where any of them has kinks.
    pub(crate) fn kinked_arguments(&self) -> usize {
        let arguments = self.formulas.iter().map(|formula| formula.arguments.len());
        if self.kinks.is_empty() {
            0
        } else {
            arguments.sum()
        }
    }

    /// Cams and their followers.
    pub(crate) fn cams(&self) -> impl Iterator<Item = &Cam> {
        self.joints
            .iter()
            .filter_map(|joint| joint.extras().cam.as_deref())
    }

    /// Writes where the sections and mass points of elastic links are, which follow from their frames and amplitudes, and how they move.
    pub(crate) fn carry(&self, q: &mut [f64], v: Option<&mut [f64]>) {
        if self.bodies.iter().all(|body| body.inner.is_none()) {
            return;
        }
        let mut evaluation = Evaluation::new(self);
        evaluation.set_position(q);
        if let Some(v) = &v {
            evaluation.set_velocity(v);
        }
        let inputs = Inputs::still(self);
        let at = evaluation.kinematics(&inputs);
        let carried = self.bodies.iter().zip(self.layout.bodies());
        let carried: Vec<_> = carried
            .filter_map(|(body, columns)| {
                let station = body.carried()?;
                Some((columns, station.pose(&at), station.twist(&at)))
            })
            .collect();
        for (columns, (place, angle), _) in &carried {
            columns.write(q, [place.x, place.y, *angle]);
        }
        if let Some(v) = v {
            for (columns, _, (velocity, omega)) in &carried {
                columns.write(v, [velocity.x, velocity.y, *omega]);
            }
        }
    }

    /// Number of coordinates n.
    pub fn n(&self) -> usize {
        self.layout.n()
    }

    /// Number of constraint rows m.
    pub fn m(&self) -> usize {
        self.measures.len()
    }

    /// Number of rows that joints make; the drivers' follow.
    pub fn joint_rows(&self) -> usize {
        self.blocks
            .iter()
            .filter(|b| matches!(b.origin, Origin::Joint(_)))
            .map(|b| b.rows().len())
            .sum()
    }

    /// Rows of driver `id`.
    pub fn driver_row(&self, id: DriverId) -> usize {
        self.joint_rows() + id.0
    }

    /// Whether kinetic and potential energy stay constant together: no moving drivers, dampers or loads.
    pub(crate) fn is_conservative(&self) -> bool {
        self.drivers.iter().all(DriverData::is_still)
            && self.contacts.is_empty()
            && self.dependent_forces.is_empty()
            && self.forces.iter().all(|force| force.is_conservative())
    }

    /// The block that makes `row`.
    pub fn block_of_row(&self, row: usize) -> &Block {
        let k = self.blocks.partition_point(|b| b.row() <= row);
        &self.blocks[k - 1]
    }

    /// Poses of the moving bodies' frames at a position: x, y \[m\] and angle \[rad\].
    pub(crate) fn frames(&self, q: &[f64]) -> Vec<[f64; 3]> {
        let bodies = self.bodies.iter().zip(self.layout.bodies());
        let frame = bodies.map(|(body, columns)| {
            let [x, y, theta] = columns.read(q);
            let origin = crate::element::Pose::new(x, y, theta).turn(body.origin);
            [x + origin.x, y + origin.y, theta]
        });
        frame.collect()
    }

    /// Length scale of a coordinate: size for x and y, 1 for angles; coordinates divided by it are comparable.
    pub fn column_scale(&self, column: usize) -> f64 {
        let (_, axis) = self.layout.coordinate(column);
        self.axis_scale(axis)
    }

    /// What a coordinate is measured in.
    pub(crate) fn column_measure(&self, column: usize) -> Measure {
        match self.layout.is_angle(column) {
            true => Measure::Angle,
            false => Measure::Length,
        }
    }

    /// The same for any body's coordinate.
    pub(crate) fn axis_scale(&self, axis: Axis) -> f64 {
        match axis {
            Axis::X | Axis::Y => self.size,
            Axis::Theta => 1.0,
        }
    }

    /// Multiplies coordinates (n) by their scales.
    pub fn scale_columns(&self, x: &mut [f64]) {
        for body in self.layout.bodies() {
            x[body.x()] *= self.size;
            x[body.y()] *= self.size;
        }
    }

    /// Scale of a row's residual [m or rad].
    pub fn row_scale(&self, row: usize) -> f64 {
        self.measure_scale(self.measures[row])
    }

    /// Scale of residuals of a measure [m or rad].
    pub(crate) fn measure_scale(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Length => self.size,
            Measure::Angle => 1.0,
        }
    }

    /// An entry of the Jacobian, row and column measured by their scales [–].
    pub fn scaled_entry(&self, value: f64, row: usize, column: usize) -> f64 {
        value * self.column_scale(column) / self.row_scale(row)
    }

    /// S_φ⁻¹ J S_q, the Jacobian's joint and driver rows as a dense row-major matrix (m × n), scaled to be comparable.
    pub(crate) fn dense_scaled(&self, values: &[f64]) -> Vec<f64> {
        let n = self.n();
        let mut dense = vec![0.0; self.m() * n];
        for (entry, value) in self.entries.iter().zip(values) {
            if let Some(column) = entry.column() {
                let (row, column) = (entry.row as usize, column as usize);
                dense[row * n + column] = self.scaled_entry(*value, row, column);
            }
        }
        dense
    }
}
