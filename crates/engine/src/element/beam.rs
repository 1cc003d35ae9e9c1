//! Beam: an elastic bar between two bodies, which bends, stretches and, if it is so made, shears; it has no mass.
//!
//! In the frame of the line between its ends (length l, direction β) it is a slender bar with rotations θ₁, θ₂ of its ends:
//!
//! ```text
//! d = P₂ − P₁,  l = |d|,  β = arg d         θᵢ = (angle of body i) + αᵢ − β         αᵢ: direction of the end in its body
//! a = (θ₁ − θ₂)/2,  s = (θ₁ + θ₂)/2         Φ = 12 EI/(GA L²), 0 without shear      ŝ = s/(1 + Φ),  γ = s Φ/(1 + Φ)
//! ε = (l/L) cos γ − 1 + a²/6 + ŝ²/10        η = (l/L) sin γ
//! V = ½ EA L ε² + ½ GA L η² + EI/L (2 a² + 6 ŝ²)
//! ```
//!
//! a bends it into an arc, s into an S; γ is the mean angle of shear, a²/6 + ŝ²/10 what the arc is longer than its chord: so a load along
//! the bar changes its stiffness against bending, to second order, and buckling is met. Q = −(∂V/∂q)ᵀ. Damping adds β K₀ u̇ to the
//! forces of u = (l, θ₁, θ₂), with K₀ the second derivatives of V where nothing is loaded.
//!
//! A chain of such beams is the corotational beam (Crisfield, Non-linear Finite Element Analysis of Solids and Structures 1, 1991,
//! sec. 7.3, with its shallow arc), of order 4 in the length of its parts; with shear it goes to the geometrically exact beam (Simo, A
//! finite strain beam formulation, 1985): strains ε and η are along and across the turned cross-section. The potential is exact for large
//! rotations of the bodies as long as θ₁ and θ₂ are small, which more parts make so.

use super::span::{BOTH, Span, all_pairs};
use super::{Applied, Force, Kinematics, Marker, Slope};
use linkdyn_linear::math::{Vec2, perp};
use std::f64::consts::TAU;

/// Coordinates of the function V: d by x and y, and the angles of both bodies.
const FREE: usize = 4;
/// l, θ₁, θ₂.
const LOCAL: usize = 3;

/// An elastic bar between two bodies.
#[derive(Debug, Clone, Copy)]
pub struct Beam {
    /// Its beginning.
    pub first: Marker,
    /// Its end.
    pub second: Marker,
    /// EA \[N\], EI [N·m²] and GA \[N\], infinite without shear.
    pub stiffness: [f64; 3],
    /// L \[m\]
    pub length: f64,
    /// α₁ and α₂ \[rad\].
    pub angles: [f64; 2],
    /// β \[s\]
    pub damping: f64,
}

/// V with its first and second derivatives by l, θ₁ and θ₂.
struct Energy {
    value: f64,
    gradient: [f64; LOCAL],
    second: [[f64; LOCAL]; LOCAL],
}

/// Where its ends are.
struct Chord {
    /// d/l and its left normal.
    axes: [Vec2; 2],
    l: f64,
    theta: [f64; 2],
}

impl Chord {
    /// A derivative of l, θ₁ or θ₂ by d and the angles.
    fn slope(&self, k: usize) -> [f64; FREE] {
        let [along, across] = self.axes;
        match k {
            0 => [along.x, along.y, 0.0, 0.0],
            _ => {
                let [x, y] = (across / -self.l).into();
                [x, y, f64::from(k == 1), f64::from(k == 2)]
            }
        }
    }

    /// Second derivatives by d of l and of −β.
    fn curvature(&self, of_length: bool) -> [[f64; 2]; 2] {
        let [e, n] = self.axes;
        let entry = |i: usize, j: usize| {
            if of_length {
                n[i] * n[j] / self.l
            } else {
                (e[i] * n[j] + n[i] * e[j]) / (self.l * self.l)
            }
        };
        [0, 1].map(|i| [0, 1].map(|j| entry(i, j)))
    }

    /// Second derivatives by d and the angles of f·u, with the numbers f by l, θ₁ and θ₂.
    fn bent(&self, f: [f64; LOCAL]) -> [[f64; FREE]; FREE] {
        let mut bent = [[0.0; FREE]; FREE];
        let (length, turn) = (self.curvature(true), self.curvature(false));
        for i in 0..2 {
            for j in 0..2 {
                bent[i][j] = f[0] * length[i][j] + (f[1] + f[2]) * turn[i][j];
            }
        }
        bent
    }
}

impl Beam {
    fn chord(&self, at: &Kinematics) -> Chord {
        let d = self.second.place(at) - self.first.place(at);
        let l = d.norm();
        let along = if l > 0.0 { d / l } else { Vec2::x() };
        let beta = along.y.atan2(along.x);
        let turned = |marker: &Marker, angle: f64| {
            let theta = at.poses[marker.body.0].theta + angle - beta;
            theta - TAU * (theta / TAU).round()
        };
        Chord {
            axes: [along, perp(along)],
            // Ends that meet have no direction; they are kept apart by what is far less than any length.
            l: l.max(f64::EPSILON * self.length),
            theta: [
                turned(&self.first, self.angles[0]),
                turned(&self.second, self.angles[1]),
            ],
        }
    }

    /// Φ
    fn shear(&self) -> f64 {
        let [_, bending, shear] = self.stiffness;
        12.0 * bending / (shear * self.length * self.length)
    }

    fn energy(&self, chord: &Chord) -> Energy {
        let [axial, bending, shear] = self.stiffness;
        let (length, phi) = (self.length, self.shear());
        let [first, second] = chord.theta;
        let (a, s) = ((first - second) / 2.0, (first + second) / 2.0);
        let (bends, shears) = (1.0 / (1.0 + phi), phi / (1.0 + phi));
        let (hat, ratio) = (s * bends, chord.l / length);
        let (sin, cos) = (s * shears).sin_cos();
        let strain = ratio * cos - 1.0 + a * a / 6.0 + hat * hat / 10.0;
        let slip = ratio * sin;
        // Infinite against no slip at all.
        let shear = if phi > 0.0 { shear } else { 0.0 };
        let (ea, ga, ei) = (axial * length, shear * length, bending / length);
        let value =
            0.5 * (ea * strain * strain + ga * slip * slip) + ei * (2.0 * a * a + 6.0 * hat * hat);
        // By l, s and a: first derivatives of strain and slip, then the second ones.
        let strains = [
            cos / length,
            -ratio * sin * shears + hat * bends / 5.0,
            a / 3.0,
        ];
        let slips = [sin / length, ratio * cos * shears, 0.0];
        let mut gradient: [f64; LOCAL] =
            [0, 1, 2].map(|k| ea * strain * strains[k] + ga * slip * slips[k]);
        gradient[1] += 12.0 * ei * hat * bends;
        gradient[2] += 4.0 * ei * a;
        let mut h = [0, 1, 2]
            .map(|i| [0, 1, 2].map(|j| ea * strains[i] * strains[j] + ga * slips[i] * slips[j]));
        let mixed = (-ea * strain * sin + ga * slip * cos) * shears / length;
        h[0][1] += mixed;
        h[1][0] += mixed;
        h[1][1] += ea * strain * (-ratio * cos * shears * shears + bends * bends / 5.0)
            - ga * slip * ratio * sin * shears * shears
            + 12.0 * ei * bends * bends;
        h[2][2] += ea * strain / 3.0 + 4.0 * ei;
        // s = (θ₁ + θ₂)/2, a = (θ₁ − θ₂)/2.
        let by = [[1.0, 0.0, 0.0], [0.0, 0.5, 0.5], [0.0, 0.5, -0.5]];
        let second = [0, 1, 2].map(|i: usize| {
            [0, 1, 2].map(|j: usize| {
                let terms = (0..LOCAL).flat_map(|p| (0..LOCAL).map(move |q| (p, q)));
                terms.map(|(p, q)| by[p][i] * h[p][q] * by[q][j]).sum()
            })
        });
        Energy {
            value,
            gradient: [0, 1, 2].map(|i: usize| (0..LOCAL).map(|p| gradient[p] * by[p][i]).sum()),
            second,
        }
    }

    /// K₀: second derivatives of V where nothing is loaded.
    fn unloaded(&self) -> [[f64; LOCAL]; LOCAL] {
        let straight = Chord {
            axes: [Vec2::x(), Vec2::y()],
            l: self.length,
            theta: [0.0; 2],
        };
        self.energy(&straight).second
    }

    /// Rates of l, θ₁ and θ₂.
    fn rates(&self, at: &Kinematics, chord: &Chord) -> [f64; LOCAL] {
        let free = self.free_rates(at);
        [0, 1, 2].map(|k| dot(&chord.slope(k), &free))
    }

    /// Rates of d and of the angles.
    fn free_rates(&self, at: &Kinematics) -> [f64; FREE] {
        let d = self.second.velocity(at) - self.first.velocity(at);
        [d.x, d.y, self.first.omega(at), self.second.omega(at)]
    }

    /// What V and damping exert by l, θ₁ and θ₂, as forces that act against these.
    fn local(&self, at: &Kinematics, chord: &Chord, energy: &Energy) -> [f64; LOCAL] {
        if self.damping == 0.0 {
            return energy.gradient;
        }
        let (rates, k) = (self.rates(at, chord), self.unloaded());
        [0, 1, 2].map(|i: usize| energy.gradient[i] + self.damping * dot(&k[i], &rates))
    }

    /// By d and the angles, with the sign of what acts on them.
    fn spread(chord: &Chord, local: [f64; LOCAL]) -> (Vec2, [f64; 2]) {
        let mut acts = [0.0; FREE];
        for (k, by) in local.into_iter().enumerate() {
            for (to, slope) in acts.iter_mut().zip(chord.slope(k)) {
                *to -= by * slope;
            }
        }
        let [x, y, first, second] = acts;
        (Vec2::new(x, y), [first, second])
    }

    /// Force at its point \[N\] and torque [N·m] on the second body.
    pub fn wrench(&self, at: &Kinematics) -> (Vec2, f64) {
        let chord = self.chord(at);
        let local = self.local(at, &chord, &self.energy(&chord));
        let (force, [_, torque]) = Beam::spread(&chord, local);
        (force, torque)
    }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Force for Beam {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        let chord = self.chord(at);
        let local = self.local(at, &chord, &self.energy(&chord));
        let (force, [first, second]) = Beam::spread(&chord, local);
        to.add_force(at, &self.second, force);
        to.add_force(at, &self.first, -force);
        to.add(self.first.body, Vec2::zeros(), first);
        to.add(self.second.body, Vec2::zeros(), second);
    }

    fn slopes(&self) -> Vec<Slope> {
        all_pairs(&self.first, &self.second)
    }

    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        position.fill(0.0);
        velocity.fill(0.0);
        let span = Span::at(at, &self.first, &self.second);
        let chord = self.chord(at);
        let energy = self.energy(&chord);
        let local = self.local(at, &chord, &energy);
        let (force, _) = Beam::spread(&chord, local);
        let (damped, slopes) = (self.unloaded(), [0, 1, 2].map(|k| chord.slope(k)));
        // By d and the angles: of what acts, by themselves and by their rates.
        let mut by_place = chord.bent(local);
        let mut by_rate = [[0.0; FREE]; FREE];
        for i in 0..FREE {
            for j in 0..FREE {
                for p in 0..LOCAL {
                    for q in 0..LOCAL {
                        let pair = slopes[p][i] * slopes[q][j];
                        by_place[i][j] += pair * energy.second[p][q];
                        by_rate[i][j] += pair * self.damping * damped[p][q];
                    }
                }
            }
        }
        if self.damping > 0.0 {
            // Rates of l and β change with the place.
            let rates = self.free_rates(at);
            let change = [0, 1, 2].map(|q: usize| {
                let unit = [0, 1, 2].map(|k: usize| f64::from(k == q));
                chord.bent(unit).map(|row| dot(&row, &rates))
            });
            for (i, row) in by_place.iter_mut().enumerate() {
                for (j, to) in row.iter_mut().enumerate() {
                    for p in 0..LOCAL {
                        let by: f64 = (0..LOCAL).map(|q| damped[p][q] * change[q][j]).sum();
                        *to += self.damping * slopes[p][i] * by;
                    }
                }
            }
        }
        // d and the angles by the coordinates of both bodies, and their rates by these.
        let moved =
            |column: usize, d: Vec2| [d.x, d.y, f64::from(column == 2), f64::from(column == 5)];
        let columns: [[f64; FREE]; BOTH] =
            std::array::from_fn(|column| moved(column, span.spread(column)));
        for (column, own) in columns.iter().enumerate() {
            let turned = span.turn(column);
            let turned = [turned.x, turned.y, 0.0, 0.0];
            for (row, other) in columns.iter().enumerate() {
                for i in 0..FREE {
                    let place = dot(&by_place[i], own) + dot(&by_rate[i], &turned);
                    position[row * BOTH + column] -= other[i] * place;
                    velocity[row * BOTH + column] -= other[i] * dot(&by_rate[i], own);
                }
            }
        }
        span.add_turned(force, position);
    }

    fn potential(&self, at: &Kinematics) -> f64 {
        self.energy(&self.chord(at)).value
    }

    fn is_conservative(&self) -> bool {
        self.damping == 0.0
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        let (rates, k) = (self.rates(at, &self.chord(at)), self.unloaded());
        -self.damping
            * (0..LOCAL)
                .map(|i| rates[i] * dot(&k[i], &rates))
                .sum::<f64>()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::element::tests::marker;

    /// One that is bent, stretched and sheared, for checks by differences.
    pub(in crate::element) fn beam(first: usize, damping: f64) -> Beam {
        Beam {
            first: marker(first, 0.3, -0.2),
            second: marker(2, -0.4, 0.1),
            stiffness: [40.0, 3.0, 25.0],
            length: 1.3,
            angles: [0.4, -0.3],
            damping,
        }
    }

    /// Without shear, and with both ends free to turn: the stiffnesses of the textbook, 4 EI/L and 2 EI/L, EA/L.
    #[test]
    fn it_is_the_bar_of_the_textbook_where_nothing_is_loaded() {
        let beam = Beam {
            stiffness: [40.0, 3.0, f64::INFINITY],
            ..beam(1, 0.0)
        };
        let k = beam.unloaded();
        let (l, ei) = (beam.length, 3.0);
        let known = [
            [40.0 / l, 0.0, 0.0],
            [0.0, 4.0 * ei / l, 2.0 * ei / l],
            [0.0, 2.0 * ei / l, 4.0 * ei / l],
        ];
        for (own, known) in k.as_flattened().iter().zip(known.as_flattened()) {
            assert!((own - known).abs() < 1e-12 * 40.0, "{k:?}");
        }
        // With shear: (4 + Φ) EI/(L (1 + Φ)), (2 − Φ) EI/(L (1 + Φ)) (Przemieniecki 1968, sec. 5.6).
        let beam = super::tests::beam(1, 0.0);
        let (k, phi) = (beam.unloaded(), 12.0 * 3.0 / (25.0 * l * l));
        let by = ei / (l * (1.0 + phi));
        assert!((k[1][1] - (4.0 + phi) * by).abs() < 1e-12);
        assert!((k[1][2] - (2.0 - phi) * by).abs() < 1e-12);
    }
}
