//! Bodies that roll on each other, against closed forms.

use crate::mechanisms::*;
use linkdyn_output::Status;
use serde_json::{Value, json};

/// Mass and inertia of each body [kg, kg·m²].
const MASS: f64 = 2.0;
const INERTIA: f64 = 0.03;

fn body(position: [f64; 2], angle: f64) -> Value {
    json!({ "mass": MASS, "inertia": INERTIA, "com": [0.0, 0.0], "points": { "C": [0.0, 0.0], "P": [0.1, 0.0] },
            "pose": { "position": position, "angle": angle } })
}

fn rolling(first: &str, second: &str, radii: [f64; 2]) -> Value {
    json!({ "type": "rolling", "between": [first, second], "radii": radii })
}

/// A disc on the ground's one, drawn at the angle ψ₀, without gravity: (r₁ + r₂) ψ̇ = r₂ ω₂, through several turns, with the
/// force that accelerates its centre and the torque that the traction needs; on a disc, in a ring, and as a ring.
#[test]
fn a_disc_rolls_around_another_as_its_own_angle_says() {
    for radii in [[0.3, 0.1], [-0.3, 0.1], [0.1, -0.3]] {
        let ([_, r], distance, start) = (radii, radii[0] + radii[1], 0.7_f64);
        let (sin, cos) = start.sin_cos();
        let bodies = json!({ "ground": { "points": { "O": [0.2, -0.1] } },
            "disc": body([0.2 + distance * cos, -0.1 + distance * sin], 0.4) });
        let joints = json!({ "mesh": rolling("ground.O", "disc.C", radii) });
        let alpha = 5.0;
        let motor = json!({ "type": "rotation", "body": "disc",
            "motion": { "type": "polynomial", "coefficients": [0.4, 40.0, 0.5 * alpha] } });
        let mut pair = model(bodies, joints, json!({ "motor": motor }));
        pair["gravity"] = json!([0.0, 0.0]);
        let run = outcome(&pair);
        assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
        let mobility = &run.report.mobility;
        assert_eq!((mobility.grubler, mobility.rank), (1, 1));
        let of = |name: &str| column(&run, name);
        let (omega, torque) = (of("disc.omega"), of("joint.mesh.torque"));
        for (k, theta) in of("disc.angle").into_iter().enumerate() {
            let psi = start + r * (theta - 0.4) / distance;
            let (sin, cos) = psi.sin_cos();
            close(of("disc.x")[k], 0.2 + distance * cos, 1e-12);
            close(of("disc.y")[k], -0.1 + distance * sin, 1e-12);
            // The acceleration of the centre: inwards, and along the turn.
            let inwards = -(r * omega[k]).powi(2) / distance;
            let along = r * alpha;
            close(
                of("joint.mesh.fx")[k],
                MASS * (inwards * cos - along * sin),
                1e-9,
            );
            close(
                of("joint.mesh.fy")[k],
                MASS * (inwards * sin + along * cos),
                1e-9,
            );
            close(torque[k], -r * MASS * along, 1e-9);
            close(
                of("driver.motor.effort")[k],
                INERTIA * alpha - torque[k],
                1e-9,
            );
        }
        assert!(omega.len() > 2);
    }
}

/// A disc of half the ring's radius carries each point of its rim along a straight line (Tusi's couple).
#[test]
fn a_disc_of_half_the_size_of_its_ring_moves_its_rim_along_a_line() {
    let bodies =
        json!({ "ground": { "points": { "O": [0.0, 0.0] } }, "disc": body([0.1, 0.0], 0.0) });
    let joints = json!({ "ring": rolling("ground.O", "disc.C", [-0.2, 0.1]) });
    let motor = json!({ "type": "rotation", "body": "disc", "motion": { "type": "constant_velocity", "velocity": -20.0 } });
    let mut couple = model(bodies, joints, json!({ "motor": motor }));
    couple["points"] = json!(["disc.P"]);
    let run = outcome(&couple);
    for (x, (y, theta)) in column(&run, "disc.P.x").into_iter().zip(
        column(&run, "disc.P.y")
            .into_iter()
            .zip(column(&run, "disc.angle")),
    ) {
        close(y, 0.0, 1e-13);
        close(x, 0.2 * theta.cos(), 1e-13);
    }
}

/// In a ring a disc is a pendulum of the length (R − r)(1 + I/(m r²)): after the period by the arithmetic-geometric mean it is
/// where it was, at rest.
#[test]
fn a_disc_swings_in_a_ring_as_a_pendulum() {
    let (ring, r, g, start) = (0.5, 0.2, 9.81, 1.2_f64);
    let length = (ring - r) * (1.0 + INERTIA / (MASS * r * r));
    let [mut a, mut b] = [1.0, (0.5 * start).cos()];
    for _ in 0..8 {
        [a, b] = [0.5 * (a + b), (a * b).sqrt()];
    }
    let period = std::f64::consts::TAU * (length / g).sqrt() / a;
    let place = [(ring - r) * start.sin(), -(ring - r) * start.cos()];
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } }, "disc": body(place, 0.3) });
    let joints = json!({ "ring": rolling("ground.O", "disc.C", [-ring, r]) });
    let mut swing = model(bodies, joints, json!({}));
    swing["analysis"] = json!({ "type": "dynamics", "end": period, "outputs": 21,
        "solver": { "rtol": 1e-12, "atol": 1e-14 } });
    let run = outcome(&swing);
    assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
    let of = |name: &str| column(&run, name);
    let energy = |k: usize| of("energy.kinetic")[k] + of("energy.potential")[k];
    close(of("disc.x")[20], place[0], 1e-8);
    close(of("disc.angle")[20], 0.3, 1e-8);
    close(of("disc.x")[10], -place[0], 1e-7);
    close(of("disc.omega")[20], 0.0, 1e-7);
    for k in 0..21 {
        close(energy(k), energy(0), 1e-9);
    }
}

/// Two discs on pins: ω₂ = −r₁ ω₁/r₂, the distance held by pins and contact alike, which is said as a redundancy.
#[test]
fn discs_on_pins_turn_against_each_other() {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0], "Q": [0.4, 0.0] } },
        "small": body([0.0, 0.0], 0.2), "large": body([0.4, 0.0], 0.0) });
    let joints = json!({ "shaft": pin("ground.O", "small.C"), "axle": pin("ground.Q", "large.C"),
        "mesh": rolling("small.C", "large.C", [0.1, 0.3]) });
    let motor = json!({ "type": "rotation", "body": "small", "motion": { "type": "constant_velocity", "velocity": 30.0 } });
    let run = outcome(&model(bodies, joints, json!({ "motor": motor })));
    assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
    assert_eq!(
        (run.report.mobility.grubler, run.report.mobility.rank),
        (0, 1)
    );
    let turned = column(&run, "small.angle")
        .into_iter()
        .zip(column(&run, "large.angle"));
    for (small, large) in turned {
        close(large, -(small - 0.2) / 3.0, 1e-12);
    }
}

/// Sun, planet and ring without a carrier: sun and ring hold the planet's centre twice. With ψ of the line of centres,
/// r_s θ_s + r_p θ_p = (r_s + r_p) ψ and r_p θ_p = −(r_r − r_p) ψ. The path does not close after a turn of the sun, and starts
/// where the redundant row is that of x.
#[test]
fn a_planet_needs_no_carrier() {
    let [sun, planet, ring] = [0.04, 0.02, 0.08];
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "sun": body([0.0, 0.0], 0.0), "planet": body([sun + planet, 0.0], 0.0) });
    let joints = json!({ "shaft": pin("ground.O", "sun.C"), "inner": rolling("sun.C", "planet.C", [sun, planet]),
        "outer": rolling("ground.O", "planet.C", [-ring, planet]) });
    let motor = json!({ "type": "rotation", "body": "sun", "motion": { "type": "constant_velocity", "velocity": 20.0 } });
    let run = outcome(&model(bodies, joints, json!({ "motor": motor })));
    assert_eq!(run.report.status, Status::Completed, "{:?}", run.report);
    let of = |name: &str| column(&run, name);
    let angles = of("sun.angle").into_iter().zip(of("planet.angle"));
    for (k, (theta, turned)) in angles.enumerate() {
        let psi = theta * sun / (sun + ring);
        close(turned, -psi * (ring - planet) / planet, 1e-11);
        close(of("planet.x")[k], (sun + planet) * psi.cos(), 1e-13);
    }
}
