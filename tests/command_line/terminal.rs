//! The command on a terminal: a line of progress while it works, and what an interrupt leaves.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use crate::long::text;
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
    fs::write(&model, text("dynamics")).expect("written");
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
    assert!(results.ends_with('\n') && !rows.is_empty() && rows.iter().all(|row| row.len() == 3));
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

/// Red is for terminals that have colours, and for people who have not switched them off.
#[test]
fn missed_limits_are_red_on_a_terminal() {
    let folder = scratch("red");
    let path = folder.join("mine.json");
    let models = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
        .args(["models", "four-bar"])
        .output();
    let mut model: serde_json::Value =
        serde_json::from_slice(&models.expect("it runs").stdout).expect("JSON");
    model["responses"] =
        serde_json::json!({ "swing": { "value": "range(rocker.angle)", "limits": [0, 0.1] } });
    fs::write(&path, model.to_string()).expect("written");
    for (variable, value, is_red) in [
        ("TERM", "xterm", true),
        ("NO_COLOR", "", true),
        ("NO_COLOR", "1", false),
        ("TERM", "dumb", false),
    ] {
        let terminal = openpty(None, None).expect("a pseudo-terminal");
        let mut child = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
            .arg("run")
            .arg(&path)
            .env("TERM", "xterm")
            .env_remove("NO_COLOR")
            .env(variable, value)
            .stdin(Stdio::null())
            .stdout(terminal.slave)
            .stderr(Stdio::null())
            .spawn()
            .expect("the binary runs");
        let mut seen = String::new();
        read(&mut File::from(terminal.master), &mut seen, |_| false);
        assert!(child.wait().is_ok_and(|status| status.success()));
        let line = seen.lines().find(|line| line.contains("swing"));
        let line = line.expect("a response");
        assert!(line.contains(", MISSED ("), "{line:?}");
        assert_eq!(
            line.starts_with("\u{1b}[31m  responses") && line.trim_end().ends_with("\u{1b}[0m"),
            is_red,
            "{variable}={value}: {line:?}"
        );
        assert_eq!(seen.matches('\u{1b}').count(), if is_red { 2 } else { 0 });
    }
    fs::remove_dir_all(folder).expect("removed");
}

#[test]
fn people_are_told_where_messages_are_explained() {
    let (mut child, mut master) = spawn(&["run", "four-bar", "--set", "unit=1"]);
    let mut seen = String::new();
    read(&mut master, &mut seen, |_| false);
    assert_eq!(child.wait().expect("ends").code(), Some(2), "{seen:?}");
    let shown = screen(&seen);
    let lines: Vec<&str> = shown.lines().filter(|line| !line.is_empty()).collect();
    assert!(
        lines.len() == 2
            && lines[0].starts_with("error: four-bar: ")
            && lines[1] == "`linkdyn docs messages` explains messages",
        "{shown}"
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
