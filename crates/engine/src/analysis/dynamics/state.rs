//! The state vector and its layout.
//!
//! ```text
//! y = (u, u̇ | z | s | W | D, I, S per contact)
//!
//! u, u̇   independent coordinates and their rates (f, f)    [`crate::mechanism::reduced`]
//! z      bristles of friction laws that have them           ż by the law                           [m]
//!        (of contacts, then of ideal joints)
//! s      integrated states of the model                      ṡ by its formula
//! W      work of drivers, loads and dampers                 W' = Σ effort · rate + Σ supplied      [J]
//! D      energy dissipated in a contact                     D' = (N − N_e) δ̇ − T v_t               [J]
//! I      normal impulse                                     I' = N                                 [N·s]
//! S      sliding under load, for wear                       S' = N |v_t|                           [J]
//! ```
//!
//! Without contacts y is (u, u̇ | z | s) alone.

use crate::element::pair::Surface;
use crate::system::System;
use std::ops::{Range, Sub};
use std::sync::Arc;

/// Quantities kept per contact.
const PER_CONTACT: usize = 3;

/// Where the parts of y are.
#[derive(Debug, Clone)]
pub struct Layout {
    freedom: usize,
    contacts: usize,
    states: usize,
    bristles: Arc<Bristles>,
}

/// Bristles, counted from the first.
#[derive(Debug)]
struct Bristles {
    /// By contact.
    contacts: Vec<Option<usize>>,
    /// By force that depends on multipliers.
    forces: Vec<Option<usize>>,
    count: usize,
}

impl Layout {
    /// Of a mechanism with so many degrees of freedom.
    pub fn new(system: &System, freedom: usize) -> Self {
        let mut count = 0;
        let mut next = |has_bristle: bool| {
            has_bristle.then(|| {
                count += 1;
                count - 1
            })
        };
        let of_contact = |surface: &Surface| match surface {
            Surface::Compliant(laws) => laws.friction.has_bristle(),
            Surface::Rigid(_) => false,
        };
        let contacts = system.contacts.iter();
        let contacts = contacts.map(|contact| next(of_contact(&contact.surface)));
        let contacts: Vec<Option<usize>> = contacts.collect();
        let forces = system.dependent_forces.iter();
        let forces = forces.map(|dependent| next(dependent.force.memory_scale().is_some()));
        let forces = forces.collect();
        Layout {
            freedom,
            contacts: contacts.len(),
            states: system.states.len(),
            bristles: Arc::new(Bristles {
                contacts,
                forces,
                count,
            }),
        }
    }

    /// Number of components.
    pub fn dimension(&self) -> usize {
        if self.contacts == 0 {
            self.work()
        } else {
            self.work() + 1 + PER_CONTACT * self.contacts
        }
    }

    /// Degrees of freedom f.
    pub fn freedom(&self) -> usize {
        self.freedom
    }

    /// The same with another number of degrees of freedom.
    pub fn set_freedom(&mut self, freedom: usize) {
        self.freedom = freedom;
    }

    /// (u, u̇).
    pub fn mechanical(&self) -> Range<usize> {
        0..2 * self.freedom
    }

    /// u̇.
    pub fn rates(&self) -> Range<usize> {
        self.freedom..2 * self.freedom
    }

    /// z of a contact.
    pub fn bristle(&self, contact: usize) -> Option<usize> {
        Some(2 * self.freedom + self.bristles.contacts[contact]?)
    }

    /// z of a force that depends on multipliers.
    pub fn memory(&self, force: usize) -> Option<usize> {
        Some(2 * self.freedom + (*self.bristles.forces.get(force)?)?)
    }

    /// Number of forces that depend on multipliers in every phase; those of sustained contacts stand behind them.
    pub fn forces(&self) -> usize {
        self.bristles.forces.len()
    }

    /// s.
    pub fn states(&self) -> Range<usize> {
        let first = 2 * self.freedom + self.bristles.count;
        first..first + self.states
    }

    /// W.
    pub fn work(&self) -> usize {
        self.states().end
    }

    /// D, I, S of a contact.
    pub fn sums(&self, contact: usize) -> Range<usize> {
        let first = self.work() + 1 + PER_CONTACT * contact;
        first..first + PER_CONTACT
    }
}

/// Dissipated energy, normal impulse and sliding under load since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sums {
    /// Dissipated energy \[J\].
    pub dissipated: f64,
    /// Normal impulse \[N·s\].
    pub impulse: f64,
    /// Sliding under load \[N·m\].
    pub sliding: f64,
}

impl Sums {
    /// From their components of y.
    pub fn of(parts: &[f64]) -> Self {
        Sums {
            dissipated: parts[0],
            impulse: parts[1],
            sliding: parts[2],
        }
    }
}

impl Sub for Sums {
    type Output = Sums;

    fn sub(self, before: Sums) -> Sums {
        Sums {
            dissipated: self.dissipated - before.dissipated,
            impulse: self.impulse - before.impulse,
            sliding: self.sliding - before.sliding,
        }
    }
}

/// A point of the motion: y.
#[derive(Debug, Clone)]
pub struct State {
    layout: Layout,
    y: Vec<f64>,
}

impl State {
    /// All zero.
    pub fn new(layout: &Layout) -> Self {
        State {
            layout: layout.clone(),
            y: vec![0.0; layout.dimension()],
        }
    }

    /// y.
    pub fn as_slice(&self) -> &[f64] {
        &self.y
    }

    /// y, to be filled.
    pub fn as_mut_slice(&mut self) -> &mut [f64] {
        &mut self.y
    }

    /// (u, u̇), to be filled.
    pub fn mechanical_mut(&mut self) -> &mut [f64] {
        &mut self.y[self.layout.mechanical()]
    }

    /// s, to be filled.
    pub fn states_mut(&mut self) -> &mut [f64] {
        &mut self.y[self.layout.states()]
    }

    /// u̇, to be changed by impulses.
    pub fn rates_mut(&mut self) -> &mut [f64] {
        &mut self.y[self.layout.rates()]
    }

    /// D, I and S of a contact.
    pub fn sums(&self, contact: usize) -> Sums {
        Sums::of(&self.y[self.layout.sums(contact)])
    }

    /// Adds to D, I and S of a contact.
    pub fn add_sums(&mut self, contact: usize, more: Sums) {
        let sums = &mut self.y[self.layout.sums(contact)];
        let more = [more.dissipated, more.impulse, more.sliding];
        sums.iter_mut()
            .zip(more)
            .for_each(|(sum, more)| *sum += more);
    }

    /// W \[J\].
    pub fn work(&self) -> f64 {
        self.y[self.layout.work()]
    }

    /// Adds to W \[J\].
    pub fn add_work(&mut self, work: f64) {
        self.y[self.layout.work()] += work;
    }

    /// The bristles of a contact are straight again.
    pub fn straighten_bristle(&mut self, contact: usize) {
        if let Some(component) = self.layout.bristle(contact) {
            self.y[component] = 0.0;
        }
    }

    /// The bristles of one contact become those of another.
    pub fn hand_bristle(&mut self, [from, to]: [usize; 2]) {
        let components = [from, to].map(|contact| self.layout.bristle(contact));
        if let [Some(from), Some(to)] = components {
            self.y[to] = std::mem::take(&mut self.y[from]);
        }
    }

    /// Takes a state with this layout.
    pub fn take(&mut self, layout: &Layout, y: &[f64]) {
        self.fit(layout);
        self.y.copy_from_slice(y);
    }

    /// Makes room for a state with this layout.
    pub fn fit(&mut self, layout: &Layout) {
        self.layout.set_freedom(layout.freedom());
        self.y.resize(layout.dimension(), 0.0);
    }

    /// Another number of degrees of freedom: (u, u̇) are to be filled anew, all else is kept.
    pub fn set_freedom(&mut self, freedom: usize) {
        let (from, to) = (2 * self.layout.freedom(), 2 * freedom);
        let new = std::iter::repeat_n(0.0, to);
        self.y.splice(..from, new);
        self.layout.set_freedom(freedom);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(freedom: usize) -> Layout {
        Layout {
            freedom,
            contacts: 2,
            states: 0,
            bristles: Arc::new(Bristles {
                contacts: vec![None, Some(0)],
                forces: vec![Some(1)],
                count: 2,
            }),
        }
    }

    #[test]
    fn the_parts_of_y_lie_one_after_the_other() {
        let layout = layout(3);
        assert_eq!((layout.mechanical(), layout.rates()), (0..6, 3..6));
        assert_eq!((layout.bristle(0), layout.bristle(1)), (None, Some(6)));
        assert_eq!((layout.memory(0), layout.memory(1)), (Some(7), None));
        assert_eq!(layout.work(), 8);
        assert_eq!((layout.sums(0), layout.sums(1)), (9..12, 12..15));
        assert_eq!(layout.dimension(), 15);
    }

    #[test]
    fn what_is_not_mechanical_outlives_a_change_of_freedom() {
        let (three, one) = (layout(3), layout(1));
        let mut state = State::new(&three);
        let y: Vec<f64> = (0..15).map(f64::from).collect();
        state.take(&three, &y);
        state.set_freedom(1);
        assert_eq!(state.as_slice()[one.mechanical()], [0.0, 0.0]);
        assert_eq!(state.as_slice()[2..], y[6..]);
        assert_eq!((state.work(), state.sums(1).impulse), (8.0, 13.0));
        state.set_freedom(3);
        assert_eq!(state.as_slice()[6..], y[6..]);
    }
}
