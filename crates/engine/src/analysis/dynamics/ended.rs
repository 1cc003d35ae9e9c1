//! Why a run ended before its time, in words and in parts.

use super::fault::Fault;
use super::flow::Flow;
use super::ledger::Ledger;
use super::words::{busiest, chatters, culprits, describe, jam, no_value, tight, unclosed};
use crate::analysis::words::{friction_may_lock, locked};
use crate::mechanism::driven::Failure;
use crate::system::System;
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
    /// By the user or the clock, at `time`, in a motion whose contacts have done so much.
    pub fn stopped(status: Status, time: f64, system: &System, ledger: &Ledger) -> Ended {
        let why = match status {
            Status::Interrupted => "interrupted".to_string(),
            _ => format!(
                "max_wall_time is over at t = {}{}",
                system.display.time(time),
                ledger.busiest(system).map_or_else(String::new, busiest)
            ),
        };
        Ended {
            status,
            message: format!("{why}; the rows until then are kept"),
            reason: None,
        }
    }

    /// At an output that can't be solved.
    pub fn at_output(flow: &mut Flow, fault: Fault, time: f64) -> Ended {
        let system = flow.system();
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
            | Fault::Chatters { .. }
            | Fault::NoValue { .. }
            | Fault::Apart { .. }
            | Fault::Driven { .. }
            | Fault::Inside { .. }
            | Fault::Indivisible { .. } => format!("the position at t = {when} can't be solved"),
        };
        Ended {
            status: Status::Singular,
            message,
            reason: Some(Box::new(fault.reason(flow, time))),
        }
    }

    /// At a step that can't be taken. `ahead` is a force that is about to lock its joint, `jammed` the rigid contacts that no
    /// forces answer.
    pub fn at_step(
        flow: &mut Flow,
        fault: Fault,
        now: f64,
        ahead: Option<usize>,
        jammed: &[usize],
    ) -> Ended {
        let (status, message) = told(flow, fault, now, ahead, jammed);
        Ended {
            status,
            message,
            reason: Some(Box::new(fault.reason(flow, now))),
        }
    }
}

/// What a step that can't be taken means.
fn told(
    flow: &mut Flow,
    fault: Fault,
    now: f64,
    ahead: Option<usize>,
    jammed: &[usize],
) -> (Status, String) {
    if let Some(message) = unclosed(flow.system(), fault, now) {
        return (Status::Singular, message);
    }
    let refused = match fault {
        Fault::Chatters { force } => return (Status::StepTooSmall, chatters(flow, force, now)),
        Fault::NoValue { force } => return (Status::Singular, no_value(flow, force, now)),
        Fault::TooSmall { .. } => false,
        Fault::Indivisible { .. }
        | Fault::Apart { .. }
        | Fault::Driven { .. }
        | Fault::Inside { .. }
        | Fault::Unsolved(_) => true,
    };
    let lock = flow
        .equations
        .dependent_forces()
        .locked()
        .filter(|_| refused)
        .or(ahead)
        // Friction of a contact that has let go since is not among them any more.
        .filter(|&force| force < flow.system().dependent_forces.len());
    if let Some(force) = lock {
        let who = locked(flow.system(), force);
        let when = flow.system().display.time(now);
        return (
            Status::Singular,
            format!("at t = {when} {who}; the rows until there are kept"),
        );
    }
    let display = &flow.system().display;
    if !refused {
        let what = describe(fault, now, "", display);
        return (Status::StepTooSmall, format!("{what}{}", tight(flow)));
    }
    if !jammed.is_empty() {
        return (Status::Singular, jam(flow, jammed, now));
    }
    let culprits = culprits(flow) + &friction_may_lock(flow.system());
    (Status::Singular, describe(fault, now, &culprits, display))
}
