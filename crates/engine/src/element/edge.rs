//! A piece of an outline of the first body, and a round tip of the second that may touch it.
//!
//! An outline has its material on the left of the way along it. Its pieces are straight, arcs, and the corners of the material,
//! which are arcs of radius zero. With P the tip's centre, r its radius, n the direction from it into the material and t = n⊥:
//!
//! ```text
//! straight   δ = n·(P − E) + r                       n, E fixed in the first body                          [m]
//! arc        δ = n·(P − O) − (R − r)                 n = ±(P − O)/|P − O|, as in [`super::journal`]        [m]
//! v_t        of the straight: d(t·(P − E))/dt + (r − δ/2) (ω₂ − ω₁)                                      [m/s]
//! Q = −N ∂δ/∂q + T ∂v_t/∂v
//! ```
//!
//! R is the radius of an arc that curves around the tip as a bearing does. One that curves away from it (a disc, a corner) has R and
//! R − r below zero, and n points to its centre: the equations are those of a journal in a bearing, word for word.
//!
//! Each piece acts where the tip is above it: its **room** is how far the tip's centre is from the ends of the piece \[m\]. Where
//! that is negative there is no contact, but with one of the neighbours. What comes in from the side, deep in the material, is behind
//! the surface, and has nothing to do with it. How an outline goes on at the [`End`] of a piece:
//!
//! ```text
//! tangent, convex    the same touch goes over to the next piece; a point in the material of a convex corner, on its bisector
//! hollow             the next piece stands in the way, and both touch; for a point the surface goes on a little into its material
//! ```

use super::journal::Journal;
use super::span::all_pairs;
use super::straight::{RollingTip, Straight};
use super::touch::{Compliant, Contact, ContactId, Reading};
use super::{Applied, Constraint, Kinematics, Marker, Slope};
use linkdyn_linear::math::Vec2;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Depth, in parts of the mechanism, up to which a tip is taken to have come from above.
const SHALLOW: f64 = 1e-2;

/// Half of an arc \[rad\] up to which the directions within it are those on the right sides of both its ends.
const FLAT: f64 = 0.49 * PI;

/// A piece of an outline, and the tip that may touch it.
#[derive(Debug, Clone)]
pub struct Edge {
    /// The piece.
    pub piece: Piece,
    /// Where the tip's round is.
    pub tip: Option<Sector>,
    /// A tip that comes in from the side deeper than this is behind the surface \[m\].
    pub deepest: f64,
    /// What penetrations are measured against \[m\].
    pub size: f64,
    /// Where it begins, and where it ends.
    pub ends: [End; 2],
}

/// How an outline goes on where a piece of it ends.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct End {
    /// The piece to which a touch goes over.
    pub next: Option<ContactId>,
    /// How far the surface goes on into the material of a piece that stands in the way \[m\].
    pub beyond: f64,
    /// Tangent of half the turn of a corner that a point goes around.
    pub lean: f64,
}

/// What the outline is there.
#[derive(Debug, Clone)]
pub enum Piece {
    /// A straight.
    Straight(Straight),
    /// An arc, and the directions from its centre in which it is.
    Round(Journal, Sector),
}

/// Directions within a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sector {
    /// The one in the middle \[rad\].
    pub middle: f64,
    /// How far they are from it \[rad\].
    pub half: f64,
}

impl Sector {
    /// From one direction to another, turning left \[rad\].
    pub fn between(from: f64, to: f64) -> Self {
        let half = 0.5 * (to - from).rem_euclid(TAU);
        Sector {
            middle: from + half,
            half,
        }
    }

    /// How far a direction of a body at an angle is from the ends \[rad\]; negative outside.
    fn rooms(&self, direction: Vec2, angle: f64) -> [f64; 2] {
        let off = direction.y.atan2(direction.x) - angle - self.middle;
        let off = (off + PI).rem_euclid(TAU) - PI;
        [self.half + off, self.half - off]
    }

    /// The same of the nearer one.
    fn room(&self, direction: Vec2, angle: f64) -> f64 {
        let [from, to] = self.rooms(direction, angle);
        from.min(to)
    }
}

impl Edge {
    /// The points: one of the outline's piece, and the tip's centre.
    pub fn markers(&self) -> [Marker; 2] {
        match &self.piece {
            Piece::Straight(straight) => [straight.stop.first, straight.stop.second],
            Piece::Round(journal, _) => [journal.bearing, journal.journal],
        }
    }

    /// Geometry and velocities.
    pub fn read(&self, at: &Kinematics) -> Reading {
        let mut reading = match &self.piece {
            Piece::Straight(straight) => straight.read(at),
            Piece::Round(journal, _) => Reading {
                // That of a bearing alone is reported.
                eccentricity: Vec2::zeros(),
                ..journal.read(at)
            },
        };
        reading.room = self.room(at, &reading);
        reading
    }

    /// How far the tip's centre is from the beginning and from the end of the piece \[m\].
    fn rooms(&self, at: &Kinematics, towards: Vec2) -> [f64; 2] {
        let [outline, _] = self.markers();
        match &self.piece {
            Piece::Straight(straight) => straight.rooms(at),
            Piece::Round(journal, sector) => {
                let out = towards * journal.side();
                let rooms = sector.rooms(out, at.poses[outline.body.0].theta);
                let [from, to] = rooms.map(|room| room * journal.clearance.abs());
                // The way along a hollow turns right.
                match journal.bearing_radius > 0.0 {
                    true => [to, from],
                    false => [from, to],
                }
            }
        }
    }

    fn room(&self, at: &Kinematics, reading: &Reading) -> f64 {
        let [_, centre] = self.markers();
        let depth = reading.penetration.max(0.0);
        let rooms = self.rooms(at, reading.towards).into_iter().zip(self.ends);
        let room = rooms.fold(f64::INFINITY, |least, (room, end)| {
            least.min(room + end.beyond - end.lean * depth)
        });
        let tip = self.tip.map_or(f64::INFINITY, |sector| {
            let angle = at.poses[centre.body.0].theta;
            sector.room(reading.towards, angle) * self.radius()
        });
        room.min(tip)
    }

    /// How far the tip's centre is from both ends \[m\], by functions that are smooth also where it passes the centre of an arc: above
    /// zero together where there is room.
    pub fn level_rooms(&self, at: &Kinematics, reading: &Reading) -> [f64; 2] {
        let [outline, centre] = self.markers();
        let mut rooms = self.rooms(at, reading.towards);
        if let Piece::Round(_, sector) = &self.piece
            && sector.half < FLAT
        {
            let from_middle = centre.place(at) - outline.place(at);
            let turn = at.poses[outline.body.0].theta + sector.middle;
            let end = |angle: f64| Vec2::new((turn + angle).cos(), (turn + angle).sin());
            let [from, to] = [end(-sector.half), end(sector.half)];
            rooms = [from.perp(&from_middle), from_middle.perp(&to)];
            if matches!(&self.piece, Piece::Round(journal, _) if journal.bearing_radius > 0.0) {
                rooms.reverse();
            }
        }
        let depth = reading.penetration.max(0.0);
        for (room, end) in rooms.iter_mut().zip(self.ends) {
            *room += end.beyond - end.lean * depth;
        }
        if let Some(sector) = self.tip {
            let angle = at.poses[centre.body.0].theta;
            rooms[0] = rooms[0].min(sector.room(reading.towards, angle) * self.radius());
        }
        rooms
    }

    /// The end that the tip's centre is nearer to, 0 or 1.
    pub fn nearer_end(&self, at: &Kinematics, reading: &Reading) -> usize {
        let [from, to] = self.rooms(at, reading.towards);
        usize::from(to < from)
    }

    /// How far the tip's centre is from the piece, and its height over it, negative on the side of the material \[m\]; none of a
    /// corner, which its neighbours have too.
    pub fn near(&self, at: &Kinematics) -> Option<[f64; 2]> {
        let [outline, centre] = self.markers();
        let centre = centre.place(at);
        match &self.piece {
            Piece::Straight(straight) => {
                let height = -straight.stop.coordinate(at);
                let [from, to] = straight.rooms(at);
                let beyond = (-from.min(to)).max(0.0);
                Some([height.hypot(beyond), height])
            }
            Piece::Round(journal, _) if journal.bearing_radius == 0.0 => None,
            Piece::Round(journal, sector) => {
                let (radius, middle) = (journal.bearing_radius, outline.place(at));
                let turn = at.poses[outline.body.0].theta + sector.middle;
                let d = centre - middle;
                let off = (d.y.atan2(d.x) - turn + PI).rem_euclid(TAU) - PI;
                let nearest = turn + off.clamp(-sector.half, sector.half);
                let out = Vec2::new(nearest.cos(), nearest.sin());
                let from = d - out * radius.abs();
                Some([from.norm(), -radius.signum() * from.dot(&out)])
            }
        }
    }

    /// How deep the tip is in the material, where it has come from above \[m\]; not above zero elsewhere.
    pub fn depth(&self, reading: &Reading, size: f64) -> f64 {
        let most = self.radius().max(SHALLOW * size);
        match reading.penetration <= most {
            true => reading.penetration.min(reading.room),
            false => 0.0,
        }
    }

    /// r
    pub fn radius(&self) -> f64 {
        match &self.piece {
            Piece::Straight(straight) => straight.radius,
            Piece::Round(journal, _) => journal.bearing_radius - journal.clearance,
        }
    }

    /// Adds a normal and a tangential force at the contact of a reading, on both bodies.
    pub fn press(&self, at: &Kinematics, reading: &Reading, forces: [f64; 2], to: &mut Applied) {
        match &self.piece {
            Piece::Straight(straight) => straight.press(at, reading, forces, to),
            Piece::Round(journal, _) => journal.press(at, reading, forces, to),
        }
    }

    /// Where the derivatives of the contact's forces can be non-zero, in the order [`Edge::slope`] writes.
    pub fn slopes(&self) -> Vec<Slope> {
        let [first, second] = self.markers();
        all_pairs(&first, &second)
    }

    /// Their values, of surfaces without bristles.
    pub fn slope(
        &self,
        at: &Kinematics,
        laws: (&Contact, &Compliant),
        reading: &Reading,
        position: &mut [f64],
        velocity: &mut [f64],
    ) {
        match &self.piece {
            Piece::Straight(straight) => straight.slope(at, laws, reading, position, velocity),
            Piece::Round(journal, _) => journal.slope(at, laws, reading, position, velocity),
        }
    }

    /// R − r of an arc \[m\], 0 of a straight.
    pub fn bend(&self) -> f64 {
        match &self.piece {
            Piece::Straight(_) => 0.0,
            Piece::Round(journal, _) => journal.clearance,
        }
    }

    /// The length over which the direction of the contact turns once \[m\]; none of a straight, which has one direction.
    pub fn turns_over(&self) -> Option<f64> {
        match &self.piece {
            Piece::Straight(_) => None,
            Piece::Round(journal, _) => Some(journal.clearance.abs()),
        }
    }

    /// δ = 0.
    pub fn sustained(&self) -> Arc<dyn Constraint> {
        match &self.piece {
            Piece::Straight(straight) => Arc::new(straight.stop.clone()),
            Piece::Round(journal, _) => Arc::new(journal.following()),
        }
    }

    /// The same, and no sliding.
    pub fn stuck(&self, id: ContactId) -> Arc<dyn Constraint> {
        match &self.piece {
            Piece::Straight(straight) => Arc::new(RollingTip {
                straight: straight.clone(),
                id,
            }),
            Piece::Round(journal, _) => Arc::new(journal.sticking(id)),
        }
    }

    /// What a tip that begins to stick keeps \[m\].
    pub fn anchor(&self, at: &Kinematics, id: ContactId) -> f64 {
        match &self.piece {
            Piece::Straight(straight) => straight.rolled(at),
            Piece::Round(journal, _) => journal.sticking(id).rolled(at),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::straight::tests::straight;
    use super::super::tests::{Named, marker};
    use super::*;
    use crate::element::following::{Following, Sticking};

    /// A tip on a piece of an outline, for checks by differences.
    pub(in crate::element) fn edge(piece: Piece) -> Edge {
        Edge {
            piece,
            tip: None,
            deepest: 1.0,
            size: 0.7,
            ends: [End::default(); 2],
        }
    }

    /// A disc that a journal touches from outside.
    pub(in crate::element) fn disc() -> Journal {
        Journal {
            bearing: marker(1, 0.3, -0.2),
            journal: marker(2, -0.4, 0.1),
            clearance: -0.9,
            bearing_radius: -0.5,
        }
    }

    /// Tips that slide on a disc, and that stick; and stops, of which a straight's constraint is one.
    pub(in crate::element) fn held() -> Vec<Named> {
        let following: Following = disc().following();
        let sticking: Sticking = disc().sticking(ContactId(0));
        let rolling = RollingTip {
            straight: straight(),
            id: ContactId(0),
        };
        let held: [Named; 3] = [
            ("following a disc", Box::new(following)),
            ("sticking to a disc", Box::new(sticking)),
            ("rolling on a straight", Box::new(rolling)),
        ];
        super::super::stop::tests::each()
            .into_iter()
            .chain(held)
            .collect()
    }

    #[test]
    fn sectors_go_round() {
        let sector = Sector::between(3.0, -3.0);
        let room = |direction: f64, angle: f64| {
            sector.room(Vec2::new(direction.cos(), direction.sin()), angle)
        };
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found}");
        near(sector.half, PI - 3.0);
        near(room(PI, 0.0), PI - 3.0);
        near(room(3.0, 0.0), 0.0);
        near(room(0.1 - PI, 0.3), PI - 3.0 - 0.2);
        near(room(0.0, 0.0), -3.0);
        near(room(7.0 * PI, 40.0 * PI), PI - 3.0);
    }
}
