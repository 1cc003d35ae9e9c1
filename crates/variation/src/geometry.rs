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
//! All but the direction of a guide stand in φ linearly, so that a finite step changes φ by ∂φ times the step.

use linkdyn_engine::element::{Axis, BodyId, Kinematics};
use linkdyn_engine::motion::Law;
use linkdyn_engine::system::{Block, Evaluation, System};
use linkdyn_linear::math::{Vec2, perp};
use std::collections::HashMap;

/// Number of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PointId(pub usize);

/// A point of a body, and the equations that hold it.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub body: BodyId,
    pub holds: Vec<Hold>,
    /// Whether the line of centres of a gear goes along with it, which φ does not follow in a straight line.
    pub bears_wheel: bool,
}

/// The entries of J that say how rows change as a point moves: those of its body's place, for ∂φ/∂P = ±∂φ/∂r.
#[derive(Debug, Clone)]
pub(super) struct Hold {
    /// 1; −1 of the point on a carrier along which the line of centres of a gear goes.
    pub sign: f64,
    /// The body whose guide the rows are measured across or along: ∂φ/∂P turns with it.
    pub guide: Option<BodyId>,
    /// Bound of |∂φ/∂P| in a row [1 or 1/m].
    pub most: f64,
    /// (row, index among the entries of J) along x and along y.
    pub entries: [Vec<(usize, usize)>; 2],
}

impl Hold {
    /// Of a block on the point that it has on a body.
    pub fn of(block: &Block, body: BodyId) -> Hold {
        let mut entries = [Vec::new(), Vec::new()];
        for (index, (row, own, axis)) in block.constraint.entries().into_iter().enumerate() {
            let entry = (block.row() + row, block.entries().start + index);
            match axis {
                Axis::X if own == body => entries[0].push(entry),
                Axis::Y if own == body => entries[1].push(entry),
                Axis::X | Axis::Y | Axis::Theta => {}
            }
        }
        Hold {
            sign: 1.0,
            guide: None,
            most: 1.0,
            entries,
        }
    }

    /// λᵀ ∂φ/∂P, in global axes.
    pub fn pull(&self, jacobian: &[f64], lambda: &[f64]) -> Vec2 {
        let along = |axis: usize| -> f64 {
            let own = self.entries[axis].iter();
            own.map(|&(row, entry)| lambda[row] * jacobian[entry]).sum()
        };
        self.sign * Vec2::new(along(0), along(1))
    }

    /// Adds ∂φ/∂P·d to the rows.
    pub fn push(&self, jacobian: &[f64], d: Vec2, rows: &mut [f64]) {
        for (entries, d) in self.entries.iter().zip([d.x, d.y]) {
            for &(row, entry) in entries {
                rows[row] += self.sign * jacobian[entry] * d;
            }
        }
    }

    /// The rows that hold the point; one that does so along both axes stands twice.
    pub fn rows(&self) -> impl Iterator<Item = usize> + '_ {
        self.entries.iter().flatten().map(|&(row, _)| row)
    }
}

/// The block of driver `id`.
pub(super) fn driver_block(system: &System, id: usize) -> &Block {
    &system.blocks[system.joints.len() + id]
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
    /// A number of a driver's motion f(t): ∂f is a motion too, times t where `by_time`; whether f is linear in it.
    Motion {
        driver: usize,
        slope: Law,
        by_time: bool,
        is_linear: bool,
    },
}

impl Dimension {
    /// Whether it is a multiple of what the file says, and φ of it.
    pub fn is_linear(&self) -> bool {
        match self {
            Dimension::Point(..) | Dimension::Angle { .. } | Dimension::Ratio { .. } => true,
            // What poses and ratio do together is left out.
            Dimension::Direction { .. } | Dimension::Mesh { .. } => false,
            Dimension::Motion { is_linear, .. } => *is_linear,
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
    /// \[s\]
    pub time: f64,
    /// The driver whose value says which pose is meant; its motion has no influence there.
    pub held: Option<usize>,
}

/// What a row of φ gains by a step of a dimension.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gain {
    pub row: usize,
    /// Its derivative.
    pub rate: f64,
    /// The second one, less the step's own: of a direction, which turns.
    turning: Option<f64>,
}

impl Gain {
    pub fn by(&self, step: f64) -> f64 {
        match self.turning {
            None => step * self.rate,
            Some(across) => step.sin() * self.rate + 2.0 * (0.5 * step).sin().powi(2) * across,
        }
    }
}

impl Dimensions {
    /// What the rows gain by a dimension other than that of a point.
    pub fn gains(&self, here: &Here<'_>, k: usize) -> [Option<Gain>; 2] {
        let one = |row: usize, rate: f64| {
            let turning = None;
            [Some(Gain { row, rate, turning }), None]
        };
        match &self.all[k] {
            Dimension::Point(..) => [None, None],
            Dimension::Direction { joint, driver } => {
                // u and n turn by the step: φ = −n·d, and −u·d of a driver.
                let (along, across) = guide(here, *joint);
                let gain = |row: usize, rate: f64, turning: f64| Gain {
                    row,
                    rate,
                    turning: Some(turning),
                };
                let own = gain(here.system.blocks[*joint].row(), along, across);
                let driver = driver.map(|id| driver_block(here.system, id).row());
                [Some(own), driver.map(|row| gain(row, -across, along))]
            }
            Dimension::Angle { row } | Dimension::Mesh { row } => one(*row, 1.0),
            Dimension::Ratio {
                joint,
                carrier,
                drawn,
            } => {
                let [first, _] = here.system.joints[*joint].bodies();
                let theta = |body: BodyId| here.at.poses[body.0].theta;
                let rate = theta(first) - theta(*carrier) - drawn;
                one(here.system.blocks[*joint].row(), rate)
            }
            Dimension::Motion { driver, .. } if here.held == Some(*driver) => [None, None],
            Dimension::Motion {
                driver,
                slope,
                by_time,
                ..
            } => {
                let times = if *by_time { here.time } else { 1.0 };
                let row = driver_block(here.system, *driver).row();
                one(row, times * slope.jet(here.time)[0])
            }
        }
    }

    /// Adds to the rows what φ gains where one dimension is off by a step.
    pub fn push(&self, here: &Here<'_>, k: usize, step: f64, rows: &mut [f64]) {
        if let Dimension::Point(id, axis) = &self.all[k] {
            let point = &self.points[id.0];
            let mut by = Vec2::zeros();
            by[*axis] = step;
            let by = here.at.poses[point.body.0].turn(by);
            let holds = point.holds.iter();
            holds.for_each(|hold| hold.push(&here.evaluation.jacobian, by, rows));
        }
        for gain in self.gains(here, k).into_iter().flatten() {
            rows[gain.row] += gain.by(step);
        }
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
