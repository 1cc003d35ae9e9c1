//! Motions at the last factors: of the independent coordinates, and of the drivers.

use super::Driven;
use crate::system::Inputs;

/// Right-hand sides that go through the factors together.
const TOGETHER: usize = 4;

/// What a motion is of.
#[derive(Clone, Copy)]
struct Motions<'a> {
    /// The first independent coordinate, and how many there are from it on.
    first: usize,
    coordinates: usize,
    /// Drivers, as one motion behind those of the coordinates.
    drivers: Option<&'a Inputs>,
}

impl Driven<'_> {
    /// S (f × n), one tangent ∂q/∂u_k after the other: the motion that independent coordinate k alone makes.
    pub fn tangents(&mut self, tangents: &mut [f64]) {
        self.motions(None, tangents, &mut []);
    }

    /// The same, and v_t (n), the velocities while the independent coordinates are held.
    pub fn tangents_and_drift(&mut self, inputs: &Inputs, tangents: &mut [f64], drift: &mut [f64]) {
        self.motions(Some(inputs), tangents, drift);
    }

    fn motions(&mut self, drivers: Option<&Inputs>, tangents: &mut [f64], drift: &mut [f64]) {
        let f = self.independent.len();
        let all = f + usize::from(drivers.is_some());
        let mut first = 0;
        while first < all {
            let count = (all - first).min(TOGETHER);
            let motions = Motions {
                first,
                coordinates: count.min(f - first),
                drivers: drivers.filter(|_| first + count > f),
            };
            match count {
                1 => self.some::<1>(motions, tangents, drift),
                2 => self.some::<2>(motions, tangents, drift),
                3 => self.some::<3>(motions, tangents, drift),
                _ => self.some::<TOGETHER>(motions, tangents, drift),
            }
            first += count;
        }
    }

    /// K motions, by one pass through the factors.
    fn some<const K: usize>(&mut self, motions: Motions, tangents: &mut [f64], drift: &mut [f64]) {
        let Motions {
            first,
            coordinates,
            drivers,
        } = motions;
        let (n, m) = (self.system.n(), self.system.m());
        if let Some(inputs) = drivers {
            self.evaluation
                .eval_rate(self.system, inputs, &mut self.rows[..m]);
        }
        if self.together.len() < K * n {
            self.together.resize(K * n, 0.0);
        }
        let together = self.together[..K * n].as_chunks_mut::<K>().0;
        let rows = self.selection.active.iter().zip(&self.row_scales);
        for (sides, (&row, scale)) in together.iter_mut().zip(rows) {
            *sides = [0.0; K];
            match row.checked_sub(m) {
                Some(k) if k >= first && k - first < coordinates => sides[k - first] = -1.0 / scale,
                None if drivers.is_some() => sides[coordinates] = -self.rows[row] / scale,
                Some(_) | None => {}
            }
        }
        self.lu.solve_together(together);
        let columns = tangents[first * n..].chunks_exact_mut(n.max(1));
        let all = columns.take(coordinates).chain(drivers.map(|_| drift));
        for (k, motion) in all.enumerate() {
            for (to, sides) in motion.iter_mut().zip(&*together) {
                *to = sides[k];
            }
            self.system.scale_columns(motion);
        }
    }
}
