//! Events that close and open joints.

use super::Flow;
use crate::system::Trigger;

impl Flow<'_> {
    /// What closes (true) or opens where formulas go from the sides that they hold over to those of the last evaluation, by contact.
    pub fn fired(&self) -> Vec<(usize, bool)> {
        let at = self.equations.kinematics();
        let happens =
            |trigger: &Option<Trigger>| trigger.as_ref().is_some_and(|one| one.happens(&at));
        let timed = self.system().timed.iter();
        let fired = timed.filter_map(|timed| {
            let contact = timed.contact.0;
            let is_closed = self.sustained[contact].is_some();
            let is_over = || timed.until.as_ref().is_some_and(|until| until.is_true(&at));
            match is_closed {
                true => happens(&timed.until).then_some((contact, false)),
                false => (happens(&timed.from) && !is_over()).then_some((contact, true)),
            }
        });
        fired.collect()
    }

    /// What closes at the start, since its event is true there.
    pub fn true_at_start(&self) -> Vec<usize> {
        let at = self.equations.kinematics();
        let is_true =
            |trigger: &Option<Trigger>| trigger.as_ref().is_some_and(|one| one.is_true(&at));
        let timed = self.system().timed.iter();
        let closing = timed.filter(|timed| is_true(&timed.from) && !is_true(&timed.until));
        closing.map(|timed| timed.contact.0).collect()
    }
}
