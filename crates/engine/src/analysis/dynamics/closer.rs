//! Looks at a step for the extremes of all columns (see [`super::watch`]).
//!
//! A step is closely looked at in two rounds: rows at fixed points of it give a polynomial per column ([`within`]); where
//! that exceeds the extreme so far, the mechanism is evaluated at its top. What counts is always a row that was evaluated.

use super::fault::Fault;
use super::integration::Integration;
use super::looking::{Looking, Top};
use super::motion::Motion;
use super::watch::{Node, SIDES, Watch};
use super::within::{self, POINTS};
use crate::element::journal::{Phase, Surface};

/// Evaluations of one step after which the rest is left as it is.
const MOST: usize = 60;
/// Parabolas that follow up a top that the polynomial has wrong, their first width in parts of the step, and how much narrower
/// each is.
const PARABOLAS: usize = 5;
const WIDTH: f64 = 0.03;
const NARROWER: f64 = 0.2;

impl Integration {
    /// The row of the motion's last evaluation, at the point in `y`, goes into the node.
    fn fill(&self, motion: &mut Motion, watch: &mut Watch, node: &mut Node) {
        let [dissipated, _] = self.ledger(motion);
        let reduced = &motion.reduced;
        let elastic = reduced
            .driven
            .evaluation
            .contact_energy(motion.system(), &reduced.inputs);
        watch.sampling.take(motion);
        watch.sampling.sample.contact_energy = [elastic, dissipated];
        watch.sampling.recorder.trajectory.data.clear();
        watch.sampling.push(motion);
        watch.fill(node);
    }

    /// A smooth piece of the motion begins at `time`, with the state in `y`: at the start of the run, or after an event.
    pub(super) fn watch_from(&mut self, motion: &mut Motion, time: f64) {
        let Some(mut looking) = self.looking.take() else {
            return;
        };
        if motion.evaluate_exactly(time, &self.y).is_ok() {
            let Looking {
                watch,
                episodes,
                here,
                happened,
                ..
            } = &mut *looking;
            self.fill(motion, watch, here);
            watch.offer(here, true);
            let mut told = 0;
            let count = self
                .histories
                .iter()
                .map(|history| history.episodes + history.switches)
                .sum();
            let is_new = std::mem::replace(happened, count) != count;
            for (contact, memory) in motion.reduced.inputs.contacts.iter().enumerate() {
                match (memory.phase != Phase::Flight, episodes.is_open(contact)) {
                    (true, false) => {
                        episodes.begin(contact, motion.reading(contact).normal, &here.row);
                        told += 1;
                    }
                    (false, true) => {
                        episodes.end(contact, &here.row);
                        told += 1;
                    }
                    (true, true) | (false, false) => {}
                }
            }
            if is_new && told == 0 {
                episodes.note(&here.row);
            }
            std::mem::swap(&mut watch.end, here);
            watch.ends = 1;
        }
        self.looking = Some(looking);
    }

    /// A contact may have been found to press more than before in its episode, at `time`, where the mechanism is evaluated.
    pub(super) fn watch_peak(
        &mut self,
        motion: &mut Motion,
        contact: usize,
        force: f64,
        time: f64,
    ) {
        let Some(mut looking) = self.looking.take() else {
            return;
        };
        let Looking {
            watch,
            episodes,
            here,
            ..
        } = &mut *looking;
        if episodes.rises(contact, force) && motion.evaluate_exactly(time, &self.y).is_ok() {
            self.fill(motion, watch, here);
            episodes.rise(contact, force, &here.row, true);
            watch.offer(here, true);
        }
        self.looking = Some(looking);
    }

    /// Looks at the last step, up to its event where there is one. The mechanism is evaluated at its end, which is in `y`.
    pub(super) fn watch_step(&mut self, motion: &mut Motion) {
        let Some(mut looking) = self.looking.take() else {
            return;
        };
        let (from, until) = (self.stepper.previous(), self.reached());
        let Looking {
            watch,
            episodes,
            here,
            ..
        } = &mut *looking;
        let rises = |contact: &usize| {
            motion.reduced.inputs.contacts[*contact].phase == Phase::Contact
                && episodes.rises(*contact, motion.reading(*contact).normal)
        };
        let rising: Vec<usize> = (0..self.histories.len()).filter(rises).collect();
        // Behind an event the motion is another one, and can't be evaluated before it any more.
        let wants_exact = self.pending.is_some();
        let is_exact = wants_exact && motion.evaluate_exactly(until, &self.y).is_ok();
        if wants_exact && !is_exact && self.evaluate_at(motion, until).is_err() {
            watch.ends = 0;
            self.looking = Some(looking);
            return;
        }
        self.fill(motion, watch, here);
        for contact in rising {
            episodes.rise(contact, motion.reading(contact).normal, &here.row, is_exact);
        }
        watch.offer(here, is_exact);
        // A step that was taken again for an output begins elsewhere.
        let goes_on =
            watch.end.time() == from || self.watch_again_from(motion, watch, from).is_ok();
        watch.advance();
        std::mem::swap(&mut watch.end, here);
        let is_final = watch.start_is_inexact() || episodes.is_inexact_at(from);
        if goes_on && is_final && self.look_at(motion, &mut looking, from, None).is_ok() {
            looking.episodes.make_exact(&looking.here.row);
        }
        if goes_on && until > from {
            // Where the mechanism can't be evaluated, the rows that there are count.
            let _ = self.look_within(motion, &mut looking, from, until);
        }
        self.looking = Some(looking);
    }

    /// The beginning of a step that does not begin where the last one ended.
    fn watch_again_from(
        &mut self,
        motion: &mut Motion,
        watch: &mut Watch,
        from: f64,
    ) -> Result<(), Fault> {
        self.evaluate_at(motion, from)?;
        let mut node = std::mem::take(&mut watch.end);
        self.fill(motion, watch, &mut node);
        watch.end = node;
        watch.ends = 1;
        Ok(())
    }

    /// Looks within a step where its ends are no reason to leave it.
    fn look_within(
        &mut self,
        motion: &mut Motion,
        looking: &mut Looking,
        from: f64,
        until: f64,
    ) -> Result<(), Fault> {
        // All of a piece within one step: its ends tell nothing.
        let is_all = !looking.watch.has_before() && self.pending.is_some();
        if !is_all && !looking.watch.is_suspicious() {
            return Ok(());
        }
        let places = within::points();
        let middle = POINTS / 2;
        // One point within tells most steps from those that matter.
        self.look_at(
            motion,
            looking,
            from + places[middle] * (until - from),
            Some(middle),
        )?;
        if !looking.watch.is_within(&looking.inner[middle]) {
            return Ok(());
        }
        for (k, place) in places.iter().enumerate().take(POINTS - 1).skip(1) {
            if k != middle {
                self.look_at(motion, looking, from + place * (until - from), Some(k))?;
            }
        }
        let Looking { watch, inner, .. } = looking;
        inner[0].values.clone_from(&watch.start.values);
        inner[POINTS - 1].values.clone_from(&watch.end.values);
        let mut tops = looking.tops();
        for _ in 0..MOST {
            let watch = &looking.watch;
            let gain = |&(quantity, side, _, value): &Top| {
                (SIDES[side] * (value - watch.extreme(quantity, side)))
                    / watch.near[quantity].max(f64::MIN_POSITIVE)
            };
            tops.retain(|top| gain(top) > 1.0);
            let best = (0..tops.len()).max_by(|&a, &b| gain(&tops[a]).total_cmp(&gain(&tops[b])));
            let Some(best) = best else { break };
            let top = tops.swap_remove(best);
            self.look_at(motion, looking, from + top.2 * (until - from), None)?;
            if looking.is_wrong(&top) {
                self.follow_up(motion, looking, &top, (from, until))?;
            }
        }
        Ok(())
    }

    /// The row at a time within the step, for extremes, and for a polynomial's point where it is one.
    fn look_at(
        &mut self,
        motion: &mut Motion,
        looking: &mut Looking,
        time: f64,
        point: Option<usize>,
    ) -> Result<(), Fault> {
        let known = self.stepper.interpolate(motion, time, &mut self.y);
        known.map_err(|refused| motion.refused(refused))?;
        motion.evaluate_exactly(time, &self.y)?;
        let Looking {
            watch, inner, here, ..
        } = looking;
        let node = match point {
            Some(point) => &mut inner[point],
            None => here,
        };
        self.fill(motion, watch, node);
        watch.offer(node, true);
        // Of a rigid journal that follows its bearing nothing else looks for peaks.
        for (contact, journal) in motion.system().contacts.iter().enumerate() {
            if matches!(journal.surface, Surface::Rigid(_)) {
                let reading = motion.reading(contact);
                if motion.reduced.inputs.contacts[contact].phase == Phase::Contact {
                    self.histories[contact].peak(reading.penetration, reading.normal);
                }
            }
        }
        Ok(())
    }

    /// Follows up a top by parabolas through evaluated rows.
    fn follow_up(
        &mut self,
        motion: &mut Motion,
        looking: &mut Looking,
        &(quantity, side, place, _): &Top,
        (from, until): (f64, f64),
    ) -> Result<(), Fault> {
        let (mut place, mut width) = (place, WIDTH);
        for _ in 0..PARABOLAS {
            let middle = place.clamp(width, 1.0 - width);
            let mut values = [0.0; 3];
            for (value, at) in values.iter_mut().zip([-1.0, 0.0, 1.0]) {
                self.look_at(
                    motion,
                    looking,
                    from + (middle + at * width) * (until - from),
                    None,
                )?;
                *value = SIDES[side] * looking.here.values[quantity];
            }
            place = within::vertex(values, middle, width);
            width *= NARROWER;
        }
        self.look_at(motion, looking, from + place * (until - from), None)
    }
}
