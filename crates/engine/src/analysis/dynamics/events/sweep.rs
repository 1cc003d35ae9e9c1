//! What comes and goes within a step: no guard may rise above zero between two evaluations and not be seen.
//!
//! The guards of contacts in flight, of formulas and of cams are smooth functions of time within a step. Between two samples
//! each is followed by the cubic of its values and rates, by a straight where no rates are known; how far that may be off is
//! measured at the samples beside and within ([`super::course`]). Where the bound is not above zero nothing happens. Elsewhere
//! the mechanism is evaluated where the guard is largest, until each part is either shown to be free of events or has one.
//! The guards of contacts that touch depend on forces: they are known at the evaluations alone.

use super::course::{Course, Doubt};
use super::locate::{Bracket, Point};
use crate::analysis::dynamics::fault::Fault;
use crate::analysis::dynamics::flow::{Flow, Sample};
use crate::analysis::dynamics::steps::LastStep;

/// Samples that are nearer to each other than this part of the step tell more of their own errors than of the course.
const APART: f64 = 0.08;
/// What is measured at a few times may be larger between them.
const SAFETY: f64 = 4.0;
/// A part of a course is known at least so much better than the whole.
const BETTER: f64 = 1.0 / 64.0;
/// Doubt of a course that nothing measures.
const UNKNOWN: f64 = 1e100;
/// Evaluations in a step at most; a step that needs more is too long.
const MOST: usize = 64;
/// How often a part of a step is divided.
const DEEPEST: usize = 24;
/// Where a guard is largest is not looked for nearer than this to the ends of a part.
const INSIDE: f64 = 0.1;

/// The guards at one time.
#[derive(Debug, Clone)]
struct Node {
    time: f64,
    largest: f64,
    samples: Vec<Sample>,
}

/// A guard that may be above zero in a part of the step.
#[derive(Debug, Clone, Copy)]
struct Open {
    /// The part between this evaluation and the next.
    part: usize,
    guard: usize,
    doubt: Doubt,
}

/// Looks through steps; it keeps its memory from one to the next.
#[derive(Debug, Default)]
pub struct Sweep {
    /// The first of them are the evaluations of the step, in the order of time.
    nodes: Vec<Node>,
    known: usize,
    opens: Vec<Open>,
    /// Evaluations that the step has taken.
    taken: usize,
}

impl Sweep {
    /// The first two times of the last step, before `until`, between which a guard rises above zero.
    ///
    /// # Errors
    /// Where the mechanism can't be evaluated within the step, or the step is too long.
    pub fn first(&mut self, step: &mut LastStep, until: f64) -> Result<Option<Bracket>, Fault> {
        self.taken = 0;
        self.gather(step.flow, (step.from(), step.to()));
        self.opens.clear();
        for guard in 0..step.flow.system().guards() {
            if self.may_rise(guard) {
                self.open(guard, until);
            }
        }
        self.opens.sort_by_key(|open| open.part);
        let opens = std::mem::take(&mut self.opens);
        let found = self.through(step, &opens, until);
        self.opens = opens;
        found
    }

    /// Evaluations of the last step at which the mechanism was for this alone.
    pub fn taken(&self) -> usize {
        self.taken
    }

    fn through(
        &mut self,
        step: &mut LastStep,
        opens: &[Open],
        until: f64,
    ) -> Result<Option<Bracket>, Fault> {
        for group in opens.chunk_by(|one, other| one.part == other.part) {
            let part = group[0].part;
            let [low, high] = [part, part + 1].map(|node| self.nodes[node].time.min(until));
            if low >= high {
                break;
            }
            let ends = [self.exactly(step, low)?, self.exactly(step, high)?];
            let exact = |open: &Open| {
                let of_ends = [false; 2];
                let doubt = Doubt {
                    of_ends,
                    ..open.doubt
                };
                Open { doubt, ..*open }
            };
            let group: Vec<Open> = group.iter().map(exact).collect();
            if let Some(bracket) = self.descend(step, [&ends[0], &ends[1]], &group, DEEPEST)? {
                return Ok(Some(bracket));
            }
        }
        Ok(None)
    }

    /// Takes the evaluations of the step, without those that are too near to others.
    fn gather(&mut self, flow: &Flow, (from, to): (f64, f64)) {
        self.known = 0;
        for (time, largest, samples) in flow.evaluations(from, to) {
            let is_end = time == from || time == to;
            let apart = if is_end { 0.0 } else { APART * (to - from) };
            let is_near = |node: &Node| (node.time - time).abs() <= apart;
            let is_close = !is_end && (time - from).min(to - time) < apart;
            if is_close || self.nodes[..self.known].iter().any(is_near) {
                continue;
            }
            if self.known == self.nodes.len() {
                let samples = Vec::with_capacity(samples.len());
                self.nodes.push(Node {
                    time,
                    largest,
                    samples,
                });
            }
            let node = &mut self.nodes[self.known];
            (node.time, node.largest) = (time, largest);
            node.samples.clear();
            node.samples.extend_from_slice(samples);
            self.known += 1;
        }
        self.nodes[..self.known].sort_by(|one, other| one.time.total_cmp(&other.time));
    }

    /// Whether a guard comes near to zero at all, by its largest value and its steepest rate at the evaluations.
    fn may_rise(&self, guard: usize) -> bool {
        let nodes = &self.nodes[..self.known];
        let mut most = f64::NEG_INFINITY;
        let (mut farthest, mut roomiest) = (0.0_f64, f64::NEG_INFINITY);
        for pair in nodes.windows(2) {
            let [one, other] = [&pair[0], &pair[1]].map(|node| &node.samples[guard]);
            let width = pair[1].time - pair[0].time;
            let steep = one.rate.abs().max(other.rate.abs()) * width;
            let steep = if steep.is_nan() { 0.0 } else { steep };
            farthest = farthest
                .max(steep)
                .max(2.0 * (other.value - one.value).abs());
            most = most.max(one.value).max(other.value);
            roomiest = roomiest.max(one.room).max(other.room);
        }
        most > f64::NEG_INFINITY && (most + farthest > 0.0 || nodes.len() < 3)
    }

    /// The parts of the step in which a guard may be above zero before a time at which none is.
    fn open(&mut self, guard: usize, until: f64) {
        let nodes = &self.nodes[..self.known];
        let course = |from: usize, to: usize| {
            let [from, to] = [&nodes[from], &nodes[to]];
            Course::new(
                &from.samples[guard],
                &to.samples[guard],
                to.time - from.time,
            )
        };
        let unknown = Doubt {
            value: UNKNOWN,
            room: UNKNOWN,
            ..Doubt::default()
        };
        // What the part is off by the evaluation at one of its ends, in the course between the two beside it.
        let by = |node: usize, width: f64| {
            if node == 0 || node + 1 >= nodes.len() {
                return None;
            }
            let around = course(node - 1, node + 1);
            let whole = nodes[node + 1].time - nodes[node - 1].time;
            let x = (nodes[node].time - nodes[node - 1].time) / whole;
            let missed = around.missed(&nodes[node].samples[guard], x);
            Some(around.doubt(missed, width / whole).times(SAFETY))
        };
        let parts = nodes.len().saturating_sub(1);
        for part in 0..parts {
            let width = nodes[part + 1].time - nodes[part].time;
            let mut doubt = match (by(part, width), by(part + 1, width)) {
                (Some(one), Some(other)) => one.max(other),
                (one, other) => one.or(other).unwrap_or(unknown),
            };
            doubt.of_ends = [part > 0, part + 1 < parts];
            let course = course(part, part + 1);
            // What rises up to a time at which it is not above zero was not so before.
            let is_last = nodes[part + 1].time >= until;
            if course.first(doubt).is_some() && !(is_last && course.rises(doubt)) {
                self.opens.push(Open { part, guard, doubt });
            }
            if is_last {
                break;
            }
        }
    }

    /// The guards at a time of the step, by its continuous extension.
    fn exactly(&mut self, step: &mut LastStep, time: f64) -> Result<Node, Fault> {
        self.taken += 1;
        step.evaluate(time)?;
        let mut samples = vec![Sample::never(); step.flow.system().guards()];
        let largest = step.flow.sample(&mut samples);
        Ok(Node {
            time,
            largest,
            samples,
        })
    }

    /// The same in a part of the step.
    fn descend(
        &mut self,
        step: &mut LastStep,
        [from, to]: [&Node; 2],
        opens: &[Open],
        depth: usize,
    ) -> Result<Option<Bracket>, Fault> {
        let width = to.time - from.time;
        let course = |guard: usize| Course::new(&from.samples[guard], &to.samples[guard], width);
        let is_open = |open: &&Open| course(open.guard).first(open.doubt).is_some();
        let opens: Vec<Open> = opens.iter().filter(is_open).copied().collect();
        let early = opens.iter().filter_map(|open| {
            let course = course(open.guard);
            Some((course.first(open.doubt)?, course))
        });
        let Some((x, first)) = early.reduce(|one, other| if other.0 < one.0 { other } else { one })
        else {
            return Ok(None);
        };
        let ends = [from, to].map(|node| Point {
            time: node.time,
            value: node.largest,
        });
        let [low, high] = ends;
        let bracket = (high.value > 0.0 && low.value <= 0.0).then_some(Bracket { low, high });
        let rises = |open: &Open| course(open.guard).rises(open.doubt);
        if depth == 0 || (bracket.is_some() && opens.iter().all(rises)) {
            return Ok(bracket);
        }
        if self.taken > MOST {
            return Err(Fault::Indivisible {
                t: step.from(),
                h: width,
            });
        }
        let x = first.summit(x).clamp(INSIDE, 1.0 - INSIDE);
        let middle = self.exactly(step, from.time + x * width)?;
        let of = |part: f64| {
            let known = |open: &Open| {
                let course = course(open.guard);
                let missed = course.missed(&middle.samples[open.guard], x).times(SAFETY);
                let doubt = course.doubt(missed, part).max(open.doubt.times(BETTER));
                Open { doubt, ..*open }
            };
            opens.iter().map(known).collect::<Vec<_>>()
        };
        let before = self.descend(step, [from, &middle], &of(x), depth - 1)?;
        if before.is_some() {
            return Ok(before);
        }
        if middle.largest > 0.0 {
            let high = Point {
                time: middle.time,
                value: middle.largest,
            };
            return Ok((low.value <= 0.0).then_some(Bracket { low, high }));
        }
        self.descend(step, [&middle, to], &of(1.0 - x), depth - 1)
    }
}
