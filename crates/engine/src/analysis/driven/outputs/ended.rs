//! What is left to say at the end of a prescribed motion.

use super::Outputs;
use crate::analysis::words::unsure_friction;
use linkdyn_output::{EventKind, Trajectory};

impl Outputs<'_, '_> {
    /// What is left to say at the end.
    pub fn finish(mut self) -> Trajectory {
        self.gap.close(&mut self.report.events);
        self.wavering.close(&mut self.report.events);
        self.locking.close(&mut self.report.events);
        self.report.events.sort_by(|a, b| a.time.total_cmp(&b.time));
        if self.contents.reactions {
            self.report.quality.power_imbalance = Some(self.powers.relative_imbalance());
        }
        let outside = self.outside.warnings(self.system);
        self.report.warnings.extend(outside);
        let overrun = self.overrun.warnings(self.system);
        self.report.warnings.extend(overrun);
        self.recorder.close(self.system, self.report);
        if !self.bridge.missing.is_empty() {
            self.report.warnings.push(format!(
                "at a change point the reactions of {} have no bound and are left out",
                self.bridge.missing.join(", ")
            ));
        }
        if !self.report.mobility.redundant.is_empty() && self.contents.reactions {
            self.report.warnings.push(format!(
                "constraints of {} are redundant: the reactions of {} are the ones of least norm, not the only ones",
                self.report.mobility.redundant.join(", "),
                self.report.mobility.reactions_not_unique.join(", ")
            ));
        }
        if self.contents.reactions {
            self.report.warnings.extend(unsure_friction(
                self.system,
                &self.report.mobility.reactions_not_unique,
            ));
        }
        for (kind, what) in [
            (
                EventKind::NotConverged,
                "the clearance fixed point does not converge",
            ),
            (EventKind::NoSolution, "there is no assembly"),
            (
                EventKind::SelfLocking,
                "a joint locks itself by its friction: forces do not exist",
            ),
        ] {
            let count = self
                .report
                .events
                .iter()
                .filter(|event| event.kind == kind)
                .count();
            if count > 0 {
                let intervals = if count == 1 { "interval" } else { "intervals" };
                self.report
                    .warnings
                    .push(format!("in {count} {intervals} {what} (see events)"));
            }
        }
        self.recorder.trajectory
    }
}
