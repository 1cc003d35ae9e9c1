//! Paths of points, and searches that are stopped.

use super::{command, found, value};
use crate::browser::Scratch;
use serde_json::{Value, json};
use std::process::Stdio;

/// A point of the coupler of a four-bar at an angle of its crank, by the law of cosines [mm].
fn point(angle: f64, base: f64, crank: f64, coupler: f64, rocker: f64, p: [f64; 2]) -> [f64; 2] {
    let a = [crank * angle.cos(), crank * angle.sin()];
    let gap = [base - a[0], -a[1]];
    let d = gap[0].hypot(gap[1]);
    let cos = (coupler * coupler + d * d - rocker * rocker) / (2.0 * coupler * d);
    let (sin, cos) = (cos.acos() + gap[1].atan2(gap[0])).sin_cos();
    [
        a[0] + p[0] * cos - p[1] * sin,
        a[1] + p[0] * sin + p[1] * cos,
    ]
}

/// The bundled four-bar as one of other lengths: its point is (l/2, 80 l/250) of a coupler l.
fn wanted(angles: &[f64]) -> Value {
    let all = angles.iter().map(|angle| {
        let [x, y] = point(angle.to_radians(), 300.0, 90.0, 260.0, 200.0, [130.0, 83.2]);
        json!([x, y])
    });
    all.collect()
}

#[test]
fn a_path_is_found_again_with_and_without_its_timing() {
    let scratch = Scratch::new("optimise-path");
    // The crank starts at 60°, so that 20° comes a turn later.
    let angles = [60.0, 100.0, 150.0, 220.0, 300.0, 350.0, 20.0];
    let mut curve = json!({ "point": "coupler.P", "through": wanted(&angles), "at": angles });
    for timed in [true, false] {
        if !timed {
            curve.as_object_mut().expect("an object").remove("at");
        }
        let asked = json!({ "design": { "crank": [60, 140], "coupler": [200, 400] }, "curve": curve, "starts": 2 });
        let set = format!("optimise={asked}");
        let found = found(
            &scratch,
            &["four-bar", "--set", "analysis.end=0.63", "--set", &set],
        );
        assert!(
            found["curve"]["largest_distance"].as_f64() < Some(1e-12),
            "{found}"
        );
        assert!((value(&found, "crank") - 0.09).abs() < 1e-11, "{found}");
        assert!((value(&found, "coupler") - 0.26).abs() < 1e-11, "{found}");
        assert_eq!(found["reached"], 2, "{found}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_the_best_so_far() {
    use nix::sys::signal::{Signal, kill};
    use nix::unistd::Pid;
    use std::time::Duration;
    let scratch = Scratch::new("optimise-interrupt");
    let set = format!(
        "optimise={}",
        json!({ "design": { "base": [200, 400], "crank": [60, 140], "coupler": [200, 400], "rocker": [150, 300] },
            "curve": { "point": "coupler.P", "through": [[0, 0], [300, 10], [100, 500], [-50, 70]] }, "starts": 1000 })
    );
    let mut command = command(&scratch, &["four-bar", "--set", &set, "--json"]);
    let child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary runs");
    std::thread::sleep(Duration::from_millis(1500));
    kill(Pid::from_raw(child.id() as i32), Signal::SIGINT).expect("a signal");
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130));
    let told: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(told["status"], "interrupted");
    assert!(told["curve"]["rms_distance"].as_f64() > Some(0.0), "{told}");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        said.ends_with("error: interrupted: this is the best so far\n"),
        "{said}"
    );
}
