//! The analyses: from a model to a trajectory and a report.

mod acting;
mod along;
mod applied;
mod assemblies;
pub mod assembly;
mod belts;
mod bent;
mod branch;
mod cams;
pub mod channels;
mod check;
pub mod clearance_link;
mod control;
mod departure;
pub mod derived;
mod derived_columns;
pub mod driven;
mod dynamics;
mod ends;
mod equilibrium;
mod family;
pub mod hand;
pub mod in_line;
pub mod instants;
mod interval;
mod leaning;
mod modes;
mod needed;
mod outcome;
mod outside;
mod power;
mod progress;
mod quasi_statics;
pub mod question;
mod ratios;
pub mod readings;
mod record;
pub mod responses;
mod rows;
mod run;
pub mod sample;
mod section;
mod settings;
mod shaking;
mod state_space;
mod statics;
mod suspicious;
mod transmission;
mod unbounded;
pub mod words;

pub use along::{AlongStroke, Rates};
pub use assemblies::{
    AllAssemblies, AllCircuits, AssemblyGroup, CircuitsQuestion, FoundAssembly, FoundCircuit,
    Turning, all_assemblies, all_circuits,
};
pub use bent::{BentAxis, bent_axes};
pub use check::{Check, Lack, check};
pub use control::{Control, Stop};
pub use dynamics::{Snapshot, Stepped};
pub use family::{ABREAST, Ended, Family, Member};
pub use modes::{Linearised, Mode, modes};
pub use outcome::Outcome;
pub use progress::Progress;
pub use run::{Prepared, run};
pub use state_space::{LinearSystem, NoLinearSystem, StateSpaceQuestion, Variable, state_space};
pub use suspicious::suspicious;
