//! Places as sums of vectors that turn and stretch.
//!
//! ```text
//! r      = Σ ± s_j R(φ_k) a                          s_j, φ_k: coordinates, either may be missing
//! ∂r/∂φ  = Σ ± s_j R(φ_k) a⊥          ∂r/∂s = Σ ± R(φ_k) a
//! r̈      = Σ ∂r/∂p_i p̈_i + bend       bend  = Σ ± R(φ_k) (2 ṡ_j φ̇_k a⊥ − s_j φ̇_k² a)
//! ```

/// A vector of the plane.
pub type Plane = [f64; 2];

/// a turned by an angle \[rad\].
pub fn turned([x, y]: Plane, angle: f64) -> Plane {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// a turned by a right angle.
pub fn across([x, y]: Plane) -> Plane {
    [-y, x]
}

/// a·b.
pub fn dot([ax, ay]: Plane, [bx, by]: Plane) -> f64 {
    ax * bx + ay * by
}

/// One vector of a sum: ± s R(φ) a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summand {
    /// 1 or −1.
    pub sign: f64,
    /// The number of a, among all constant vectors.
    pub vector: usize,
    /// a \[m\], of a direction of sliding \[1\].
    pub value: Plane,
    /// The coordinate φ, where it turns.
    pub angle: Option<usize>,
    /// The coordinate s, where it stretches.
    pub slide: Option<usize>,
}

/// A place \[m\], or the difference of two: a sum.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Place(pub Vec<Summand>);

impl Place {
    /// With one more vector; one that is zero is none.
    #[must_use]
    pub fn plus(&self, more: Summand) -> Place {
        let mut sum = self.clone();
        let same = |one: &Summand| {
            one.vector == more.vector && one.slide == more.slide && one.sign == -more.sign
        };
        match sum.0.iter().position(same) {
            Some(opposite) => drop(sum.0.remove(opposite)),
            None if more.value != [0.0, 0.0] => sum.0.push(more),
            None => {}
        }
        sum
    }

    /// From another place to this one; vectors that both have cancel.
    #[must_use]
    pub fn minus(&self, other: &Place) -> Place {
        other.0.iter().fold(self.clone(), |sum, one| {
            let sign = -one.sign;
            sum.plus(Summand { sign, ..*one })
        })
    }

    /// Its derivative by each coordinate, at coordinates p \[m/rad or 1\].
    pub fn slopes(&self, p: &[f64]) -> Vec<Plane> {
        let mut slopes = vec![[0.0; 2]; p.len()];
        let mut add = |coordinate: usize, [x, y]: Plane, factor: f64| {
            slopes[coordinate][0] += factor * x;
            slopes[coordinate][1] += factor * y;
        };
        for one in &self.0 {
            let vector = one.angle.map_or(one.value, |k| turned(one.value, p[k]));
            if let Some(angle) = one.angle {
                let stretch = one.slide.map_or(1.0, |slide| p[slide]);
                add(angle, across(vector), one.sign * stretch);
            }
            if let Some(slide) = one.slide {
                add(slide, vector, one.sign);
            }
        }
        slopes
    }
}
