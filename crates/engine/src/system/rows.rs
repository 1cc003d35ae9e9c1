//! Which rows are in force: systems that differ from a compiled one in that alone.
//!
//! A model is compiled once, with every row that may come into force:
//!
//! ```text
//! contact in flight       no row; impacts, or the force of the overlap (of journals and stops)
//! contact that slides     δ = 0, and friction by its multiplier                       rigid surfaces only
//! contact that sticks     the same, and no sliding                                    the same
//! contact closed          P₁ − P₂ = 0                                                 where a motion starts from
//! joints of a part        by themselves, as a system of the part's bodies alone
//! ```
//!
//! From these a mask picks. The constraints themselves are shared, none is made anew.

use super::{Block, DependentForce, JointId, Mass, Origin, System};
use crate::element::pair::{ContactId, Hold, Pair};
use crate::element::{BodyId, Constraint, ConstraintDependentForce, Layout};
use linkdyn_linear::math::Vec2;
use std::collections::BTreeMap;
use std::sync::Arc;

/// What a contact belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// A joint.
    Joint(JointId),
    /// A spring or an actuator, by its number among the model's forces.
    Force(usize),
}

/// Rows that may stand for a contact.
#[derive(Clone)]
pub struct ContactRows {
    /// What it belongs to.
    pub(crate) owner: Owner,
    /// Index into [`System::blocks`]; none of a piece of an outline, whose block is there only while it is held: an outline may have
    /// thousands.
    pub(crate) block: Option<usize>,
    /// Those of an ideal pin, in the place of a journal in its bearing.
    pub(crate) closed: Option<Arc<dyn Constraint>>,
    /// That of rigid surfaces which stay together.
    pub(crate) sustained: Arc<dyn Constraint>,
    /// Those of surfaces that do not slide, either.
    pub(crate) stuck: Arc<dyn Constraint>,
    /// Friction while they slide, where there is some.
    pub(crate) friction: Option<Arc<dyn ConstraintDependentForce>>,
}

/// How far a body reaches in its own frame, and where that is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Extent {
    /// Largest distance of two of its points \[m\].
    pub(crate) spread: f64,
    /// Largest coordinate of a point \[m\].
    pub(crate) reach: f64,
    /// Where the frame is drawn \[m\], of what has no spread; none of a ground that the model does not name.
    pub(crate) origin: Option<Box<Vec2>>,
}

/// Largest distance across points \[m\].
pub(super) fn spread(points: &[Vec2]) -> f64 {
    let low = points
        .iter()
        .fold(Vec2::repeat(f64::INFINITY), |m, p| m.inf(p));
    let high = points
        .iter()
        .fold(Vec2::repeat(f64::NEG_INFINITY), |m, p| m.sup(p));
    if points.is_empty() {
        0.0
    } else {
        (high - low).norm()
    }
}

/// Characteristic length of some bodies \[m\]: the largest distance between two points of one of them; where there is none
/// (all points at their origins), the spread of the drawing, and 1 m at last.
pub(super) fn size(extents: &[Extent]) -> f64 {
    let largest = extents.iter().map(|extent| extent.spread);
    let origins = extents.iter().filter_map(|extent| extent.origin.as_deref());
    let origins: Vec<Vec2> = origins.copied().collect();
    [largest.fold(0.0, f64::max), spread(&origins), 1.0]
        .into_iter()
        .find(|&length| length > 0.0)
        .unwrap_or(1.0)
}

/// Largest coordinate of a point in the frame of its body \[m\].
pub(super) fn reach(extents: &[Extent]) -> f64 {
    extents
        .iter()
        .fold(0.0, |most: f64, extent| most.max(extent.reach))
}

impl ContactRows {
    /// Of a contact, where no rows stand for it otherwise.
    pub(super) fn of(pair: &Pair, id: ContactId, owner: Owner, block: Option<usize>) -> Self {
        ContactRows {
            owner,
            block,
            closed: None,
            sustained: pair.sustained(),
            stuck: pair.stuck(id),
            friction: pair.sliding(id),
        }
    }
}

impl System {
    /// The system in which contacts are held so (by contact), with their friction behind that of the joints, and with other
    /// constraints in the place of those of some blocks.
    pub(crate) fn with_rows(
        &self,
        holds: &[Hold],
        exchanged: Vec<(usize, Arc<dyn Constraint>)>,
    ) -> System {
        let mut system = self.clone();
        let mut constraints = exchanged;
        let mut added = Vec::new();
        for (contact, (rows, hold)) in self.contact_rows.iter().zip(holds).enumerate() {
            let constraint = match hold {
                Hold::Free => continue,
                Hold::Slides => rows.sustained.clone(),
                Hold::Sticks => rows.stuck.clone(),
            };
            let block = rows.block.unwrap_or(self.blocks.len() + added.len());
            if let (Hold::Slides, Some(force)) = (hold, &rows.friction) {
                let force = force.clone();
                system
                    .dependent_forces
                    .push(DependentForce { force, block });
            }
            match rows.block {
                Some(block) => constraints.push((block, constraint)),
                None => added.push((constraint, Origin::Stop(ContactId(contact)))),
            }
        }
        system.exchange(constraints);
        for (constraint, origin) in added {
            system.push_block(constraint, origin);
        }
        system
    }

    /// The block of a contact that is held.
    pub(crate) fn held_block(&self, contact: usize) -> Option<&Block> {
        let own = self.contact_rows[contact].block;
        match own {
            Some(block) => self.blocks.get(block),
            None => {
                let mut last = self.blocks.iter().rev();
                last.find(|block| block.origin == Origin::Stop(ContactId(contact)))
            }
        }
    }

    /// The system in which all contacts are ideal pins.
    pub(crate) fn closed(&self) -> System {
        let mut system = self.clone();
        let pins = self.contact_rows.iter();
        let pins = pins.filter_map(|rows| Some((rows.block?, rows.closed.clone()?)));
        system.exchange(pins.collect());
        system.contacts = Arc::default();
        system.contact_rows = Arc::default();
        system.enclosures.clear();
        system.timed.clear();
        for joint in &mut system.joints {
            joint.change_extras(|extras| {
                extras.contact = None;
                extras.clasp = None;
                extras.stops = None;
                extras.edges = 0..0;
            });
        }
        system
    }

    /// The system of some moving bodies and joints alone, which hold nothing else: no drivers, forces or initial values; `from`,
    /// which may move in the whole, is its ground. `None` if a joint is more than geometry between two bodies.
    pub(crate) fn part(&self, from: BodyId, bodies: &[BodyId], joints: &[usize]) -> Option<System> {
        let id = |body: BodyId| {
            let index = bodies.iter().position(|own| *own == body);
            index.map_or(BodyId::GROUND, BodyId::moving)
        };
        let own = |body: &BodyId| self.extents[body.0].clone();
        let extents: Vec<Extent> = [own(&from)]
            .into_iter()
            .chain(bodies.iter().map(own))
            .collect();
        let mut mass = Mass::default();
        let mut guess = Vec::new();
        for columns in bodies.iter().filter_map(|body| self.layout.columns(*body)) {
            mass.push_block_of(&self.mass, columns);
            guess.extend_from_slice(&self.guess[columns.range()]);
        }
        let mut part = System {
            layout: Layout::rigid(bodies.len()),
            bodies: bodies
                .iter()
                .filter_map(|body| Some(self.bodies[body.index()?].clone()))
                .collect(),
            axes: Vec::new(),
            sections: BTreeMap::new(),
            joints: Vec::with_capacity(joints.len()),
            drivers: Vec::new(),
            points: Vec::new(),
            blocks: Vec::with_capacity(joints.len()),
            initial: Vec::new(),
            starts: Vec::new(),
            initial_rates: Vec::new(),
            branch: Vec::new(),
            forces: Vec::new(),
            force_data: Vec::new(),
            measured: Vec::new(),
            outputs: Vec::new(),
            formulas: Vec::new(),
            inputs: Vec::new(),
            states: Vec::new(),
            kinks: Vec::new(),
            dependent_forces: Vec::new(),
            contacts: Arc::default(),
            contact_rows: Arc::default(),
            enclosures: Vec::new(),
            timed: Vec::new(),
            broken: Vec::new(),
            gravity: self.gravity,
            mass,
            masses_known: self.masses_known,
            entries: Vec::new(),
            measures: Vec::new(),
            links: 0,
            guess,
            scale: self.scale,
            is_pushed: false,
            is_slow: self.is_slow,
            size: size(&extents),
            reach: reach(&extents),
            extents,
            display: self.display.clone(),
        };
        for (index, &joint) in joints.iter().enumerate() {
            let data = self.joints[joint].clone();
            let points = data.points().map(|point| point.of(&id));
            let mut data = data.moved(points);
            data.change_extras(|extras| extras.edges = 0..0);
            let constraint = self.blocks[joint].constraint.between(&id)?;
            part.joints.push(data);
            part.push_block(constraint, Origin::Joint(JointId(index)));
        }
        Some(part)
    }

    /// Puts other equations in the place of those of some blocks.
    fn exchange(&mut self, constraints: Vec<(usize, Arc<dyn Constraint>)>) {
        for (block, constraint) in constraints {
            self.blocks[block].constraint = constraint;
        }
        self.measures.clear();
        self.entries.clear();
        for Block {
            constraint, origin, ..
        } in std::mem::take(&mut self.blocks)
        {
            self.push_block(constraint, origin);
        }
    }
}
