//! Sentences that several analyses say, and lists of names in them.

use crate::element::pair::ContactId;
use crate::system::System;

/// Names that a message lists before it only counts them.
const MOST_NAMES: usize = 12;

/// `"a", "b", "c"`, as many as anybody reads.
pub fn quoted<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    listed(&names, ", ")
}

/// Names with something between them, as many as anybody reads.
pub fn listed<S: AsRef<str>>(names: &[S], between: &str) -> String {
    let first: Vec<&str> = names.iter().take(MOST_NAMES).map(AsRef::as_ref).collect();
    let text = first.join(between);
    if names.len() > MOST_NAMES {
        format!("{text}{between}and {} more", names.len() - MOST_NAMES)
    } else {
        text
    }
}

/// What to say where a force that depends on multipliers has no finite size.
pub fn locked(system: &System, force: usize) -> String {
    let own = system.dependent_forces.get(force);
    let name = own.map_or_else(
        // One of rows that a contact held.
        || "a contact".into(),
        |own| system.origin_name(&system.blocks[own.block].origin),
    );
    format!(
        "{name} locks itself: its friction grows with its reaction faster than it can be balanced (no motion satisfies the \
         equations)"
    )
}

/// What to say of friction from reactions that are not the only ones possible.
pub fn unsure_friction(system: &System, not_unique: &[String]) -> Option<String> {
    let with_friction = system
        .joints
        .iter()
        .filter(|joint| joint.extras().friction.is_some() && not_unique.contains(&joint.name));
    let names: Vec<&str> = with_friction.map(|joint| joint.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "the friction of {} follows from reactions of least norm, which are not the only ones",
            names.join(", ")
        )
    })
}

/// Joints whose friction an equilibrium leaves out.
fn rubbing(system: &System) -> Option<String> {
    let with_friction = system
        .joints
        .iter()
        .filter(|joint| joint.extras().friction.is_some());
    let mut names: Vec<&str> = with_friction.map(|joint| joint.name.as_str()).collect();
    names.extend(rough(system));
    (!names.is_empty()).then(|| names.join(", "))
}

/// Contacts with outlines that have friction.
fn rough(system: &System) -> Vec<&str> {
    let contacts = system.contacts.iter().enumerate();
    let rough = contacts.filter(|(_, pair)| pair.edge().is_some() && pair.rubs());
    let mut names: Vec<&str> = rough
        .map(|(k, _)| system.owner_name(ContactId(k)))
        .collect();
    names.dedup();
    names
}

/// What may be behind equations without a solution: a contact that friction locks.
pub fn friction_may_lock(system: &System) -> String {
    let names = rough(system);
    match names.is_empty() {
        true => String::new(),
        false => format!(
            " (or the friction of {} locks it: with a coefficient so large no force balances it)",
            names.join(", ")
        ),
    }
}

/// What to say where nothing moves.
pub fn friction_left_out(system: &System) -> Option<String> {
    rubbing(system).map(|names| {
        format!(
            "the friction of {names} is left out: at rest it can hold the mechanism in many positions, this is the one that needs none"
        )
    })
}

/// What to say of it where there is no equilibrium.
pub fn friction_may_hold(system: &System) -> String {
    rubbing(system).map_or_else(String::new, |names| {
        format!(
            "; the friction of {names}, which might hold it, is left out: drive it in \"quasi_statics\" both ways, where friction \
             holds it the effort pushes in both"
        )
    })
}
