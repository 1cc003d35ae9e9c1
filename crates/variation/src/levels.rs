//! The levels of accuracy at one pose.

use super::answer::{Contribution, PoseAccuracy};
use super::ascent::{Ascent, Farthest};
use super::displaced::{Asked, Mechanism};
use super::enclosure::{Enclosure, Region};
use super::limits::SAME;
use super::output::Load;
use super::path::Path;
use super::poses::NominalPose;
use super::source::{Acts, Kind, Pair, Room, dot, length};
use super::statistics::{Pins, capability};
use super::wanted::Levels;
use linkdyn_engine::analysis::clearance_link::forces_at_factors;
use linkdyn_engine::analysis::sample::Sample;

/// A question at one pose after the other.
pub(super) struct PoseAnalysis<'a> {
    mechanism: Mechanism<'a>,
    enclosure: Enclosure,
    sample: Sample,
}

/// What is known of an output at the nominal position.
struct Nominal {
    load: Load,
    g: Vec<Pair>,
}

impl<'a> PoseAnalysis<'a> {
    pub fn new(mechanism: Mechanism<'a>) -> PoseAnalysis<'a> {
        PoseAnalysis {
            enclosure: Enclosure::new(&mechanism),
            sample: Sample::new(mechanism.driven.system),
            mechanism,
        }
    }

    /// The levels requested, at one pose of the outputs with these numbers.
    pub fn answer(&mut self, outputs: &[usize], stand: &NominalPose) -> Vec<PoseAccuracy> {
        let question = self.mechanism.question;
        let system = self.mechanism.driven.system;
        let is_regular = self.mechanism.stand(stand) && stand.self_stress.is_none();
        let blank = PoseAccuracy::at(system, stand, f64::NAN);
        let mut poses = vec![blank; outputs.len()];
        // All that needs the nominal position comes first, for the farthest leaves it.
        let mut nominal = Vec::with_capacity(outputs.len());
        for (&index, pose) in outputs.iter().zip(&mut poses) {
            let of = question.asked(index, stand);
            pose.nominal = self.mechanism.value(of, 0.0);
            let known = is_regular.then(|| self.first_order(of, pose)).flatten();
            nominal.push(known);
        }
        if nominal.iter().any(Option::is_some) {
            self.press(stand, outputs, &nominal, &mut poses);
        }
        if question.levels == Levels::First {
            return poses;
        }
        let has_any = nominal.iter().any(Option::is_some);
        let region = has_any.then(|| self.enclosure.region(&mut self.mechanism, stand));
        let region = region.flatten();
        for ((&index, pose), known) in outputs.iter().zip(&mut poses).zip(&nominal) {
            let of = question.asked(index, stand);
            let bound = self.bound(of, pose, known.as_ref(), region.as_ref());
            pose.certified = bound.filter(|_| question.levels == Levels::Certified);
        }
        for ((&index, pose), known) in outputs.iter().zip(&mut poses).zip(&nominal) {
            let of = question.asked(index, stand);
            // Where the mechanism may leave the position, only what is reached step by step belongs to it.
            let stays = region.is_some();
            let found = [0, 1].map(|side| self.found(of, pose, known.as_ref(), (side, stays)));
            pose.take(system, found);
        }
        poses
    }

    fn bound(
        &mut self,
        of: Asked,
        pose: &PoseAccuracy,
        known: Option<&Nominal>,
        region: Option<&Region>,
    ) -> Option<[f64; 2]> {
        let first = (&known?.load, pose.first?);
        self.enclosure
            .bound(&mut self.mechanism, of, first, region?)
    }

    /// The farthest deviation to a side, lower or upper (0 or 1).
    fn found(
        &mut self,
        of: Asked,
        pose: &PoseAccuracy,
        known: Option<&Nominal>,
        (number, stays): (usize, bool),
    ) -> Option<Farthest> {
        let side = [-1.0, 1.0][number];
        let first = pose.first.map_or(0.0, |first| first[number]);
        // Where an output turns back, deviations may be stationary that go less far than none.
        let goes = |found: &Farthest| found.deviation * side >= 0.0 || first * side < 0.0;
        let mut ascent = Ascent {
            mechanism: &mut self.mechanism,
            of,
            side,
            nominal: pose.nominal,
            known: known.map(|known| (&known.load, &*known.g)),
        };
        if stays && let Some(found) = ascent.ascend_from_first_order().filter(goes) {
            return Some(found);
        }
        // At a change point the self-stress is the load that the equations balance without any on the output.
        let stress = of.stand.self_stress.clone().filter(|own| !own.is_empty());
        let load = match known {
            Some(known) => Some(known.load.times(side)),
            None => stress.map(|lambda| Load { lambda, size: 0.0 }),
        };
        let reached = load.and_then(|load| Path::new(ascent.mechanism, of, load, side).reach());
        let climbed = match &reached {
            Some(reached) => ascent.from(&reached.q, &reached.e),
            None => None,
        };
        let climbed = climbed.or_else(|| ascent.ascend_from_rest()).filter(goes);
        match (reached, climbed) {
            (Some(reached), Some(climbed)) => Some(reached.or_beyond(climbed, side)),
            (reached, climbed) => reached.or(climbed),
        }
    }

    /// Influences, contributions and spread of an output at a pose that was taken; `None` if it has no first order.
    fn first_order(&mut self, of: Asked, pose: &mut PoseAccuracy) -> Option<Nominal> {
        let load = self.mechanism.load(of)?;
        let mut g = vec![[0.0; 2]; self.mechanism.sources.len()];
        self.mechanism.influences(of, &load, &mut g);
        let pins = self.mechanism.question.pins;
        let sources = self.mechanism.sources.iter().zip(&g);
        let by = sources.map(|(source, g)| {
            let [mean, variance] = source.moments(*g, pins);
            let sensitivity = match source.room {
                Room::Disc(_) => length(*g),
                Room::Line(_) | Room::Guide { .. } => g[0],
            };
            let by = Contribution {
                sensitivity,
                reach: source.room.reach(*g),
                variance,
            };
            (by, mean)
        });
        pose.contribute(by.collect());
        Some(Nominal { load, g })
    }

    /// Where the loads of the motion press the journals, and what limits say of the spread, which may follow from it.
    fn press(
        &mut self,
        stand: &NominalPose,
        outputs: &[usize],
        nominal: &[Option<Nominal>],
        poses: &mut [PoseAccuracy],
    ) {
        let question = self.mechanism.question;
        let is_known = self.load_of_motion(stand);
        for ((&index, pose), known) in outputs.iter().zip(poses).zip(nominal) {
            let known = known.as_ref().filter(|_| is_known);
            pose.pressed = known.and_then(|known| self.pressed(&known.g));
            let Some([mean, sigma]) = &mut pose.moments else {
                continue;
            };
            if let (Pins::Load, Some(pressed)) = (question.pins, pose.pressed) {
                *mean += pressed;
            }
            let limits = question.outputs[index].limits;
            pose.capability = limits.and_then(|limits| capability(limits, *mean, *sigma));
        }
    }

    /// Forces of the motion, in the sample; whether they are known: not without masses or friction's history.
    fn load_of_motion(&mut self, stand: &NominalPose) -> bool {
        let mechanism = &mut self.mechanism;
        let is_known = mechanism.driven.system.masses_known;
        if !is_known
            || !mechanism
                .sources
                .iter()
                .any(|source| source.pin().is_some())
        {
            return is_known;
        }
        self.sample.q.copy_from_slice(&stand.q);
        forces_at_factors(&mut mechanism.driven, &stand.inputs, &mut self.sample).is_ok()
    }

    /// Deviation with the journals where the loads of the motion press them.
    fn pressed(&self, g: &[Pair]) -> Option<f64> {
        let mut deviation = 0.0;
        for (source, g) in self.mechanism.sources.iter().zip(g) {
            if let Some((row, clearance)) = source.pin() {
                let force = [self.sample.lambda[row], self.sample.lambda[row + 1]];
                let size = length(force);
                if size > 0.0 {
                    // The journal presses the bearing against the force that it feels.
                    deviation -= clearance * dot(*g, force) / size;
                }
            }
        }
        deviation.is_finite().then_some(deviation)
    }
}

impl super::source::Source {
    /// First row and greatest clearance of a pin.
    fn pin(&self) -> Option<(usize, f64)> {
        match (&self.acts, self.room, self.kind) {
            (Acts::Row(row), Room::Disc(radius), Kind::Clearance { .. }) => Some((*row, radius)),
            _ => None,
        }
    }
}

impl Farthest {
    /// The farther one of what was reached and what was climbed to, with what is needed on the way to the first.
    fn or_beyond(mut self, climbed: Farthest, side: f64) -> Farthest {
        if side * (climbed.deviation - self.deviation) < -SAME * self.deviation.abs() {
            return self;
        }
        if let Some([reached, _]) = self.needed.last_mut() {
            *reached = climbed.deviation;
        }
        Farthest {
            needed: self.needed,
            ..climbed
        }
    }
}

impl Load {
    /// The load times a number.
    fn times(&self, factor: f64) -> Load {
        Load {
            lambda: self.lambda.iter().map(|l| l * factor).collect(),
            size: self.size * factor,
        }
    }
}
