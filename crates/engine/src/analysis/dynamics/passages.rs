//! Change points that a motion passes, and the reactions that have no bound there.

use super::events::locate::{Bracket, GuardPoint, locate};
use super::fault::Fault;
use super::flow::Flow;
use super::sampling::Sampling;
use super::steps::LastStep;
use crate::analysis::channels::Contents;
use crate::analysis::unbounded::{DISTANCES, unbounded};
use crate::mechanism::reduced::ChangePoint;
use linkdyn_output::{Event, EventKind, Report, Unbounded};

/// Distance from a change point at which reactions are compared, in parts of its window's half width.
const BESIDE: f64 = 1e-3;
/// Part of a step's length to which a passage is located.
const NARROW: f64 = 1e-12;
/// Passages that are nearer to each other than this part of the time are one event.
const SAME: f64 = 1e-12;
/// More of them than anybody reads.
const MOST: usize = 1000;

/// The passages of a motion so far.
#[derive(Clone)]
pub struct Passages {
    contents: Contents,
    /// Where the mechanism was at the end of what was looked at (n).
    q: Vec<f64>,
    times: Vec<f64>,
    /// Change points that were passed, each with the columns that have no bound there, and when.
    passed: Vec<(ChangePoint, Unbounded)>,
}

impl Passages {
    /// None yet, at the point of the last evaluation; results have these contents.
    pub fn new(contents: Contents, flow: &Flow) -> Self {
        let mut passages = Passages {
            contents,
            q: Vec::new(),
            times: Vec::new(),
            passed: Vec::new(),
        };
        passages.begin(flow);
        passages
    }

    /// When the first one was \[s\].
    pub fn first(&self) -> Option<f64> {
        self.times.first().copied()
    }

    /// Those that nobody has been told.
    pub fn news(&mut self) -> impl Iterator<Item = Event> + '_ {
        let times = self.times.drain(..);
        times.map(|time| Event::at(EventKind::ChangePoint, time))
    }

    /// All go to the report.
    pub fn tell(self, report: &mut Report) {
        let mut times = self.times;
        times.sort_by(f64::total_cmp);
        // Parts may pass theirs together.
        times.dedup_by(|later, earlier| *later - *earlier <= SAME * *later);
        let events = times.iter();
        report
            .events
            .extend(events.map(|time| Event::at(EventKind::ChangePoint, *time)));
        report.events.sort_by(|a, b| a.time.total_cmp(&b.time));
        let passed = self.passed.iter().map(|(_, unbounded)| unbounded);
        let mut each: Vec<(f64, &[String])> = passed
            .flat_map(|Unbounded { columns, times }| times.iter().map(|time| (*time, &columns[..])))
            .collect();
        each.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (time, columns) in each {
            report.note_unbounded(columns, time);
        }
    }

    /// Those of the last step, as far as `until`, where the mechanism was evaluated last, and is again. What can't be evaluated is
    /// not told: it ends no motion.
    pub fn note(&mut self, step: &mut LastStep, until: f64) {
        let curves = step.flow.equations.curves();
        let mut has_left = false;
        for curve in 0..curves {
            let equations = &step.flow.equations;
            let value = |q: &[f64]| equations.coordinate(curve, q);
            let (Some(from), Some(to)) = (value(&self.q), value(equations.position())) else {
                continue;
            };
            // Nothing is allocated where there are none.
            let points: Vec<ChangePoint> = equations.change_points(curve, [from, to]).collect();
            let room = MOST.saturating_sub(self.times.len());
            for point in points.iter().take(room) {
                has_left = true;
                step.state.fit(step.flow.layout());
                let _ = self.pass(step, [from, to], until, point);
            }
        }
        if has_left {
            // It was evaluated there before.
            let _ = step.evaluate(until);
        }
        self.begin(step.flow);
    }

    /// Looks at what comes from here on.
    pub fn begin(&mut self, flow: &Flow) {
        self.q.clear();
        self.q.extend_from_slice(flow.equations.position());
    }

    /// One that may lie on the way of a step, from one value of its coordinate to another.
    fn pass(
        &mut self,
        step: &mut LastStep,
        way: [f64; 2],
        until: f64,
        point: &ChangePoint,
    ) -> Result<(), Fault> {
        let Some(time) = located(step, way, until, point)? else {
            return Ok(());
        };
        self.times.push(time);
        match self.passed.iter_mut().find(|(known, _)| known.is(point)) {
            Some((_, unbounded)) => unbounded.times.push(time),
            None => {
                let rate = (way[1] - way[0]) / (until - step.from());
                let columns = self.beside(step, BESIDE * point.width / rate.abs(), time)?;
                let times = vec![time];
                self.passed.push((*point, Unbounded { columns, times }));
            }
        }
        Ok(())
    }

    /// Columns without bound at a change point that the last step passes at this time, from what they are so near to it \[s\].
    fn beside(&self, step: &mut LastStep, near: f64, time: f64) -> Result<Vec<String>, Fault> {
        step.evaluate(time)?;
        let flow = &mut *step.flow;
        let f = flow.layout().freedom();
        let there = step.state.as_slice().to_vec();
        let accelerations = flow.equations.accelerations().to_vec();
        let system = flow.equations.own_system();
        let mut rows = Sampling::new(system, self.contents, DISTANCES.len());
        for part in DISTANCES {
            let (h, mut y) = (part * near, there.clone());
            for (k, a) in accelerations.iter().enumerate() {
                y[k] += h * (there[f + k] + 0.5 * h * a);
                y[f + k] += h * a;
            }
            // With friction from reactions that have no bound there may be no motion there.
            if flow.evaluate_exactly(time + h, &y).is_ok() {
                rows.take(flow);
                rows.push(flow);
            }
        }
        Ok(unbounded(&rows.recorder.trajectory))
    }
}

/// When the last step passes a change point, before `until` \[s\]; `None` if it does not.
fn located(
    step: &mut LastStep,
    [from, to]: [f64; 2],
    until: f64,
    point: &ChangePoint,
) -> Result<Option<f64>, Fault> {
    let sign = (to - from).signum();
    let off = |coordinate: f64| sign * (coordinate - point.s);
    if off(from) > 0.0 || off(to) <= 0.0 {
        return Ok(None);
    }
    let bracket = Bracket {
        low: GuardPoint {
            time: step.from(),
            value: off(from),
        },
        high: GuardPoint {
            time: until,
            value: off(to),
        },
    };
    let found = locate(bracket, NARROW * (until - step.from()), |time| {
        Ok::<_, Fault>(off(step.coordinate(point.curve, time)?))
    })?;
    Ok(Some(found.high.time))
}
