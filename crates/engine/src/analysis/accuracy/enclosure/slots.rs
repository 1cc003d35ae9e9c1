//! Which coordinates are enclosed one by one, and where their bounds stand.
//!
//! All angles are, and places of bodies that something other than pins holds: guides, gears. From there pins lead to
//! every other body, each passed once at most, so that for the places of all these
//!
//! ```text
//! |Δr| ≤ D = max |Δr| of bodies that are placed + Σ of pins (|s₁| |Δθ₁| + |s₂| |Δθ₂| + gap)
//! ```
//!
//! Nothing but round-off goes with D. Bounds stand in lists of slots: of four coordinates each, with zeros behind the last, then D,
//! then 0 for ground.

use super::super::dimensions::Dimensions;
use super::super::source::Play;
use super::extents::Extents;
use crate::element::{Axis, BodyId, Marker};
use crate::system::{DriverRole, JointRole, Origin, System};

/// D is widened by its rounding.
const WIDENED: f64 = 1.0 + 1e-9;

/// Slots of the coordinates.
pub(super) struct Slots {
    /// Number of slots before D.
    len: usize,
    /// The slot of each column (n).
    pub of: Vec<u32>,
    /// Those of x, y and θ of each body, ground first.
    bodies: Vec<[u32; 3]>,
    /// Angles of bodies that move, and what a radian of each moves others at most \[m\].
    spans: Vec<(u32, f64)>,
    /// Slots of x and y of bodies that are placed.
    places: Vec<[u32; 2]>,
    /// What gaps of all pins together move \[m\].
    gaps: f64,
}

impl Slots {
    /// Of a mechanism, with the columns that are enclosed one by one, in the order of their slots.
    pub fn new(
        system: &System,
        (plays, dimensions): (&[Play], &Dimensions),
        extents: &Extents,
    ) -> (Slots, Vec<usize>) {
        let pins = pins(system);
        let is_placed = placed(system, &pins);
        let layout = &system.layout;
        let is_wanted = |column: &usize| {
            let (body, axis) = layout.coordinate(*column);
            axis.is_angle() || is_placed[body.0]
        };
        let wanted: Vec<usize> = (0..layout.n()).filter(is_wanted).collect();
        let far = 4 * wanted.len().div_ceil(4) as u32;
        let mut of = vec![far; layout.n()];
        for (slot, &column) in wanted.iter().enumerate() {
            of[column] = slot as u32;
        }
        let mut bodies = vec![[far + 1; 3]];
        bodies.extend(layout.bodies().map(|own| {
            let columns = [own.x(), own.y(), own.theta()];
            columns.map(|column| of[column])
        }));
        // A point goes as far from its place as steps and zones put it.
        let mut spans = vec![0.0; bodies.len()];
        let mut gaps = 0.0;
        for marker in pins.iter().flatten() {
            spans[marker.body.0] += marker.s.norm();
        }
        let off = extents.off.iter().zip(&extents.beyond);
        for (point, (off, beyond)) in dimensions.points.iter().zip(off) {
            let most = (off + beyond) * point.grips.len() as f64;
            spans[point.body.0] += most;
            gaps += most;
        }
        for play in plays {
            if let Play::Pin { clearance, .. } = play {
                gaps += clearance[1];
            }
        }
        let angles = bodies.iter().map(|&[_, _, angle]| angle);
        let places = bodies.iter().zip(&is_placed).skip(1);
        let slots = Slots {
            places: places
                .filter(|(_, is_placed)| **is_placed)
                .map(|(&[x, y, _], _)| [x, y])
                .collect(),
            spans: angles.zip(spans).skip(1).collect(),
            len: far as usize,
            of,
            bodies,
            gaps,
        };
        (slots, wanted)
    }

    /// Slots that belong to coordinates, the zeros behind them included.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Length of a list of slots.
    pub fn room(&self) -> usize {
        self.len() + 2
    }

    /// The slot of a coordinate of a body.
    pub fn coordinate(&self, body: BodyId, axis: Axis) -> u32 {
        self.bodies[body.0][axis as usize]
    }

    /// Whether a column is one of those that share D.
    pub fn is_far(&self, column: usize) -> bool {
        self.of[column] as usize == self.len
    }

    /// Slots of the angles of all bodies that move.
    pub fn angles(&self) -> impl ExactSizeIterator<Item = u32> {
        self.spans.iter().map(|&(slot, _)| slot)
    }

    /// The slot of an angle by its number among them.
    pub fn angle(&self, number: u32) -> usize {
        let (slot, _) = self.spans[number as usize];
        slot as usize
    }

    /// The greatest of all angles.
    pub fn greatest_angle(&self, x: &[f64]) -> f64 {
        let angles = self.spans.iter().map(|&(slot, _)| x[slot as usize]);
        angles.fold(0.0, f64::max)
    }

    /// Sets D, where gaps of all rows together are off by no more than `gap` at the pose.
    pub fn set_far(&self, gap: f64, x: &mut [f64]) {
        let places = self.places.iter();
        let places = places.map(|&[a, b]| x[a as usize] + x[b as usize]);
        let mut far = places.fold(0.0, f64::max) + self.gaps + gap;
        for &(slot, span) in &self.spans {
            far += span * x[slot as usize];
        }
        x[self.len()] = WIDENED * far;
    }
}

/// The points of all joints that hold points together.
fn pins(system: &System) -> Vec<[Marker; 2]> {
    let mut pins = Vec::new();
    for block in &system.blocks {
        if let Origin::Joint(id) = block.origin {
            let joint = &system.joints[id.0];
            if let JointRole::Revolute | JointRole::Fixed = joint.role() {
                pins.push(joint.points());
            }
        }
    }
    pins
}

/// Which bodies are placed, ground among them: those that something other than a pin holds, and of those that no pins lead to
/// from there one each.
fn placed(system: &System, pins: &[[Marker; 2]]) -> Vec<bool> {
    let mut placed = vec![false; system.bodies.len() + 1];
    placed[BodyId::GROUND.0] = true;
    for joint in &system.joints {
        match joint.role() {
            JointRole::Revolute | JointRole::Fixed => {}
            JointRole::Prismatic { .. }
            | JointRole::Slot { .. }
            | JointRole::Gear
            | JointRole::Cam
            | JointRole::Rack { .. }
            | JointRole::Belt
            | JointRole::Bushing
            | JointRole::Contact => joint.bodies().iter().for_each(|body| placed[body.0] = true),
        }
    }
    for driver in &system.drivers {
        if let DriverRole::Length { between } = driver.role {
            between.iter().for_each(|end| placed[end.body.0] = true);
        }
    }
    let mut is_reached = placed.clone();
    loop {
        let mut is_more = false;
        for [a, b] in pins {
            let (a, b) = (a.body.0, b.body.0);
            if is_reached[a] != is_reached[b] {
                (is_reached[a], is_reached[b], is_more) = (true, true, true);
            }
        }
        if !is_more {
            let Some(next) = is_reached.iter().position(|is_reached| !is_reached) else {
                return placed;
            };
            (placed[next], is_reached[next]) = (true, true);
        }
    }
}
