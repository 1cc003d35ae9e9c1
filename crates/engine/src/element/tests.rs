//! The shared check of every element: its derivatives against finite differences, its reaction against virtual work.

use super::coordinate::Coordinate;
use super::driven::{DriveId, Rotation, Translation};
use super::fixed::Fixed;
use super::following::Following;
use super::formula::Strength;
use super::gear::Gear;
use super::load::{PointLoad, Torque};
use super::pair::{Contact, ContactId};
use super::prismatic::{Guide, Prismatic};
use super::revolute::{OffsetId, Revolute};
use super::slot::Slot;
use super::spring::Spring;
use super::torsion_spring::TorsionSpring;
use super::*;
use crate::motion::Law;
use nalgebra::SimdValue;

pub(super) fn marker(body: usize, x: f64, y: f64) -> Marker {
    Marker {
        body: BodyId(body),
        s: Vec2::new(x, y),
    }
}

fn guide() -> Guide {
    Guide {
        first: marker(1, 0.3, -0.2),
        second: marker(2, -0.4, 0.1),
        axis: Vec2::new(0.6, 0.8),
    }
}

fn gear(carrier: usize, ratio: f64) -> Gear {
    Gear {
        first: marker(1, 0.3, -0.2),
        second: marker(2, -0.4, 0.1),
        carrier: BodyId(carrier),
        axis: Vec2::new(-0.8, 0.6),
        distance: 0.7,
        ratio,
        angle: 0.3,
    }
}

/// A constraint with the name that a failed check says.
pub(super) type Named = (&'static str, Box<dyn Constraint>);

/// One of each kind. A new constraint is added below.
pub(crate) fn all_constraints() -> Vec<Named> {
    let own = [joints(), drivers_and_initial_values()];
    let rolling = [
        super::rack::tests::both(),
        super::belt::tests::both(),
        super::rolling::tests::both(),
    ];
    let pieces = [super::edge::tests::held(), super::cam::tests::all()];
    let all = own.into_iter().chain(pieces).flatten();
    let more = rolling.into_iter().chain([super::distance::tests::both()]);
    let all = all.chain(more.flatten());
    all.chain(super::station::tests::all()).collect()
}

fn joints() -> Vec<Named> {
    let (first, second) = (marker(1, 0.3, -0.2), marker(2, -0.4, 0.1));
    let following = Following {
        bearing: first,
        journal: second,
        clearance: 0.4,
    };
    let weld = Fixed {
        first,
        second,
        angle: -0.3,
    };
    vec![
        (
            "revolute",
            Box::new(Revolute {
                first,
                second,
                offset: None,
            }),
        ),
        (
            "revolute with offset",
            Box::new(Revolute {
                first,
                second,
                offset: Some(OffsetId(0)),
            }),
        ),
        (
            "revolute on ground",
            Box::new(Revolute {
                first: marker(0, 1.0, 2.0),
                second,
                offset: None,
            }),
        ),
        (
            "prismatic",
            Box::new(Prismatic {
                guide: guide(),
                angle: 0.2,
            }),
        ),
        ("slot", Box::new(Slot { guide: guide() })),
        ("following", Box::new(following)),
        ("sticking", Box::new(following.stuck(1.3, ContactId(0)))),
        ("gear", Box::new(gear(3, -1.7))),
        ("internal gear on ground", Box::new(gear(0, 2.5))),
        ("fixed", Box::new(weld)),
    ]
}

fn drivers_and_initial_values() -> Vec<Named> {
    let origin = marker(2, -0.4, 0.1);
    vec![
        (
            "rotation",
            Box::new(Rotation {
                body: BodyId(2),
                relative_to: BodyId(1),
                drive: DriveId(0),
            }),
        ),
        (
            "translation",
            Box::new(Translation {
                guide: guide(),
                drive: DriveId(0),
            }),
        ),
        (
            "coordinate x",
            Box::new(Coordinate {
                origin,
                axis: Axis::X,
                value: 0.4,
                drive: None,
            }),
        ),
        (
            "coordinate y",
            Box::new(Coordinate {
                origin,
                axis: Axis::Y,
                value: 0.4,
                drive: None,
            }),
        ),
        (
            "coordinate angle",
            Box::new(Coordinate {
                origin,
                axis: Axis::Theta,
                value: 0.4,
                drive: Some(DriveId(0)),
            }),
        ),
    ]
}

pub(super) const Q0: [f64; 9] = [0.1, -0.3, 0.7, 1.2, 0.4, -1.1, -0.6, 0.2, 0.5];
pub(super) const V0: [f64; 9] = [0.5, 1.1, -0.8, -0.6, 0.9, 1.7, 0.3, -1.2, 1.3];
const A0: [f64; 9] = [-0.2, 0.3, 0.9, 1.4, -0.5, -1.2, 0.8, 0.1, -0.7];

/// Calls `f` with the instant t along q(t) = q₀ + v₀ t + a₀ t²/2 and matching inputs.
fn along<T>(t: f64, f: impl Fn(&Kinematics) -> T) -> T {
    let q: Vec<f64> = (0..9)
        .map(|i| Q0[i] + V0[i] * t + 0.5 * A0[i] * t * t)
        .collect();
    let v: Vec<f64> = (0..9).map(|i| V0[i] + A0[i] * t).collect();
    at_state(t, &q, &v, f)
}

pub(super) fn at_state<T>(t: f64, q: &[f64], v: &[f64], f: impl Fn(&Kinematics) -> T) -> T {
    let pose = |k: usize| Pose::new(q[k], q[k + 1], q[k + 2]);
    let poses = [Pose::GROUND, pose(0), pose(3), pose(6)];
    let twist = |k: usize| Twist {
        v: Vec2::new(v[k], v[k + 1]),
        omega: v[k + 2],
    };
    let twists = [Twist::default(), twist(0), twist(3), twist(6)];
    let drive = [Law::Polynomial(vec![0.2, -0.5, 0.8, 0.3]).jet(t)];
    let (ex, ey) = (
        Law::Polynomial(vec![0.01, 0.2, -0.3]).jet(t),
        Law::Polynomial(vec![-0.02, 0.1, 0.5]).jet(t),
    );
    let offset = [[0, 1, 2].map(|order| Vec2::new(ex[order], ey[order]))];
    f(&Kinematics {
        poses: &poses,
        twists: &twists,
        drive: &drive,
        offset: &offset,
        states: &[],
        sides: &[],
        contacts: &[Contact::default()],
        time: t,
    })
}

fn phi(c: &dyn Constraint, at: &Kinematics) -> Vec<f64> {
    let mut phi = vec![0.0; c.rows().len()];
    c.position(at, &mut phi);
    phi
}

/// J x by the element's entries.
fn product(c: &dyn Constraint, at: &Kinematics, x: &[f64]) -> Vec<f64> {
    let entries = c.entries();
    let mut values = vec![0.0; entries.len()];
    c.jacobian(at, &mut values);
    let mut out = vec![0.0; c.rows().len()];
    for (&(row, body, axis), value) in entries.iter().zip(&values) {
        if let Some(column) = Layout::rigid(3).column(body, axis) {
            out[row] += value * x[column];
        }
    }
    out
}

#[test]
fn jacobian_is_the_derivative_of_phi() {
    let h = 1e-6;
    for (name, c) in all_constraints() {
        for column in 0..9 {
            let shifted = |by: f64| {
                let mut q = Q0;
                q[column] += by;
                at_state(0.0, &q, &V0, |at| phi(c.as_ref(), at))
            };
            let (lo, hi) = (shifted(-h), shifted(h));
            let mut unit = [0.0; 9];
            unit[column] = 1.0;
            let exact = along(0.0, |at| product(c.as_ref(), at, &unit));
            for row in 0..exact.len() {
                let difference = (hi[row] - lo[row]) / (2.0 * h);
                assert!(
                    (difference - exact[row]).abs() < 1e-8,
                    "{name}: row {row}, column {column}: {difference} {exact:?}"
                );
            }
        }
    }
}

#[test]
fn rate_and_gamma_are_the_time_derivatives_of_phi() {
    let h = 1e-4;
    for (name, c) in all_constraints() {
        let (lo, mid, hi) = (
            along(-h, |at| phi(c.as_ref(), at)),
            along(0.0, |at| phi(c.as_ref(), at)),
            along(h, |at| phi(c.as_ref(), at)),
        );
        let (velocity, acceleration) = along(0.0, |at| {
            let (mut rate, mut gamma) = (vec![0.0; mid.len()], vec![0.0; mid.len()]);
            c.rate(at, &mut rate);
            c.gamma(at, &mut gamma);
            let (jv, ja) = (product(c.as_ref(), at, &V0), product(c.as_ref(), at, &A0));
            let velocity: Vec<f64> = jv.iter().zip(&rate).map(|(a, b)| a + b).collect();
            let acceleration: Vec<f64> = ja.iter().zip(&gamma).map(|(a, b)| a - b).collect();
            (velocity, acceleration)
        });
        for row in 0..mid.len() {
            let first = (hi[row] - lo[row]) / (2.0 * h);
            let second = (hi[row] - 2.0 * mid[row] + lo[row]) / (h * h);
            assert!(
                (first - velocity[row]).abs() < 1e-6,
                "{name}: φ̇ {first} {velocity:?}"
            );
            assert!(
                (second - acceleration[row]).abs() < 1e-5,
                "{name}: φ̈ {second} {acceleration:?}"
            );
        }
    }
}

#[test]
fn entries_that_are_called_constant_are() {
    let values = |c: &dyn Constraint, t: f64| {
        along(t, |at| {
            let mut values = vec![0.0; c.entries().len()];
            c.jacobian(at, &mut values);
            values
        })
    };
    let mut constant = 0;
    for (name, c) in all_constraints() {
        let first = values(c.as_ref(), 0.0);
        for t in [0.3, 1.1, 2.7] {
            let now = values(c.as_ref(), t);
            for entry in (0..first.len()).filter(|entry| c.is_constant(*entry)) {
                assert_eq!(first[entry], now[entry], "{name}: entry {entry}");
                constant += 1;
            }
        }
    }
    assert!(constant > 50, "{constant}");
}

#[test]
fn several_side_by_side_are_as_one_by_one() {
    let times = [0.0, 0.4, 0.9, 1.7];
    let mut seen = 0;
    for (name, c) in all_constraints() {
        let Some(abreast) = c.abreast(&mut Lanes::splat) else {
            continue;
        };
        let again = c.renumbered(&mut |own| own).expect("numbers of its own");
        seen += 1;
        let (rows, entries) = (c.rows().len(), c.entries().len());
        let (mut poses, mut twists) = (vec![], vec![]);
        let (mut drive, mut offset) = (vec![[Lanes::ZERO; 3]], vec![[Vector::zeros(); 3]]);
        for (lane, time) in times.into_iter().enumerate() {
            let (own, own_twists, jet, gap) = along(time, |at| {
                (
                    at.poses.to_vec(),
                    at.twists.to_vec(),
                    at.drive[0],
                    at.offset[0],
                )
            });
            poses.push(own);
            twists.push(own_twists);
            for order in 0..3 {
                drive[0][order].replace(lane, jet[order]);
                let gap: Vec2 = gap[order];
                let to: &mut Vector<Lanes> = &mut offset[0][order];
                to.x.replace(lane, gap.x);
                to.y.replace(lane, gap.y);
            }
        }
        let all = |of: &dyn Fn(usize) -> f64| Lanes::from_arr(std::array::from_fn(of));
        let bodies = 0..poses[0].len();
        let wide_poses: Vec<Pose<Lanes>> = { bodies.clone() }
            .map(|body| Pose {
                r: Vector::new(all(&|k| poses[k][body].r.x), all(&|k| poses[k][body].r.y)),
                theta: all(&|k| poses[k][body].theta),
                cos: all(&|k| poses[k][body].cos),
                sin: all(&|k| poses[k][body].sin),
            })
            .collect();
        let wide_twists: Vec<Twist<Lanes>> = bodies
            .map(|body| Twist {
                v: Vector::new(all(&|k| twists[k][body].v.x), all(&|k| twists[k][body].v.y)),
                omega: all(&|k| twists[k][body].omega),
            })
            .collect();
        let wide = Kinematics {
            poses: &wide_poses,
            twists: &wide_twists,
            drive: &drive,
            offset: &offset,
            sides: &[],
            states: &[],
            contacts: &[],
            time: 0.0,
        };
        let zero = |count: usize| vec![Lanes::ZERO; count];
        let mut found = [zero(rows), zero(entries), zero(rows), zero(rows)];
        abreast.position(&wide, &mut found[0]);
        abreast.jacobian(&wide, &mut found[1]);
        abreast.rate(&wide, &mut found[2]);
        abreast.gamma(&wide, &mut found[3]);
        for (lane, time) in times.into_iter().enumerate() {
            let alone = along(time, |at| {
                let mut alone = [rows, entries, rows, rows].map(|count| vec![0.0; count]);
                again.position(at, &mut alone[0]);
                again.jacobian(at, &mut alone[1]);
                again.rate(at, &mut alone[2]);
                again.gamma(at, &mut alone[3]);
                alone
            });
            for (found, alone) in found.iter().zip(alone) {
                for (found, alone) in found.iter().zip(alone) {
                    let off = (found.extract(lane) - alone).abs();
                    assert!(off <= 1e-14 * alone.abs().max(1.0), "{name}: {off:e}");
                }
            }
        }
    }
    assert!(seen >= 15, "{seen}");
}

#[test]
fn reaction_does_the_work_of_the_multipliers() {
    // Moving only the second body, −λᵀ J v is the power of the reaction on it; sections are held at their origin.
    let mut second_moves = [0.0; 9];
    second_moves[3..6].copy_from_slice(&V0[3..6]);
    for (name, c) in all_constraints()
        .into_iter()
        .filter(|(name, _)| !name.starts_with("coordinate") && !name.starts_with("section"))
    {
        let lambda: Vec<f64> = (0..c.rows().len()).map(|k| 1.5 - 0.7 * k as f64).collect();
        let (by_lambda, by_reaction) = at_state(0.0, &Q0, &second_moves, |at| {
            let power: f64 = product(c.as_ref(), at, &second_moves)
                .iter()
                .zip(&lambda)
                .map(|(a, b)| -a * b)
                .sum();
            let (force, torque) = c.reaction(at, &lambda);
            (
                power,
                force.dot(&marker(2, -0.4, 0.1).velocity(at)) + torque * at.twists[2].omega,
            )
        });
        assert!(
            (by_lambda - by_reaction).abs() < 1e-12,
            "{name}: {by_lambda} {by_reaction}"
        );
    }
}

#[test]
fn conservative_forces_are_minus_the_gradient_of_their_potential() {
    let constant = |value: f64| Law::Polynomial(vec![value]);
    let forces: Vec<(&str, Box<dyn Force>)> = vec![
        (
            "spring",
            Box::new(Spring {
                first: marker(1, 0.3, -0.2),
                second: marker(2, -0.4, 0.1),
                stiffness: 12.0,
                damping: 0.0,
                free_length: constant(0.4),
            }),
        ),
        (
            "torsion spring",
            Box::new(TorsionSpring {
                first: BodyId(1),
                second: BodyId(2),
                stiffness: 3.0,
                damping: 0.0,
                free_angle: constant(0.1),
            }),
        ),
    ];
    let h = 1e-6;
    for (name, force) in forces {
        let mut q_force = [0.0; 9];
        at_state(0.0, &Q0, &V0, |at| {
            let mut q = [0.0; 9];
            force.apply(at, &mut Applied::to(&mut q, &Layout::rigid(3)));
            q
        })
        .iter()
        .zip(&mut q_force)
        .for_each(|(a, b)| *b = *a);
        for k in 0..9 {
            let energy = |by: f64| {
                let mut q = Q0;
                q[k] += by;
                at_state(0.0, &q, &V0, |at| force.potential(at))
            };
            let slope = (energy(h) - energy(-h)) / (2.0 * h);
            assert!(
                (slope + q_force[k]).abs() < 1e-7,
                "{name}: coordinate {k}: {slope} {}",
                q_force[k]
            );
        }
    }
}

#[test]
fn dampers_take_power_and_loads_act_where_they_say() {
    let constant = |value: f64| Law::Polynomial(vec![value]);
    let spring = Spring {
        first: marker(1, 0.3, -0.2),
        second: marker(2, -0.4, 0.1),
        stiffness: 0.0,
        damping: 2.0,
        free_length: constant(0.0),
    };
    at_state(0.0, &Q0, &V0, |at| {
        let mut q = [0.0; 9];
        spring.apply(at, &mut Applied::to(&mut q, &Layout::rigid(3)));
        let d = spring.second.place(at) - spring.first.place(at);
        let rate = d.dot(&(spring.second.velocity(at) - spring.first.velocity(at))) / d.norm();
        let power: f64 = q.iter().zip(&V0).map(|(a, b)| a * b).sum();
        assert!((power + 2.0 * rate * rate).abs() < 1e-12);
    });
    // A unit force along the body's x axis at (0.3, −0.2): moment +0.2 whatever the pose.
    let load = PointLoad {
        at: marker(1, 0.3, -0.2),
        vector: [constant(1.0), constant(0.0)].map(Strength::OfTime),
        follows_body: true,
    };
    let torque = Torque {
        body: BodyId(2),
        relative_to: BodyId(1),
        value: Strength::OfTime(constant(0.5)),
    };
    at_state(0.0, &Q0, &V0, |at| {
        let mut q = [0.0; 9];
        load.apply(at, &mut Applied::to(&mut q, &Layout::rigid(3)));
        assert!(
            (q[2] - 0.2).abs() < 1e-15 && (q[0] - Q0[2].cos()).abs() < 1e-15,
            "{q:?}"
        );
        torque.apply(at, &mut Applied::to(&mut q, &Layout::rigid(3)));
        assert!(
            (q[2] + 0.3).abs() < 1e-15 && (q[5] - 0.5).abs() < 1e-15,
            "{q:?}"
        );
    });
}
