//! A variant, found beside the nominal mechanism.
//!
//! ```text
//! q = q₀ + δ        the nominal mechanism at a station, and the difference
//! δ(t + h) ≈ δ + h δ̇ + h² δ̈/2     where Newton's iteration begins
//! ```
//!
//! or, from the third station on, by the quintic through δ, δ̇, δ̈ at the last two. Newton contracts at least fourfold from
//! step to step, det J keeps the sign of the nominal mechanism, and the prediction was good to 1e-5, or else the quintic
//! half-way between the stations is: so the variant moves between them as smoothly as the nominal mechanism, and no
//! singular position lies there. (Newton–Kantorovich, as in `continuation`.) At the first station the parameters go from
//! the nominal values to those of the variant, in steps where one does not do.

mod gradient;

use super::mechanisms::Mechanisms;
use super::needs::Depth;
use super::needs::{Room, State};
use super::track::{Middle, SMOOTH, Station, Track};
use crate::analysis::clearance_link::{balance, carried};
use crate::analysis::derived::Derived;
use crate::analysis::responses::{Evaluation, Responses};
use crate::analysis::sample::Sample;
use crate::mechanism::driven::{Aside, Driven};
use crate::system::{Inputs, System};
use linkdyn_linear::hermite::{Node, quintic};
use linkdyn_output::Report;

/// Contraction of Newton that proves the branch.
const CONTRACTION: f64 = 0.25;
/// Shortest step of the parameters, as part of the way.
const SHORTEST: f64 = 1.0 / 16.0;

/// One thread's variant.
pub struct PerturbedSolver<'f> {
    track: &'f Track,
    responses: &'f Responses,
    evaluation: Evaluation<'f>,
    /// Whether the motion between outputs matters.
    looks_between: bool,
    /// Whether the motion is kept for derivatives, and the values whose motion it is.
    keeps: bool,
    kept: Option<Vec<f64>>,
    solver: Option<Aside>,
    inputs: Inputs,
    sample: Sample,
    room: Room,
    start: Vec<f64>,
    /// δ, δ̇, δ̈ (n) at the station before and at this one.
    before: [Vec<f64>; 3],
    here: [Vec<f64>; 3],
    /// The motion at all stations, where what lies between matters.
    nodes: Vec<Node>,
    /// A position, and its correction (n); residuals (m).
    trial: Vec<f64>,
    step: Vec<f64>,
    residual: Vec<f64>,
    report: Report,
}

impl<'f> PerturbedSolver<'f> {
    pub fn new(track: &'f Track, system: &System, responses: &'f Responses) -> Self {
        let n = system.n();
        let zero = || vec![0.0; n];
        let three = || [zero(), zero(), zero()];
        PerturbedSolver {
            track,
            responses,
            evaluation: responses.begin(),
            looks_between: responses.look_between(),
            keeps: false,
            kept: None,
            nodes: Vec::new(),
            solver: Some(track.solver.clone()),
            inputs: Inputs::still(system),
            sample: Sample::new(system),
            room: track.needs.room(),
            start: zero(),
            before: three(),
            here: three(),
            trial: zero(),
            step: zero(),
            residual: vec![0.0; system.m()],
            report: Report::default(),
        }
    }

    /// Works out the responses; false where the variant is not proven to be like the nominal mechanism.
    pub fn run(
        &mut self,
        values: &[f64],
        mechanisms: &mut Mechanisms,
        responses: &mut [f64],
    ) -> bool {
        self.kept = None;
        let mut solver = self.solver();
        self.start.copy_from_slice(&self.track.stations[0].q);
        let (mut part, mut length) = (0.0, 1.0);
        let mut is_found = false;
        while part < 1.0 && length >= SHORTEST {
            let next = f64::min(part + length, 1.0);
            let Some(system) = mechanisms.at(values, next) else {
                break;
            };
            let mut driven = Driven::take_up(&system, solver);
            if self.begin(&mut driven) {
                part = next;
                if part == 1.0 {
                    mechanisms.tell(self.responses, &mut self.evaluation);
                    let mut derived = self.track.needs.derived(&system);
                    is_found = self.march(&mut driven, derived.as_mut());
                }
            } else {
                length *= 0.5;
            }
            solver = driven.set_aside();
        }
        self.solver = Some(solver);
        if is_found {
            self.evaluation.finish(&self.report, responses);
            self.kept = self.keeps.then(|| values.to_vec());
        }
        is_found
    }

    /// A solver as if nothing had been computed before.
    fn solver(&mut self) -> Aside {
        match self.solver.take() {
            Some(mut solver) => {
                if solver.pivots_chosen_anew() != self.track.solver.pivots_chosen_anew() {
                    solver.restore(&self.track.solver);
                }
                solver
            }
            None => self.track.solver.clone(),
        }
    }

    /// From where the start was found last, the one of this mechanism; whether it is found.
    fn begin(&mut self, driven: &mut Driven) -> bool {
        self.take(driven.system, &self.track.stations[0]);
        self.trial.copy_from_slice(&self.start);
        let is_found = proven(driven, &mut self.trial, &self.inputs).is_some();
        if is_found {
            self.start.copy_from_slice(&self.trial);
        }
        is_found
    }

    fn take(&mut self, system: &System, station: &Station) {
        self.inputs.time = station.instant.time;
        station.instant.drive(system, &mut self.inputs.drive);
    }

    /// Goes along all stations; whether the motion is like that of the nominal mechanism.
    fn march(&mut self, driven: &mut Driven, mut derived: Option<&mut Derived>) -> bool {
        let track = self.track;
        self.evaluation.restart();
        let (mut time, mut last) = (0.0, 0.0);
        for (index, station) in track.stations.iter().enumerate() {
            let h = station.instant.time - time;
            time = station.instant.time;
            let before = std::mem::replace(&mut last, h);
            match index {
                0 => self.sample.q.copy_from_slice(&self.start),
                1 => self.predict(station, h),
                _ => self.extrapolate(station, [before, h]),
            }
            self.take(driven.system, station);
            let Some(miss) = self.solve(driven, station) else {
                return false;
            };
            if station.is_output {
                self.record(driven, derived.as_deref_mut());
            }
            self.note(station);
            if self.looks_between || self.keeps {
                self.keep(index, time);
            }
            if let Some(middle) = &station.middle
                && (index == 1 || miss > SMOOTH)
                && !self.is_smooth(driven, middle, h)
            {
                return false;
            }
        }
        self.ask(driven, derived);
        true
    }

    /// Keeps the motion at a station.
    fn keep(&mut self, index: usize, time: f64) {
        let Sample { q, v, a, .. } = &self.sample;
        if self.nodes.len() == index {
            let zero = || vec![0.0; q.len()];
            let (s, q, d, dd) = (time, zero(), zero(), zero());
            self.nodes.push(Node { s, q, d, dd });
        }
        let node = &mut self.nodes[index];
        node.s = time;
        node.q.copy_from_slice(q);
        node.d.copy_from_slice(v);
        node.dd.copy_from_slice(a);
    }

    /// Looks for extremes and crossings between the outputs: the quintic between two stations is where Newton begins.
    fn ask(&mut self, driven: &mut Driven, mut derived: Option<&mut Derived>) {
        if !self.looks_between {
            return;
        }
        let PerturbedSolver {
            evaluation,
            nodes,
            track,
            sample,
            inputs,
            room,
            report,
            ..
        } = self;
        let system = driven.system;
        let positions = track.needs.depth(track.reactions) == Depth::Positions;
        evaluation.ask(report, &mut |time, wanted| {
            if !place(driven, nodes, time, inputs, &mut sample.q) {
                return false;
            }
            if !positions {
                if driven.factor(inputs).is_err() {
                    return false;
                }
                driven.velocity(inputs, &mut sample.v);
                driven.acceleration(inputs, &mut sample.a);
            }
            if track.reactions && !positions {
                balance(system, &driven.evaluation, inputs, sample);
                if carried(driven, inputs, sample).is_err() {
                    return false;
                }
            }
            let state = State {
                system,
                evaluation: &driven.evaluation,
                inputs,
                sample,
            };
            track.needs.read(state, derived.as_deref_mut(), room);
            wanted.extend_from_slice(&room.values);
            true
        });
    }

    /// Where the variant should be at a station.
    fn predict(&mut self, station: &Station, h: f64) {
        let [zeroth, first, second] = &self.here;
        for (k, q) in self.sample.q.iter_mut().enumerate() {
            *q = station.q[k] + zeroth[k] + h * (first[k] + 0.5 * h * second[k]);
        }
    }

    /// The same by the quintic through the last two stations.
    fn extrapolate(&mut self, station: &Station, [before, h]: [f64; 2]) {
        let ([q0, v0, a0], [q1, v1, a1]) = (&self.before, &self.here);
        let u = 1.0 + h / before;
        for (k, q) in self.sample.q.iter_mut().enumerate() {
            let (slope, bend) = (before * v0[k], 0.5 * before * before * a0[k]);
            let gap = q1[k] - (q0[k] + slope + bend);
            let turn = before * v1[k] - (slope + 2.0 * bend);
            let rest = before * before * a1[k] - 2.0 * bend;
            let [c3, c4, c5] = [
                10.0 * gap - 4.0 * turn + 0.5 * rest,
                -15.0 * gap + 7.0 * turn - rest,
                6.0 * gap - 3.0 * turn + 0.5 * rest,
            ];
            *q = station.q[k] + q0[k] + u * (slope + u * (bend + u * (c3 + u * (c4 + u * c5))));
        }
    }

    /// From the prediction; how far off it was [rad, sizes], and `None` if nothing is proven.
    fn solve(&mut self, driven: &mut Driven, station: &Station) -> Option<f64> {
        let Sample { q, v, a, .. } = &mut self.sample;
        let miss = proven(driven, q, &self.inputs)?;
        driven.factor(&self.inputs).ok()?;
        driven.velocity(&self.inputs, v);
        driven.acceleration(&self.inputs, a);
        if driven.determinant_sign() != station.sign {
            return None;
        }
        if self.track.reactions {
            balance(
                driven.system,
                &driven.evaluation,
                &self.inputs,
                &mut self.sample,
            );
            carried(driven, &self.inputs, &mut self.sample).ok()?;
        }
        Some(miss)
    }

    fn record(&mut self, driven: &Driven, derived: Option<&mut Derived>) {
        let state = State {
            system: driven.system,
            evaluation: &driven.evaluation,
            inputs: &self.inputs,
            sample: &self.sample,
        };
        self.track.needs.read(state, derived, &mut self.room);
        self.evaluation.row(&self.room.values);
    }

    /// Notes δ, δ̇, δ̈ at a station.
    fn note(&mut self, station: &Station) {
        std::mem::swap(&mut self.before, &mut self.here);
        let Sample { q, v, a, .. } = &self.sample;
        let pairs = [(q, &station.q), (v, &station.v), (a, &station.a)];
        for (difference, (own, nominal)) in self.here.iter_mut().zip(pairs) {
            for ((difference, own), nominal) in difference.iter_mut().zip(own).zip(nominal) {
                *difference = own - nominal;
            }
        }
    }

    /// Whether the quintic half-way from the station before meets the constraints.
    fn is_smooth(&mut self, driven: &mut Driven, middle: &Middle, h: f64) -> bool {
        let ([q0, v0, a0], [q1, v1, a1]) = (&self.before, &self.here);
        for (k, q) in self.trial.iter_mut().enumerate() {
            *q = middle.q[k]
                + 0.5 * (q0[k] + q1[k])
                + h * (5.0 / 32.0 * (v0[k] - v1[k]) + h / 64.0 * (a0[k] + a1[k]));
        }
        let system = driven.system;
        self.inputs.set_time(system, middle.time);
        driven.evaluation.set_position(&self.trial);
        driven.evaluation.eval_phi(system, &self.inputs);
        self.residual.copy_from_slice(&driven.evaluation.phi);
        driven.answer(&self.residual, &mut self.step);
        system.scaled_norm(&self.step) <= SMOOTH
    }
}

/// Position between the nodes of a motion; whether it is found.
pub fn place(
    driven: &mut Driven,
    nodes: &[Node],
    time: f64,
    inputs: &mut Inputs,
    q: &mut [f64],
) -> bool {
    let next = nodes
        .partition_point(|node| node.s < time)
        .clamp(1, nodes.len() - 1);
    quintic(&nodes[next - 1], &nodes[next], time, q, None);
    inputs.set_time(driven.system, time);
    driven.correct(q, inputs).is_ok()
}

/// Newton from `q`; its first step where the contraction proves the branch.
fn proven(driven: &mut Driven, q: &mut [f64], inputs: &Inputs) -> Option<f64> {
    let correction = driven.correct(q, inputs).ok()?;
    (correction.contraction <= CONTRACTION).then_some(correction.first_step)
}
