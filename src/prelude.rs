//! What most programs need: `use linkdyn::prelude::*;`.

pub use crate::quantity::{deg, kg, m, mm, newton, newton_metre, rad, rpm, s, um};
pub use crate::{
    Checkpoint, Column, Complaint, Control, Error, Event, Family, Mechanism, Member, Model,
    Parameter, Quantity, Report, Run, Simulation, Status, Values,
};
