//! Where the search for the farthest deviation of an output begins.
//!
//! With the pins pressed, and all else at its ends, where the influences at the nominal position say, and displaced to first order.
//! Along a stroke what comes to that goes on smoothly, on a parabola through the last three poses: of q, λ and g what is beyond
//! the first order, and the places of sources between their ends.

use super::displaced::{Mechanism, Space, Stand};
use super::output::{Load, Output};
use super::source::Influence;
use super::turn::Turn;

/// Poses that are kept: those of a parabola.
const KEPT: usize = 3;
/// What reaches no farther than this part of all has no influence.
pub(super) const SILENT: f64 = 1e-14;

/// Deviations of all sources.
#[derive(Debug, Clone)]
pub(super) struct Chosen {
    /// e of the plays.
    pub extremes: Vec<Influence>,
    /// Sources that give way to their influence (plays).
    pub turns: Vec<Turn>,
    /// Steps of the dimensions …
    pub steps: Vec<f64>,
    /// … for these deviations of the parameters.
    pub stepped: Vec<f64>,
}

impl Chosen {
    pub fn new(plays: usize, dimensions: usize) -> Self {
        Chosen {
            extremes: vec![[0.0; 2]; plays],
            turns: vec![Turn::default(); plays],
            steps: vec![0.0; dimensions],
            stepped: Vec::new(),
        }
    }
}

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
    /// What they say of this one.
    ahead: Beyond,
}

/// A pose that was searched.
#[derive(Debug, Clone)]
struct Past {
    /// \[s\]
    time: f64,
    beyond: Beyond,
}

/// What a farthest deviation was beyond its first order, in one row so that parabolas are quick: coordinates (n), multipliers (m),
/// influences (two a play), and the places of the plays, whole.
#[derive(Debug, Clone)]
struct Beyond {
    numbers: Vec<f64>,
    /// Where multipliers, influences and places begin.
    begins: [usize; 3],
}

impl Beyond {
    fn q(&self) -> &[f64] {
        &self.numbers[..self.begins[0]]
    }

    fn lambda(&self) -> &[f64] {
        &self.numbers[self.begins[0]..self.begins[1]]
    }

    fn influences(&self) -> &[Influence] {
        self.numbers[self.begins[1]..self.begins[2]].as_chunks().0
    }

    fn places(&self) -> &[f64] {
        &self.numbers[self.begins[2]..]
    }
}

impl Search {
    pub fn new(mechanism: &Mechanism, side: f64) -> Self {
        let (n, m) = (mechanism.driven.system.n(), mechanism.driven.system.m());
        let plays = mechanism.plays.len();
        Search {
            side,
            q: vec![0.0; n],
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
            ahead: Beyond {
                numbers: vec![0.0; n + m + 3 * plays],
                begins: [n, n + m, n + m + 2 * plays],
            },
        }
    }

    /// The next pose does not go on from the ones before.
    pub fn forget(&mut self) {
        self.past.clear();
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
        let ahead = &mut self.ahead.numbers;
        match self.past.as_slice() {
            [] => return false,
            [a, b, c] => {
                let each = a
                    .beyond
                    .numbers
                    .iter()
                    .zip(&b.beyond.numbers)
                    .zip(&c.beyond.numbers);
                for (ahead, ((a, b), c)) in ahead.iter_mut().zip(each) {
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
    fn choose(&mut self, mechanism: &Mechanism, influences: &[Influence], first: f64) {
        let Chosen {
            extremes, turns, ..
        } = &mut self.chosen;
        let own = extremes
            .iter_mut()
            .zip(turns)
            .zip(mechanism.plays)
            .zip(influences);
        if !self.is_led {
            for (((e, turn), play), g) in own {
                (*e, *turn) = (play.extreme(*g, self.side), Turn::default());
            }
            return;
        }
        let still = SILENT * first.abs();
        let ahead = self.ahead.influences().iter().zip(self.ahead.places());
        for ((((e, turn), play), g), (more, place)) in own.zip(ahead) {
            let g = [g[0] + more[0], g[1] + more[1]];
            *turn = match play.ends() {
                Some(ends) if turn.is_bent() => turn.ahead([*place, g[0]], ends),
                Some(_) | None => Turn::default(),
            };
            if turn.is_bent() {
                *e = [*place, 0.0];
                continue;
            }
            // What has no influence stays where it was.
            let [down, up] = play.reach(g);
            if up - down > still {
                *e = play.extreme(g, self.side);
            }
        }
    }

    /// Keeps what was found, the mechanism displaced to first order (n) for the same deviations.
    fn keep(
        &mut self,
        time: f64,
        first: &[f64],
        mechanism: &Mechanism,
        nominal: (&Load, &[Influence]),
    ) {
        let mut past = if self.past.len() == KEPT {
            self.past.remove(KEPT - 1)
        } else {
            Past {
                time,
                beyond: self.ahead.clone(),
            }
        };
        past.time = time;
        let (load, influences) = nominal;
        let now = &mechanism.space.influences;
        let less = |(a, b): (&f64, &f64)| a - b;
        let q = self.q.iter().zip(first).map(less);
        let lambda = self.load.lambda.iter().zip(&load.lambda).map(less);
        let g = now
            .as_flattened()
            .iter()
            .zip(influences.as_flattened())
            .map(less);
        let places = self.chosen.extremes.iter().map(|e| e[0]);
        let numbers = q.chain(lambda).chain(g).chain(places);
        past.beyond.numbers.clear();
        past.beyond.numbers.extend(numbers);
        self.past.insert(0, past);
    }
}

impl Mechanism<'_> {
    /// Begins a search at a pose that was taken, with the load and the influences there, and the deviation to first order. Whether
    /// the model can be had with it.
    pub fn begin(
        &mut self,
        stand: &Stand,
        output: &Output,
        (load, influences): (&Load, &[Influence]),
        (first, search): (f64, &mut Search),
    ) -> bool {
        search.is_led = search.look(stand.inputs.time);
        search.choose(self, influences, first);
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        let is_had = self.first_step(stand, load);
        if let Some(lacking) = is_had {
            let nominal = self.value(stand, output, 0.0);
            search.nominal = nominal;
            search.deviation = self.value(stand, output, 1.0) - nominal + lacking;
            search.far = self.driven.system.scaled_norm(&self.space.step);
            let step = stand.q.iter().zip(&self.space.step);
            search
                .q
                .iter_mut()
                .zip(step)
                .for_each(|(own, (q, d))| *own = q + d);
            search.load.size = load.size;
            search.load.lambda.copy_from_slice(&load.lambda);
            if search.is_led {
                let add = |own: &mut [f64], more: &[f64]| {
                    own.iter_mut()
                        .zip(more)
                        .for_each(|(own, more)| *own += more);
                };
                add(&mut search.q, search.ahead.q());
                add(&mut search.load.lambda, search.ahead.lambda());
            }
        }
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        is_had.is_some()
    }

    /// Sets `space.step` to the first correction for the deviations chosen, at the nominal position of a pose that was taken. What
    /// the equations lack is worth; none where the model can't be had with them.
    fn first_step(&mut self, stand: &Stand, load: &Load) -> Option<f64> {
        if !self.step_parameters() {
            return None;
        }
        self.place(stand);
        self.gap(stand);
        let lacking = self.lack(load);
        let Space { right, step, .. } = &mut self.space;
        self.driven.answer(right, step);
        Some(lacking)
    }

    /// Keeps what a search found for the next pose; `is_moved` where sources left the ends that it began with.
    pub fn keep(
        &mut self,
        stand: &Stand,
        nominal: (&Load, &[Influence]),
        (began, is_moved): (&[f64], bool),
        search: &mut Search,
    ) {
        search
            .q
            .iter_mut()
            .zip(&self.space.step)
            .for_each(|(q, d)| *q += d);
        let mut first = std::mem::take(&mut self.space.pull);
        if is_moved || !search.is_led {
            self.take(&stand.q, stand);
            if self.first_step(stand, nominal.0).is_none() {
                search.forget();
                self.space.pull = first;
                return;
            }
            let step = stand.q.iter().zip(&self.space.step);
            first
                .iter_mut()
                .zip(step)
                .for_each(|(first, (q, d))| *first = q + d);
        } else {
            let ahead = began.iter().zip(search.ahead.q());
            first
                .iter_mut()
                .zip(ahead)
                .for_each(|(first, (q, r))| *first = q - r);
        }
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        search.keep(stand.inputs.time, &first, self, nominal);
        std::mem::swap(&mut self.chosen, &mut search.chosen);
        self.space.pull = first;
    }
}
