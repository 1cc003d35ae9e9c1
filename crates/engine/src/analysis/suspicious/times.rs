//! Tables of another time than the run.

use super::bodies::DIGITS;
use linkdyn_model::error::Complaint;
use linkdyn_model::{Model, Motion, Value};

/// A run that sees less of a table than this part is rarely meant; crank degrees, milliseconds and minutes taken for seconds
/// are beyond it [–].
const LEAST_PART: f64 = 1.0 / 50.0;

/// Tables of which the run, from 0 to `end` \[s\], sees only the beginning.
pub(in crate::analysis) fn tables(model: &Model, end: f64) -> Vec<Complaint> {
    let mut found = Vec::new();
    let mut look = |path: String, motion: &Motion| {
        let Motion::Table { points, .. } = motion else {
            return;
        };
        let last = points.last().map_or(0.0, |point| point[0]);
        if end > 0.0 && end < LEAST_PART * last {
            let [last, end] = [last, end].map(|time| model.display.time_to(time, DIGITS));
            let message = format!(
                "the table ends at t = {last}, the run at t = {end}: only its beginning is used"
            );
            let hint = "check the unit of its times: they are in s unless \"units\" names another \"time\", never in crank angle";
            found.push(Complaint::new(format!("{path}.points"), message).hint(hint));
        }
    };
    for (name, driver) in &model.drivers {
        look(format!("drivers.{name}.motion"), &driver.motion);
    }
    for (name, force) in &model.forces {
        for (key, value, _) in force.kind.values() {
            if let Value::Motion(motion) = value {
                look(format!("forces.{name}.{key}"), motion);
            }
        }
    }
    found
}
