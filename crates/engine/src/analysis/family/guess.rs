//! Where a variant is expected to be: beside the nominal mechanism, as far as a polynomial through stations says.

use super::track::Station;
use linkdyn_linear::hermite::{quintic, value_weights};
use linkdyn_linear::math::Lanes;
use nalgebra::SimdValue;

/// Data that a polynomial goes through, about, and how much those of an extrapolation may weigh: that is what round-off grows
/// by.
const DATA: usize = 6;
const HEAVY: f64 = 1e3;
/// Stations that a position between them is interpolated from, and how much their weights come to where they stand evenly, at
/// most.
const WINDOW: usize = 8;
const EVEN: f64 = 8.0;

/// How q at a time follows from what is known at stations.
pub struct Guess {
    /// Station, order of the derivative, weight.
    data: Vec<(usize, usize, f64)>,
    /// The nominal mechanism there, without what the same weights make of it (n).
    base: Vec<f64>,
    /// The same of how it changes by each parameter, where that is known.
    by: Vec<Vec<f64>>,
}

/// q, v, a by a parameter at stations, as far as a [`Motion`] has them.
pub type MotionSlopes = [Vec<f64>; 3];

/// q, v, a (n by stations); the rates of some stations may be missing at the end.
pub type Motion = [Vec<Lanes>; 3];

impl Guess {
    /// Of the nominal position `q` at a time, from the last of the stations until there, of which the first ones have rates.
    pub fn beyond(known: &[Station], with_rates: usize, time: f64, q: &[f64]) -> Self {
        let count = |index: usize| if index < with_rates { 3 } else { 1 };
        let mut data = 0;
        let enough = known.iter().enumerate().rposition(|(index, _)| {
            data += count(index);
            data >= DATA
        });
        let last = known.len().saturating_sub(1);
        let of = |first: usize| Guess::through(known, first, (first..known.len()).map(count), time);
        let all = (enough.unwrap_or(0)..last).map(of);
        let light = { all }.find(|guess| guess.weight(known, time) <= HEAVY);
        let mut found = light.unwrap_or_else(|| of(last));
        found.beside(known, q);
        found
    }

    /// Of stations from one on, with so many data each.
    fn through(
        stations: &[Station],
        first: usize,
        counts: impl Iterator<Item = usize> + Clone,
        time: f64,
    ) -> Self {
        let nodes = stations[first..].iter().zip(counts.clone());
        let nodes: Vec<(f64, usize)> = nodes.map(|(own, count)| (own.node.s, count)).collect();
        let places = counts.enumerate();
        let places = places.flat_map(|(k, count)| (0..count).map(move |order| (first + k, order)));
        let data = places.zip(value_weights(&nodes, time));
        Guess {
            data: data
                .map(|((station, order), weight)| (station, order, weight))
                .collect(),
            base: Vec::new(),
            by: Vec::new(),
        }
    }

    /// How much its data weigh together, rates by the distance from the last station.
    fn weight(&self, known: &[Station], time: f64) -> f64 {
        let h = known.last().map_or(1.0, |last| (time - last.node.s).abs());
        let sizes = self
            .data
            .iter()
            .map(|(_, order, weight)| weight.abs() / h.powi(*order as i32));
        sizes.sum()
    }

    fn beside(&mut self, stations: &[Station], q: &[f64]) {
        self.base = q.to_vec();
        for (station, order, weight) in &self.data {
            let node = &stations[*station].node;
            let own = [&node.q, &node.d, &node.dd][*order];
            let to = self.base.iter_mut().zip(own);
            to.for_each(|(base, own)| *base -= weight * own);
        }
    }

    /// Takes how the motion changes by each parameter, of the position at a station.
    pub fn learn(&mut self, station: usize, slopes: &[MotionSlopes]) {
        let n = self.base.len();
        let of = |slopes: &MotionSlopes| {
            let mut by = slopes[0][n * station..][..n].to_vec();
            for (station, order, weight) in &self.data {
                let own = &slopes[*order][n * station..][..n];
                by.iter_mut()
                    .zip(own)
                    .for_each(|(by, own)| *by -= weight * own);
            }
            by
        };
        self.by = slopes.iter().map(of).collect();
    }

    /// From motions side by side, whose parameters differ so from the nominal ones.
    pub fn write(&self, motion: &Motion, offsets: &[Lanes], q: &mut [Lanes]) {
        let n = q.len();
        for (q, base) in q.iter_mut().zip(&self.base) {
            *q = Lanes::splat(*base);
        }
        for (by, offset) in self.by.iter().zip(offsets) {
            q.iter_mut()
                .zip(by)
                .for_each(|(q, by)| *q += *offset * Lanes::splat(*by));
        }
        for (station, order, weight) in &self.data {
            let own = &motion[*order][n * station..][..n];
            let weight = Lanes::splat(*weight);
            q.iter_mut()
                .zip(own)
                .for_each(|(q, own)| *q += weight * *own);
        }
    }
}

/// Positions between stations.
pub struct Interpolation {
    windows: Vec<Neighbours>,
}

/// Stations around those between which a time is, with Lagrange's weights (Berrut and Trefethen 2004, eq. 3.2).
struct Neighbours {
    first: usize,
    weights: [f64; WINDOW],
    count: usize,
}

impl Interpolation {
    /// Interpolation stations.
    pub fn new(stations: &[Station]) -> Self {
        let window = |after: usize| {
            let of = |wide: usize| {
                let first = after
                    .saturating_sub(wide)
                    .min(stations.len().saturating_sub(2 * wide));
                Neighbours::new(
                    stations,
                    first,
                    stations.len().min(first + 2 * wide) - first,
                )
            };
            let middle = 0.5 * (stations[after - 1].node.s + stations[after].node.s);
            let even = [WINDOW / 2, WINDOW / 4].into_iter().map(of);
            let is_even = |window: &Neighbours| {
                let weights = window.at(stations, middle);
                weights.iter().map(|own| own.abs()).sum::<f64>() <= EVEN
            };
            { even }.find(is_even).unwrap_or_else(|| of(1))
        };
        Interpolation {
            windows: (1..stations.len()).map(window).collect(),
        }
    }

    /// Where one variant is expected at a time.
    pub fn write(
        &self,
        stations: &[Station],
        (motion, lane): (&[Lanes], usize),
        time: f64,
        q: &mut [f64],
    ) {
        let n = q.len();
        let after = stations.partition_point(|station| station.node.s < time);
        let after = after.clamp(1, self.windows.len().max(1));
        let Some(window) = self.windows.get(after - 1) else {
            return q
                .iter_mut()
                .zip(motion)
                .for_each(|(q, own)| *q = own.extract(lane));
        };
        quintic(
            &stations[after - 1].node,
            &stations[after].node,
            time,
            q,
            None,
        );
        let weights = window.at(stations, time);
        for (index, weight) in (window.first..).zip(&weights[..window.count]) {
            let own = motion[n * index..][..n].iter().zip(&stations[index].node.q);
            for (q, (own, nominal)) in q.iter_mut().zip(own) {
                *q += weight * (own.extract(lane) - nominal);
            }
        }
    }
}

impl Neighbours {
    fn new(stations: &[Station], first: usize, count: usize) -> Self {
        let x = |k: usize| stations[first + k].node.s;
        // differences by a typical one, so that their products are numbers
        let scale = (x(count - 1) - x(0)) / count as f64;
        let mut weights = [0.0; WINDOW];
        for (j, weight) in weights[..count].iter_mut().enumerate() {
            let others = (0..count).filter(|i| *i != j);
            *weight = others.fold(1.0, |product, i| product * scale / (x(j) - x(i)));
        }
        Neighbours {
            first,
            weights,
            count,
        }
    }

    /// What positions are multiplied by at a time.
    fn at(&self, stations: &[Station], time: f64) -> [f64; WINDOW] {
        let mut weights = self.weights;
        let own = weights[..self.count].iter_mut();
        for (weight, station) in own.zip(&stations[self.first..]) {
            *weight /= time - station.node.s;
        }
        let sum: f64 = weights.iter().sum();
        match sum.is_finite() {
            true => weights.map(|weight| weight / sum),
            // at a station
            false => weights.map(|weight| if weight.is_finite() { 0.0 } else { 1.0 }),
        }
    }
}
