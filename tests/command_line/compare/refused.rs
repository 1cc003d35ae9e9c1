//! What does not fit, and runs that stop.

use super::*;

#[test]
fn joints_and_models_that_do_not_fit_are_bad_input() {
    let scratch = Scratch::new("bad");
    let ran = scratch.refused(&["--joint", "a"], 2, "joints.a: has no \"clearance\"");
    assert!(
        ran.stderr.contains("model.json: line 2") && ran.stderr.contains("add \"clearance\": {"),
        "{}",
        ran.stderr
    );
    scratch.refused(
        &["--joint", "s"],
        2,
        "joints.s: only a revolute joint can have a clearance",
    );
    scratch.refused(&["--joint", "bb"], 2, "there is no joint \"bb\"");
    scratch.refused(&[], 2, "--joint <NAME>");
    scratch.refused(
        &["--joint", "b", "--models", "contacts"],
        2,
        "did you mean \"contact\"?",
    );
    scratch.refused(
        &["--joint", "b", "--columns", "slider.z"],
        2,
        "--columns \"slider.z\": matches no column",
    );
    let ran = scratch.refused(
        &["--joint", "b", "--models", "ideal,two_state"],
        2,
        "two_state: joints.b.clearance",
    );
    assert!(
        ran.stdout.contains("ideal         completed")
            && ran.stdout.contains("two_state     refused"),
        "{}",
        ran.stdout
    );
}

#[test]
fn what_can_not_be_compared_is_told() {
    let scratch = Scratch::new("nothing");
    let told = scratch.done(&["--joint", "b", "--models", "contact,contact"]);
    assert!(
        told.contains("nothing to compare contact with: no other model was run")
            && !told.contains("RMS"),
        "{told}"
    );
    let cranks = [
        "--joint",
        "b",
        "--models",
        "ideal,contact",
        "--set",
        "analysis.columns=[\"crank.*\"]",
    ];
    let told = scratch.done(&cranks);
    assert!(
        told.contains("the results have none of the columns that are compared")
            && !told.contains("RMS"),
        "{told}"
    );
    // Told after the first run, not after all of them; nothing is left of what was refused.
    let ran = scratch.refused(
        &["--joint", "b", "--columns", "slider.x,nope.*", "-o", "out"],
        2,
        "\"nope.*\"",
    );
    assert_eq!(ran.stdout, "");
    assert!(!scratch.0.join("out/ideal").exists());
}

/// A free mechanism has no massless link; the others are run.
#[test]
fn a_free_mechanism_has_no_massless_link() {
    let scratch = Scratch::new("free");
    let free = [
        "--joint",
        "b",
        "--set",
        "drivers={}",
        "--set",
        "gravity=[0, -9.81]",
        "-o",
        "out",
    ];
    let told = scratch.done(&free);
    assert!(
        told.contains("massless_link skipped: joints.b.clearance.model: a massless clearance link"),
        "{told}"
    );
    assert!(told.contains("contact       completed"), "{told}");
    let models = scratch.json("out/compare.json")["models"].clone();
    assert_eq!(
        (&models[1]["model"], &models[1]["status"]),
        (&"massless_link".into(), &"skipped".into())
    );
    assert!(!scratch.0.join("out/massless_link").exists());
}

#[test]
fn a_run_that_stops_is_a_row_and_the_others_are_done() {
    let scratch = Scratch::new("stops");
    // The crank's motion is prescribed beyond what the ideal mechanism can do, after 1.5 ms.
    let stopped = [
        "--joint",
        "b",
        "--models",
        "ideal,contact",
        "--set",
        "bodies.rod.points.B=[0.051, 0]",
        "--set",
        "joints.o.between=[\"ground.E\", \"crank.O\"]",
        "--set",
        "bodies.ground.points.E=[0, 0.01]",
        "-o",
        "out",
    ];
    let ran = scratch.compare(&stopped);
    println!("{}\n{}", ran.stdout, ran.stderr);
    assert_eq!(ran.status, Some(3), "{}", ran.stderr);
    let models = scratch.json("out/compare.json")["models"].clone();
    assert_eq!(models[0]["status"], "dead_centre");
    assert_eq!(models[1]["status"], "completed");
    let (header, rows) = scratch.table("out/compare.csv");
    assert_eq!(
        (header[1].as_str(), rows.len()),
        ("ideal:driver.motor.effort[N*m]", 41)
    );
    assert!(rows[40][1].is_none() && rows[40][2].is_some());
}
