//! The tree as bodies and what holds them, as drawn.

use super::super::spatial::{Hold, HoldKind, Solid, Travel};
use super::MjcfReader;
use super::tree::{Branch, MjcfJoint, MjcfKind, Pivot};

impl MjcfReader<'_, '_> {
    /// Bodies and joints as drawn.
    pub(super) fn draw(&mut self, start: &[f64]) {
        let (poses, pivots) = self.tree.poses(start);
        let branches = std::mem::take(&mut self.tree.branches);
        for (branch, pose) in branches.iter().zip(&poses) {
            let sites = branch.sites.iter();
            self.scene.bodies.push(Solid {
                name: branch.name.clone(),
                weight: branch.weight.map(|weight| weight.moved(pose)),
                sites: sites.map(|(name, at)| (name.clone(), pose * at)).collect(),
            });
        }
        for (index, branch) in branches.iter().enumerate().skip(1) {
            self.joints_of(index, branch, &pivots[index], start);
        }
        self.tree.branches = branches;
    }

    fn joints_of(&mut self, index: usize, branch: &Branch, pivots: &[Pivot], start: &[f64]) {
        let travel = |joint: &MjcfJoint| {
            let here = start.get(joint.first).copied().unwrap_or_default();
            Travel {
                limits: joint.limits.map(|ends| ends.map(|end| end - here)),
                stiffness: joint.stiffness,
                rest: joint.rest - here,
                damping: joint.damping,
            }
        };
        let hold = |between: [usize; 2], joint: &MjcfJoint, kind: HoldKind| Hold {
            name: joint.name.clone(),
            place: joint.place.clone(),
            between,
            kind,
            travel: travel(joint),
            armature: joint.armature,
        };
        let between = [branch.parent, index];
        let kinds: Vec<MjcfKind> = branch.joints.iter().map(|joint| joint.kind).collect();
        let is_bare = |joint: &MjcfJoint| {
            joint.limits.is_none() && joint.stiffness == 0.0 && joint.damping == 0.0
        };
        use MjcfKind::{Ball, Free, Hinge, Slide};
        let joints = &branch.joints;
        match kinds.as_slice() {
            [] => self.scene.holds.push(Hold {
                name: branch.name.clone(),
                place: branch.place.clone(),
                between,
                kind: HoldKind::Rigid,
                travel: Travel::default(),
                armature: 0.0,
            }),
            [Free] => {
                self.remarks
                    .about(&branch.place, "its motion out of the plane");
                let kind = HoldKind::Free { normal: None };
                self.scene.holds.push(hold(between, &joints[0], kind));
            }
            // Two slides and a hinge leave a body free in the plane.
            [Slide, Slide, Hinge] if joints.iter().all(is_bare) => {
                let normal = Some(pivots[2].1);
                let kind = HoldKind::Free { normal };
                self.scene.holds.push(hold(between, &joints[2], kind));
            }
            [Slide, Hinge] | [Hinge, Slide] => {
                let (slide, hinge) = if kinds[0] == Slide { (0, 1) } else { (1, 0) };
                let kind = HoldKind::Guide {
                    at: pivots[hinge].0,
                    along: pivots[slide].1,
                    is_of_second: slide == 1,
                    axis: pivots[hinge].1,
                    turn: travel(&joints[hinge]),
                };
                self.scene.holds.push(hold(between, &joints[slide], kind));
            }
            kinds => {
                let mut before = branch.parent;
                for (k, kind) in kinds.iter().enumerate() {
                    // All but the last move a body without mass.
                    let next = if k + 1 == kinds.len() {
                        index
                    } else {
                        let name = format!("{}_{}", branch.name, k + 1);
                        self.scene.bodies.push(Solid {
                            name,
                            ..Solid::default()
                        });
                        self.scene.bodies.len() - 1
                    };
                    let (at, axis) = pivots[k];
                    let kind = match kind {
                        Hinge | Ball => HoldKind::Turn {
                            at: [at, at],
                            axis: (*kind == Hinge).then_some(axis),
                        },
                        Slide => HoldKind::Slide { at, axis },
                        Free => HoldKind::Free { normal: None },
                    };
                    self.holds.insert((index, k), self.scene.holds.len());
                    self.scene
                        .holds
                        .push(hold([before, next], &joints[k], kind));
                    before = next;
                }
            }
        }
    }
}
