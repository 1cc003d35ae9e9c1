//! The worst that can be found: deviations that carry the output farther and farther, until none near by do.
//!
//! ```text
//! φ(q) + B e = 0,   J(q)ᵀ λ = ∂y(q),   g = −Bᵀλ              q and λ by Newton's method with the factors of the place before
//! e ← P(e + α r² g)      α = Δe²/(−Δe·Δg), Δe by r          r what each source may be off, P to where it may
//! lacks = Σ max g·(e* − e)                                  ≥ 0, and 0 where the output is stationary under all that is allowed
//! ```
//!
//! α = ∞ presses each source to where its influence asks: a pin to the rim where the unit load on the output presses it, as a
//! massless link. From the nominal position this is done while q and λ are corrected, and mostly settles at once. From there on it is
//! a projected gradient with the step of Barzilai and Borwein (1988; Birgin, Martínez and Raydan 2000) and a line search that never
//! lets y fall. At last sources turn over to their other sides, several together and each alone: there the output may go farther by
//! the second order. A stationary output is no proof that there is no farther one; see `enclosure` for that.

use super::displaced::{Asked, Mechanism};
use super::limits::{DONE, LONGEST, MOST_PASSES, MOST_STEPS, SAME, left};
use super::output::Load;
use super::source::{Pair, dot};

/// Passes in which sources are pressed while the position is corrected: each shrinks what is left by a thousand and more, else the
/// line search has to do it.
const PRESSES: usize = 6;
/// A step gains at least this part of what the influences promise (Armijo): small, so that only what hardly gains is shortened.
const GAINED: f64 = 1e-4;
/// What all sources lack may be this part of the deviation. Near a change point a deviation is wrong by ten thousand times what
/// its sources lack; steps that round-off keeps from gaining end the ascent before.
const STILL: f64 = 1e-13;
/// A place that lacks more than this part of its deviation is not stationary: no digit that is printed may be open.
const STATIONARY: f64 = 1e-6;
/// A source may go farther at another side if it spans no more than so many times what the first order leaves out, or what its
/// influence changed by: y = m e + k e²/2 does where y′ < k r at the end r, and spans 2 r y′; twice that, for what others add.
const WEAK: f64 = 4.0;

/// Where the output is carried farthest.
#[derive(Debug, Clone)]
pub(super) struct Farthest {
    /// Deviation of the output [rad or m].
    pub deviation: f64,
    /// Coordinates there (n), and e of the sources.
    pub q: Vec<f64>,
    pub e: Vec<Pair>,
    /// What the sources could still gain, to first order; NaN where that is not known.
    pub lacks: f64,
    /// On the way there: deviations with the share of the sources that each needs; empty where they were not followed.
    pub needed: Vec<[f64; 2]>,
}

/// A displaced mechanism on the way: coordinates, multipliers of a unit load on the output, deviations of the sources with their
/// influences, and the deviation of the output.
#[derive(Debug, Clone)]
struct Place {
    q: Vec<f64>,
    lambda: Vec<f64>,
    e: Vec<Pair>,
    g: Vec<Pair>,
    y: f64,
}

/// The ascent of an output to a side (±1).
pub(super) struct Ascent<'a, 'm> {
    pub mechanism: &'a mut Mechanism<'m>,
    pub of: Asked<'a>,
    pub side: f64,
    /// The output at the nominal position, and there the load on it with the influences; none at a change point.
    pub nominal: f64,
    pub known: Option<(&'a Load, &'a [Pair])>,
}

impl Ascent<'_, '_> {
    /// From the deviations that the influences at the nominal position ask for, or `None` if corrections do not lead there.
    pub fn ascend_from_first_order(&mut self) -> Option<Farthest> {
        let (load, g) = self.known?;
        self.mechanism.factor(&self.of.stand.q, self.of.stand)?;
        let mut start = self.start(&self.of.stand.q, load.lambda.clone());
        start.e = self.pressed(&start.e, g);
        let at = self.settle(&start, &start.e, PRESSES)?;
        self.peak(at)
    }

    /// From deviations that were found another way, else from none.
    pub fn from(&mut self, q: &[f64], e: &[Pair]) -> Option<Farthest> {
        let lambda = vec![0.0; self.mechanism.driven.system.m()];
        let start = self.start(q, lambda);
        self.mechanism.factor(q, self.of.stand)?;
        let at = self.settle(&start, e, 0)?;
        self.peak(at)
    }

    /// From where nothing is off.
    pub fn ascend_from_rest(&mut self) -> Option<Farthest> {
        let rest: Vec<Pair> = self
            .mechanism
            .sources
            .iter()
            .map(|own| own.room.rest())
            .collect();
        self.from(&self.of.stand.q, &rest)
    }

    fn start(&self, q: &[f64], lambda: Vec<f64>) -> Place {
        let sources = self.mechanism.sources;
        Place {
            q: q.to_vec(),
            lambda,
            e: sources.iter().map(|source| source.room.rest()).collect(),
            g: vec![[0.0; 2]; sources.len()],
            y: 0.0,
        }
    }

    /// On from a place until neither a step nor another side of sources goes farther.
    fn peak(&mut self, at: Place) -> Option<Farthest> {
        let mut at = self.top(at);
        for _ in 0..2 * at.e.len() {
            let Some(next) = self.aside(&at) else { break };
            at = next;
        }
        let lacks = self.lacks(&at);
        (lacks <= STATIONARY * at.y.abs()).then_some(Farthest {
            deviation: at.y,
            q: at.q,
            e: at.e,
            lacks,
            needed: Vec::new(),
        })
    }

    /// On until no step gains any more.
    fn top(&mut self, mut at: Place) -> Place {
        let mut pace = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            if self.lacks(&at) <= STILL * at.y.abs() {
                break;
            }
            let to = self.ahead(&at, pace);
            let Some(next) = self.step(&at, &to) else {
                break;
            };
            pace = self.pace(&at, &next);
            at = next;
        }
        at
    }

    /// What influences promise of other deviations.
    fn promise(&self, g: &[Pair], from: &[Pair], to: &[Pair]) -> f64 {
        let each = g.iter().zip(from).zip(to);
        let gains = each.map(|((g, from), to)| dot(*g, [to[0] - from[0], to[1] - from[1]]));
        self.side * gains.sum::<f64>()
    }

    /// The most that influences promise: the output can't gain more, to first order.
    fn lacks(&self, at: &Place) -> f64 {
        self.promise(&at.g, &at.e, &self.ahead(at, f64::INFINITY))
            .max(0.0)
    }

    /// Where influences press the sources; those without stay.
    fn pressed(&self, e: &[Pair], g: &[Pair]) -> Vec<Pair> {
        let each = self.mechanism.sources.iter().zip(e).zip(g);
        let to = each.map(|((source, e), g)| {
            let end = source.room.extreme(g.map(|g| self.side * g));
            end.unwrap_or(*e)
        });
        to.collect()
    }

    /// Where the influences press the sources with a step of α; what is curved goes to its ends alone (`aside`).
    fn ahead(&self, at: &Place, pace: f64) -> Vec<Pair> {
        let mut to = self.pressed(&at.e, &at.g);
        let each = self.mechanism.sources.iter().zip(&at.e).zip(&at.g);
        for (((source, e), g), to) in each.zip(&mut to) {
            if source.is_curved() {
                *to = *e;
            } else if pace.is_finite() {
                let radii = source.room.radii();
                let by = |k: usize| pace * radii[k] * radii[k] * self.side * g[k];
                *to = source.room.nearest([0, 1].map(|k| e[k] + by(k)));
            }
        }
        to
    }

    /// Towards other deviations, as far as it gains.
    fn step(&mut self, at: &Place, to: &[Pair]) -> Option<Place> {
        self.mechanism.factor(&at.q, self.of.stand)?;
        let promised = self.promise(&at.g, &at.e, to);
        let mut part = 1.0;
        while part > DONE {
            let between = |(e, to): (&Pair, &Pair)| match part {
                1.0 => *to,
                _ => [0, 1].map(|k| e[k] + part * (to[k] - e[k])),
            };
            let e: Vec<Pair> = at.e.iter().zip(to).map(between).collect();
            let shorter = match self.settle(at, &e, 0) {
                Some(there) if self.gain(at, &there) >= GAINED * part * promised => {
                    return Some(there);
                }
                // Where the promise of the straight line between both vanishes.
                Some(there) => promised / (promised - self.promise(&there.g, &at.e, to)),
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
        for (k, source) in self.mechanism.sources.iter().enumerate() {
            for (axis, radius) in source.room.radii().into_iter().enumerate() {
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

    /// The place with these deviations, on from another whose factors are at hand; in the first passes (`presses`) sources go on to
    /// where their influences ask. `None` if corrections do not lead there.
    fn settle(&mut self, near: &Place, e: &[Pair], presses: usize) -> Option<Place> {
        let mut at = near.clone();
        at.e.copy_from_slice(e);
        let mut load = Load {
            lambda: std::mem::take(&mut at.lambda),
            size: 1.0,
        };
        let mut last = f64::INFINITY;
        for pass in 0..MOST_PASSES {
            self.mechanism.e.copy_from_slice(&at.e);
            if !self.mechanism.step_parameters() {
                return None;
            }
            let [size, leant] = self.mechanism.correct(self.of, &mut at.q, &mut load);
            let moved = size.max(leant);
            // Corrections that do not shrink lead elsewhere.
            let is_lost = size > 0.5 * last && size > DONE;
            if !moved.is_finite() || size > LONGEST || is_lost {
                return None;
            }
            let gained = if pass < presses {
                self.press(&mut at, &load)
            } else {
                0.0
            };
            if gained == 0.0 && left(moved, last) <= DONE {
                return Some(self.read(at, load));
            }
            last = if gained > 0.0 { f64::INFINITY } else { moved };
        }
        None
    }

    /// Presses all sources, if they gain by that; what they gain.
    fn press(&mut self, at: &mut Place, load: &Load) -> f64 {
        self.mechanism.influences(self.of, load, &mut at.g);
        let to = self.pressed(&at.e, &at.g);
        let gained = self.promise(&at.g, &at.e, &to);
        let all: f64 = self.promise(&at.g, &vec![[0.0; 2]; to.len()], &to);
        if gained <= STILL * all.abs() {
            return 0.0;
        }
        at.e = to;
        gained
    }

    /// A place that was found, with what it is worth.
    fn read(&mut self, mut at: Place, load: Load) -> Place {
        let mechanism = &mut *self.mechanism;
        mechanism.take(&at.q, self.of.stand);
        mechanism.place(self.of.stand);
        mechanism.influences(self.of, &load, &mut at.g);
        at.y = mechanism.reading(self.of, &load) - self.nominal;
        at.lambda = load.lambda;
        at
    }

    /// On from where weak sources stand at another side, several or one of them, if that goes farther.
    fn aside(&mut self, at: &Place) -> Option<Place> {
        let weak = self.weak(at)?;
        if weak.is_empty() {
            return None;
        }
        self.mechanism.factor(&at.q, self.of.stand)?;
        let sources = self.mechanism.sources;
        // What goes through the same joint turns over together: all of them, the weaker half, and so on.
        let halves = std::iter::successors(Some(weak.len()), |count| Some(count / 2));
        let mut tries: Vec<Vec<(usize, Pair)>> = Vec::new();
        for count in halves.take_while(|count| *count > 1) {
            let others = weak[..count].iter();
            let others =
                others.filter_map(|&k| Some((k, *sources[k].room.others(at.e[k]).first()?)));
            tries.push(others.collect());
        }
        for k in weak {
            tries.extend(
                sources[k]
                    .room
                    .others(at.e[k])
                    .into_iter()
                    .map(|other| vec![(k, other)]),
            );
        }
        for turned in tries {
            let mut e = at.e.clone();
            turned.into_iter().for_each(|(k, other)| e[k] = other);
            let there = self.settle(at, &e, 0);
            let is_farther = |there: &Place| self.gain(at, there) > SAME * at.y.abs();
            if let Some(there) = there.filter(is_farther) {
                return Some(self.top(there));
            }
        }
        None
    }

    /// The sources that may go farther at another side, the weakest first, or `None` if the first order is not known.
    fn weak(&self, at: &Place) -> Option<Vec<usize>> {
        let (_, nominal) = self.known?;
        let sources = self.mechanism.sources;
        let reach = sources.iter().zip(nominal).map(|(source, g)| {
            let [down, up] = source.room.reach(*g);
            if self.side > 0.0 { up } else { down }
        });
        let left_out = (at.y - reach.sum::<f64>()).abs();
        let mut weak: Vec<(f64, usize)> = Vec::new();
        for (k, source) in sources.iter().enumerate() {
            let (g, then) = (at.g[k], nominal[k]);
            let span = source.room.span(g);
            let change = source.room.span([g[0] - then[0], g[1] - then[1]]);
            if span <= WEAK * left_out.max(change) && span.max(change) > SAME * at.y.abs() {
                weak.push((span, k));
            }
        }
        weak.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(weak.into_iter().map(|(_, k)| k).collect())
    }
}
