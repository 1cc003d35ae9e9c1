//! Jams that end: impulses that stop sliding (see [`super::jamming`]), and what comes of them.

use super::grips::ContactMode;
use super::jamming::{JamPushes, stop};
use super::touching::Touching;
use super::{Impulses, at_rest};
use crate::analysis::dynamics::words::TIGHT;
use crate::element::pair::Hold;
use crate::mechanism::driven::Failure;

impl Impulses<'_, '_> {
    /// Impulses that stop sliding in a jam, and what comes of them. `way` is how it jams.
    pub(super) fn end_jam(
        &mut self,
        touching: &Touching,
        way: Option<JamPushes>,
    ) -> Result<(), Failure> {
        self.at.jams.begin(self.at.flow, touching, self.at.time)?;
        if let Some(way) = way.as_ref().filter(|way| way.is_alone()) {
            // One contact by itself is an impact from its beginning, and restitution gives back of all that it presses in.
            let leader = touching.contacts[way.leader];
            let none = self.at.flow.memories().len();
            self.at
                .take(&vec![Hold::Free; none], &vec![ContactMode::Leaves; none])?;
            let mut reading = self.at.flow.reading(leader);
            reading.rate = 0.0;
            self.impact(leader, &reading)?;
        } else {
            let pushes = stop(self.at.flow, touching, way.as_ref()).ok_or(Failure::Singular)?;
            self.at.push_all(touching, &pushes)?;
            self.settle(at_rest(self.at.flow))?;
        }
        self.at.jams.contacts.clear();
        Ok(())
    }

    /// Ends a jam at the last accepted point, where the next step would be none.
    ///
    /// # Errors
    /// Where there is none, or no impulses end it.
    pub fn loosen(&mut self) -> Result<(), Failure> {
        let loosened = self.try_to_loosen();
        loosened.map_err(|failure| self.of_contacts(failure))
    }

    fn try_to_loosen(&mut self) -> Result<(), Failure> {
        let is_answered = self.at.is_answered()?;
        let margin = self.at.flow.equations.dependent_forces().margin();
        let were = self.at.release_all()?;
        let contacts = (0..were.len()).filter(|&contact| were[contact] != Hold::Free);
        let touching = Touching::new(self.at.flow, contacts.collect());
        let way = JamPushes::find(self.at.flow, &touching);
        let jams = way.as_ref().is_some_and(|way| way.margin <= TIGHT);
        if is_answered && margin > TIGHT && !jams {
            return Err(Failure::Singular);
        }
        self.end_jam(&touching, way)?;
        self.try_to_resolve()
    }
}
