//! What is said of singular starts that nothing decides, or that velocities contradict.

use super::pace::{NEARER, Pace, failed, miss};
use crate::analysis::branch::turns;
use crate::analysis::control::Stop;
use crate::analysis::words::listed;
use crate::element::{Axis, BodyId};
use crate::mechanism::branching::Branch;
use crate::system::System;
use linkdyn_model::display::number;

/// Digits of turns in messages.
const DIGITS: usize = 3;
/// The same of rates.
const RATE_DIGITS: usize = 6;

/// Turns below this, by the largest, are none.
const STILL: f64 = 1e-6;

const START: &str = "the start is a singular position (the constraints lose rank there)";

/// What to say of velocities that miss a branch.
pub(super) fn off(system: &System, pace: &Pace, which: &str) -> Stop {
    let rates = system.initial_rates.iter();
    let missing = pace.missing.iter().rev().take(rates.len()).rev();
    let worst = rates
        .zip(missing)
        .max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()));
    let told = worst.map_or_else(String::new, |((name, rate), missing)| {
        let scale = system.axis_scale(rate.axis);
        let unit = match rate.axis {
            Axis::Theta => "rad/s",
            Axis::X | Axis::Y => "m/s",
        };
        // The row says: what is less what is wanted.
        let there = number(rate.value + missing * scale, RATE_DIGITS);
        let given = number(rate.value, RATE_DIGITS);
        format!(": there {name} is {there} {unit}, and {given} {unit} is given")
    });
    failed(format!(
        "{START}, and the initial velocities are not those of the branch of motion {which}{told}"
    ))
}

/// What to say where the way from the drawing decides, with the words that mean another branch.
pub(super) fn arrived(system: &System, branches: &[Branch], taken: usize) -> String {
    let way = |branch: &Branch| turns(system, &branch.direction);
    let others = branches.iter().enumerate().filter(|(k, _)| *k != taken);
    let others: Vec<String> = others
        .take(1)
        .map(|(_, other)| {
            let hint = hint(system, branches, other);
            format!(
                "; on another {}: for that one say \"initial\": {hint}",
                way(other)
            )
        })
        .collect();
    format!(
        "{START}, from which {} branches of motion lead away: taken is the one on which it is reached from the drawing, where {}{}",
        branches.len(),
        way(&branches[taken]),
        others.concat(),
    )
}

/// What to say where nothing decides, with the words that would.
pub(super) fn undecided(system: &System, branches: &[Branch]) -> Stop {
    let shown = &branches[..branches.len().min(2)];
    let ways: Vec<String> = shown
        .iter()
        .map(|branch| turns(system, &branch.direction))
        .collect();
    let words: Vec<String> = shown
        .iter()
        .map(|branch| hint(system, branches, branch))
        .collect();
    failed(format!(
        "{START}, from which {} branches of motion lead away: on one {}. Give \"initial\" velocities that only one of them \
         has, or say how bodies turn by each other there: \"initial\": {}",
        branches.len(),
        listed(&ways, "; on another "),
        listed(&words, ", or "),
    ))
}

/// Words of the model that mean one of the branches: by two bodies where these tell it, else by all.
fn hint(system: &System, branches: &[Branch], branch: &Branch) -> String {
    let turn = |k: usize| branch.direction[system.layout.moving(k).theta()];
    let bodies = system.bodies.len();
    let id = BodyId::moving;
    let tells = |hints: &[(BodyId, f64)]| {
        let others = branches.iter().filter(|other| *other != branch);
        others.fold(f64::INFINITY, |least: f64, other| {
            least.min(miss(system, hints, other))
        })
    };
    let pairs = (0..bodies).flat_map(|a| (a + 1..bodies).map(move |b| [a, b]));
    let pairs = pairs.map(|pair| {
        let hints = pair.map(|k| (id(k), turn(k)));
        (tells(&hints), pair.to_vec())
    });
    let best = pairs.max_by(|(a, _), (b, _)| a.total_cmp(b));
    let chosen = match best {
        Some((told, pair)) if told.is_finite() && told > 1.0 - NEARER => pair,
        _ => (0..bodies).collect(),
    };
    let largest =
        chosen.iter().map(|&k| turn(k)).fold(
            0.0,
            |most: f64, x| if x.abs() > most.abs() { x } else { most },
        );
    let word = |&k: &usize| {
        let name = &system.bodies[k].name;
        let share = turn(k) / largest;
        let share = if share.abs() < STILL { 0.0 } else { share };
        let share = number(share, DIGITS);
        format!("\"{name}\": {{ \"branch\": {share} }}")
    };
    let words: Vec<String> = chosen.iter().map(word).collect();
    format!("{{ {} }}", words.join(", "))
}
