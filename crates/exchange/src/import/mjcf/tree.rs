//! The tree of bodies, and where they are by the coordinates of their joints.

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

use super::super::spatial::Weight;

/// Bodies, each after the one that carries it; the world first.
pub(super) struct Tree {
    pub branches: Vec<Branch>,
    /// How many coordinates all joints have.
    pub coordinates: usize,
}

/// A body of the tree.
pub(super) struct Branch {
    pub name: String,
    pub place: String,
    pub parent: usize,
    /// Its frame in that of its parent.
    pub frame: Isometry3<f64>,
    pub joints: Vec<MjcfJoint>,
    /// In its frame.
    pub weight: Option<Weight>,
    pub sites: Vec<(String, Point3<f64>)>,
}

/// A joint between a body and its parent.
pub(super) struct MjcfJoint {
    pub name: String,
    pub place: String,
    pub kind: MjcfKind,
    pub at: Point3<f64>,
    pub axis: Vector3<f64>,
    pub reference: f64,
    pub limits: Option<[f64; 2]>,
    pub stiffness: f64,
    pub rest: f64,
    pub damping: f64,
    pub armature: f64,
    /// Where its coordinates begin.
    pub first: usize,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum MjcfKind {
    Hinge,
    Slide,
    Ball,
    Free,
}

impl MjcfKind {
    pub fn size(self) -> usize {
        match self {
            MjcfKind::Hinge | MjcfKind::Slide => 1,
            MjcfKind::Ball => 4,
            MjcfKind::Free => 7,
        }
    }
}

/// Place and axis of a joint in the world, at its turn.
pub(super) type Pivot = (Point3<f64>, Vector3<f64>);

impl Tree {
    /// Coordinates of all joints; a free body and a ball have those of the reference.
    pub fn coordinates(&self, of: impl Fn(&MjcfJoint) -> f64) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.coordinates);
        for branch in &self.branches {
            for joint in &branch.joints {
                match joint.kind {
                    MjcfKind::Hinge | MjcfKind::Slide => all.push(of(joint)),
                    MjcfKind::Ball => all.extend([1.0, 0.0, 0.0, 0.0]),
                    MjcfKind::Free => {
                        let [x, y, z] = branch.frame.translation.vector.into();
                        let q = branch.frame.rotation.quaternion();
                        all.extend([x, y, z, q.w, q.i, q.j, q.k]);
                    }
                }
            }
        }
        all
    }

    /// Poses of all bodies, and where the joints of each are.
    pub fn poses(&self, coordinates: &[f64]) -> (Vec<Isometry3<f64>>, Vec<Vec<Pivot>>) {
        let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(self.branches.len());
        let mut pivots = Vec::with_capacity(self.branches.len());
        for (index, branch) in self.branches.iter().enumerate() {
            let mut pose = match index {
                0 => Isometry3::identity(),
                _ => poses[branch.parent] * branch.frame,
            };
            let mut own = Vec::new();
            for joint in &branch.joints {
                let at = pose * joint.at;
                let axis = pose.rotation * joint.axis;
                own.push((at, axis));
                let q = &coordinates[joint.first..][..joint.kind.size()];
                let turn = match (joint.kind, q) {
                    (MjcfKind::Slide, [q]) => {
                        pose.translation.vector += axis * (q - joint.reference);
                        continue;
                    }
                    (MjcfKind::Hinge, [q]) => {
                        let axis = Unit::new_normalize(joint.axis);
                        UnitQuaternion::from_axis_angle(&axis, q - joint.reference)
                    }
                    (MjcfKind::Ball, [w, x, y, z]) => unit([*w, *x, *y, *z]),
                    (MjcfKind::Free, [x, y, z, w, i, j, k]) => {
                        let place = Translation3::new(*x, *y, *z);
                        pose = Isometry3::from_parts(place, unit([*w, *i, *j, *k]));
                        continue;
                    }
                    _ => continue,
                };
                // The place of the joint stays.
                pose.rotation *= turn;
                pose.translation.vector = at.coords - pose.rotation * joint.at.coords;
            }
            poses.push(pose);
            pivots.push(own);
        }
        (poses, pivots)
    }
}

/// The rotation of a quaternion w, x, y, z of any length; none of one without length.
pub(super) fn unit([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    let quaternion = nalgebra::Quaternion::new(w, x, y, z);
    UnitQuaternion::try_new(quaternion, 1e-10).unwrap_or_default()
}
