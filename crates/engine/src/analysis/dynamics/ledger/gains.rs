//! Impacts that gain energy: with friction those whose restitution compares velocities or impulses may, see
//! [`crate::contact::impact`].

use crate::contact::impact::Sense;
use crate::element::pair::{ContactId, Surface};
use crate::system::System;
use linkdyn_model::display::number;

/// What one joint's impacts have gained.
#[derive(Clone)]
struct Gain {
    contact: ContactId,
    impacts: u64,
    /// \[J\]
    sum: f64,
    /// The largest of them \[J\], and when \[s\].
    most: (f64, f64),
}

/// Those of all joints.
#[derive(Clone, Default)]
pub struct Gains(Vec<Gain>);

impl Gains {
    /// An impact has gained this \[J\].
    pub fn note(&mut self, system: &System, contact: ContactId, time: f64, gained: f64) {
        let owner = system.owner_of(contact);
        let known = self
            .0
            .iter_mut()
            .find(|gain| system.owner_of(gain.contact) == owner);
        match known {
            Some(gain) => {
                gain.impacts += 1;
                gain.sum += gained;
                if gained > gain.most.0 {
                    gain.most = (gained, time);
                }
            }
            None => self.0.push(Gain {
                contact,
                impacts: 1,
                sum: gained,
                most: (gained, time),
            }),
        }
    }

    /// What is said of them.
    pub fn warnings(&self, system: &System) -> impl Iterator<Item = String> {
        self.0.iter().map(|gain| gain.warning(system))
    }
}

impl Gain {
    fn warning(&self, system: &System) -> String {
        let pair = &system.contacts[self.contact.0];
        let (energy, time) = (number(self.most.0, 3), system.display.time(self.most.1));
        let gains = match self.impacts {
            1 => format!("the impact at t = {time} gains {energy} J"),
            many => format!(
                "{many} impacts gain {} J, the one at t = {time} {energy} J",
                number(self.sum, 3)
            ),
        };
        let compared = match &pair.surface {
            Surface::Rigid(rigid) if rigid.sense == Sense::Kinetic => "impulses",
            _ => "velocities",
        };
        let place = system.owner_path(self.contact);
        let words = match pair.journal() {
            Some(_) => format!("{place}.clearance.impact"),
            None => place,
        };
        format!(
            "{}: {gains}, for its restitution compares {compared}, which with friction may; \"sense\": \"energetic\" in {words} never does",
            system.owner_words(self.contact)
        )
    }
}
