//! Transmission to a slide, whichever body its joint names first.

use super::*;
use crate::mechanisms;

/// A slider-crank on a sloping guide beside the origin, drawn with a slide that leans. Where the joint names the slide first, its
/// axis is the slide's own, and it counts the way from the slide to the guide, so that it falls as the slide goes on.
#[test]
fn transmission_to_a_slide_does_not_depend_on_how_it_is_drawn() {
    let (r, l, slope, leans) = (0.1_f64, 0.35_f64, 0.5_f64, 0.8_f64);
    let turn = |[x, y]: [f64; 2], by: f64| {
        let (sin, cos) = by.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    };
    for reversed in [false, true] {
        let start = 0.7_f64;
        let along = mechanisms::slider_position(r, l, start);
        let angle = if reversed { leans } else { 0.0 };
        // The pin is off the slide's frame and centre.
        let own = [0.04, -0.03];
        let pin = turn([along, 0.0], slope);
        let arm = turn(own, angle);
        let rod_angle = slope + (-r * start.sin()).atan2(along - r * start.cos());
        let bodies = json!({
            "ground": { "points": { "O": [0.0, 0.0] } },
            "crank": mechanisms::rod(r, [0.0, 0.0], slope + start),
            "rod": mechanisms::rod(l, turn([r * start.cos(), r * start.sin()], slope), rod_angle),
            "slide": { "mass": 1.0, "inertia": 0.01, "com": [-0.1, 0.2], "points": { "B": own },
                       "pose": { "position": [pin[0] - arm[0], pin[1] - arm[1]], "angle": angle } },
        });
        let axis = slope - angle;
        let mut guide = json!({ "type": "prismatic", "between": ["ground.O", "slide.B"], "axis": [axis.cos(), axis.sin()] });
        if reversed {
            guide["between"] = json!(["slide.B", "ground.O"]);
            guide["angle"] = json!(-angle);
        }
        let joints = json!({ "o": mechanisms::pin("ground.O", "crank.A"), "a": mechanisms::pin("crank.B", "rod.A"),
            "b": mechanisms::pin("rod.B", "slide.B"), "g": guide });
        let motor = json!({ "type": "rotation", "body": "crank",
            "motion": { "type": "constant_velocity", "start": slope + start, "velocity": 2.0 } });
        let mut json = mechanisms::model(bodies, joints, json!({ "motor": motor }));
        json["analysis"]["transmission"] = json!({ "driver": "motor", "output": "slide" });
        let model = models::load(&json);
        let (found, _) = transmitted(&model);
        let [ratio, advantage, mu] = ["ratio", "advantage", "b.angle"]
            .map(|name| column(&found, &format!("transmission.{name}")));
        let cranks = models::values(&models::solve(&model), "crank.angle");
        for (row, crank) in cranks.iter().enumerate() {
            let (sin, cos) = (crank - slope).sin_cos();
            let root = (l * l - (r * sin).powi(2)).sqrt();
            let by_angle = -r * sin - r * r * sin * cos / root;
            let known = if reversed { -by_angle } else { by_angle };
            assert!(
                (ratio[row] - known).abs() < 1e-12,
                "row {row}, reversed {reversed}: {} instead of {known}",
                ratio[row]
            );
            assert!((advantage[row] * known - 1.0).abs() < 1e-9);
            let between = (root / l).asin();
            assert!((mu[row] - between).abs() < 1e-7, "{} {between}", mu[row]);
        }
    }
}
