//! Outputs: how fast one quantity changes by another, where the mechanism has one degree of freedom, or by one of its drivers while
//! the others stand still.
//!
//! ```text
//! J_j t = 0                joint rows alone, beside several drivers those of the others; one t but for its length
//! dA/dB = (∂A/∂q t)/(∂B/∂q t)
//! ```
//!
//! Bodies i and j turn about each other at P, where their velocities are the same:
//!
//! ```text
//! w + ω k × P = 0          ω = ωᵢ − ωⱼ,  w = vᵢ − ωᵢ k × cᵢ − (vⱼ − ωⱼ k × cⱼ)
//! P = k × w/ω              v, c velocity and place of the centres of mass along t
//! ```
//!
//! t is the tangent of the curve on which the mechanism moves, so that the ratio does not depend on how fast it moves there, and
//! exists where a driver stands still or can't drive. Where B does not change along t, as at a dead point of it, there is no ratio:
//! the cell is empty. So it is where the joints leave more than one motion, as at a change point. Against closed forms and
//! finite differences in `tests/fast/outputs`.

use super::assembly::tangent;
use super::rows::{Columns, Replay};
use crate::element::Kinematics;
use crate::element::quantity::{Measured, Quantity};
use crate::element::span::BOTH;
use crate::element::{Axis, BodyId};
use crate::system::{DriverId, OutputKind, System};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_output::{Channel, Column};

/// Part of the largest motion of the mechanism below which a quantity does not change: round-off of the tangent.
const NO_MOTION: f64 = 1e-9;

/// The columns of all outputs.
pub(super) fn headings(system: &System) -> Vec<Column> {
    let outputs = system.outputs.iter().enumerate();
    let heading = |(k, output): (usize, &crate::system::OutputRatio)| {
        Column::of(Channel::Output(k), &output.name, output.unit)
    };
    outputs.map(heading).collect()
}

/// A sum of quantities, each with where the coordinates stand that change it.
struct SumPart {
    terms: Vec<(Quantity, Vec<Option<usize>>)>,
    /// By what it is measured \[m or rad\].
    scale: f64,
}

/// What an output is computed from.
enum OutputParts {
    Ratio([SumPart; 2]),
    Centre { bodies: [BodyId; 2], axis: Axis },
}

impl OutputParts {
    fn new(system: &System, kind: &OutputKind) -> Self {
        match kind {
            OutputKind::Ratio(sums) => {
                OutputParts::Ratio(sums.each_ref().map(|sum| SumPart::new(system, sum)))
            }
            OutputKind::Centre { bodies, axis } => OutputParts::Centre {
                bodies: *bodies,
                axis: *axis,
            },
        }
    }

    /// Its value along a motion; `None` where what it divides by stands still.
    fn along(&self, system: &System, at: &Kinematics, tangent: &[f64]) -> Option<f64> {
        match self {
            OutputParts::Ratio(parts) => {
                let [above, below] = parts.each_ref().map(|part| part.along(at, tangent));
                (below.abs() > NO_MOTION * parts[1].scale).then(|| above / below)
            }
            OutputParts::Centre { bodies, axis } => {
                let velocity = |body: BodyId, axis| {
                    let column = system.layout.column(body, axis);
                    column.map_or(0.0, |column| tangent[column])
                };
                let [(first, w), (second, v)] = bodies.map(|body| {
                    let omega = velocity(body, Axis::Theta);
                    let center = Vec2::new(velocity(body, Axis::X), velocity(body, Axis::Y));
                    (omega, center - perp(at.poses[body.0].r) * omega)
                });
                let omega = first - second;
                let place = perp(w - v) / omega;
                let coordinate = match axis {
                    Axis::X => place.x,
                    Axis::Y | Axis::Theta => place.y,
                };
                (omega.abs() > NO_MOTION).then_some(coordinate)
            }
        }
    }
}

/// One output, and in how many rows it is empty.
struct Ratio {
    output: usize,
    /// The driver that moves alone, where there are others.
    by: Option<DriverId>,
    parts: OutputParts,
    still: usize,
    free: usize,
}

/// Outputs beside the rows of a run.
pub(super) struct Ratios<'s> {
    ratios: Vec<Ratio>,
    replay: Replay<'s>,
    rows: usize,
}

impl SumPart {
    fn new(system: &System, sum: &[Measured]) -> Self {
        let term = |measured: &Measured| {
            let quantity = Quantity::Value(*measured);
            let columns = quantity.columns().into_iter();
            let columns = columns.map(|(body, axis)| system.layout.column(body, axis));
            (quantity, columns.collect())
        };
        let turns = |one: &Measured| matches!(one, Measured::Turn { .. });
        SumPart {
            terms: sum.iter().map(term).collect(),
            scale: if sum.iter().all(turns) {
                1.0
            } else {
                system.size
            },
        }
    }

    /// Its change along a motion.
    fn along(&self, at: &Kinematics, tangent: &[f64]) -> f64 {
        let change = |(quantity, columns): &(Quantity, Vec<Option<usize>>)| -> f64 {
            let (mut position, mut velocity) = ([0.0; BOTH], [0.0; BOTH]);
            quantity.slopes(at, &mut position, &mut velocity);
            let terms = position.iter().zip(columns);
            terms
                .filter_map(|(slope, column)| Some(slope * tangent[(*column)?]))
                .sum()
        };
        self.terms.iter().map(change).sum()
    }
}

impl<'s> Ratios<'s> {
    /// These columns beside rows; `None` if the rows lack a pose.
    pub fn new(system: &'s System, columns: &Columns, wanted: &[Column]) -> Option<Self> {
        let ratio = |column: &Column| match column.channel {
            Some(Channel::Output(output)) => Some(Ratio {
                output,
                by: system.outputs[output]
                    .by
                    .filter(|_| system.drivers.len() > 1),
                parts: OutputParts::new(system, &system.outputs[output].kind),
                still: 0,
                free: 0,
            }),
            _ => None,
        };
        Some(Ratios {
            ratios: wanted.iter().map(ratio).collect::<Option<_>>()?,
            replay: Replay::new(system, columns)?,
            rows: 0,
        })
    }

    /// Appends the columns of a row, NaN where there is no ratio.
    pub fn push(&mut self, row: &[f64], line: &mut Vec<f64>) {
        self.replay.take(row);
        if !self.replay.is_there() {
            line.extend(self.ratios.iter().map(|_| f64::NAN));
            return;
        }
        self.rows += 1;
        let system = self.replay.system;
        let mut tangents: Vec<(_, Option<Vec<f64>>)> = Vec::new();
        for by in self.ratios.iter().map(|ratio| ratio.by) {
            if tangents.iter().all(|(known, _)| *known != by) {
                tangents.push((by, tangent(system, self.replay.jacobian(), by).ok()));
            }
        }
        let at = self.replay.kinematics();
        for ratio in &mut self.ratios {
            let tangent = tangents.iter().find(|(by, _)| *by == ratio.by);
            let Some((_, Some(tangent))) = tangent else {
                ratio.free += 1;
                line.push(f64::NAN);
                continue;
            };
            let value = ratio.parts.along(system, &at, tangent);
            ratio.still += usize::from(value.is_none());
            line.push(value.unwrap_or(f64::NAN));
        }
    }

    /// What there is to say about empty cells of the rows so far.
    pub fn notes(&self) -> Vec<String> {
        let system = self.replay.system;
        let rows = |empty: usize| match empty {
            empty if empty == self.rows => "in all rows".to_owned(),
            1 => format!("in 1 of {} rows", self.rows),
            empty => format!("in {empty} of {} rows", self.rows),
        };
        let of = |ratio: &Ratio| {
            let name = &system.outputs[ratio.output].name;
            let still = (ratio.still > 0).then(|| {
                let why = match ratio.parts {
                    OutputParts::Ratio(_) => "what it divides by does not change there",
                    OutputParts::Centre { .. } => "its bodies do not turn against each other there",
                };
                format!("output.{name} is empty {}: {why}", rows(ratio.still))
            });
            let free = (ratio.free > 0).then(|| {
                format!(
                    "output.{name} is empty {}: the joints do not leave one motion alone there",
                    rows(ratio.free)
                )
            });
            [still, free]
        };
        self.ratios.iter().flat_map(of).flatten().collect()
    }
}
