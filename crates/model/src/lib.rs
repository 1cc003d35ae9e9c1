//! The words of a model file (`linkdyn/1`): what the user wrote, checked, with every number already in SI units.
//!
//! This crate knows names, units and places in a file; it knows no equations. The engine compiles a model into numbers.
//! Part of linkdyn; its items change without notice. Use the package `linkdyn`.

pub mod accuracy;
pub mod analysis;
pub mod beam;
pub mod body;
pub mod bundled;
pub mod bushing;
pub mod cam;
pub mod clearance;
pub mod display;
pub mod driver;
pub mod elastic;
pub mod error;
pub mod event;
mod file_access;
pub mod fit;
pub mod force;
pub mod formula;
pub mod joint;
pub mod optimise;
pub mod outline;
mod release;
pub mod response;
pub mod study;
pub mod synthesise;
pub mod tolerance;

mod carrier;
mod compiled_formula;
mod derive;
mod dimension;
mod examples;
mod expression;
mod file;
mod gate;
mod hold;
mod input;
mod json;
mod knob;
mod literal;
mod load;
mod measure;
mod motion;
mod node;
mod point;
mod print;
pub mod ratio;
mod ratio_text;
mod schema;
pub mod section;
mod set;
mod shape;
mod source;
mod stale;
mod state;
mod substitution;
mod suggest;
mod table;
mod tree;
mod units;
mod walk;
mod words;

pub use accuracy::{Accuracy, AccuracyOutput, At, Levels, Measured, Pins};
pub use analysis::{
    Accelerations, Analysis, AnalysisKind, OutputsAt, Sample, Solver, Transmission,
};
pub use body::{Body, Initial, Pose};
pub use carrier::Carrier;
pub use clearance::{
    Clearance, ClearanceModel, Elastic, Friction, FrictionLaw, Impact, ImpactSense, Material,
    Normal, NormalLaw, Surface,
};
pub use derive::Dependence;
pub use dimension::{Dimension, Powers};
pub use driver::{Driver, DriverKind, PointAxis};
pub use expression::{Derivatives, Interval, Leaf, Parameter};
pub use fit::Fit;
pub use force::{Force, ForceKind, Frame, Value};
pub use gate::Checked;
pub use hold::unheld;
pub use joint::{Joint, JointKind};
pub use knob::{Knob, knobs, rewritten};
pub use literal::Literal;
pub use load::{Loaded, load, load_file};
pub use measure::Measurement;
pub use motion::Motion;
pub use optimise::Optimise;
pub use point::PointRef;
pub use response::Response;
pub use schema::schema;
pub use section::{LinkMaterial, LinkSection, SectionShape};
pub use source::Source;
pub use study::Study;
pub use suggest::nearest;
pub use synthesise::Synthesise;
pub use tolerance::{Distribution, Play, Tolerance};
pub use units::Unit;

pub use self::{
    beam::{Beam, BeamSection},
    bushing::{Bushing, PerAxis},
    cam::{Cam, CamSegment, Follower, Profile},
    elastic::{Crack, ElasticBar, ElasticFrame, ElasticLink, ModalData},
    expression::Given,
    file_access::FileAccess,
    force::Stroke,
    formula::Formula,
    input::ModelInput,
    joint::{Latch, OneWay, Stops, Strands, Timed},
    load::{load_with_access, read_file},
    motion::{Interpolation, Paced, Rise, RiseLaw, Segment},
    state::State,
    substitution::{Substituted, Substitution},
    table::Table,
};

use crate::display::DisplayUnits;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

/// The reserved name of the fixed body.
pub const GROUND: &str = "ground";

/// The format of the files that this version reads.
pub const FORMAT: &str = "linkdyn/1";

/// What a name of a body, point, joint, driver or force must look like.
const NAME_PATTERN: &str = r"^[^.\[\],=*?\u0000-\u001f\u007f-\u009f]+$";

/// A whole model: order of the maps is the order in the file. All numbers are SI (m, kg, s, rad, N …).
#[derive(Debug, Clone, PartialEq, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct Model {
    /// What it is called.
    pub name: Option<String>,
    /// What this is, and for whom.
    pub about: Option<String>,
    /// Who measured or published it.
    pub source: Option<String>,
    /// Acceleration of gravity [m/s²], zero where left out.
    pub gravity: [f64; 2],
    /// All bodies, `ground` among them where the file has it.
    pub bodies: IndexMap<String, Body>,
    /// Joints by their names.
    pub joints: IndexMap<String, Joint>,
    /// Prescribed motions by their names.
    pub drivers: IndexMap<String, Driver>,
    /// Springs, loads and torques by their names.
    pub forces: IndexMap<String, Force>,
    /// Functions by their points, for formulas.
    pub tables: IndexMap<String, Table>,
    /// Numbers from outside, for formulas.
    pub inputs: IndexMap<String, ModelInput>,
    /// Quantities of which the rates are known.
    pub states: IndexMap<String, State>,
    /// Exact values at t = 0, per body.
    pub initial: IndexMap<String, Initial>,
    /// Body points whose motion is wanted among the results.
    pub points: Vec<PointRef>,
    /// Lengths and angles of points, as columns.
    pub measures: IndexMap<String, Measurement>,
    /// What is to be computed.
    pub analysis: Option<Analysis>,
    /// What is asked of its accuracy.
    pub accuracy: Option<Accuracy>,
    /// Ratios of velocities, as columns.
    pub outputs: IndexMap<String, String>,
    /// Named numbers of a run.
    pub responses: IndexMap<String, Response>,
    /// Many variants.
    pub study: Option<Study>,
    /// What an optimisation looks for.
    pub optimise: Option<Optimise>,
    /// What linkages are wanted for.
    pub synthesise: Option<Synthesise>,
    /// How messages speak of it: the units that the file names.
    #[serde(skip)]
    pub display: DisplayUnits,
}
