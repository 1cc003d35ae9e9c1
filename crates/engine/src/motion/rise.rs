//! Rises from rest to rest: s(z) from 0 to 1 while z = t/T goes from 0 to 1.
//!
//! | law                   | first half of s(z)                                                        | Cv    | Ca    | Cj    |
//! | --------------------- | ------------------------------------------------------------------------- | ----- | ----- | ----- |
//! | cycloidal             | z − sin(2πz)/2π                                                           | 2     | 6.283 | 39.48 |
//! | polynomial 3-4-5      | 10z³ − 15z⁴ + 6z⁵                                                         | 1.875 | 5.774 | 60    |
//! | polynomial 4-5-6-7    | 35z⁴ − 84z⁵ + 70z⁶ − 20z⁷                                                 | 2.188 | 7.513 | 52.5  |
//! | modified sine         | acceleration sin 4πz to z = 1/8, then sin((π + 4πz)/3)                    | 1.760 | 5.528 | 69.47 |
//! | modified trapezoid    | acceleration sin 4πz to 1/8, constant to 3/8, then −sin 4πz               | 2     | 4.888 | 61.43 |
//! | trapezoidal velocity  | acceleration constant to r, then none                                     | 1/(1 − r) | Cv/r | – |
//! | s-curve               | jerk ± for ϱr/2 at both ends of the ramp r, acceleration constant between | 1/(1 − r) | Cv/(r(1 − ϱ/2)) | 2Ca/(ϱr) |
//!
//! s(1 − z) = 1 − s(z) gives the second half. Cv, Ca and Cj are the peaks of s′, s″, s‴ (VDI 2143, sheet 1, 1980; Norton, Cam
//! Design and Manufacturing Handbook, 2009, ch. 3; the modified laws are Neklutin's, 1969). Limits of velocity, acceleration and
//! jerk give T, r and ϱ of the fastest rise within them (Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and
//! Robots, 2008, ch. 3).

use super::pieces::{Cycle, LawPiece, Pieces, TERMS};
use std::f64::consts::{PI, TAU};

/// The law of a rise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// Acceleration as a sine.
    Cycloidal,
    /// Of the fifth order.
    Polynomial345,
    /// Of the seventh order.
    Polynomial4567,
    /// Sines of two paces.
    ModifiedSine,
    /// A trapezoid with sines for its flanks.
    ModifiedTrapezoid,
    /// Ramps r of velocity, of which the part ϱ has jerk.
    Ramps {
        /// r \[–\], to 1/2.
        ramp: f64,
        /// ϱ \[–\], to 1; 0: accelerations jump.
        rounding: f64,
    },
}

/// A part of the first half of a rise: Σ cₖ xᵏ + A sin(w x + φ) from z = `from` on, x = z − `origin`.
#[derive(Debug, Clone, Copy)]
struct RisePart {
    from: f64,
    origin: f64,
    terms: [f64; TERMS],
    wave: [f64; 3],
}

impl RisePart {
    fn polynomial<const N: usize>(from: f64, terms: [f64; N]) -> Self {
        let mut all = [0.0; TERMS];
        all[..N].copy_from_slice(&terms);
        RisePart {
            from,
            origin: from,
            terms: all,
            wave: [0.0; 3],
        }
    }

    /// A line and a wave, in z itself.
    fn wave(from: f64, line: [f64; 2], wave: [f64; 3]) -> Self {
        RisePart {
            origin: 0.0,
            wave,
            ..RisePart::polynomial(from, line)
        }
    }
}

impl Shape {
    /// The first half.
    fn parts(self) -> Vec<RisePart> {
        match self {
            Shape::Cycloidal => {
                vec![RisePart::wave(0.0, [0.0, 1.0], [-1.0 / TAU, TAU, 0.0])]
            }
            Shape::Polynomial345 => {
                vec![RisePart::polynomial(0.0, [0.0, 0.0, 0.0, 10.0, -15.0, 6.0])]
            }
            Shape::Polynomial4567 => {
                let terms = [0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0];
                vec![RisePart::polynomial(0.0, terms)]
            }
            Shape::ModifiedSine => {
                let c = 1.0 / (4.0 + PI);
                vec![
                    RisePart::wave(0.0, [0.0, PI * c], [-0.25 * c, 2.0 * TAU, 0.0]),
                    RisePart::wave(
                        0.125,
                        [2.0 * c, PI * c],
                        [-2.25 * c, 2.0 * TAU / 3.0, PI / 3.0],
                    ),
                ]
            }
            Shape::ModifiedTrapezoid => {
                let peak = 8.0 * PI / (2.0 + PI);
                let (slow, w) = (peak / (4.0 * PI), 4.0 * PI);
                let first = slow * (0.125 - 1.0 / w);
                let second = first + 0.25 * slow + peak / 32.0;
                // from 3/8 on the velocity is that at 3/8 and what a cosine adds
                let speed = slow + 0.25 * peak;
                vec![
                    RisePart::wave(0.0, [0.0, slow], [-slow / w, w, 0.0]),
                    RisePart::polynomial(0.125, [first, slow, 0.5 * peak]),
                    RisePart::wave(
                        0.375,
                        [second - 0.375 * speed + slow / w, speed],
                        [slow / w, w, 0.0],
                    ),
                ]
            }
            Shape::Ramps { ramp, rounding } => ramps(ramp, rounding),
        }
    }
}

/// Ramps r of velocity, of which the part ϱ has jerk.
fn ramps(r: f64, rounding: f64) -> Vec<RisePart> {
    let speed = 1.0 / (1.0 - r);
    let j = 0.5 * rounding * r;
    let peak = speed / (r - j);
    let mut parts = Vec::new();
    if j > 0.0 {
        parts.push(RisePart::polynomial(0.0, [0.0, 0.0, 0.0, peak / (6.0 * j)]));
    }
    if r > 2.0 * j {
        let terms = [peak * j * j / 6.0, 0.5 * peak * j, 0.5 * peak];
        parts.push(RisePart::polynomial(j, terms));
    }
    let reached = 0.5 * speed * r;
    if j > 0.0 {
        // in z − r, which is negative
        let terms = [reached, speed, 0.0, -peak / (6.0 * j)];
        parts.push(RisePart {
            from: r - j,
            ..RisePart::polynomial(r, terms)
        });
    }
    if r < 0.5 {
        parts.push(RisePart::polynomial(r, [reached, speed]));
    }
    parts
}

/// A rise, or a dwell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// How it rises; a dwell has none.
    pub shape: Option<Shape>,
    /// How far.
    pub height: f64,
    /// How long \[s\].
    pub duration: f64,
}

/// What a rise may reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The greatest speed.
    pub velocity: f64,
    /// The greatest acceleration.
    pub acceleration: f64,
    /// The greatest jerk; none: accelerations jump.
    pub jerk: Option<f64>,
}

impl Limits {
    /// The fastest rise of a height within them.
    pub fn fastest(self, height: f64) -> Segment {
        let Limits {
            velocity: v,
            acceleration: a,
            jerk,
        } = self;
        let h = height.abs();
        // how long the acceleration changes, and how long a ramp is, where there is room for both
        let (mut rounded, mut ramp) = match jerk {
            None => (0.0, v / a),
            Some(j) if v * j >= a * a => (a / j, a / j + v / a),
            Some(j) => ((v / j).sqrt(), 2.0 * (v / j).sqrt()),
        };
        if h < v * ramp {
            // the speed is not reached
            (rounded, ramp) = match jerk {
                None => (0.0, (h / a).sqrt()),
                Some(j) if h >= 2.0 * a * (a / j) * (a / j) => {
                    let rounded = a / j;
                    let half = 0.5 * rounded;
                    (rounded, half + (half * half + h / a).sqrt())
                }
                Some(j) => {
                    let rounded = (0.5 * h / j).cbrt();
                    (rounded, 2.0 * rounded)
                }
            };
        }
        let cruise = (h / v - ramp).max(0.0);
        let cruise = if h < v * ramp { 0.0 } else { cruise };
        let duration = 2.0 * ramp + cruise;
        Segment {
            shape: Some(Shape::Ramps {
                ramp: (ramp / duration).min(0.5),
                rounding: (2.0 * rounded / ramp).min(1.0),
            }),
            height,
            duration,
        }
    }
}

/// Pieces of segments from a value and a time on, and the value and the time after them.
fn laid_out(start: f64, begin: f64, segments: &[Segment]) -> (Vec<LawPiece>, f64, f64) {
    let mut pieces = Vec::new();
    let (mut value, mut time) = (start, begin);
    for segment in segments {
        let end = time + segment.duration;
        // what goes nowhere has no pace that could be said
        let moves = segment.height != 0.0 && end > time;
        match segment.shape.filter(|_| moves) {
            Some(shape) => rise(&mut pieces, shape, (time, value), segment),
            None if end > time => pieces.push(LawPiece::dwell(time, value)),
            None => {}
        }
        value += segment.height;
        time = end;
    }
    (pieces, value, time)
}

/// The law of segments from a value on, which begin at a time and are gone through some times; a dwell before and after.
pub fn sequence(start: f64, begin: f64, segments: &[Segment], rounds: usize) -> Pieces {
    let (mut pieces, value, mut time) = laid_out(start, begin, segments);
    if pieces.is_empty() {
        pieces.push(LawPiece::dwell(begin, value));
        time = begin + 1.0;
    }
    let law = Pieces::new(pieces, time, [start, 0.0], [value, 0.0]);
    if rounds <= 1 {
        return law;
    }
    law.repeating(Cycle {
        advance: value - start,
        numbers: [0.0, rounds as f64],
    })
}

/// The law of segments over the angle of a cam, from 0 at an angle on and over and over with each turn; what is left of a turn is
/// a dwell.
pub fn turn(begin: f64, segments: &[Segment]) -> Pieces {
    let (mut pieces, value, reached) = laid_out(0.0, begin, segments);
    let end = begin + TAU;
    // what is left by round-off of degrees is nothing
    if pieces.is_empty() || end - reached > ROUND_OFF {
        pieces.push(LawPiece::dwell(reached, value));
    }
    Pieces::new(pieces, end, [0.0; 2], [value, 0.0]).repeating(Cycle {
        advance: 0.0,
        numbers: [f64::NEG_INFINITY, f64::INFINITY],
    })
}

/// Angles of segments are sums of degrees \[rad\].
const ROUND_OFF: f64 = 1e-9;

/// The pieces of a rise from (time, value) on: its first half, and that turned round.
fn rise(pieces: &mut Vec<LawPiece>, shape: Shape, (time, value): (f64, f64), segment: &Segment) {
    let Segment {
        height, duration, ..
    } = *segment;
    let parts = shape.parts();
    let scaled = |part: &RisePart, height: f64| {
        let terms = part.terms.map(|term| height * term);
        let [amplitude, w, phase] = part.wave;
        (terms, [height * amplitude, w, phase])
    };
    for part in &parts {
        let (mut terms, wave) = scaled(part, height);
        terms[0] += value;
        pieces.push(LawPiece {
            from: time + duration * part.from,
            origin: time + duration * part.origin,
            span: duration,
            terms,
            wave,
            is_smooth: false,
        });
    }
    let end = time + duration;
    for (k, part) in parts.iter().enumerate().rev() {
        let to = parts.get(k + 1).map_or(0.5, |next| next.from);
        let (mut terms, wave) = scaled(part, -height);
        terms[0] += value + height;
        let is_middle = k + 1 == parts.len();
        pieces.push(LawPiece {
            from: end - duration * to,
            origin: end - duration * part.origin,
            span: -duration,
            terms,
            wave,
            // only the corner of a triangle is none
            is_smooth: is_middle
                && !matches!(
                    shape,
                    Shape::Ramps {
                        ramp: 0.5,
                        rounding: 0.0
                    }
                ),
        });
    }
}
