//! The slider-crank against its statics, and where it locks itself.

use super::*;
use linkdyn_output::EventKind;

/// A slider-crank without mass but in its slider, which is pulled with `pull`.
fn bare_slider_crank(mu: f64, pull: f64) -> Value {
    let mut model = slider_crank(
        0.08,
        0.1,
        0.4,
        false,
        &json!({ "type": "polynomial", "coefficients": [0.4, 2.0] }),
    );
    for body in ["crank", "rod"] {
        model["bodies"][body]["mass"] = json!(0.0);
        model["bodies"][body]["inertia"] = json!(0.0);
    }
    model["joints"]["g"]["friction"] = coulomb(mu, 1e-9);
    model["forces"] =
        json!({ "pull": { "type": "force", "at": "slider.B", "vector": [pull, 0.0] } });
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 3.0, "outputs": 302 });
    model
}

/// Rod force S, guide force N and friction T of that slider-crank by statics of the slider; none where it locks itself.
fn slider_by_hand(mu: f64, pull: f64, angle: f64, [v, a]: [f64; 2]) -> (Option<[f64; 3]>, f64) {
    let phi = (-0.08 * angle.sin() / 0.1).asin();
    // N without friction has the sign of N with it.
    let free = G - (a - pull) / phi.cos() * phi.sin();
    let against = mu * v.signum() * free.signum();
    let margin = 1.0 + against * phi.tan();
    let force = (a - pull + against * G) / (phi.cos() + against * phi.sin());
    let normal = G - force * phi.sin();
    let torque = 0.08 * force * (angle.cos() * phi.sin() - angle.sin() * phi.cos());
    (
        (margin > 0.0).then_some([
            normal,
            -against.signum() * mu * normal.abs() * free.signum(),
            torque,
        ]),
        margin,
    )
}

#[test]
fn a_slider_crank_needs_the_effort_of_its_statics() {
    let (mu, pull) = (0.4, -30.0);
    let run = completed(&bare_slider_crank(mu, pull));
    let names = [
        "driver.motor.value",
        "slider.vx",
        "slider.ax",
        "joint.g.fy",
        "joint.g.friction",
        "driver.motor.effort",
    ];
    let columns = names.map(|name| run.trajectory.column_index(name).expect("a column"));
    let mut compared = 0;
    for row in run.trajectory.rows() {
        let [angle, v, a, normal, friction, effort] = columns.map(|column| row[column]);
        let (Some(by_hand), _) = slider_by_hand(mu, pull, angle, [v, a]) else {
            panic!("locked at {angle}")
        };
        let [wanted_normal, wanted_friction, wanted_effort] = by_hand;
        close(normal, wanted_normal, 1e-11);
        close(friction, wanted_friction, 1e-11);
        close(effort, wanted_effort, 1e-11);
        // What the driver brings in, the slider and its friction take.
        close(effort * 2.0, (a - pull - friction) * v, 1e-11);
        compared += 1;
    }
    assert_eq!(compared, 302);
}

#[test]
fn where_a_slider_locks_itself_there_are_no_forces_but_an_event() {
    let (mu, pull) = (1.1, -30.0);
    let run = outcome(&bare_slider_crank(mu, pull));
    assert_eq!(run.report.status, Status::CompletedWithGaps);
    let names = [
        "driver.motor.value",
        "slider.vx",
        "slider.ax",
        "driver.motor.effort",
        "joint.g.friction",
    ];
    let columns = names.map(|name| run.trajectory.column_index(name).expect("a column"));
    let mut counts = [0, 0];
    for row in run.trajectory.rows() {
        let [angle, v, a, effort, friction] = columns.map(|column| row[column]);
        let (by_hand, margin) = slider_by_hand(mu, pull, angle, [v, a]);
        assert_eq!(
            by_hand.is_none(),
            effort.is_nan() && friction.is_nan(),
            "{angle}: {margin}"
        );
        if let Some([_, _, wanted]) = by_hand {
            close(effort, wanted, 1e-10 / margin);
        }
        counts[usize::from(by_hand.is_none())] += 1;
    }
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
    let event = run
        .report
        .events
        .iter()
        .find(|event| event.kind == EventKind::SelfLocking)
        .expect("an event");
    let note = event.note.as_deref().expect("a note");
    assert!(note.starts_with("joint \"g\" locks itself"), "{note}");
    assert!(
        run.report
            .warnings
            .iter()
            .any(|warning| warning.contains("locks itself")),
        "{:?}",
        run.report.warnings
    );
    assert!(run.report.quality.power_imbalance.expect("forces") < 1e-12);
}

/// A heavy crank drives the slider; the pull changes until the guide presses from the side on which friction wedges.
#[test]
fn motion_that_locks_itself_ends_with_the_joint_named() {
    let mut model = bare_slider_crank(1.1, 0.0);
    model.as_object_mut().expect("a map").remove("drivers");
    model["bodies"]["crank"]["inertia"] = json!(5.0);
    model["forces"]["pull"]["vector"][0] =
        json!({ "type": "polynomial", "coefficients": [-60.0, 100.0] });
    model["analysis"] = dynamics(2.0, 201, 1e-8);
    model["initial"] = json!({ "crank": { "angle": 1.3, "angular_velocity": 0.5 } });
    let run = outcome(&model);
    let message = run.report.message.clone().expect("why it ended");
    assert_eq!(run.report.status, Status::Singular, "{message}");
    assert!(message.contains("joint \"g\" locks itself"), "{message}");
    // Where the guide presses no more: 0 = m g − S sin φ with S cos φ = m a − P; rows until there are whole.
    let columns = ["time", "crank.angle", "slider.ax", "joint.g.fy"].map(|name| column(&run, name));
    let row = columns[0].len() - 1;
    let free = |row: usize| {
        let phi = (-0.8 * columns[1][row].sin()).asin();
        G - (columns[2][row] + 60.0 - 100.0 * columns[0][row]) * phi.tan()
    };
    assert!(
        columns[3].iter().all(|normal| *normal > 0.0) && columns[3][row] < 0.03 * columns[3][0],
        "{:?}",
        columns[3]
    );
    assert!(
        free(row) > 0.0 && free(row) + (free(row) - free(row - 1)) < 0.0,
        "{} {}",
        free(row - 1),
        free(row)
    );
    // And where it starts locked, at once.
    model["forces"]["pull"]["vector"][0] = json!(40.0);
    let run = outcome(&model);
    assert_eq!(run.report.status, Status::Singular);
    let message = run.report.message.expect("why it did not begin");
    assert!(
        message.starts_with("at the start joint \"g\" locks itself"),
        "{message}"
    );
}

const LOCKING: &str = include_str!("../../cases/friction-lock.json");

/// A parallelogram that swings into its flat position: its pins' friction grows as 1/(t* − t) towards the lock before it, so
/// that no step reaches it. Whatever the tolerance, the run ends there and names the joint.
#[test]
fn a_lock_that_no_step_reaches_ends_as_one() {
    let mut ends = Vec::new();
    for rtol in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut model: Value = serde_json::from_str(LOCKING).expect("JSON");
        model["analysis"] = dynamics(1.0, 10_001, rtol);
        let run = outcome(&model);
        assert_eq!(
            run.report.status,
            Status::Singular,
            "{rtol}: {:?}",
            run.report.message
        );
        let message = run.report.message.as_deref().expect("a message");
        assert!(
            message.contains("joint \"b\" locks itself") && !message.contains("oosen"),
            "{message}"
        );
        assert!(
            message.starts_with("at t = 0.49") && message.contains("the rows until there are kept"),
            "{message}"
        );
        let (forces, times) = (column(&run, "joint.b.fx"), column(&run, "time"));
        let end = times[times.len() - 1];
        assert!(forces.iter().all(|force| force.is_finite()));
        ends.push(end);
    }
    assert!(
        ends.iter()
            .all(|end| (end - ends[3]).abs() <= 1.01e-4 * (1.0 + ends[3])),
        "{ends:?}"
    );
}
