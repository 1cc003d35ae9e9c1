//! The ledger: what contacts have done, and the energy that went through them.

mod gains;
mod history;
mod peaks;

use super::fault::Fault;
use super::flow::Flow;
use super::modes::{Change, sticks};
use super::state::{State, Sums};
use super::steps::LastStep;
use super::words::beyond_range;
use crate::element::pair::{Contact, ContactId, Phase, Reading, Shape};
use crate::system::System;
use gains::Gains;
use linkdyn_output::{ClearanceSums, Event, Report, StopSums};

pub use history::{Entry, History};

/// Hears of places where a contact may press most: the step, evaluated there, the contact, and the time.
pub type Listener<'l> = &'l mut dyn FnMut(&Ledger, &mut LastStep, usize, f64);

/// What every contact has done.
#[derive(Clone)]
pub struct Ledger {
    accounts: Vec<Account>,
    gains: Gains,
    /// Touches that have gone over from a contact to another.
    handed: Vec<[usize; 2]>,
}

/// Of one contact.
#[derive(Clone)]
struct Account {
    history: History,
    /// At the end of the last piece of a step.
    last: Reading,
    /// Elastic energy lost where a contact ended by its law while penetrated \[J\].
    released: f64,
}

impl Account {
    /// Episodes and changes between stick and slip so far.
    fn happened(&self) -> u64 {
        self.history.episodes + self.history.switches
    }
}

impl Ledger {
    /// Before anything has happened.
    pub fn new(system: &System) -> Self {
        let contacts = system.contacts.iter().enumerate();
        let accounts = contacts.map(|(contact, pair)| Account {
            history: History::new(&system.owner_key(ContactId(contact)), pair),
            last: Reading::default(),
            released: 0.0,
        });
        Ledger {
            accounts: accounts.collect(),
            gains: Gains::default(),
            handed: Vec::new(),
        }
    }

    /// Whether there are no contacts.
    pub fn is_empty(&self) -> bool {
        self.accounts.is_empty()
    }

    /// What a contact has done so far.
    pub fn sums(&self, state: &State, contact: usize) -> Sums {
        let mut sums = state.sums(contact);
        sums.dissipated += self.accounts[contact].released;
        sums
    }

    /// Energy that contacts have dissipated, and work of everything else \[J\].
    pub fn energy(&self, state: &State) -> [f64; 2] {
        if self.is_empty() {
            return [0.0; 2];
        }
        let contacts = 0..self.accounts.len();
        let dissipated = contacts.map(|contact| self.sums(state, contact).dissipated);
        [dissipated.sum(), state.work()]
    }

    /// The same of all contacts.
    pub fn happened(&self) -> u64 {
        self.accounts.iter().map(Account::happened).sum()
    }

    /// Whose contact has begun, stuck and slipped most often, and how often.
    pub fn busiest(&self, system: &System) -> Option<(String, u64)> {
        let accounts = self.accounts.iter().enumerate();
        let (contact, account) = accounts.max_by_key(|(_, account)| account.happened())?;
        Some((system.owner_words(ContactId(contact)), account.happened()))
    }

    /// A contact with this reading at an instant.
    pub fn entry(
        &self,
        (flow, state): (&Flow, &State),
        contact: usize,
        reading: &Reading,
        time: f64,
    ) -> Entry {
        Entry {
            time,
            reading: *reading,
            sums: self.sums(state, contact),
            angle: flow.contact_angle(contact, reading),
        }
    }

    /// The history of a contact.
    pub fn history(&mut self, contact: usize) -> &mut History {
        &mut self.accounts[contact].history
    }

    /// A contact at the start of the run. `entry` is the penetration before its forces act, `reading` the contact after.
    pub fn start(&mut self, contact: usize, is_behind: bool, entry: &Entry, reading: &Reading) {
        let Account { history, last, .. } = &mut self.accounts[contact];
        if entry.reading.penetration.min(entry.reading.room) > 0.0 && !is_behind {
            history.begin(entry);
        }
        history.peak(reading);
        *last = *reading;
    }

    /// A contact changes as its guards say; `entry` is the contact before, `was` its memory then, `reading` the contact after.
    pub fn change(
        &mut self,
        flow: &Flow,
        contact: usize,
        (change, was): (Change, &Contact),
        entry: &Entry,
        reading: &Reading,
    ) {
        let Account { history, last, .. } = &mut self.accounts[contact];
        match change {
            Change::Begin => {
                history.begin(entry);
                // The force of some laws begins at once.
                history.peak(reading);
            }
            Change::Release => history.rest(entry),
            Change::Press => history.press(),
            Change::End => {
                if was.phase == Phase::Contact {
                    history.rest(entry);
                }
                history.end();
            }
            Change::Piece => {
                let journal = &flow.system().contacts[contact];
                let is = sticks(journal, &flow.memories()[contact]);
                if is != sticks(journal, was) {
                    history.switch(entry.time, is);
                }
            }
        }
        *last = *reading;
    }

    /// The touch of a contact goes over to another, as it is there: no more than the piece of an outline changes.
    pub fn hand_over(&mut self, state: &State, [from, to]: [usize; 2], reading: &Reading) {
        let [before, after] = [from, to].map(|contact| self.sums(state, contact));
        if let Some(open) = self.history(from).hand_over(before) {
            self.history(to).take_over(open, after);
        }
        self.accounts[to].last = *reading;
        self.handed.push([from, to]);
    }

    /// Contacts that have gone over to others since this was asked last.
    pub fn handed(&mut self) -> Vec<[usize; 2]> {
        std::mem::take(&mut self.handed)
    }

    /// Elastic energy of a contact is lost \[J\].
    pub fn release(&mut self, contact: usize, energy: f64) {
        self.accounts[contact].released += energy;
    }

    /// An impact has gained this energy \[J\].
    pub fn gain(&mut self, system: &System, contact: usize, time: f64, gained: f64) {
        self.gains.note(system, ContactId(contact), time, gained);
    }

    /// What contacts do from the beginning of the last step to `until`, where the mechanism is evaluated then.
    ///
    /// # Errors
    /// Where the mechanism can't be evaluated within the step.
    pub fn follow(
        &mut self,
        step: &mut LastStep,
        until: f64,
        listener: Listener,
    ) -> Result<(), Fault> {
        let from = step.from();
        step.evaluate(until)?;
        for contact in 0..self.accounts.len() {
            let reading = step.flow.reading(contact);
            if step.flow.is_in_contact(contact) {
                let piece = (from, until);
                if self.locate_peaks(step, contact, &reading, piece, listener)? {
                    step.evaluate(until)?;
                }
                let entry = self.entry((step.flow, step.state), contact, &reading, until);
                self.history(contact).go_on(&entry);
            }
            self.accounts[contact].last = reading;
        }
        Ok(())
    }

    /// Whether there are events that nobody has been told.
    pub fn has_news(&self) -> bool {
        let mut accounts = self.accounts.iter();
        accounts.any(|account| !account.history.events.is_empty())
    }

    /// Events that nobody has been told.
    pub fn news(&mut self) -> Vec<Event> {
        let accounts = self.accounts.iter_mut();
        let events = accounts.flat_map(|account| account.history.events.drain(..));
        events.collect()
    }

    /// What contacts have done, into the report.
    pub fn close(&mut self, system: &System, state: &State, time: f64, report: &mut Report) {
        for (contact, pair) in system.contacts.iter().enumerate() {
            let id = ContactId(contact);
            let joint = system.owner_key(id);
            let sums = self.sums(state, contact);
            let history = self.history(contact);
            history.finish(time, sums);
            match &pair.shape {
                Shape::Journal(journal) => {
                    report.warnings.extend(beyond_range(
                        &system.display,
                        &joint,
                        (journal, &pair.surface),
                        history.most,
                    ));
                    report.clearances.push(ClearanceSums {
                        joint,
                        episodes: history.episodes,
                        switches: history.switches,
                        time_in_contact: history.time_in_contact,
                        energy_lost: sums.dissipated,
                        impulse: sums.impulse,
                        wear: std::mem::take(&mut history.wear),
                    });
                }
                Shape::Stop(stop) => report.stops.push(StopSums {
                    joint,
                    stop: stop.word(),
                    episodes: history.episodes,
                    time_in_contact: history.time_in_contact,
                    energy_lost: sums.dissipated,
                    impulse: sums.impulse * stop.arm,
                }),
                Shape::Clasp(_) => report.stops.push(StopSums {
                    joint,
                    stop: "active",
                    episodes: history.episodes,
                    time_in_contact: history.time_in_contact,
                    energy_lost: sums.dissipated,
                    impulse: sums.impulse,
                }),
                Shape::Edge(_) => {
                    let known = report.stops.iter().position(|all| all.joint == joint);
                    let place = known.unwrap_or(report.stops.len());
                    if known.is_none() {
                        report.stops.push(StopSums::of(joint, "contact"));
                    }
                    let all = &mut report.stops[place];
                    all.episodes += history.episodes;
                    all.time_in_contact += history.time_in_contact;
                    all.energy_lost += sums.dissipated;
                    all.impulse += sums.impulse;
                }
            }
            if history.unlisted > 0 {
                report.warnings.push(format!(
                    "{}: {} further contacts and changes between stick and slip are counted but not listed",
                    system.contact_name(id), history.unlisted
                ));
            }
            report.events.append(&mut history.events);
        }
        report.warnings.extend(self.gains.warnings(system));
        report.events.sort_by(|a, b| a.time.total_cmp(&b.time));
    }
}
