//! A mechanism that is led from where it is drawn to where it starts.
//!
//! ```text
//! value(t) = c + f(t),   f = off (t/T − 1)        off = c − what is drawn
//! ```
//!
//! of each driver and initial value, and of coordinates that are free beside them. It is an ordinary driven mechanism.

use super::{DriverData, DriverId, DriverRole, Origin, System};
use crate::element::coordinate::Coordinate;
use crate::element::driven::DriveId;
use crate::element::{Axis, Measure};
use crate::motion::Law;
use std::sync::Arc;

impl System {
    /// The system with drivers that go straight from what is `off` at t = 0 to their values at t = `end`; behind those of the model
    /// one for each coordinate given with its own.
    pub(crate) fn led(&self, off: &[f64], coordinates: Vec<(Coordinate, f64)>, end: f64) -> System {
        let mut system = self.clone();
        let law = |value: f64, off: f64| Law::Polynomial(vec![value - off, off / end]);
        for (driver, off) in system.drivers.iter_mut().zip(off) {
            driver.law = law(driver.law.value(0.0), *off);
        }
        for (mut coordinate, off) in coordinates {
            let id = system.drivers.len();
            coordinate.drive = Some(DriveId(id));
            let Coordinate { origin, axis, .. } = coordinate;
            system.drivers.push(DriverData {
                name: String::new(),
                role: DriverRole::Coordinate { origin, axis },
                law: law(0.0, off),
                measure: match axis {
                    Axis::X | Axis::Y => Measure::Length,
                    Axis::Theta => Measure::Angle,
                },
                share: 1.0,
                is_steered: false,
            });
            system.push_block(Arc::new(coordinate), Origin::Driver(DriverId(id)));
        }
        system.initial.clear();
        system.starts.clear();
        system
    }
}
