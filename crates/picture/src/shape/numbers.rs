//! Bodies and points by numbers.

use std::collections::HashMap;

use linkdyn_model::{GROUND, Model, PointRef};

/// A body and the number of one of its points.
pub type PointId = (usize, usize);

/// Numbers of bodies, ground first, and of their points.
pub struct Numbers<'m> {
    pub model: &'m Model,
    bodies: HashMap<&'m str, usize>,
}

impl<'m> Numbers<'m> {
    pub fn new(model: &'m Model) -> Self {
        Numbers {
            model,
            bodies: names(model).zip(0..).collect(),
        }
    }

    pub fn body(&self, name: &str) -> usize {
        self.bodies.get(name).copied().unwrap_or(0)
    }

    pub fn point(&self, point: &PointRef) -> PointId {
        let body = self.model.bodies.get(&point.body);
        let number = body.and_then(|body| body.points.get_index_of(&point.point));
        (self.body(&point.body), number.unwrap_or(0))
    }

    pub fn place(&self, point: &PointRef) -> [f64; 2] {
        let body = self.model.bodies.get(&point.body);
        let place = body.and_then(|body| body.points.get(&point.point));
        place.copied().unwrap_or_default()
    }

    pub fn ends(&self, ends: &[PointRef; 2]) -> [PointId; 2] {
        ends.each_ref().map(|end| self.point(end))
    }
}

/// Names of the bodies, ground first.
pub fn names(model: &Model) -> impl Iterator<Item = &str> {
    let moving = model.bodies.keys().map(String::as_str);
    [GROUND]
        .into_iter()
        .chain(moving.filter(|name| *name != GROUND))
}
