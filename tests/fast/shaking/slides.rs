//! Shaking forces of driven slides: the balance of momentum of one body.

use crate::mechanisms::{column, loaded, model, outcome};
use linkdyn_engine::analysis::derived::derived;
use serde_json::json;

/// A driven carriage on a sloping rail beside the origin: F = m (g − a), M = r × F about the origin, whichever of the two is named
/// first, and wherever its centre of mass is.
#[test]
fn a_driven_slide_shakes_the_ground_at_its_own_place() {
    const MASS: f64 = 3.0;
    const CENTRE: [f64; 2] = [0.05, 0.04];
    let (slope, turned) = (0.6_f64, 0.9_f64);
    let (speed, pace) = (0.7, -0.4);
    for reversed in [false, true] {
        // The axis stands in the first body.
        let (between, axis, angle) = if reversed {
            (["carriage.P", "ground.G"], slope - turned, turned)
        } else {
            (["ground.G", "carriage.P"], slope, 0.0)
        };
        let bodies = json!({
            "ground": { "points": { "G": [0.8, -0.3] } },
            "carriage": { "mass": MASS, "inertia": 0.02, "com": CENTRE, "points": { "P": [-0.02, 0.01] },
                          "pose": { "position": [0.8, -0.3], "angle": angle } },
        });
        let joints = json!({ "rail": { "type": "prismatic", "between": between, "axis": [axis.cos(), axis.sin()],
                                       "angle": if reversed { -angle } else { 0.0 } } });
        let motor = json!({ "type": "translation", "joint": "rail",
            "motion": { "type": "polynomial", "coefficients": [0.1, speed, 0.5 * pace] } });
        let json = model(bodies, joints, json!({ "motor": motor }));
        let run = outcome(&json);
        let (derived, _) = derived(&loaded(&json).model, run.all());
        let of = |name: &str| derived.values(name).unwrap_or_else(|| panic!("no {name}"));
        let shaking = ["fx", "fy", "moment"].map(|word| of(&format!("shaking.{word}")));
        let [x, y] = ["x", "y"].map(|axis| column(&run, &format!("carriage.{axis}")));
        let (sin, cos) = angle.sin_cos();
        let arm = [
            cos * CENTRE[0] - sin * CENTRE[1],
            sin * CENTRE[0] + cos * CENTRE[1],
        ];
        let along = if reversed { -pace } else { pace };
        let force = [
            -MASS * along * slope.cos(),
            MASS * (-9.81 - along * slope.sin()),
        ];
        for row in 0..x.len() {
            let [rx, ry] = [x[row] + arm[0], y[row] + arm[1]];
            let known = [force[0], force[1], rx * force[1] - ry * force[0]];
            for (ours, known) in shaking.iter().zip(known) {
                let off = (ours[row] - known).abs();
                assert!(
                    off < 1e-12 * 40.0,
                    "row {row}, reversed {reversed}: {} instead of {known}",
                    ours[row]
                );
            }
        }
        // It goes along the rail.
        let gone = (x[100] - x[0]).hypot(y[100] - y[0]);
        assert!((gone - (speed + 0.5 * pace)).abs() < 1e-13, "{gone}");
    }
}
