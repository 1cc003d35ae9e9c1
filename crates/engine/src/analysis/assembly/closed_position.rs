//! A position that meets everything, however it was found.

use super::way::Reached;
use crate::element::Axis;
use crate::mechanism::closing::{Closed, close};
use crate::system::{Block, Inputs, System};

/// A position that meets everything.
pub(super) struct ClosedPosition {
    pub q: Vec<f64>,
    pub iterations: u64,
    pub arrival: Option<Vec<f64>>,
    pub warnings: Vec<String>,
}

impl ClosedPosition {
    /// One of which there is nothing to say.
    pub fn alone(closed: Closed) -> Self {
        ClosedPosition {
            q: closed.q,
            iterations: closed.iterations,
            arrival: None,
            warnings: Vec::new(),
        }
    }

    /// One that is reached from the drawing; `None` if it does not meet initial values that could not lead the way.
    pub fn reached(
        system: &System,
        inputs: &Inputs,
        reached: Reached,
        before: u64,
    ) -> Option<Self> {
        let all: Vec<&Block> = system.blocks.iter().chain(&system.initial).collect();
        let closed = close(system, &all, &reached.q, inputs);
        closed.converged.then(|| {
            let mut q = closed.q;
            // Met to round-off; exact they are what the file says.
            for start in &system.starts {
                let column = system.layout.column(start.origin.body, start.axis);
                if let (Axis::Theta, Some(column)) = (start.axis, column) {
                    q[column] = start.value;
                }
            }
            ClosedPosition {
                q,
                iterations: before + closed.iterations,
                arrival: reached.arrival,
                warnings: reached.warnings,
            }
        })
    }
}
