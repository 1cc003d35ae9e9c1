//! Long runs: a line of progress on a terminal and none elsewhere, and what an interrupt or a time limit leaves.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use linkdyn_engine::analysis::{Control, Outcome, run};
use linkdyn_output::Status;

/// A driven slider-crank and, beside it, a pendulum; long enough for everybody.
fn text(analysis: &str) -> String {
    let drivers = match analysis {
        "dynamics" => "",
        _ => {
            r#""drivers": {
            "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": 6 } },
            "shaker": { "type": "rotation", "body": "bob",
                        "motion": { "type": "harmonic", "amplitude": 1, "frequency": 0.7 } } },"#
        }
    };
    format!(
        r#"{{ "format": "linkdyn/1", "name": "long", "units": "SI", "gravity": [0, -9.81],
        "bodies": {{ "ground": {{ "points": {{ "O": [0, 0], "Q": [2, 0] }} }},
            "crank": {{ "mass": 1, "inertia": 0.1, "com": [0, 0], "points": {{ "O": [0, 0], "A": [0.1, 0] }} }},
            "rod": {{ "mass": 1, "inertia": 0.01, "com": [0.2, 0], "points": {{ "A": [0, 0], "B": [0.4, 0] }}, "pose": {{ "position": [0.1, 0] }} }},
            "piston": {{ "mass": 1, "inertia": 0, "com": [0, 0], "points": {{ "B": [0, 0] }}, "pose": {{ "position": [0.5, 0] }} }},
            "bob": {{ "mass": 1, "inertia": 0, "com": [0.5, 0], "points": {{ "Q": [0, 0] }}, "pose": {{ "position": [2, 0] }} }} }},
        "joints": {{ "a": {{ "type": "revolute", "between": ["ground.O", "crank.O"] }},
            "b": {{ "type": "revolute", "between": ["crank.A", "rod.A"] }},
            "c": {{ "type": "revolute", "between": ["rod.B", "piston.B"] }},
            "d": {{ "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] }},
            "q": {{ "type": "revolute", "between": ["ground.Q", "bob.Q"] }} }},
        {drivers}
        "analysis": {{ "type": "{analysis}", "end": 1e4, "outputs": 100001, "columns": ["piston.x", "bob.angle"] }} }}"#
    )
}

const ANALYSES: [&str; 3] = ["kinematics", "inverse_dynamics", "dynamics"];

/// The run, stopped where `when` says so.
fn stopped(analysis: &str, when: fn(f64) -> bool) -> Outcome {
    let loaded = linkdyn_model::load(text(analysis).as_bytes(), &[]).expect("a sound model");
    let control = Control {
        deadline: Instant::now().checked_add(Duration::from_secs(100)),
        ..Control::default()
    };
    let watched = control.clone();
    let watcher = std::thread::spawn(move || {
        while !watched.progress.share().is_some_and(when) {
            std::thread::sleep(Duration::from_micros(50));
        }
        watched.interrupted.store(true, Ordering::SeqCst);
    });
    let outcome = run(&loaded.model, &control).expect("sound");
    watcher.join().expect("no panic");
    outcome
}

#[test]
fn an_interrupt_keeps_the_rows_until_then() {
    for analysis in ANALYSES {
        // of prescribed motions the first half is the path
        let outcome = stopped(
            analysis,
            if analysis == "dynamics" {
                |share| share > 0.001
            } else {
                |share| share > 0.5001
            },
        );
        let rows = outcome.trajectory.rows().count();
        assert_eq!(outcome.report.status, Status::Interrupted, "{analysis}");
        assert!(0 < rows && rows < 100_001, "{analysis}: {rows}");
        assert!(
            outcome
                .trajectory
                .rows()
                .all(|row| row.iter().all(|value| value.is_finite())),
            "{analysis}"
        );
        let message = outcome.report.message.expect("a reason");
        assert!(
            message.starts_with("interrupted") && message.ends_with("the rows until then are kept"),
            "{message}"
        );
    }
}

#[test]
fn an_interrupt_while_the_path_is_followed_is_told_as_that() {
    let outcome = stopped("kinematics", |share| share > 0.001);
    assert_eq!(
        (outcome.report.status, outcome.trajectory.rows().count()),
        (Status::Interrupted, 0)
    );
    let message = outcome.report.message.expect("a reason");
    assert_eq!(
        message,
        "interrupted while the path was followed, before the first output"
    );
}

#[test]
fn a_time_that_is_over_is_a_time_limit_in_every_analysis() {
    for analysis in ANALYSES {
        let loaded = linkdyn_model::load(text(analysis).as_bytes(), &[]).expect("a sound model");
        let control = Control {
            deadline: Some(Instant::now()),
            ..Control::default()
        };
        let report = run(&loaded.model, &control).expect("sound").report;
        assert_eq!(report.status, Status::TimeLimit, "{analysis}");
        assert!(
            report
                .message
                .expect("a reason")
                .starts_with("max_wall_time is over"),
            "{analysis}"
        );
    }
}

/// Ten million cycles of a driver: with one driver its path is gone once, of several it is followed in time until the limit.
#[test]
fn a_fast_driver_does_not_outlast_its_time() {
    let second = r#", "still": { "type": "rotation", "body": "b", "motion": { "type": "constant_velocity", "velocity": 1 } }"#;
    for (drivers, limit) in [("", false), (second, true)] {
        let joint = if limit {
            ""
        } else {
            r#", "k": { "type": "fixed", "between": ["ground.Q", "b.B"] }"#
        };
        let text = format!(
            r#"{{ "format": "linkdyn/1", "units": "SI", "bodies": {{ "ground": {{ "points": {{ "O": [0, 0], "Q": [2, 0] }} }},
            "a": {{ "points": {{ "O": [0, 0] }} }}, "b": {{ "points": {{ "B": [0, 0] }}, "pose": {{ "position": [2, 0] }} }} }},
            "joints": {{ "o": {{ "type": "revolute", "between": ["ground.O", "a.O"] }}
                {} {joint} }},
            "drivers": {{ "fast": {{ "type": "rotation", "body": "a", "motion": {{ "type": "harmonic", "amplitude": 0.3, "frequency": 1e7 }} }} {drivers} }},
            "analysis": {{ "type": "kinematics", "end": 1, "outputs": 11 }} }}"#,
            if limit {
                r#", "q": { "type": "revolute", "between": ["ground.Q", "b.B"] }"#
            } else {
                ""
            }
        );
        let model = linkdyn_model::load(text.as_bytes(), &[])
            .expect("a sound model")
            .model;
        let start = Instant::now();
        let control = Control {
            deadline: start.checked_add(Duration::from_millis(500)),
            ..Control::default()
        };
        let outcome = run(&model, &control).expect("sound");
        assert!(
            start.elapsed() < Duration::from_millis(1500),
            "{:?}",
            start.elapsed()
        );
        if limit {
            assert_eq!(outcome.report.status, Status::TimeLimit);
            continue;
        }
        assert_eq!(
            outcome.report.status,
            Status::Completed,
            "{:?}",
            outcome.report.message
        );
        for row in outcome.trajectory.rows() {
            // 0.3 sin ωt: ωt is known to round-off of some 6e7.
            let exact = 0.3 * (std::f64::consts::TAU * 1e7 * row[0]).sin();
            let angle = row[outcome
                .trajectory
                .column_index("a.angle")
                .expect("a column")];
            assert!((angle - exact).abs() < 1e-12, "{angle} instead of {exact}");
        }
    }
}

#[cfg(unix)]
mod terminal {
    use std::fs::{self, File};
    use std::io::Read;
    use std::path::{Path, PathBuf};
    use std::process::{Child, Command, Stdio};

    use nix::pty::openpty;

    /// The command with a terminal for standard error, and that terminal's other side.
    fn spawn(arguments: &[&str]) -> (Child, File) {
        let terminal = openpty(None, None).expect("a pseudo-terminal");
        let child = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
            .args(arguments)
            .env("TERM", "xterm")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(terminal.slave)
            .spawn()
            .expect("the binary runs");
        (child, File::from(terminal.master))
    }

    /// Reads until `enough`, or until the other side is closed.
    fn read(master: &mut File, seen: &mut String, enough: fn(&str) -> bool) {
        let mut piece = [0; 1024];
        // Linux tells a closed terminal by an error
        while let Ok(count @ 1..) = master.read(&mut piece) {
            seen.push_str(&String::from_utf8_lossy(&piece[..count]));
            if enough(seen) {
                return;
            }
        }
    }

    /// What a terminal shows after all that: lines, of each the last characters put at each place.
    fn screen(seen: &str) -> String {
        let mut lines = vec![Vec::new()];
        let mut at = 0;
        for c in seen.chars() {
            match c {
                '\r' => at = 0,
                '\n' => lines.push(Vec::new()),
                c => {
                    let line: &mut Vec<char> = lines.last_mut().expect("one");
                    line.resize(line.len().max(at + 1), ' ');
                    line[at] = c;
                    at += 1;
                }
            }
        }
        let lines = lines
            .iter()
            .map(|line| line.iter().collect::<String>().trim_end().to_string());
        lines.collect::<Vec<_>>().join("\n")
    }

    fn scratch(name: &str) -> PathBuf {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("interrupt-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a scratch directory");
        path
    }

    fn interrupt(child: &Child) {
        let sent = Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status();
        assert!(sent.is_ok_and(|status| status.success()));
    }

    #[test]
    fn a_long_run_tells_its_progress_and_leaves_what_it_has_when_interrupted() {
        let folder = scratch("run");
        let model = folder.join("long.json");
        fs::write(&model, super::text("dynamics")).expect("written");
        let out = folder.join("out");
        let (mut child, mut master) = spawn(&[
            "run",
            model.to_str().expect("UTF-8"),
            "--set",
            "analysis.end=1e6",
            "-o",
            out.to_str().expect("UTF-8"),
        ]);
        let mut seen = String::new();
        read(&mut master, &mut seen, |seen| {
            seen.matches(" %").count() >= 3
        });
        assert!(
            seen.contains("\rlong [>") && seen.contains(" %  0."),
            "{seen:?}"
        );
        interrupt(&child);
        read(&mut master, &mut seen, |_| false);
        let status = child.wait().expect("ends");
        assert_eq!(status.code(), Some(130), "{seen:?}");
        let shown = screen(&seen);
        let lines: Vec<&str> = shown.lines().filter(|line| !line.is_empty()).collect();
        assert_eq!(
            lines[0], "interrupted: writing what there is; once more to stop at once",
            "{seen:?}"
        );
        assert!(
            lines.len() == 2 && lines[1].starts_with("error: interrupted"),
            "{shown}"
        );

        let summary = fs::read_to_string(out.join("summary.json")).expect("written");
        let summary: serde_json::Value = serde_json::from_str(&summary).expect("valid JSON");
        assert_eq!(summary["status"], "interrupted");
        let results = fs::read_to_string(out.join("results.csv")).expect("written");
        let mut rows = results.lines();
        assert_eq!(rows.next(), Some("time[s],piston.x[m],bob.angle[rad]"));
        let rows: Vec<Vec<f64>> = rows
            .map(|row| {
                row.split(',')
                    .map(|cell| cell.parse().expect("a number"))
                    .collect()
            })
            .collect();
        assert!(
            results.ends_with('\n') && !rows.is_empty() && rows.iter().all(|row| row.len() == 3)
        );
        fs::remove_dir_all(folder).expect("removed");
    }

    /// The flag is that of all runs of a command, not of the first one only.
    #[test]
    fn a_comparison_is_interrupted_in_any_of_its_runs() {
        let models = ["--models", "ideal,two_state,contact"];
        let run = [
            "compare",
            "slider-crank-clearance",
            "--joint",
            "wristpin",
            "--set",
            "analysis.end=20",
        ];
        let (mut child, mut master) = spawn(&[&run[..], &models].concat());
        let mut seen = String::new();
        read(&mut master, &mut seen, |seen| {
            seen.contains("two_state [") && seen.contains(" %")
        });
        interrupt(&child);
        read(&mut master, &mut seen, |_| false);
        let mut told = String::new();
        child
            .stdout
            .take()
            .expect("piped")
            .read_to_string(&mut told)
            .expect("UTF-8");
        assert_eq!(child.wait().expect("ends").code(), Some(130), "{seen:?}");
        assert!(
            told.contains("ideal ") && told.contains("interrupted"),
            "{told}"
        );
        assert!(
            screen(&seen).contains("error: interrupted: contact left out"),
            "{seen:?}"
        );
    }

    #[test]
    fn a_short_run_on_a_terminal_shows_no_line() {
        let (mut child, mut master) = spawn(&["run", "four-bar", "--set", "analysis.outputs=3"]);
        let mut seen = String::new();
        read(&mut master, &mut seen, |_| false);
        assert_eq!(
            (child.wait().expect("ends").code(), seen.as_str()),
            (Some(0), "")
        );
    }

    #[test]
    fn validation_names_the_case_and_is_interrupted() {
        // long enough together: the line waits for half a second of the command
        let cases = [&["validate", "four-bar"][..], &["tolerance-ladder"; 40]].concat();
        let (mut child, mut master) = spawn(&cases);
        let mut seen = String::new();
        read(&mut master, &mut seen, |seen| {
            seen.contains("tolerance-ladder [") && seen.contains(" %")
        });
        interrupt(&child);
        read(&mut master, &mut seen, |_| false);
        let mut told = String::new();
        child
            .stdout
            .take()
            .expect("piped")
            .read_to_string(&mut told)
            .expect("UTF-8");
        assert_eq!(child.wait().expect("ends").code(), Some(130), "{seen:?}");
        assert!(told.starts_with("four-bar: "), "{told}");
        let shown = screen(&seen);
        assert!(
            shown.contains("error: interrupted after ") && shown.contains(" of 41 cases"),
            "{seen:?}"
        );
    }
}
