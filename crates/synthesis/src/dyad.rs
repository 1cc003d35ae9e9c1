//! Links that keep their length, and guides that keep their direction, through positions of a plane.
//!
//! With the point z of the plane at the first position, and the plane displaced by tⱼ and turned by Θⱼ, it is at tⱼ + Θⱼ z; for the first
//! position t = 0 and Θ = 1. A link from the fixed pivot g keeps its length:
//!
//! ```text
//! (tⱼ + Θⱼ z − g)(t̄ⱼ + Θ̄ⱼ z̄ − ḡ) = (z − g)(z̄ − ḡ)
//! t t̄ + t Θ̄ z̄ + t̄ Θ z − t ḡ − t̄ g + (1 − Θ) z ḡ + (1 − Θ̄) z̄ g = 0
//! ```
//!
//! bilinear in (z, z̄) and (g, ḡ). Five positions leave finitely many links, up to four of them real; four leave a curve of them, the circle
//! points and centre points (Burmester, Lehrbuch der Kinematik, 1888; McCarthy and Soh, Geometric Design of Linkages, 2011, ch. 5). The
//! position of a plane may be measured in any other plane, so links between two moving bodies are found in the same way.

use linkdyn_linear::bilinear::{BilinearEquation, Number, roots};

/// A position of a plane, counted from its first one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Position {
    /// Where the origin is.
    pub shift: Number,
    /// e^{iθ}.
    pub turn: Number,
}

/// A link from a fixed pivot to a point of the moving plane, both where the plane is at its first position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dyad {
    /// The fixed pivot.
    pub fixed: Number,
    /// The moving pivot.
    pub moving: Number,
}

/// A point of the moving plane that is on a line in all positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guide {
    /// The point at the first position.
    pub point: Number,
    /// The direction of the line, of length 1.
    pub along: Number,
}

/// How far from its conjugate a number may be, in parts of its size, and still be real.
const REAL: f64 = 1e-7;
/// Links shorter than this part of the extent of the positions are none, and longer ones than its inverse are guides.
const SHORTEST: f64 = 1e-5;

impl Position {
    /// The first one.
    pub const FIRST: Position = Position {
        shift: Number::new(0.0, 0.0),
        turn: Number::new(1.0, 0.0),
    };

    /// Where a point is.
    pub fn of(&self, point: Number) -> Number {
        self.shift + self.turn * point
    }

    /// This position as it is seen from a plane that has another one.
    pub fn seen_from(&self, other: &Position) -> Position {
        Position {
            shift: (self.shift - other.shift) * other.turn.conj(),
            turn: self.turn * other.turn.conj(),
        }
    }

    /// Positions given as points and turns, counted from the first of them.
    pub fn counted(given: &[(Number, Number)]) -> Vec<Position> {
        let Some(&(first, turn)) = given.first() else {
            return Vec::new();
        };
        let one = |&(at, own): &(Number, Number)| {
            let turn = own * turn.conj();
            Position {
                shift: at - turn * first,
                turn,
            }
        };
        given.iter().map(one).collect()
    }
}

/// Origin and size in which numbers are near 1.
#[derive(Clone, Copy)]
struct Measure {
    origin: Number,
    size: f64,
}

impl Measure {
    /// Of the places of a point of the plane, the size also by how far the plane turns about it.
    fn of(positions: &[Position], near: Number) -> Measure {
        let places = positions.iter().map(|p| (p.of(near) - near).norm());
        Measure {
            origin: near,
            size: places.fold(1e-300, f64::max),
        }
    }

    fn position(&self, p: &Position) -> Position {
        Position {
            shift: (p.of(self.origin) - self.origin) / self.size,
            turn: p.turn,
        }
    }

    fn back(&self, z: Number) -> Number {
        z * self.size + self.origin
    }
}

const ZERO: Number = Number::new(0.0, 0.0);
const ONE: Number = Number::new(1.0, 0.0);

/// The forms 1, u, ū of both groups.
fn unit_forms() -> [Vec<Vec<Number>>; 2] {
    let forms: Vec<Vec<Number>> = (0..3)
        .map(|k| (0..3).map(|i| if i == k { ONE } else { ZERO }).collect())
        .collect();
    [forms.clone(), forms]
}

/// The equation of one position; rows 1, z, z̄, columns 1, g, ḡ.
fn keeps_length(p: &Position) -> BilinearEquation {
    let (t, turn) = (p.shift, p.turn);
    let coefficients = vec![
        t * t.conj(),
        -t.conj(),
        -t,
        t.conj() * turn,
        ZERO,
        ONE - turn,
        t * turn.conj(),
        ONE - turn.conj(),
        ZERO,
    ];
    BilinearEquation {
        coefficients,
        factors: unit_forms(),
    }
}

/// A real dyad of a root.
fn real(z: &[Number], g: &[Number]) -> Option<Dyad> {
    let is_real =
        |pair: &[Number]| (pair[0] - pair[1].conj()).norm() <= REAL * (1.0 + pair[0].norm());
    let dyad = Dyad {
        fixed: (g[0] + g[1].conj()) / 2.0,
        moving: (z[0] + z[1].conj()) / 2.0,
    };
    let length = (dyad.fixed - dyad.moving).norm();
    (is_real(z) && is_real(g) && length > SHORTEST && length < 1.0 / SHORTEST).then_some(dyad)
}

/// Of five positions all links, and how many there are in complex numbers; `near` is a point of the plane around which they matter.
pub fn links(positions: &[Position; 5], near: Number) -> (Vec<Dyad>, usize) {
    let measure = Measure::of(positions, near);
    let all = positions[1..].iter();
    let equations: Vec<BilinearEquation> =
        all.map(|p| keeps_length(&measure.position(p))).collect();
    let found = roots(&equations, 2);
    let complex = found.regular.len();
    (placed(&found.regular, measure), complex)
}

fn placed(roots: &[linkdyn_linear::bilinear::Root], measure: Measure) -> Vec<Dyad> {
    let own = roots.iter().filter_map(|root| real(&root.z, &root.w));
    let placed = own.map(|dyad| Dyad {
        fixed: measure.back(dyad.fixed),
        moving: measure.back(dyad.moving),
    });
    placed.collect()
}

/// Of four positions the links whose fixed pivots are on a line, up to three: {g : Re(normal̄ · g) = offset}, |normal| = 1.
pub fn links_on_line(
    positions: &[Position; 4],
    near: Number,
    normal: Number,
    offset: f64,
) -> Vec<Dyad> {
    let measure = Measure::of(positions, near);
    let all = positions[1..].iter();
    let mut equations: Vec<BilinearEquation> =
        all.map(|p| keeps_length(&measure.position(p))).collect();
    let offset = (offset - (normal.conj() * measure.origin).re) / measure.size;
    let mut coefficients = vec![ZERO; 9];
    coefficients[..3].copy_from_slice(&[Number::from(-2.0 * offset), normal.conj(), normal]);
    let [mut first, second] = unit_forms();
    first.truncate(1);
    // One form, the line's own, so that the start keeps to it.
    let line = vec![coefficients[..3].to_vec()];
    drop(second);
    equations.push(BilinearEquation {
        coefficients,
        factors: [first, line],
    });
    placed(&roots(&equations, 2).regular, measure)
}

/// Of four positions the point that stays on a line (Ball's point where the positions are infinitely near).
///
/// Im((qⱼ − q₀)(q̄₁ − q̄₀)) = 0 for j = 2, 3, bilinear in z and z̄; the other root is the pole at which q₁ = q₀.
pub fn guide(positions: &[Position; 4], near: Number) -> Option<Guide> {
    let measure = Measure::of(positions, near);
    let own: Vec<Position> = positions.iter().map(|p| measure.position(p)).collect();
    let by = |j: usize| [own[j].shift, own[j].turn - 1.0];
    let [t1, h1] = by(1);
    let equation = |j: usize| {
        let [t, h] = by(j);
        let cross = |a: Number, b: Number| a * b.conj();
        BilinearEquation {
            coefficients: vec![
                cross(t, t1) - cross(t, t1).conj(),
                cross(t, h1) - cross(h, t1).conj(),
                cross(h, t1) - cross(t, h1).conj(),
                cross(h, h1) - cross(h, h1).conj(),
            ],
            factors: [
                vec![vec![ONE, ZERO], vec![ZERO, ONE]],
                vec![vec![ONE, ZERO], vec![ZERO, ONE]],
            ],
        }
    };
    let found = roots(&[equation(2), equation(3)], 1);
    let is_guide = |root: &&linkdyn_linear::bilinear::Root| {
        let (z, bar) = (root.z[0], root.w[0]);
        (z - bar.conj()).norm() <= REAL * (1.0 + z.norm())
            && (t1 + h1 * z).norm() > 1e-6 * (1.0 + z.norm())
            && z.norm() < 1.0 / SHORTEST
    };
    let root = found.regular.iter().find(is_guide)?;
    let z = (root.z[0] + root.w[0].conj()) / 2.0;
    let way = t1 + h1 * z;
    Some(Guide {
        point: measure.back(z),
        along: way / way.norm(),
    })
}
