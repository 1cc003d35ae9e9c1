//! Starts in flat positions, and change points of loops that hold no ground, against equations of motion written by hand.

use crate::mechanisms::{column, completed, loaded, outcome, parallelogram, pin, rod};
use linkdyn_engine::analysis::{Control, run};
use linkdyn_output::Status;
use serde_json::{Value, json};

const CRANK: f64 = 0.1;
const COUPLER: f64 = 0.3;
const G: f64 = 9.81;
const END: f64 = 0.3;
const ROWS: usize = 31;

fn dynamics() -> Value {
    json!({ "type": "dynamics", "end": END, "outputs": ROWS, "solver": { "rtol": 1e-11, "atol": 1e-11 } })
}

/// A parallelogram drawn with its cranks at `angle`, on ground, or on a base that a guide along x holds.
fn drawn(angle: f64, on: &str) -> Value {
    let tip = [CRANK * angle.cos(), CRANK * angle.sin()];
    let points = json!({ "O": [0.0, 0.0], "Q": [COUPLER, 0.0] });
    let mut model = json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, -G],
        "bodies": {
            "ground": { "points": points },
            "c0": rod(CRANK, [0.0, 0.0], angle), "c1": rod(CRANK, [COUPLER, 0.0], angle), "h": rod(COUPLER, tip, 0.0),
        },
        "joints": { "o": pin(&format!("{on}.O"), "c0.A"), "q": pin(&format!("{on}.Q"), "c1.A"),
                    "a": pin("c0.B", "h.A"), "b": pin("h.B", "c1.B") },
        "initial": {}, "analysis": dynamics() });
    if on == "base" {
        model["bodies"]["base"] =
            json!({ "mass": 2.0, "inertia": 0.05, "com": [0.15, 0.02], "points": points });
        model["joints"]["guide"] =
            json!({ "type": "prismatic", "between": ["ground.O", "base.O"], "axis": [1.0, 0.0] });
        model["initial"]["base"] = json!({ "x": 0.0, "vx": 0.0 });
    }
    model
}

/// Rows of y at the outputs, by the classical method of fourth order with small steps.
fn integrated<const N: usize>(
    mut y: [f64; N],
    rates: impl Fn([f64; N]) -> [f64; N],
) -> Vec<[f64; N]> {
    let steps = 1000;
    let h = END / (ROWS - 1) as f64 / f64::from(steps);
    let mut rows = vec![y];
    while rows.len() < ROWS {
        for _ in 0..steps {
            let at = |k: &[f64; N], part: f64| std::array::from_fn(|i| y[i] + part * h * k[i]);
            let k1 = rates(y);
            let k2 = rates(at(&k1, 0.5));
            let k3 = rates(at(&k2, 0.5));
            let k4 = rates(at(&k3, 1.0));
            y = std::array::from_fn(|i| {
                y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i])
            });
        }
        rows.push(y);
    }
    rows
}

#[track_caller]
fn same<const N: usize>(model: &Value, wanted: &[[f64; N]], columns: &[(&str, usize)]) {
    let run = completed(model);
    for &(name, index) in columns {
        let ours = column(&run, name);
        assert_eq!(ours.len(), wanted.len());
        let off = ours.iter().zip(wanted).fold(0.0, |most: f64, (ours, row)| {
            most.max((ours - row[index]).abs())
        });
        println!("{name}: {off:e}");
        assert!(off < 2e-8, "{name}: {off:e}");
    }
    let drift = run.report.quality.energy_drift.expect("conservative");
    assert!(drift < 1e-8, "{drift:e}");
}

/// Moment of inertia of two cranks and the coupler that goes round with them, and m r of the same weight.
const INERTIA: f64 = (2.0 / 3.0 + 1.0) * CRANK * CRANK;
const WEIGHT: f64 = 2.0 * CRANK;

/// (⅔ + 1) m r² φ″ = −2 m g r cos φ.
fn turning([phi, rate]: [f64; 2]) -> [f64; 2] {
    [rate, -G * WEIGHT * phi.cos() / INERTIA]
}

const TURNS: [(&str, usize); 4] = [
    ("c0.angle", 0),
    ("c1.angle", 0),
    ("c0.omega", 1),
    ("c1.omega", 1),
];

#[test]
fn velocities_say_which_branch_a_flat_start_is_left_on() {
    let mut model = drawn(0.0, "ground");
    model["initial"] = json!({ "c0": { "angle": 0.0, "angular_velocity": 30.0 }, "c1": { "angular_velocity": 30.0 } });
    let wanted = integrated([0.0, 30.0], turning);
    same(&model, &wanted, &TURNS);
    let run = completed(&model);
    assert_eq!(run.report.mobility.rank, 1);
    let alpha = column(&run, "c1.alpha")[0];
    assert!((alpha + G * WEIGHT / INERTIA).abs() < 1e-7, "{alpha}");
    // The contrary parallelogram: tips r(1 − cos) apart, cranks turn as 1 : −(l + r)/(l − r).
    model["initial"]["c0"]["angular_velocity"] = json!(-15.0);
    let run = completed(&model);
    let (left, right) = (column(&run, "c0.angle"), column(&run, "c1.angle"));
    for (left, right) in left.iter().zip(&right) {
        let tips = [
            COUPLER + CRANK * (right.cos() - left.cos()),
            CRANK * (right.sin() - left.sin()),
        ];
        assert!((tips[0].hypot(tips[1]) - COUPLER).abs() < 1e-13);
    }
    assert!((left[3] - right[3]).abs() > 0.5, "{left:?} {right:?}");
    assert!(run.report.quality.energy_drift.expect("conservative") < 1e-8);
}

#[test]
fn at_rest_a_word_says_which_branch() {
    let mut model = drawn(0.0, "ground");
    model["initial"] = json!({ "c0": { "angle": 0.0, "branch": 1 }, "c1": { "branch": 1 } });
    same(&model, &integrated([0.0, 0.0], turning), &TURNS);
    // Which way bodies turn counts, not how much: here they turn as -0.5 : 1.
    model["initial"]["c1"]["branch"] = json!(-1);
    let run = completed(&model);
    let (left, right) = (column(&run, "c0.angle"), column(&run, "c1.angle"));
    assert!(
        left[ROWS - 1] * right[ROWS - 1] < -0.01,
        "{left:?} {right:?}"
    );
    // One velocity alone, which both have.
    model["initial"] = json!({ "c0": { "angle": 0.0, "angular_velocity": 30.0, "branch": 1 }, "c1": { "branch": 1 } });
    same(&model, &integrated([0.0, 30.0], turning), &TURNS);
}

#[test]
fn starts_that_nothing_decides_are_refused_with_the_words_that_would() {
    let said = |initial: Value| {
        let mut model = drawn(0.0, "ground");
        model["initial"] = initial;
        let run = outcome(&model);
        assert_eq!(run.report.status, Status::Singular);
        assert!(run.trajectory.is_empty());
        run.report.message.expect("why")
    };
    let start = "the start is a singular position (the constraints lose rank there), ";
    let undecided = format!(
        "{start}from which 2 branches of motion lead away: on one \"c0\", \"c1\" turn counter-clockwise; on another \"c1\", \
         \"h\" turn clockwise, \"c0\" turns counter-clockwise. Give \"initial\" velocities that only one of them has, or say \
         how bodies turn by each other there: \"initial\": {{ \"c0\": {{ \"branch\": 1 }}, \"c1\": {{ \"branch\": 1 }} }}, or \
         {{ \"c0\": {{ \"branch\": -0.5 }}, \"c1\": {{ \"branch\": 1 }} }}"
    );
    assert_eq!(said(json!({ "c0": { "angle": 0.0 } })), undecided);
    assert_eq!(
        said(json!({ "c0": { "angle": 0.0, "angular_velocity": 3.0 } })),
        undecided
    );
    // Both branches let one body turn.
    assert_eq!(
        said(json!({ "c0": { "angle": 0.0, "branch": 2 } })),
        undecided
    );
    assert_eq!(
        said(
            json!({ "c0": { "angle": 0.0, "angular_velocity": 30.0 }, "c1": { "angular_velocity": 32.0 } })
        ),
        format!(
            "{start}and the initial velocities are not those of the branch of motion nearest to them: there \
             c0.angular_velocity is 31 rad/s, and 30 rad/s is given"
        )
    );
    assert_eq!(
        said(
            json!({ "c0": { "angle": 0.0, "angular_velocity": 30.0, "branch": 1 },
                     "c1": { "angular_velocity": 30.0, "branch": -2 } })
        ),
        format!(
            "{start}and the initial velocities are not those of the branch of motion that is meant: there \
             c0.angular_velocity is -6 rad/s, and 30 rad/s is given"
        )
    );
}

/// The reactions of a flat loop have no bound, nor has friction that depends on them.
#[test]
fn a_flat_start_with_friction_in_the_loop_is_refused() {
    let mut model = drawn(0.0, "ground");
    model["initial"] = json!({ "c0": { "angle": 0.0, "angular_velocity": 30.0 }, "c1": { "angular_velocity": 30.0 } });
    model["joints"]["o"]["pin_radius"] = json!(0.005);
    model["joints"]["o"]["friction"] =
        json!({ "law": "coulomb", "coefficient": 0.1, "threshold_velocity": 1e-3 });
    let report = outcome(&model).report;
    assert_eq!(report.status, Status::Singular);
    let said = report.message.expect("why");
    assert!(said.contains("start a little beside it"), "{said}");
}

#[test]
fn a_driver_starts_in_a_flat_position() {
    let motion = json!({ "type": "polynomial", "coefficients": [0.0, 30.0] });
    let mut model = parallelogram(1, false, 0.0, &motion);
    model["initial"] = json!({ "c0": { "branch": 1 }, "c1": { "branch": 1 } });
    for kind in ["inverse_dynamics", "dynamics"] {
        model["analysis"] = json!({ "type": kind, "end": END, "outputs": ROWS });
        let run = completed(&model);
        assert_eq!(
            (
                run.report.mobility.rank,
                run.report.mobility.redundant.len()
            ),
            (1, 0)
        );
        assert_eq!(run.report.events[0].time, 0.0, "{:?}", run.report.events);
        for (k, time) in column(&run, "time").iter().enumerate() {
            assert!((column(&run, "c1.angle")[k] - 30.0 * time).abs() < 1e-12);
            assert!(column(&run, "c1.alpha")[k].abs() < 1e-6);
            assert!(column(&run, "h0.angle")[k].abs() < 1e-12);
        }
        let effort = column(&run, "driver.motor.effort")[0];
        assert!((effort - G * WEIGHT).abs() < 1e-7, "{effort}");
    }
    // The velocity of the other crank says as much.
    model["initial"] = json!({ "c1": { "angular_velocity": -60.0 } });
    let run = completed(&model);
    let turned = column(&run, "c1.angle")[1];
    assert!((turned + 0.57).abs() < 0.1, "{turned}");
    model["initial"] = json!({});
    let said = outcome(&model).report.message.expect("why");
    assert!(said.contains("2 branches of motion lead away"), "{said}");
}

/// (M + 3 m) x″ − 2 m r (sin φ φ″ + cos φ φ′²) = 0, (⅔ + 1) m r² φ″ − 2 m r sin φ x″ = −2 m g r cos φ.
fn sliding([_, phi, dx, dphi]: [f64; 4]) -> [f64; 4] {
    let (sin, cos) = phi.sin_cos();
    let (a, b, c) = (5.0, -WEIGHT * sin, INERTIA);
    let (f, h) = (WEIGHT * cos * dphi * dphi, -G * WEIGHT * cos);
    let det = a * c - b * b;
    [dx, dphi, (f * c - b * h) / det, (a * h - b * f) / det]
}

#[test]
fn a_parallelogram_on_a_base_that_slides_passes_its_flat_positions() {
    // From beside, and from the flat position itself.
    for angle in [0.5, 0.0] {
        let mut model = drawn(angle, "base");
        model["initial"]["c0"] = json!({ "angle": angle, "angular_velocity": 30.0 });
        model["initial"]["c1"] = json!({ "angular_velocity": 30.0 });
        let wanted = integrated([0.0, angle, 0.0, 30.0], sliding);
        assert!(wanted[ROWS - 1][1] > std::f64::consts::TAU, "{wanted:?}");
        let columns = [
            ("base.x", 0),
            ("c0.angle", 1),
            ("c1.angle", 1),
            ("base.vx", 2),
            ("c0.omega", 3),
        ];
        same(&model, &wanted, &columns);
    }
}

#[test]
fn two_flat_parallelograms_with_a_spring_start_each_on_its_own_branch() {
    let (stiffness, free, place) = (200.0, 0.7, 1.0);
    let mut model = drawn(0.0, "ground");
    model["bodies"]["ground"]["points"]["R"] = json!([place, 0.0]);
    model["bodies"]["ground"]["points"]["S"] = json!([place + COUPLER, 0.0]);
    for (name, length, x) in [
        ("d0", CRANK, 0.0),
        ("d1", CRANK, COUPLER),
        ("k", COUPLER, CRANK),
    ] {
        model["bodies"][name] = rod(length, [place + x, 0.0], 0.0);
    }
    for (name, ends) in [
        ("r", ["ground.R", "d0.A"]),
        ("s", ["ground.S", "d1.A"]),
        ("c", ["d0.B", "k.A"]),
        ("d", ["k.B", "d1.B"]),
    ] {
        model["joints"][name] = pin(ends[0], ends[1]);
    }
    model["forces"] = json!({ "k": { "type": "spring", "between": ["c1.B", "d0.B"], "stiffness": stiffness, "free_length": free } });
    model["initial"] = json!({ "c0": { "angle": 0.0, "angular_velocity": 20.0 }, "c1": { "angular_velocity": 20.0 },
                               "d0": { "angle": 0.0, "angular_velocity": -15.0 }, "d1": { "angular_velocity": -15.0 } });
    let rates = |y: [f64; 4]| {
        let [phi, psi, dphi, dpsi] = y;
        let ends = [
            place - COUPLER + CRANK * (psi.cos() - phi.cos()),
            CRANK * (psi.sin() - phi.sin()),
        ];
        let length = ends[0].hypot(ends[1]);
        let pull = ends.map(|d| stiffness * (length - free) * d / length);
        let turn = |angle: f64| CRANK * (pull[1] * angle.cos() - pull[0] * angle.sin());
        let falls = |angle: f64| -G * WEIGHT * angle.cos();
        [
            dphi,
            dpsi,
            (turn(phi) + falls(phi)) / INERTIA,
            (falls(psi) - turn(psi)) / INERTIA,
        ]
    };
    let wanted = integrated([0.0, 0.0, 20.0, -15.0], rates);
    same(
        &model,
        &wanted,
        &[
            ("c0.angle", 0),
            ("c1.angle", 0),
            ("d0.angle", 1),
            ("d1.omega", 3),
        ],
    );
    // Words mean the same.
    model["initial"] = json!({ "c0": { "angle": 0.0, "angular_velocity": 20.0, "branch": 1 }, "c1": { "branch": 1 },
                               "d0": { "angle": 0.0, "angular_velocity": -15.0, "branch": 1 }, "d1": { "branch": 1 } });
    same(&model, &wanted, &[("c1.angle", 0), ("d1.angle", 1)]);
    // Of the second pair nothing is said.
    model["initial"]["d1"] = json!({});
    let said = run(&loaded(&model).model, &Control::default()).expect("a report");
    let said = said.report.message.expect("why");
    assert!(said.contains("4 branches of motion lead away"), "{said}");
}
