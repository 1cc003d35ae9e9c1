//! By how much the entries of J can change as the coordinates move, and what that does to the rows.

use super::slots::Slots;
use crate::element::{Axis, BodyId, Kinematics, Marker};
use crate::system::{Block, DriverRole, JointData, JointRole, Origin, System};
use linkdyn_linear::math::{Vec2, perp};

/// The entries ∓ρ⊥ of a pin for the angle of a body.
pub(super) struct Pin {
    /// The first of its two rows.
    pub row: u32,
    /// The number of the angle.
    pub angle: u32,
    /// The first entry of the body; those of its angle are the second and the fourth.
    entry: u32,
    /// |ρ| along x and y at the pose.
    pub arm: [f64; 2],
    /// What gaps of its rows change as the body turns \[m/rad\].
    pub gaps: [f64; 2],
}

/// An entry of J of a guide or a gear that turns with bodies.
struct Turning {
    row: u32,
    /// Its coordinate.
    slot: u32,
    /// The angles that it turns with.
    by: [u32; 2],
    /// Its first derivative at the pose.
    slope: f64,
    /// Its size at the pose, or what of it turns.
    size: f64,
}

/// One that changes as points move, besides.
struct Moving {
    row: u32,
    /// Its coordinate.
    slot: u32,
    /// Its change by a metre.
    by: f64,
    points: [Point; 2],
    is_guide: bool,
}

/// A point of a body.
pub(super) struct Point {
    place: [u32; 2],
    pub angle: u32,
    /// How far it is from the centre of mass \[m\].
    arm: f64,
}

impl Point {
    pub fn new(marker: &Marker, slots: &Slots) -> Point {
        let slot = |axis| slots.coordinate(marker.body, axis);
        Point {
            place: [slot(Axis::X), slot(Axis::Y)],
            angle: slot(Axis::Theta),
            arm: marker.s.norm(),
        }
    }

    /// How far its body is off.
    pub fn shift(&self, x: &[f64]) -> Vec2 {
        Vec2::new(x[self.place[0] as usize], x[self.place[1] as usize])
    }

    /// How far it moves as its body turns.
    pub fn swing(&self, x: &[f64]) -> f64 {
        self.arm * x[self.angle as usize]
    }
}

impl Moving {
    /// How far its points can move.
    fn length(&self, x: &[f64]) -> f64 {
        let [first, second] = &self.points;
        match self.is_guide {
            // The arm of the first body is no part of w.
            true => (first.shift(x) + second.shift(x)).norm() + second.swing(x),
            false => {
                let [first, second] = [first, second].map(|p| p.shift(x).norm() + p.swing(x));
                first + second
            }
        }
    }
}

/// Guides or gears, whose slopes follow from a pose.
enum Source {
    /// A guide; along or across which rows are measured.
    Guide {
        points: [Marker; 2],
        axis: Vec2,
        is_along: bool,
    },
    /// A gear: its first entry.
    Gear { entry: usize, points: [Marker; 2] },
}

/// All entries of J that change.
#[derive(Default)]
pub(super) struct Changes {
    /// Of pins, which change with one angle.
    pub pins: Vec<Pin>,
    /// Guides and gears, and their entries in turn.
    sources: Vec<Source>,
    turning: Vec<Turning>,
    moving: Vec<Moving>,
    /// Whether nothing bounds some.
    pub are_unbounded: bool,
}

impl Changes {
    /// Of a mechanism.
    pub fn new(system: &System, slots: &Slots) -> Changes {
        let mut changes = Changes::default();
        for block in &system.blocks {
            match &block.origin {
                Origin::Joint(id) => changes.add_joint(&system.joints[id.0], block, slots),
                Origin::Driver(id) => {
                    if let DriverRole::Translation { joint } = system.drivers[id.0].role {
                        let joint = &system.joints[joint.0];
                        if let Some(axis) = joint.role().axis() {
                            changes.add_guide(block, joint.points(), (axis, true), slots);
                        }
                    }
                }
                // No row stands for a stop where nothing moves by itself.
                Origin::Stop(_) | Origin::Initial(_) => {}
            }
        }
        changes
    }

    fn add_joint(&mut self, joint: &JointData, block: &Block, slots: &Slots) {
        let points = joint.points();
        match joint.role() {
            JointRole::Revolute | JointRole::Fixed => {
                let sides = points.iter().zip([0, 4]);
                self.pins.extend(sides.filter_map(|(marker, side)| {
                    Some(Pin {
                        row: block.row() as u32,
                        angle: marker.body.index()? as u32,
                        entry: (block.entries().start + side) as u32,
                        arm: [0.0; 2],
                        gaps: [0.0; 2],
                    })
                }));
            }
            JointRole::Prismatic { axis, .. } | JointRole::Slot { axis } => {
                self.add_guide(block, points, (axis, false), slots);
            }
            JointRole::Gear => {
                let entry = block.entries().start;
                self.sources.push(Source::Gear { entry, points });
                let entries = block.constraint.entries();
                let carrier = entries[entries.len() - 1].1;
                for Marker { body, .. } in points {
                    for axis in [Axis::X, Axis::Y] {
                        self.add(block.row(), (body, axis), [carrier, BodyId::GROUND], slots);
                    }
                    self.add(block.row(), (body, Axis::Theta), [carrier, body], slots);
                }
                let turn = (carrier, Axis::Theta);
                self.add(block.row(), turn, [carrier, BodyId::GROUND], slots);
                self.moving.push(Moving {
                    row: block.row() as u32,
                    slot: slots.coordinate(carrier, Axis::Theta),
                    by: 0.0,
                    points: points.map(|point| Point::new(&point, slots)),
                    is_guide: false,
                });
            }
            // The question is refused where there is one.
            JointRole::Cam => self.are_unbounded = true,
            // No question is answered of a mechanism with one.
            JointRole::Rack { .. } | JointRole::Belt | JointRole::Bushing => {}
            // It has no rows.
            JointRole::Contact => {}
        }
    }

    fn add_guide(
        &mut self,
        block: &Block,
        points: [Marker; 2],
        (axis, is_along): (Vec2, bool),
        slots: &Slots,
    ) {
        self.sources.push(Source::Guide {
            points,
            axis,
            is_along,
        });
        let [first, second] = points.map(|point| point.body);
        for (body, other) in [(first, BodyId::GROUND), (second, second)] {
            for axis in [Axis::X, Axis::Y] {
                self.add(block.row(), (body, axis), [first, BodyId::GROUND], slots);
            }
            self.add(block.row(), (body, Axis::Theta), [first, other], slots);
        }
        self.moving.push(Moving {
            row: block.row() as u32,
            slot: slots.coordinate(first, Axis::Theta),
            by: 1.0,
            points: points.map(|point| Point::new(&point, slots)),
            is_guide: true,
        });
    }

    fn add(&mut self, row: usize, (body, axis): (BodyId, Axis), by: [BodyId; 2], slots: &Slots) {
        self.turning.push(Turning {
            row: row as u32,
            slot: slots.coordinate(body, axis),
            by: by.map(|body| slots.coordinate(body, Axis::Theta)),
            slope: 0.0,
            size: 0.0,
        });
    }

    /// Takes over what gaps of a row change with an angle, where a pin has both; whether one has.
    pub fn take_gap(&mut self, row: u32, angle: u32, by: f64) -> bool {
        let mut pins = self.pins.iter_mut();
        let pin = pins.find(|pin| pin.angle == angle && row.wrapping_sub(pin.row) < 2);
        let is_taken = pin.is_some();
        if let Some(pin) = pin {
            pin.gaps[(row - pin.row) as usize] += by;
        }
        is_taken
    }

    /// Takes the slopes and sizes of a pose.
    pub fn take(&mut self, at: &Kinematics, jacobian: &[f64]) {
        for pin in &mut self.pins {
            let entry = pin.entry as usize;
            pin.arm = [jacobian[entry + 3].abs(), jacobian[entry + 1].abs()];
        }
        let mut turning = self.turning.iter_mut();
        let mut set = |slope: f64, size: f64| {
            if let Some(next) = turning.next() {
                (next.slope, next.size) = (slope.abs(), size.abs());
            }
        };
        for (source, moving) in self.sources.iter().zip(&mut self.moving) {
            match source {
                Source::Guide {
                    points,
                    axis,
                    is_along,
                } => {
                    let u = at.poses[points[0].body.0].turn(*axis);
                    // φ = f − u·d has −u where a guide has n, and n where it has u.
                    let pair = if *is_along {
                        [perp(u), u]
                    } else {
                        [u, perp(u)]
                    };
                    guide_slopes(at, points, pair, &mut set);
                }
                Source::Gear { entry, points } => {
                    moving.by = gear_slopes(at, points, &jacobian[*entry..], &mut set).norm();
                }
            }
        }
    }

    /// Whether there are guides or gears.
    pub fn has_others(&self) -> bool {
        !self.sources.is_empty()
    }

    /// Adds to the rows (m) the changes of pins in the mean along the way where the coordinates are off by `by`, times `x`, and those
    /// of their gaps.
    pub fn add_pins(&self, slots: &Slots, by: &[f64], x: &[f64], rows: &mut [f64]) {
        for pin in &self.pins {
            let slot = slots.angle(pin.angle);
            let angle = by[slot];
            let (first, second) = (0.5 * angle * x[slot], angle * angle * x[slot] / 6.0);
            let [along, across] = pin.arm;
            let [a, b] = pin.gaps;
            rows[pin.row as usize] += a * angle + along * first + across * second;
            rows[pin.row as usize + 1] += b * angle + across * first + along * second;
        }
    }

    /// Adds to the rows (m) the changes of guides and gears where the coordinates are off by `by`, times `x`: in the mean along
    /// the way, and anywhere on it.
    pub fn add_others(&self, by: &[f64], x: &[f64], rows: &mut [[f64; 2]]) {
        for entry in &self.turning {
            let angle = by[entry.by[0] as usize] + by[entry.by[1] as usize];
            let linear = entry.slope * angle;
            let square = 0.5 * entry.size * angle * angle;
            let x = x[entry.slot as usize];
            let [mean, most] = &mut rows[entry.row as usize];
            *mean += (0.5 * linear + square / 3.0) * x;
            *most += (linear + square) * x;
        }
        for entry in &self.moving {
            let change = entry.by * entry.length(by) * x[entry.slot as usize];
            let [mean, most] = &mut rows[entry.row as usize];
            *mean += 0.5 * change;
            *most += change;
        }
    }
}

/// Entries [nᵀ, u·w | −nᵀ, −u·ρ₂] of a guide, w = P₂ − r₁.
fn guide_slopes(
    at: &Kinematics,
    [first, second]: &[Marker; 2],
    [u, n]: [Vec2; 2],
    set: &mut impl FnMut(f64, f64),
) {
    let rho = second.rho(at);
    let w = second.place(at) - at.poses[first.body.0].r;
    for arm in [w, rho] {
        set(u.x, n.x);
        set(u.y, n.y);
        set(n.dot(&arm), u.dot(&arm));
    }
}

/// Entries of a gear, see `element::gear`: k = (1 − r)/ℓ stands before t, which the Jacobian shows. Says k t.
fn gear_slopes(
    at: &Kinematics,
    [first, second]: &[Marker; 2],
    jacobian: &[f64],
    set: &mut impl FnMut(f64, f64),
) -> Vec2 {
    // k t stands in the entries of the second centre; e = −t⊥.
    let kt = Vec2::new(jacobian[3], jacobian[4]);
    let ke = -perp(kt);
    for marker in [first, second] {
        let rho = marker.rho(at);
        set(ke.x, kt.x);
        set(ke.y, kt.y);
        set(kt.dot(&rho), ke.dot(&rho));
    }
    let span = second.place(at) - first.place(at);
    set(kt.dot(&span), ke.dot(&span));
    kt
}
