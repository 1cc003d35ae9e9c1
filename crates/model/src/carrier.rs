//! Which body carries a gear pair, or the pulleys of a belt: the one that revolute (or fixed) joints hold at both wheels' centres.
//!
//! A centre is found on a body also through others: three bodies pinned at one place by two joints share it.

use super::{GROUND, Joint, JointKind, Model, PointRef};
use crate::error::Complaint;

/// The body on which both wheels of a gear turn, or both pulleys of a belt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carrier<'a> {
    /// Its name.
    pub body: &'a str,
    /// Centres of the first and the second wheel, in its frame \[m\]; one place where it holds no centres.
    pub centres: [[f64; 2]; 2],
}

/// A place in a body's frame.
type Place<'a> = (&'a str, [f64; 2]);

impl Model {
    /// The carrier of a gear or a belt; none for other joints.
    ///
    /// # Errors
    /// No body holds both centres, not the one that the file names, or the centres are one.
    pub fn carrier(&self, name: &str, joint: &Joint) -> Option<Result<Carrier<'_>, Complaint>> {
        let (JointKind::Gear { carrier, .. } | JointKind::Belt { carrier, .. }) = &joint.kind
        else {
            return None;
        };
        let (between, carrier) = (&joint.between, carrier.as_deref());
        Some(match joint.kind {
            JointKind::Belt { .. } => self.of_belt(name, between, carrier),
            _ => self.find_carrier(name, between, carrier),
        })
    }

    /// The body in which the line of centres of a belt turns little: any that the file names, else the one that holds both.
    fn of_belt(
        &self,
        name: &str,
        pulleys: &[PointRef; 2],
        named: Option<&str>,
    ) -> Result<Carrier<'_>, Complaint> {
        if let Ok(carrier) = self.find_carrier(name, pulleys, named) {
            return Ok(carrier);
        }
        let found = named.and_then(|named| self.bodies.get_key_value(named));
        if let Some((body, _)) = found {
            let centres = [[0.0; 2]; 2];
            return Ok(Carrier { body, centres });
        }
        if named == Some(GROUND) {
            let (body, centres) = (GROUND, [[0.0; 2]; 2]);
            return Ok(Carrier { body, centres });
        }
        let message = format!("no third body holds both {} and {}", pulleys[0], pulleys[1]);
        let hint = "pin both pulleys to one body, or name as \"carrier\" the body in which the line between them turns by less than half a turn";
        Err(Complaint::new(format!("joints.{name}.between"), message).hint(hint))
    }

    fn find_carrier(
        &self,
        name: &str,
        wheels: &[PointRef; 2],
        named: Option<&str>,
    ) -> Result<Carrier<'_>, Complaint> {
        let [first, second] = wheels.each_ref().map(|wheel| self.places_of(wheel));
        let on = |places: &[Place], body: &str| {
            places
                .iter()
                .find(|place| place.0 == body)
                .map(|place| place.1)
        };
        let candidates = self
            .bodies
            .keys()
            .filter(|body| wheels.iter().all(|wheel| wheel.body != **body));
        let mut carriers = candidates.filter_map(|body| {
            let centres = [on(&first, body)?, on(&second, body)?];
            named
                .is_none_or(|named| named == body)
                .then_some(Carrier { body, centres })
        });
        let both = format!("both {} and {}", wheels[0], wheels[1]);
        let between = format!("joints.{name}.between");
        match (carriers.next(), named) {
            (Some(carrier), _) if carrier.centres[0] != carrier.centres[1] => Ok(carrier),
            (Some(_), _) => Err(Complaint::new(between, "both wheels turn about one axis, as meshing wheels do not")
                .hint("write a gear for each mesh, with the wheels that lie between")),
            (None, Some(named)) if wheels.iter().any(|wheel| wheel.body == named) => {
                Err(Complaint::new(format!("joints.{name}.carrier"), "this is one of the two wheels")
                    .hint("the carrier is the third body, on which both wheels turn"))
            }
            (None, Some(named)) => Err(Complaint::new(
                format!("joints.{name}.carrier"),
                format!("no revolute joints hold {both} to body {named:?}"),
            )
            .hint("name the body on which both wheels turn, or leave \"carrier\" out")),
            (None, None) => Err(Complaint::new(between, format!("no third body carries {both}"))
                .hint("the wheels turn about these points on a body of their own: pin both to it by revolute joints")),
        }
    }

    /// All places that joints hold together with this point, itself first.
    fn places_of(&self, point: &PointRef) -> Vec<Place<'_>> {
        let mut places: Vec<Place> = self.place(point).into_iter().collect();
        let mut next = 0;
        while let Some(&here) = places.get(next) {
            next += 1;
            for joint in self
                .joints
                .values()
                .filter(|joint| holds_points(&joint.kind))
            {
                for (from, to) in [(0, 1), (1, 0)] {
                    let (from, to) = (&joint.between[from], &joint.between[to]);
                    let other = (from.body == here.0 && self.place(from) == Some(here))
                        .then(|| self.place(to));
                    places.extend(other.flatten().filter(|place| !places.contains(place)));
                }
            }
        }
        places
    }

    fn place(&self, point: &PointRef) -> Option<Place<'_>> {
        let (name, body) = self.bodies.get_key_value(&point.body)?;
        Some((name, *body.points.get(&point.point)?))
    }
}

/// Whether the joint's points coincide (but for a clearance).
fn holds_points(kind: &JointKind) -> bool {
    matches!(kind, JointKind::Revolute { .. } | JointKind::Fixed { .. })
}
