//! `run` for programs and for edits in a loop: JSON, rows on standard output, no report, watching.

use super::*;
use std::io::{BufRead, BufReader};
use std::process::{Child, ChildStderr};

#[test]
fn the_summary_is_told_as_json() {
    let scratch = Scratch::new("json");
    let told: Value = serde_json::from_str(&done(&["run", "four-bar", "--json"])).expect("JSON");
    let out = scratch.path("out");
    let kept = done(&["run", "four-bar", "--json", "-o", &out]);
    let file = fs::read_to_string(scratch.0.join("out/summary.json")).expect("written");
    assert!(kept == file, "{} and {} bytes", kept.len(), file.len());
    let kept: Value = serde_json::from_str(&kept).expect("JSON");
    let keys = |value: &Value| {
        let object = value.as_object().expect("an object");
        object.keys().cloned().collect::<Vec<_>>()
    };
    assert_eq!(keys(&told), keys(&kept));
    for key in ["status", "extremes", "mechanism", "quality"] {
        assert_eq!(told[key], kept[key], "{key}");
    }
}

#[test]
fn a_run_that_stops_early_tells_its_json_all_the_same() {
    let sets = ["--set", "analysis.sample.to=133 deg"];
    let ran = refused(
        &[&["run", "lock", "--json"][..], &sets].concat(),
        3,
        "error: dead centre",
    );
    let told: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(told["status"], "dead_centre");
    assert!(ran.stderr.contains(told["message"].as_str().expect("why")));
    let rows = linkdyn(&[&["run", "lock", "-o", "-"][..], &sets].concat());
    assert!(rows.status == Some(3) && rows.stderr.contains("dead centre"));
    assert!(rows.stdout.starts_with("time[s],") && rows.stdout.lines().count() > 100);
    // Bad input leaves no half of a document.
    let ran = refused(&["run", "lock", "--json", "--set", "unit=1"], 2, "unknown");
    assert_eq!(ran.stdout, "");
}

#[test]
fn rows_go_to_standard_output() {
    let scratch = Scratch::new("rows");
    let told = done(&["run", "four-bar", "-o", "-"]);
    done(&["run", "four-bar", "-o", &scratch.path("out")]);
    let file = fs::read_to_string(scratch.0.join("out/results.csv")).expect("written");
    assert_eq!(told, file);
    let kept = linkdyn::cli::captured(["linkdyn", "run", "four-bar", "-o", "-"].map(Into::into));
    assert_eq!((kept.status, kept.stdout), (0, file));

    let ran = linkdyn(&["run", "parallel-crank", "-o", "-"]);
    assert!(ran.stdout.starts_with("time[s],"), "{ran:?}");
    assert!(
        ran.stderr
            .starts_with("warning: constraints of b are redundant"),
        "{ran:?}"
    );
    for option in ["--json", "--watch"] {
        refused(
            &["run", "four-bar", option, "-o", "-"],
            2,
            &format!("{option}: not with -o -"),
        );
    }
}

#[test]
fn without_a_report_there_is_none_of_an_older_run_either() {
    let scratch = Scratch::new("no-report");
    let out = scratch.path("out");
    let run = ["run", "four-bar", "-o", &out];
    done(&run);
    let report = scratch.0.join("out/report.html");
    assert!(report.exists());
    let told = done(&[&run[..], &["--no-report"]].concat());
    assert!(told.contains("results.csv") && !told.contains("report.html"));
    assert!(!report.exists() && scratch.0.join("out/summary.json").exists());
    refused(&["run", "four-bar", "--no-report"], 2, "--output");
}

/// A command that watches, ended when it is dropped.
struct Watching(Child, BufReader<ChildStderr>);

impl Watching {
    fn start(arguments: &[&str]) -> Self {
        let mut child = command(arguments)
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary runs");
        let said = BufReader::new(child.stderr.take().expect("piped"));
        Watching(child, said)
    }

    /// What it says until it waits.
    fn until_it_waits(&mut self) -> String {
        let mut said = String::new();
        while !said.contains("watching ") {
            assert_ne!(self.1.read_line(&mut said).expect("UTF-8"), 0, "{said}");
        }
        said
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn a_watched_file_runs_again_when_it_is_saved() {
    let scratch = Scratch::new("watch");
    let text = done(&["models", "four-bar"]);
    let model = scratch.write("mine.json", &text);
    let out = scratch.path("out");
    let mut watching = Watching::start(&["run", &model, "-o", &out, "--watch"]);
    let largest =
        || json(&scratch.path("out/summary.json"))["extremes"]["crank.omega[rad/s]"]["max"].clone();

    let said = watching.until_it_waits();
    assert!(
        said.starts_with("watching ") && said.contains("Ctrl-C"),
        "{said}"
    );
    let first = largest();
    let results = scratch.0.join("out/results.csv");
    let rows = |path: &Path| fs::read_to_string(path).expect("written").lines().count();
    let before = rows(&results);

    // At one stroke: on a busy machine a file that is written in place may be read twice, empty and full.
    let save = |text: &str| {
        let new = scratch.write("mine.new", text);
        fs::rename(new, &model).expect("saved");
    };

    // A fault is told and waited out.
    save("{");
    let said = watching.until_it_waits();
    assert!(
        said.starts_with("error: ") && said.contains("not JSON"),
        "{said}"
    );
    assert_eq!(rows(&results), before);

    let mut fewer: Value = serde_json::from_str(&text).expect("JSON");
    fewer["analysis"]["outputs"] = 7.into();
    save(&fewer.to_string());
    watching.until_it_waits();
    assert_eq!((rows(&results), largest()), (8, first));

    // The page beside the report leads to the one that is served, and says so when that is gone.
    let live = fs::read_to_string(scratch.0.join("out/live.html")).expect("written");
    assert!(live.contains("report.html") && live.contains("http://127.0.0.1:"));
}

#[test]
#[cfg(unix)]
fn an_interrupt_ends_the_watch_without_a_word() {
    let scratch = Scratch::new("watch-end");
    let model = scratch.write("mine.json", &done(&["models", "four-bar"]));
    let out = scratch.path("out");
    let mut watching = Watching::start(&["run", &model, "-o", &out, "--watch"]);
    let said = watching.until_it_waits();
    assert!(said.contains("live.html shows the report"), "{said}");
    assert!(said.contains(" (http://127.0.0.1:"), "{said}");
    let live = scratch.0.join("out/live.html");
    assert!(live.exists());
    // It begins to wait a moment after it has said so.
    std::thread::sleep(std::time::Duration::from_millis(300));
    let sent = Command::new("kill")
        .args(["-INT", &watching.0.id().to_string()])
        .status();
    assert!(sent.is_ok_and(|status| status.success()));
    let mut rest = String::new();
    std::io::Read::read_to_string(&mut watching.1, &mut rest).expect("UTF-8");
    let status = watching.0.wait().expect("ends");
    assert_eq!((status.code(), rest.as_str()), (Some(130), ""));
    assert!(!live.exists());
    assert!(scratch.0.join("out/report.html").exists());
}

#[test]
fn only_a_file_can_be_watched() {
    refused(
        &["run", "four-bar", "--watch"],
        2,
        "four-bar: --watch wants the path of a model file",
    );
}

/// Missed limits are told first; they are a matter of the exit status if that is requested.
#[test]
fn limits_that_are_missed_are_marked() {
    let scratch = Scratch::new("limits");
    let mut model: Value = serde_json::from_str(&done(&["models", "four-bar"])).expect("JSON");
    model["responses"] = serde_json::json!({
        "peak": { "value": "max(abs(driver.motor.effort))", "limits": ["0 N*m", "1 N*m"], "unit": "kN*m" },
        "swing": { "value": "range(rocker.angle)", "limits": ["0 deg", "180 deg"] },
        "never": { "value": "at(crank.angle, t = 1 h)", "limits": ["0 deg", "1 deg"] },
    });
    let path = scratch.write("mine.json", &model.to_string());
    let told = done(&["run", &path]);
    let lines: Vec<&str> = told.lines().collect();
    assert!(
        lines[1].starts_with("  responses     peak = 0.")
            && lines[1].ends_with(" kN·m, MISSED (outside of 0 kN·m … 0.001 kN·m)"),
        "{told}"
    );
    assert!(
        lines[2].contains("swing = ") && lines[2].contains(" (within 0° … 180°)"),
        "{told}"
    );
    assert!(lines[3].contains("never: none, MISSED, at("), "{told}");
    assert!(lines[4].starts_with("  mobility"), "{told}");

    let said = "error: limits are missed: peak, never";
    let strict = refused(&["run", &path, "--strict"], 4, said);
    assert!(strict.stdout.starts_with(lines[0]), "{strict:?}");
    refused(&["run", &path, "--strict", "--json"], 4, said);
    refused(&["run", &path, "--strict", "-o", "-"], 4, said);
    model["responses"] = serde_json::json!({ "swing": model["responses"]["swing"] });
    let path = scratch.write("kept.json", &model.to_string());
    done(&["run", &path, "--strict"]);
    done(&["run", "four-bar", "--strict"]);
    // Whoever stops early has not missed a limit, but the end.
    let early = ["--set", "analysis.solver.max_wall_time=1e-9"];
    let stopped = linkdyn(&[&["run", &path, "--strict"][..], &early].concat());
    assert_eq!(stopped.status, Some(3), "{stopped:?}");
}

#[test]
fn responses_are_told_and_kept() {
    let scratch = Scratch::new("responses");
    let out = scratch.path("out");
    let asked = [
        "run",
        "four-bar",
        "-o",
        &out,
        "--response",
        "peak = max(abs(driver.motor.effort))",
        "--response",
        "never = at(crank.angle, t = 1 h)",
    ];
    let told = done(&asked);
    assert!(told.contains("  responses     peak = "), "{told}");
    let never = "never: none, at(crank.angle, t = 1 h): this never happens";
    assert!(told.contains(never), "{told}");
    let text = fs::read_to_string(scratch.0.join("out/summary.json")).expect("written");
    let kept: Value = serde_json::from_str(&text).expect("JSON");
    let extremes = &kept["extremes"]["driver.motor.effort[N*m]"];
    let end = |key: &str| extremes[key].as_f64().expect("a number").abs();
    let peak = kept["responses"]["peak"]["value"]
        .as_f64()
        .expect("a number");
    // the rows stand beside the peak
    let of_rows = end("min").max(end("max"));
    assert!(
        (of_rows..1.0001 * of_rows).contains(&peak),
        "{peak} beside {of_rows}"
    );
    assert_eq!(kept["responses"]["peak"]["unit"], "N*m");
    assert!(kept["responses"]["never"]["value"].is_null());
    let page = fs::read_to_string(scratch.0.join("out/report.html")).expect("written");
    assert!(page.contains(r#""responses":{"peak""#), "no responses");
    refused(
        &["run", "four-bar", "--response", "a = max(crank.angel)"],
        2,
        "--response \"a = max(crank.angel)\": there is no column, parameter or number \"crank.angel\" (did you mean \"crank.angle\"?)",
    );
}
