//! Joints and locks that close and open at an event.
//!
//! ```text
//! w = J v + φ_t                     the rate of the joint's rows before                 (r ≤ 3)  [m/s, rad/s]
//! Δv = −S (SᵀMS)⁻¹ Sᵀ Jᵀ p,   W p = w,   W = J S (SᵀMS)⁻¹ Sᵀ Jᵀ
//! ΔE = ½ pᵀ w = ½ wᵀ W⁻¹ w          energy lost: ½ m v² of the reduced mass W⁻¹           [J]
//! ```
//!
//! Rows that the mechanism meets already take no impulse: W is solved by its eigenvectors, in lengths of the mechanism, and those
//! without mobility are left out. Surfaces that touch take part without rebound, p ≥ 0: after the projection onto J v = 0 the
//! velocities are projected onto δ̇ ≤ 0 within it, which is the projection onto both (Moreau 1988), for the metric is that of the
//! kinetic energy in both.
//!
//! Opening takes nothing: forces that were carried are carried no more.

use super::{Impulses, at_rest};
use crate::analysis::dynamics::fault::Fault;
use crate::analysis::dynamics::flow::Flow;
use crate::analysis::dynamics::state::Sums;
use crate::element::clasp::sizes;
use crate::element::pair::Contact;
use crate::element::{Constraint, Measure};
use crate::mechanism::driven::Failure;
use linkdyn_linear::math::dot;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// Gap of a joint that closes, in parts of the mechanism or radians: what figures of six digits leave.
const APART: f64 = 1e-6;
/// Mobility, in parts of the largest and of one by the mechanism's mass, that is none.
const NONE: f64 = 1e-11;
/// Rate that is left where nothing can take it, in parts of the mechanism's velocity.
const LEFT: f64 = 1e-8;

/// Steps that take a gap away: the last leaves the square of what the first did.
const JOINED: usize = 2;

/// The rows of a joint that closes, and what impulses along them do.
struct ClosingRows {
    constraint: Arc<dyn Constraint>,
    /// Jᵀ by row (n).
    forces: Vec<Vec<f64>>,
    /// S (SᵀMS)⁻¹ Sᵀ Jᵀ by row, in the independent rates and in all velocities.
    rates: Vec<Vec<f64>>,
    changes: Vec<Vec<f64>>,
    /// w, and the length by which a row is measured, 1 or that of the mechanism.
    before: Vec<f64>,
    arms: Vec<f64>,
}

impl ClosingRows {
    /// Of a contact at the last evaluation.
    fn new(flow: &mut Flow, contact: usize) -> Self {
        let system = flow.system();
        let constraint = system.contact_rows[contact].sustained.clone();
        let at = flow.equations.kinematics();
        let (entries, measures) = (constraint.entries(), constraint.rows());
        let mut values = vec![0.0; entries.len()];
        constraint.jacobian(&at, &mut values);
        let mut before = vec![0.0; measures.len()];
        constraint.rate(&at, &mut before);
        let mut forces = vec![vec![0.0; system.n()]; measures.len()];
        for (&(row, body, axis), value) in entries.iter().zip(&values) {
            if let Some(column) = system.layout.column(body, axis) {
                forces[row][column] += value;
                before[row] += value * flow.equations.velocity()[column];
            }
        }
        let (n, f) = (system.n(), flow.equations.freedom());
        let answers = forces.iter().map(|force| {
            let (mut rates, mut change) = (vec![0.0; f], vec![0.0; n]);
            flow.equations
                .impulsive_change(force, &mut rates, &mut change);
            (rates, change)
        });
        let (rates, changes) = answers.unzip();
        let arm = |measure: &Measure| match measure {
            Measure::Length => 1.0,
            Measure::Angle => system.size,
        };
        ClosingRows {
            arms: measures.iter().map(arm).collect(),
            forces,
            rates,
            changes,
            before,
            constraint,
        }
    }

    /// W in metres.
    fn mobility(&self) -> DMatrix<f64> {
        let count = self.forces.len();
        DMatrix::from_fn(count, count, |i, j| {
            self.arms[i] * self.arms[j] * dot(&self.forces[i], &self.changes[j])
        })
    }

    /// p that takes away w, and the most that is left of it, in metres; `least` is a mobility that is none.
    fn impulses(&self, wanted: &[f64], least: f64) -> (Vec<f64>, f64) {
        let count = self.forces.len();
        let wanted = wanted.iter().zip(&self.arms);
        let wanted = DVector::from_iterator(count, wanted.map(|(rate, arm)| rate * arm));
        let mobility = self.mobility();
        let directions = mobility.clone().symmetric_eigen();
        let least = least.max(NONE * directions.eigenvalues.amax());
        let mut found = DVector::zeros(count);
        for (value, direction) in directions
            .eigenvalues
            .iter()
            .zip(directions.eigenvectors.column_iter())
        {
            if *value > least {
                found += direction * (direction.dot(&wanted) / value);
            }
        }
        let left = (&wanted - &mobility * &found).amax();
        let pushes = found.iter().zip(&self.arms).map(|(push, arm)| push * arm);
        (pushes.collect(), left)
    }

    /// −Σ p parts.
    fn sum(parts: &[Vec<f64>], pushes: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; parts.first().map_or(0, Vec::len)];
        for (part, push) in parts.iter().zip(pushes) {
            let pairs = sum.iter_mut().zip(part);
            pairs.for_each(|(sum, part)| *sum -= push * part);
        }
        sum
    }

    /// The speed at which the joint closes, of a lock by its row.
    fn speed(&self) -> f64 {
        let [speed, turn] = sizes(self.constraint.rows(), &self.before);
        if speed > 0.0 { speed } else { turn }
    }
}

impl Impulses<'_, '_> {
    /// Closes what is open: a joint, or a lock.
    ///
    /// # Errors
    /// Where the joint's ends do not meet, where something drives them apart, and where the mechanism can't be solved.
    pub fn close(&mut self, contact: usize) -> Result<(), Fault> {
        self.begin_to_hold(contact, true)
    }

    /// The same; what holds from the start on is no event.
    fn begin_to_hold(&mut self, contact: usize, is_event: bool) -> Result<(), Fault> {
        let flow = &*self.at.flow;
        let system = flow.system();
        if let Some(clasp) = system.contacts[contact].clasp() {
            let gap = clasp.apart(&flow.equations.kinematics());
            // NaN is apart, too.
            if !(gap[0] <= APART * system.size && gap[1] <= APART) {
                return Err(Fault::Apart { contact, gap });
            }
        }
        let were = self.at.release_all()?;
        let scale = &system.scale;
        let least = NONE / scale.mass;
        if system.contacts[contact].clasp().is_some() {
            self.join(contact, least)?;
        }
        let rows = ClosingRows::new(self.at.flow, contact);
        let (pushes, left) = rows.impulses(&rows.before, least);
        if left > LEFT * scale.velocity() {
            return Err(Fault::Driven { contact, left });
        }
        let mut reading = self.at.flow.reading(contact);
        (reading.rate, reading.penetration) = (rows.speed(), 0.0);
        let entry = self.at.entry(contact, &reading);
        self.at.ledger.history(contact).begin(&entry);
        let half: f64 = pushes
            .iter()
            .zip(&rows.before)
            .map(|(p, w)| 0.5 * p * w)
            .sum();
        let [push, turn] = sizes(rows.constraint.rows(), &pushes);
        let sums = Sums {
            dissipated: half,
            impulse: if push > 0.0 { push } else { turn },
            sliding: 0.0,
        };
        let changed = ClosingRows::sum(&rows.rates, &pushes);
        let rates = self.at.state.rates_mut().iter_mut().zip(&changed);
        rates.for_each(|(rate, change)| *rate += change);
        self.at.state.add_sums(contact, sums);
        let (force, change) = (
            ClosingRows::sum(&rows.forces, &pushes),
            ClosingRows::sum(&rows.changes, &pushes),
        );
        let work = self.at.flow.impulsive_work(&force, &change);
        self.at.state.add_work(work);
        self.at.is_answered()?;
        self.at.latch(contact, is_event)?;
        let slow = at_rest(self.at.flow);
        Ok(self.settle_from(&were, slow)?)
    }

    /// Takes away what is left of a gap, as an impulse would a rate, so that nothing moves any more where the rows come into force:
    /// velocities would change with it, and momentum.
    fn join(&mut self, contact: usize, least: f64) -> Result<(), Failure> {
        for _ in 0..JOINED {
            let rows = ClosingRows::new(self.at.flow, contact);
            let mut gap = vec![0.0; rows.forces.len()];
            let at = self.at.flow.equations.kinematics();
            rows.constraint.position(&at, &mut gap);
            let (moves, _) = rows.impulses(&gap, least);
            let moved = ClosingRows::sum(&rows.rates, &moves);
            let coordinates = self.at.state.mechanical_mut().iter_mut().zip(&moved);
            coordinates.for_each(|(coordinate, change)| *coordinate += change);
            self.at.is_answered()?;
        }
        Ok(())
    }

    /// Opens what is closed.
    ///
    /// # Errors
    /// Where the mechanism can't be solved without it.
    pub fn open(&mut self, contact: usize) -> Result<(), Failure> {
        let reading = self.at.flow.reading(contact);
        let entry = self.at.entry(contact, &reading);
        let time = self.at.time;
        let history = self.at.ledger.history(contact);
        history.latch(time, false);
        history.go_on(&entry);
        history.rest(&entry);
        history.end();
        *self.at.flow.memory_mut(contact) = Contact::default();
        self.settle(at_rest(self.at.flow))
    }

    /// Closes at the start what holds there, by no event, and what has its event there.
    ///
    /// # Errors
    /// As in [`Impulses::close`].
    pub fn engage(&mut self) -> Result<(), Fault> {
        let held: Vec<usize> = self.at.flow.system().held_at_start().collect();
        let events = self.at.flow.true_at_start();
        for contact in held {
            self.begin_to_hold(contact, false)?;
        }
        events
            .into_iter()
            .try_for_each(|contact| self.close(contact))
    }
}
