//! Where the search for the farthest deviation of an output begins.
//!
//! With the pins pressed, and all else at its ends, where the influences at the nominal position say, and displaced to first order.
//! Along a stroke what comes to that goes on smoothly, on a parabola through the last three poses: of q, λ and g what is beyond
//! the first order, and the places of sources between their ends.

use super::chosen::Chosen;
use super::displaced::{Mechanism, Space, Stand};
use super::output::Load;
use super::source::Influence;
use super::worst::Farthest;

/// Poses that are kept: those of a parabola.
const KEPT: usize = 3;
/// What reaches no farther than this part of all has no influence.
pub(super) const SILENT: f64 = 1e-14;

/// The search for the farthest deviation of one output to one side, pose after pose.
#[derive(Debug, Clone)]
pub(super) struct Search {
    /// −1 or 1.
    pub side: f64,
    /// Coordinates (n).
    pub q: Vec<f64>,
    /// The load on the output there.
    pub load: Load,
    /// The deviations, and before the search those of the last pose.
    pub chosen: Chosen,
    /// Coordinates where it began (n).
    pub began: Vec<f64>,
    /// The output at the nominal position [rad or m].
    pub nominal: f64,
    /// Its deviation to first order.
    pub deviation: f64,
    /// Size of the correction to first order [–].
    pub far: f64,
    /// Whether poses before say what is beyond it.
    pub is_led: bool,
    /// The last poses, the newest first.
    past: Vec<Past>,
    /// What they weigh in what they say of this one, and what they say.
    weights: [f64; KEPT],
    ahead: Beyond,
}

/// A pose that was searched.
#[derive(Debug, Clone)]
struct Past {
    /// \[s\]
    time: f64,
    beyond: Beyond,
    /// e of the plays.
    places: Vec<Influence>,
}

/// What a farthest deviation was beyond its first order, in one row so that parabolas are quick: coordinates (n), multipliers (m),
/// and the influences that these do not tell.
#[derive(Debug, Clone)]
struct Beyond {
    numbers: Vec<f64>,
    /// Where multipliers and influences begin.
    begins: [usize; 2],
}

impl Beyond {
    fn q(&self) -> &[f64] {
        &self.numbers[..self.begins[0]]
    }

    fn lambda(&self) -> &[f64] {
        &self.numbers[self.begins[0]..self.begins[1]]
    }

    fn influences(&self) -> &[f64] {
        &self.numbers[self.begins[1]..]
    }
}

impl Search {
    pub fn new(mechanism: &Mechanism, side: f64) -> Self {
        let (n, m) = (mechanism.driven.system.n(), mechanism.driven.system.m());
        let plays = mechanism.plays.len();
        Search {
            side,
            q: vec![0.0; n],
            began: vec![0.0; n],
            load: Load {
                lambda: vec![0.0; m],
                size: 1.0,
            },
            chosen: Chosen::new(plays, mechanism.dimensions.all.len()),
            nominal: 0.0,
            deviation: 0.0,
            far: 0.0,
            is_led: false,
            past: Vec::with_capacity(KEPT),
            weights: [0.0; KEPT],
            ahead: Beyond {
                numbers: vec![0.0; n + m + mechanism.sorted.untold()],
                begins: [n, n + m],
            },
        }
    }

    /// The next pose does not go on from the ones before.
    pub fn forget(&mut self) {
        self.past.clear();
    }

    /// Where it is, whether that is a worst case or not.
    pub fn last(&self) -> Farthest {
        Farthest {
            deviation: f64::NAN,
            q: self.q.clone(),
            e: self.chosen.extremes.clone(),
            lacks: f64::NAN,
            needed: Vec::new(),
        }
    }

    /// Whether a deviation is one to its side: where an output turns back, deviations may be stationary that go less far than none.
    pub fn goes(&self, deviation: f64) -> bool {
        deviation * self.side >= 0.0 || self.deviation * self.side < 0.0
    }

    /// Looks ahead to a time; whether anything is known.
    fn look(&mut self, time: f64) -> bool {
        let times = self.past.iter().map(|past| past.time);
        let mut weights = [0.0; KEPT];
        for (k, (weight, own)) in weights.iter_mut().zip(times.clone()).enumerate() {
            let others = times.clone().enumerate().filter(|(j, _)| *j != k);
            *weight = others
                .map(|(_, other)| (time - other) / (own - other))
                .product();
        }
        self.weights = weights;
        let ahead = &mut self.ahead.numbers;
        match self.past.as_slice() {
            [] => return false,
            [a, b, c] => {
                let [a, b, c] = [a, b, c].map(|past| past.beyond.numbers.iter());
                for (ahead, ((a, b), c)) in ahead.iter_mut().zip(a.zip(b).zip(c)) {
                    *ahead = weights[0] * a + weights[1] * b + weights[2] * c;
                }
            }
            few => {
                ahead.fill(0.0);
                for (past, weight) in few.iter().zip(weights) {
                    let each = ahead.iter_mut().zip(&past.beyond.numbers);
                    each.for_each(|(ahead, own)| *ahead += weight * own);
                }
            }
        }
        true
    }

    /// Chooses the deviations that the influences at the nominal position ask for, and those beyond it.
    fn choose(
        &mut self,
        mechanism: &Mechanism,
        (influences, g): (&[Influence], &mut [Influence]),
        first: f64,
    ) {
        let sources = (&mechanism.sorted, mechanism.plays);
        if !self.is_led {
            let asked = (influences, self.side);
            return self.chosen.begin(sources, asked, -1.0, |_| None);
        }
        let beyond = (self.ahead.lambda(), self.ahead.influences());
        mechanism.sorted.differ(beyond, influences, g);
        let each = self.past.iter().zip(self.weights);
        let place = |play: usize| {
            let places = each.clone();
            Some(
                places
                    .map(|(past, weight)| weight * past.places[play][0])
                    .sum(),
            )
        };
        let still = SILENT * first.abs();
        self.chosen.begin(sources, (g, self.side), still, place);
    }

    /// Keeps what was found, the mechanism displaced to first order (n) for the same deviations.
    fn keep(
        &mut self,
        time: f64,
        first: &[f64],
        mechanism: &Mechanism,
        (load, influences): (&Load, &[Influence]),
    ) {
        let mut past = if self.past.len() == KEPT {
            self.past.remove(KEPT - 1)
        } else {
            Past {
                time,
                beyond: self.ahead.clone(),
                places: self.chosen.extremes.clone(),
            }
        };
        past.time = time;
        past.places.copy_from_slice(&self.chosen.extremes);
        let [begin, middle] = past.beyond.begins;
        let (q, others) = past.beyond.numbers.split_at_mut(begin);
        less(&self.q, first, q);
        let (lambda, untold) = others.split_at_mut(middle - begin);
        less(&self.load.lambda, &load.lambda, lambda);
        let g = &mechanism.space.influences;
        mechanism.sorted.differences(g, influences, untold);
        self.past.insert(0, past);
    }
}

impl Mechanism<'_> {
    /// Begins a search at a pose that was taken, with the load and the influences there, the output and its deviation to first
    /// order. Whether the model can be had with it.
    pub fn begin(
        &mut self,
        stand: &Stand,
        (load, influences): (&Load, &[Influence]),
        [nominal, first]: [f64; 2],
        search: &mut Search,
    ) -> bool {
        search.is_led = search.look(stand.inputs.time);
        let mut g = std::mem::take(&mut self.space.influences);
        search.choose(self, (influences, &mut g), first);
        self.space.influences = g;
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        let is_had = self.first_step(stand, load);
        if is_had {
            search.nominal = nominal;
            search.deviation = first;
            search.far = self.driven.system.scaled_norm(&self.space.step);
            sum(&stand.q, &self.space.step, &mut search.q);
            search.load.size = load.size;
            search.load.lambda.copy_from_slice(&load.lambda);
            if search.is_led {
                add(&mut search.q, search.ahead.q());
                add(&mut search.load.lambda, search.ahead.lambda());
            }
        }
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        is_had
    }

    /// Sets `space.step` to the first correction for the deviations chosen, at the nominal position of a pose that was taken.
    /// Whether the model can be had with them.
    fn first_step(&mut self, stand: &Stand, load: &Load) -> bool {
        let is_had = self.step_parameters();
        if is_had {
            self.place(stand);
            self.gap(stand);
            self.lack(load);
            let Space { right, step, .. } = &mut self.space;
            self.driven.answer(right, step);
        }
        is_had
    }

    /// Keeps what a search found for the next pose; `is_moved` where sources left the ends that it began with.
    pub fn keep(
        &mut self,
        stand: &Stand,
        nominal: (&Load, &[Influence]),
        is_moved: bool,
        search: &mut Search,
    ) {
        let mut first = std::mem::take(&mut self.space.pull);
        if is_moved || !search.is_led {
            self.take(&stand.q, stand);
            if !self.first_step(stand, nominal.0) {
                search.forget();
                self.space.pull = first;
                return;
            }
            sum(&stand.q, &self.space.step, &mut first);
        } else {
            less(&search.began, search.ahead.q(), &mut first);
        }
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        search.keep(stand.inputs.time, &first, self, nominal);
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        self.space.pull = first;
    }
}

pub(super) fn add(own: &mut [f64], more: &[f64]) {
    own.iter_mut()
        .zip(more)
        .for_each(|(own, more)| *own += more);
}

fn sum(a: &[f64], b: &[f64], sum: &mut [f64]) {
    let each = sum.iter_mut().zip(a.iter().zip(b));
    each.for_each(|(sum, (a, b))| *sum = a + b);
}

fn less(a: &[f64], b: &[f64], less: &mut [f64]) {
    let each = less.iter_mut().zip(a.iter().zip(b));
    each.for_each(|(less, (a, b))| *less = a - b);
}
