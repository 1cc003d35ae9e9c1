//! The accepted points of a motion, and the positions that they predict.

use linkdyn_linear::hermite::{Node, quintic};

/// The last two accepted points, and S at the later one where it is at hand. On a curve that comes round nothing is predicted from
/// them: of the later one there is no more than what it is found again by.
#[derive(Clone)]
pub(super) struct Accepted {
    /// The later one: time, position, velocity and acceleration (n), or nothing.
    pub here: Node,
    before: Option<Node>,
    /// S there, one tangent after the other (f × n), or nothing.
    tangents: Vec<f64>,
    /// (u, u̇) there.
    pub state: Vec<f64>,
    /// Whether another coordinate moves more than an independent one, where tangents told it.
    pub has_better: bool,
}

/// A point that is to be kept.
pub(super) struct AcceptedPoint<'a> {
    /// When it is \[s\].
    pub time: f64,
    /// q, v, a (n).
    pub jets: [&'a [f64]; 3],
    /// S, where it is at hand.
    pub tangents: &'a [f64],
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
            state: Vec::new(),
            has_better: false,
        }
    }

    /// Whether the later point is there with all that it is.
    pub fn is_whole(&self) -> bool {
        !self.here.q.is_empty()
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

    /// Takes a point for the later one from now on; at the same time it takes the place of that.
    pub fn keep(&mut self, point: AcceptedPoint) {
        if self.is_whole() && self.here.s != point.time {
            let before = self.before.get_or_insert_with(|| self.here.clone());
            std::mem::swap(before, &mut self.here);
        }
        self.put(&point);
        self.tangents.clear();
        self.tangents.extend_from_slice(point.tangents);
    }

    /// Puts a point in the place of the later one.
    pub fn put(&mut self, point: &AcceptedPoint) {
        self.here.s = point.time;
        let Node { q, d, dd, .. } = &mut self.here;
        for (own, jet) in [q, d, dd].into_iter().zip(point.jets) {
            own.clear();
            own.extend_from_slice(jet);
        }
    }

    /// Takes a point of a curve that comes round.
    pub fn pass(&mut self, time: f64) {
        self.here.s = time;
        let Node { q, d, dd, .. } = &mut self.here;
        let all = [q, d, dd, &mut self.tangents].into_iter();
        all.for_each(|own| *own = Vec::new());
        self.before = None;
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
