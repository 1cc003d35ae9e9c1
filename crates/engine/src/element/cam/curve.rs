//! Closed curves about the cam's point, and the foot of a point on them.
//!
//! ```text
//! circle     |x − c| = R
//! polar      c(u) = R(u) (cos u, sin u)                                              R a periodic spline
//! slide      c(u) = A(−u) ((h + s(u)) a − e a⊥),     h = √((r_b + r)² − e²)          s the law of the follower
//! swing      c(u) = A(−u) (D d − l A(ψ₀ + s(u)) d)                                   s the law of the arm
//! ```
//!
//! The last two are where the follower's point goes in the cam's frame while the cam turns by u against what guides the
//! follower: the pitch curve. The foot of x is where (x − c)·c′ = 0, found by Newton's method from the place on the curve in
//! the direction of x, which is known from a table; derivatives of the distance follow from c, c′, c″ there.

use crate::motion::{Jet, Pieces};
use linkdyn_linear::math::{Vec2, perp};
use std::f64::consts::TAU;

/// A closed curve.
#[derive(Debug, Clone)]
pub struct Curve {
    form: Form,
    /// Parameters at equal steps of direction, from −π on; they decrease where the curve runs clockwise.
    starts: Vec<f64>,
}

/// What it is.
#[derive(Debug, Clone)]
pub enum Form {
    /// A circle.
    Circle {
        /// c \[m\].
        centre: Vec2,
        /// R \[m\].
        radius: f64,
    },
    /// R(u).
    Polar(Pieces),
    /// Of a point that slides.
    Slide {
        /// s(u).
        law: Pieces,
        /// a.
        axis: Vec2,
        /// h \[m\].
        height: f64,
        /// e \[m\].
        offset: f64,
    },
    /// Of a point on an arm.
    Swing {
        /// s(u).
        law: Pieces,
        /// d.
        axis: Vec2,
        /// D \[m\].
        distance: f64,
        /// l \[m\].
        arm: f64,
        /// ψ₀ \[rad\].
        angle: f64,
    },
}

/// The foot of a point.
#[derive(Debug, Clone, Copy)]
pub struct Foot {
    /// D, positive outside \[m\].
    pub distance: f64,
    /// Outwards, length one.
    pub normal: Vec2,
    /// κ_c, positive where the curve is convex [1/m].
    pub curvature: f64,
}

impl Foot {
    /// κ_c/(1 + κ_c D) [1/m].
    pub fn bend(&self) -> f64 {
        self.curvature * super::inverse(1.0 + self.curvature * self.distance)
    }
}

/// A law held on a stretch between its breaks, and how far beyond that it is.
pub(super) fn held(law: &Pieces, u: f64, stretch: Option<i32>) -> (Jet, f64) {
    match stretch {
        Some(stretch) => law.held(u, stretch),
        None => (law.jet(u), f64::NEG_INFINITY),
    }
}

/// Places whose direction is tabulated, and samples of what is looked for all around.
const STARTS: usize = 256;
const SAMPLES: usize = 1440;
/// Steps of Newton's method, at most, and the longest of them \[rad\].
const STEPS: usize = 80;
const LONGEST: f64 = 0.4;
/// Part of |c′|² below which the second derivative of the distance is no help [–].
const FLAT: f64 = 0.05;

impl Curve {
    /// A curve; `None` if it does not go once around the cam's point in one sense.
    pub fn new(form: Form) -> Option<Self> {
        let mut curve = Curve {
            form,
            starts: Vec::new(),
        };
        if let Form::Circle { .. } = curve.form {
            return Some(curve);
        }
        let sense = curve.sense();
        let direction = |u: f64| {
            let place = curve.place(u)[0];
            place.y.atan2(place.x)
        };
        // directions along the curve, without jumps
        let step = TAU / SAMPLES as f64;
        let mut along = vec![direction(0.0) * sense];
        for k in 1..=SAMPLES {
            let before = along[k - 1];
            let turn = direction(step * k as f64) * sense - before;
            let turn = turn - TAU * (turn / TAU).round();
            if turn <= 0.0 {
                return None;
            }
            along.push(before + turn);
        }
        if (along[SAMPLES] - along[0] - TAU).abs() > 1e-6 {
            return None;
        }
        let start = |k: usize| {
            let wanted = (TAU * k as f64 / STARTS as f64 - 0.5 * TAU) * sense;
            let wanted = wanted - TAU * ((wanted - along[0]) / TAU).floor();
            let after = along.partition_point(|&angle| angle <= wanted);
            let after = after.clamp(1, SAMPLES);
            let part = (wanted - along[after - 1]) / (along[after] - along[after - 1]);
            step * (after as f64 - 1.0 + part)
        };
        curve.starts = (0..STARTS).map(start).collect();
        Some(curve)
    }

    /// Whether this is the curve of the follower's point, not the profile.
    pub fn is_pitch(&self) -> bool {
        match self.form {
            Form::Circle { .. } | Form::Polar(_) => false,
            Form::Slide { .. } | Form::Swing { .. } => true,
        }
    }

    /// 1 where the curve runs counterclockwise, else −1.
    fn sense(&self) -> f64 {
        if self.is_pitch() { -1.0 } else { 1.0 }
    }

    /// c, c′, c″ at a parameter.
    pub fn place(&self, u: f64) -> [Vec2; 3] {
        self.held(u, None)
    }

    /// The same with the law held on a stretch between its breaks.
    fn held(&self, u: f64, stretch: Option<i32>) -> [Vec2; 3] {
        let (local, turn): ([Vec2; 3], f64) = match &self.form {
            Form::Circle { centre, radius } => {
                let (sin, cos) = u.sin_cos();
                let e = Vec2::new(cos, sin) * *radius;
                return [centre + e, perp(e), -e];
            }
            Form::Polar(radius) => {
                let [r, r1, r2] = radius.jet(u);
                let x = Vec2::x();
                ([x * r, x * r1, x * r2], 1.0)
            }
            Form::Slide {
                law,
                axis,
                height,
                offset,
            } => {
                let [s, s1, s2] = held(law, u, stretch).0;
                let place = axis * (height + s) - perp(*axis) * *offset;
                ([place, axis * s1, axis * s2], -1.0)
            }
            Form::Swing {
                law,
                axis,
                distance,
                arm,
                angle,
            } => {
                let [s, s1, s2] = held(law, u, stretch).0;
                let (sin, cos) = (angle + s).sin_cos();
                let reach = (axis * cos + perp(*axis) * sin) * *arm;
                let across = perp(reach);
                let place = axis * *distance - reach;
                ([place, across * -s1, reach * (s1 * s1) - across * s2], -1.0)
            }
        };
        let (sin, cos) = (turn * u).sin_cos();
        let turned = |x: Vec2| Vec2::new(cos * x.x - sin * x.y, sin * x.x + cos * x.y);
        let [place, rate, change] = local;
        [
            turned(place),
            turned(rate + perp(place) * turn),
            turned(change + perp(rate) * (2.0 * turn) - place),
        ]
    }

    /// Outward normal and curvature at a place with its derivatives.
    fn shape(&self, [_, rate, change]: &[Vec2; 3]) -> (Vec2, f64) {
        let speed = rate.norm();
        let normal = perp(*rate) * (-self.sense() / speed);
        (normal, -change.dot(&normal) / (speed * speed))
    }

    /// Place, outward normal and curvature at a parameter.
    pub fn corner(&self, u: f64) -> (Vec2, Vec2, f64) {
        let place = self.place(u);
        let (normal, curvature) = self.shape(&place);
        (place[0], normal, curvature)
    }

    /// The parameter of the place in a direction, near enough to begin with.
    fn start(&self, x: Vec2) -> f64 {
        let part = (x.y.atan2(x.x) / TAU + 0.5) * STARTS as f64;
        let k = part.floor().clamp(0.0, (STARTS - 1) as f64);
        let [from, to] = [k as usize, (k as usize + 1) % STARTS].map(|k| self.starts[k]);
        let step = to - from;
        from + (step - TAU * (step / TAU).round()) * (part - k)
    }

    /// The foot of a point.
    pub fn foot(&self, x: Vec2, stretch: Option<i32>) -> Foot {
        if let Form::Circle { centre, radius } = &self.form {
            let (normal, far) = super::super::direction(x - centre).unwrap_or((Vec2::x(), 0.0));
            return Foot {
                distance: far - radius,
                normal,
                curvature: 1.0 / radius,
            };
        }
        let place = self.held(self.parameter(x, stretch), stretch);
        let (normal, curvature) = self.shape(&place);
        Foot {
            distance: (x - place[0]).dot(&normal),
            normal,
            curvature,
        }
    }

    /// The parameter of the foot of a point.
    fn parameter(&self, x: Vec2, stretch: Option<i32>) -> f64 {
        let mut u = self.start(x);
        let mut here = self.held(u, stretch);
        for _ in 0..STEPS {
            let off = x - here[0];
            let square = here[1].norm_squared();
            let second = (square - off.dot(&here[2])).max(FLAT * square);
            let mut step = (off.dot(&here[1]) / second).clamp(-LONGEST, LONGEST);
            if step.abs() <= 2.0 * f64::EPSILON * u.abs().max(1.0) {
                break;
            }
            let far = off.norm_squared();
            let mut next = self.held(u + step, stretch);
            // far from the curve a whole step may go too far
            while step.abs() > 1e-6 && (x - next[0]).norm_squared() > far {
                step *= 0.5;
                next = self.held(u + step, stretch);
            }
            u += step;
            here = next;
        }
        u
    }

    /// The law of the follower's motion, where it has breaks.
    pub(super) fn broken(&self) -> Option<&Pieces> {
        match &self.form {
            Form::Circle { .. } | Form::Polar(_) => None,
            Form::Slide { law, .. } | Form::Swing { law, .. } => {
                Some(law).filter(|law| law.has_breaks())
            }
        }
    }

    /// The stretch between breaks on which the foot of a point is, and how far beyond the one that is held \[rad\].
    pub(super) fn stretch(&self, x: Vec2, stretch: Option<i32>) -> (i32, f64) {
        let u = self.parameter(x, stretch);
        let beyond = |law: &Pieces| (law.stretch(u), held(law, u, stretch).1);
        self.broken().map_or((0, f64::NEG_INFINITY), beyond)
    }

    /// The parameter at which the outward normal has this angle, of a convex curve, from a table of such; and the jet of the
    /// support function there.
    pub(super) fn support(&self, alpha: f64, start: f64) -> Jet {
        let (sin, cos) = alpha.sin_cos();
        let n = Vec2::new(cos, sin);
        let mut u = start;
        for _ in 0..STEPS {
            let [_, rate, change] = self.place(u);
            let step = (-rate.dot(&n) / change.dot(&n)).clamp(-LONGEST, LONGEST);
            u += step;
            if step.abs() <= 2.0 * f64::EPSILON * u.abs().max(1.0) {
                break;
            }
        }
        let place = self.place(u);
        let (_, curvature) = self.shape(&place);
        let p = place[0].dot(&n);
        [p, place[0].dot(&perp(n)), super::inverse(curvature) - p]
    }

    /// Samples all around: parameter, angle of the outward normal, curvature.
    pub fn samples(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        (0..SAMPLES).map(|k| {
            let u = TAU * k as f64 / SAMPLES as f64;
            let (normal, curvature) = self.shape(&self.place(u));
            (u, normal.y.atan2(normal.x), curvature)
        })
    }

    /// Where the room for a roller is least: a profile has a radius of curvature above nothing, and a hollow one larger than the
    /// roller's; parameter and room \[m\].
    pub fn least_room(&self, roller: f64) -> (f64, f64) {
        let room = |(u, _, curvature): (f64, f64, f64)| {
            let radius = super::inverse(curvature);
            if self.is_pitch() {
                // an edge's curve is the profile
                (
                    u,
                    if curvature > 0.0 {
                        radius - roller
                    } else {
                        f64::MAX
                    },
                )
            } else {
                (
                    u,
                    if curvature < 0.0 {
                        -radius - roller
                    } else {
                        f64::MAX
                    },
                )
            }
        };
        let rooms = self.samples().map(room);
        rooms.fold(
            (0.0, f64::MAX),
            |least, next| {
                if next.1 < least.1 { next } else { least }
            },
        )
    }
}
