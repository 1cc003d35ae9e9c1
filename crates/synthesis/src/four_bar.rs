//! Four-bars and slider-cranks from links and positions: their cranks' angles, cognates, functions.

use crate::dyad::{Dyad, Guide, Position};
use crate::fit::Candidate;
use crate::linkage::{Joint, Kind, Linkage};
use crate::path::{Unknowns, cognates, dyads};
use linkdyn_linear::bilinear::Number;

/// A four-bar that passes positions: its dyads, its point, and how far its coupler has turned at each.
#[derive(Debug, Clone, PartialEq)]
pub struct Passing {
    /// The dyads.
    pub dyads: [Dyad; 2],
    /// Where the point is at each position.
    pub points: Vec<Number>,
    /// e^{iθ} of the coupler at each, counted from the first.
    pub turns: Vec<Number>,
}

fn pin(bodies: [usize; 2], at: Number) -> Joint {
    Joint {
        bodies,
        kind: Kind::Pin(at),
    }
}

impl Passing {
    /// A four-bar through points; the turns of its coupler follow from the first dyad, and the second says which of two.
    pub fn through(dyads: [Dyad; 2], points: &[Number]) -> Self {
        let first = points[0];
        let turn = |p: &Number| {
            let ways = dyads[0].turns(*p - first, first);
            let off = |turn: &Number| {
                let [_, d] = dyads;
                let there = *p + turn * (d.moving - first);
                ((there - d.fixed).norm() - (d.moving - d.fixed).norm()).abs()
            };
            let [one, other] = ways;
            if off(&one) <= off(&other) { one } else { other }
        };
        let mut turns: Vec<Number> = points.iter().map(turn).collect();
        turns[0] = Number::new(1.0, 0.0);
        Passing {
            dyads,
            points: points.to_vec(),
            turns,
        }
    }

    /// One driven by either dyad.
    pub fn candidates(&self) -> [Candidate; 2] {
        let [one, other] = self.dyads;
        [[one, other], [other, one]].map(|[crank, rocker]| {
            let turns = self.points.iter().zip(&self.turns);
            let arm = crank.moving - crank.fixed;
            let turns = turns.map(|(p, turn)| {
                let there = *p + turn * (crank.moving - self.points[0]);
                ((there - crank.fixed) / arm).arg()
            });
            let linkage = Linkage {
                bodies: 4,
                joints: vec![
                    pin([0, 1], crank.fixed),
                    pin([1, 2], crank.moving),
                    pin([2, 3], rocker.moving),
                    pin([3, 0], rocker.fixed),
                ],
                crank: 1,
                output: 2,
                point: self.points[0],
            };
            Candidate {
                linkage,
                turns: turns.collect(),
            }
        })
    }

    /// Both cognates, whose couplers turn as the cranks of this one.
    pub fn cognates(&self) -> [Passing; 2] {
        let first = self.points[0];
        let [one, other] = self.dyads.map(|d| [d.moving - first, d.fixed - first]);
        let both = |z: Number| [z, z.conj()];
        let own = [one[0], one[1], other[0], other[1]].map(both).concat();
        let own: Unknowns = own.try_into().unwrap_or([first; 8]);
        let [_, left, right] = cognates(&own);
        [(left, self.dyads[0]), (right, self.dyads[1])].map(|(new, crank)| {
            let turns = self.points.iter().zip(&self.turns).map(|(p, turn)| {
                let there = *p + turn * (crank.moving - first);
                let way = (there - crank.fixed) / (crank.moving - crank.fixed);
                way / way.norm()
            });
            Passing {
                dyads: dyads(new.map(|z| z + first)),
                points: self.points.clone(),
                turns: turns.collect(),
            }
        })
    }
}

impl Dyad {
    /// The two turns of the coupler with which the link keeps its length, where the point has moved from `first` by δ:
    /// |δ − a + Θ x| = |x − a|, x and a from the point. Where there is none, both are the one with which it comes nearest.
    pub fn turns(&self, delta: Number, first: Number) -> [Number; 2] {
        let (x, a) = (self.moving - first, self.fixed - first);
        let (way, length) = (delta - a, (x - a).norm());
        let cosine =
            (length.powi(2) - way.norm_sqr() - x.norm_sqr()) / (2.0 * way.norm() * x.norm());
        let angle = cosine.clamp(-1.0, 1.0).acos();
        [angle, -angle].map(|angle| Number::from_polar(1.0, angle + way.arg() - x.arg()))
    }
}

/// A slider-crank that leads its coupler through positions, with the point that the coupler has at the first.
pub fn slider_crank(crank: Dyad, guide: Guide, positions: &[Position], point: Number) -> Candidate {
    let arm = crank.moving - crank.fixed;
    let turns = positions
        .iter()
        .map(|p| ((p.of(crank.moving) - crank.fixed) / arm).arg());
    let linkage = Linkage {
        bodies: 4,
        joints: vec![
            pin([0, 1], crank.fixed),
            pin([1, 2], crank.moving),
            pin([2, 3], guide.point),
            Joint {
                bodies: [0, 3],
                kind: Kind::Guide(guide.along.arg()),
            },
        ],
        crank: 1,
        output: 2,
        point,
    };
    Candidate {
        linkage,
        turns: turns.collect(),
    }
}

/// A four-bar whose rocker turns as wanted: crank pin and rocker pin at the first position, pivots at 0 and `base`.
pub fn function_four_bar(base: f64, pins: [Number; 2], crank: &[f64]) -> Candidate {
    let pivot = Number::from(base);
    let linkage = Linkage {
        bodies: 4,
        joints: vec![
            pin([0, 1], Number::from(0.0)),
            pin([1, 2], pins[0]),
            pin([2, 3], pins[1]),
            pin([3, 0], pivot),
        ],
        crank: 1,
        output: 3,
        point: pins[1],
    };
    Candidate {
        linkage,
        turns: crank.iter().map(|angle| angle - crank[0]).collect(),
    }
}

/// Positions of the crank's plane as the output's plane sees them, so that a link between both is a dyad from the output to the crank.
pub fn relative(base: f64, pairs: &[[f64; 2]]) -> Vec<Position> {
    let about = |pivot: Number, angle: f64| {
        let turn = Number::from_polar(1.0, angle);
        Position {
            shift: pivot - turn * pivot,
            turn,
        }
    };
    let one = |[crank, output]: &[f64; 2]| {
        let crank = about(Number::from(0.0), crank - pairs[0][0]);
        crank.seen_from(&about(Number::from(base), output - pairs[0][1]))
    };
    pairs.iter().map(one).collect()
}

/// Freudenstein's equation P + (b/r) cos ψ − (b/s) cos φ = cos(φ − ψ), for directions φ of the crank r and ψ of the rocker s on the base
/// b (Freudenstein, Transactions of the ASME 77, 1955): exact for three pairs, least squares for more. Crank pin and rocker pin at the
/// first pair; a negative length points the other way.
pub fn freudenstein(base: f64, pairs: &[[f64; 2]]) -> Option<[Number; 2]> {
    let rows = pairs
        .iter()
        .flat_map(|[phi, psi]| [1.0, psi.cos(), -phi.cos()]);
    let left = nalgebra::DMatrix::from_row_iterator(pairs.len(), 3, rows);
    let right = pairs.iter().map(|[phi, psi]| (phi - psi).cos());
    let right = nalgebra::DVector::from_iterator(pairs.len(), right);
    let k = left.svd(true, true).solve(&right, 1e-13).ok()?;
    let [r, s] = [base / k[1], base / k[2]];
    let is_linkage =
        |length: f64| length.is_finite() && length.abs() > 1e-6 * base && length.abs() < 1e6 * base;
    (is_linkage(r) && is_linkage(s)).then(|| {
        [
            Number::from_polar(
                r.abs(),
                pairs[0][0] + if r < 0.0 { std::f64::consts::PI } else { 0.0 },
            ),
            base + Number::from_polar(
                s.abs(),
                pairs[0][1] + if s < 0.0 { std::f64::consts::PI } else { 0.0 },
            ),
        ]
    })
}
