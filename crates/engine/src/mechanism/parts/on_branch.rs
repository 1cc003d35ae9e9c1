//! What stands for a part's joints near a change point: its coordinates by one of them, as the smooth branch has them.
//!
//! ```text
//! φ = c_i − Q_i(s)                                  s the independent coordinate, of the same kind as the c_i
//! c = r, θ                                          seen from ground
//! c = Rᵀ (r − r_B), θ − θ_B                         seen from a body B turned by R(θ_B)
//! ċ = Rᵀ (v − v_B) − ω_B ĉ                          ĉ = (−c_y, c_x)
//! c̈ = Rᵀ (a − a_B) − α_B ĉ − 2 ω_B û − ω_B² c       u = Rᵀ (v − v_B)
//! ```

use crate::element::{Axis, BodyId, Constraint, Entry, Equations, Kinematics, Measure};
use crate::mechanism::continuation::Branch;
use linkdyn_linear::math::Vec2;
use std::sync::Arc;

/// A coordinate of a body as another one, or ground, sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seen {
    pub body: BodyId,
    pub axis: Axis,
    /// Who sees it.
    pub from: BodyId,
}

impl Seen {
    /// Its value, from the places of the body and of who sees it.
    pub fn of(self, own: [f64; 3], frame: Option<[f64; 3]>) -> f64 {
        let Some([x, y, theta]) = frame else {
            return own[self.axis as usize];
        };
        let (sin, cos) = theta.sin_cos();
        let (dx, dy) = (own[0] - x, own[1] - y);
        match self.axis {
            Axis::X => cos * dx + sin * dy,
            Axis::Y => cos * dy - sin * dx,
            Axis::Theta => own[2] - theta,
        }
    }

    /// Who sees it, where that moves.
    fn frame(self) -> Option<BodyId> {
        (self.from != BodyId::GROUND).then_some(self.from)
    }

    fn value(self, at: &Kinematics) -> f64 {
        let place = |body: BodyId| {
            let pose = &at.poses[body.0];
            [pose.r.x, pose.r.y, pose.theta]
        };
        self.of(place(self.body), self.frame().map(place))
    }

    /// c and u, where a moving body sees it.
    fn seen(self, at: &Kinematics) -> (Vec2, Vec2) {
        let (own, base) = (&at.poses[self.body.0], &at.poses[self.from.0]);
        let back = |d: Vec2| {
            Vec2::new(
                base.cos * d.x + base.sin * d.y,
                base.cos * d.y - base.sin * d.x,
            )
        };
        let (own_twist, twist) = (&at.twists[self.body.0], &at.twists[self.from.0]);
        (back(own.r - base.r), back(own_twist.v - twist.v))
    }

    /// ċ.
    fn rate(self, at: &Kinematics) -> f64 {
        let own = &at.twists[self.body.0];
        if self.frame().is_none() {
            return [own.v.x, own.v.y, own.omega][self.axis as usize];
        }
        let omega = at.twists[self.from.0].omega;
        let (c, u) = self.seen(at);
        match self.axis {
            Axis::X => u.x + omega * c.y,
            Axis::Y => u.y - omega * c.x,
            Axis::Theta => own.omega - omega,
        }
    }

    /// Part of c̈ that is quadratic in velocities.
    fn bend(self, at: &Kinematics) -> f64 {
        if self.frame().is_none() || self.axis == Axis::Theta {
            return 0.0;
        }
        let omega = at.twists[self.from.0].omega;
        let (c, u) = self.seen(at);
        match self.axis {
            Axis::X => 2.0 * omega * u.y - omega * omega * c.x,
            Axis::Y => -2.0 * omega * u.x - omega * omega * c.y,
            Axis::Theta => 0.0,
        }
    }

    /// Coordinates of the whole that it depends on.
    fn depends_on(self) -> impl Iterator<Item = (BodyId, Axis)> {
        let moves = self.axis != Axis::Theta && self.frame().is_some();
        let own: &[Axis] = match (moves, self.axis) {
            (true, _) => &[Axis::X, Axis::Y],
            (false, Axis::X) => &[Axis::X],
            (false, Axis::Y) => &[Axis::Y],
            (false, Axis::Theta) => &[Axis::Theta],
        };
        let base: &[Axis] = match (self.frame(), moves) {
            (None, _) => &[],
            (Some(_), true) => &[Axis::X, Axis::Y, Axis::Theta],
            (Some(_), false) => &[Axis::Theta],
        };
        let of = |body: BodyId, axes: &'static [Axis]| axes.iter().map(move |axis| (body, *axis));
        of(self.body, own).chain(of(self.from, base))
    }

    /// Its derivative by a coordinate of the whole.
    fn slope(self, at: &Kinematics, (body, axis): (BodyId, Axis)) -> f64 {
        let Some(frame) = self.frame() else {
            return f64::from(u8::from(body == self.body && axis == self.axis));
        };
        let base = &at.poses[frame.0];
        if body == self.body {
            return match (self.axis, axis) {
                (Axis::X, Axis::X) | (Axis::Y, Axis::Y) => base.cos,
                (Axis::X, Axis::Y) => base.sin,
                (Axis::Y, Axis::X) => -base.sin,
                (Axis::Theta, Axis::Theta) => 1.0,
                (Axis::X | Axis::Y, Axis::Theta) | (Axis::Theta, Axis::X | Axis::Y) => 0.0,
            };
        }
        if body != frame {
            return 0.0;
        }
        match (self.axis, axis) {
            (Axis::X, Axis::X) | (Axis::Y, Axis::Y) => -base.cos,
            (Axis::X, Axis::Y) => -base.sin,
            (Axis::Y, Axis::X) => base.sin,
            (Axis::X, Axis::Theta) => self.seen(at).0.y,
            (Axis::Y, Axis::Theta) => -self.seen(at).0.x,
            (Axis::Theta, Axis::Theta) => -1.0,
            (Axis::Theta, Axis::X | Axis::Y) => 0.0,
        }
    }
}

/// q_i − Q_i(s) = 0 for some coordinates of a part.
pub(super) struct OnBranch {
    branch: Arc<Branch>,
    /// Of the part.
    columns: Vec<usize>,
    /// The same in the whole.
    coordinates: Vec<Seen>,
    independent: Seen,
    entries: Vec<Entry>,
}

impl OnBranch {
    /// For columns of a part, which are these coordinates, by the independent one.
    pub fn new(
        (branch, columns): (Arc<Branch>, Vec<usize>),
        coordinates: Vec<Seen>,
        independent: Seen,
    ) -> Self {
        let mut entries: Vec<Entry> = Vec::new();
        for (row, coordinate) in coordinates.iter().enumerate() {
            for (body, axis) in coordinate.depends_on().chain(independent.depends_on()) {
                if !entries.contains(&(row, body, axis)) {
                    entries.push((row, body, axis));
                }
            }
        }
        OnBranch {
            branch,
            columns,
            coordinates,
            independent,
            entries,
        }
    }
}

const L: Measure = Measure::Length;
const A: Measure = Measure::Angle;
/// By what rows measure: bit k says that row k is an angle.
const MEASURES: [[Measure; 3]; 8] = [
    [L, L, L],
    [A, L, L],
    [L, A, L],
    [A, A, L],
    [L, L, A],
    [A, L, A],
    [L, A, A],
    [A, A, A],
];

impl Equations for OnBranch {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        let s = self.independent.value(at);
        let coordinates = self.columns.iter().zip(&self.coordinates);
        for (phi, (&column, coordinate)) in phi.iter_mut().zip(coordinates) {
            *phi = coordinate.value(at) - self.branch.jet(column, s)[0];
        }
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        let s = self.independent.value(at);
        let (mut known, mut by_s) = (usize::MAX, 0.0);
        for (value, &(row, body, axis)) in values.iter_mut().zip(&self.entries) {
            if row != known {
                (known, by_s) = (row, self.branch.jet(self.columns[row], s)[1]);
            }
            let place = (body, axis);
            *value =
                self.coordinates[row].slope(at, place) - by_s * self.independent.slope(at, place);
        }
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t.fill(0.0);
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let (s, rate) = (self.independent.value(at), self.independent.rate(at));
        let bend = self.independent.bend(at);
        let coordinates = self.columns.iter().zip(&self.coordinates);
        for (gamma, (&column, coordinate)) in gamma.iter_mut().zip(coordinates) {
            let [_, d, dd] = self.branch.jet(column, s);
            *gamma = dd * rate * rate - coordinate.bend(at) + d * bend;
        }
    }
}

impl Constraint for OnBranch {
    fn rows(&self) -> &'static [Measure] {
        let angles = self
            .coordinates
            .iter()
            .enumerate()
            .map(|(k, coordinate)| usize::from(coordinate.axis == Axis::Theta) << k);
        &MEASURES[angles.sum::<usize>()][..self.columns.len()]
    }

    fn entries(&self) -> Vec<Entry> {
        self.entries.clone()
    }

    /// The joints' own equations tell their reactions.
    fn reaction(&self, _at: &Kinematics, _lambda: &[f64]) -> (Vec2, f64) {
        (Vec2::zeros(), 0.0)
    }
}
