//! The accepted points of a motion, and the positions that they predict.

use linkdyn_linear::hermite::{Node, quintic};

/// The last two accepted points, and S at the later one where it is at hand.
pub(super) struct Accepted {
    /// The later one: time, position, velocity and acceleration (n).
    pub here: Node,
    before: Option<Node>,
    /// S there, one tangent after the other (f × n), or nothing.
    pub tangents: Vec<f64>,
}

impl Accepted {
    /// The first point.
    pub fn new(time: f64, q: &[f64], v: &[f64]) -> Self {
        let n = q.len();
        Accepted {
            here: Node {
                s: time,
                q: q.to_vec(),
                d: v.to_vec(),
                dd: vec![0.0; n],
            },
            before: None,
            tangents: Vec::new(),
        }
    }

    /// The position at `time` by extrapolation, with these independent coordinates where S is at hand.
    pub fn predict(
        &self,
        time: f64,
        independent: impl Iterator<Item = (usize, f64)>,
        q: &mut [f64],
    ) {
        match &self.before {
            Some(before) if before.s < self.here.s => quintic(before, &self.here, time, q, None),
            _ => {
                let h = time - self.here.s;
                let jets = self.here.q.iter().zip(&self.here.d).zip(&self.here.dd);
                for (q, ((q0, d), dd)) in q.iter_mut().zip(jets) {
                    *q = q0 + h * (d + 0.5 * h * dd);
                }
            }
        }
        let n = q.len();
        for ((column, value), tangent) in independent.zip(self.tangents.chunks_exact(n.max(1))) {
            let off = value - q[column];
            q.iter_mut().zip(tangent).for_each(|(q, s)| *q += off * s);
        }
    }

    /// Takes a point for the later one from now on; at the same time it takes the place of that. The earlier one is kept where
    /// positions are predicted from both.
    pub fn keep(&mut self, time: f64, [q, v, a]: [&[f64]; 3], tangents: &[f64], predicts: bool) {
        if !predicts {
            self.before = None;
        } else if self.here.s != time {
            let before = self.before.get_or_insert_with(|| self.here.clone());
            std::mem::swap(before, &mut self.here);
        }
        self.here.s = time;
        self.here.q.copy_from_slice(q);
        self.here.d.copy_from_slice(v);
        self.here.dd.copy_from_slice(a);
        self.tangents.clear();
        self.tangents.extend_from_slice(tangents);
    }

    /// Sets the earlier point aside, for what evaluates the later one anew.
    pub fn set_aside(&mut self) -> Option<Node> {
        self.before.take()
    }

    /// Takes the earlier point back.
    pub fn take_back(&mut self, before: Option<Node>) {
        self.before = before;
    }
}
