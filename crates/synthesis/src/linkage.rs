//! A linkage of rigid bodies, pins and guides, drawn at the first of the wanted positions, and how it moves.
//!
//! ```text
//! position of body k   z → rₖ + Θₖ z,   z where the body is drawn,   r = 0, Θ = 1 at the first position
//! pin                  r_a + Θ_a z − r_b − Θ_b z = 0
//! guide                θ_a − θ_b = 0,   Im(d̄ Θ̄_a (r_b − r_a)) = 0,   d the direction as it is drawn
//! ```
//!
//! All dimensions are places of pins, directions of guides, and the place of the point, so that each drawing is a linkage that closes.

use crate::dyad::Position;
use linkdyn_linear::bilinear::Number;
use nalgebra::{DMatrix, DVector};

/// What a joint is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A pin at this place.
    Pin(Number),
    /// A guide in this direction \[rad\]; the bodies don't turn against each other.
    Guide(f64),
}

/// A joint of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Numbers of the bodies; 0 is the ground.
    pub bodies: [usize; 2],
    /// What it is.
    pub kind: Kind,
}

/// A linkage with one freedom, whose crank is pinned to the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Linkage {
    /// How many bodies there are, the ground among them.
    pub bodies: usize,
    /// The joints.
    pub joints: Vec<Joint>,
    /// The body that is driven.
    pub crank: usize,
    /// The body that does what is wanted.
    pub output: usize,
    /// Its point, as it is drawn.
    pub point: Number,
}

/// A place of all moving bodies: x, y, angle of each.
pub type Places = DVector<f64>;

/// Correction that is round-off, by the size of the linkage.
const ROUND_OFF: f64 = 1e-13;
/// Correction that a step of the crank may need at most, by the size of the linkage.
const NEAR: f64 = 0.4;
/// Largest and smallest step of the crank \[rad\].
const STEP: f64 = 0.2;
const SHORTEST: f64 = 1e-3;

/// Rows of the joints, with derivatives by the places of bodies and by the dimensions.
struct Rows {
    values: DVector<f64>,
    by_places: DMatrix<f64>,
    by_dimensions: Option<DMatrix<f64>>,
}

impl Linkage {
    /// The extent of the drawing: largest distance of two pins, or of a pin and the point.
    fn size(&self) -> f64 {
        let pins: Vec<Number> = self
            .joints
            .iter()
            .filter_map(Joint::pin)
            .chain([self.point])
            .collect();
        let apart = pins
            .iter()
            .flat_map(|a| pins.iter().map(move |b| (a - b).norm()));
        apart.fold(0.0, f64::max)
    }

    /// Dimensions: each pin's x and y, each guide's angle, the point's x and y.
    pub fn dimensions(&self) -> Vec<f64> {
        let of = |joint: &Joint| match joint.kind {
            Kind::Pin(at) => vec![at.re, at.im],
            Kind::Guide(angle) => vec![angle],
        };
        let joints = self.joints.iter().flat_map(of);
        joints.chain([self.point.re, self.point.im]).collect()
    }

    /// The same linkage with other dimensions.
    pub fn with(&self, dimensions: &[f64]) -> Linkage {
        let mut own = dimensions.iter().copied();
        let mut next = || own.next().unwrap_or(0.0);
        let mut new = self.clone();
        for joint in &mut new.joints {
            joint.kind = match joint.kind {
                Kind::Pin(_) => Kind::Pin(Number::new(next(), next())),
                Kind::Guide(_) => Kind::Guide(next()),
            };
        }
        new.point = Number::new(next(), next());
        new
    }

    /// The body to which motion is transmitted: the output on the ground, or else another body there; and its pins but that to the ground.
    pub fn transmitted(&self) -> Option<(usize, Vec<usize>)> {
        let on_ground = |body: &usize| {
            let mut joints = self.joints.iter();
            *body != self.crank
                && joints.any(|own| own.bodies.contains(body) && own.bodies.contains(&0))
        };
        let last = (1..self.bodies).filter(on_ground);
        let last = last.max_by_key(|body| *body == self.output)?;
        let joints = self.joints.iter().enumerate();
        let own = joints.filter(|(_, own)| own.bodies.contains(&last) && !own.bodies.contains(&0));
        Some((last, own.map(|(k, _)| k).collect()))
    }

    /// All bodies as they are drawn.
    pub fn first(&self) -> Places {
        Places::zeros(3 * (self.bodies - 1))
    }

    /// The position of a body.
    pub fn position(&self, places: &Places, body: usize) -> Position {
        match body.checked_sub(1) {
            None => Position::FIRST,
            Some(k) => Position {
                shift: Number::new(places[3 * k], places[3 * k + 1]),
                turn: Number::from_polar(1.0, places[3 * k + 2]),
            },
        }
    }

    /// The angle by which a body has turned.
    pub fn angle(&self, places: &Places, body: usize) -> f64 {
        body.checked_sub(1).map_or(0.0, |k| places[3 * k + 2])
    }

    /// Rows of the joints, and that of the crank's angle.
    fn rows(&self, places: &Places, turn: f64, with_dimensions: bool) -> Rows {
        let n = 3 * (self.bodies - 1);
        let mut values = DVector::zeros(n);
        let mut by_places = DMatrix::zeros(n, n);
        let dimensions = self.dimensions().len();
        let mut by_dimensions = with_dimensions.then(|| DMatrix::zeros(n, dimensions));
        let (mut row, mut column) = (0, 0);
        for joint in &self.joints {
            let [a, b] = joint.bodies;
            let (p, q) = (self.position(places, a), self.position(places, b));
            match joint.kind {
                Kind::Pin(z) => {
                    let gap = p.of(z) - q.of(z);
                    (values[row], values[row + 1]) = (gap.re, gap.im);
                    for (body, position, sign) in [(a, p, 1.0), (b, q, -1.0)] {
                        let Some(k) = body.checked_sub(1) else {
                            continue;
                        };
                        let arm = position.turn * z;
                        by_places[(row, 3 * k)] = sign;
                        by_places[(row + 1, 3 * k + 1)] = sign;
                        by_places[(row, 3 * k + 2)] = -sign * arm.im;
                        by_places[(row + 1, 3 * k + 2)] = sign * arm.re;
                    }
                    if let Some(by) = &mut by_dimensions {
                        let turn = p.turn - q.turn;
                        by[(row, column)] = turn.re;
                        by[(row + 1, column)] = turn.im;
                        by[(row, column + 1)] = -turn.im;
                        by[(row + 1, column + 1)] = turn.re;
                    }
                    column += 2;
                }
                Kind::Guide(angle) => {
                    let along = Number::from_polar(1.0, angle) * p.turn;
                    let apart = q.shift - p.shift;
                    values[row] = self.angle(places, a) - self.angle(places, b);
                    values[row + 1] = (along.conj() * apart).im;
                    for (body, sign) in [(a, 1.0), (b, -1.0)] {
                        let Some(k) = body.checked_sub(1) else {
                            continue;
                        };
                        by_places[(row, 3 * k + 2)] = sign;
                        by_places[(row + 1, 3 * k)] = sign * along.im;
                        by_places[(row + 1, 3 * k + 1)] = -sign * along.re;
                    }
                    // With e^{−iθ}: ∂Im(e^{−iθ} s)/∂θ = −Re(e^{−iθ} s)
                    let by_angle = -(along.conj() * apart).re;
                    if let Some(k) = a.checked_sub(1) {
                        by_places[(row + 1, 3 * k + 2)] += by_angle;
                    }
                    if let Some(by) = &mut by_dimensions {
                        by[(row + 1, column)] = by_angle;
                    }
                    column += 1;
                }
            }
            row += 2;
        }
        if row < n {
            values[row] = self.angle(places, self.crank) - turn;
            by_places[(row, 3 * self.crank - 1)] = 1.0;
        }
        Rows {
            values,
            by_places,
            by_dimensions,
        }
    }

    /// The places near others at which the crank has turned so far; `None` where Newton's iteration does not come there.
    fn closed(&self, near: &Places, turn: f64, size: f64) -> Option<Places> {
        let scale = |step: &Places| {
            let own = step.iter().enumerate();
            own.map(|(k, v)| if k % 3 == 2 { v.abs() } else { v.abs() / size })
                .fold(0.0, f64::max)
        };
        let mut places = near.clone();
        let mut last = f64::INFINITY;
        for count in 0..12 {
            let rows = self.rows(&places, turn, false);
            let step = rows.by_places.lu().solve(&rows.values)?;
            let length = scale(&step);
            if length.is_nan() || length > NEAR || count > 1 && length > 0.5 * last && length > 1e-9
            {
                return None;
            }
            places -= step;
            if length <= ROUND_OFF || count > 3 && length >= last && length <= 1e-9 {
                return Some(places);
            }
            last = length;
        }
        None
    }

    /// Leads the crank from one angle to another, in steps that are halved where they are too long.
    pub fn led(&self, mut places: Places, from: f64, to: f64) -> Option<Places> {
        let size = self.size();
        let mut at = from;
        let mut step = STEP;
        while at != to {
            let next = match (to - at).abs() <= step {
                true => to,
                false => at + step.copysign(to - at),
            };
            // Along the tangent.
            let rows = self.rows(&places, at, false);
            let mut right = DVector::zeros(places.len());
            right[places.len() - 1] = next - at;
            let tangent = rows.by_places.lu().solve(&right)?;
            let is_near = tangent.iter().enumerate().all(|(k, v)| match k % 3 {
                2 => v.abs() <= 4.0 * STEP,
                _ => v.abs() <= 4.0 * STEP * size,
            });
            let closed = match is_near {
                true => self
                    .closed(&(&places + &tangent), next, size)
                    .filter(|new| {
                        // What the tangent did not foresee is another branch.
                        let off = (new - &places - &tangent).amax();
                        off <= 0.5 * tangent.amax() + 1e-12
                    }),
                false => None,
            };
            match closed {
                Some(new) => {
                    (places, at) = (new, next);
                    step = (1.5 * step).min(STEP);
                }
                None if step <= SHORTEST => return None,
                None => step *= 0.5,
            }
        }
        Some(places)
    }

    /// Derivatives of the places by the dimensions and, last, by the crank's angle (n, d + 1).
    pub fn slopes(&self, places: &Places, turn: f64) -> Option<DMatrix<f64>> {
        let rows = self.rows(places, turn, true);
        let by = rows.by_dimensions?;
        let n = places.len();
        let columns = by.ncols();
        let mut right = DMatrix::zeros(n, columns + 1);
        right.view_mut((0, 0), (n, columns)).copy_from(&(-by));
        right[(n - 1, columns)] = 1.0;
        rows.by_places.lu().solve(&right)
    }

    /// Standard deviations of the output's point and angle \[–\], \[rad per unit of length\] where x and y of each hole, in each of its two
    /// bodies, and the point's own have the standard deviation 1, to first order; the crank's angle is exact.
    ///
    /// A hole that is off by δ opens its pin by Θδ, and the bodies move by −J⁻¹Θδ. Of both directions together Θ drops out.
    pub fn spread(&self, places: &Places, turn: f64) -> Option<[f64; 2]> {
        let rows = self.rows(places, turn, false);
        let inverse = rows.by_places.try_inverse()?;
        let k = 3 * self.output - 3;
        let arm = self.position(places, self.output).turn * self.point;
        let (mut point, mut angle) = (0.0, 0.0);
        for (number, joint) in self.joints.iter().enumerate() {
            let own = match joint.kind {
                Kind::Pin(_) => [2 * number, 2 * number + 1],
                // Its place along matters, its angle is no length.
                Kind::Guide(_) => [2 * number + 1; 2],
            };
            let weight = if own[0] == own[1] { 1.0 } else { 2.0 };
            for row in own {
                let by = inverse[(k + 2, row)];
                let x = inverse[(k, row)] - arm.im * by;
                let y = inverse[(k + 1, row)] + arm.re * by;
                point += weight * (x * x + y * y);
                angle += weight * by * by;
            }
        }
        Some([(point + 2.0).sqrt(), angle.sqrt()])
    }
}

impl Joint {
    /// Its place, of a pin.
    pub fn pin(&self) -> Option<Number> {
        match self.kind {
            Kind::Pin(at) => Some(at),
            Kind::Guide(_) => None,
        }
    }
}
