//! The shared check of what elements say of the derivatives of their forces.

use super::actuator::Actuator;
use super::beam::tests::beam;
use super::belt::{Strands, tests::belt};
use super::bushing::tests::bushing;
use super::edge::tests::{disc, edge};
use super::edge::{Piece, Sector};
use super::formula::{Formula, Function, Strength};
use super::journal::Journal;
use super::load::{PointLoad, Torque};
use super::pair::{Compliant, Contact, Pair, Phase, Shape, Surface};
use super::quantity::{Measured, Quantity};
use super::spring::Spring;
use super::stop::{Travel, tests::stop};
use super::straight::tests::straight;
use super::tests::{Q0, V0, all_constraints, at_state, marker};
use super::torsion_spring::TorsionSpring;
use super::*;
use crate::contact::{friction, normal};
use crate::motion::Law;

/// Writes ∂Q/∂q and ∂Q/∂v of an element.
type Say<'a> = dyn Fn(&Kinematics, &mut [f64], &mut [f64]) + 'a;

/// ∂Q/∂q and ∂Q/∂v of an element (9 × 9 by rows), by what it says and by differences of its forces, with the largest entry.
fn hold(name: &str, slopes: &[Slope], say: &Say, apply: &dyn Fn(&Kinematics, &mut Applied)) {
    let layout = Layout::rigid(3);
    let values = [vec![0.0; slopes.len()], vec![0.0; slopes.len()]];
    let mut said = [[0.0; 81]; 2];
    let values = at_state(0.0, &Q0, &V0, |at| {
        let [mut position, mut velocity] = values.clone();
        say(at, &mut position, &mut velocity);
        [position, velocity]
    })
    .map(|found| found.to_vec());
    for (said, values) in said.iter_mut().zip(&values) {
        for ([row, column], value) in slopes.iter().zip(values) {
            if let (Some(row), Some(column)) = (
                layout.column(row.0, row.1),
                layout.column(column.0, column.1),
            ) {
                said[9 * row + column] += value;
            }
        }
    }
    let force = |q: &[f64], v: &[f64]| {
        at_state(0.0, q, v, |at| {
            let mut force = [0.0; 9];
            apply(at, &mut Applied::to(&mut force, &layout));
            force
        })
    };
    let h = 1e-6;
    let largest = said
        .iter()
        .flatten()
        .fold(1.0, |most: f64, value| most.max(value.abs()));
    for column in 0..9 {
        for (kind, said) in said.iter().enumerate() {
            let moved = |by: f64| {
                let (mut q, mut v) = (Q0, V0);
                [&mut q, &mut v][kind][column] += by;
                force(&q, &v)
            };
            let (low, high) = (moved(-h), moved(h));
            for row in 0..9 {
                let difference = (high[row] - low[row]) / (2.0 * h);
                let value = said[9 * row + column];
                assert!(
                    (difference - value).abs() < 1e-8 * largest,
                    "{name}, {}: row {row}, column {column}: {difference} {value}",
                    ["position", "velocity"][kind]
                );
            }
        }
    }
}

/// s₁ s₂ + 2 s₁ + s₂ |s₂|.
#[derive(Debug)]
struct Mixed;

impl Function for Mixed {
    fn value(&self, inputs: &[f64], _: Option<&[i32]>) -> f64 {
        inputs[0] * inputs[1] + 2.0 * inputs[0] + inputs[1] * inputs[1].abs()
    }

    fn slope(&self, inputs: &[f64], index: usize, _: Option<&[i32]>) -> f64 {
        [inputs[1] + 2.0, inputs[0] + 2.0 * inputs[1].abs()][index]
    }

    fn kinks(&self) -> usize {
        0
    }

    fn take_sides(&self, _: &[f64], _: &mut [i32]) {}

    fn beyond(&self, _: &[f64], _: &[i32], _: &[f64]) -> f64 {
        -1.0
    }
}

fn hold_force(name: &str, force: &dyn Force) {
    hold(
        name,
        &force.slopes(),
        &|at, position, velocity| force.slope(at, position, velocity),
        &|at, to| force.apply(at, to),
    );
}

#[test]
fn slopes_are_the_derivatives_of_formulas() {
    let (first, second) = (marker(1, 0.3, -0.2), marker(2, -0.4, 0.1));
    let along = |body: usize| Measured::Along {
        first: marker(0, 0.2, 0.1),
        second: marker(body, 0.3, -0.2),
        axis: Vec2::new(0.6, 0.8),
    };
    let slide = Measured::Along {
        first,
        second,
        axis: Vec2::new(0.6, 0.8),
    };
    let apart = Measured::Distance { first, second };
    let turn = Measured::Turn {
        first: BodyId(1),
        second: BodyId(3),
        from: 0.0,
    };
    let measured = [along(1), along(3), slide, apart, turn];
    let quantities = measured.map(|one| [Quantity::Value(one), Quantity::Rate(one)]);
    // the second of three adds to the first, as stretches of a cable do
    let formula = |arguments: &[Quantity]| {
        let inputs = [&[0, 1][..], &[0, 0, 1]][arguments.len() - 2].iter();
        Strength::OfMotion(Arc::new(Formula {
            function: Arc::new(Mixed),
            arguments: inputs.copied().zip(arguments.iter().copied()).collect(),
            first: 0,
            force: 0,
        }))
    };
    let mut forces: Vec<(&str, Box<dyn Force>)> = Vec::new();
    for pair in &quantities {
        let sum = [Quantity::Value(apart), pair[1], pair[0]];
        let vector = [formula(&sum), formula(&[Quantity::Time, pair[0]])];
        for follows_body in [false, true] {
            let load = PointLoad {
                at: second,
                vector: vector.clone(),
                follows_body,
            };
            forces.push(("load by a formula", Box::new(load)));
        }
        let torque = Torque {
            body: BodyId(2),
            relative_to: BodyId(1),
            value: formula(pair),
        };
        forces.push(("torque by a formula", Box::new(torque)));
        let actuator = Actuator {
            first,
            second,
            force: formula(pair),
        };
        forces.push(("actuator", Box::new(actuator)));
    }
    for (name, force) in forces {
        hold_force(name, &*force);
    }
}

fn constant(value: f64) -> Law {
    Law::Polynomial(vec![value])
}

#[test]
fn slopes_are_the_derivatives_of_forces() {
    let (first, second) = (marker(1, 0.3, -0.2), marker(2, -0.4, 0.1));
    let load = |follows_body: bool| PointLoad {
        at: first,
        vector: [constant(1.5), constant(-0.7)].map(Strength::OfTime),
        follows_body,
    };
    let spring = |first: Marker| Spring {
        first,
        second,
        stiffness: 12.0,
        damping: 1.7,
        free_length: constant(0.4),
    };
    let forces: Vec<(&str, Box<dyn Force>)> = vec![
        ("belt", Box::new(Strands(belt(false, Some([12.0, 1.7]))))),
        (
            "crossed belt",
            Box::new(Strands(belt(true, Some([12.0, 1.7])))),
        ),
        ("pretension", Box::new(Strands(belt(false, None)))),
        ("beam", Box::new(beam(1, 0.0))),
        ("damped beam on ground", Box::new(beam(0, 0.3))),
        ("bushing", Box::new(bushing(1))),
        ("bushing on ground", Box::new(bushing(0))),
        ("modes of a link", Box::new(super::modal::tests::modes())),
        ("spring", Box::new(spring(first))),
        ("spring to ground", Box::new(spring(marker(0, 1.0, 0.3)))),
        (
            "torsion spring",
            Box::new(TorsionSpring {
                first: BodyId(1),
                second: BodyId(2),
                stiffness: 3.0,
                damping: 0.4,
                free_angle: constant(0.1),
            }),
        ),
        ("load", Box::new(load(false))),
        ("load that follows", Box::new(load(true))),
        (
            "torque",
            Box::new(Torque {
                body: BodyId(2),
                relative_to: BodyId(1),
                value: Strength::OfTime(constant(0.5)),
            }),
        ),
    ];
    for (name, force) in forces {
        hold_force(name, &*force);
    }
}

#[test]
fn slopes_are_the_derivatives_of_contact_forces() {
    let normals = [
        normal::Law::Hertz {
            stiffness: 40.0,
            exponent: 1.5,
        },
        normal::Law::KelvinVoigt {
            stiffness: 30.0,
            damping: 2.0,
        },
        normal::Law::Dissipative {
            stiffness: 25.0,
            exponent: 1.5,
            hysteresis: 0.3,
        },
    ];
    let frictions = [
        (friction::Law::None, 0),
        (
            friction::Law::Coulomb {
                coefficient: 0.3,
                threshold: 0.1,
            },
            1,
        ),
        // On the ramp, far beyond its end.
        (
            friction::Law::Coulomb {
                coefficient: 0.3,
                threshold: 0.1,
            },
            0,
        ),
    ];
    for normal in normals {
        for (friction, piece) in frictions {
            let journal = Journal {
                bearing: marker(1, 0.3, -0.2),
                journal: marker(2, -0.4, 0.1),
                clearance: 0.2,
                bearing_radius: 0.5,
            };
            let surface = Surface::Compliant(Compliant { normal, friction });
            let axis = Vec2::new(0.6, 0.8);
            let shapes = [
                Shape::Journal(journal),
                Shape::Stop(stop(Travel::Turn)),
                Shape::Stop(stop(Travel::Along(axis))),
                Shape::Stop(stop(Travel::Apart)),
                Shape::Edge(edge(Piece::Straight(straight()))),
                Shape::Edge(edge(Piece::Round(disc(), Sector::between(0.0, 1.0)))),
            ];
            let memory = Contact {
                phase: Phase::Contact,
                approach: 2.0,
                piece,
                ..Contact::default()
            };
            for shape in shapes {
                let surface = surface.clone();
                let pair = Pair { shape, surface };
                hold(
                    &format!("{pair:?}"),
                    &pair.slopes(),
                    &|at, position, velocity| pair.slope(at, &memory, position, velocity),
                    &|at, to| pair.apply(at, &memory, to),
                );
            }
        }
    }
}

#[test]
fn bends_are_the_derivatives_of_what_multipliers_do() {
    for (name, constraint) in all_constraints() {
        let lambda: Vec<f64> = (0..constraint.rows().len())
            .map(|k| 1.5 - 0.7 * k as f64)
            .collect();
        let bends = constraint.curvature_pattern();
        // Each entry beside the diagonal stands for two.
        let mut slopes = bends.clone();
        slopes.extend(bends.iter().map(|[row, column]| [*column, *row]));
        hold(
            name,
            &slopes,
            &|at, position, _| {
                let (upper, lower) = position.split_at_mut(bends.len());
                constraint.bend(at, &lambda, upper);
                lower.copy_from_slice(upper);
                for (value, [row, column]) in lower.iter_mut().zip(&bends) {
                    if row == column {
                        *value = 0.0;
                    }
                }
            },
            &|at, to| {
                let entries = constraint.entries();
                let mut values = vec![0.0; entries.len()];
                constraint.jacobian(at, &mut values);
                for ((row, body, axis), value) in entries.into_iter().zip(values) {
                    let mut force = [0.0; 3];
                    force[axis as usize] = value * lambda[row];
                    to.add(body, Vec2::new(force[0], force[1]), force[2]);
                }
            },
        );
    }
}

/// What is said to be linear has the same derivatives elsewhere, whatever the other rows of its constraint do.
#[test]
fn linear_rows_have_constant_derivatives() {
    let mut linear = 0;
    for (name, constraint) in all_constraints() {
        let entries = constraint.entries();
        let values = |by: f64| {
            let q: Vec<f64> = Q0
                .iter()
                .enumerate()
                .map(|(k, q)| q + by * (1.0 + k as f64))
                .collect();
            at_state(0.0, &q, &V0, |at| {
                let mut values = vec![0.0; entries.len()];
                constraint.jacobian(at, &mut values);
                values
            })
        };
        let (here, there) = (values(0.0), values(0.03));
        for row in 0..constraint.rows().len() {
            if constraint.is_linear(row) {
                linear += 1;
                for (entry, (a, b)) in entries.iter().zip(here.iter().zip(&there)) {
                    assert!(entry.0 != row || a == b, "{name}, row {row}: {a} {b}");
                }
            }
        }
    }
    assert!(linear > 3, "{linear}");
}
