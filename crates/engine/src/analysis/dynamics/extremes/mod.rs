//! The extremes of all columns in a motion with contacts, and the rows of contacts.
//!
//! A step that may hold an extreme is searched in two rounds: rows at fixed points of it give a polynomial per column ([`within`]); where
//! that exceeds the extreme so far, the mechanism is evaluated at its top. What counts is always a row that was evaluated.

mod episodes;
mod quantities;
mod watch;
mod within;

use super::fault::Fault;
use super::flow::Flow;
use super::ledger::Ledger;
use super::sampling::Sampling;
use super::settings::Settings;
use super::state::State;
use super::steps::LastStep;
use crate::element::pair::{Phase, Surface};
use crate::system::System;
use episodes::{Episodes, by_time, insert};
use linkdyn_output::Trajectory;
use watch::{Node, SIDES, Watch};
use within::POINTS;

/// How much larger a column may be between the points of a step than at them, in parts of the values' range.
const BETWEEN: f64 = 0.15;
/// Part of the values' range in a step by which a polynomial may be wrong at its top.
const WRONG: f64 = 1e-4;
/// Evaluations of one step after which the rest is left as it is.
const MOST: usize = 60;
/// Parabolas that follow up a top that the polynomial has wrong, their first width in parts of the step, and how much narrower
/// each is.
const PARABOLAS: usize = 5;
const WIDTH: f64 = 0.03;
const NARROWER: f64 = 0.2;

/// The extremes so far.
#[derive(Clone)]
pub struct Extremes {
    /// What fills rows.
    sampling: Sampling,
    watch: Watch,
    /// The rows of contacts.
    episodes: Episodes,
    /// The points within the step that give the polynomials.
    inner: [Node; POINTS],
    /// The row that was evaluated last.
    here: Node,
    /// Contacts and changes between stick and slip so far.
    happened: u64,
}

/// A top of a polynomial: quantity, side, place within the step, and value there.
type Top = (usize, usize, f64, f64);

/// The last step up to where it counts, and whether an event is there.
#[derive(Debug, Clone, Copy)]
pub struct StepPiece {
    /// Its beginning \[s\].
    pub from: f64,
    /// Its end, or the event \[s\].
    pub until: f64,
    /// Whether that is an event.
    pub has_event: bool,
}

impl StepPiece {
    /// A time by its place in the step, 0 … 1.
    fn at(&self, place: f64) -> f64 {
        self.from + place * (self.until - self.from)
    }
}

impl Extremes {
    /// For what is wanted of a motion, of the columns that these patterns keep.
    pub fn new(system: &System, settings: &Settings, watched: &[String]) -> Self {
        let sampling = Sampling::new(system, settings.contents, 1);
        let columns = &sampling.recorder.trajectory.columns;
        Extremes {
            watch: Watch::new(columns, watched),
            sampling,
            episodes: Episodes::new(system.contacts.len(), settings.events_are_outputs),
            inner: Default::default(),
            here: Node::default(),
            happened: 0,
        }
    }

    /// The row of the last evaluation, into `here`.
    fn fill(&mut self, flow: &mut Flow, state: &State, ledger: &Ledger) {
        let [dissipated, _] = ledger.energy(state);
        let evaluation = flow.equations.evaluation();
        let elastic = evaluation.contact_energy(flow.system(), &flow.equations.inputs);
        self.sampling.take(flow);
        self.sampling.sample.contact_energy = [elastic, dissipated];
        self.sampling.recorder.trajectory.data.clear();
        self.sampling.push(flow);
        let row = &self.sampling.recorder.trajectory.data;
        self.watch.fill(&mut self.here, row);
    }

    /// Contacts go on as others.
    pub fn hand_over(&mut self, handed: &[[usize; 2]]) {
        for &contacts in handed {
            self.episodes.hand_over(contacts);
        }
    }

    /// A smooth piece of the motion begins at `time`: at the start of the run, or after an event.
    pub fn begin_piece(&mut self, flow: &mut Flow, state: &State, ledger: &Ledger, time: f64) {
        if flow.evaluate_exactly(time, state.as_slice()).is_err() {
            return;
        }
        self.fill(flow, state, ledger);
        self.watch.offer(&self.here, true);
        let mut told = 0;
        let count = ledger.happened();
        let is_new = std::mem::replace(&mut self.happened, count) != count;
        let row = &self.here.row;
        for (contact, memory) in flow.memories().iter().enumerate() {
            match (
                memory.phase != Phase::Flight,
                self.episodes.is_open(contact),
            ) {
                (true, false) => {
                    self.episodes
                        .begin(contact, flow.reading(contact).normal, row);
                    told += 1;
                }
                (false, true) => {
                    self.episodes.end(contact, row);
                    told += 1;
                }
                (true, true) | (false, false) => {}
            }
        }
        if is_new && told == 0 {
            self.episodes.note(row);
        }
        std::mem::swap(&mut self.watch.end, &mut self.here);
        self.watch.ends = 1;
    }

    /// A contact may have been found to press more than before in its episode, at `time`, where the mechanism is evaluated.
    pub fn note_peak(&mut self, ledger: &Ledger, step: &mut LastStep, contact: usize, time: f64) {
        let LastStep { flow, state, .. } = step;
        let force = flow.reading(contact).normal;
        if self.episodes.rises(contact, force)
            && flow.evaluate_exactly(time, state.as_slice()).is_ok()
        {
            self.fill(flow, state, ledger);
            self.episodes.rise(contact, force, &self.here.row, true);
            self.watch.offer(&self.here, true);
        }
    }

    /// Searches the last step. The mechanism is evaluated at the end of the piece, with its state.
    pub fn note_step(&mut self, step: &mut LastStep, ledger: &mut Ledger, piece: StepPiece) {
        let StepPiece { from, until, .. } = piece;
        let rises = |contact: &usize| {
            let force = || step.flow.reading(*contact).normal;
            step.flow.is_in_contact(*contact) && self.episodes.rises(*contact, force())
        };
        let rising: Vec<usize> = (0..step.flow.memories().len()).filter(rises).collect();
        // Behind an event the motion is another one, and can't be evaluated before it any more.
        let at_end = |step: &mut LastStep| {
            let state = step.state.as_slice();
            step.flow.evaluate_exactly(until, state).is_ok()
        };
        let is_exact = piece.has_event && at_end(step);
        if piece.has_event && !is_exact && step.evaluate(until).is_err() {
            self.watch.ends = 0;
            return;
        }
        self.fill(step.flow, step.state, ledger);
        for contact in rising {
            let force = step.flow.reading(contact).normal;
            self.episodes.rise(contact, force, &self.here.row, is_exact);
        }
        self.watch.offer(&self.here, is_exact);
        // A step that was taken again for an output begins elsewhere.
        let end = std::mem::take(&mut self.here);
        let goes_on = self.watch.end.time() == from || self.begin_at(step, ledger, from).is_ok();
        self.watch.advance();
        self.here = std::mem::replace(&mut self.watch.end, end);
        let is_final = self.watch.start_is_inexact() || self.episodes.is_inexact_at(from);
        if goes_on && is_final && self.evaluate(step, ledger, from, None).is_ok() {
            self.episodes.make_exact(&self.here.row);
        }
        if goes_on && until > from {
            // Where the mechanism can't be evaluated, the rows that there are count.
            let _ = self.search_within(step, ledger, piece);
        }
    }

    /// The beginning of a step that does not begin where the last one ended.
    fn begin_at(&mut self, step: &mut LastStep, ledger: &Ledger, from: f64) -> Result<(), Fault> {
        step.evaluate(from)?;
        self.fill(step.flow, step.state, ledger);
        std::mem::swap(&mut self.watch.end, &mut self.here);
        self.watch.ends = 1;
        Ok(())
    }

    /// Searches within a step where its ends are no reason to leave it.
    fn search_within(
        &mut self,
        step: &mut LastStep,
        ledger: &mut Ledger,
        piece: StepPiece,
    ) -> Result<(), Fault> {
        // All of a piece within one step: its ends tell nothing.
        let is_all = !self.watch.has_before() && piece.has_event;
        if !is_all && !self.watch.is_suspicious() {
            return Ok(());
        }
        let places = within::points();
        let middle = POINTS / 2;
        // One point within tells most steps from those that matter.
        self.evaluate(step, ledger, piece.at(places[middle]), Some(middle))?;
        if !self.watch.is_within(&self.inner[middle]) {
            return Ok(());
        }
        for (k, place) in places.iter().enumerate().take(POINTS - 1).skip(1) {
            if k != middle {
                self.evaluate(step, ledger, piece.at(*place), Some(k))?;
            }
        }
        self.inner[0].values.clone_from(&self.watch.start.values);
        self.inner[POINTS - 1]
            .values
            .clone_from(&self.watch.end.values);
        let mut tops = self.tops();
        for _ in 0..MOST {
            let watch = &self.watch;
            let gain = |&(quantity, side, _, value): &Top| {
                (SIDES[side] * (value - watch.extreme(quantity, side)))
                    / watch.near[quantity].max(f64::MIN_POSITIVE)
            };
            tops.retain(|top| gain(top) > 1.0);
            let best = (0..tops.len()).max_by(|&a, &b| gain(&tops[a]).total_cmp(&gain(&tops[b])));
            let Some(best) = best else { break };
            let top = tops.swap_remove(best);
            self.evaluate(step, ledger, piece.at(top.2), None)?;
            if self.is_wrong(&top) {
                self.follow_up(step, ledger, piece, &top)?;
            }
        }
        Ok(())
    }

    /// The row at a time within the step, for extremes, and for a polynomial's point where it is one.
    fn evaluate(
        &mut self,
        step: &mut LastStep,
        ledger: &mut Ledger,
        time: f64,
        point: Option<usize>,
    ) -> Result<(), Fault> {
        step.evaluate_exactly(time)?;
        self.fill(step.flow, step.state, ledger);
        self.watch.offer(&self.here, true);
        if let Some(point) = point {
            std::mem::swap(&mut self.inner[point], &mut self.here);
        }
        // Of a sustained contact nothing else searches for peaks.
        for (contact, journal) in step.flow.system().contacts.iter().enumerate() {
            if matches!(journal.surface, Surface::Rigid(_)) && step.flow.is_in_contact(contact) {
                ledger.history(contact).peak(&step.flow.reading(contact));
            }
        }
        Ok(())
    }

    /// Tops of the polynomials that exceed the extremes so far.
    fn tops(&self) -> Vec<Top> {
        let mut tops = Vec::new();
        for quantity in 0..self.watch.len() {
            let values = self.inner.each_ref().map(|node| node.values[quantity]);
            let (low, high) = values
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                    (low.min(*value), high.max(*value))
                });
            for (side, sign) in SIDES.into_iter().enumerate() {
                let extreme = sign * self.watch.extreme(quantity, side);
                let largest = if side == 0 { -low } else { high };
                // Between such points it is no larger, unless it is none that a polynomial meets.
                if largest + BETWEEN * (high - low) > extreme + self.watch.near[quantity] {
                    let (place, value) = within::top(&values.map(|value| sign * value));
                    if value > extreme + self.watch.near[quantity] {
                        tops.push((quantity, side, place, sign * value));
                    }
                }
            }
        }
        tops
    }

    /// Whether the row that was evaluated last is not what the polynomial says of its top.
    fn is_wrong(&self, &(quantity, _, _, value): &Top) -> bool {
        let values = self.inner.iter().map(|node| node.values[quantity]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        (self.here.values[quantity] - value).abs()
            > WRONG * (high - low) + self.watch.near[quantity]
    }

    /// Follows up a top by parabolas through evaluated rows.
    fn follow_up(
        &mut self,
        step: &mut LastStep,
        ledger: &mut Ledger,
        piece: StepPiece,
        &(quantity, side, place, _): &Top,
    ) -> Result<(), Fault> {
        let (mut place, mut width) = (place, WIDTH);
        for _ in 0..PARABOLAS {
            let middle = place.clamp(width, 1.0 - width);
            let mut values = [0.0; 3];
            for (value, at) in values.iter_mut().zip([-1.0, 0.0, 1.0]) {
                self.evaluate(step, ledger, piece.at(middle + at * width), None)?;
                *value = SIDES[side] * self.here.values[quantity];
            }
            place = within::vertex(values, middle, width);
            width *= NARROWER;
        }
        self.evaluate(step, ledger, piece.at(place), None)
    }

    /// Puts rows at events into the outputs where they are wanted there, and gives the rows of peaks beside them.
    pub fn finish(self, outputs: &mut Trajectory) -> Trajectory {
        let (rows, are_outputs) = self.episodes.rows();
        let mut rows = by_time(rows);
        if are_outputs {
            insert(outputs, &rows);
            rows.clear();
        }
        rows.extend(
            self.watch
                .rows_beyond(outputs)
                .into_iter()
                .map(<[f64]>::to_vec),
        );
        let mut peaks = Trajectory::with_columns(&outputs.columns);
        by_time(rows).iter().for_each(|row| peaks.push_row(row));
        peaks
    }
}
