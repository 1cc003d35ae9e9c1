//! What is said of a run: where it ended and by whose fault, and what to doubt.

use super::fault::Fault;
use super::flow::Flow;
use crate::analysis::ends;
use crate::analysis::in_line::singular_text;
use crate::element::journal::Journal;
use crate::element::pair::{ContactId, Reading, Surface};
use crate::system::System;
use linkdyn_model::display::DisplayUnits;
use linkdyn_model::error::Complaint;

/// Determinant of the friction's equations, 1 without friction, below which a joint is about to lock itself.
pub(super) const TIGHT: f64 = 0.1;
/// So often a contact changes in a run that it keeps busy.
const BUSY: u64 = 30;
/// Penetration, in parts of the journal's radius, that is not small any more.
const DEEP: f64 = 0.1;
/// Digits of penetrations: of the deepest that steps and outputs have met.
const PENETRATION_DIGITS: usize = 4;

/// Whose contact has kept a run busy, where it has.
pub(super) fn busiest((owner, happened): (String, u64)) -> String {
    if happened < BUSY {
        return String::new();
    }
    format!(": the contact of {owner} has changed {happened} times, more than any other")
}

/// Rigid contacts, by number, that no forces answer.
pub(super) fn jam(flow: &Flow, jammed: &[usize], now: f64) -> String {
    let name = |&contact: &usize| format!("{:?}", flow.system().owner_name(ContactId(contact)));
    let jammed: Vec<String> = jammed.iter().map(name).collect();
    format!(
        "at t = {} the journals that slide on their bearings jam in {} {}: with this friction neither normal forces nor \
         impulses answer the motion (Painlevé's paradox); a smaller coefficient, or the model \"contact\", goes on; the rows until there are kept",
        flow.system().display.time(now),
        if jammed.len() == 1 { "joint" } else { "joints" },
        jammed.join(", ")
    )
}

/// What is said where the penetration was beyond what the law of the normal force was made for.
pub(super) fn beyond_range(
    display: &DisplayUnits,
    joint: &str,
    (journal, surface): (&Journal, &Surface),
    deepest: f64,
) -> Option<String> {
    let Surface::Compliant(laws) = surface else {
        return None;
    };
    let Some(range) = laws.normal.range() else {
        let radius = journal.bearing_radius - journal.clearance;
        return (radius > 0.0 && deepest > DEEP * radius).then(|| {
            format!(
                "joint \"{joint}\": the penetration reached {}, {:.2} of the journal's radius: laws of contact are made for \
                 one that is small against it; is the surface stiff enough?",
                display.length_to(deepest, PENETRATION_DIGITS),
                deepest / radius
            )
        });
    };
    (deepest > range).then(|| format!(
        "joint \"{joint}\": the penetration reached {} ({:.2} of the clearance), the formula of its normal law ends at \
         {}: beyond, the force goes on straight, and is no more than a guess",
        display.length_to(deepest, PENETRATION_DIGITS),
        deepest / journal.clearance,
        display.length_to(range, PENETRATION_DIGITS)
    ))
}

/// A start against a one-way clutch.
pub(super) fn backward_start(system: &System, contact: usize) -> Complaint {
    let id = ContactId(contact);
    Complaint::new(
        format!("{}.one_way", system.owner_path(id)),
        "the mechanism starts with the joint turning the way that its clutch holds",
    )
    .hint("turn the clutch round, or give initial velocities the other way")
}

pub(super) fn deep_start(system: &System, contact: usize, reading: &Reading) -> Complaint {
    let name = system.owner_name(ContactId(contact));
    let pair = &system.contacts[contact];
    let Some(clearance) = pair.journal().map(|journal| journal.clearance) else {
        return ends::deep(system, contact, reading.penetration);
    };
    Complaint::new(
        "initial",
        format!(
            "joint \"{name}\" starts with its journal {} deep in the bearing: eccentricity {}, clearance {}",
            system.display.length(reading.penetration),
            system.display.length(reading.penetration + clearance),
            system.display.length(clearance),
        ),
    )
    .hint("give initial values that leave the journal within its clearance, or a larger clearance")
}

/// What comes nearest to being singular at the last accepted point: ` (…)`, bodies in line or joints that lose rank.
pub(super) fn culprits(flow: &mut Flow) -> String {
    let rows = flow.equations.strained_rows();
    singular_text(flow.system(), &rows).map_or_else(String::new, |what| format!(" ({what})"))
}

/// The joint that is about to lock itself by its friction, where one is.
pub(super) fn tight(flow: &Flow) -> String {
    let (system, dependent) = (flow.system(), flow.equations.dependent_forces());
    if system.dependent_forces.is_empty() || dependent.margin() > TIGHT {
        return String::new();
    }
    let block = &system.blocks[system.dependent_forces[dependent.tightest()].block];
    format!(
        " ({} is about to lock itself by its friction)",
        system.origin_name(&block.origin)
    )
}

/// A formula that drives the motion back to where it jumps, from either side.
pub(super) fn chatters(flow: &Flow, force: usize, now: f64) -> String {
    let system = flow.system();
    format!(
        "at t = {} the formula of {} holds the motion where it jumps: it changes its side again and again without \
         end; the rows until there are kept. A force that brakes is friction of a joint, or smooth, as in v/sqrt(v^2 + v0^2)",
        system.display.time(now),
        system.owner(force)
    )
}

/// A formula with a root of a negative number, a division by zero, or the like.
pub(super) fn no_value(flow: &Flow, force: usize, now: f64) -> String {
    let system = flow.system();
    format!(
        "beyond t = {} the formula of {} has no value (a root of a negative number, a division by zero, or the \
         like); the rows until there are kept",
        system.display.time(now),
        system.owner(force)
    )
}

/// What can't close at an event; nothing of another fault.
pub(super) fn unclosed(system: &System, fault: Fault, now: f64) -> Option<String> {
    let display = &system.display;
    let when = display.time(now);
    Some(match fault {
        Fault::Apart { contact, gap } => {
            let name = system.contact_name(ContactId(contact));
            let [length, angle] = gap;
            let apart = match length > angle * system.size {
                true => format!("its points are {} apart", display.length_to(length, 4)),
                false => format!(
                    "its bodies are {} off their angle",
                    display.angle_to(angle, 4)
                ),
            };
            format!(
                "at t = {when} {name} closes, and {apart}; the rows until there are kept. Let its event be where they meet"
            )
        }
        Fault::Driven { contact, .. } => {
            let name = system.contact_name(ContactId(contact));
            format!(
                "at t = {when} {name} closes on what a driver moves on; the rows until there are kept. Let the driver rest \
                 there, or let a torque drive instead of it"
            )
        }
        Fault::Inside { contact } => {
            let name = system.owner_words(ContactId(contact));
            let (why, mend) = match system.contacts[contact].surface {
                Surface::Rigid(_) => (
                    "and has not been seen to touch it: steps were too long for it",
                    "A shorter max_step, or a smaller rtol, sees it",
                ),
                Surface::Compliant(_) => (
                    "deeper in a corner than its walls reach: they yield too much",
                    "A larger stiffness keeps it out",
                ),
            };
            format!(
                "at t = {when} the tip of {name} is inside its outline, {why}; the rows until there are kept. {mend}"
            )
        }
        Fault::TooSmall { .. }
        | Fault::Indivisible { .. }
        | Fault::Chatters { .. }
        | Fault::NoValue { .. }
        | Fault::Unsolved(_) => return None,
    })
}

/// What a failed step means; `what` says what is singular.
pub(super) fn describe(fault: Fault, now: f64, what: &str, display: &DisplayUnits) -> String {
    match fault {
        Fault::TooSmall { t, h } => format!(
            "step too small at t = {}: the tolerances ask for steps below {}; the rows until there are kept. \
             Loosen rtol, or look for what changes so fast there",
            display.time(t),
            display.time_to(h, 2)
        ),
        Fault::Indivisible { .. }
        | Fault::Chatters { .. }
        | Fault::NoValue { .. }
        | Fault::Apart { .. }
        | Fault::Driven { .. }
        | Fault::Inside { .. }
        | Fault::Unsolved(_) => format!(
            "the motion can't be followed beyond t = {}: the constraints are singular there{what}; the rows until there are kept",
            display.time(now)
        ),
    }
}
