//! A force along the line of two points: a hydraulic cylinder, a gas spring.
//!
//! ```text
//! u = d/l as in `spring`;  force −F u on the first body, +F u on the second: F pushes them apart      [N]
//! ∂(F u) = u ∂F + F P ∂d/l
//! ```

use super::formula::Strength;
use super::span::{BOTH, Span, all_pairs};
use super::{Applied, Axis, Force, Kinematics, Marker, Slope, direction};

/// A force between two points.
#[derive(Debug, Clone)]
pub struct Actuator {
    /// One end.
    pub first: Marker,
    /// The other end.
    pub second: Marker,
    /// F \[N\]
    pub force: Strength,
}

impl Force for Actuator {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        // Points that coincide have no line: the force has no direction there and is left out.
        let Some((u, _)) = direction(self.second.place(at) - self.first.place(at)) else {
            return;
        };
        let force = u * self.force.value(at);
        to.add_force(at, &self.first, -force);
        to.add_force(at, &self.second, force);
    }

    fn slopes(&self) -> Vec<Slope> {
        let of = |marker: &Marker| Axis::ALL.map(|axis| (marker.body, axis));
        let rows = [of(&self.first), of(&self.second)].concat();
        let of_force = self.force.columns();
        let of_force = of_force
            .iter()
            .flat_map(|column| rows.iter().map(|row| [*row, *column]));
        let of_line = all_pairs(&self.first, &self.second);
        of_line.into_iter().chain(of_force).collect()
    }

    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        position.fill(0.0);
        velocity.fill(0.0);
        let d = self.second.place(at) - self.first.place(at);
        let Some((u, length)) = direction(d) else {
            return;
        };
        let force = self.force.value(at);
        let span = Span::at(at, &self.first, &self.second);
        let (of_line, by_position) = position.split_at_mut(BOTH * BOTH);
        for column in 0..BOTH {
            let moved = span.spread(column);
            let across = (moved - u * u.dot(&moved)) / length;
            span.add_force(across * force, column, of_line);
        }
        span.add_turned(u * force, of_line);
        let by_velocity = &mut velocity[BOTH * BOTH..];
        let mut place = 0;
        self.force.each_slope(at, |[of_q, of_v]| {
            for row in 0..BOTH {
                let arm = span.spread(row).dot(&u);
                by_position[place] = arm * of_q;
                by_velocity[place] = arm * of_v;
                place += 1;
            }
        });
    }

    fn potential(&self, _at: &Kinematics) -> f64 {
        0.0
    }

    fn is_conservative(&self) -> bool {
        false
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        let Some((u, _)) = direction(self.second.place(at) - self.first.place(at)) else {
            return 0.0;
        };
        let rate = u.dot(&(self.second.velocity(at) - self.first.velocity(at)));
        self.force.value(at) * rate
    }
}
