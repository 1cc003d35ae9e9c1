//! Tables of formulas: against closed forms, from files, and what is told of those that are none.

mod files;
mod told;

use crate::mechanisms::*;
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::Status;
use serde_json::{Value, json};
use std::f64::consts::PI;

const INERTIA: f64 = 0.2;
const TURN: f64 = 2.0 * PI;

/// A rotor of 0.2 kg·m² on ground with one torque, and tables.
fn rotor(torque: Value, tables: Value) -> Value {
    let bodies = json!({ "ground": { "points": { "O": [0.0, 0.0] } },
        "rotor": { "mass": 1.0, "inertia": INERTIA, "com": [0.0, 0.0], "points": { "O": [0.0, 0.0] } } });
    let mut model = model(
        bodies,
        json!({ "o": pin("ground.O", "rotor.O") }),
        json!({}),
    );
    model["tables"] = tables;
    model["forces"] = json!({ "m": { "type": "torque", "body": "rotor", "value": torque } });
    model["initial"] = json!({ "rotor": { "angle": -0.3, "angular_velocity": 5.0 } });
    model["analysis"] = json!({ "type": "dynamics", "end": 3.0, "outputs": 31,
        "solver": { "rtol": 1e-12, "atol": 1e-14 } });
    model
}

/// That the kinetic energy is the work of the torque since −0.3 rad.
#[track_caller]
fn work_is_energy(run: &Outcome, tolerance: f64, work: impl Fn(f64) -> f64) {
    let said = &run.report;
    assert_eq!(said.status, Status::Completed, "{:?}", said.message);
    let (angle, omega) = (column(run, "rotor.angle"), column(run, "rotor.omega"));
    for (angle, omega) in angle.iter().zip(omega) {
        let known = 0.5 * INERTIA * 25.0 + work(*angle) - work(-0.3);
        let energy = 0.5 * INERTIA * omega * omega;
        let off = (energy - known).abs() / known;
        assert!(off < tolerance, "{angle}: {energy} {known}, {off:e}");
    }
}

/// The work of a saw-tooth of one turn: from 0 to 4 N·m in a quarter, back to 0 in the rest.
fn of_saw(angle: f64) -> f64 {
    let (turns, rest) = ((angle / TURN).floor(), angle.rem_euclid(TURN));
    let rising = rest.min(0.25 * TURN);
    let falling = (rest - 0.25 * TURN).max(0.0);
    turns * 2.0 * TURN + rising * rising * 4.0 / PI + falling * (4.0 - falling * 4.0 / (3.0 * PI))
}

#[test]
fn a_table_does_its_work_in_each_turn() {
    let saw = json!([["0 deg", "0 N*m"], ["90 deg", "4 N*m"], ["1 rev", "0 N*m"]]);
    let open = json!([[0, 0], [90, 4]]);
    let tables = [
        json!({ "points": saw, "interpolation": "linear", "period": "1 rev" }),
        // the first point of the next period may be left out, and units be those of columns
        json!({ "points": open, "units": ["deg", "N*m"], "interpolation": "linear", "period": 360 }),
    ];
    for table in tables {
        let run = outcome(&rotor(json!("=saw(rotor.angle)"), json!({ "saw": table })));
        work_is_energy(&run, 1e-11, of_saw);
        assert!(column(&run, "rotor.angle")[30] > 2.0 * TURN);
        let mut own = table.clone();
        own["of"] = json!("rotor.angle");
        let again = outcome(&rotor(own, json!({})));
        assert_eq!(again.trajectory.data, run.trajectory.data);
    }
}

/// A periodic spline through four points of a wave of one turn is its Hermite cubic on each quarter.
#[test]
fn a_periodic_spline_has_no_kinks() {
    let points = json!([
        [0.0, 0.0],
        [0.25 * TURN, 3.0],
        [0.5 * TURN, 0.0],
        [0.75 * TURN, -3.0],
        [TURN, 0.0]
    ]);
    let table = json!({ "points": points, "units": ["rad", "N*m"], "interpolation": "periodic" });
    let mut model = rotor(json!("=wave(rotor.angle)"), json!({ "wave": table }));
    let clever = outcome(&model).report.statistics.steps;
    assert!(clever < 400, "{clever} steps");
    // steps do not end where the third derivative jumps, and so they must be short to be exact
    model["analysis"]["solver"]["max_step"] = json!(0.002);
    let run = outcome(&model);
    // f = 3 g(x) on a quarter with g(0) = 0, g(1) = 1, g′(0) = 3/2, g′(1) = 0: g = 3/2 x − x³/2
    let quarter = |x: f64| 3.0 * 0.25 * TURN * (0.75 * x * x - 0.125 * x.powi(4));
    work_is_energy(&run, 1e-10, |angle| {
        let x = angle.rem_euclid(TURN) / (0.25 * TURN);
        let half = if x > 2.0 { 4.0 - x } else { x };
        if half > 1.0 {
            2.0 * quarter(1.0) - quarter(2.0 - half)
        } else {
            quarter(half)
        }
    });
}

#[test]
fn work_over_a_closed_cycle_is_the_integral_of_the_map() {
    // 720° of a crank; the straight lines of a table integrate by trapezia
    let value = |k: usize| 40.0 * (0.05 * k as f64).sin().powi(3) + 7.0 * (0.31 * k as f64).cos();
    let mut points: Vec<[f64; 2]> = (0..144).map(|k| [5.0 * k as f64, value(k)]).collect();
    points.push([720.0, points[0][1]]);
    let whole: f64 = points
        .windows(2)
        .map(|pair| 0.5 * (pair[0][1] + pair[1][1]))
        .sum();
    let whole = whole * (5.0_f64).to_radians();
    let table = json!({ "points": points, "units": ["deg", "N*m"], "interpolation": "linear", "period": "720 deg" });
    let mut model = rotor(json!("=map(rotor.angle)"), json!({ "map": table }));
    // fast enough to get through all of it
    model["initial"] = json!({ "rotor": { "angle": 0.0, "angular_velocity": 60.0 } });
    model["analysis"]["end"] = json!(0.5);
    model["responses"] = json!({ "omega": "at(rotor.omega, rotor.angle = 4*pi*1 rad)" });
    model["analysis"]["outputs"] = json!(5001);
    let run = outcome(&model);
    let (angle, omega) = (column(&run, "rotor.angle"), column(&run, "rotor.omega"));
    let (last, _) = angle
        .iter()
        .enumerate()
        .rfind(|(_, angle)| **angle < 2.0 * TURN)
        .expect("a cycle");
    // to the end of the cycle with the torque of its last piece
    let at = |angle: f64| {
        let part = (angle.to_degrees() - 715.0) / 5.0;
        points[143][1] + part * (points[144][1] - points[143][1])
    };
    let rest = 2.0 * TURN - angle[last];
    let energy =
        0.5 * INERTIA * omega[last].powi(2) + rest * 0.5 * (at(angle[last]) + points[144][1]);
    let work = energy - 0.5 * INERTIA * 3600.0;
    assert!((work - whole).abs() < 1e-12 * 360.0, "{work} {whole}");
}

#[test]
fn ends_hold_and_are_told() {
    let told = |table: Value| {
        let run = outcome(&rotor(
            json!("=push(rotor.angle)"),
            json!({ "push": table }),
        ));
        work_is_energy(&run, 1e-11, |angle| match angle {
            angle if angle < 0.0 => 2.0 * angle,
            angle if angle > 1.0 => 3.0 + 4.0 * (angle - 1.0),
            angle => 2.0 * angle + angle * angle,
        });
        run.report.warnings
    };
    for shape in ["linear", "natural", "monotone"] {
        let said = told(
            json!({ "points": [[0, 2], [1, 4]], "units": ["rad", "N*m"], "interpolation": shape }),
        );
        assert_eq!(
            said,
            [
                r#"from t = 0 s on, the formula of force "m" looks at times beyond the table, whose first and last value hold there"#
            ],
            "{shape}"
        );
    }
}

#[test]
fn slopes_of_tables_are_exact() {
    // a natural spline of a torsion spring's characteristic, and small motions about where it holds a weight
    let points = json!([
        [-1, "-9 N*m"],
        ["-0.4 rad", "-2 N*m"],
        [0, 0],
        ["0.4 rad", "2 N*m"],
        ["1 rad", "9 N*m"]
    ]);
    let points = {
        let mut points = points;
        points[0][0] = json!("-1 rad");
        points
    };
    let mut model = rotor(
        json!("=1 N*m - k(rotor.angle)"),
        json!({ "k": { "points": points } }),
    );
    model["initial"] = json!({});
    model["analysis"] = json!({ "type": "statics" });
    let control = linkdyn_engine::analysis::Control::default();
    let small = linkdyn_engine::analysis::modes(&loaded(&model).model, false, &control)
        .expect("small motions");
    // odd, so that the curvature at the middle is none; M at 0.4 from 0.2 M₀ … : h₀ M₀ + 2(h₀ + h₁) M₁ = 6(…)
    let (h0, h1) = (0.4, 0.6);
    let bend = 6.0 * (7.0 / h1 - 2.0 / h0) / (2.0 * (h0 + h1));
    let torque = |x: f64| 2.0 * x / h0 + bend * (x * x * x - h0 * h0 * x) / (6.0 * h0);
    let slope = |x: f64| 2.0 / h0 + bend * (3.0 * x * x - h0 * h0) / (6.0 * h0);
    let mut x = 0.2;
    for _ in 0..50 {
        x -= (torque(x) - 1.0) / slope(x);
    }
    let [real, imaginary] = small.modes[0].eigenvalue;
    let known = (slope(x) / INERTIA).sqrt();
    assert!(
        (imaginary.abs() - known).abs() < 1e-10 * known && real.abs() < 1e-10,
        "{imaginary} {known}"
    );
}

#[test]
fn ten_thousand_points_cost_no_more_than_few() {
    let points: Vec<[f64; 2]> = (0..=10_000)
        .map(|k| {
            let x = TURN * f64::from(k) / 10_000.0;
            [x, if k == 10_000 { 0.0 } else { 3.0 * x.sin() }]
        })
        .collect();
    let table = json!({ "points": points, "units": ["rad", "N*m"], "interpolation": "periodic" });
    let run = outcome(&rotor(
        json!("=wave(rotor.angle)"),
        json!({ "wave": table }),
    ));
    work_is_energy(&run, 1e-11, |angle| -3.0 * angle.cos());
    assert!(
        run.report.statistics.steps < 300,
        "{}",
        run.report.statistics.steps
    );
}

#[test]
fn parameters_reach_into_tables_and_models_are_printed_back() {
    let table = json!({ "points": [["0 rad", 0], ["1 rad", "=2*peak"], ["1 rev", 0]], "interpolation": "linear", "period": "1 rev" });
    let mut model = rotor(json!("=m(rotor.angle)"), json!({ "m": table.clone() }));
    model["parameters"] = json!({ "peak": "2 N*m" });
    let own = loaded(&model);
    assert_eq!(own.model.tables["m"].points[1], [1.0, 4.0]);
    assert_eq!(own.source.print(&own.model), own.document);
    let plain = own.model.to_json();
    let again = linkdyn_model::load(plain.to_string().as_bytes(), &[]).expect("legal");
    assert_eq!(again.model.tables, own.model.tables);
    let mut inline = table;
    inline["of"] = json!("rotor.angle");
    model["forces"]["m"]["value"] = inline;
    model["tables"] = json!({});
    let own = loaded(&model);
    assert_eq!(own.source.print(&own.model), own.document);
    let again =
        linkdyn_model::load(own.model.to_json().to_string().as_bytes(), &[]).expect("legal");
    assert_eq!(
        again.model.forces["m"],
        loaded(&again.source.print(&again.model)).model.forces["m"]
    );
    // a variant is what reading again gives
    let family =
        linkdyn_engine::analysis::Family::new(&own, &["peak"], linkdyn_model::Given::Values);
    assert!(family.is_ok());
}
