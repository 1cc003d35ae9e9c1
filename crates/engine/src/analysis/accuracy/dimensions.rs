//! The dimensions of a mechanism, and what the equations say of each.
//!
//! ```text
//! point P of a body       ∂φ/∂s = ∂φ/∂P·A            A the rotation of the body, s in its frame
//! direction of a guide    ∂φ/∂α = u·d, of a driver along it −n·d
//! angle between bodies    ∂φ/∂β = 1
//! ratio of a gear         ∂φ/∂r = θ₁ − θ_c − (θ₁ − θ_c as drawn, where its angle is that of the drawing)
//! motion of a driver      ∂φ/∂f = 1
//! ```
//!
//! All but the direction of a guide stand in φ linearly, so that what is off by a finite step is off by ∂φ times the step.

use super::grip::{Grip, driver_block};
use super::output::Load;
use crate::element::{BodyId, Kinematics};
use crate::system::{Evaluation, JointRole, System};
use linkdyn_linear::math::{Vec2, perp};
use std::collections::HashMap;

/// Number of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PointId(pub usize);

/// A point of a body, and the equations that hold on to it.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub body: BodyId,
    pub grips: Vec<Grip>,
    /// Whether the line of centres of a gear goes along with it, which φ does not follow in a straight line.
    pub bears_wheel: bool,
}

/// One number of the geometry.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Dimension {
    /// A coordinate of a point in the frame of its body \[m\]: 0 along x, 1 along y.
    Point(PointId, usize),
    /// Direction of the guide of a joint \[rad\].
    Direction { joint: usize, driver: Option<usize> },
    /// An angle that stands alone in a row \[rad\].
    Angle { row: usize },
    /// The angle at which wheels mesh as drawn \[rad\]: it follows from angles of bodies and from the ratio.
    Mesh { row: usize },
    /// The ratio of a gear [–], in its row; what ∂φ/∂r is where the bodies stand as drawn.
    Ratio {
        joint: usize,
        carrier: BodyId,
        drawn: f64,
    },
    /// What a driver's motion takes from one of its numbers: factor by time.
    Motion { driver: usize, number: MotionNumber },
}

impl Dimension {
    /// Whether it is a multiple of what the file says, and φ of it.
    pub fn is_linear(&self) -> bool {
        match self {
            Dimension::Point(..) | Dimension::Angle { .. } | Dimension::Ratio { .. } => true,
            // What poses and ratio do together is left out.
            Dimension::Direction { .. } | Dimension::Mesh { .. } => false,
            Dimension::Motion { number, .. } => match number {
                MotionNumber::Power { .. }
                | MotionNumber::Amplitude { .. }
                | MotionNumber::Value(_) => true,
                MotionNumber::Phase { .. } | MotionNumber::Frequency { .. } => false,
            },
        }
    }
}

/// A number of a driver's motion f(t).
#[derive(Debug, Clone, PartialEq)]
pub(super) enum MotionNumber {
    /// ∂f = tᵏ/k! or tᵏ.
    Power { exponent: i32, factor: f64 },
    /// ∂f = sin(2π ν t + φ).
    Amplitude { frequency: f64, phase: f64 },
    /// ∂f = A cos(2π ν t + φ).
    Phase {
        amplitude: f64,
        frequency: f64,
        phase: f64,
    },
    /// ∂f = 2π t A cos(2π ν t + φ).
    Frequency {
        amplitude: f64,
        frequency: f64,
        phase: f64,
    },
    /// A value in which the motion is linear: ∂f is the motion with 1 there and 0 elsewhere.
    Value(crate::motion::Law),
}

impl MotionNumber {
    /// ∂f at a time.
    pub fn rate(&self, t: f64) -> f64 {
        let angle = |frequency: f64, phase: f64| std::f64::consts::TAU * frequency * t + phase;
        match self {
            MotionNumber::Power { exponent, factor } => factor * t.powi(*exponent),
            MotionNumber::Amplitude { frequency, phase } => angle(*frequency, *phase).sin(),
            MotionNumber::Phase {
                amplitude,
                frequency,
                phase,
            } => amplitude * angle(*frequency, *phase).cos(),
            MotionNumber::Frequency {
                amplitude,
                frequency,
                phase,
            } => std::f64::consts::TAU * t * amplitude * angle(*frequency, *phase).cos(),
            MotionNumber::Value(law) => law.jet(t)[0],
        }
    }
}

/// All dimensions.
#[derive(Debug, Clone, Default)]
pub(super) struct Dimensions {
    pub points: Vec<Point>,
    pub all: Vec<Dimension>,
    /// By the path of a quantity in the file: the dimensions that follow from it, each with the factor.
    pub by_path: HashMap<String, Vec<(usize, f64)>>,
}

/// A position at which the equations were evaluated, φ and J.
#[derive(Clone, Copy)]
pub(super) struct Here<'a> {
    pub system: &'a System,
    pub evaluation: &'a Evaluation,
    pub at: Kinematics<'a>,
    /// How far points are off in the frames of their bodies \[m\].
    pub shifts: &'a [Vec2],
    /// \[s\]
    pub time: f64,
    /// The driver whose value says which pose is meant; its motion has no influence there.
    pub held: Option<usize>,
}

impl Dimensions {
    /// ∂y/∂(dimension) under a load on the output; of points see `held`.
    pub fn influence(&self, here: &Here<'_>, load: &Load, k: usize) -> f64 {
        let lambda = &load.lambda;
        let dimension = &self.all[k];
        match dimension {
            Dimension::Point(..) => 0.0,
            Dimension::Direction { joint, driver } => {
                let (slide, across) = guide(here, *joint);
                let own = lambda[here.system.blocks[*joint].row()] * slide;
                let driven = driver.map_or(0.0, |id| {
                    lambda[driver_block(here.system, id).row()] * -across
                });
                -(own + driven)
            }
            Dimension::Angle { row } | Dimension::Mesh { row } => -lambda[*row],
            Dimension::Ratio { joint, .. } => {
                -lambda[here.system.blocks[*joint].row()] * ratio_rate(here, dimension)
            }
            Dimension::Motion { driver, number } if here.held != Some(*driver) => {
                -lambda[driver_block(here.system, *driver).row()] * number.rate(here.time)
            }
            Dimension::Motion { .. } => 0.0,
        }
    }

    /// Adds to the rows what φ gains where one dimension is off by a step.
    pub fn push_one(&self, here: &Here<'_>, k: usize, step: f64, rows: &mut [f64]) {
        let dimension = &self.all[k];
        match dimension {
            Dimension::Point(id, axis) => {
                let point = &self.points[id.0];
                let pose = &here.at.poses[point.body.0];
                let off = pose.turn(unit(*axis)) * step;
                for grip in &point.grips {
                    grip.push(&here.evaluation.jacobian, off, rows);
                }
            }
            Dimension::Direction { joint, driver } => {
                // u and n turn by the step: φ = −n·d, and −u·d of a driver.
                let (slide, across) = guide(here, *joint);
                let (sin, versed) = (step.sin(), 2.0 * (0.5 * step).sin().powi(2));
                rows[here.system.blocks[*joint].row()] += sin * slide + versed * across;
                if let Some(id) = driver {
                    rows[driver_block(here.system, *id).row()] += versed * slide - sin * across;
                }
            }
            Dimension::Angle { row } | Dimension::Mesh { row } => rows[*row] += step,
            Dimension::Ratio { joint, .. } => {
                rows[here.system.blocks[*joint].row()] += step * ratio_rate(here, dimension);
            }
            Dimension::Motion { driver, number } => {
                if here.held != Some(*driver) {
                    rows[driver_block(here.system, *driver).row()] += step * number.rate(here.time);
                }
            }
        }
    }
}

/// Along an axis of a frame.
pub(super) fn unit(axis: usize) -> Vec2 {
    match axis {
        0 => Vec2::new(1.0, 0.0),
        _ => Vec2::new(0.0, 1.0),
    }
}

/// u·d and n·d of the guide of a joint \[m\].
fn guide(here: &Here<'_>, joint: usize) -> (f64, f64) {
    let data = &here.system.joints[joint];
    let Some(axis) = data.role().axis() else {
        return (0.0, 0.0);
    };
    let [first, second] = &data.points();
    let u = here.at.poses[first.body.0].turn(axis);
    let d = second.place(&here.at) - first.place(&here.at);
    (u.dot(&d), perp(u).dot(&d))
}

/// ∂φ/∂r of a gear.
fn ratio_rate(here: &Here<'_>, dimension: &Dimension) -> f64 {
    match dimension {
        Dimension::Ratio {
            joint,
            carrier,
            drawn,
        } => {
            debug_assert!(here.system.joints[*joint].role() == JointRole::Gear);
            let [first, _] = here.system.joints[*joint].bodies();
            let theta = |body: BodyId| here.at.poses[body.0].theta;
            theta(first) - theta(*carrier) - drawn
        }
        Dimension::Point(..)
        | Dimension::Direction { .. }
        | Dimension::Angle { .. }
        | Dimension::Mesh { .. }
        | Dimension::Motion { .. } => 0.0,
    }
}
