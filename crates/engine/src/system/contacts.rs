//! Which contacts a mechanism has, and how messages speak of them and of what else holds it.

use super::{ContactRows, JointData, JointRole, Origin, Owner, System};
use crate::element::Measure;
use crate::element::pair::{ContactId, Pair, Shape};
use crate::element::stop::Stop;
use std::sync::Arc;

/// Where the one-way clutch stands among them, and the lock.
pub(crate) const ONE_WAY: usize = 2;
pub(crate) const LOCK: usize = 3;

impl JointData {
    /// Whether its way has an end.
    pub(crate) fn has_stops(&self) -> bool {
        self.extras().stops.is_some()
    }

    /// Whether anything of it begins and ends to hold.
    pub(crate) fn touches(&self) -> bool {
        let comes_and_goes = self.has_stops() || self.extras().clasp.is_some();
        self.extras().bearing.is_some() || comes_and_goes || self.is_contact()
    }

    /// Whether it holds only where it touches.
    pub(crate) fn is_contact(&self) -> bool {
        self.role() == JointRole::Contact
    }
}

impl System {
    /// What a contact belongs to.
    pub(crate) fn owner_of(&self, id: ContactId) -> Owner {
        self.contact_rows[id.0].owner
    }

    /// The name of what a contact belongs to.
    pub(crate) fn owner_name(&self, id: ContactId) -> &str {
        match self.owner_of(id) {
            Owner::Joint(joint) => &self.joints[joint.0].name,
            Owner::Force(force) => &self.force_data[force].name,
        }
    }

    /// The same as events and sums have it: forces as columns have them, `force.NAME`.
    pub(crate) fn owner_key(&self, id: ContactId) -> String {
        match self.owner_of(id) {
            Owner::Joint(_) => self.owner_name(id).to_owned(),
            Owner::Force(_) => format!("force.{}", self.owner_name(id)),
        }
    }

    /// The same as complaints have it, `joints.NAME`.
    pub(crate) fn owner_path(&self, id: ContactId) -> String {
        match self.owner_of(id) {
            Owner::Joint(_) => format!("joints.{}", self.owner_name(id)),
            Owner::Force(_) => format!("forces.{}", self.owner_name(id)),
        }
    }

    /// The same as messages have it, `joint "NAME"`.
    pub(crate) fn owner_words(&self, id: ContactId) -> String {
        match self.owner_of(id) {
            Owner::Joint(_) => format!("joint \"{}\"", self.owner_name(id)),
            Owner::Force(_) => format!("force \"{}\"", self.owner_name(id)),
        }
    }

    /// The name that a contact goes by in messages: that of what it belongs to, or of a stop of it.
    pub(crate) fn contact_name(&self, id: ContactId) -> String {
        let owner = self.owner_words(id);
        match self.contacts[id.0].stop() {
            None => owner,
            Some(Stop {
                kept: None, side, ..
            }) => format!("the {} stop of {owner}", side.word()),
            Some(Stop {
                kept: Some(kept), ..
            }) if kept.is_lock => format!("the lock of {owner}"),
            Some(_) => format!("the one-way clutch of {owner}"),
        }
    }

    /// Whether springs or actuators have stops.
    pub(crate) fn has_strokes(&self) -> bool {
        let mut owners = self.contact_rows.iter();
        owners.any(|rows| matches!(rows.owner, Owner::Force(_)))
    }

    /// Adds a contact, with the rows that may come into force for it.
    pub(super) fn push_contact(&mut self, pair: Pair, rows: ContactRows) {
        Arc::make_mut(&mut self.contacts).push(pair);
        Arc::make_mut(&mut self.contact_rows).push(rows);
    }

    /// The stops of a spring or an actuator.
    pub(crate) fn stops_of_force(&self, force: usize) -> impl Iterator<Item = ContactId> {
        let owners = self.contact_rows.iter().enumerate();
        let own = owners.filter(move |(_, rows)| rows.owner == Owner::Force(force));
        own.map(|(contact, _)| ContactId(contact))
    }

    /// A value of driver `id` [rad or m] as messages say it.
    pub(crate) fn driver_value(&self, id: usize, value: f64) -> String {
        match self.drivers[id].measure {
            Measure::Angle => self.display.angle(value),
            Measure::Length => self.display.length(value),
        }
    }

    /// The name a row's origin goes by in messages.
    pub(crate) fn origin_name(&self, origin: &Origin) -> String {
        match origin {
            Origin::Joint(id) => format!("joint \"{}\"", self.joints[id.0].name),
            Origin::Driver(id) => format!("driver \"{}\"", self.drivers[id.0].name),
            Origin::Stop(id) => self.contact_name(*id),
            Origin::Initial(name) => format!("initial value \"{name}\""),
        }
    }

    /// The system with each stop this much further on \[m or rad\].
    pub(crate) fn turned(&self, turns: &[f64]) -> System {
        let mut system = self.clone();
        for (contact, turn) in turns.iter().enumerate() {
            let pair = &mut Arc::make_mut(&mut system.contacts)[contact];
            if let Shape::Stop(stop) = &mut pair.shape {
                *stop = stop.turned(*turn);
                system.rows_anew(ContactId(contact));
            }
        }
        system
    }

    /// The rows of a stop after a change of it.
    pub(super) fn rows_anew(&mut self, id: ContactId) {
        let rows = &mut Arc::make_mut(&mut self.contact_rows)[id.0];
        *rows = ContactRows::of(&self.contacts[id.0], id, rows.owner, rows.block);
    }

    /// Whether joints are open, their journals free in their bearings: these stand before all other contacts.
    pub(crate) fn has_journals(&self) -> bool {
        let first = self.contacts.first();
        first.is_some_and(|pair| pair.journal().is_some())
    }
}
