//! The path of a driven mechanism over a range.

use crate::analysis::control::Control;
use crate::element::Measure;
use crate::mechanism::continuation::{HALF_TURN, Parameter, Path, follow};
use crate::mechanism::driven::{Driven, Failure};
use crate::system::Inputs;

/// The path over `range`: of a crank that goes round more than once and comes back, one turn stands for all.
pub fn path(
    driven: &mut Driven,
    start: (f64, &[f64]),
    range: (f64, f64),
    control: &Control,
) -> Result<Path, Failure> {
    let system = driven.system;
    let parameter = Parameter::of(system);
    let half_way = |s: f64, (low, high): (f64, f64)| {
        // up first, then down
        let covered = if s >= start.0 { s - start.0 } else { high - s };
        control.progress.note(0.5 * covered, high - low);
        control.stop().is_some()
    };
    let turns = parameter == Parameter::DriverValue && system.drivers[0].measure == Measure::Angle;
    if turns && range.1 - range.0 > 4.0 * HALF_TURN {
        let around = (start.0 - HALF_TURN, start.0 + HALF_TURN);
        let mut path = follow(
            driven,
            (parameter, Inputs::still(system)),
            start,
            around,
            &|s| half_way(s, around),
        )?;
        if path.close_turn(system, start.0) {
            return Ok(path);
        }
    }
    follow(
        driven,
        (parameter, Inputs::still(system)),
        start,
        range,
        &|s| half_way(s, range),
    )
}
