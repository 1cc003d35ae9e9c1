//! Racks and pinions against closed forms.

use crate::mechanisms::*;
use linkdyn_output::Status;
use serde_json::{Value, json};

/// Round-off of some ten equations in numbers around 1, and of forces of some 10 N.
const ROUND_OFF: f64 = 1e-13;
const FORCE: f64 = 1e-11;
/// Mass and inertia of each wheel and rack [kg, kg·m²].
const MASS: f64 = 2.0;
const INERTIA: f64 = 0.03;

fn body(position: [f64; 2], angle: f64) -> Value {
    json!({ "mass": MASS, "inertia": INERTIA, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0] },
            "pose": { "position": position, "angle": angle } })
}

fn rack(first: &str, second: &str, axis: [f64; 2], radius: f64) -> Value {
    json!({ "type": "rack", "between": [first, second], "axis": axis, "radius": radius })
}

fn slide(first: &str, second: &str, axis: [f64; 2]) -> Value {
    json!({ "type": "prismatic", "between": [first, second], "axis": axis })
}

/// A wheel on a shaft of the ground at the height r over a rack that slides along (0.8, 0.6): the rack is drawn turned by 0.3 rad,
/// so that its own axis is not that of its guide.
fn driven(radius: f64, alpha: f64, load: f64) -> Value {
    let (axis, drawn) = ([0.8, 0.6], 0.3_f64);
    let centre = [-0.6 * radius, 0.8 * radius];
    let own = [
        axis[0] * drawn.cos() + axis[1] * drawn.sin(),
        axis[1] * drawn.cos() - axis[0] * drawn.sin(),
    ];
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0], "S": centre } },
        "wheel": body(centre, 0.7), "rack": body([0.16, 0.12], drawn) });
    let mut guide = slide("ground.O", "rack.C", axis);
    guide["angle"] = json!(drawn);
    let joints = json!({ "shaft": pin("ground.S", "wheel.C"), "guide": guide,
        "mesh": rack("wheel.C", "rack.C", own, radius) });
    let motor = json!({ "type": "rotation", "body": "wheel",
        "motion": { "type": "polynomial", "coefficients": [0.7, 1.0, 0.5 * alpha] } });
    let mut pair = model(bodies, joints, json!({ "motor": motor }));
    pair["gravity"] = json!([0.0, 0.0]);
    pair["forces"] = json!({ "load": { "type": "force", "at": "rack.C", "vector": [-0.8 * load, -0.6 * load] } });
    pair
}

/// s = 0.2 + r (θ − θ₀); λ = m r α + load along the axis, in the pitch point: nothing about the rack's point, −λ r about the
/// wheel's centre; whichever side of the rack the wheel is on.
#[test]
fn a_rack_goes_as_its_wheel_rolls_and_both_feel_one_force_in_the_pitch_point() {
    let (alpha, load) = (3.0, 7.0);
    for radius in [0.05, -0.05] {
        let run = outcome(&driven(radius, alpha, load));
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        assert!(run.report.warnings.is_empty(), "{:?}", run.report.warnings);
        let mobility = &run.report.mobility;
        assert_eq!((mobility.grubler, mobility.rank), (1, 1));
        let of = |name: &str| column(&run, name);
        let force = MASS * radius * alpha + load;
        for (k, theta) in of("wheel.angle").into_iter().enumerate() {
            let slide = 0.2 + radius * (theta - 0.7);
            close(of("rack.x")[k], 0.8 * slide, ROUND_OFF);
            close(of("rack.y")[k], 0.6 * slide, ROUND_OFF);
            for (name, known) in [
                ("joint.mesh.fx", 0.8 * force),
                ("joint.mesh.fy", 0.6 * force),
                ("joint.mesh.torque", 0.0),
                ("joint.shaft.fx", 0.8 * force),
                ("joint.shaft.fy", 0.6 * force),
                ("joint.guide.fx", 0.0),
                ("joint.guide.fy", 0.0),
                ("joint.guide.torque", 0.0),
                ("driver.motor.effort", INERTIA * alpha + radius * force),
            ] {
                close(of(name)[k], known, FORCE);
            }
        }
    }
}

/// A wheel on a carriage between a rack that stands and one that slides: that one goes twice as far as the carriage, the teeth
/// of both racks carry the load, which the wheel exerts on either, and the carriage's pin twice the load.
#[test]
fn a_wheel_between_two_racks_doubles_the_stroke() {
    let (radius, load) = (0.04, 12.0);
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0], "G": [0.0, 0.0], "T": [0.0, 2.0 * radius] } },
        "carriage": body([0.1, radius], 0.0), "wheel": body([0.1, radius], 0.2), "top": body([0.3, 2.0 * radius], 0.0) });
    let mut guide = slide("ground.O", "carriage.C", [1.0, 0.0]);
    guide["between"][0] = json!("ground.H");
    let mut bodies = bodies;
    bodies["ground"]["points"]["H"] = json!([0.0, radius]);
    let joints = json!({ "way": guide, "shaft": pin("carriage.C", "wheel.C"), "guide": slide("ground.T", "top.C", [1.0, 0.0]),
        "below": rack("wheel.C", "ground.G", [1.0, 0.0], radius), "above": rack("wheel.C", "top.C", [1.0, 0.0], -radius) });
    let push = json!({ "type": "translation", "joint": "way", "motion": { "type": "polynomial", "coefficients": [0.1, 0.4] } });
    let mut train = model(bodies, joints, json!({ "push": push }));
    train["gravity"] = json!([0.0, 0.0]);
    train["forces"] = json!({ "load": { "type": "force", "at": "top.C", "vector": [-load, 0.0] } });
    let run = outcome(&train);
    assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
    let of = |name: &str| column(&run, name);
    for (k, x) in of("carriage.x").into_iter().enumerate() {
        close(of("top.x")[k], 0.3 + 2.0 * (x - 0.1), ROUND_OFF);
        close(of("wheel.angle")[k], 0.2 - (x - 0.1) / radius, 1e-11);
        close(of("joint.above.fx")[k], load, FORCE);
        close(of("joint.below.fx")[k], load, FORCE);
        close(of("joint.shaft.fx")[k], 2.0 * load, FORCE);
        close(of("driver.push.effort")[k], 2.0 * load, FORCE);
    }
}

/// Down a slope a wheel rolls with g sin β/(1 + I/(m r²)), and nothing is lost.
#[test]
fn a_wheel_rolls_down_a_slope() {
    let (radius, g) = (0.1, 9.81);
    let along = [0.8, -0.6];
    let bodies = json!({ "ground": { "points": { "G": [0.0, 0.0], "H": [0.6 * radius, 0.8 * radius] } },
        "wheel": body([0.6 * radius, 0.8 * radius], 0.4) });
    let joints = json!({ "way": { "type": "slot", "between": ["ground.H", "wheel.C"], "axis": along },
        "mesh": rack("wheel.C", "ground.G", along, radius) });
    let mut slope = model(bodies, joints, json!({}));
    slope["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 21 });
    let run = outcome(&slope);
    assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
    let of = |name: &str| column(&run, name);
    let acceleration = 0.6 * g / (1.0 + INERTIA / (MASS * radius * radius));
    let energy = |k: usize| of("energy.kinetic")[k] + of("energy.potential")[k];
    for (k, t) in of("time").into_iter().enumerate() {
        let way = 0.5 * acceleration * t * t;
        close(of("wheel.x")[k], 0.06 + 0.8 * way, 1e-11);
        close(of("wheel.angle")[k], 0.4 - way / radius, 1e-10);
        close(energy(k), energy(0), 1e-11);
        // What the wheel exerts on the rack: I α/r along the slope.
        let tooth = INERTIA * acceleration / (radius * radius);
        close(of("joint.mesh.fx")[k], 0.8 * tooth, FORCE);
        close(of("joint.mesh.fy")[k], -0.6 * tooth, FORCE);
    }
}

/// With `offset` the drawing does not matter: a·(C − R) + r (θ₁ − θ₂) is that number.
#[test]
fn a_rack_meshes_as_told() {
    let radius = 0.05;
    let mut told = driven(radius, 3.0, 7.0);
    told["joints"]["mesh"]["offset"] = json!(-0.5);
    let run = outcome(&told);
    let (theta, x) = (column(&run, "wheel.angle"), column(&run, "rack.x"));
    for (theta, x) in theta.into_iter().zip(x) {
        close(-x / 0.8 + radius * (theta - 0.3), -0.5, ROUND_OFF);
    }
}

/// A wheel that is not where its teeth would meet is told, with the mend.
#[test]
fn a_wheel_beside_its_pitch_line_is_told() {
    let mut wrong = driven(0.05, 3.0, 7.0);
    wrong["joints"]["mesh"]["radius"] = json!(-0.05);
    assert_eq!(
        outcome(&wrong).report.warnings,
        [
            "joint \"mesh\": the wheel's centre is 0.05 m from the line through the rack's point, and rolls at -0.05 m from it; \
              the line lies on its other side: write \"radius\": \"0.05 m\""
        ]
    );
    wrong["joints"]["mesh"]["radius"] = json!(0.06);
    assert_eq!(
        outcome(&wrong).report.warnings,
        [
            "joint \"mesh\": the wheel's centre is 0.05 m from the line through the rack's point, and rolls at 0.06 m from it; \
              move the wheel or the rack's point, or give this distance as \"radius\""
        ]
    );
}
