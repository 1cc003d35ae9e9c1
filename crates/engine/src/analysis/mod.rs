//! The analyses: from a model to a trajectory and a report.

mod applied;
pub mod assembly;
mod branch;
mod channels;
mod check;
mod clearance_link;
mod control;
pub mod derived;
pub mod driven;
mod dynamics;
mod in_line;
mod instants;
mod interval;
mod modes;
mod outcome;
mod power;
mod progress;
mod question;
mod readings;
mod record;
mod rows;
mod run;
pub mod sample;
mod settings;
mod shaking;
mod statics;
mod suspicious;
mod transmission;
mod words;

pub use check::{Check, Lack, check};
pub use control::{Control, Stop};
pub use modes::{Linearised, Mode, modes};
pub use outcome::Outcome;
pub use progress::Progress;
pub use run::{Prepared, run};
pub use suspicious::suspicious;
