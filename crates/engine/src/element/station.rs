//! A cross-section of an elastic link, carried by the frame of its deflections and by the amplitudes of its modes.
//!
//! ```text
//! u = X + Σ Φ_i q_i + ½ Σ Γ_ij q_i q_j                       in the frame of the deflections [m]
//! φ = (R + A u − r, θ + Σ ϑ_i q_i − θ_s)                     (3)  [m, m, rad]
//! γ = −(−ω² A u + 2 ω (A u̇)⊥ + Σ A Γ_ij q̇_i q̇_j, 0)         u̇ = Σ (Φ_i + Σ Γ_ij q_j) q̇_i
//! ```
//!
//! R and θ are the frame's, r and θ_s the section's. Γ is the foreshortening of a bar that bends (Kane, Ryan and Banerjee, Dynamics
//! of a cantilever beam attached to a moving base, 1987): without it a link that turns fast softens instead of stiffening.
//! The amplitudes stand in the coordinates x and y of bodies of their own, two in each. λ is force and torque of the frame on the section.

use super::{Axis, BodyId, Constraint, Entry, Equations, Kinematics, Layout, Measure, Slope};
use linkdyn_linear::math::{Vec2, perp};

/// Where an amplitude stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitude {
    /// The body of two amplitudes.
    pub body: BodyId,
    /// Which of them.
    pub axis: Axis,
}

impl Amplitude {
    /// q \[m\].
    pub fn value(self, at: &Kinematics) -> f64 {
        at.poses[self.body.0].r[self.axis as usize]
    }

    /// q̇ [m/s].
    pub fn rate(self, at: &Kinematics) -> f64 {
        at.twists[self.body.0].v[self.axis as usize]
    }
}

/// How a section moves by one amplitude.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AmplitudeShare {
    /// The amplitude.
    pub amplitude: Amplitude,
    /// Φ [–].
    pub moves: Vec2,
    /// ϑ [rad/m].
    pub turns: f64,
}

/// A section of an elastic link.
#[derive(Debug, Clone)]
pub struct CarriedSection {
    /// The frame.
    pub frame: BodyId,
    /// The section.
    pub section: BodyId,
    /// X \[m\], from the frame's origin.
    pub place: Vec2,
    /// By each amplitude (n).
    pub shares: Vec<AmplitudeShare>,
    /// Γ (n × n by rows) [1/m]; empty where nothing shortens.
    pub shortens: Vec<Vec2>,
}

impl CarriedSection {
    /// Γ of one amplitude by each.
    fn row(&self, share: usize) -> &[Vec2] {
        let n = self.shares.len();
        match self.shortens.is_empty() {
            true => &[],
            false => &self.shortens[share * n..(share + 1) * n],
        }
    }

    /// Each amplitude with Φ_i + Σ Γ_ij q_j.
    fn slopes<'s>(
        &'s self,
        at: &'s Kinematics,
    ) -> impl Iterator<Item = (Vec2, &'s AmplitudeShare)> + 's {
        self.shares.iter().enumerate().map(|(k, share)| {
            let bent = self.row(k).iter().zip(&self.shares);
            let slope = bent.fold(share.moves, |sum, (second, other)| {
                sum + second * other.amplitude.value(at)
            });
            (slope, share)
        })
    }

    /// u \[m\].
    fn deflected(&self, at: &Kinematics) -> Vec2 {
        self.slopes(at).fold(self.place, |sum, (slope, share)| {
            sum + (share.moves + slope) * (0.5 * share.amplitude.value(at))
        })
    }

    /// u \[m\] and u̇ [m/s].
    fn deflected_with_rate(&self, at: &Kinematics) -> [Vec2; 2] {
        let none = [self.place, Vec2::zeros()];
        self.slopes(at).fold(none, |[place, rate], (slope, share)| {
            [
                place + (share.moves + slope) * (0.5 * share.amplitude.value(at)),
                rate + slope * share.amplitude.rate(at),
            ]
        })
    }

    /// Where the section is: its place \[m\] and angle \[rad\].
    pub fn pose(&self, at: &Kinematics) -> (Vec2, f64) {
        let frame = &at.poses[self.frame.0];
        let turn = self
            .shares
            .iter()
            .map(|share| share.turns * share.amplitude.value(at));
        let place = frame.r + frame.turn(self.deflected(at));
        (place, frame.theta + turn.sum::<f64>())
    }

    /// How it moves: its velocity [m/s] and angular velocity [rad/s].
    pub fn twist(&self, at: &Kinematics) -> (Vec2, f64) {
        let (frame, twist) = (&at.poses[self.frame.0], &at.twists[self.frame.0]);
        let turn = self
            .shares
            .iter()
            .map(|share| share.turns * share.amplitude.rate(at));
        let [place, rate] = self.deflected_with_rate(at);
        let carried = perp(frame.turn(place)) * twist.omega;
        (
            twist.v + carried + frame.turn(rate),
            twist.omega + turn.sum::<f64>(),
        )
    }
}

impl CarriedSection {
    /// Σ Γ_ij q̇_i q̇_j [m/s²].
    fn shortening(&self, at: &Kinematics) -> Vec2 {
        let mut bent = Vec2::zeros();
        for (k, share) in self.shares.iter().enumerate() {
            let others = self.row(k).iter().zip(&self.shares);
            let own = others.fold(Vec2::zeros(), |sum, (second, other)| {
                sum + second * other.amplitude.rate(at)
            });
            bent += own * share.amplitude.rate(at);
        }
        bent
    }

    /// Its acceleration [m/s²] beside that of the place of the frame where it is when nothing is deflected, by accelerations (n).
    pub fn vibrates(&self, at: &Kinematics, a: &[f64], layout: &Layout) -> Vec2 {
        let (frame, omega) = (&at.poses[self.frame.0], at.twists[self.frame.0].omega);
        let of =
            |body: BodyId, axis: Axis| layout.column(body, axis).map_or(0.0, |column| a[column]);
        let [place, rate] = self.deflected_with_rate(at);
        let own = self
            .slopes(at)
            .fold(self.shortening(at), |sum, (slope, share)| {
                sum + slope * of(share.amplitude.body, share.amplitude.axis)
            });
        let off = frame.turn(place - self.place);
        perp(off) * of(self.frame, Axis::Theta) - off * (omega * omega)
            + perp(frame.turn(rate)) * (2.0 * omega)
            + frame.turn(own)
    }
}

impl Equations for CarriedSection {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        let (place, angle) = self.pose(at);
        let section = &at.poses[self.section.0];
        let gap = place - section.r;
        phi.copy_from_slice(&[gap.x, gap.y, angle - section.theta]);
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        let frame = &at.poses[self.frame.0];
        let (places, turns) = values.split_at_mut(6 + 2 * self.shares.len());
        let mut place = self.place;
        for (values, (slope, share)) in places[6..].chunks_exact_mut(2).zip(self.slopes(at)) {
            place += (share.moves + slope) * (0.5 * share.amplitude.value(at));
            let along = frame.turn(slope);
            values.copy_from_slice(&[along.x, along.y]);
        }
        let arm = perp(frame.turn(place));
        places[..6].copy_from_slice(&[1.0, arm.x, -1.0, 1.0, arm.y, -1.0]);
        turns[..2].copy_from_slice(&[1.0, -1.0]);
        for (value, share) in turns[2..].iter_mut().zip(&self.shares) {
            *value = share.turns;
        }
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t.fill(0.0);
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let (frame, omega) = (&at.poses[self.frame.0], at.twists[self.frame.0].omega);
        let bent = self.shortening(at);
        let [place, rate] = self.deflected_with_rate(at);
        let g = frame.turn(place * (omega * omega) - bent) - perp(frame.turn(rate)) * (2.0 * omega);
        gamma.copy_from_slice(&[g.x, g.y, 0.0]);
    }
}

impl Constraint for CarriedSection {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length, Measure::Length, Measure::Angle]
    }

    fn entries(&self) -> Vec<Entry> {
        let (frame, section) = (self.frame, self.section);
        let mut entries = vec![
            (0, frame, Axis::X),
            (0, frame, Axis::Theta),
            (0, section, Axis::X),
            (1, frame, Axis::Y),
            (1, frame, Axis::Theta),
            (1, section, Axis::Y),
        ];
        let amplitudes = || self.shares.iter().map(|share| share.amplitude);
        entries.extend(amplitudes().flat_map(|q| [(0, q.body, q.axis), (1, q.body, q.axis)]));
        entries.extend([(2, frame, Axis::Theta), (2, section, Axis::Theta)]);
        entries.extend(amplitudes().map(|q| (2, q.body, q.axis)));
        entries
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        let turn = (self.frame, Axis::Theta);
        let of = |share: &AmplitudeShare| (share.amplitude.body, share.amplitude.axis);
        let mut pattern = vec![[turn, turn]];
        for (i, share) in self.shares.iter().enumerate() {
            pattern.push([turn, of(share)]);
            let others = self.shares[..=i].iter().take(self.row(i).len());
            pattern.extend(others.map(|other| [of(share), of(other)]));
        }
        pattern
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let frame = &at.poses[self.frame.0];
        let force = Vec2::new(lambda[0], lambda[1]);
        let mut values = values.iter_mut();
        let mut put = |value: f64| {
            if let Some(to) = values.next() {
                *to = value;
            }
        };
        put(-force.dot(&frame.turn(self.deflected(at))));
        for (i, (slope, _)) in self.slopes(at).enumerate() {
            put(force.dot(&perp(frame.turn(slope))));
            for second in self.row(i).iter().take(i + 1) {
                put(force.dot(&frame.turn(*second)));
            }
        }
    }

    fn is_linear(&self, row: usize) -> bool {
        row == 2
    }

    fn reaction(&self, _at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        (Vec2::new(lambda[0], lambda[1]), lambda[2])
    }
}

/// Coordinates of a body that stay zero: those in which no amplitude stands.
#[derive(Debug, Clone)]
pub struct Still {
    /// The body.
    pub body: BodyId,
    /// Which of them.
    pub axes: &'static [Axis],
}

impl Equations for Still {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        let pose = &at.poses[self.body.0];
        let place = [pose.r.x, pose.r.y, pose.theta];
        for (phi, axis) in phi.iter_mut().zip(self.axes) {
            *phi = place[*axis as usize];
        }
    }

    fn jacobian(&self, _at: &Kinematics, values: &mut [f64]) {
        values.fill(1.0);
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t.fill(0.0);
    }

    fn gamma(&self, _at: &Kinematics, gamma: &mut [f64]) {
        gamma.fill(0.0);
    }
}

impl Constraint for Still {
    fn rows(&self) -> &'static [Measure] {
        match self.axes {
            [Axis::Theta] => &[Measure::Angle],
            _ => &[Measure::Length, Measure::Angle],
        }
    }

    fn entries(&self) -> Vec<Entry> {
        let axes = self.axes.iter().enumerate();
        axes.map(|(row, axis)| (row, self.body, *axis)).collect()
    }

    fn is_constant(&self, _entry: usize) -> bool {
        true
    }

    fn reaction(&self, _at: &Kinematics, _lambda: &[f64]) -> (Vec2, f64) {
        (Vec2::zeros(), 0.0)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::element::tests::Named;

    /// Sections with and without foreshortening, for the shared checks.
    pub(in crate::element) fn all() -> Vec<Named> {
        let share = |axis: Axis, moves: [f64; 2], turns: f64| AmplitudeShare {
            amplitude: Amplitude {
                body: BodyId(3),
                axis,
            },
            moves: moves.into(),
            turns,
        };
        let station = |shares: Vec<AmplitudeShare>, second: &[[f64; 2]]| CarriedSection {
            frame: BodyId(1),
            section: BodyId(2),
            place: Vec2::new(0.7, -0.1),
            shares,
            shortens: second.iter().map(|&both| Vec2::from(both)).collect(),
        };
        vec![
            (
                "still",
                Box::new(Still {
                    body: BodyId(3),
                    axes: &[Axis::Y, Axis::Theta],
                }),
            ),
            (
                "section",
                Box::new(station(vec![share(Axis::Y, [0.2, 0.9], -1.5)], &[])),
            ),
            (
                "section of a bar that shortens",
                Box::new(station(
                    vec![
                        share(Axis::X, [0.1, 1.0], 2.0),
                        share(Axis::Y, [-0.2, 0.4], 0.5),
                    ],
                    &[[-0.8, 0.1], [0.3, 0.2], [0.3, 0.2], [-0.5, 0.0]],
                )),
            ),
        ]
    }
}
