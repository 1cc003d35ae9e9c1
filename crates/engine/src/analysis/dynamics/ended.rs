//! Why a run ended before its time, in words and in parts.

use super::fault::Fault;
use super::motion::Motion;
use super::words::{culprits, describe, jam, tight};
use crate::analysis::words::locked;
use crate::mechanism::driven::Failure;
use linkdyn_output::{Reason, Status};

/// Why the loop ended before its time.
pub struct Ended {
    /// How the run ended.
    pub status: Status,
    /// The same in words.
    pub message: String,
    /// And in parts, where it failed.
    pub reason: Option<Box<Reason>>,
}

impl Ended {
    /// At an output that can't be solved.
    pub fn at_output(motion: &mut Motion, fault: Fault, time: f64) -> Ended {
        let system = motion.system();
        let when = system.display.time(time);
        let message = match fault {
            Fault::Unsolved(Failure::Locked { force }) => format!(
                "at t = {when} {}; the rows until there are kept",
                locked(system, force)
            ),
            Fault::Unsolved(
                Failure::Singular | Failure::Diverged { .. } | Failure::Inconsistent { .. },
            )
            | Fault::TooSmall { .. }
            | Fault::Indivisible { .. } => format!("the position at t = {when} can't be solved"),
        };
        Ended {
            status: Status::Singular,
            message,
            reason: Some(Box::new(fault.reason(motion, time))),
        }
    }

    /// At a step that can't be taken. `ahead` is a force that is about to lock its joint, `jammed` the rigid contacts that no
    /// forces answer.
    pub fn at_step(
        motion: &mut Motion,
        fault: Fault,
        now: f64,
        ahead: Option<usize>,
        jammed: &[usize],
    ) -> Ended {
        let (status, message) = told(motion, fault, now, ahead, jammed);
        Ended {
            status,
            message,
            reason: Some(Box::new(fault.reason(motion, now))),
        }
    }
}

/// What a step that can't be taken means.
fn told(
    motion: &mut Motion,
    fault: Fault,
    now: f64,
    ahead: Option<usize>,
    jammed: &[usize],
) -> (Status, String) {
    let refused = match fault {
        Fault::TooSmall { .. } => false,
        Fault::Indivisible { .. } | Fault::Unsolved(_) => true,
    };
    let lock = motion
        .reduced
        .driven
        .dependent_forces
        .locked()
        .filter(|_| refused)
        .or(ahead);
    if let Some(force) = lock {
        let who = locked(motion.system(), force);
        let when = motion.system().display.time(now);
        return (
            Status::Singular,
            format!("at t = {when} {who}; the rows until there are kept"),
        );
    }
    let display = &motion.system().display;
    if !refused {
        let what = describe(fault, now, "", display);
        return (Status::StepTooSmall, format!("{what}{}", tight(motion)));
    }
    if !jammed.is_empty() {
        return (Status::Singular, jam(motion, jammed, now));
    }
    let culprits = culprits(motion);
    (Status::Singular, describe(fault, now, &culprits, display))
}
