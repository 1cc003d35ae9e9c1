//! Internal forces of a straight bar under concentrated and distributed loads.
//!
//! ```text
//! N′ = −p,  V′ = −q,  M′ = −V        p = p₀ + p₁ x along, q = q₀ + q₁ x across the axis [N/m]
//! σ = N/A ± M/W                      at both extreme fibres
//! ```
//!
//! N, V and M are what the part at greater x exerts on the part at less x: N along the axis, V across it to the left of it, M turning
//! left. Between concentrated loads N and V are of second order in x, M and σ of third, so that all extremes are at ends of such a
//! segment or at roots of equations of second order.

/// A concentrated load at x: along and across the axis \[N\], and a moment [N·m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Concentrated {
    /// Its place \[m\].
    pub x: f64,
    /// Along the axis \[N\].
    pub along: f64,
    /// Across it \[N\].
    pub across: f64,
    pub moment: f64,
}

/// N, V \[N\] and M [N·m] of a cut.
pub type CutForces = [f64; 3];

/// Largest values along the axis.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Peaks {
    pub tension: f64,
    pub compression: f64,
    pub shear: f64,
    pub moment: f64,
    /// Largest |σ| \[Pa\], and where it is \[m\].
    pub stress: f64,
    pub at: f64,
}

/// A part of the axis on which no concentrated load acts.
#[derive(Debug, Clone, Copy)]
struct BeamSegment {
    start: f64,
    end: f64,
    /// At its start.
    cut: CutForces,
}

/// A bar from x = 0 to its length.
#[derive(Debug, Clone)]
pub struct StraightLink {
    length: f64,
    along: [f64; 2],
    across: [f64; 2],
    segments: Vec<BeamSegment>,
    /// Of a cut beyond its end, which is zero in equilibrium.
    rest: CutForces,
    /// Sum of the sizes of the concentrated loads \[N\].
    size: f64,
}

/// Places that are nearer to each other are the same, relative to the length.
pub const SAME_PLACE: f64 = 1e-9;

impl StraightLink {
    /// Under concentrated loads from 0 to `length`, and distributed ones.
    pub fn new(length: f64, mut loads: Vec<Concentrated>, [along, across]: [[f64; 2]; 2]) -> Self {
        loads.sort_by(|one, other| one.x.total_cmp(&other.x));
        let mut beam = StraightLink {
            length,
            along,
            across,
            segments: Vec::with_capacity(loads.len() + 1),
            rest: [0.0; 3],
            size: 0.0,
        };
        let mut segment = BeamSegment {
            start: 0.0,
            end: 0.0,
            cut: [0.0; 3],
        };
        for load in &loads {
            if load.x > segment.start {
                segment.end = load.x;
                segment = beam.next(segment);
            }
            let [axial, shear, moment] = &mut segment.cut;
            *axial -= load.along;
            *shear -= load.across;
            *moment -= load.moment;
            beam.size += load.along.abs() + load.across.abs() + load.moment.abs() / length;
        }
        if segment.start < length {
            segment.end = length;
            segment = beam.next(segment);
        }
        beam.rest = segment.cut;
        beam
    }

    /// Keeps a segment; the one behind it.
    fn next(&mut self, segment: BeamSegment) -> BeamSegment {
        self.segments.push(segment);
        BeamSegment {
            start: segment.end,
            end: segment.end,
            cut: self.cut(&segment, segment.end - segment.start),
        }
    }

    /// Distributed loads at x.
    fn spread(&self, x: f64) -> [f64; 2] {
        [self.along, self.across].map(|[constant, slope]| constant + slope * x)
    }

    /// The cut so far behind the start of a segment.
    fn cut(&self, segment: &BeamSegment, u: f64) -> CutForces {
        let ([p, q], [axial, shear, moment]) = (self.spread(segment.start), segment.cut);
        [
            axial - (p + self.along[1] * u / 2.0) * u,
            shear - (q + self.across[1] * u / 2.0) * u,
            moment - (shear - (q / 2.0 + self.across[1] * u / 6.0) * u) * u,
        ]
    }

    /// The cut at x: at a load on the side of less x, at x = 0 on the other one.
    pub fn at(&self, x: f64) -> CutForces {
        let least = (x - SAME_PLACE * self.length).max(0.0);
        let behind = self.segments[1..].iter();
        let behind = behind.take_while(|segment| {
            segment.start < least || (x == 0.0 && segment.start <= SAME_PLACE * self.length)
        });
        let segment = behind.last().unwrap_or(&self.segments[0]);
        self.cut(segment, (x - segment.start).max(0.0))
    }

    /// What is left beyond its end, and the size of all loads \[N\].
    pub fn unbalanced(&self) -> [f64; 2] {
        let [axial, shear, moment] = self.rest;
        let rest = axial.abs() + shear.abs() + moment.abs() / self.length;
        [rest, self.size]
    }

    /// Largest values, of a bar with this area \[m²\] and section modulus \[m³\].
    pub fn peaks(&self, area: f64, modulus: f64) -> Peaks {
        let mut peaks = Peaks::default();
        for segment in &self.segments {
            let width = segment.end - segment.start;
            let ([p, q], [_, shear, _]) = (self.spread(segment.start), segment.cut);
            let (p_slope, q_slope) = (self.along[1], self.across[1]);
            // σ′ = −p/A ∓ V/W of both fibres, as −σ′ W
            let fibre = |side: f64| {
                let by = side * modulus / area;
                roots([shear + by * p, by * p_slope - q, -q_slope / 2.0])
            };
            let inside = [[-p / p_slope, -q / q_slope], fibre(1.0), fibre(-1.0)];
            let inside = inside
                .into_iter()
                .chain([roots([shear, -q, -q_slope / 2.0])]);
            let inside = inside.flatten().filter(|u| *u > 0.0 && *u < width);
            for u in [0.0, width].into_iter().chain(inside) {
                let [axial, shear, moment] = self.cut(segment, u);
                peaks.tension = peaks.tension.max(axial);
                peaks.compression = peaks.compression.max(-axial);
                peaks.shear = peaks.shear.max(shear.abs());
                peaks.moment = peaks.moment.max(moment.abs());
                let stress = axial.abs() / area + moment.abs() / modulus;
                if stress > peaks.stress {
                    (peaks.stress, peaks.at) = (stress, segment.start + u);
                }
            }
        }
        peaks
    }
}

/// Roots of c₀ + c₁ u + c₂ u², not finite where there are none.
fn roots([c0, c1, c2]: [f64; 3]) -> [f64; 2] {
    // the sum of what has one sign loses no digits
    let sum = -0.5 * (c1 + (c1 * c1 - 4.0 * c2 * c0).sqrt().copysign(c1));
    [sum / c2, c0 / sum]
}

#[cfg(test)]
mod tests;
