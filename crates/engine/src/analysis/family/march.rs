//! Variants, found side by side beside the nominal mechanism.
//!
//! ```text
//! q = q₀ + δ        the nominal mechanism at a station, and the difference
//! δ(t) ≈ Σ w δ      the polynomial through the stations before, at the first three also through δ̇, δ̈
//! ```
//!
//! besides what the slopes by the parameters tell (`guess`). There Newton's iteration begins. It contracts at least fourfold
//! from step to step, det J keeps the sign of the nominal mechanism, and the prediction was good to 1e-5, or else the
//! polynomial half-way between the stations meets the constraints as well: so the variant moves between them as smoothly as
//! the nominal mechanism, and no singular position lies there. (Newton–Kantorovich, as in `continuation`.) At the first
//! station the parameters go from the nominal values to those of the variant, in several steps where one is too far.
//!
//! A variant for which this is not proven is run as any model is.

use super::super::instants::OutputInstant;
use super::guess::{Guess, Interpolation, Motion, MotionSlopes};
use super::mechanisms::{Mechanisms, Variant};
use super::track::{SMOOTH, Track};
use crate::mechanism::abreast::{Abreast, Which, is_among, which};
use crate::motion::Jet;
use crate::system::System;
use linkdyn_linear::hermite::Node;
use linkdyn_linear::math::{Lanes, WIDTH};
use nalgebra::{SimdBool, SimdPartialOrd, SimdValue};
use std::sync::Arc;

/// Stations with rates at the beginning, where there are no others before.
const FIRST: usize = 3;
/// Parameters, and numbers of slopes by them, up to which these are learned.
const MOST_SLOPES: usize = 16;
const LARGEST_SLOPES: usize = 1 << 20;
/// Step to both sides of the nominal mechanism for that, as part of the parameters.
const SIDE: f64 = 1e-4;
/// Shortest step of the parameters, as part of the way.
const SHORTEST: f64 = 1.0 / 16.0;

/// Variants on their way.
pub struct VariantMarch<'f> {
    track: &'f Track,
    abreast: Abreast,
    /// The mechanisms, where they have been compiled.
    systems: [Arc<System>; WIDTH],
    drive: Vec<Jet>,
    /// How many stations have rates.
    with_rates: usize,
    /// Where the variants begin (n).
    start: Vec<Lanes>,
    /// How the motion goes on to each station, and half-way to it.
    guesses: Vec<[Guess; 2]>,
    between: Interpolation,
    /// A position (n).
    q: Vec<Lanes>,
    motion: Motion,
    /// Multipliers at all stations (m), where they are found side by side.
    lambda: Vec<Lanes>,
    /// Cosine and sine of the angle of each body at each station.
    turns: Vec<[Lanes; 2]>,
    /// Numbers of the variants, where these tell them.
    numbers: [Vec<f64>; WIDTH],
    /// How parameters differ from the nominal ones; none until it is known what that changes.
    offsets: Vec<Lanes>,
    has_learned: bool,
    /// The start by each parameter (n).
    start_by: Vec<Vec<f64>>,
}

/// A step of the parameters on the way to a variant.
#[derive(Clone, Copy)]
struct ParameterWay {
    part: f64,
    length: f64,
    is_open: bool,
}

impl<'f> VariantMarch<'f> {
    /// Along a track of a mechanism, with velocities and accelerations at all stations, or where they are needed.
    pub fn new(track: &'f Track, nominal: &System, with_rates: bool) -> Option<Self> {
        let (stations, n) = (&track.stations, nominal.n());
        let one = Arc::new(nominal.clone());
        let zero = |count: usize| vec![Lanes::ZERO; n * count];
        let with_rates = if with_rates {
            stations.len()
        } else {
            stations.len().min(FIRST)
        };
        let guesses = stations.iter().enumerate().map(|(index, station)| {
            let node = &station.node;
            let of = |until: usize, time, q: &[f64]| {
                Guess::beyond(&stations[..until], with_rates, time, q)
            };
            let middle = station.middle.as_ref();
            let middle = middle.map_or((node.s, &node.q), |middle| (middle.time, &middle.q));
            [
                of(index, node.s, &node.q),
                of(index + 1, middle.0, middle.1),
            ]
        });
        Some(VariantMarch {
            track,
            abreast: Abreast::new(nominal, track.solver.factors()?)?,
            systems: std::array::from_fn(|_| one.clone()),
            drive: vec![[0.0; 3]; nominal.drivers.len()],
            with_rates,
            start: zero(1),
            guesses: guesses.collect(),
            between: Interpolation::new(stations),
            q: zero(1),
            motion: [stations.len(), with_rates, with_rates].map(zero),
            lambda: Vec::new(),
            turns: vec![[Lanes::ZERO; 2]; nominal.bodies.len() * stations.len()],
            numbers: Default::default(),
            offsets: Vec::new(),
            has_learned: false,
            start_by: Vec::new(),
        })
    }

    /// Finds multipliers from now on, where nothing but weights pulls and all rates are known.
    pub fn weigh(&mut self) {
        if self.with_rates == self.track.stations.len() && self.abreast.weigh(&self.systems[0]) {
            self.lambda = vec![Lanes::ZERO; self.motion[0].len()];
        }
    }

    /// Takes the multipliers of one variant at a station, where they have been found; whether they have.
    pub fn multipliers(&self, lane: usize, station: usize, lambda: &mut [f64]) -> bool {
        let own = self
            .lambda
            .get(lambda.len() * station..)
            .unwrap_or_default();
        let pairs = lambda.iter_mut().zip(own);
        pairs.for_each(|(lambda, own)| *lambda = own.extract(lane));
        !own.is_empty()
    }

    /// Learns how the motion changes by each parameter, by variants to both sides of the nominal mechanism; nothing where that
    /// would be long.
    fn learn(&mut self, mechanisms: &mut Mechanisms) {
        self.has_learned = true;
        let (nominal, lengths) = mechanisms.nominal();
        let size = self.motion[0].len() * nominal.len();
        if nominal.len() > MOST_SLOPES || size > LARGEST_SLOPES {
            return;
        }
        let steps: Vec<f64> = lengths.iter().map(|length| SIDE * length).collect();
        let mut all = Vec::with_capacity(nominal.len());
        for (k, step) in steps.iter().enumerate() {
            let side = |sign: f64| {
                let mut own = nominal.to_vec();
                own[k] += sign * step;
                own
            };
            let sides = [side(1.0), side(-1.0)];
            let found = self.run(&sides.each_ref().map(|own| &own[..]), mechanisms);
            let weight = 0.5 / step;
            let is_known = found[0] && found[1] && weight.is_finite();
            let slope = |q: &Lanes| match is_known {
                true => weight * (q.extract(0) - q.extract(1)),
                false => 0.0,
            };
            let slopes = self
                .motion
                .each_ref()
                .map(|own| own.iter().map(slope).collect());
            all.push(slopes);
        }
        let n = self.start.len();
        self.start_by = all
            .iter()
            .map(|own: &MotionSlopes| own[0][..n].to_vec())
            .collect();
        for (index, [guess, _]) in self.guesses.iter_mut().enumerate() {
            guess.learn(index, &all);
        }
        self.offsets = vec![Lanes::ZERO; nominal.len()];
    }

    /// The mechanism at a place, where it has been compiled.
    pub fn system(&self, lane: usize) -> &Arc<System> {
        &self.systems[lane]
    }

    /// Its numbers, where these tell it.
    pub fn numbers(&self, lane: usize) -> &[f64] {
        &self.numbers[lane]
    }

    /// Takes the motion of one variant at a station to a node; its rates where they are known.
    pub fn node(&self, lane: usize, station: usize, node: &mut Node) {
        let n = node.q.len();
        node.s = self.track.stations[station].node.s;
        let to = [&mut node.q, &mut node.d, &mut node.dd];
        for (to, from) in to.into_iter().zip(&self.motion) {
            let from = from.get(n * station..).unwrap_or_default();
            to.iter_mut()
                .zip(from)
                .for_each(|(to, from)| *to = from.extract(lane));
        }
    }

    /// Cosine and sine of the angles of one variant at a station.
    pub fn turns(&self, lane: usize, station: usize) -> impl Iterator<Item = [f64; 2]> {
        let bodies = self.abreast.poses().len();
        let own = &self.turns[bodies * station..][..bodies];
        own.iter()
            .map(move |turn| turn.map(|own| own.extract(lane)))
    }

    /// Where one variant is expected to be between stations.
    pub fn guess(&self, lane: usize, time: f64, q: &mut [f64]) {
        let positions = (&self.motion[0][..], lane);
        self.between.write(&self.track.stations, positions, time, q);
    }

    /// Follows variants, as many as there is room for; which of them are proven to be like the nominal mechanism.
    pub fn run(&mut self, variants: &[&[f64]], mechanisms: &mut Mechanisms) -> [bool; WIDTH] {
        if !self.has_learned {
            self.learn(mechanisms);
        }
        let (nominal, _) = mechanisms.nominal();
        for (k, offset) in self.offsets.iter_mut().enumerate() {
            let own = variants.iter().enumerate();
            own.for_each(|(lane, values)| offset.replace(lane, values[k] - nominal[k]));
        }
        let begun = self.begin(variants, mechanisms);
        let found = self.follow(begun);
        std::array::from_fn(|lane| is_among(found, lane))
    }

    /// Takes the drivers' values at an instant.
    fn take(&mut self, instant: &OutputInstant) {
        let lanes = if self.track.changes.drivers { WIDTH } else { 1 };
        for (lane, system) in self.systems[..lanes].iter().enumerate() {
            instant.drive(system, &mut self.drive);
            for (all, own) in self.abreast.drive.iter_mut().zip(&self.drive) {
                for (all, own) in all.iter_mut().zip(own) {
                    match lanes {
                        1 => *all = Lanes::splat(*own),
                        _ => all.replace(lane, *own),
                    }
                }
            }
        }
    }

    /// Finds where variants begin; which have been found.
    fn begin(&mut self, variants: &[&[f64]], mechanisms: &mut Mechanisms) -> Which {
        let track = self.track;
        let first = &track.stations[0];
        for (start, q) in self.start.iter_mut().zip(&first.node.q) {
            *start = Lanes::splat(*q);
        }
        let way = |lane| ParameterWay {
            part: 0.0,
            length: 1.0,
            is_open: lane < variants.len(),
        };
        let mut ways: [ParameterWay; WIDTH] = std::array::from_fn(way);
        while ways.iter().any(|way| way.is_open) {
            let abreast = &mut self.abreast;
            for (lane, way) in ways.iter_mut().enumerate().filter(|(_, way)| way.is_open) {
                let next = f64::min(way.part + way.length, 1.0);
                let numbers = &mut self.numbers[lane];
                match mechanisms.make(variants[lane], next, numbers) {
                    Some(Variant::Numbers) => abreast.put_numbers(lane, numbers),
                    Some(Variant::System(system)) => {
                        abreast.put(lane, &system);
                        self.systems[lane] = system;
                    }
                    None => way.is_open = false,
                }
            }
            abreast.build();
            self.take(&first.instant);
            self.q.copy_from_slice(&self.start);
            self.step(&ways);
            let open = which(|lane| ways[lane].is_open);
            let corrected = self.abreast.correct(&mut self.q, open, None);
            for (start, found) in self.start.iter_mut().zip(&self.q) {
                *start = found.select(corrected.is_proven, *start);
            }
            for (lane, way) in ways.iter_mut().enumerate().filter(|(_, way)| way.is_open) {
                if is_among(corrected.is_proven, lane) {
                    way.part = f64::min(way.part + way.length, 1.0);
                    way.is_open = way.part < 1.0;
                } else {
                    way.length *= 0.5;
                    way.is_open = way.length >= SHORTEST;
                }
            }
        }
        which(|lane| ways[lane].part == 1.0)
    }

    /// Moves the start as the next step of the parameters does, as far as that is known.
    fn step(&mut self, ways: &[ParameterWay; WIDTH]) {
        let part = ways.map(|way| f64::min(way.length, 1.0 - way.part));
        let part = Lanes::from_arr(part);
        for (by, offset) in self.start_by.iter().zip(&self.offsets) {
            let offset = *offset * part;
            let q = self.q.iter_mut().zip(by);
            q.for_each(|(q, by)| *q += offset * Lanes::splat(*by));
        }
    }

    /// Goes along all stations; which variants move like the nominal mechanism.
    fn follow(&mut self, begun: Which) -> Which {
        let track = self.track;
        let n = self.start.len();
        let mut live = begun;
        let mut curvature = Lanes::splat(f64::INFINITY);
        for (index, station) in track.stations.iter().enumerate() {
            if !live.any() {
                break;
            }
            match index {
                0 => self.q.copy_from_slice(&self.start),
                _ => self.guesses[index][0].write(&self.motion, &self.offsets, &mut self.q),
            }
            self.take(&station.instant);
            let near = Some(&mut curvature);
            let corrected = self.abreast.correct(&mut self.q, live, near);
            let mut sign = corrected.sign;
            let own = n * index..n * (index + 1);
            let [q, v, a] = &mut self.motion;
            q[own.clone()].copy_from_slice(&self.q);
            let poses = self.abreast.poses();
            let turns = self.turns[poses.len() * index..].iter_mut().zip(poses);
            turns.for_each(|(turn, pose)| *turn = [pose.cos, pose.sin]);
            if index < self.with_rates {
                sign = self.abreast.factor();
                self.abreast.rates(&mut v[own.clone()], &mut a[own.clone()]);
                if let Some(lambda) = self.lambda.get_mut(own.clone()) {
                    self.abreast.multipliers(&a[own], lambda);
                }
            }
            live = live & corrected.is_proven & sign.simd_eq(Lanes::splat(station.sign));
            if let Some(middle) = &station.middle {
                let is_far = corrected.first_step.simd_gt(Lanes::splat(SMOOTH));
                let asked = if index == 1 { live } else { live & is_far };
                if asked.any() {
                    self.guesses[index][1].write(&self.motion, &[], &mut self.q);
                    let instant = OutputInstant {
                        time: middle.time,
                        exact: None,
                    };
                    self.take(&instant);
                    let is_smooth = self.abreast.miss(&self.q).simd_le(Lanes::splat(SMOOTH));
                    live = live & (!asked | is_smooth);
                }
            }
        }
        live
    }
}

#[cfg(test)]
mod tests {
    use crate::analysis::{Control, Family, Member};
    use crate::mechanism::abreast::{is_among, which};
    use crate::mechanism::driven::Driven;
    use crate::system::compile::compile;
    use crate::system::{Inputs, System};
    use linkdyn_linear::math::Lanes;
    use linkdyn_model::{AnalysisKind, Given, bundled, load};
    use nalgebra::SimdValue;

    /// Bundled mechanisms whose motion drivers prescribe, with pins, guides, gears and belts.
    const MODELS: [&str; 6] = [
        "four-bar",
        "slider-crank",
        "watt-i-lock",
        "quick-return",
        "geared-five-bar",
        "cam-roller",
    ];

    fn system(name: &str) -> System {
        let text = bundled::find(name).expect("a bundled model").text;
        let loaded = load(text.as_bytes(), &[]).expect("a model");
        compile(&loaded.model, AnalysisKind::Kinematics).expect("a system")
    }

    /// What comes out of a variant depends on its values alone: not on those beside it, nor on whether it was expected.
    #[test]
    fn a_variant_does_not_know_its_neighbours() {
        let text = bundled::find("four-bar").expect("a bundled model").text;
        for response in [
            "last(rocker.angle)",
            "range(coupler.x)",
            "max(rocker.omega)",
            "max(joint.a.f)",
        ] {
            let set = ["responses.r=".to_owned() + response];
            let loaded = load(text.as_bytes(), &set).expect("a model");
            let names = ["crank", "coupler", "rocker"];
            let family = Family::new(&loaded, &names, Given::Values).expect("a family");
            assert!(family.is_tracked());
            let value = |name: &str| {
                let mut all = loaded.parameters.iter();
                all.find(|one| one.name == name).expect(name).value
            };
            let nominal = names.map(value);
            // the third is none: its crank is longer than what it turns
            let parts = [1.0, 1.001, 40.0, 0.9, 1.02, 0.97];
            let variant = |k: usize| {
                [
                    nominal[0] * parts[k],
                    nominal[1] * (2.0 - parts[k]).max(0.5),
                    nominal[2],
                ]
            };
            let control = Control::default();
            let run = |member: &mut Member, k: usize| {
                let mut found = [0.0];
                let ended = member
                    .run(&variant(k), &control, &mut found)
                    .expect("a model");
                (ended.status, found[0].to_bits())
            };
            let alone: Vec<_> = (0..parts.len())
                .map(|k| run(&mut family.begin(), k))
                .collect();
            assert!(
                alone.iter().any(|(status, _)| *status != alone[0].0),
                "{response}"
            );
            for order in [[0, 1, 2, 3], [5, 2, 0, 4], [3, 3, 1, 2]] {
                let mut member = family.begin();
                let values = order.map(variant);
                member.expect(&values.each_ref().map(|own| &own[..]));
                for k in order {
                    assert_eq!(
                        run(&mut member, k),
                        alone[k],
                        "{response}: {k} among {order:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn side_by_side_is_as_alone() {
        for name in MODELS {
            let system = system(name);
            let start = Inputs::at_time(&system, 0.0);
            let assembled = crate::analysis::assembly::assemble(&system, &start);
            let q0 = assembled.unwrap_or_else(|_| panic!("{name} assembles")).q;
            let mut driven = Driven::new(&system, &q0, &start).expect("a regular start");
            let mut abreast = driven.abreast().expect(name);
            let times = [0.0, 0.001, 0.002, 0.003];
            let n = system.n();
            let mut q: Vec<Lanes> = q0.iter().map(|q| Lanes::splat(*q)).collect();
            let mut inputs = start.clone();
            for (lane, time) in times.into_iter().enumerate() {
                inputs.set_time(&system, time);
                for (all, own) in abreast.drive.iter_mut().zip(&inputs.drive) {
                    for (all, own) in all.iter_mut().zip(own) {
                        all.replace(lane, *own);
                    }
                }
            }
            let corrected = abreast.correct(&mut q, which(|lane| lane != 2), None);
            let zero = || vec![Lanes::ZERO; n];
            let (mut v, mut a) = (zero(), zero());
            abreast.factor();
            abreast.rates(&mut v, &mut a);
            for (lane, time) in times.into_iter().enumerate().filter(|(lane, _)| *lane != 2) {
                assert!(is_among(corrected.is_proven, lane), "{name} {lane}");
                inputs.set_time(&system, time);
                let mut own = q0.clone();
                driven.correct(&mut own, &inputs).expect("a position");
                driven.factor(&inputs).expect("factors");
                assert_eq!(
                    corrected.sign.extract(lane),
                    driven.determinant_sign(),
                    "{name}"
                );
                let (mut own_v, mut own_a) = (vec![0.0; n], vec![0.0; n]);
                driven.velocity(&inputs, &mut own_v);
                driven.acceleration(&inputs, &mut own_a);
                for (found, exact) in [(&q, own), (&v, own_v), (&a, own_a)] {
                    let size = linkdyn_linear::math::max_abs(&exact).max(1.0);
                    for (found, exact) in found.iter().zip(exact) {
                        let off = (found.extract(lane) - exact).abs();
                        assert!(off <= 1e-12 * size, "{name} {lane}: {off:e}");
                    }
                }
            }
        }
    }
}
