//! Largest penetration and force of a contact, within the steps.

use super::{Ledger, Listener};
use crate::analysis::dynamics::fault::Fault;
use crate::analysis::dynamics::steps::LastStep;
use crate::element::pair::{Reading, Surface};

/// Parts of a step at whose ends peaks are estimated, and how far inside at those of the step.
const PEAK_POINTS: usize = 16;
const RISE: f64 = 1e-3;
/// Parabolas that follow up a peak, each a tenth as wide as the one before.
const PEAK_PARABOLAS: usize = 3;

/// One number of a reading.
type ReadingNumber = fn(&Reading) -> f64;

impl Ledger {
    /// Peaks of penetration and force within a piece of a step: where a cubic through its ends has them, then on the
    /// continuous extension. Whether that was evaluated.
    pub(super) fn locate_peaks(
        &mut self,
        step: &mut LastStep,
        contact: usize,
        end: &Reading,
        (from, to): (f64, f64),
        listener: Listener,
    ) -> Result<bool, Fault> {
        let Surface::Compliant(laws) = &step.flow.system().contacts[contact].surface else {
            return Ok(false);
        };
        let (a, b) = (self.accounts[contact].last, end);
        let deepest = self.accounts[contact].history.deepest();
        if deepest.is_some_and(|deepest| a.penetration.max(b.penetration) < 0.5 * deepest) {
            return Ok(false);
        }
        let approach = step.flow.memories()[contact].approach;
        let h = to - from;
        // Largest value so far, and where within the piece.
        let mut deepest = (a.penetration.max(b.penetration), None);
        let mut hardest = (a.normal.max(b.normal), None);
        for k in 0..=PEAK_POINTS {
            let part = 1.0 / PEAK_POINTS as f64;
            // At the ends a little inside, which tells whether it rises from there.
            let s = (k as f64 * part).clamp(RISE, 1.0 - RISE);
            let place = s.clamp(0.5 * part, 1.0 - 0.5 * part);
            let (r, rest) = (s * s, 1.0 - s);
            let penetration = (1.0 + 2.0 * s) * rest * rest * a.penetration
                + s * rest * rest * h * a.rate
                + r * (3.0 - 2.0 * s) * b.penetration
                - r * rest * h * b.rate;
            let rate = 6.0 * s * rest * (b.penetration - a.penetration) / h
                + rest * (1.0 - 3.0 * s) * a.rate
                + s * (3.0 * s - 2.0) * b.rate;
            let force = laws.normal.continued(penetration, rate, approach);
            for (largest, value) in [(&mut deepest, penetration), (&mut hardest, force)] {
                if value > largest.0 {
                    *largest = (value, Some(from + place * h));
                }
            }
        }
        if !self.accounts[contact].history.rises(deepest.0, hardest.0) {
            return Ok(false);
        }
        let (depth, force): (ReadingNumber, ReadingNumber) = (|at| at.penetration, |at| at.normal);
        for (time, of) in [(deepest.1, depth), (hardest.1, force)] {
            if let Some(time) = time {
                let near = (time, 0.5 * h / PEAK_POINTS as f64);
                self.peak_near(step, contact, near, of, listener)?;
            }
        }
        Ok(deepest.1.is_some() || hardest.1.is_some())
    }

    /// A peak near `time`, by parabolas through three points.
    fn peak_near(
        &mut self,
        step: &mut LastStep,
        contact: usize,
        (mut time, mut width): (f64, f64),
        of: ReadingNumber,
        listener: Listener,
    ) -> Result<(), Fault> {
        for _ in 0..PEAK_PARABOLAS {
            let mut values = [0.0; 3];
            for (value, side) in values.iter_mut().zip([-1.0, 0.0, 1.0]) {
                let at = time + side * width;
                step.evaluate(at)?;
                let reading = step.flow.reading(contact);
                self.history(contact).peak(&reading);
                listener(self, step, contact, at);
                *value = of(&reading);
            }
            let [before, here, after] = values;
            let bend = before - 2.0 * here + after;
            if bend >= 0.0 {
                break;
            }
            time += width * (0.5 * (before - after) / bend).clamp(-1.0, 1.0);
            width *= 0.1;
        }
        Ok(())
    }
}
