//! Lists and whole numbers of a file.

use crate::tree::Tree;

use super::{Driven, Walk, wrong_kind};
use crate::dimension::Dimension;
use crate::error::Complaint;
use crate::gate::length_fault;
use crate::node::{Kind, Node};
use crate::shape::{Bound, Measure, Shape};
use crate::words::{self, LENGTH};

/// Least and most entries of a list.
type Length = (usize, Option<usize>);

impl Walk<'_> {
    /// The entries of a list, where there are as many as should be.
    fn items<'n>(&mut self, node: &'n Node, length: Length, path: &str) -> Option<&'n [Node]> {
        let Kind::Array(items) = &node.kind else {
            self.complain(node, wrong_kind(path, "a list", node));
            return None;
        };
        let (least, most) = length;
        if items.len() < least || most.is_some_and(|most| items.len() > most) {
            let message = length_fault(items.len(), least, most == Some(least));
            self.complain(node, Complaint::new(path, message));
            return None;
        }
        Some(items)
    }

    pub(super) fn list(
        &mut self,
        node: &Node,
        of: &Shape,
        length: Length,
        path: &str,
        driven: Driven,
    ) -> Option<Tree> {
        let items = self.items(node, length, path)?;
        let values = items.iter().enumerate().map(|(index, item)| {
            let driven = entry_driven(of, driven, index);
            self.value(item, of, &format!("{path}[{index}]"), driven)
        });
        Some(values.collect())
    }

    /// A number, or its least and its greatest value.
    pub(super) fn range(
        &mut self,
        node: &Node,
        of: &Shape,
        path: &str,
        driven: Driven,
    ) -> Option<Tree> {
        match node.kind {
            Kind::Array(_) => self.list(node, of, (2, Some(2)), path, driven),
            _ => self.read(node, of, path, driven),
        }
    }

    /// Two coordinates, or these with a tolerance.
    pub(super) fn place(&mut self, node: &Node, path: &str, driven: Driven) -> Option<Tree> {
        match node.kind {
            Kind::Object(_) => self.object(node, words::object("Place"), None, path, driven),
            _ => self.list(node, &LENGTH, (2, Some(2)), path, driven),
        }
    }

    /// Points (t, value).
    pub(super) fn table(&mut self, node: &Node, path: &str, driven: Driven) -> Option<Tree> {
        let points = self.items(node, (2, None), path)?;
        let points = points.iter().enumerate().map(|(index, point)| {
            let here = format!("{path}[{index}]");
            let Some(pair) = self.items(point, (2, Some(2)), &here) else {
                return self.hole(&Shape::Pair(&Shape::Number(Bound::Any)), &here);
            };
            let columns = pair.iter().zip(COLUMNS.iter()).enumerate();
            let values = columns.map(|(index, (item, shape))| {
                self.value(item, shape, &format!("{here}[{index}]"), driven)
            });
            values.collect()
        });
        Some(points.collect())
    }

    /// A whole number within a bound.
    pub(super) fn whole(&mut self, node: &Node, bound: Bound, path: &str) -> Option<u64> {
        let number = self.plain_number(node, path)?;
        if number.fract() != 0.0 {
            self.complain(node, Complaint::new(path, "a whole number is expected"));
            return None;
        }
        if let Some(fault) = bound.fault(number) {
            self.complain(node, Complaint::new(path, fault));
            return None;
        }
        // bounds keep it far below 2⁵³
        Some(number as u64)
    }
}

/// What stands in a table's points.
pub static COLUMNS: [Shape; 2] = [
    Shape::Quantity(Measure::Of(Dimension::Time), Bound::Any),
    Shape::Quantity(Measure::Driven(0), Bound::Any),
];

/// What is driven at a place of a list: of coefficients the derivative of that order.
pub fn entry_driven(of: &Shape, driven: Driven, index: usize) -> Driven {
    match of {
        Shape::Quantity(Measure::DrivenCoefficient, _) => driven.derivative(index),
        _ => driven,
    }
}
