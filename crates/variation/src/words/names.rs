//! Points and columns of a model by name.

use super::super::geometry::PointId;
use super::super::output::{Output, Place};
use linkdyn_engine::element::{BodyId, Marker};
use linkdyn_engine::system::System;
use linkdyn_linear::math::Vec2;
use linkdyn_model::{GROUND, Model};
use std::collections::HashMap;

/// Bodies and points of a model by name, with their numbers.
pub(super) struct Names<'a> {
    pub(super) bodies: HashMap<&'a str, BodyId>,
    pub(super) points: HashMap<(&'a str, &'a str), (PointId, Marker)>,
}

impl<'a> Names<'a> {
    /// Those of a model; markers are measured from the centre of mass, as everywhere.
    pub fn new(model: &'a Model) -> Self {
        let mut bodies = HashMap::from([(GROUND, BodyId::GROUND)]);
        let mut points = HashMap::new();
        for name in model.bodies.keys().filter(|name| *name != GROUND) {
            bodies.insert(name.as_str(), BodyId::moving(bodies.len() - 1));
        }
        for (name, body) in &model.bodies {
            let com = body.com.filter(|_| name != GROUND).unwrap_or_default();
            for (point, place) in &body.points {
                let marker = Marker {
                    body: bodies[name.as_str()],
                    s: Vec2::from(*place) - Vec2::from(com),
                };
                points.insert(
                    (name.as_str(), point.as_str()),
                    (PointId(points.len()), marker),
                );
            }
        }
        Names { bodies, points }
    }

    fn place(&self, body: &str, point: &str) -> Option<Place> {
        let (point, marker) = self.points.get(&(body, point))?;
        Some(Place {
            marker: *marker,
            point: Some(*point),
        })
    }

    /// A point's coordinate along a direction.
    pub fn along(&self, body: &str, point: &str, direction: Vec2) -> Option<Output> {
        Some(Output::Coordinate(self.place(body, point)?, direction))
    }

    /// The output that a column's name stands for; `None` if no position has it.
    pub fn column(&self, system: &System, name: &str) -> Option<Output> {
        let (owner, quantity) = name.rsplit_once('.')?;
        let along = match quantity {
            "x" => Vec2::new(1.0, 0.0),
            "y" => Vec2::new(0.0, 1.0),
            "angle" => {
                return self
                    .bodies
                    .get(owner)
                    .filter(|_| owner != GROUND)
                    .map(|&body| Output::Angle(body));
            }
            _ => return None,
        };
        let place = match owner.split_once('.') {
            Some((body, point)) => self.place(body, point)?,
            None => {
                let body = *self.bodies.get(owner).filter(|_| owner != GROUND)?;
                Place {
                    marker: Marker {
                        body,
                        s: system.bodies[body.index()?].origin,
                    },
                    point: None,
                }
            }
        };
        Some(Output::Coordinate(place, along))
    }

    /// The distance of two points.
    pub fn distance(&self, [from, to]: [(&str, &str); 2]) -> Option<Output> {
        Some(Output::Distance(
            self.place(from.0, from.1)?,
            self.place(to.0, to.1)?,
        ))
    }

    /// The number of a point.
    pub fn point(&self, body: &str, point: &str) -> Option<PointId> {
        self.points.get(&(body, point)).map(|(id, _)| *id)
    }
}
