//! How well a path is known between its nodes.
//!
//! The polynomial of degree 11 through four nodes with q, q′, q″ misses the curve by ω(s)³ q⁽¹²⁾/12!, ω = Π (s − s_i). How much that
//! is tells a node that is left out: the four around it miss it by the same with their own ω, of twice the widths, and so some hundred
//! times as much. Nothing is solved for that. What q″ is off by is that, or the nodes' round-off, by the square of the gap. Where a
//! node is of little accuracy, beside a change point, it stands out likewise; nodes within the window of one are points of its smooth
//! branch.

use super::path::Path;
use crate::system::System;
use linkdyn_linear::hermite::{Node, osculate};

/// A node that is missed by no more than this may be left out [rad or sizes].
const TOLD: f64 = 1e-13;
/// Round-off of a node's position [rad or sizes].
const ROUND_OFF: f64 = 1e-15;
/// q″ in the middle of a gap of width 1, of values at its ends that are off by 1: of the weights of four equidistant nodes.
const BEND: f64 = 36.0;

impl Path {
    /// Finds what the polynomials around gaps are off by; `unit` is that of the parameter.
    pub(super) fn find_errors(&mut self, system: &System, unit: f64) {
        for node in &mut self.nodes {
            let windows = &mut self.windows.iter();
            let within = windows.find(|w| (node.s - w.s).abs() <= w.radius);
            if let Some(branch) = within.and_then(|window| window.branch.as_ref()) {
                let Node { s, q, d, dd } = node;
                branch.eval(*s, q, d, dd);
            }
        }
        let mut left_out = LeftOut::new(system);
        self.thin(&mut left_out);
        let count = self.nodes.len();
        let misses: Vec<f64> = (0..count)
            .map(|k| match (2..count.saturating_sub(2)).contains(&k) {
                true => left_out.miss(&self.nodes[k - 2..k + 3]),
                false => f64::INFINITY,
            })
            .collect();
        let error = |k: usize| {
            if k < 1 || k + 2 >= count {
                return f64::INFINITY;
            }
            let [a, b] = [self.nodes[k].s, self.nodes[k + 1].s];
            let around = [self.nodes[k - 1].s, a, b, self.nodes[k + 2].s];
            let omega = distances(&around, 0.5 * (a + b));
            let error = misses[k].max(misses[k + 1]) * omega.powi(3);
            BEND * error.max(ROUND_OFF) * (unit / (b - a)).powi(2)
        };
        self.errors = (0..count.saturating_sub(1)).map(error).collect();
    }

    /// Leaves out nodes that lie close together, where the march began with short steps, and that the others tell.
    fn thin(&mut self, left_out: &mut LeftOut) {
        let gaps = self.nodes.windows(2).map(|pair| pair[1].s - pair[0].s);
        let largest = gaps.fold(0.0, f64::max);
        let mut k = 2;
        while k + 2 < self.nodes.len() {
            let [before, after] = [&self.nodes[k - 1], &self.nodes[k + 1]];
            let around = &self.nodes[k - 2..k + 3];
            if after.s - before.s <= largest && left_out.distance(around) <= TOLD {
                self.nodes.remove(k);
            } else {
                k += 1;
            }
        }
    }
}

/// Π |s − s_i|.
fn distances(at: &[f64; 4], s: f64) -> f64 {
    at.iter().map(|at| (s - at).abs()).product()
}

/// A node that is left out.
struct LeftOut<'s> {
    system: &'s System,
    q: Vec<f64>,
    d: Vec<f64>,
    dd: Vec<f64>,
}

impl<'s> LeftOut<'s> {
    fn new(system: &'s System) -> Self {
        let [q, d, dd] = std::array::from_fn(|_| vec![0.0; system.n()]);
        LeftOut { system, q, d, dd }
    }

    /// By how much the middle one of five is missed by the others, by ω³.
    fn miss(&mut self, nodes: &[Node]) -> f64 {
        let [a, b, middle, c, d] = nodes else {
            return f64::INFINITY;
        };
        let around = [a.s, b.s, c.s, d.s];
        self.distance(nodes) / distances(&around, middle.s).powi(3)
    }

    /// By how much it is missed, in q and over the gaps' width in q′ and q″ [rad or sizes].
    fn distance(&mut self, nodes: &[Node]) -> f64 {
        let [a, b, middle, c, d] = nodes else {
            return f64::INFINITY;
        };
        let around = [a, b, c, d];
        let to = [&mut self.q[..], &mut self.d, &mut self.dd];
        osculate(around, middle.s, to);
        let width = 0.5 * (c.s - b.s);
        let powers = [1.0, width, width * width];
        let found = [&mut self.q, &mut self.d, &mut self.dd];
        let wanted = [&middle.q, &middle.d, &middle.dd];
        let mut largest = 0.0_f64;
        for ((found, wanted), power) in found.into_iter().zip(wanted).zip(powers) {
            let pairs = found.iter_mut().zip(wanted);
            pairs.for_each(|(found, wanted)| *found = (*found - wanted) * power);
            largest = largest.max(self.system.scaled_norm(found));
        }
        largest
    }
}
