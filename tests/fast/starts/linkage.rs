//! Linkages that follow from their crank's angle by closed forms, point by point.
//!
//! ```text
//! pin of two rods       R = P + a e + side h e⊥,   e = (Q − P)/d,  a = (d² + l₁² − l₂²)/(2 d),  h² = l₁² − a²
//! rod on a slider       R = (x_P + side √(l² − (y − y_P)²), y)
//! arm with a slot       turns to the pin in it, or by half a turn more
//! ```
//!
//! Where nothing under a root vanishes on a way, the side can't change on it.

use crate::linkage::Random;
use std::f64::consts::PI;

/// Kinds of linkages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    FourBar,
    Parallelogram,
    Kite,
    SliderCrank,
    EqualSliderCrank,
    QuickReturn,
    Watt,
    Stephenson,
}

/// What a way from a drawing meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// Nothing singular.
    Regular,
    /// Something so near to it that a step may see it.
    Near,
    /// A position in which branches cross.
    Passes,
    /// One in which it ends.
    Ends,
}

/// How a point follows from those before.
#[derive(Debug, Clone)]
pub(super) enum Step {
    /// Pin of two rods from two points.
    Rods {
        from: [usize; 2],
        lengths: [f64; 2],
        side: f64,
    },
    /// A slider at height y on a rod.
    Slider {
        from: usize,
        length: f64,
        y: f64,
        side: f64,
    },
    /// The end of an arm that turns about one point and holds another in its slot.
    Arm {
        pivot: usize,
        pin: usize,
        length: f64,
        side: f64,
    },
    /// A point of the body from one point to another, in its frame.
    Carried { body: [usize; 2], place: [f64; 2] },
}

/// A linkage: the crank's length, places of ground's points, and how others follow.
#[derive(Debug, Clone)]
pub struct Linkage {
    pub(super) crank: f64,
    pub(super) ground: Vec<[f64; 2]>,
    pub(super) steps: Vec<Step>,
}

/// Roots by the lengths' square below which a way is near a singular position, and none.
const NEAR: f64 = 2e-3;
const NONE: f64 = 1e-9;
/// Steps of the way [rad].
const STEP: f64 = 1e-3;

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * 0.5 * (1.0 + random.signed())
}

impl Linkage {
    pub fn random(random: &mut Random, kind: Kind) -> Self {
        let length = |random: &mut Random| between(random, 0.15, 1.0);
        let side = |random: &mut Random| if random.below(2) == 0 { 1.0 } else { -1.0 };
        let crank = length(random);
        let ground = [length(random), 0.3 * random.signed()];
        let four_bar = |lengths: [f64; 2], side: f64| Step::Rods {
            from: [GROUND, TIP],
            lengths,
            side,
        };
        let mut linkage = Linkage {
            crank,
            ground: vec![[0.0; 2], ground],
            steps: Vec::new(),
        };
        match kind {
            Kind::FourBar => {
                let lengths = [length(random), length(random)];
                linkage.steps.push(four_bar(lengths, side(random)));
            }
            Kind::Parallelogram => {
                linkage.ground[1] = [ground[0], 0.0];
                linkage
                    .steps
                    .push(four_bar([crank, ground[0]], side(random)));
            }
            Kind::Kite => {
                linkage.ground[1] = [crank, 0.0];
                let other = length(random);
                linkage.steps.push(four_bar([other, other], side(random)));
            }
            Kind::SliderCrank | Kind::EqualSliderCrank => {
                let equal = kind == Kind::EqualSliderCrank;
                linkage.steps.push(Step::Slider {
                    from: TIP,
                    length: if equal { crank } else { length(random) },
                    y: if equal { 0.0 } else { 0.3 * random.signed() },
                    side: side(random),
                });
            }
            Kind::QuickReturn => {
                linkage.steps.push(Step::Arm {
                    pivot: GROUND,
                    pin: TIP,
                    length: length(random),
                    side: side(random),
                });
                linkage.steps.push(Step::Slider {
                    from: 3,
                    length: between(random, 1.0, 2.5),
                    y: ground[1] + 0.3 * random.signed(),
                    side: side(random),
                });
            }
            Kind::Watt | Kind::Stephenson => {
                let lengths = [length(random), length(random)];
                linkage.steps.push(four_bar(lengths, side(random)));
                let body = match kind {
                    Kind::Watt => [GROUND, 3],
                    _ => [TIP, 3],
                };
                let place = [random.signed(), random.signed()];
                linkage.steps.push(Step::Carried { body, place });
                linkage
                    .ground
                    .push([1.5 * random.signed(), 1.5 * random.signed()]);
                let lengths = [between(random, 0.4, 1.6), between(random, 0.4, 1.6)];
                // Ground's third point is behind all others.
                linkage.steps.push(Step::Rods {
                    from: [FAR, 4],
                    lengths,
                    side: side(random),
                });
            }
        }
        linkage
    }

    /// Points at a crank's angle: the shaft, the second of ground, the crank's tip, then those of the steps; and the least of
    /// the roots' squares, by the lengths'. None where one is negative.
    fn solved(&self, angle: f64) -> Option<(Vec<[f64; 2]>, f64)> {
        let (sin, cos) = angle.sin_cos();
        let mut points = vec![
            self.ground[0],
            self.ground[1],
            [self.crank * cos, self.crank * sin],
        ];
        let mut least = f64::INFINITY;
        for step in &self.steps {
            let at = |k: usize| if k == FAR { self.ground[2] } else { points[k] };
            let point = match *step {
                Step::Rods {
                    from,
                    lengths,
                    side,
                } => {
                    let [p, q] = from.map(at);
                    let d = [q[0] - p[0], q[1] - p[1]];
                    let distance = d[0].hypot(d[1]);
                    let [l, m] = lengths;
                    let along = (distance * distance + l * l - m * m) / (2.0 * distance);
                    let square = (l - along) * (l + along);
                    least = least.min(square / (l * m)).min(distance / l);
                    if square.is_nan() || square < 0.0 {
                        return None;
                    }
                    let (a, h) = (along / distance, side * square.sqrt() / distance);
                    [p[0] + a * d[0] - h * d[1], p[1] + a * d[1] + h * d[0]]
                }
                Step::Slider {
                    from,
                    length,
                    y,
                    side,
                } => {
                    let p = at(from);
                    let square = (length - (y - p[1])) * (length + (y - p[1]));
                    least = least.min(square / (length * length));
                    if square.is_nan() || square < 0.0 {
                        return None;
                    }
                    [p[0] + side * square.sqrt(), y]
                }
                Step::Arm {
                    pivot,
                    pin,
                    length,
                    side,
                } => {
                    let (p, q) = (at(pivot), at(pin));
                    let d = [q[0] - p[0], q[1] - p[1]];
                    let distance = d[0].hypot(d[1]);
                    least = least.min(distance / self.crank);
                    let part = side * length / distance;
                    [p[0] + part * d[0], p[1] + part * d[1]]
                }
                Step::Carried { body, place } => {
                    let (p, q) = (at(body[0]), at(body[1]));
                    let angle = (q[1] - p[1]).atan2(q[0] - p[0]);
                    let (sin, cos) = angle.sin_cos();
                    [
                        p[0] + cos * place[0] - sin * place[1],
                        p[1] + sin * place[0] + cos * place[1],
                    ]
                }
            };
            points.push(point);
        }
        Some((points, least))
    }

    /// Places of all points at a crank's angle.
    pub fn places(&self, angle: f64) -> Option<Vec<[f64; 2]>> {
        Some(self.solved(angle)?.0)
    }

    /// What is on the way from one angle of the crank to another.
    pub fn on_the_way(&self, drawn: f64, start: f64) -> Verdict {
        let steps = ((start - drawn).abs() / STEP).ceil().max(1.0) as usize;
        let touches = self.touches();
        if touches && self.flat_between(drawn, start) {
            // Behind it the way of a kite may end.
            let is_there = self.places(start).is_some();
            return if is_there {
                Verdict::Passes
            } else {
                Verdict::Ends
            };
        }
        let mut least = f64::INFINITY;
        for k in 0..=steps {
            let angle = drawn + (start - drawn) * k as f64 / steps as f64;
            match self.solved(angle) {
                Some((_, margin)) => least = least.min(margin),
                // Round-off at a root that only touches zero.
                None if touches && !self.is_kite() => return Verdict::Near,
                None => return Verdict::Ends,
            }
        }
        match least > NEAR {
            true => Verdict::Regular,
            false => Verdict::Near,
        }
    }

    /// Whether the lengths are such that a root touches zero, and does not go below.
    fn touches(&self) -> bool {
        match &self.steps[..] {
            [Step::Rods { lengths, .. }] => {
                let ground = self.ground[1][0].hypot(self.ground[1][1]);
                let [coupler, rocker] = [lengths[1], lengths[0]];
                let mut lengths = [self.crank, ground, coupler, rocker];
                lengths.sort_by(f64::total_cmp);
                (lengths[0] + lengths[3] - lengths[1] - lengths[2]).abs() < NONE
            }
            [Step::Slider { length, y, .. }] => (self.crank - length).abs() < NONE && *y == 0.0,
            _ => false,
        }
    }

    /// Whether the crank's tip meets the second point of ground: only there branches cross.
    fn is_kite(&self) -> bool {
        self.ground[1] == [self.crank, 0.0]
    }

    /// Whether a flat position lies between two angles, and not within a hair of one.
    fn flat_between(&self, drawn: f64, start: f64) -> bool {
        let flat = match self.steps[0] {
            Step::Slider { .. } => PI / 2.0,
            _ => 0.0,
        };
        let (low, high) = (drawn.min(start), drawn.max(start));
        let period = if self.is_kite() { 2.0 * PI } else { PI };
        let first = ((low - flat) / period).ceil() * period + flat;
        first < high && first - low > 1e-3 && high - first > 1e-3
    }
}

/// Numbers of points: the second of ground, the crank's tip, and the third of ground.
pub(super) const GROUND: usize = 1;
pub(super) const TIP: usize = 2;
pub(super) const FAR: usize = usize::MAX;
