//! What steps and contacts have done, into the report.

use super::integration::Integration;
use super::motion::Motion;
use super::words::beyond_range;
use linkdyn_output::{ClearanceSums, Report};

impl Integration {
    /// Work and contacts into the report.
    pub fn account(&mut self, motion: &Motion, report: &mut Report) {
        let counters = self.stepper.counters();
        report.statistics.steps = self.before[0] + counters.steps;
        report.statistics.rejected = self.before[1] + counters.rejected;
        report.statistics.evaluations = self.before[2] + counters.evaluations;
        let joints = motion
            .system()
            .joints
            .iter()
            .filter(|joint| joint.contact.is_some());
        for (contact, joint) in joints.enumerate() {
            let sums = self.sums(motion, contact);
            let history = &mut self.histories[contact];
            history.finish(self.stepper.t(), sums);
            report.clearances.push(ClearanceSums {
                joint: joint.name.clone(),
                episodes: history.episodes,
                switches: history.switches,
                time_in_contact: history.time_in_contact,
                energy_lost: sums.dissipated,
                impulse: sums.impulse,
                wear: std::mem::take(&mut history.wear),
            });
            let (display, journal) = (&motion.system().display, &motion.system().contacts[contact]);
            report.warnings.extend(beyond_range(
                display,
                joint.name.as_str(),
                journal,
                history.most,
            ));
            if history.unlisted > 0 {
                report.warnings.push(format!(
                    "joint \"{}\": {} further contacts and changes between stick and slip are counted but not listed",
                    joint.name, history.unlisted
                ));
            }
            report.events.append(&mut history.events);
        }
        report.events.sort_by(|a, b| a.time.total_cmp(&b.time));
    }
}
