//! What gaps change as the mechanism moves, and what is left out of the steps of parameters.
//!
//! ```text
//! point, off by d           ∂φ/∂P turns with the body of the guide, d with its own      |d| (|Δθ| + greatest |Δθ|)
//! zone, off by d            d keeps its direction                                      2 |d| greatest |Δθ|
//! direction, off by α       u·d and n·d change                                         α (|Δd| + (|u·d| + |n·d|)(|Δθ₁| + α))
//! ratio, off by δ           ∂φ/∂r = θ₁ − θ_c − …                                       δ (|Δθ₁| + |Δθ_c|)
//! ```

use super::super::dimensions::{Dimension, Dimensions, Here};
use super::super::grip::driver_block;
use super::super::source::Play;
use super::changes::{Changes, Point};
use super::extents::Extents;
use super::slots::Slots;
use crate::element::{BodyId, Marker};
use crate::system::System;
use linkdyn_linear::math::{Vec2, perp};
use std::collections::BTreeMap;

/// A guide whose direction is off.
struct Swung {
    rows: [Option<u32>; 2],
    markers: [Marker; 2],
    points: [Point; 2],
    axis: Vec2,
    /// How far \[rad\].
    step: f64,
    /// |u·d| + |n·d| at the pose \[m\].
    length: f64,
}

/// What gaps change.
pub(super) struct Gaps {
    /// By the greatest angle: row and factor.
    pub greatest: Vec<(u32, f64)>,
    /// By an angle: row, number of the angle, and factor; but for pins.
    pub angles: Vec<(u32, u32, f64)>,
    swung: Vec<Swung>,
    /// What is left out of steps at the pose (m); none where none leave anything out.
    pub slack: Vec<f64>,
    /// Room (m).
    rows: Vec<f64>,
}

impl Gaps {
    /// Of a mechanism.
    pub fn new(
        system: &System,
        (plays, dimensions): (&[Play], &Dimensions),
        extents: &Extents,
        (slots, changes): (&Slots, &mut Changes),
    ) -> Gaps {
        let mut greatest = vec![0.0; system.m()];
        let mut rows = vec![0.0; system.m()];
        for play in plays {
            if let Play::Zone { point, radius } = play {
                let grips = dimensions.points[point.0].grips.iter();
                grips.for_each(|grip| grip.push_size(2.0 * radius, &mut greatest));
            }
        }
        let mut angles = BTreeMap::new();
        let mut swung = Vec::new();
        for &(k, step) in &extents.most {
            match &dimensions.all[k] {
                Dimension::Point(id, _) => {
                    let point = &dimensions.points[id.0];
                    rows.fill(0.0);
                    let grips = point.grips.iter();
                    grips.for_each(|grip| grip.push_size(step, &mut rows));
                    let angle = point.body.index();
                    for (row, by) in rows.iter().enumerate().filter(|(_, by)| **by != 0.0) {
                        greatest[row] += by;
                        if let Some(angle) = angle {
                            *angles.entry((row, angle)).or_insert(0.0) += by;
                        }
                    }
                }
                Dimension::Direction { joint, driver } => {
                    let data = &system.joints[*joint];
                    let markers = data.points();
                    let driven = driver.map(|id| driver_block(system, id).row() as u32);
                    swung.extend(data.role().axis().map(|axis| Swung {
                        rows: [Some(system.blocks[*joint].row() as u32), driven],
                        points: markers.map(|marker| Point::new(&marker, slots)),
                        markers,
                        axis,
                        step,
                        length: 0.0,
                    }));
                }
                Dimension::Ratio { joint, carrier, .. } => {
                    let [first, _] = system.joints[*joint].bodies();
                    let row = system.blocks[*joint].row();
                    for angle in [first, *carrier].into_iter().filter_map(BodyId::index) {
                        *angles.entry((row, angle)).or_insert(0.0) += step;
                    }
                }
                Dimension::Angle { .. } | Dimension::Mesh { .. } | Dimension::Motion { .. } => {}
            }
        }
        let some = |(_, by): &(usize, f64)| *by != 0.0;
        let greatest = greatest.into_iter().enumerate().filter(some);
        let angles = angles.into_iter();
        let angles = angles.map(|((row, angle), by)| (row as u32, angle as u32, by));
        Gaps {
            greatest: greatest.map(|(row, by)| (row as u32, by)).collect(),
            angles: angles
                .filter(|&(row, angle, by)| !changes.take_gap(row, angle, by))
                .collect(),
            swung,
            slack: match extents.slack[..] {
                [] => Vec::new(),
                [..] => vec![0.0; system.m()],
            },
            rows,
        }
    }

    /// Takes what is known of a pose.
    pub fn take(&mut self, here: &Here<'_>, dimensions: &Dimensions, extents: &Extents) {
        for guide in &mut self.swung {
            let [first, second] = &guide.markers;
            let u = here.at.poses[first.body.0].turn(guide.axis);
            let d = second.place(&here.at) - first.place(&here.at);
            guide.length = u.dot(&d).abs() + perp(u).dot(&d).abs();
        }
        self.slack.fill(0.0);
        for &(k, step) in &extents.slack {
            self.rows.fill(0.0);
            dimensions.push_one(here, k, step, &mut self.rows);
            for (slack, own) in self.slack.iter_mut().zip(&self.rows) {
                *slack += own.abs();
            }
        }
    }

    /// Whether directions are off.
    pub fn has_others(&self) -> bool {
        !self.swung.is_empty()
    }

    /// Adds to the rows (m) what gaps change with the angles in `x`, and what is left out.
    pub fn add_turned(&self, slots: &Slots, x: &[f64], rows: &mut [f64]) {
        let greatest = slots.greatest_angle(x);
        for &(row, by) in &self.greatest {
            rows[row as usize] += by * greatest;
        }
        for &(row, angle, by) in &self.angles {
            rows[row as usize] += by * x[slots.angle(angle)];
        }
        for (row, slack) in rows.iter_mut().zip(&self.slack) {
            *row += slack;
        }
    }

    /// Adds to the rows (m) what directions do where the coordinates are off by `x`.
    pub fn add_swung(&self, x: &[f64], rows: &mut [[f64; 2]]) {
        for guide in &self.swung {
            let points = guide.points.iter();
            let moved = points.map(|point| point.shift(x).norm() + point.swing(x));
            let turn = x[guide.points[0].angle as usize] + guide.step;
            let by = guide.step * (moved.sum::<f64>() + guide.length * turn);
            for row in guide.rows.iter().flatten() {
                rows[*row as usize].iter_mut().for_each(|row| *row += by);
            }
        }
    }
}
