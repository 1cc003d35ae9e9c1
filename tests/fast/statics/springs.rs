//! Springs that balance weights.

use super::*;

#[test]
fn a_block_hangs_on_its_spring() {
    for kind in ["prismatic", "slot"] {
        let run = outcome(&hanging_block(kind, 0.0));
        close(value(&run, "block.y"), 1.0 - 0.3 - 2.0 * G / 150.0, 1e-14);
        // In the slot the block may turn, which nothing minds.
        assert_eq!(
            stability(&run),
            if kind == "slot" {
                "indifferent"
            } else {
                "stable"
            }
        );
    }
    let mode = &linearised(&hanging_block("prismatic", 0.0), false).modes[0];
    close(mode.frequency(), 75.0_f64.sqrt(), 1e-12);
    // s² + c/m s + k/m = 0
    let mode = &linearised(&hanging_block("prismatic", 8.0), false).modes[0];
    close(mode.eigenvalue[0], -2.0, 1e-12);
    close(mode.eigenvalue[1], 71.0_f64.sqrt(), 1e-12);
    close(
        mode.damping_ratio().expect("one"),
        2.0 / 75.0_f64.sqrt(),
        1e-13,
    );
    let slow = linearised(&hanging_block("slot", 8.0), false);
    assert_eq!(slow.modes[0].frequency(), 0.0, "{:?}", slow.modes);
    // Overdamped: two real rates.
    let creeping = linearised(&hanging_block("prismatic", 100.0), false);
    let rates: Vec<[f64; 2]> = creeping.modes.iter().map(|mode| mode.eigenvalue).collect();
    let root = (625.0_f64 - 75.0).sqrt();
    close(rates[0][0], -25.0 + root, 1e-11);
    close(rates[1][0], -25.0 - root, 1e-11);
    assert!(rates.iter().all(|rate| rate[1] == 0.0), "{rates:?}");
}

/// IFToMM's four-bar of three rods with a spring on its diagonal (`validation/four-bar-spring`).
#[test]
fn the_four_bar_with_a_diagonal_spring_balances_and_swings_as_by_hand() {
    let four_bar = |damping: f64| {
        let bodies = json!({
            "ground": { "points": { "O": [0.0, 0.0], "Q": [1.0, 0.0] } },
            "left": rod(1.0, [0.0, 0.0], 2.0), "top": rod(1.0, [-0.4, 0.9], 0.0), "right": rod(1.0, [1.0, 0.0], 2.0),
        });
        let joints = json!({ "o": pin("ground.O", "left.A"), "a": pin("left.B", "top.A"), "b": pin("top.B", "right.B"),
                             "q": pin("ground.Q", "right.A") });
        let spring = json!({ "type": "spring", "between": ["ground.O", "top.B"], "stiffness": 25.0, "damping": damping,
                             "free_length": 2.0_f64.sqrt() });
        statics(bodies, joints, json!({ "s": spring }))
    };
    let run = outcome(&four_bar(1.0));
    close(value(&run, "left.angle"), 2.234331019017586, 1e-14);
    close(value(&run, "right.angle"), 2.234331019017586, 1e-14);
    close(
        run.report.equilibrium.as_ref().expect("there").stiffness[0],
        7.687524905947409,
        1e-11,
    );
    close(
        linearised(&four_bar(0.0), false).modes[0].frequency(),
        2.1476766385022783,
        1e-12,
    );
    let [re, im] = linearised(&four_bar(1.0), false).modes[0].eigenvalue;
    close(re, -0.24238581, 1e-8);
    close(im, 2.13395503, 1e-8);
}

/// Crank 0.1 m and massless yoke pressed by a spring: M = k (r cos θ − x₀) r sin θ.
#[test]
fn a_scotch_yoke_is_balanced_by_its_spring() {
    let (r, k, x0, torque) = (0.1, 400.0, 0.02, 1.1);
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0], "W": [-0.5, 0.0] } },
        "crank": { "points": { "O": [0.0, 0.0], "A": [r, 0.0] }, "pose": { "position": [0.0, 0.0], "angle": 0.6 } },
        "yoke": { "points": { "C": [0.0, 0.0] }, "pose": { "position": [0.08, 0.0] } },
    });
    let joints = json!({
        "o": pin("ground.O", "crank.O"),
        "s": { "type": "slot", "between": ["yoke.C", "crank.A"], "axis": [0.0, 1.0] },
        "g": { "type": "prismatic", "between": ["ground.O", "yoke.C"], "axis": [1.0, 0.0] },
    });
    let forces = json!({
        "spring": { "type": "spring", "between": ["ground.W", "yoke.C"], "stiffness": k, "free_length": 0.5 + x0 },
        "brake": { "type": "torque", "body": "crank", "value": -torque },
    });
    let mut model = statics(bodies, joints, forces);
    // Without gravity no mass is missed.
    model.as_object_mut().expect("a map").remove("gravity");
    let run = outcome(&model);
    assert_eq!(stability(&run), "stable");
    let theta = value(&run, "crank.angle");
    close(value(&run, "yoke.x"), r * theta.cos(), 1e-15);
    close(k * (r * theta.cos() - x0) * r * theta.sin(), torque, 1e-13);
    // V″ of V = ½ k (r cos θ − x₀)² + M θ
    let found = run.report.equilibrium.as_ref().expect("there");
    let by_angle = match found.coordinates[0].as_str() {
        "yoke.x" => found.stiffness[0] * (r * theta.sin()).powi(2),
        _ => found.stiffness[0],
    };
    close(
        by_angle,
        k * r * (x0 * theta.cos() - r * (2.0 * theta).cos()),
        1e-10,
    );
    close(
        value(&run, "joint.s.fx").abs(),
        k * (r * theta.cos() - x0),
        1e-12,
    );
}

/// k θ = −W a cos θ.
#[test]
fn a_lever_turns_until_its_torsion_spring_carries_the_weight() {
    let (weight, arm, k) = (3.0 * G, 0.4, 20.0);
    let bodies = json!({
        "ground": { "points": { "O": [0.0, 0.0] } },
        "lever": { "mass": 3.0, "com": [arm, 0.0], "points": { "O": [0.0, 0.0] } },
    });
    let forces = json!({ "k": { "type": "torsion_spring", "between": ["lever", "ground"], "stiffness": k } });
    let run = outcome(&statics(
        bodies,
        json!({ "o": pin("ground.O", "lever.O") }),
        forces,
    ));
    assert_eq!(stability(&run), "stable");
    let theta = value(&run, "lever.angle");
    close(-k * theta, weight * arm * theta.cos(), 1e-13);
    close(
        run.report.equilibrium.as_ref().expect("there").stiffness[0],
        k - weight * arm * theta.sin(),
        1e-11,
    );
}
