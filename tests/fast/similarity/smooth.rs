//! The same of motions without contacts: forward dynamics, clearance links, outputs by a driver's value, initial velocities.

use super::{Factors, Near, assert_alike, slider_crank};
use crate::models::{load, solve};
use linkdyn_engine::analysis::Outcome;
use linkdyn_engine::integrate::{Dop853, Limits, Ode, Refused, Stepper, Tolerance};
use linkdyn_output::Status;
use serde_json::{Value, json};

/// Enlargements whose masses and times are not those of gravity and density.
const FACTORS: [Factors; 4] = [
    Factors {
        length: 1e-6,
        mass: 1e-9,
        time: 1e-7,
    },
    Factors {
        length: 1e-6,
        mass: 1e6,
        time: 1e9,
    },
    Factors {
        length: 1e2,
        mass: 1e-3,
        time: 1e-8,
    },
    Factors {
        length: 1e2,
        mass: 1e7,
        time: 1e10,
    },
];

fn completed(model: &Value) -> Outcome {
    let outcome = solve(&load(model));
    let report = &outcome.report;
    assert_eq!(report.status, Status::Completed, "{:?}", report.message);
    outcome
}

/// Two rods on each other, let go aside under gravity, with a spring and a damper.
fn pendulum(factors: Factors) -> Value {
    let Factors { length, mass, time } = factors;
    let (l, m, i) = (0.3 * length, 0.5 * mass, 4e-3 * mass * length.powi(2));
    let per_angle = mass * length.powi(2) / time.powi(2);
    json!({
        "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81 * length / time.powi(2)],
        "bodies": {
            "ground": { "points": { "O": [0, 0] } },
            "upper": { "mass": m, "inertia": i, "com": [0.5 * l, 0], "points": { "O": [0, 0], "A": [l, 0] } },
            "lower": { "mass": m, "inertia": i, "com": [0.5 * l, 0], "points": { "A": [0, 0], "P": [l, 0] },
                       "pose": { "position": [l, 0] } },
        },
        "joints": {
            "o": { "type": "revolute", "between": ["ground.O", "upper.O"] },
            "a": { "type": "revolute", "between": ["upper.A", "lower.A"] },
        },
        "forces": {
            "coil": { "type": "torsion_spring", "between": ["upper", "lower"], "stiffness": 0.8 * per_angle,
                      "damping": 0.02 * per_angle * time, "free_angle": 0.4 },
        },
        "initial": { "upper": { "angle": -0.3, "angular_velocity": 0.7 / time }, "lower": { "angle": 0.5 } },
        "points": ["lower.P"],
        // Near nothing but rtol bounds the errors: `atol` is in SI.
        "analysis": { "type": "dynamics", "end": 2.5 * time, "outputs": 26,
                      "solver": { "rtol": 1e-10, "atol": 1e-30 } },
    })
}

/// Some hundred steps of an error of 1e-10 of what moves.
const INTEGRATED: Near = Near {
    length: 1e-7,
    other: 1e-6,
};

#[test]
fn free_motions_are_alike_at_every_size() {
    let unit = Factors {
        length: 1.0,
        mass: 1.0,
        time: 1.0,
    };
    let own = completed(&pendulum(unit));
    for factors in FACTORS {
        // Errors of rates are bounded by 1e-14 rad/s at least: much slower ones are not as exact.
        let factors = Factors {
            time: factors.time.min(1e2),
            ..factors
        };
        let what = format!("{factors:?}");
        let other = completed(&pendulum(factors));
        let [steps, others] = [&own, &other].map(|outcome| outcome.report.statistics.steps);
        println!("{what}: {steps} and {others} steps");
        // A first step that is a million times too short takes eight more.
        assert!(steps.abs_diff(others) <= 5, "{what}: {steps} and {others}");
        assert_alike(&own, &other, factors, &what, INTEGRATED);
    }
}

/// y₁′ = y₂/T, y₂′ = −y₁/T.
struct Swing {
    /// T \[s\].
    pace: f64,
}

impl Ode for Swing {
    fn dimension(&self) -> usize {
        2
    }

    fn eval(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        (dy[0], dy[1]) = (y[1] / self.pace, -y[0] / self.pace);
        Ok(())
    }

    fn accept(&mut self, _: f64, _: &[f64]) {}
}

/// First steps of a swing that nothing tells the pace of are its own, whatever the unit of time: bit by bit, for a power of two.
#[test]
fn first_steps_are_measured_by_the_pace() {
    let steps = |pace: f64| {
        let limits = Limits {
            pace: Some(pace),
            ..Limits::default()
        };
        let tolerance = Tolerance {
            rtol: 1e-8,
            atol: vec![1e-8; 2],
            cap: Vec::new(),
        };
        let mut stepper = Dop853::new(tolerance, limits);
        let mut problem = Swing { pace };
        let end = 10.0 * pace;
        // From y = 0 almost: so small that the first step has nothing to go by.
        let start = [1e-14, 0.0];
        stepper
            .start(&mut problem, 0.0, &start, end)
            .expect("started");
        let mut times = Vec::new();
        while stepper.t() < end {
            stepper.step(&mut problem, end).expect("a step");
            times.push(stepper.t() / pace);
        }
        times
    };
    let own = steps(1.0);
    assert!(own.len() > 2, "{own:?}");
    for power in [-60, -20, 20, 80] {
        assert_eq!(steps(2.0_f64.powi(power)), own, "2^{power}");
    }
}

/// The fixed point is found to 1e-10 of the mechanism; its turning is a difference of outputs 5° apart.
const FIXED: Near = Near {
    length: 1e-9,
    other: 1e-6,
};

#[test]
fn clearance_links_are_alike_at_every_size() {
    let linked = |factors: Factors| {
        let mut model = slider_crank("massless_link", factors);
        model["analysis"]["type"] = json!("inverse_dynamics");
        model["analysis"]["outputs"] = json!(73);
        completed(&model)
    };
    let own = linked(Factors::with_rod(super::ROD));
    for factors in FACTORS {
        let other = linked(factors);
        assert_alike(&own, &other, factors, &format!("{factors:?}"), FIXED);
    }
}

/// A driver that takes a second or ten thousand years to pass its values passes them all.
#[test]
fn sampled_values_are_reached_at_every_pace() {
    let sampled = |time: f64| {
        let velocity = format!(
            r#"{{"type":"constant_velocity","start":"35 deg","velocity":"{:e} rad/s"}}"#,
            -0.7 / time
        );
        let sets = [
            format!("drivers.motor.motion={velocity}"),
            "analysis={\"type\":\"kinematics\",\"sample\":{\"driver\":\"motor\",\"from\":\"35 deg\",\"to\":\"-325 deg\",\"step\":\"40 deg\"}}"
                .to_owned(),
        ];
        let bundled = linkdyn_model::bundled::find("four-bar").expect("bundled");
        let loaded = linkdyn_model::load(bundled.text.as_bytes(), &sets);
        let model = loaded.unwrap_or_else(|said| panic!("{said:?}")).model;
        solve(&model.into_model())
    };
    let times = |outcome: &Outcome| outcome.trajectory.values("time").expect("a column");
    let own = sampled(1.0);
    assert_eq!(own.trajectory.len(), 10, "{:?}", own.report.message);
    for time in [1e-13, 1e-5, 1e6, 3e11] {
        let other = sampled(time);
        for (own, other) in times(&own).iter().zip(times(&other)) {
            assert!(
                (own - other / time).abs() <= 1e-14 * own.abs(),
                "{time}: {own} {other}"
            );
        }
        assert_eq!(own.trajectory.len(), other.trajectory.len(), "{time}");
    }
}

/// A crank that is driven and starts a thousandth faster than that is a slip at any speed, a billionth is round-off.
#[test]
fn initial_velocities_conflict_at_every_pace() {
    for time in [1e-12, 1e-6, 1.0, 1e6, 1e12] {
        let status = |part: f64| {
            let model = json!({
                "format": "linkdyn/1", "units": "SI",
                "bodies": { "ground": { "points": { "O": [0, 0] } },
                            "crank": { "points": { "O": [0, 0], "A": [0.1, 0] } } },
                "joints": { "o": { "type": "revolute", "between": ["ground.O", "crank.O"] } },
                "drivers": { "motor": { "type": "rotation", "body": "crank",
                    "motion": { "type": "constant_velocity", "velocity": 2.0 / time } } },
                "initial": { "crank": { "angular_velocity": 2.0 / time * (1.0 + part) } },
                "analysis": { "type": "assembly" },
            });
            solve(&load(&model)).report.status
        };
        assert_eq!(status(1e-3), Status::AssemblyFailed, "{time}");
        assert_eq!(status(1e-9), Status::Completed, "{time}");
    }
}
