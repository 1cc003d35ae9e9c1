//! What comes and goes within a step: no guard may rise above zero between two evaluations and not be seen.
//!
//! The guards of contacts in flight, of formulas and of cams are smooth functions of time within a step. Between two samples
//! each is followed by the cubic of its values and rates, by a straight where no rates are known; how far that may be off is
//! measured at the samples beside and within ([`super::course`]). Where the bound is not above zero nothing happens. Elsewhere
//! the mechanism is evaluated where the guard is largest, until each part is either shown to be free of events or has one.
//!
//! A formula may bend more sharply than the motion does: it is computed at some times between two evaluations from the courses
//! of its arguments. The guards of contacts that touch depend on forces: they are known at the evaluations alone.

use super::course::{Course, Doubt};
use super::locate::{Bracket, GuardPoint};
use crate::analysis::dynamics::fault::Fault;
use crate::analysis::dynamics::flow::{Flow, Least, Mark, Sample};
use crate::analysis::dynamics::steps::LastStep;

/// Samples that are nearer to each other than this part of the step tell more of their own errors than of the course.
const APART: f64 = 0.08;
/// Parts between two evaluations at whose ends formulas are computed.
const FINER: u32 = 8;
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
/// What is shorter than this, in parts of the time, is an instant: times are round-off.
const INSTANT: f64 = 16.0 * f64::EPSILON;
/// Where a guard is largest is not looked for nearer than this to the ends of a part.
const INSIDE: f64 = 0.1;

/// The guards at one time.
#[derive(Debug, Clone, Default)]
struct GuardNode {
    time: f64,
    /// The largest of them, where the mechanism was evaluated for this.
    largest: f64,
    samples: Vec<Sample>,
    levels: Vec<[f64; 2]>,
}

impl GuardNode {
    fn take(&mut self, mark: &Mark) {
        self.time = mark.time;
        self.samples.clear();
        self.samples.extend_from_slice(mark.samples);
        self.levels.clear();
        self.levels.extend_from_slice(mark.levels);
    }

    fn point(&self) -> GuardPoint {
        GuardPoint {
            time: self.time,
            value: self.largest,
        }
    }
}

/// A guard that may be above zero between two times.
#[derive(Debug, Clone, Copy)]
struct OpenInterval {
    guard: usize,
    from: f64,
    to: f64,
    least: Least,
    doubt: Doubt,
}

impl OpenInterval {
    /// Its course between two evaluations.
    fn course(&self, from: &GuardNode, to: &GuardNode) -> Course {
        let samples = [from, to].map(|node| &node.samples[self.guard]);
        Course::new(samples, self.least, to.time - from.time)
    }
}

/// Looks through steps; it keeps its memory from one to the next.
#[derive(Debug, Clone, Default)]
pub struct Sweep {
    /// The first of them are the evaluations of the step, in the order of time.
    nodes: Vec<GuardNode>,
    known: usize,
    /// Times and samples of one guard.
    series: Vec<(f64, Sample)>,
    opens: Vec<OpenInterval>,
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
        if is_instant(step.from(), until) {
            return Ok(None);
        }
        self.gather(step.flow, (step.from(), step.to()));
        self.opens.clear();
        let system = step.flow.system();
        for guard in 0..system.guards() {
            if self.may_rise(guard) {
                self.follow(guard);
                if let Some((formula, arguments)) = system.formula_of(guard) {
                    self.follow_finer(step.flow, formula, arguments);
                }
                self.open(guard, step.flow.least(guard), until);
            }
        }
        self.opens
            .sort_by(|one, other| one.from.total_cmp(&other.from));
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
        opens: &[OpenInterval],
        until: f64,
    ) -> Result<Option<Bracket>, Fault> {
        let mut ends: [GuardNode; 2] = Default::default();
        for group in opens.chunk_by(|one, other| one.from == other.from && one.to == other.to) {
            let times = [group[0].from, group[0].to].map(|time| time.min(until));
            if times[0] >= times[1] {
                break;
            }
            for (end, time) in ends.iter_mut().zip(times) {
                if end.samples.is_empty() || end.time != time {
                    *end = self.exactly(step, time)?;
                }
            }
            let exact = |open: &OpenInterval| {
                let of_ends = [false; 2];
                let doubt = Doubt {
                    of_ends,
                    ..open.doubt
                };
                OpenInterval { doubt, ..*open }
            };
            let group: Vec<OpenInterval> = group.iter().map(exact).collect();
            if let Some(bracket) = self.descend(step, [&ends[0], &ends[1]], &group, DEEPEST)? {
                return Ok(Some(bracket));
            }
            ends.swap(0, 1);
        }
        Ok(None)
    }

    /// Takes the evaluations of the step, without those that are too near to others.
    fn gather(&mut self, flow: &Flow, (from, to): (f64, f64)) {
        self.known = 0;
        for mark in flow.evaluations(from, to) {
            let time = mark.time;
            let is_end = time == from || time == to;
            let apart = if is_end { 0.0 } else { APART * (to - from) };
            let is_near = |node: &GuardNode| (node.time - time).abs() <= apart;
            let is_close = !is_end && (time - from).min(to - time) < apart;
            if is_close || self.nodes[..self.known].iter().any(is_near) {
                continue;
            }
            if self.known == self.nodes.len() {
                self.nodes.push(GuardNode::default());
            }
            self.nodes[self.known].take(&mark);
            self.known += 1;
        }
        self.nodes[..self.known].sort_by(|one, other| one.time.total_cmp(&other.time));
    }

    /// Whether a guard comes near to zero at all, by its largest value and its steepest rate at the evaluations.
    fn may_rise(&self, guard: usize) -> bool {
        let nodes = &self.nodes[..self.known];
        let mut most = f64::NEG_INFINITY;
        let mut farthest = 0.0_f64;
        for pair in nodes.windows(2) {
            let [one, other] = [&pair[0], &pair[1]].map(|node| &node.samples[guard]);
            let width = pair[1].time - pair[0].time;
            let steep = one.rate.abs().max(other.rate.abs()) * width;
            let steep = if steep.is_nan() { 0.0 } else { steep };
            farthest = farthest
                .max(steep)
                .max(2.0 * (other.value - one.value).abs());
            most = most.max(one.value).max(other.value);
        }
        most > f64::NEG_INFINITY && (most + farthest > 0.0 || nodes.len() < 3)
    }

    /// Takes the samples of a guard.
    fn follow(&mut self, guard: usize) {
        self.series.clear();
        let nodes = self.nodes[..self.known].iter();
        let samples = nodes.map(|node| (node.time, node.samples[guard]));
        self.series.extend(samples);
    }

    /// Adds what a formula is between the evaluations, by the courses of its arguments.
    fn follow_finer(&mut self, flow: &Flow, formula: usize, arguments: std::ops::Range<usize>) {
        let mut levels = [0.0; crate::element::formula::MOST_ARGUMENTS];
        for pair in self.nodes[..self.known].windows(2) {
            let width = pair[1].time - pair[0].time;
            let [from, to] = [&pair[0], &pair[1]].map(|node| &node.levels[arguments.clone()]);
            for part in 1..FINER {
                let x = f64::from(part) / f64::from(FINER);
                for (level, (from, to)) in levels.iter_mut().zip(from.iter().zip(to)) {
                    let ends = [from, to].map(|[value, rate]| Sample {
                        rate: *rate,
                        ..Sample::of(*value)
                    });
                    *level = Course::new([&ends[0], &ends[1]], Least::default(), width).value_at(x);
                }
                let guard = flow.guard_at(formula, &levels[..arguments.len()]);
                self.series
                    .push((pair[0].time + x * width, Sample::of(guard)));
            }
        }
        self.series.sort_by(|one, other| one.0.total_cmp(&other.0));
    }

    /// Notes the parts of the step in which the guard at hand may be above zero before a time at which none is.
    fn open(&mut self, guard: usize, least: Least, until: f64) {
        let series = &self.series;
        let course = |from: usize, to: usize| {
            let [(from, one), (to, other)] = [&series[from], &series[to]];
            Course::new([one, other], least, to - from)
        };
        let unknown = Doubt {
            value: UNKNOWN,
            rooms: [UNKNOWN; 2],
            ..Doubt::default()
        };
        // What the part is off by the sample at one of its ends, in the course between the two beside it.
        let by = |index: usize, width: f64| {
            if index == 0 || index + 1 >= series.len() {
                return None;
            }
            let around = course(index - 1, index + 1);
            let whole = series[index + 1].0 - series[index - 1].0;
            let x = (series[index].0 - series[index - 1].0) / whole;
            let missed = around.missed(&series[index].1, x);
            Some(around.doubt(missed, width / whole).times(SAFETY))
        };
        let parts = series.len().saturating_sub(1);
        for part in 0..parts {
            let [from, to] = [part, part + 1].map(|index| series[index].0);
            let width = to - from;
            let mut doubt = match (by(part, width), by(part + 1, width)) {
                (Some(one), Some(other)) => one.max(other),
                (one, other) => one.or(other).unwrap_or(unknown),
            };
            doubt.of_ends = [part > 0, part + 1 < parts];
            let course = course(part, part + 1);
            // What rises up to a time at which it is not above zero was not so before.
            let is_last = to >= until;
            if course.first(doubt).is_some() && !(is_last && course.rises(doubt)) {
                self.opens.push(OpenInterval {
                    guard,
                    from,
                    to,
                    least,
                    doubt,
                });
            }
            if is_last {
                break;
            }
        }
    }

    /// The guards at a time of the step, by its continuous extension.
    fn exactly(&mut self, step: &mut LastStep, time: f64) -> Result<GuardNode, Fault> {
        self.taken += 1;
        step.evaluate(time)?;
        let mut samples = vec![Sample::never(); step.flow.system().guards()];
        let largest = step.flow.sample(&mut samples);
        Ok(GuardNode {
            time,
            largest,
            samples,
            levels: Vec::new(),
        })
    }

    /// The same in a part of the step.
    fn descend(
        &mut self,
        step: &mut LastStep,
        [from, to]: [&GuardNode; 2],
        opens: &[OpenInterval],
        depth: usize,
    ) -> Result<Option<Bracket>, Fault> {
        let width = to.time - from.time;
        let is_open = |open: &&OpenInterval| open.course(from, to).first(open.doubt).is_some();
        let opens: Vec<OpenInterval> = opens.iter().filter(is_open).copied().collect();
        let early = opens.iter().filter_map(|open| {
            let course = open.course(from, to);
            Some((course.first(open.doubt)?, course))
        });
        let early = early.reduce(|one, other| if other.0 < one.0 { other } else { one });
        let Some((x, first)) = early else {
            return Ok(None);
        };
        let [low, high] = [from.point(), to.point()];
        let bracket = (high.value > 0.0 && low.value <= 0.0).then_some(Bracket { low, high });
        let rises = |open: &OpenInterval| open.course(from, to).rises(open.doubt);
        let is_last = depth == 0 || is_instant(from.time, to.time);
        if is_last || (bracket.is_some() && opens.iter().all(rises)) {
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
            let known = |open: &OpenInterval| {
                let course = open.course(from, to);
                let missed = course.missed(&middle.samples[open.guard], x).times(SAFETY);
                let doubt = course.doubt(missed, part).max(open.doubt.times(BETTER));
                OpenInterval { doubt, ..*open }
            };
            opens.iter().map(known).collect::<Vec<_>>()
        };
        let before = self.descend(step, [from, &middle], &of(x), depth - 1)?;
        if before.is_some() {
            return Ok(before);
        }
        let high = middle.point();
        if high.value > 0.0 {
            return Ok((low.value <= 0.0).then_some(Bracket { low, high }));
        }
        self.descend(step, [&middle, to], &of(1.0 - x), depth - 1)
    }
}

fn is_instant(from: f64, to: f64) -> bool {
    to - from <= INSTANT * to.abs()
}
