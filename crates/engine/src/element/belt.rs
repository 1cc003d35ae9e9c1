//! Belt: two pulleys, the first and the second body, and the two strands between them.
//!
//! With r₁, r₂ the radii, σ = 1 of an open belt and −1 of a crossed one, ρ = r₁ − σ r₂, d = P₂ − P₁ from centre to centre,
//! ℓ = |d|, e = d/ℓ, n = e⊥ and ψ the direction of d in space:
//!
//! ```text
//! s  = r₁ (θ₁ − ψ) − σ r₂ (θ₂ − ψ) − c        (1)  what the left strand is longer by, and the right one shorter   [m]
//! h  = ℓ cos β + ρ β − (the same as drawn)    (2)  what both are longer by; sin β = ρ/ℓ                           [m]
//! s′ = r₁ dθ₁ − σ r₂ dθ₂ − ρ dψ,  dψ = n·dd/ℓ     h′ = cos β e·dd
//! ```
//!
//! The left strand leaves the first pulley to the left of d; both strands stand at the angle β to it. (2) is half the length of
//! the belt around both pulleys: dh/dℓ = cos β − ℓ sin β β′ + ρ β′.
//!
//! ```text
//! T_l = T₀ + k (h + s) + b (ḣ + ṡ)     T_r = T₀ + k (h − s) + b (ḣ − ṡ)       strands that stretch, k [N/m] and b [N·s/m] of each
//! T_l = T₀ + λ/2                       T_r = T₀ − λ/2        φ = s = 0        a belt that does not
//! Q  = −T_l ∂(h + s)/∂q − T_r ∂(h − s)/∂q,   V = 2 T₀ h + k (h² + s²)
//! ```
//!
//! So each strand pulls with its tension along itself: T_l (cos β e − sin β n) on the first pulley, T_r (cos β e + sin β n), and
//! their moments ∓r₁. A belt that does not stretch holds s alone. The distance of the centres is held by other joints; where
//! it changes, T₀ stays, as with a weight that tightens the belt, and does the work −2 T₀ dh.
//!
//! (1) holds for pulleys on anything that moves, for it is rolling seen from the line of centres; the strands have no mass.
//! ψ is the angle of a body, the carrier, and that of d there, from where it is drawn: it has no jump while d turns by less
//! than half a turn in that body. Its derivatives do not know of the carrier. (Tensions: Shigley, Mechanical Engineering Design,
//! flexible elements; the form is ours.)

use super::span::{BOTH, Span, all_pairs, both_bodies, upper_pairs};
use super::{
    Applied, BodyId, Constraint, Entry, Equations, Force, Kinematics, Marker, Measure, Slope,
};
use linkdyn_linear::math::{Vec2, perp};

/// cos β where pulleys overlap, whose belt has no strands: tensions stay finite there [–].
const LEAST_COSINE: f64 = 1e-3;

/// Two pulleys and their belt.
#[derive(Debug, Clone)]
pub struct Belt {
    /// Centres of the pulleys.
    pub first: Marker,
    /// The second pulley's centre.
    pub second: Marker,
    /// The body in which the line of centres turns little.
    pub carrier: BodyId,
    /// d in the carrier as drawn, length one.
    pub axis: Vec2,
    /// r₁ and r₂ \[m\].
    pub radii: [f64; 2],
    /// Whether the strands cross.
    pub crossed: bool,
    /// c \[m\].
    pub offset: f64,
    /// ℓ as drawn \[m\].
    pub distance: f64,
    /// T₀ \[N\].
    pub pretension: f64,
    /// k [N/m] and b [N·s/m] of each strand; `None` if it does not stretch.
    pub elastic: Option<[f64; 2]>,
}

/// The line of centres.
struct Line {
    e: Vec2,
    n: Vec2,
    length: f64,
    cos: f64,
}

/// First and second derivatives by the coordinates of both bodies.
struct StrandSlopes {
    first: [f64; BOTH],
    second: [[f64; BOTH]; BOTH],
}

impl StrandSlopes {
    /// Rate at these velocities.
    fn rate(&self, v: &[f64; BOTH]) -> f64 {
        self.first.iter().zip(v).map(|(a, b)| a * b).sum()
    }

    /// Rate of a derivative.
    fn turn(&self, column: usize, v: &[f64; BOTH]) -> f64 {
        self.second[column].iter().zip(v).map(|(a, b)| a * b).sum()
    }
}

impl Belt {
    /// Whether it exerts forces beside its constraint.
    pub(crate) fn acts(&self) -> bool {
        self.pretension != 0.0 || self.elastic.is_some()
    }

    fn sigma(&self) -> f64 {
        if self.crossed { -1.0 } else { 1.0 }
    }

    /// ρ \[m\].
    pub fn lean(&self) -> f64 {
        self.radii[0] - self.sigma() * self.radii[1]
    }

    /// ℓ \[m\].
    pub fn span(&self, at: &Kinematics) -> f64 {
        (self.second.place(at) - self.first.place(at)).norm()
    }

    fn line(&self, at: &Kinematics) -> Line {
        let d = self.second.place(at) - self.first.place(at);
        let length = d.norm();
        // Centres that coincide have no line; any will do for numbers that stay finite.
        let e = if length > f64::MIN_POSITIVE {
            d / length
        } else {
            Vec2::x()
        };
        Line {
            e,
            n: perp(e),
            length: length.max(f64::MIN_POSITIVE),
            cos: self.cosine(length),
        }
    }

    fn cosine(&self, length: f64) -> f64 {
        let sin = self.lean() / length;
        (1.0 - sin * sin).max(LEAST_COSINE * LEAST_COSINE).sqrt()
    }

    /// Angle of the line of centres in the carrier, from where it is drawn \[rad\].
    pub fn swing(&self, at: &Kinematics) -> f64 {
        let e = at.poses[self.carrier.0].turn(self.axis);
        let d = self.second.place(at) - self.first.place(at);
        perp(e).dot(&d).atan2(e.dot(&d))
    }

    /// s + c \[m\].
    pub fn turned(&self, at: &Kinematics) -> f64 {
        let theta = |body: BodyId| at.poses[body.0].theta;
        let psi = theta(self.carrier) + self.swing(at);
        self.apart([self.first, self.second].map(|marker| theta(marker.body) - psi))
    }

    /// What the left strand is longer by where the pulleys are turned by these angles against the line of centres \[m\].
    pub fn apart(&self, [first, second]: [f64; 2]) -> f64 {
        self.radii[0] * first - self.sigma() * self.radii[1] * second
    }

    /// h + (2) as drawn \[m\].
    fn half(&self, length: f64) -> f64 {
        let cos = self.cosine(length);
        length * cos + self.lean() * (self.lean() / length).clamp(-1.0, 1.0).asin()
    }

    /// h \[m\].
    fn common(&self, at: &Kinematics) -> f64 {
        self.half(self.span(at)) - self.half(self.distance)
    }

    /// Derivatives of a function of d, of gradient `g` and second derivatives that `bent` applies to a vector.
    fn slopes_of(&self, at: &Kinematics, g: Vec2, bent: impl Fn(Vec2) -> Vec2) -> StrandSlopes {
        let span = Span::at(at, &self.first, &self.second);
        StrandSlopes {
            first: std::array::from_fn(|column| g.dot(&span.spread(column))),
            second: span.bent(g, bent),
        }
    }

    /// Derivatives of s.
    fn slopes_of_turned(&self, at: &Kinematics) -> StrandSlopes {
        let Line { e, n, length, .. } = self.line(at);
        let g = n * (-self.lean() / length);
        let square = self.lean() / (length * length);
        let bent = |by: Vec2| (e * n.dot(&by) + n * e.dot(&by)) * square;
        let mut slopes = self.slopes_of(at, g, bent);
        slopes.first[2] += self.radii[0];
        slopes.first[5] -= self.sigma() * self.radii[1];
        slopes
    }

    /// Derivatives of h.
    fn slopes_of_common(&self, at: &Kinematics) -> StrandSlopes {
        let Line { e, n, length, cos } = self.line(at);
        let along = self.lean() * self.lean() / (length * length * length * cos);
        let bent = |by: Vec2| n * (n.dot(&by) * cos / length) + e * (e.dot(&by) * along);
        self.slopes_of(at, e * cos, bent)
    }

    fn velocities(&self, at: &Kinematics) -> [f64; BOTH] {
        let [a, b] = [self.first.body, self.second.body].map(|body| at.twists[body.0]);
        [a.v.x, a.v.y, a.omega, b.v.x, b.v.y, b.omega]
    }

    /// T_l and T_r \[N\]; `lambda` of a belt that does not stretch.
    pub fn tensions(&self, at: &Kinematics, lambda: Option<f64>) -> [f64; 2] {
        let [common, apart] = self.pulls(at);
        let apart = apart + lambda.unwrap_or(0.0);
        [0.5 * (common + apart), 0.5 * (common - apart)]
    }

    /// T_l + T_r and T_l − T_r \[N\], without what a constraint adds.
    fn pulls(&self, at: &Kinematics) -> [f64; 2] {
        let Some([stiffness, damping]) = self.elastic else {
            return [2.0 * self.pretension, 0.0];
        };
        let (h, s) = (self.common(at), self.turned(at) - self.offset);
        let v = self.velocities(at);
        let rate = |slopes: StrandSlopes| if damping == 0.0 { 0.0 } else { slopes.rate(&v) };
        let (h_rate, s_rate) = (
            rate(self.slopes_of_common(at)),
            rate(self.slopes_of_turned(at)),
        );
        [
            2.0 * (self.pretension + stiffness * h + damping * h_rate),
            2.0 * (stiffness * s + damping * s_rate),
        ]
    }

    /// Force on the second pulley \[N\], and its torque about the centre [N·m], of these tensions.
    pub fn wrench(&self, at: &Kinematics, [left, right]: [f64; 2]) -> (Vec2, f64) {
        let Line {
            e, n, length, cos, ..
        } = self.line(at);
        let sin = self.lean() / length;
        let force = n * (sin * (left - right)) - e * (cos * (left + right));
        (force, self.sigma() * self.radii[1] * (left - right))
    }
}

impl Equations for Belt {
    fn position(&self, at: &Kinematics, phi: &mut [f64]) {
        phi[0] = self.turned(at) - self.offset;
    }

    fn jacobian(&self, at: &Kinematics, values: &mut [f64]) {
        values.copy_from_slice(&self.slopes_of_turned(at).first);
    }

    fn rate(&self, _at: &Kinematics, phi_t: &mut [f64]) {
        phi_t.fill(0.0);
    }

    fn gamma(&self, at: &Kinematics, gamma: &mut [f64]) {
        let (slopes, v) = (self.slopes_of_turned(at), self.velocities(at));
        let square: f64 = (0..BOTH).map(|k| v[k] * slopes.turn(k, &v)).sum();
        gamma[0] = -square;
    }
}

impl Constraint for Belt {
    fn rows(&self) -> &'static [Measure] {
        &[Measure::Length]
    }

    fn entries(&self) -> Vec<Entry> {
        let both = both_bodies(&self.first, &self.second).into_iter();
        both.map(|(body, axis)| (0, body, axis)).collect()
    }

    fn curvature_pattern(&self) -> Vec<Slope> {
        upper_pairs(&self.first, &self.second)
    }

    fn bend(&self, at: &Kinematics, lambda: &[f64], values: &mut [f64]) {
        let second = self.slopes_of_turned(at).second;
        let mut place = 0;
        for (row, of_row) in second.iter().enumerate() {
            for value in &of_row[row..] {
                values[place] = lambda[0] * value;
                place += 1;
            }
        }
    }

    fn reaction(&self, at: &Kinematics, lambda: &[f64]) -> (Vec2, f64) {
        self.wrench(at, [0.5 * lambda[0], -0.5 * lambda[0]])
    }
}

/// What the strands of a belt exert beside a constraint: the pretension, and all of it where they stretch.
#[derive(Debug, Clone)]
pub struct Strands(pub Belt);

impl Force for Strands {
    fn apply(&self, at: &Kinematics, to: &mut Applied) {
        let Strands(belt) = self;
        let [common, apart] = belt.pulls(at);
        let tensions = [0.5 * (common + apart), 0.5 * (common - apart)];
        let (force, torque) = belt.wrench(at, tensions);
        to.add_force(at, &belt.first, -force);
        to.add_force(at, &belt.second, force);
        to.add(belt.first.body, Vec2::zeros(), -belt.radii[0] * apart);
        to.add(belt.second.body, Vec2::zeros(), torque);
    }

    fn slopes(&self) -> Vec<Slope> {
        all_pairs(&self.0.first, &self.0.second)
    }

    fn slope(&self, at: &Kinematics, position: &mut [f64], velocity: &mut [f64]) {
        let Strands(belt) = self;
        let [stiffness, damping] = belt.elastic.unwrap_or_default();
        let [common, apart] = belt.pulls(at);
        let v = belt.velocities(at);
        let (h, s) = (belt.slopes_of_common(at), belt.slopes_of_turned(at));
        for row in 0..BOTH {
            for column in 0..BOTH {
                let of = |one: &StrandSlopes| {
                    let by = stiffness * one.first[column] + damping * one.turn(column, &v);
                    2.0 * one.first[row] * by
                };
                let place = row * BOTH + column;
                position[place] = -(common * h.second[row][column]
                    + apart * s.second[row][column]
                    + of(&h)
                    + of(&s));
                velocity[place] = -2.0
                    * damping
                    * (h.first[row] * h.first[column] + s.first[row] * s.first[column]);
            }
        }
    }

    fn potential(&self, at: &Kinematics) -> f64 {
        let Strands(belt) = self;
        let h = belt.common(at);
        let strained = belt.elastic.map_or(0.0, |[stiffness, _]| {
            let s = belt.turned(at) - belt.offset;
            stiffness * (h * h + s * s)
        });
        2.0 * belt.pretension * h + strained
    }

    fn is_conservative(&self) -> bool {
        self.0.elastic.is_none_or(|[_, damping]| damping == 0.0)
    }

    fn supplied(&self, at: &Kinematics) -> f64 {
        let Strands(belt) = self;
        let damping = belt.elastic.map_or(0.0, |[_, damping]| damping);
        if damping == 0.0 {
            return 0.0;
        }
        let v = belt.velocities(at);
        let rates = [belt.slopes_of_common(at), belt.slopes_of_turned(at)];
        -2.0 * damping * rates.map(|one| one.rate(&v).powi(2)).iter().sum::<f64>()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::tests::{Named, marker};
    use super::*;

    pub(in super::super) fn belt(crossed: bool, elastic: Option<[f64; 2]>) -> Belt {
        Belt {
            first: marker(1, 0.3, -0.2),
            second: marker(2, -0.4, 0.1),
            carrier: BodyId(3),
            axis: Vec2::new(0.8, 0.6),
            radii: [0.21, 0.34],
            crossed,
            offset: 0.2,
            distance: 0.9,
            pretension: 5.0,
            elastic,
        }
    }

    pub(in super::super) fn both() -> [Named; 2] {
        [
            ("belt", Box::new(belt(false, None))),
            ("crossed belt", Box::new(belt(true, None))),
        ]
    }
}
