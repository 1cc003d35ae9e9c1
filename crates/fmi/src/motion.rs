//! A simulation, and what was done to it: from that it can be done again, bit by bit, in another instance or another process.
//!
//! What a simulation holds of its integrator, its factors and its contacts are megabytes that only it can read. What was done to it are
//! sixteen bytes a step, and the engine repeats itself exactly. So that is what a state consists of in a file, and reading it takes as long
//! as the motion took.

use std::sync::Arc;

use linkdyn::fmu::{Interface, Role};
use linkdyn::{Checkpoint, Column, Event, Mechanism, Simulation};

use crate::refusal::Refusal;

/// What was done to a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Act {
    /// Gave an input, by its value reference, a value.
    Set(u32, f64),
    /// Stepped to an instant \[s\].
    Step(f64),
    /// Stepped to an instant \[s\], or the first event before it.
    StepToEvent(f64),
}

/// Acts of one block of a history.
const BLOCK: usize = 1024;
/// Acts that are remembered, at most: 64 MB.
pub const MOST_ACTS: usize = 1 << 22;

/// What was done since the beginning. Copies share what they have in common.
#[derive(Debug, Clone, Default)]
pub struct History {
    full: Option<Arc<Block>>,
    last: Vec<Act>,
    length: usize,
}

#[derive(Debug)]
struct Block {
    acts: Vec<Act>,
    before: Option<Arc<Block>>,
}

impl History {
    /// Adds an act; beyond the most it only counts.
    pub fn push(&mut self, act: Act) {
        self.length += 1;
        if self.length > MOST_ACTS {
            return;
        }
        self.last.push(act);
        if self.last.len() == BLOCK {
            self.full = Some(Arc::new(Block {
                acts: std::mem::take(&mut self.last),
                before: self.full.take(),
            }));
        }
    }

    /// All acts, in their order.
    ///
    /// # Errors
    /// Where there were too many.
    pub fn acts(&self) -> Result<Vec<Act>, Refusal> {
        if self.length > MOST_ACTS {
            return Err(Refusal::new(format!(
                "a state can be kept outside the unit, or given to another instance, for the first {MOST_ACTS} steps; this is step {}",
                self.length
            )));
        }
        let blocks = std::iter::successors(self.full.as_deref(), |block| block.before.as_deref());
        let mut blocks: Vec<&[Act]> = blocks.map(|block| &block.acts[..]).collect();
        blocks.reverse();
        blocks.push(&self.last);
        Ok(blocks.concat())
    }
}

/// A simulation with its history.
pub struct Motion {
    simulation: Simulation,
    history: History,
    /// The interface by which inputs have names.
    interface: Arc<Interface>,
    /// Inputs have changed since the result columns were evaluated.
    is_stale: bool,
}

/// A point of a motion.
#[derive(Debug, Clone)]
pub struct Point {
    /// For the simulation that it is one of.
    checkpoint: Option<Checkpoint>,
    /// For all others.
    pub history: History,
    is_stale: bool,
}

impl Motion {
    /// At t = 0, with these values of inputs by value reference.
    ///
    /// # Errors
    /// Where the mechanism can't start.
    pub fn new(
        mechanism: &Mechanism,
        interface: &Arc<Interface>,
        values: &[f64],
    ) -> Result<Self, Refusal> {
        let mut motion = Motion::bare(mechanism, interface)?;
        for (reference, value) in (0..).zip(values) {
            let is_other = match interface.variables[reference as usize].role {
                Role::Input(start) => start != *value,
                Role::Acceleration => true,
                Role::Time | Role::Parameter(_) | Role::Output { .. } | Role::Events => false,
            };
            if is_other {
                motion.set(reference, *value)?;
            }
        }
        Ok(motion)
    }

    fn bare(mechanism: &Mechanism, interface: &Arc<Interface>) -> Result<Self, Refusal> {
        let steered = interface.inputs();
        let steered = steered.filter(|input| input.role == Role::Acceleration);
        let steered: Vec<&str> = steered.map(|input| input.owner.as_str()).collect();
        Ok(Motion {
            simulation: mechanism.steered_simulation(&steered)?,
            history: History::default(),
            interface: interface.clone(),
            is_stale: false,
        })
    }

    /// The instant \[s\].
    pub fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// The value of a result column.
    ///
    /// # Errors
    /// Where it can't be evaluated under the inputs of the instant.
    pub fn value(&mut self, column: Column) -> Result<f64, Refusal> {
        if self.is_stale {
            // To where it is: that evaluates the columns anew.
            self.act(Act::Step(self.simulation.time()))?;
        }
        Ok(self.simulation.value(column))
    }

    /// Gives an input a value.
    ///
    /// # Errors
    /// Where there is none of that reference.
    pub fn set(&mut self, reference: u32, value: f64) -> Result<(), Refusal> {
        self.act(Act::Set(reference, value)).map(drop)
    }

    /// Steps, and tells what happened.
    ///
    /// # Errors
    /// Where the motion can't go on; it stays where its last step ended.
    pub fn step(&mut self, time: f64, to_event: bool) -> Result<Vec<Event>, Refusal> {
        self.act(match to_event {
            true => Act::StepToEvent(time),
            false => Act::Step(time),
        })
    }

    fn act(&mut self, act: Act) -> Result<Vec<Event>, Refusal> {
        self.history.push(act);
        self.is_stale = matches!(act, Act::Set(..));
        let simulation = &mut self.simulation;
        let happened = match act {
            Act::Set(reference, value) => {
                let variable = self.interface.variables.get(reference as usize);
                match variable.map(|variable| (variable.role, &variable.owner)) {
                    Some((Role::Input(_), owner)) => simulation.set_input(owner, value)?,
                    Some((Role::Acceleration, owner)) => {
                        simulation.set_acceleration(owner, value)?;
                    }
                    Some(_) | None => {
                        return Err(Refusal::new(format!("{reference} is no input")));
                    }
                }
                Vec::new()
            }
            Act::Step(time) => simulation.step_to(time)?,
            Act::StepToEvent(time) => simulation.step_to_event(time)?,
        };
        Ok(happened)
    }

    /// Keeps where it is.
    pub fn point(&mut self) -> Point {
        Point {
            checkpoint: Some(self.simulation.checkpoint()),
            history: self.history.clone(),
            is_stale: self.is_stale,
        }
    }

    /// Goes back to a point of this simulation; whether it is one.
    pub fn restore(&mut self, point: &Point) -> bool {
        let own = point.checkpoint.as_ref();
        let restored = own.is_some_and(|own| self.simulation.restore(own).is_ok());
        if restored {
            self.history = point.history.clone();
            self.is_stale = point.is_stale;
        }
        restored
    }

    /// Does all again that led to a point, with the mechanism that it is one of.
    ///
    /// # Errors
    /// Where that can't be done.
    pub fn repeat(
        mechanism: &Mechanism,
        interface: &Arc<Interface>,
        point: &Point,
    ) -> Result<Self, Refusal> {
        let mut motion = Motion::bare(mechanism, interface)?;
        for act in point.history.acts()? {
            // What failed then fails again, and leaves the same.
            let _ = motion.act(act);
        }
        Ok(motion)
    }
}

impl Point {
    /// A point by what led to it.
    pub fn of_acts(acts: impl IntoIterator<Item = Act>) -> Self {
        let mut history = History::default();
        acts.into_iter().for_each(|act| history.push(act));
        Point {
            checkpoint: None,
            history,
            is_stale: false,
        }
    }
}
