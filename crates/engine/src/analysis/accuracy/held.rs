//! Points that sources move, and the equations that hold on to them.
//!
//! ```text
//! pull     p = ∂y/∂P − λᵀ ∂φ/∂P            of the point alone, in global axes
//! step     g = Aᵀ p                        of its coordinates in the frame of its body, A the rotation of the body
//! off      P + A s + e                     s steps of the coordinates, e the place in a zone, which keeps its direction
//! ```

use super::dimensions::{Dimension, Dimensions, Here, PointId};
use super::grip::Grip;
use super::output::{Load, Pulls};
use super::source::Influence;
use crate::element::Pose;
use crate::system::System;
use linkdyn_linear::math::{Vec2, perp};

/// A point that sources move.
#[derive(Debug, Clone)]
struct Point {
    id: PointId,
    /// Its body, and the column of the body's angle.
    body: usize,
    theta: Option<usize>,
    /// The first of its dimensions, where parameters step it.
    stepped: Option<usize>,
    /// The play that is its zone.
    zone: Option<usize>,
}

/// An entry of J by which an equation holds on to a point: ∂φ/∂P for ∂φ/∂r.
#[derive(Debug, Clone, Copy)]
struct Entry {
    /// Number among the points that are held.
    point: u32,
    row: u32,
    entry: u32,
    sign: f64,
}

/// An equation that is measured across or along the guide of a body with this column of its angle.
#[derive(Debug, Clone)]
struct Guide {
    /// Number among the points that are held.
    point: usize,
    grip: Grip,
    theta: usize,
}

/// How far a point is off, in global axes \[m\].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Off {
    /// What turns with its body.
    turns: Vec2,
    /// All.
    by: Vec2,
}

/// All points that sources move.
#[derive(Debug, Clone, Default)]
pub(super) struct Held {
    points: Vec<Point>,
    /// Along x and along y.
    entries: [Vec<Entry>; 2],
    guides: Vec<Guide>,
    /// By the number of a point among all: that among those held.
    numbers: Vec<Option<usize>>,
}

impl Held {
    /// Of the dimensions that parameters step, and of zones, each with its play.
    pub fn new(
        system: &System,
        dimensions: &Dimensions,
        stepped: &[usize],
        zones: &[(usize, PointId)],
    ) -> Held {
        let mut held = Held {
            numbers: vec![None; dimensions.points.len()],
            ..Held::default()
        };
        for &k in stepped {
            if let Dimension::Point(id, axis) = dimensions.all[k] {
                held.point(system, dimensions, id).stepped = Some(k - axis);
            }
        }
        for &(play, id) in zones {
            held.point(system, dimensions, id).zone = Some(play);
        }
        held
    }

    /// The point with a number among all, which is taken in.
    fn point(&mut self, system: &System, dimensions: &Dimensions, id: PointId) -> &mut Point {
        let new = self.points.len();
        let number = *self.numbers[id.0].get_or_insert(new);
        if number == new {
            self.take_in(system, dimensions, id);
        }
        &mut self.points[number]
    }

    fn take_in(&mut self, system: &System, dimensions: &Dimensions, id: PointId) {
        let point = &dimensions.points[id.0];
        let theta = |body| system.layout.columns(body).map(|columns| columns.theta());
        let number = self.points.len();
        for (axis, entries) in self.entries.iter_mut().enumerate() {
            for grip in &point.grips {
                let own = grip.entries(axis).iter();
                entries.extend(own.map(|&(row, entry)| Entry {
                    point: number as u32,
                    row: row as u32,
                    entry: entry as u32,
                    sign: grip.sign(),
                }));
            }
        }
        for grip in &point.grips {
            self.guides
                .extend(grip.guide.and_then(theta).map(|theta| Guide {
                    point: number,
                    grip: grip.clone(),
                    theta,
                }));
        }
        self.points.push(Point {
            id,
            body: point.body.0,
            theta: theta(point.body),
            stepped: None,
            zone: None,
        });
    }

    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// p of all points under a load on the output, which itself pulls with `own`.
    pub fn pulls(&self, here: &Here<'_>, own: &Pulls, load: &Load, pulls: &mut [Vec2]) {
        let jacobian = &here.evaluation.jacobian;
        let [x, y] = &self.entries;
        let of = |of: &Entry| of.sign * load.lambda[of.row as usize] * jacobian[of.entry as usize];
        pulls.fill(Vec2::zeros());
        for entry in x {
            pulls[entry.point as usize].x -= of(entry);
        }
        for entry in y {
            pulls[entry.point as usize].y -= of(entry);
        }
        for (place, own) in own.iter().flatten() {
            if let Some(number) = place.point.and_then(|PointId(id)| self.numbers[id]) {
                pulls[number] += own * load.size;
            }
        }
    }

    /// ∂y/∂(coordinate of a point), and of the zones, from the pulls on the points.
    pub fn influences(
        &self,
        poses: &[Pose],
        pulls: &[Vec2],
        of_dimensions: &mut [f64],
        g: &mut [Influence],
    ) {
        for (pull, point) in pulls.iter().zip(&self.points) {
            if let Some(k) = point.stepped {
                let Pose { cos, sin, .. } = poses[point.body];
                of_dimensions[k] = cos * pull.x + sin * pull.y;
                of_dimensions[k + 1] = cos * pull.y - sin * pull.x;
            }
            if let Some(play) = point.zone {
                g[play] = [pull.x, pull.y];
            }
        }
    }

    /// Puts the points where steps of the dimensions and zones put them; `shifts` (points of the model) are in the frames of their
    /// bodies.
    pub fn place(
        &self,
        poses: &[Pose],
        (steps, e): (&[f64], &[Influence]),
        offs: &mut [Off],
        shifts: &mut [Vec2],
    ) {
        for (off, point) in offs.iter_mut().zip(&self.points) {
            let pose = &poses[point.body];
            let step = |k: usize| Vec2::new(steps[k], steps[k + 1]);
            let mut shift = point.stepped.map_or(Vec2::zeros(), step);
            let turns = pose.turn(shift);
            let mut by = turns;
            if let Some(play) = point.zone {
                let [x, y] = e[play];
                by += Vec2::new(x, y);
                shift += Vec2::new(pose.cos * x + pose.sin * y, pose.cos * y - pose.sin * x);
            }
            *off = Off { turns, by };
            shifts[point.id.0] = shift;
        }
    }

    /// Adds to `turned` (n) what the Lagrangian y − λᵀφ gains as bodies turn while points are off: λ follows the displaced points.
    pub fn turn(
        &self,
        here: &Here<'_>,
        lambda: &[f64],
        (pulls, offs): (&[Vec2], &[Off]),
        turned: &mut [f64],
    ) {
        for ((pull, off), point) in pulls.iter().zip(offs).zip(&self.points) {
            if let Some(column) = point.theta {
                turned[column] += pull.dot(&perp(off.turns));
            }
        }
        for guide in &self.guides {
            let pull = guide.grip.pull(&here.evaluation.jacobian, lambda);
            turned[guide.theta] -= perp(pull).dot(&offs[guide.point].by);
        }
    }

    /// Adds to the rows what φ gains where points are off.
    pub fn push(&self, jacobian: &[f64], offs: &[Off], rows: &mut [f64]) {
        let [x, y] = &self.entries;
        for of in x {
            let by = offs[of.point as usize].by.x;
            rows[of.row as usize] += of.sign * jacobian[of.entry as usize] * by;
        }
        for of in y {
            let by = offs[of.point as usize].by.y;
            rows[of.row as usize] += of.sign * jacobian[of.entry as usize] * by;
        }
    }
}
