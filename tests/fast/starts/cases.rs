//! Starts that went wrong once.

use crate::mechanisms::{column, completed, outcome, pin, rod};
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

const LENGTH: f64 = 0.5;
const BASE: f64 = 0.3;

/// A parallelogram that hangs, drawn with its links at an angle from straight down.
fn hanging(drawn: f64) -> Value {
    let (sin, cos) = drawn.sin_cos();
    let link = |x: f64| {
        json!({ "mass": 1.2, "inertia": 0.025, "com": [0, -0.25], "points": { "O": [0, 0], "E": [0, -LENGTH] },
                "pose": { "position": [x, 0], "angle": drawn } })
    };
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
        "bodies": { "ground": { "points": { "A": [0, 0], "D": [BASE, 0] } },
            "l": link(0.0), "r": link(BASE),
            "k": { "mass": 0.8, "inertia": 0.006, "com": [0.15, 0], "points": { "L": [0, 0], "R": [BASE, 0] },
                   "pose": { "position": [LENGTH * sin, -LENGTH * cos] } } },
        "joints": { "a": pin("ground.A", "l.O"), "b": pin("l.E", "k.L"), "c": pin("k.R", "r.E"), "d": pin("r.O", "ground.D") },
        "analysis": { "type": "assembly" } })
}

/// Whether the links of a run are parallel all the time.
fn is_parallel(run: &linkdyn_engine::analysis::Outcome) -> bool {
    let (l, r) = (column(run, "l.angle"), column(run, "r.angle"));
    l.iter()
        .zip(&r)
        .all(|(l, r)| (0.5 * (l - r)).sin().abs() < 1e-9)
}

#[test]
fn a_parallelogram_stays_one_from_every_start_before_its_flat_position() {
    for degrees in -89..=89 {
        let mut model = hanging(0.0);
        model["initial"] = json!({ "l": { "angle": f64::from(degrees).to_radians() } });
        let run = completed(&model);
        assert!(is_parallel(&run), "{degrees}");
        assert!(
            run.report.warnings.is_empty(),
            "{degrees}: {:?}",
            run.report.warnings
        );
    }
}

#[test]
fn a_start_beyond_a_flat_position_is_told() {
    for degrees in [100.0, 200.0, -120.0, 3.0 * 360.0 + 30.0, -3600.0] {
        let mut model = hanging(0.0);
        model["initial"] = json!({ "l": { "angle": f64::to_radians(degrees) } });
        let run = completed(&model);
        let [said] = &run.report.warnings[..] else {
            panic!("{degrees}: {:?}", run.report.warnings)
        };
        for part in [
            "singular position at l.angle = ",
            "1.5708 rad",
            "\"l\", \"r\" and \"k\" are in line",
            "\"pose\"",
        ] {
            assert!(said.contains(part), "{degrees}: {said}");
        }
        assert!(is_parallel(&run), "{degrees}");
    }
}

#[test]
fn a_whitworth_motor_starts_anywhere() {
    for start in 0..36 {
        let start = format!("drivers.motor.motion.start={} deg", 10 * start);
        let model = crate::models::load_bundled("whitworth", &[&start]);
        let run = crate::models::solve(&model);
        assert!(run.report.warnings.is_empty(), "{:?}", run.report.warnings);
        // The pin stays on the side of the arm on which it is drawn.
        let at = |name: &str| crate::models::values(&run, name)[0];
        let crank = at("crank.angle");
        let pin = [0.12 * crank.cos(), 0.12 * crank.sin() + 0.06];
        let arm = at("arm.angle");
        let along = pin[0] * arm.cos() + pin[1] * arm.sin();
        assert!(along > 0.05, "{start}: {along}");
    }
}

#[test]
fn a_flat_start_is_exact_and_on_the_branch_that_is_said() {
    let flat = 0.5 * PI;
    for (own, other) in [(1.0, 1.0), (1.0, 4.0)] {
        let mut model = hanging(0.0);
        model["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 101, "solver": { "rtol": 1e-10, "atol": 1e-12 } });
        model["initial"] = json!({ "l": { "angle": flat, "angular_velocity": 0, "branch": own }, "r": { "branch": other } });
        let run = completed(&model);
        for link in ["l.angle", "r.angle"] {
            let off = (column(&run, link)[0] - flat).abs();
            assert!(off < 1e-13, "{link}: {off:e}");
        }
        assert_eq!(is_parallel(&run), own == other);
        assert!(run.report.quality.energy_drift.expect("conservative") < 1e-7);
    }
    // Of itself it goes on as it was drawn, and says so.
    let mut model = hanging(0.0);
    model["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 101 });
    model["initial"] = json!({ "l": { "angle": flat, "angular_velocity": 0 } });
    let run = completed(&model);
    assert!(is_parallel(&run));
    let said = run.report.warnings.concat();
    assert!(
        said.contains("\"branch\"") && said.contains("reached from the drawing"),
        "{said}"
    );
}

#[test]
fn a_flat_start_of_a_driver_goes_on_as_it_is_drawn() {
    // As long cranks on a short base turn against each other: one four times as fast as the other.
    let mut model = hanging(0.0);
    model["drivers"] = json!({ "d": { "type": "rotation", "body": "l",
        "motion": { "type": "constant_velocity", "start": 0.5 * PI, "velocity": 1.0 } } });
    model["analysis"] = json!({ "type": "kinematics", "end": 1, "outputs": 11 });
    let run = completed(&model);
    assert!(is_parallel(&run));
    let said = run.report.warnings.concat();
    assert!(said.contains("\"branch\""), "{said}");
    model["initial"] = json!({ "l": { "branch": 1 }, "r": { "branch": 4 } });
    assert!(!is_parallel(&completed(&model)));
}

#[test]
fn a_flat_drawing_is_left_to_the_side_of_the_start() {
    let run = |start: f64, branch: Option<f64>| {
        let mut model = hanging(0.5 * PI);
        model["initial"] = json!({ "l": { "angle": 0.5 * PI + start }, "r": {} });
        if let Some(branch) = branch {
            model["initial"]["l"]["branch"] = json!(1);
            model["initial"]["r"]["branch"] = json!(branch);
        }
        let run = completed(&model);
        let said = run.report.warnings.concat();
        let is_told = said.contains("branches of motion lead to the start");
        assert_eq!(is_told, branch.is_none(), "{start}: {said}");
        is_parallel(&run)
    };
    for start in [-1.2, -0.7, 0.01, 0.2, 1.0, 1.3] {
        assert!(run(start, Some(1.0)), "{start}");
        assert!(!run(start, Some(4.0)), "{start}");
        // Neighbours agree where nobody says.
        assert_eq!(run(start, None), run(1.0, None), "{start}");
    }
}

#[test]
fn a_start_behind_a_dead_centre_is_told() {
    // A rocker drawn at 50 degrees does not get to 310 by way of 180.
    let (crank, coupler, rocker, base) = (0.5, 0.4, 0.45, 0.7);
    let drawn = 50.0_f64.to_radians();
    let tip = [crank * drawn.cos(), crank * drawn.sin()];
    let mut model = json!({ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "O": [0, 0], "Q": [base, 0] } },
            "crank": rod(crank, [0.0, 0.0], drawn), "coupler": rod(coupler, tip, 0.3), "rocker": rod(rocker, [base, 0.0], 1.4) },
        "joints": { "o": pin("ground.O", "crank.A"), "a": pin("crank.B", "coupler.A"), "b": pin("coupler.B", "rocker.B"), "q": pin("ground.Q", "rocker.A") },
        "analysis": { "type": "assembly" } });
    model["initial"] = json!({ "crank": { "angle": TAU - drawn } });
    let run = completed(&model);
    let said = run.report.warnings.concat();
    assert!(
        said.contains("dead centre") && said.contains("\"coupler\" and \"rocker\" are in line"),
        "{said}"
    );
    // Out of reach altogether.
    model["initial"] = json!({ "crank": { "angle": PI } });
    assert_eq!(outcome(&model).report.status, Status::AssemblyFailed);
}
