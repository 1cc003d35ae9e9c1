//! Motions at the last factors: of the independent coordinates, of the drivers, and of whatever rows ask for.

use super::Driven;
use crate::system::Inputs;
use linkdyn_linear::lu::SparseLu;

/// Right-hand sides that go through the factors together.
pub const TOGETHER: usize = 4;

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
    /// x (n) with J_A x = `rows` (m) at the last factors, without independent coordinates.
    pub fn answer(&mut self, rows: &[f64], x: &mut [f64]) {
        self.rows[..rows.len()].copy_from_slice(rows);
        self.rows[rows.len()..].fill(0.0);
        self.solve_rows(x);
    }

    /// S (f × n), one tangent ∂q/∂u_k after the other: the motion that independent coordinate k alone makes.
    pub fn tangents(&mut self, tangents: &mut [f64]) {
        self.motions(None, tangents, &mut []);
    }

    /// The same, and v_t (n), the velocities while the independent coordinates are held.
    pub fn tangents_and_drift(&mut self, inputs: &Inputs, tangents: &mut [f64], drift: &mut [f64]) {
        self.motions(Some(inputs), tangents, drift);
    }

    /// The tangents from one on, at most [`TOGETHER`].
    pub fn tangents_from(&mut self, first: usize, tangents: &mut [f64]) {
        let coordinates = tangents.len() / self.system.n().max(1);
        let motions = Motions {
            first,
            coordinates,
            drivers: None,
        };
        self.count(coordinates, motions, tangents, &mut []);
    }

    /// The motion that all independent coordinates make together (n), each by its scale to one side or the other, by the factors
    /// of another position.
    pub fn spread(
        &mut self,
        factors: &mut SparseLu,
        mut is_forward: impl FnMut() -> bool,
        motion: &mut [f64],
    ) {
        let system = self.system;
        self.rows.fill(0.0);
        self.independent_rows(|coordinate| {
            let scale = system.column_scale(coordinate.column);
            if is_forward() { -scale } else { scale }
        });
        self.scaled_rows(motion);
        factors.solve(motion);
        system.scale_columns(motion);
    }

    /// Brings the independent coordinates to their values and the others along, by the factors of another position.
    pub fn slide(&mut self, factors: &mut SparseLu, q: &mut [f64]) {
        self.rows.fill(0.0);
        self.independent_rows(|coordinate| q[coordinate.column] - coordinate.jet[0]);
        self.step_by(factors, q);
    }

    /// Adds what the rows at hand ask for, by the factors of another position.
    fn step_by(&mut self, factors: &mut SparseLu, x: &mut [f64]) {
        let mut step = std::mem::take(&mut self.work);
        self.scaled_rows(&mut step);
        factors.solve(&mut step);
        self.system.scale_columns(&mut step);
        x.iter_mut().zip(&step).for_each(|(x, step)| *x += step);
        self.work = step;
    }

    /// K motions (n) in which independent coordinate k has these rates, by the factors of another position.
    pub fn follow<const K: usize>(
        &self,
        factors: &mut SparseLu,
        rates: impl Fn(usize) -> [f64; K],
        motions: &mut [[f64; K]],
    ) {
        let m = self.system.m();
        let rows = self.selection.active.iter().zip(self.row_scales.iter());
        for (sides, (&row, scale)) in motions.iter_mut().zip(rows) {
            *sides = match row.checked_sub(m) {
                Some(k) => rates(k).map(|rate| -rate / scale),
                None => [0.0; K],
            };
        }
        factors.solve_together(motions);
        for (column, motion) in motions.iter_mut().enumerate() {
            let scale = self.system.column_scale(column);
            motion.iter_mut().for_each(|x| *x *= scale);
        }
    }

    /// Keeps the factors at hand in another place.
    pub fn keep_factors(&self, place: &mut Option<SparseLu>) {
        match place {
            Some(kept) => kept.take_over(&self.lu),
            None => *place = Some(self.lu.clone()),
        }
    }

    fn motions(&mut self, drivers: Option<&Inputs>, tangents: &mut [f64], drift: &mut [f64]) {
        let (n, f) = (self.system.n(), self.independent.len());
        let all = f + usize::from(drivers.is_some());
        let mut first = 0;
        while first < all {
            let count = (all - first).min(TOGETHER);
            let motions = Motions {
                first,
                coordinates: count.min(f - first),
                drivers: drivers.filter(|_| first + count > f),
            };
            let tangents = &mut tangents[first * n..];
            self.count(count, motions, tangents, drift);
            first += count;
        }
    }

    /// So many motions, at most [`TOGETHER`].
    fn count(&mut self, count: usize, motions: Motions, tangents: &mut [f64], drift: &mut [f64]) {
        match count {
            1 => self.some::<1>(motions, tangents, drift),
            2 => self.some::<2>(motions, tangents, drift),
            3 => self.some::<3>(motions, tangents, drift),
            _ => self.some::<TOGETHER>(motions, tangents, drift),
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
        // One of them has room elsewhere.
        let room = match K {
            1 => &mut self.work,
            _ => &mut self.together,
        };
        if room.len() < K * n {
            room.resize(K * n, 0.0);
        }
        let together = room[..K * n].as_chunks_mut::<K>().0;
        let rows = self.selection.active.iter().zip(self.row_scales.iter());
        for (sides, (&row, scale)) in together.iter_mut().zip(rows) {
            *sides = [0.0; K];
            match row.checked_sub(m) {
                Some(k) if k >= first && k - first < coordinates => sides[k - first] = -1.0 / scale,
                None if drivers.is_some() => sides[coordinates] = -self.rows[row] / scale,
                Some(_) | None => {}
            }
        }
        self.lu.solve_together(together);
        let columns = tangents.chunks_exact_mut(n.max(1));
        let all = columns.take(coordinates).chain(drivers.map(|_| drift));
        for (k, motion) in all.enumerate() {
            for (to, sides) in motion.iter_mut().zip(&*together) {
                *to = sides[k];
            }
            self.system.scale_columns(motion);
        }
    }
}
