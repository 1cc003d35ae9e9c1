//! An instant of a run: the columns of a row in the words of the equations.

use super::document::broken;
use super::equations::{Angles, Offsets};
use super::models::{JOINTS, LINKS};
use crate::CaseError;
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::{Model, PointRef};
use linkdyn_output::Trajectory;

/// Angle, velocity and acceleration of a body frame.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    pub angle: f64,
    pub velocity: Vec2,
    pub omega: f64,
    pub acceleration: Vec2,
    pub alpha: f64,
}

impl Frame {
    /// The ground, at rest.
    pub const GROUND: Frame = Frame {
        angle: 0.0,
        velocity: Vec2::new(0.0, 0.0),
        omega: 0.0,
        acceleration: Vec2::new(0.0, 0.0),
        alpha: 0.0,
    };

    /// A place of the body from its origin, in directions of the ground \[m\].
    pub fn arm(&self, p: [f64; 2]) -> Vec2 {
        let (sin, cos) = self.angle.sin_cos();
        Vec2::new(cos * p[0] - sin * p[1], sin * p[0] + cos * p[1])
    }

    /// The velocity of a place of the body [m/s].
    pub fn velocity_of(&self, p: [f64; 2]) -> Vec2 {
        self.velocity + perp(self.arm(p)) * self.omega
    }

    /// The acceleration of a place of the body [m/s²].
    pub fn acceleration_of(&self, p: [f64; 2]) -> Vec2 {
        let arm = self.arm(p);
        self.acceleration + perp(arm) * self.alpha - arm * (self.omega * self.omega)
    }
}

/// A row of results by name.
struct Row<'a> {
    trajectory: &'a Trajectory,
    row: &'a [f64],
}

impl Row<'_> {
    fn get(&self, name: &str) -> Result<f64, CaseError> {
        let column = self
            .trajectory
            .column_index(name)
            .ok_or_else(|| broken(format!("no column {name}")))?;
        Ok(self.row[column])
    }

    fn pair(&self, owner: &str, x: &str, y: &str) -> Result<Vec2, CaseError> {
        Ok(Vec2::new(
            self.get(&format!("{owner}.{x}"))?,
            self.get(&format!("{owner}.{y}"))?,
        ))
    }

    fn frame(&self, link: &str) -> Result<Frame, CaseError> {
        Ok(Frame {
            angle: self.get(&format!("{link}.angle"))?,
            velocity: self.pair(link, "vx", "vy")?,
            omega: self.get(&format!("{link}.omega"))?,
            acceleration: self.pair(link, "ax", "ay")?,
            alpha: self.get(&format!("{link}.alpha"))?,
        })
    }
}

/// Everything of one instant.
pub struct Instant {
    pub frames: [Frame; 5],
    pub forces: [Vec2; 7],
    pub offsets: Offsets,
    pub torque: f64,
    pub time: f64,
}

impl Instant {
    /// Reads a row of results.
    ///
    /// # Errors
    /// When a column is missing.
    pub fn read(trajectory: &Trajectory, row: &[f64]) -> Result<Self, CaseError> {
        let row = Row { trajectory, row };
        let mut frames = [Frame::GROUND; 5];
        for (frame, link) in frames.iter_mut().zip(LINKS) {
            *frame = row.frame(link)?;
        }
        let (mut forces, mut offsets) = ([Vec2::zeros(); 7], [Vec2::zeros(); 7]);
        for ((force, offset), joint) in forces.iter_mut().zip(&mut offsets).zip(JOINTS) {
            *force = row.pair(&format!("joint.{joint}"), "fx", "fy")?;
            *offset = row.pair(&format!("joint.{joint}"), "ex", "ey")?;
        }
        Ok(Instant {
            frames,
            forces,
            offsets,
            torque: row.get("driver.motor.effort")?,
            time: row.get("time")?,
        })
    }

    /// Velocities ṙ of the clearance links that turned uniformly since the row `before`.
    pub fn rates(&self, before: Option<&Instant>) -> Offsets {
        let mut rates = [Vec2::zeros(); 7];
        let Some(before) = before else { return rates };
        for ((rate, r), last) in rates.iter_mut().zip(&self.offsets).zip(&before.offsets) {
            let turn = perp(*last).dot(r).atan2(last.dot(r));
            *rate = perp(*r) * (turn / (self.time - before.time));
        }
        rates
    }

    /// Angles θ2 … θ6.
    pub fn angles(&self) -> Angles {
        self.frames.map(|frame| frame.angle)
    }

    /// The link, frame and place in it of a joint's end.
    ///
    /// # Errors
    /// When the model has no such point.
    pub fn end(
        &self,
        model: &Model,
        end: &PointRef,
    ) -> Result<(Option<usize>, Frame, [f64; 2]), CaseError> {
        let body = model
            .bodies
            .get(&end.body)
            .ok_or_else(|| broken(format!("no body {}", end.body)))?;
        let place = body
            .points
            .get(&end.point)
            .ok_or_else(|| broken(format!("no point {}", end.point)))?;
        let link = LINKS.iter().position(|link| *link == end.body);
        Ok((
            link,
            link.map_or(Frame::GROUND, |link| self.frames[link]),
            *place,
        ))
    }
}

/// Angles θ2 … θ6 and hinge forces of a row, for the first pass of the clearance model.
///
/// # Errors
/// When a column is missing.
pub fn angles_and_forces(
    trajectory: &Trajectory,
    row: usize,
) -> Result<(Angles, [Vec2; 7]), CaseError> {
    let instant = Instant::read(trajectory, trajectory.row(row))?;
    Ok((instant.angles(), instant.forces))
}
