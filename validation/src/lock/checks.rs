//! The paper's equations held against the columns of a run, instant by instant.
//!
//! ```text
//! (5, 6; 11, 12)  the two vector loops close                                    by l3a
//! (4; 10, j = 1)  M_d = Q of θ6                                                 by the largest moment there
//! (10)            the seven hinge forces = Q of r_a … r_g                       by the largest force there
//! (10, j = 2…8)   M_j = r_k⊥·f_k = 0, the moment a clearance link would need    by the largest moment there
//! (7)             Σ f + m (g − a) = 0,  Σ ρ × f + M_d − J θ̈ = 0 for every link  by the largest force, moment there
//! (8)             f·(v₂ − v₁ − ṙ) = 0 at every hinge: it does no work           by the largest force × speed there
//! ```
//!
//! ṙ = ψ̇ r⊥ with ψ̇ from the directions of r in this row and the one before, 0 at the first row and behind a gap.
//! "The largest moment there" is the larger of |M_d| and the largest hinge force times l3a, the longest side of a link: what
//! the terms of the sums are made of. Instants without a solution, and last passes of a fixed point that was not met, are
//! left out: the equations belong to a solution.

use super::document::broken;
use super::equations::{Accelerations, Lock, Offsets};
use super::instant::Instant;
use super::models::{Found, JOINTS, LINKS, Order, Stroke};
use crate::CaseError;
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::Model;

/// Largest violation that counts as met.
pub const TOLERANCE: f64 = 1e-9;

/// Largest violations over a run, relative.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Violations {
    /// Instants at which eqs 7 and 8 were tried.
    pub instants: usize,
    /// Instants at which the others were tried, too.
    pub by_work: usize,
    pub closure: f64,
    pub torque: f64,
    pub forces: f64,
    pub links: f64,
    /// The same, by the largest force there × the clearance [–]: the misalignment of link and force \[rad\].
    pub misalignment: f64,
    pub wrench: f64,
    pub reciprocity: f64,
}

impl Violations {
    /// The larger of both, figure by figure; instants are counted together.
    pub fn join(self, other: Violations) -> Violations {
        Violations {
            instants: self.instants + other.instants,
            by_work: self.by_work + other.by_work,
            closure: self.closure.max(other.closure),
            torque: self.torque.max(other.torque),
            forces: self.forces.max(other.forces),
            links: self.links.max(other.links),
            misalignment: self.misalignment.max(other.misalignment),
            wrench: self.wrench.max(other.wrench),
            reciprocity: self.reciprocity.max(other.reciprocity),
        }
    }

    /// The six figures with their equations and numbers of instants.
    pub fn named(&self) -> [(&'static str, f64, usize); 6] {
        let (work, all) = (self.by_work, self.instants);
        [
            ("vector loops close (eqs 5, 6, 11, 12)", self.closure, work),
            (
                "M_d by Lagrange's equation = M_d by the multipliers (eqs 4, 10)",
                self.torque,
                work,
            ),
            (
                "seven hinge forces by virtual work = by the multipliers (eq. 10)",
                self.forces,
                work,
            ),
            (
                "generalized forces of the seven clearance links vanish (eq. 10)",
                self.links,
                work,
            ),
            ("wrench balance of every link (eq. 7)", self.wrench, all),
            (
                "reciprocity of wrench and twist at every hinge (eq. 8)",
                self.reciprocity,
                all,
            ),
        ]
    }
}

/// Holds the equations against a run: all of them in the bundled hinge order, eqs 7 and 8 in the other.
///
/// # Errors
/// When the run lacks what the equations need.
pub fn check(stroke: &Stroke) -> Result<Violations, CaseError> {
    // The second writing of the loops is that of the bundled hinge order.
    let lock = match stroke.request.order {
        Order::SixOnThree => Some(Lock::new(&stroke.model)?),
        Order::FiveOnThree => None,
    };
    let mut worst = Violations::default();
    let longest = longest_side(&stroke.model)?;
    let mut before: Option<Instant> = None;
    for (row, found) in stroke.trajectory.rows().zip(&stroke.found) {
        let instant = Instant::read(&stroke.trajectory, row)?;
        let force = instant
            .forces
            .iter()
            .fold(0.0, |worst: f64, force| worst.max(force.norm()));
        let rates = instant.rates(before.as_ref());
        if *found == Found::Solution && instant.forces.iter().all(|force| force.norm().is_finite())
        {
            worst.instants += 1;
            let scale = Scale {
                force,
                moment: (force * longest).max(instant.torque.abs()),
                length: longest,
            };
            if let Some(lock) = &lock {
                worst.by_work += 1;
                lagrange(lock, &stroke.model, &instant, scale, &mut worst)?;
            }
            newton_euler(&stroke.model, &instant, &rates, scale, &mut worst)?;
        }
        before = (*found != Found::Nothing).then_some(instant);
    }
    Ok(worst)
}

/// Sizes that violations are measured by.
#[derive(Debug, Clone, Copy)]
struct Scale {
    force: f64,
    moment: f64,
    length: f64,
}

/// l3a \[m\].
fn longest_side(model: &Model) -> Result<f64, CaseError> {
    let corner = model
        .bodies
        .get("link3")
        .and_then(|body| body.points.get("f"));
    corner
        .map(|p| p[0].hypot(p[1]))
        .ok_or_else(|| broken("no point link3.f"))
}

/// Largest of the two; not a number counts as infinite, so that it can't hide.
fn raise(worst: &mut f64, value: f64) {
    *worst = worst.max(if value.is_nan() {
        f64::INFINITY
    } else {
        value.abs()
    });
}

fn com(model: &Model, link: usize) -> [f64; 2] {
    model
        .bodies
        .get(LINKS[link])
        .and_then(|body| body.com)
        .unwrap_or_default()
}

fn lagrange(
    lock: &Lock,
    model: &Model,
    instant: &Instant,
    scale: Scale,
    worst: &mut Violations,
) -> Result<(), CaseError> {
    let mut accelerations = Accelerations {
        centres: [Vec2::zeros(); 5],
        angles: [0.0; 5],
    };
    for (link, frame) in instant.frames.iter().enumerate() {
        accelerations.centres[link] = frame.acceleration_of(com(model, link));
        accelerations.angles[link] = frame.alpha;
    }
    let theta = instant.angles();
    raise(
        &mut worst.closure,
        lock.residual(&theta, &instant.offsets) / scale.length,
    );
    let generalized = lock.generalized(&theta, &accelerations)?;
    raise(
        &mut worst.torque,
        (generalized.torque - instant.torque) / scale.moment,
    );
    for (hinge, force) in instant.forces.iter().enumerate() {
        raise(
            &mut worst.forces,
            (generalized.forces[hinge] - force).norm() / scale.force,
        );
        let offset = instant.offsets[hinge];
        let moment = perp(offset).dot(&generalized.forces[hinge]);
        raise(&mut worst.links, moment / scale.moment);
        if offset.norm() > 0.0 {
            raise(
                &mut worst.misalignment,
                moment / (offset.norm() * scale.force),
            );
        }
    }
    Ok(())
}

fn newton_euler(
    model: &Model,
    instant: &Instant,
    rates: &Offsets,
    scale: Scale,
    worst: &mut Violations,
) -> Result<(), CaseError> {
    let gravity = Vec2::new(model.gravity[0], model.gravity[1]);
    let mut force = [Vec2::zeros(); 5];
    let mut moment = [0.0; 5];
    for (link, frame) in instant.frames.iter().enumerate() {
        let body = model.bodies.get(LINKS[link]);
        let (mass, inertia) = body
            .and_then(|body| body.mass.zip(body.inertia))
            .unwrap_or_default();
        force[link] = (gravity - frame.acceleration_of(com(model, link))) * mass;
        moment[link] = -inertia * frame.alpha;
    }
    // The driver turns link 6.
    moment[4] += instant.torque;
    let mut speed = 0.0_f64;
    let mut power = 0.0_f64;
    for ((joint, &on_second), rate) in JOINTS.iter().zip(&instant.forces).zip(rates) {
        let words = model
            .joints
            .get(*joint)
            .ok_or_else(|| broken(format!("no joint {joint}")))?;
        let ends = [
            instant.end(model, &words.between[0])?,
            instant.end(model, &words.between[1])?,
        ];
        for ((link, frame, place), pull) in ends.into_iter().zip([-on_second, on_second]) {
            if let Some(link) = link {
                let arm = frame.arm(place) - frame.arm(com(model, link));
                force[link] += pull;
                moment[link] += perp(arm).dot(&pull);
            }
        }
        let [first, second] = ends.map(|(_, frame, place)| frame.velocity_of(place));
        speed = speed.max(first.norm()).max(second.norm());
        power = power.max(on_second.dot(&(second - first - rate)).abs());
    }
    for link in 0..5 {
        raise(&mut worst.wrench, force[link].norm() / scale.force);
        raise(&mut worst.wrench, moment[link] / scale.moment);
    }
    if speed > 0.0 {
        raise(&mut worst.reciprocity, power / (scale.force * speed));
    }
    Ok(())
}
