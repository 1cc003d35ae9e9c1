//! Rigid journals that come to rest on their bearings, and which of them follow from there.

use super::integration::Integration;
use super::jam::Jam;
use super::motion::Motion;
use super::point::{
    Point, approach_acceleration, at_rest, halfway, inverse_mass, rubbing, touches,
};
use crate::element::journal::{Contact, Phase, Surface};
use crate::mechanism::driven::Failure;
use linkdyn_linear::complementary::complementary;
use linkdyn_linear::math::dot;

impl Integration {
    /// Journals that touch their bearings with speeds below `slow` lose what brings them nearer, all at once, and of those
    /// that stay the ones that press follow: with p, N ≥ 0 their impulses and normal forces, δ̇ = v − W p ≤ 0 and then
    /// δ̈ = b − W N − W_t T(N) ≤ 0, in each pair one of the two zero.
    pub(super) fn settle(
        &mut self,
        motion: &mut Motion,
        slow: f64,
        time: f64,
    ) -> Result<(), Failure> {
        let were = motion.followers();
        self.go_on_as(motion, &vec![false; were.len()], time)?;
        let contacts: Vec<usize> = (0..were.len())
            .filter(|&contact| were[contact] || touches(motion, contact, slow))
            .collect();
        let points = Point::of(motion, &contacts);
        let mass = inverse_mass(&points, &vec![0.0; contacts.len()]);
        let rates: Vec<f64> = contacts
            .iter()
            .map(|&contact| motion.reading(contact).rate)
            .collect();
        let (stays, impulses) = complementary(&mass, &rates).ok_or(Failure::Singular)?;
        let pushes: Vec<[f64; 2]> = impulses.iter().map(|&impulse| [impulse, 0.0]).collect();
        self.push_all(motion, &contacts, &points, &pushes);
        motion.evaluate(time, &self.y)?;
        let free: Vec<f64> = contacts
            .iter()
            .zip(&points)
            .zip(&stays)
            .map(|((&contact, point), &stays)| {
                // What an impact has stopped may leave by round-off.
                let least = if were[contact] { slow } else { at_rest(motion) };
                let at_rest = stays || motion.reading(contact).rate.abs() <= least;
                if at_rest {
                    approach_acceleration(motion, contact, point)
                } else {
                    f64::NEG_INFINITY
                }
            })
            .collect();
        let ratios: Vec<f64> = contacts
            .iter()
            .map(|&contact| rubbing(motion, contact))
            .collect();
        let rubbed = inverse_mass(&points, &ratios);
        let jam = Jam {
            were: &were,
            contacts: &contacts,
            points: &points,
        };
        let Some((presses, _)) = complementary(&rubbed, &free) else {
            return self.unjam(motion, &jam, 0.0, time);
        };
        let mut following = vec![false; were.len()];
        contacts
            .iter()
            .zip(&presses)
            .for_each(|(&contact, &presses)| following[contact] = presses);
        match self.go_on(motion, &following, time) {
            // These forces answer the motion, but do not come of those without friction.
            Err(Failure::Locked { .. }) => self.unjam(motion, &jam, 0.0, time),
            gone => gone,
        }
    }

    /// Other followers, from the position and velocities at hand; those that were and are not any more end their episodes.
    pub(super) fn go_on(
        &mut self,
        motion: &mut Motion,
        following: &[bool],
        time: f64,
    ) -> Result<(), Failure> {
        self.go_on_as(motion, following, time)?;
        for (contact, &follows) in following.iter().enumerate() {
            let Surface::Rigid(rigid) = motion.system().contacts[contact].surface else {
                continue;
            };
            let (reading, sums) = (motion.reading(contact), self.sums(motion, contact));
            let history = &mut self.histories[contact];
            match (
                motion.reduced.inputs.contacts[contact].phase == Phase::Contact,
                follows,
            ) {
                (true, false) => {
                    history.go_on(&reading, sums, motion.contact_angle(contact, &reading));
                    history.rest(time, &reading, sums);
                    history.end();
                    motion.reduced.inputs.contacts[contact] = Contact::default();
                }
                (false, true) => {
                    history.begin(
                        time,
                        &reading,
                        sums,
                        motion.contact_angle(contact, &reading),
                    );
                    let memory = &mut motion.reduced.inputs.contacts[contact];
                    memory.phase = Phase::Contact;
                    memory.piece = rigid.friction_law().piece(reading.sliding);
                }
                (true, true) | (false, false) => {}
            }
        }
        Ok(())
    }

    /// The equations with these followers.
    pub(super) fn go_on_as(
        &mut self,
        motion: &mut Motion,
        following: &[bool],
        time: f64,
    ) -> Result<(), Failure> {
        let tail = self.y.split_off(2 * motion.reduced.freedom());
        if let Err(failure) = motion.follow(following, time) {
            if let Failure::Locked { .. } = failure {
                self.jammed = (0..following.len())
                    .filter(|&contact| following[contact])
                    .collect();
            }
            self.y.extend(tail);
            return Err(failure);
        }
        self.y.resize(2 * motion.reduced.freedom(), 0.0);
        self.y.extend(tail);
        motion.state(&mut self.y);
        motion.evaluate(time, &self.y)
    }

    /// Applies impulses at several contacts at once, none of which follows.
    pub(super) fn push_all(
        &mut self,
        motion: &mut Motion,
        contacts: &[usize],
        points: &[Point],
        pushes: &[[f64; 2]],
    ) {
        let halfway = halfway(motion, points, pushes);
        for ((&contact, point), &push) in contacts.iter().zip(points).zip(pushes) {
            let force = point.sum(&point.forces, push);
            let work = motion.impulsive_work(&force, &point.sum(&point.changes, push));
            let (sums, component) = (motion.dissipated(contact), motion.work());
            self.y[sums] -= dot(&force, &halfway);
            self.y[sums + 1] += push[0];
            self.y[sums + 2] += (push[0] * dot(&point.forces[1], &halfway)).abs();
            self.y[component] += work;
            point.apply(&mut self.y, push);
        }
    }
}
