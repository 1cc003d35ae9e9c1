//! Stops for checks by differences.

use super::*;
use crate::element::tests::{Named, marker};

/// One of each kind, and a lock of a slide.
pub(in crate::element) fn each() -> [Named; 4] {
    let axis = Vec2::new(0.6, 0.8);
    let lock = Stop {
        kept: Some(HeldStop {
            id: ContactId(0),
            is_lock: true,
        }),
        ..stop(Travel::Along(axis))
    };
    [
        ("lock of a slide", Box::new(lock)),
        ("stop of a slide", Box::new(stop(Travel::Along(axis)))),
        ("stop of an angle", Box::new(stop(Travel::Turn))),
        ("stop of a length", Box::new(stop(Travel::Apart))),
    ]
}

/// A stop for checks by differences.
pub(in crate::element) fn stop(way: Travel) -> Stop {
    Stop {
        first: marker(1, 0.3, -0.2),
        second: marker(2, -0.4, 0.1),
        way,
        side: Side::Lower,
        limit: 0.4,
        arm: if way == Travel::Turn { 0.7 } else { 1.0 },
        size: 0.7,
        kept: None,
    }
}
