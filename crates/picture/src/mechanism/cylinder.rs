//! Driven slides between moving bodies, and actuators: hydraulic or pneumatic cylinders.

use super::places::turned;
use crate::poses::Pose;
use crate::shape::{DriverKind, JointKind, Shape};

/// Thickness of a piston and of the ends of a barrel, as a part of the stroke.
const THICK: f64 = 0.12;
/// How far a rod of which only the tip is known reaches into the rest of its barrel.
const DEEP: f64 = 0.7;
/// Points that are no farther from the axis lie on it, as a part of the greatest slide.
const ON_AXIS: f64 = 1e-6;

/// Where a cylinder begins and ends along the axis of its joint \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lengths {
    /// Both ends of the barrel, from the joint's first point on.
    pub barrel: [f64; 2],
    /// The piston, and the free end of the rod, from the joint's second point on.
    pub rod: [f64; 2],
}

/// Least part of an actuator's shortest length that its barrel has, and the greatest.
const BARREL: [f64; 2] = [0.55, 0.92];

impl Lengths {
    /// Of an actuator between its least and its greatest length: the barrel begins at its first point, the rod ends at the second, and
    /// the piston goes through the middle of the barrel.
    pub fn of_actuator([low, high]: [f64; 2]) -> Self {
        let stroke = high - low;
        let thick = THICK * low;
        let barrel = (stroke + 2.0 * thick).clamp(BARREL[0] * low, BARREL[1] * low);
        let rod = low - (barrel - stroke) / 2.0;
        Lengths {
            barrel: [0.0, barrel],
            rod: [-rod, 0.0],
        }
    }
}

/// The cylinders among the joints, and which bodies are drawn as part of one: those of which all points lie on its axis.
#[derive(Debug, Clone, Default)]
pub struct Cylinders {
    /// Of each joint.
    pub of_joint: Vec<Option<Lengths>>,
    /// Of each body.
    pub holds: Vec<bool>,
}

impl Cylinders {
    /// The cylinders of a mechanism; `slides` are least and greatest slide of each joint, and both bodies of a slide keep the angle
    /// that they have in a pose.
    pub fn new(shape: &Shape, pose: &[Pose], slides: &[[f64; 2]]) -> Self {
        let mut cylinders = Cylinders {
            of_joint: vec![None; shape.joints.len()],
            holds: vec![false; shape.bodies.len()],
        };
        for driver in &shape.drivers {
            if let DriverKind::Translation { joint } = driver.kind {
                cylinders.add(shape, pose, joint, slides[joint]);
            }
        }
        cylinders
    }

    fn add(&mut self, shape: &Shape, pose: &[Pose], number: usize, [low, high]: [f64; 2]) {
        let joint = &shape.joints[number];
        let bodies = joint.between.map(|(body, _)| body);
        let JointKind::Prismatic { .. } = joint.kind else {
            return;
        };
        let (Some(axis), false, true) = (joint.axis(), bodies.contains(&0), low <= high) else {
            return;
        };
        let [u, v] = turned(pose[bodies[0]], axis);
        // Of each point of a body: how far along the axis from the joint's point, and how far off it.
        let along = |end: usize| -> Vec<[f64; 2]> {
            let (body, _) = joint.between[end];
            let [x0, y0] = shape.point(joint.between[end]).unwrap_or_default();
            let points = shape.bodies[body].points.iter();
            points
                .map(|(_, x, y)| {
                    let [dx, dy] = turned(pose[body], [x - x0, y - y0]);
                    [dx * u + dy * v, (dy * u - dx * v).abs()]
                })
                .collect()
        };
        let (first, second) = (along(0), along(1));
        let ends = |list: &[[f64; 2]]| {
            list.iter()
                .fold([0.0, 0.0], |[low, high]: [f64; 2], [s, _]| {
                    [low.min(*s), high.max(*s)]
                })
        };
        let stroke = (high - low).max(ON_AXIS * high.abs());
        let [base, _] = ends(&first);
        let [mut piston, tip] = ends(&second);
        if tip - piston < stroke {
            let spare = (low + tip - stroke - base).max(0.0);
            piston = piston.min(tip - stroke - DEEP * spare);
        }
        let thick = THICK * stroke;
        self.of_joint[number] = Some(Lengths {
            barrel: [base.min(low + piston - thick), high + piston + thick],
            rod: [piston, tip],
        });
        for (body, points) in bodies.into_iter().zip([first, second]) {
            let room = ON_AXIS * high.abs().max(stroke);
            self.holds[body] |= points.iter().all(|[_, off]| *off <= room);
        }
    }
}
