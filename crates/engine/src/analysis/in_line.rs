//! What is singular in a singular position, in words: which bodies lie in a line there.
//!
//! The constraints carry a self-stress there: forces in the joints that balance each other, without any load. A body that it
//! holds by two pins alone carries a force along the line of both; where two such bodies share a pin, all their pins are in
//! one line. A slider that it holds by a pin and a guide has that force square to the guide, and one between two guides has
//! them parallel. So it is enough to know where the self-stress is.

use super::words::quoted;
use crate::element::Measure;
use crate::system::{Block, Origin, System};

/// Part of the largest force above which a row belongs to a self-stress.
const STRESSED: f64 = 1e-3;

/// Forces below this part of the largest component are none.
const NOISE: f64 = 1e-8;

/// How a block holds a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Holds {
    Pin,
    Guide,
    Otherwise,
}

/// Rows that take part in a self-stress (m), scaled: forces by the largest force, torques by the largest of all.
pub fn stressed_rows(system: &System, self_stress: &[f64]) -> Vec<usize> {
    let rows = || {
        self_stress
            .iter()
            .enumerate()
            .map(|(row, part)| (row, part.abs()))
    };
    let is_force = |row: usize| matches!(system.measures[row], Measure::Length);
    let all = rows().fold(0.0, |most: f64, (_, part)| most.max(part));
    let forces = rows()
        .filter(|(row, _)| is_force(*row))
        .fold(NOISE * all, |most: f64, (_, part)| most.max(part));
    let stressed =
        rows().filter(|&(row, part)| part > STRESSED * if is_force(row) { forces } else { all });
    stressed.map(|(row, _)| row).collect()
}

/// A body that carries a force between two pins: its number, and the first rows of these.
type Rod = (usize, [usize; 2]);

/// What lies in a line, from the rows of a self-stress: `"coupler" and "rocker" are in line`; `None` if that is not it.
pub fn in_line(system: &System, rows: &[usize]) -> Option<String> {
    let is_stressed = |block: &&Block| {
        let mut own = block.rows();
        own.any(|row| rows.contains(&row))
    };
    let stressed: Vec<&Block> = system.blocks.iter().filter(is_stressed).collect();
    let mut rods: Vec<Rod> = Vec::new();
    let mut sliders: Vec<[&Block; 2]> = Vec::new();
    for body in 1..=system.bodies.len() {
        if let [first, second] = holding(&stressed, body)[..] {
            match (holds(system, first), holds(system, second)) {
                (Holds::Pin, Holds::Pin) => rods.push((body, [first.row(), second.row()])),
                (Holds::Pin, Holds::Guide) => sliders.push([first, second]),
                (Holds::Guide, Holds::Pin) => sliders.push([second, first]),
                (Holds::Guide, Holds::Guide) => {
                    let guides = [joint_name(system, first), joint_name(system, second)];
                    return Some(format!(
                        "the guides {} are parallel",
                        quoted(guides.into_iter())
                    ));
                }
                (Holds::Otherwise, _) | (_, Holds::Otherwise) => {}
            }
        }
    }
    let lines = lines(system, &rods, &sliders);
    (!lines.is_empty()).then(|| lines.join(", "))
}

/// Blocks that hold a body.
fn holding<'s>(stressed: &[&'s Block], body: usize) -> Vec<&'s Block> {
    let touches = |block: &&&Block| {
        let entries = block.constraint.entries();
        entries.iter().any(|(_, id, _)| id.0 == body)
    };
    stressed.iter().filter(touches).copied().collect()
}

/// How a block holds its bodies.
fn holds(system: &System, block: &Block) -> Holds {
    match block.origin {
        Origin::Joint(id) => match (block.rows().len(), system.joints[id.0].torque()) {
            (2, false) => Holds::Pin,
            (1, false) | (2, true) => Holds::Guide,
            _ => Holds::Otherwise,
        },
        Origin::Driver(_) | Origin::Stop(_) | Origin::Initial(_) => Holds::Otherwise,
    }
}

/// The name of the joint that a block is from.
fn joint_name<'s>(system: &'s System, block: &Block) -> &'s str {
    match block.origin {
        Origin::Joint(id) => system.joints[id.0].name.as_str(),
        Origin::Stop(id) => system.owner_name(id),
        Origin::Driver(_) | Origin::Initial(_) => "",
    }
}

/// Rods that hang together, and rods square to the guide of a slider.
fn lines(system: &System, rods: &[Rod], sliders: &[[&Block; 2]]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut told: Vec<usize> = Vec::new();
    for (k, (first, pins)) in rods.iter().enumerate() {
        if told.contains(first) {
            continue;
        }
        let mut bodies = hanging_on(&rods[k], &rods[k + 1..]);
        if bodies.len() > 1 {
            bodies.sort_unstable();
            let names: Vec<String> = bodies
                .iter()
                .map(|body| format!("\"{}\"", system.bodies[body - 1].name))
                .collect();
            if let Some((last, others)) = names.split_last() {
                lines.push(format!("{} and {last} are in line", others.join(", ")));
            }
            told.extend(bodies);
        } else if let Some([_, guide]) = sliders.iter().find(|[pin, _]| pins.contains(&pin.row())) {
            let rod = &system.bodies[first - 1].name;
            lines.push(format!(
                "\"{rod}\" stands square to the guide \"{}\"",
                joint_name(system, guide)
            ));
        }
    }
    lines
}

/// The body of a rod and those of the rods that hang on it, pin by pin.
fn hanging_on(first: &Rod, others: &[Rod]) -> Vec<usize> {
    let share = |a: &[usize; 2], b: &[usize; 2]| a.iter().any(|row| b.contains(row));
    let mut line: Vec<Rod> = vec![*first];
    while let Some(next) = others.iter().find(|rod| {
        !line.iter().any(|found| found.0 == rod.0)
            && line.iter().any(|found| share(&found.1, &rod.1))
    }) {
        line.push(*next);
    }
    line.into_iter().map(|(body, _)| body).collect()
}

/// The same, or else the joints that carry the self-stress.
pub fn singular_text(system: &System, rows: &[usize]) -> Option<String> {
    in_line(system, rows).or_else(|| {
        let mut joints: Vec<&str> = Vec::new();
        for &row in rows {
            if let Origin::Joint(id) = system.block_of_row(row).origin
                && !joints.contains(&system.joints[id.0].name.as_str())
            {
                joints.push(&system.joints[id.0].name);
            }
        }
        (!joints.is_empty()).then(|| {
            format!(
                "the constraints of {} lose rank",
                quoted(joints.into_iter())
            )
        })
    })
}
