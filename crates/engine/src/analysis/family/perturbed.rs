//! Variants that move like the nominal mechanism: their responses, from the motion that the march finds.

mod gradient;

use super::march::VariantMarch;
use super::mechanisms::Mechanisms;
use super::needs::Depth;
use super::needs::{Room, State};
use super::track::Track;
use crate::analysis::clearance_link::{balance, carried};
use crate::analysis::derived::Derived;
use crate::analysis::responses::{Evaluation, Responses};
use crate::analysis::sample::Sample;
use crate::mechanism::driven::{Aside, Driven, LAST_STEP};
use crate::system::{Inputs, System};
use linkdyn_linear::hermite::{Node, quintic};
use linkdyn_linear::math::WIDTH;
use linkdyn_output::Report;

/// Newton step between stations, scaled [–], of which the square is below round-off.
const NEAR: f64 = 1e-9;

/// One thread's variants.
pub struct PerturbedSolver<'f> {
    track: &'f Track,
    responses: &'f Responses,
    evaluation: Evaluation<'f>,
    /// Whether the motion between outputs matters.
    looks_between: bool,
    /// Whether only the ends do.
    take_ends: bool,
    depth: Depth,
    /// Whether the motion is kept for derivatives, and the values whose motion it is.
    keeps: bool,
    kept: Option<Vec<f64>>,
    march: VariantMarch<'f>,
    /// Variants that have been followed: values, and whether they move like the nominal mechanism.
    followed: Vec<(Vec<f64>, bool)>,
    solver: Option<Aside>,
    inputs: Inputs,
    sample: Sample,
    room: Room,
    /// The motion of the variant at hand at all stations, where it is kept; else where it was read last.
    nodes: Vec<Node>,
    report: Report,
}

impl<'f> PerturbedSolver<'f> {
    pub fn new(track: &'f Track, system: &System, responses: &'f Responses) -> Option<Self> {
        let depth = track.needs.depth(track.reactions);
        let mut march = VariantMarch::new(track, system, depth > Depth::Positions)?;
        if depth == Depth::Forces {
            march.weigh();
        }
        Some(PerturbedSolver {
            track,
            responses,
            evaluation: responses.begin(),
            looks_between: responses.look_between(),
            take_ends: responses.take_ends(),
            depth,
            keeps: false,
            kept: None,
            march,
            followed: Vec::with_capacity(WIDTH),
            nodes: Vec::new(),
            solver: Some(track.solver.clone()),
            inputs: Inputs::still(system),
            sample: Sample::new(system),
            room: track.needs.room(),
            report: Report::default(),
        })
    }

    /// Follows variants side by side, at most as many as there is room for.
    pub fn follow(&mut self, variants: &[&[f64]], mechanisms: &mut Mechanisms) {
        let found = self.march.run(variants, mechanisms);
        self.followed.clear();
        let variants = variants.iter().map(|values| values.to_vec());
        self.followed.extend(variants.zip(found));
    }

    /// Works out the responses; false where the variant is not proven to be like the nominal mechanism.
    pub fn run(
        &mut self,
        values: &[f64],
        mechanisms: &mut Mechanisms,
        responses: &mut [f64],
    ) -> bool {
        self.kept = None;
        let known = |followed: &[(Vec<f64>, bool)]| {
            let mut followed = followed.iter();
            followed.position(|(own, _)| own == values)
        };
        let lane = known(&self.followed).unwrap_or_else(|| {
            self.follow(&[values], mechanisms);
            0
        });
        if !self.followed[lane].1 {
            return false;
        }
        mechanisms.tell(values, self.responses, &mut self.evaluation);
        let solver = self.solver();
        let compiled = self.march.system(lane).clone();
        let written = mechanisms.written(self.march.numbers(lane));
        let system = written.unwrap_or(&compiled);
        let mut driven = Driven::take_up(system, solver);
        let mut derived = self.track.needs.derived(system);
        let is_read = self.read(lane, &mut driven, derived.as_mut());
        self.solver = Some(driven.set_aside());
        if is_read {
            self.evaluation.finish(&self.report, responses);
            self.kept = self.keeps.then(|| values.to_vec());
        }
        is_read
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

    /// Reads the rows of a variant that was followed, and what lies between; false where its forces do not exist.
    fn read(
        &mut self,
        lane: usize,
        driven: &mut Driven,
        mut derived: Option<&mut Derived>,
    ) -> bool {
        let track = self.track;
        let carries = track.reactions
            && (self.depth == Depth::Forces || !driven.system.dependent_forces.is_empty());
        self.evaluation.restart();
        for (index, station) in track.stations.iter().enumerate() {
            if !station.is_output && !self.keeps {
                continue;
            }
            let is_end = index == 0 || index + 1 == track.stations.len();
            if self.take_ends && !is_end && !self.keeps && !carries {
                continue;
            }
            let place = if self.keeps { index } else { 0 };
            self.take(lane, index, place);
            if !station.is_output {
                continue;
            }
            let node = &self.nodes[place];
            self.inputs.time = station.instant.time;
            station.instant.drive(driven.system, &mut self.inputs.drive);
            self.sample.q.copy_from_slice(&node.q);
            let turns = self.march.turns(lane, index);
            driven.evaluation.set_poses(&node.q, turns);
            if self.depth > Depth::Positions || carries {
                self.sample.v.copy_from_slice(&node.d);
                self.sample.a.copy_from_slice(&node.dd);
                driven.evaluation.set_velocity(&node.d);
            }
            let is_carried =
                carries && self.march.multipliers(lane, index, &mut self.sample.lambda);
            if carries && !is_carried && !self.carry(driven) {
                return false;
            }
            self.record(driven, derived.as_deref_mut());
        }
        self.ask(lane, driven, derived);
        true
    }

    /// Takes the motion of a variant at a station to a node.
    fn take(&mut self, lane: usize, station: usize, place: usize) {
        if self.nodes.len() == place {
            let zero = || vec![0.0; self.sample.q.len()];
            let (q, d, dd) = (zero(), zero(), zero());
            self.nodes.push(Node { s: 0.0, q, d, dd });
        }
        self.march.node(lane, station, &mut self.nodes[place]);
    }

    /// Finds what joints carry; whether it exists.
    fn carry(&mut self, driven: &mut Driven) -> bool {
        let (inputs, sample) = (&self.inputs, &mut self.sample);
        if driven.factor(inputs).is_err() {
            return false;
        }
        balance(driven.system, &driven.evaluation, inputs, sample);
        carried(driven, inputs, sample).is_ok()
    }

    /// Looks for extremes and crossings between the outputs.
    fn ask(&mut self, lane: usize, driven: &mut Driven, mut derived: Option<&mut Derived>) {
        if !self.looks_between {
            return;
        }
        let PerturbedSolver {
            evaluation,
            march,
            track,
            sample,
            inputs,
            room,
            report,
            depth,
            ..
        } = self;
        let system = driven.system;
        // Stations around tell positions so well that what a first step leaves is round-off.
        (driven.measures_residual, driven.last_step) = (false, NEAR);
        let positions = *depth == Depth::Positions;
        evaluation.ask(report, &mut |time, wanted| {
            march.guess(lane, time, &mut sample.q);
            inputs.set_time(system, time);
            if driven.correct(&mut sample.q, inputs).is_err() {
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
        (driven.measures_residual, driven.last_step) = (true, LAST_STEP);
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
