//! A mechanism with its motion: how far it reaches, the paths of its points, how far its slides go.

use super::cylinder::Cylinders;
use super::drivers::driver_ranges;
use super::places::{bent, place, turned};
use super::view::{Extent, Frame, Margins};
use crate::fault::Fault;
use crate::poses::{Pose, Poses, global};
use crate::shape::{JointKind, PitchCircles, PointId, Shape};

/// Outputs that paths and the extent are taken from, at most.
const MOST_ROWS: usize = 2000;
/// Instants whose signs the frame is fitted to.
const FITTED: usize = 25;
/// Room around the mechanism, at least, and beyond what is drawn, in bars.
const LEAST_MARGIN: f64 = 2.2;
const GAP: f64 = 1.2;
/// Largest extent, and distance from the origin, of what is drawn \[m\].
const FARTHEST: f64 = 1e12;

/// A mechanism that can be drawn at any time.
#[derive(Debug)]
pub struct Mechanism {
    pub(super) shape: Shape,
    pub(super) poses: Poses,
    /// What pictures show of the plane.
    pub(super) frame: Frame,
    /// Paths of the traced points, of each in pieces between gaps.
    pub(super) paths: Vec<Vec<Vec<[f64; 2]>>>,
    /// Least and greatest slide of each joint that has a guide \[m\].
    pub(super) slides: Vec<[f64; 2]>,
    /// Least and greatest length of each spring, damper and actuator \[m\].
    pub(super) stretches: Vec<[f64; 2]>,
    /// Driven slides that are drawn as cylinders.
    pub(super) cylinders: Cylinders,
    /// Least and greatest value of each driver [rad, m].
    pub(super) driver_ranges: Vec<[f64; 2]>,
    /// Whether pins are drawn once, however far their halves lie apart.
    pub(super) pins_are_whole: bool,
    /// Whether the motion ends as it begins.
    pub(super) returns: bool,
    /// Magnitude of the largest force among the loads \[N\].
    pub(super) largest_load: f64,
}

impl Mechanism {
    /// A mechanism and its motion.
    ///
    /// # Errors
    /// When the extent is no number that a picture can have.
    pub fn new(shape: Shape, poses: Poses) -> Result<Self, Fault> {
        shape.check("mechanism")?;
        let mut mechanism = Mechanism::measured(shape, poses);
        mechanism.check_extent()?;
        let [first, last] = mechanism.span();
        mechanism.returns = mechanism.is_same(first, last);
        mechanism.fit_frame();
        Ok(mechanism)
    }

    /// A mechanism of which is known how far it reaches and its parts move, whether it fits a page or not.
    pub(super) fn measured(shape: Shape, poses: Poses) -> Self {
        let count = poses.time.len();
        let stride = count.div_ceil(MOST_ROWS).max(1);
        let rows: Vec<Option<Vec<Pose>>> = (0..count)
            .step_by(stride)
            .chain([count - 1])
            .map(|row| poses.row(row))
            .collect();
        let forces = shape.loads.iter().filter(|load| load.at.is_some());
        let mut mechanism = Mechanism {
            paths: Vec::new(),
            slides: vec![[f64::INFINITY, f64::NEG_INFINITY]; shape.joints.len()],
            stretches: vec![[f64::INFINITY, f64::NEG_INFINITY]; shape.springs.len()],
            frame: Frame {
                extent: Extent::EMPTY,
                margins: Margins::WIDE,
            },
            cylinders: Cylinders::default(),
            pins_are_whole: false,
            returns: false,
            driver_ranges: driver_ranges(&shape, rows.iter().flatten()),
            largest_load: forces.map(|load| load.largest()).fold(0.0, f64::max),
            shape,
            poses,
        };
        if let Some(pose) = rows.iter().flatten().next() {
            mechanism.find_wheels(pose);
        }
        for pose in rows.iter().flatten() {
            mechanism.include(pose);
        }
        if let Some(pose) = rows.iter().flatten().next() {
            mechanism.cylinders = Cylinders::new(&mechanism.shape, pose, &mechanism.slides);
        }
        mechanism.include_ground();
        mechanism.reach_guides();
        let points = mechanism.shape.points.iter();
        mechanism.paths = points
            .map(|point| path(&mechanism.shape, *point, &rows))
            .collect();
        mechanism
    }

    /// Whether the motion ends with all bodies where they began, turns aside.
    pub fn returns(&self) -> bool {
        self.returns
    }

    /// Leaves as much room around the mechanism as its signs take over the motion.
    fn fit_frame(&mut self) {
        let [first, last] = self.span();
        let mut margins = [LEAST_MARGIN; 4];
        for k in 0..FITTED {
            let time = first + (last - first) * k as f64 / (FITTED - 1) as f64;
            for (margin, reach) in margins.iter_mut().zip(self.overhang(time)) {
                // A mechanism without extent has no scale: its signs reach to nowhere.
                *margin = (reach + GAP).max(*margin).min(Margins::WIDE.0[0]);
            }
        }
        self.frame.margins = Margins(margins);
    }

    /// First and last time with a pose \[s\].
    pub fn span(&self) -> [f64; 2] {
        self.poses.span()
    }

    /// Pitch circles of wheels whose carrier is not known, by the distance that they have in a pose.
    fn find_wheels(&mut self, pose: &[Pose]) {
        let places: Vec<[[f64; 2]; 2]> = self
            .shape
            .joints
            .iter()
            .map(|joint| joint.between.map(|end| place(&self.shape, pose, end)))
            .collect();
        for (joint, [[x1, y1], [x2, y2]]) in self.shape.joints.iter_mut().zip(places) {
            if let JointKind::Gear { ratio, gear } = &mut joint.kind
                && gear.is_none()
            {
                *gear = PitchCircles::of_wheels(*ratio, (x2 - x1).hypot(y2 - y1), 0);
            }
        }
    }

    /// Widens extent, slides and stretches.
    fn include(&mut self, pose: &[Pose]) {
        let shape = &self.shape;
        for (number, (body, own)) in shape.bodies.iter().zip(pose).enumerate().skip(1) {
            for (_, x, y) in &body.points {
                self.frame.extent.add(global(*own, [*x, *y]), 0.0);
            }
            for at in bent(shape, pose, number).into_iter().flatten() {
                self.frame.extent.add(at, 0.0);
            }
        }
        for (spring, stretch) in shape.springs.iter().zip(&mut self.stretches) {
            let ends = spring.between.map(|end| place(shape, pose, end));
            for end in ends {
                self.frame.extent.add(end, 0.0);
            }
            let length = (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
            *stretch = [stretch[0].min(length), stretch[1].max(length)];
        }
        for joint in shape.joints.iter().filter(|joint| joint.between[0].0 != 0) {
            if let JointKind::Contact { outlines, .. } = &joint.kind {
                for corner in outlines.iter().flatten() {
                    self.frame
                        .extent
                        .add(global(pose[joint.between[0].0], *corner), 0.0);
                }
            }
        }
        for (joint, slide) in shape.joints.iter().zip(&mut self.slides) {
            let ends = joint.between.map(|end| place(shape, pose, end));
            for (end, radius) in ends.into_iter().zip(joint.kind.radii()) {
                self.frame.extent.add(end, radius);
            }
            // Of a rack, how far its wheel is along it.
            if let JointKind::Rack { rack } = joint.kind {
                let [u, v] = turned(pose[joint.between[1].0], rack.axis);
                let s =
                    (u * (ends[0][0] - ends[1][0]) + v * (ends[0][1] - ends[1][1])) / u.hypot(v);
                *slide = [slide[0].min(s), slide[1].max(s)];
            }
            if let Some(axis) = joint.axis() {
                let [u, v] = turned(pose[joint.between[0].0], axis);
                let s = u * (ends[1][0] - ends[0][0]) + v * (ends[1][1] - ends[0][1]);
                *slide = [slide[0].min(s), slide[1].max(s)];
            }
        }
    }

    /// Outlines of the ground count, as far as they are near what moves: a floor may be as long as it likes.
    fn include_ground(&mut self) {
        let Extent { low, high } = self.frame.extent;
        let [wide, tall] = self.frame.extent.sizes();
        let far = wide.max(tall);
        for joint in self
            .shape
            .joints
            .iter()
            .filter(|joint| joint.between[0].0 == 0)
        {
            let JointKind::Contact { outlines, .. } = &joint.kind else {
                continue;
            };
            for corner in outlines.iter().flatten() {
                let near =
                    [0, 1].map(
                        |k| match (low[k] - far..=high[k] + far).contains(&corner[k]) {
                            true => corner[k],
                            false => low[k],
                        },
                    );
                self.frame.extent.add(near, 0.0);
            }
        }
    }

    /// A guide on a moving body reaches to the body's point: otherwise it would not touch the body.
    fn reach_guides(&mut self) {
        for (joint, slide) in self.shape.joints.iter().zip(&mut self.slides) {
            if joint.between[0].0 != 0 {
                *slide = [slide[0].min(0.0), slide[1].max(0.0)];
            }
        }
    }

    /// Refuses what has no place on a page.
    fn check_extent(&self) -> Result<(), Fault> {
        let Extent { low, high } = self.frame.extent;
        if low[0] > high[0] {
            let of_what = if self.shape.bodies.len() < 2 {
                "no body but the ground"
            } else {
                "no point that moves"
            };
            return Err(Fault::Nothing(format!("the model has {of_what}")));
        }
        let sizes = self.frame.extent.sizes();
        let is_drawable = sizes.iter().all(|size| (0.0..FARTHEST).contains(size))
            && low.iter().all(|x| x.abs() < FARTHEST);
        if is_drawable {
            Ok(())
        } else {
            Err(Fault::Drawing(
                "the mechanism is too large for a picture".into(),
            ))
        }
    }
}

/// The path of a point, in pieces between gaps.
fn path(shape: &Shape, point: PointId, rows: &[Option<Vec<Pose>>]) -> Vec<Vec<[f64; 2]>> {
    let pieces = rows.split(Option::is_none);
    let piece = |rows: &[Option<Vec<Pose>>]| -> Vec<[f64; 2]> {
        let poses = rows.iter().flatten();
        poses.map(|pose| place(shape, pose, point)).collect()
    };
    pieces.map(piece).filter(|piece| piece.len() > 1).collect()
}
