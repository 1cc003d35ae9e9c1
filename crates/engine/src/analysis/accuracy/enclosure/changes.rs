//! By how much the entries of J can change as the coordinates move.

use crate::element::{BodyId, Kinematics, Marker};
use crate::system::{Block, DriverRole, JointRole, Origin, System};
use linkdyn_linear::math::{Vec2, perp};

/// Bounds of the change of an entry: along the way in the mean, and anywhere.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Change {
    /// In the mean along the way.
    pub mean: f64,
    /// Anywhere on it.
    pub most: f64,
}

impl Change {
    /// Of an entry with first derivative `slope` and size `value` that turns by an angle.
    fn turned(slope: f64, value: f64, angle: f64) -> Change {
        let (linear, square) = (slope.abs() * angle, 0.5 * value.abs() * angle * angle);
        Change {
            mean: 0.5 * linear + square / 3.0,
            most: linear + square,
        }
    }

    /// And moves by a length besides.
    fn and_moved(self, length: f64) -> Change {
        Change {
            mean: self.mean + 0.5 * length,
            most: self.most + length,
        }
    }
}

/// How far coordinates may be off, read by body.
pub(super) struct Radii<'a> {
    pub system: &'a System,
    pub x: &'a [f64],
}

impl Radii<'_> {
    pub fn turn(&self, body: BodyId) -> f64 {
        let columns = self.system.layout.columns(body);
        columns.map_or(0.0, |c| self.x[c.theta()])
    }

    pub fn shift(&self, body: BodyId) -> Vec2 {
        let columns = self.system.layout.columns(body);
        columns.map_or(Vec2::zeros(), |c| Vec2::new(self.x[c.x()], self.x[c.y()]))
    }
}

/// Bounds of the changes of all entries of J where the coordinates are off by the radii.
pub(super) fn changes(system: &System, at: &Kinematics, radii: &Radii) -> Vec<Change> {
    let mut all = vec![Change::default(); system.entries.len()];
    for block in &system.blocks {
        let own = &mut all[block.entries()];
        match &block.origin {
            Origin::Joint(id) => {
                let joint = &system.joints[id.0];
                match joint.role() {
                    JointRole::Revolute | JointRole::Fixed => {
                        pin_changes(at, radii, &joint.points(), own)
                    }
                    JointRole::Prismatic { axis, .. } | JointRole::Slot { axis } => {
                        let u = at.poses[joint.points()[0].body.0].turn(axis);
                        guide_changes(at, radii, &joint.points(), u, perp(u), own);
                    }
                    // It has no rows.
                    JointRole::Contact => {}
                    JointRole::Gear => gear_changes(at, radii, block, &joint.points(), own),
                    // the question is refused where there is one
                    JointRole::Cam => own.fill(Change {
                        mean: f64::INFINITY,
                        most: f64::INFINITY,
                    }),
                    // No question is answered of a mechanism with one.
                    JointRole::Rack { .. } | JointRole::Belt | JointRole::Bushing => {}
                }
            }
            Origin::Driver(id) => {
                if let DriverRole::Translation { joint } = system.drivers[id.0].role {
                    let joint = &system.joints[joint.0];
                    if let Some(axis) = joint.role().axis() {
                        let u = at.poses[joint.points()[0].body.0].turn(axis);
                        // φ = f − u·d has −u where a guide has n, and n where it has u.
                        guide_changes(at, radii, &joint.points(), perp(u), u, own);
                    }
                }
            }
            // No row stands for a stop where nothing moves by itself.
            Origin::Stop(_) | Origin::Initial(_) => {}
        }
    }
    all
}

/// Entries ∓ρ⊥ of two points that coincide, in the order of `revolute::point_entries`.
fn pin_changes(at: &Kinematics, radii: &Radii, points: &[Marker; 2], own: &mut [Change]) {
    for (side, marker) in points.iter().enumerate() {
        let (rho, turn) = (marker.rho(at), radii.turn(marker.body));
        own[4 * side + 1] = Change::turned(rho.x, rho.y, turn);
        own[4 * side + 3] = Change::turned(rho.y, rho.x, turn);
    }
}

/// Entries [nᵀ, u·w | −nᵀ, −u·ρ₂] of a guide, w = P₂ − r₁.
fn guide_changes(
    at: &Kinematics,
    radii: &Radii,
    points: &[Marker; 2],
    u: Vec2,
    n: Vec2,
    own: &mut [Change],
) {
    let [first, second] = points;
    let (turn, other) = (radii.turn(first.body), radii.turn(second.body));
    let rho = second.rho(at);
    let w = second.place(at) - at.poses[first.body.0].r;
    let moved = (radii.shift(first.body) + radii.shift(second.body)).norm() + rho.norm() * other;
    let x = Change::turned(u.x, n.x, turn);
    let y = Change::turned(u.y, n.y, turn);
    own[0] = x;
    own[1] = y;
    own[2] = Change::turned(n.dot(&w), u.dot(&w), turn).and_moved(moved);
    own[3] = x;
    own[4] = y;
    own[5] = Change::turned(n.dot(&rho), u.dot(&rho), turn + other);
}

/// Entries of a gear, see `element::gear`: k = (1 − r)/ℓ stands before t, which the Jacobian shows.
fn gear_changes(
    at: &Kinematics,
    radii: &Radii,
    block: &Block,
    points: &[Marker; 2],
    own: &mut [Change],
) {
    let entries = block.constraint.entries();
    let mut values = vec![0.0; entries.len()];
    block.constraint.jacobian(at, &mut values);
    let carrier = entries[entries.len() - 1].1;
    // k t stands in the entries of the second centre; e = −t⊥.
    let kt = Vec2::new(values[3], values[4]);
    let ke = -perp(kt);
    let turn = radii.turn(carrier);
    let [first, second] = points;
    let span = second.place(at) - first.place(at);
    let shift = |marker: &Marker| {
        radii.shift(marker.body).norm() + marker.s.norm() * radii.turn(marker.body)
    };
    let by_x = Change::turned(ke.x, kt.x, turn);
    let by_y = Change::turned(ke.y, kt.y, turn);
    for (side, marker) in points.iter().enumerate() {
        let rho = marker.rho(at);
        own[3 * side] = by_x;
        own[3 * side + 1] = by_y;
        own[3 * side + 2] =
            Change::turned(kt.dot(&rho), ke.dot(&rho), turn + radii.turn(marker.body));
    }
    own[6] = Change::turned(kt.dot(&span), ke.dot(&span), turn)
        .and_moved(kt.norm() * (shift(first) + shift(second)));
}
