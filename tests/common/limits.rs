//! Ends of joints' ways, told otherwise.

use linkdyn_model::{Latch, OneWay, Stops};

/// Limits of an angle that is counted otherwise.
pub fn turn_limits(stops: &mut Stops, turned: impl Fn(f64) -> f64) {
    for limit in stops.limits.iter_mut().flatten().flatten() {
        *limit = turned(*limit);
    }
}

/// Limits of an angle that is counted the other way round.
pub fn flip_limits(stops: &mut Stops) {
    turn_limits(stops, |limit| -limit);
    if let Some(limits) = &mut stops.limits {
        limits.reverse();
    }
    stops.one_way = stops.one_way.map(|way| match way {
        OneWay::Forward => OneWay::Backward,
        OneWay::Backward => OneWay::Forward,
    });
    stops.latch = stops.latch.map(|latch| match latch {
        Latch::Lower => Latch::Upper,
        Latch::Upper => Latch::Lower,
        Latch::Both => Latch::Both,
    });
}
