//! Joints beyond their constraints.

use super::roles::{ClearanceLink, JointFriction, JointRole};
use crate::element::beam::Beam;
use crate::element::belt::Belt;
use crate::element::bushing::Bushing;
use crate::element::cam::Cam;
use crate::element::journal::Bearing;
use crate::element::pair::ContactId;
use crate::element::revolute::Revolute;
use crate::element::{BodyId, Constraint, Marker};
use std::ops::Range;
use std::sync::Arc;

/// The lower and the upper stop of a joint, its one-way clutch, and its lock.
pub(crate) type Ends = [Option<ContactId>; 4];

/// A joint's numbers beyond its constraint.
#[derive(Debug, Clone)]
pub struct JointData {
    /// As the file names it.
    pub name: String,
    /// Where it joins its bodies: the pin that is its constraint, of an ideal one.
    pin: Option<Arc<Revolute>>,
    /// What few joints have: most of a large mechanism are plain pins.
    extras: Option<Box<JointExtras>>,
}

/// What few joints have.
#[derive(Debug, Clone)]
pub(crate) struct JointExtras {
    /// What kind of joint it is, for results and pictures.
    role: JointRole,
    /// Carries a torque in the results.
    torque: bool,
    /// Where it joins its bodies, where no pin tells it.
    points: Option<[Marker; 2]>,
    /// Its clearance link, where that is its model.
    pub clearance: Option<ClearanceLink>,
    /// Journal and bearing that touch by a contact force.
    pub contact: Option<ContactId>,
    /// Its profile and what touches it, of a cam.
    pub cam: Option<Arc<Cam>>,
    /// Where its way ends.
    pub stops: Option<Box<Ends>>,
    /// From where to where points of a moving body draw its slot \[m\], along its axis from its own point; nothing ends there.
    pub drawn: Option<Box<[f64; 2]>>,
    /// It, where it closes and opens.
    pub clasp: Option<ContactId>,
    /// Pieces of its outline.
    pub edges: Range<usize>,
    /// Of a joint with a `clearance` in the file, whatever its model.
    pub bearing: Option<Bearing>,
    /// Of an ideal joint with friction.
    pub friction: Option<JointFriction>,
    /// Pulleys with a belt.
    pub belt: Option<Box<Belt>>,
    /// A pin in rubber.
    pub bushing: Option<Box<Bushing>>,
    /// An elastic bar.
    pub beam: Option<Box<Beam>>,
}

/// Those of a joint that has nothing of them.
static PLAIN: JointExtras = JointExtras {
    role: JointRole::Revolute,
    torque: false,
    points: None,
    clearance: None,
    contact: None,
    cam: None,
    stops: None,
    drawn: None,
    clasp: None,
    edges: 0..0,
    bearing: None,
    friction: None,
    belt: None,
    bushing: None,
    beam: None,
};

impl JointData {
    /// An ideal pin.
    pub(super) fn pin(name: &str, pin: Arc<Revolute>) -> Self {
        JointData {
            name: name.to_owned(),
            pin: Some(pin),
            extras: None,
        }
    }

    /// Another joint of two points.
    pub(super) fn of(name: &str, role: JointRole, points: [Marker; 2], torque: bool) -> Self {
        JointData {
            name: name.to_owned(),
            pin: None,
            extras: Some(Box::new(JointExtras {
                role,
                torque,
                points: Some(points),
                ..PLAIN.clone()
            })),
        }
    }

    /// What holds parts of an elastic link.
    pub(super) fn inner(name: &str, points: [Marker; 2]) -> Self {
        JointData::of(name, JointRole::Inner, points, true)
    }

    /// Whether it is a joint of the file.
    pub(crate) fn is_own(&self) -> bool {
        self.role() != JointRole::Inner
    }

    /// The same joint of other points.
    pub(super) fn moved(mut self, points: [Marker; 2]) -> Self {
        self.pin = None;
        self.change_extras(|extras| extras.points = Some(points));
        self
    }

    /// Whether its points are all its numbers.
    pub(super) fn is_numbered(&self) -> bool {
        let mut rest = self.clone();
        rest.change_extras(|extras| {
            extras.role = PLAIN.role;
            extras.torque = false;
            extras.points = None;
        });
        rest.extras.is_none()
    }

    /// The constraint of an ideal pin with other numbers, which is its own from now on.
    pub(super) fn renumber_pin(
        &mut self,
        number: &mut dyn FnMut(f64) -> f64,
    ) -> Option<Arc<dyn Constraint>> {
        let pin = self.pin.as_mut()?;
        *pin = Arc::new(pin.map(number));
        Some(pin.clone())
    }

    /// Other numbers of the points of what is no pin.
    pub(super) fn renumber_points(&mut self, number: &mut dyn FnMut(f64) -> f64) {
        let extras = self.extras.as_deref_mut();
        if let Some(points) = extras.and_then(|extras| extras.points.as_mut()) {
            *points = points.map(|point| point.map(&mut *number));
        }
    }

    /// What kind of joint it is, for results and pictures.
    pub fn role(&self) -> JointRole {
        self.extras().role
    }

    /// Carries a torque in the results.
    pub(crate) fn torque(&self) -> bool {
        self.extras().torque
    }

    /// Where it joins its bodies.
    pub fn points(&self) -> [Marker; 2] {
        match (&self.pin, self.extras().points) {
            (_, Some(points)) => points,
            (Some(pin), None) => [pin.first, pin.second],
            (None, None) => unreachable!("a joint without a pin has points"),
        }
    }

    /// What it joins.
    pub fn bodies(&self) -> [BodyId; 2] {
        self.points().map(|point| point.body)
    }

    /// What few joints have.
    pub(crate) fn extras(&self) -> &JointExtras {
        self.extras.as_deref().unwrap_or(&PLAIN)
    }

    /// The same, to be changed.
    pub(super) fn change_extras(&mut self, change: impl FnOnce(&mut JointExtras)) {
        let mut extras = self.extras().clone();
        change(&mut extras);
        self.extras = (!extras.is_plain()).then(|| Box::new(extras));
    }

    /// Its clearance link, where that is its model.
    pub fn clearance(&self) -> Option<ClearanceLink> {
        self.extras().clearance
    }
}

impl JointExtras {
    /// Whether there is nothing of them.
    fn is_plain(&self) -> bool {
        let JointExtras {
            role,
            torque,
            points,
            clearance,
            contact,
            cam,
            stops,
            drawn,
            clasp,
            edges,
            bearing,
            friction,
            belt,
            bushing,
            beam,
        } = self;
        let is_pin = *role == JointRole::Revolute && !torque && points.is_none();
        let holds = clearance.is_none() && contact.is_none() && clasp.is_none() && stops.is_none();
        let shapes = cam.is_none() && drawn.is_none() && edges.is_empty() && bearing.is_none();
        is_pin
            && holds
            && shapes
            && friction.is_none()
            && belt.is_none()
            && bushing.is_none()
            && beam.is_none()
    }
}
