//! From deviations that are had to others that carry the output farther, until none near by do.
//!
//! ```text
//! e ← P(e + α r² g)       α = Δe²/(−Δe·Δg), Δe by r      r what each source may be off, P to where it may
//! lacks = Σ max g·(e* − e)                                ≥ 0, and 0 where the output is stationary under all that is allowed
//! ```
//!
//! A projected gradient with the step of Barzilai and Borwein (1988; Birgin, Martínez and Raydan 2000), each e with its position
//! by Newton's method. α = ∞ presses each source to its end, as `worst` does all the time. Each step gains, so that nothing goes
//! to and fro. At last sources turn over to their other sides, all together and each alone, where the output bends up by more
//! than their influences say that it loses.

use super::displaced::{Mechanism, Stand};
use super::output::{Load, Output};
use super::search::add;
use super::source::{Influence, Play, length};

/// Most steps, and most tries of one.
const MOST_STEPS: usize = 300;
const MOST_TRIES: usize = 12;
/// A step gains at least this part of what the influences promise.
const GAINED: f64 = 1e-4;
/// What all sources lack may be this part of the deviation.
const STILL: f64 = 1e-11;
/// A place that lacks more than this part of its deviation is not stationary.
const STATIONARY: f64 = 1e-6;
/// Another side of a source is worth this part of the deviation, or it is the same.
const WORTH: f64 = 1e-10;
/// A source that carries the output no more than so many times what its influence changed by, or what the first order leaves out,
/// may carry it farther at another side: y = m e + k e²/2 does, where y′ < k r at the end r, and spans 2 r y′.
const TURNED: f64 = 3.0;
const LEFT_OUT: f64 = 4.0;
/// It spans less than so many times what y bends by where all of these turn over.
const BENT: f64 = 3.0;
/// There it gains this part of what the influences say that it loses, so far does the output bend up towards it.
const BENT_UP: f64 = 0.01;
/// Corrections of q and λ: most, the longest, and the last, in radians or sizes: the output lacks its square.
const MOST_PASSES: usize = 40;
const LONGEST: f64 = 0.3;
const DONE: f64 = 1e-10;

/// A displaced mechanism on the way.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub q: Vec<f64>,
    pub lambda: Vec<f64>,
    /// e of the plays.
    pub e: Vec<Influence>,
    /// Their influences, and the deviation.
    g: Vec<Influence>,
    pub y: f64,
}

/// The way to where an output is farthest to a side (±1).
pub(super) struct Climb<'a, 'm> {
    pub mechanism: &'a mut Mechanism<'m>,
    pub stand: &'a Stand,
    pub output: &'a Output,
    pub side: f64,
    /// The output at the nominal position.
    pub nominal: f64,
    /// The influences there; none at a change point.
    pub influences: Option<&'a [Influence]>,
}

impl Climb<'_, '_> {
    /// The top of the way from deviations (`e`) about a position, and what it lacks; none where none is found.
    pub fn from(&mut self, q: &[f64], e: &[Influence]) -> Option<(Place, f64)> {
        let start = Place {
            q: q.to_vec(),
            lambda: vec![0.0; self.mechanism.driven.system.m()],
            e: e.to_vec(),
            g: vec![[0.0; 2]; e.len()],
            y: 0.0,
        };
        self.factor(&start)?;
        let at = self.at(e, &start)?;
        let mut at = self.top(at);
        for _ in 0..2 * e.len() {
            let Some(next) = self.aside(&at) else { break };
            at = next;
        }
        let lacks = self.lacks(&at);
        (lacks <= STATIONARY * at.y.abs()).then_some((at, lacks))
    }

    /// On until no step gains any more.
    fn top(&mut self, mut at: Place) -> Place {
        let mut pace = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            if self.lacks(&at) <= STILL * at.y.abs() {
                break;
            }
            let to = self.pressed(&at, pace);
            let Some(next) = self.step(&at, &to) else {
                break;
            };
            pace = self.pace(&at, &next);
            at = next;
        }
        at
    }

    fn promise(&self, from: &Place, to: &[Influence], g: &[Influence]) -> f64 {
        self.side * promise(&from.e, to, g)
    }

    /// The most that influences promise: the output can't gain more, to first order.
    fn lacks(&self, at: &Place) -> f64 {
        let best = self.pressed(at, f64::INFINITY);
        self.promise(at, &best, &at.g).max(0.0)
    }

    /// Where the influences press the sources with a step of α.
    fn pressed(&self, at: &Place, pace: f64) -> Vec<Influence> {
        let each = self.mechanism.plays.iter().zip(&at.e).zip(&at.g);
        each.map(|((play, e), g)| play.pressed(*e, g.map(|g| self.side * g), pace))
            .collect()
    }

    /// Towards other deviations, as far as it gains.
    fn step(&mut self, at: &Place, to: &[Influence]) -> Option<Place> {
        self.factor(at)?;
        let promised = self.promise(at, to, &at.g);
        let mut part = 1.0;
        for _ in 0..MOST_TRIES {
            let between = |(e, to): (&Influence, &Influence)| match part {
                1.0 => *to,
                _ => [0, 1].map(|k| e[k] + part * (to[k] - e[k])),
            };
            let e: Vec<Influence> = at.e.iter().zip(to).map(between).collect();
            let shorter = match self.at(&e, at) {
                Some(there) if self.gain(at, &there) >= GAINED * part * promised => {
                    return Some(there);
                }
                // Where the promise of the straight line between both vanishes.
                Some(there) => promised / (promised - self.promise(at, to, &there.g)),
                None => 0.25,
            };
            part *= shorter.clamp(0.1, 0.5);
        }
        None
    }

    fn gain(&self, from: &Place, to: &Place) -> f64 {
        self.side * (to.y - from.y)
    }

    /// The step α that the last one asks for.
    fn pace(&self, from: &Place, to: &Place) -> f64 {
        let (mut square, mut bend) = (0.0, 0.0);
        for (k, play) in self.mechanism.plays.iter().enumerate() {
            let [first, second] = play.radii();
            for (axis, radius) in [first, second].into_iter().enumerate() {
                let by = to.e[k][axis] - from.e[k][axis];
                if by != 0.0 {
                    square += (by / radius).powi(2);
                    bend -= self.side * by * (to.g[k][axis] - from.g[k][axis]);
                }
            }
        }
        if bend > 0.0 {
            square / bend
        } else {
            f64::INFINITY
        }
    }

    /// Factors of J at a place.
    fn factor(&mut self, at: &Place) -> Option<()> {
        self.mechanism.take(&at.q, self.stand);
        self.mechanism.driven.factor(&self.stand.inputs).ok()
    }

    /// The position with these deviations, on from another whose factors are at hand; none where corrections do not lead there.
    fn at(&mut self, e: &[Influence], near: &Place) -> Option<Place> {
        let mechanism = &mut *self.mechanism;
        mechanism.chosen.extremes.copy_from_slice(e);
        if !mechanism.step_parameters() {
            return None;
        }
        let mut at = near.clone();
        let mut load = Load {
            lambda: std::mem::take(&mut at.lambda),
            size: 1.0,
        };
        let mut last = f64::INFINITY;
        for _ in 0..MOST_PASSES {
            let (size, leant) = mechanism.correct(self.stand, self.output, &mut at.q, &mut load);
            // Corrections that do not shrink lead elsewhere.
            let is_lost = size > 0.5 * last && size > DONE;
            if !(size + leant).is_finite() || size > LONGEST || is_lost {
                return None;
            }
            if size.max(leant) <= DONE {
                return Some(self.told(e, at, load));
            }
            last = size;
        }
        None
    }

    /// A place that was found, with what it is worth.
    fn told(&mut self, e: &[Influence], mut at: Place, load: Load) -> Place {
        let mechanism = &mut *self.mechanism;
        mechanism.take(&at.q, self.stand);
        mechanism.place(self.stand);
        mechanism.influences(self.stand, self.output, &load, &mut at.g);
        mechanism.gap(self.stand);
        let lacking = mechanism.lack(&load);
        at.y = mechanism.value(self.stand, self.output, 1.0) - self.nominal + lacking;
        at.e.copy_from_slice(e);
        at.lambda = load.lambda;
        at
    }

    /// On from where sources that are doubtful stand at another side, all or one of them, if that goes farther.
    fn aside(&mut self, at: &Place) -> Option<Place> {
        let nominal = self.influences?;
        self.factor(at)?;
        let load = Load {
            lambda: at.lambda.clone(),
            size: 1.0,
        };
        let turns = self.mechanism.turns(
            (self.stand, self.output),
            (&at.q, &at.e, &load),
            (&at.g, nominal),
            (self.side, at.y),
        );
        for e in turns {
            self.factor(at)?;
            let there = self.at(&e, at);
            let is_farther = |there: &Place| self.gain(at, there) > WORTH * at.y.abs();
            if let Some(there) = there.filter(is_farther).map(|there| self.top(there)) {
                return Some(there);
            }
        }
        None
    }
}

impl Mechanism<'_> {
    /// Deviations that may go farther to a side (±1) than a place with these influences and deviation, and factors that are at
    /// hand: sources that carry the output less far than what the first order leaves out, or than their influence changed by on
    /// the way, turn over, all together and each alone, where the output bends up towards that.
    pub fn turns(
        &mut self,
        of: (&Stand, &Output),
        (q, e, load): (&[f64], &[Influence], &Load),
        (g, nominal): (&[Influence], &[Influence]),
        (side, deviation): (f64, f64),
    ) -> Vec<Vec<Influence>> {
        let plays = self.plays;
        let span = |play: &Play, g: Influence| {
            let [down, up] = play.reach(g);
            up - down
        };
        let first = plays.iter().zip(nominal).map(|(play, g)| {
            let [down, up] = play.reach(*g);
            if side > 0.0 { up } else { down }
        });
        let left_out = (deviation - first.sum::<f64>()).abs();
        let is_weak = |&k: &usize| {
            let own = span(&plays[k], g[k]);
            let by = span(&plays[k], [0, 1].map(|axis| g[k][axis] - nominal[k][axis]));
            own <= (LEFT_OUT * left_out).max(TURNED * by) && own.max(by) > WORTH * deviation.abs()
        };
        let mut weak: Vec<usize> = (0..plays.len()).filter(is_weak).collect();
        let promise = |to: &[Influence]| side * promise(e, to, g);
        // What goes through the same joint turns over together; what carries the output farther than that bends it stays.
        let mut turns = Vec::new();
        while !weak.is_empty() {
            let mut all = e.to_vec();
            weak.iter().for_each(|&k| all[k] = plays[k].others(e[k])[0]);
            let bent = self.bent(of, (q, &all), load);
            let count = weak.len();
            weak.retain(|&k| span(&plays[k], g[k]) <= BENT * bent.abs() || bent.is_nan());
            if weak.len() == count {
                if count > 1 && bends_up(promise(&all), side * bent) {
                    turns.push(all);
                }
                break;
            }
        }
        for k in weak {
            for there in plays[k].others(e[k]) {
                let mut alone = e.to_vec();
                alone[k] = there;
                let bent = side * self.bent(of, (q, &alone), load);
                if bends_up(promise(&alone), bent) {
                    turns.push(alone);
                }
            }
        }
        turns
    }

    /// What the output bends by to other deviations, on from a position whose factors are at hand; NaN where that is not known.
    fn bent(
        &mut self,
        (stand, output): (&Stand, &Output),
        (q, e): (&[f64], &[Influence]),
        load: &Load,
    ) -> f64 {
        self.chosen.extremes.copy_from_slice(e);
        if !self.step_parameters() {
            return f64::NAN;
        }
        let mut q = q.to_vec();
        let [straight, bent] = [0, 1].map(|_| {
            self.take(&q, stand);
            self.place(stand);
            self.gap(stand);
            let lacking = self.lack(load);
            let reading = self.value(stand, output, 1.0) + lacking;
            self.step();
            add(&mut q, &self.space.step);
            reading
        });
        bent - straight
    }
}

/// What the influences promise of deviations that go elsewhere.
fn promise(from: &[Influence], to: &[Influence], g: &[Influence]) -> f64 {
    let each = from.iter().zip(to).zip(g);
    each.map(|((e, to), g)| g[0] * (to[0] - e[0]) + g[1] * (to[1] - e[1]))
        .sum()
}

/// Whether other deviations gain, or that is not known.
fn bends_up(promised: f64, bent: f64) -> bool {
    let gained = promised + bent;
    gained.is_nan() || gained > BENT_UP * promised.abs()
}

impl Play {
    /// How far it may be off, by number.
    fn radii(&self) -> [f64; 2] {
        match self {
            Play::Pin { clearance, .. } => [clearance[1]; 2],
            Play::Zone { radius, .. } => [*radius; 2],
            Play::Guided { half, length, .. } => [half[1], 2.0 * half[1] / length],
            Play::Sides { .. } | Play::Driver { .. } | Play::Parameter { .. } => {
                let ends = self.ends().unwrap_or_default();
                [0.5 * (ends[1] - ends[0]); 2]
            }
        }
    }

    /// The e nearest to e + α r² g of all that are allowed; with α = ∞ the one with the greatest g·e.
    fn pressed(&self, e: Influence, g: Influence, pace: f64) -> Influence {
        // What bends stands at an end, and goes to the other one alone.
        if matches!(self, Play::Parameter { bends: true, .. }) {
            return e;
        }
        if pace.is_infinite() {
            return if g == [0.0; 2] {
                e
            } else {
                self.extreme(g, 1.0)
            };
        }
        let radii = self.radii();
        let [a, b] = [0, 1].map(|k| e[k] + pace * radii[k] * radii[k] * g[k]);
        if let Some([low, high]) = self.ends() {
            return [a.clamp(low, high), 0.0];
        }
        if let Play::Guided { .. } = self {
            let [u, v] = [a / radii[0], b / radii[1]];
            let beyond = 0.5 * (u.abs() + v.abs() - 1.0);
            if beyond <= 0.0 {
                return [a, b];
            }
            let less = |u: f64| u.signum() * (u.abs() - beyond).clamp(0.0, 1.0);
            return [radii[0] * less(u), radii[1] * less(v)];
        }
        let scale = (radii[0] / length([a, b])).min(1.0);
        [scale * a, scale * b]
    }

    /// Other sides than the one where it is.
    fn others(&self, e: Influence) -> Vec<Influence> {
        match self.ends() {
            Some(ends) => {
                let other = ends.into_iter().filter(|end| *end != e[0]);
                other.map(|end| [end, 0.0]).collect()
            }
            None => vec![e.map(|e| -e)],
        }
    }
}
