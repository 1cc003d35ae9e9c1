//! What the fuzzer (`cargo bench --bench fuzz`) has found, and what must hold instead.

use std::ffi::OsString;
use std::path::Path;

use linkdyn::cli::{Said, captured};
use linkdyn_engine::analysis::{Control, check, run};
use linkdyn_model::Checked;
use linkdyn_model::error::Complaint;
use serde_json::{Value, json};

/// A driven slider-crank.
fn slider_crank() -> Value {
    json!({
        "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
        "bodies": {
            "ground": { "points": { "O": [0, 0] } },
            "crank": { "mass": 1, "inertia": 0.01, "com": [0.05, 0], "points": { "O": [0, 0], "A": [0.1, 0] } },
            "rod": { "mass": 1, "inertia": 0.02, "com": [0.15, 0], "points": { "A": [0, 0], "B": [0.3, 0] },
                     "pose": { "position": [0.1, 0] } },
            "slider": { "mass": 2, "inertia": 0.01, "com": [0, 0], "points": { "B": [0, 0] },
                        "pose": { "position": [0.4, 0] } },
        },
        "joints": {
            "o": { "type": "revolute", "between": ["ground.O", "crank.O"] },
            "a": { "type": "revolute", "between": ["crank.A", "rod.A"] },
            "b": { "type": "revolute", "between": ["rod.B", "slider.B"] },
            "guide": { "type": "prismatic", "between": ["ground.O", "slider.B"], "axis": [1, 0] },
        },
        "drivers": { "motor": { "type": "rotation", "body": "crank",
                                "motion": { "type": "constant_velocity", "start": 0.5, "velocity": 3 } } },
        "analysis": { "type": "inverse_dynamics", "end": 1, "outputs": 11 },
    })
}

/// The slider-crank with other values at some places (JSON pointers).
fn with(changes: &[(&str, Value)]) -> Value {
    let mut json = slider_crank();
    for (place, value) in changes {
        let (parent, key) = place.rsplit_once('/').expect("a pointer");
        match json.pointer_mut(parent).expect("there") {
            Value::Object(map) => drop(map.insert(key.to_string(), value.clone())),
            Value::Array(list) => list[key.parse::<usize>().expect("an index")] = value.clone(),
            other => panic!("{other}"),
        }
    }
    json
}

fn load(json: &Value) -> Checked {
    linkdyn_model::load(json.to_string().as_bytes(), &[])
        .unwrap_or_else(|said| panic!("{said:?}"))
        .model
}

/// What `check` and `run` complain of, which must be the same.
fn refused(json: &Value) -> Complaint {
    let model = load(json);
    let of_check = check(&model).expect_err("refused");
    let of_run = run(&model, &Control::default()).expect_err("refused");
    assert_eq!(of_check, of_run);
    of_run.into_iter().next().expect("a complaint")
}

fn bundled(name: &str) -> Value {
    let model = linkdyn_model::bundled::find(name).expect("bundled");
    serde_json::from_str(model.text).expect("JSON")
}

/// Runs a command on a model in a file.
fn command(name: &str, words: &[&str], json: &Value) -> Said {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join(format!("finds-{}-{name}.json", std::process::id()));
    std::fs::write(&file, json.to_string()).expect("written");
    let (command, options) = words.split_first().expect("a command");
    let words = ["linkdyn", command]
        .into_iter()
        .chain(file.to_str())
        .chain(options.iter().copied());
    let said = captured(words.map(OsString::from));
    std::fs::remove_file(file).expect("removed");
    said
}

/// The square of such an axis vanishes or overflows, its direction does not: panicked.
#[test]
fn an_axis_of_any_length_is_a_direction() {
    let reference = run(&load(&slider_crank()), &Control::default())
        .expect("runs")
        .trajectory;
    for length in [5e-324, 1e-200, 1e-160, 1e160, 1e200, 1e308] {
        let other = with(&[("/joints/guide/axis", json!([length, 0]))]);
        let found = run(&load(&other), &Control::default())
            .expect("runs")
            .trajectory;
        assert!(
            found.rows().eq(reference.rows()),
            "axis of length {length:e}"
        );
    }
}

/// "The loop does not close; it lacks inf m" of a ground that is 1e155 m away: it is a slip, and has a place.
#[test]
fn points_further_than_numbers_reach_are_refused() {
    for (place, x) in [
        ("/bodies/ground/points/O/1", 1e155),
        ("/bodies/slider/points/B/0", -1e200),
        ("/bodies/rod/com/0", 1e61),
    ] {
        let said = refused(&with(&[(place, json!(x))]));
        assert_eq!(said.path, "bodies", "{said}");
        assert!(said.message.contains("larger than 1e60 m"), "{said}");
    }
}

/// The same of an angle or the start of a driver.
#[test]
fn joints_and_drivers_further_than_numbers_reach_are_named() {
    for (place, path) in [
        ("/joints/guide/angle", "joints.guide"),
        ("/drivers/motor/motion/start", "drivers.motor"),
        ("/initial", "initial.crank.angle"),
    ] {
        let value = if place == "/initial" {
            json!({ "crank": { "angle": 1e200 } })
        } else {
            json!(1e200)
        };
        let said = refused(&with(&[(place, value)]));
        assert_eq!(said.path, path, "{said}");
        assert!(
            said.hint
                .as_ref()
                .is_some_and(|hint| hint.contains("wrong exponent")),
            "{said}"
        );
    }
}

/// A crank that gas spins up until steps leave the range of numbers: where a curve comes round no last place is kept; panicked.
#[test]
fn a_curve_that_comes_round_has_no_place_for_what_is_no_number() {
    let mut engine = bundled("engine");
    engine["tables"]["gas"]["points"][33][1] = json!(-2830079221.0975456);
    engine["analysis"]["solver"]["initial_step"] = json!(1.8939654323075532);
    engine["analysis"]["end"] = json!(0.0683);
    let trajectory = run(&load(&engine), &Control::default())
        .expect("runs")
        .trajectory;
    assert!(trajectory.len() > 340, "{} rows", trajectory.len());
}

/// "Newton's iteration does not converge (residual NaN of the size)": an output right at a dead centre, and a driver whose value
/// overflows. The message has a reason in words, and what was computed until then is kept.
#[test]
fn an_end_of_the_motion_has_a_reason_in_words() {
    let mut chebyshev = bundled("chebyshev");
    chebyshev["bodies"]["coupler"]["points"]["B"] = json!([125, 0]);
    chebyshev["bodies"]["left"]["points"]["A"] = json!([-25, 0]);
    let polynomial = json!({ "type": "polynomial", "coefficients": [0.5, 3, 1.5, -0.25] });
    let far = with(&[
        ("/drivers/motor/motion", polynomial),
        ("/analysis/end", json!(1e155)),
    ]);
    for (json, rows) in [(chebyshev, 30), (far, 1)] {
        let outcome = run(&load(&json), &Control::default()).expect("runs");
        let message = outcome.report.message.expect("it ends early");
        assert!(
            !message.contains("NaN") && !message.contains("inf"),
            "{message}"
        );
        assert!(
            outcome.trajectory.len() >= rows,
            "{} rows: {message}",
            outcome.trajectory.len()
        );
    }
}

/// "The body is heavy, inf kg": rounded to four digits the largest numbers are none any more, and ratios of large and small ones overflow.
#[test]
fn warnings_of_very_large_numbers_name_numbers() {
    let largest = f64::MAX;
    for (name, changes) in [
        ("mass", vec![("/bodies/rod/mass", json!(largest))]),
        (
            "inertia",
            vec![
                ("/bodies/rod/mass", json!(1e-320)),
                ("/bodies/rod/inertia", json!(1.0)),
            ],
        ),
        ("gravity", vec![("/gravity", json!([largest, largest]))]),
    ] {
        let said = command(name, &["check"], &with(&changes));
        assert!(said.stdout.contains("e308"), "{name}: {}", said.stdout);
        let odd = said
            .stdout
            .split(|c: char| !c.is_alphanumeric())
            .find(|word| ["inf", "NaN"].contains(word));
        assert_eq!(odd, None, "{name}: {}", said.stdout);
    }
}

/// A command that another program runs says what it says to the streams of a process.
#[test]
fn a_captured_command_keeps_its_streams() {
    let said = command("sound", &["check", "--json"], &slider_crank());
    assert_eq!((said.status, said.stderr.as_str()), (0, ""));
    assert_eq!(
        serde_json::from_str::<Value>(&said.stdout).expect("valid JSON")["status"],
        "completed"
    );
    let said = command(
        "unsound",
        &["run", "--set", "joints.a.type=hinge"],
        &slider_crank(),
    );
    assert_eq!((said.status, said.stdout.as_str()), (2, ""));
    assert!(
        said.stderr.starts_with("error: ") && said.stderr.contains("joints.a.type"),
        "{}",
        said.stderr
    );
    let said = captured(["linkdyn", "rnu"].map(OsString::from));
    assert!(
        said.status == 2 && said.stderr.contains("did you mean \"run\"?"),
        "{said:?}"
    );
    let said = captured(["linkdyn", "--version"].map(OsString::from));
    assert!(
        said.status == 0 && said.stdout.starts_with("linkdyn "),
        "{said:?}"
    );
}

/// The largest force of all is hardly one: `points="NaN,NaN"`.
#[test]
fn an_arrow_of_the_least_force_there_is_has_a_length() {
    let folder =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("finds-{}-least", std::process::id()));
    let out = folder.to_str().expect("UTF-8");
    let mut json = slider_crank();
    json["forces"] =
        json!({ "load": { "type": "force", "at": "slider.B", "vector": [-3.75e-322, 0] } });
    assert_eq!(command("least", &["run", "-o", out], &json).status, 0);
    let picture = folder.join("motion.svg");
    let words = [
        "linkdyn",
        "animate",
        out,
        "-o",
        picture.to_str().expect("UTF-8"),
    ];
    assert_eq!(captured(words.map(OsString::from)).status, 0);
    let drawn = std::fs::read_to_string(&picture).expect("a picture");
    assert!(drawn.contains("class=\"load\"") && !drawn.contains("NaN"));
    std::fs::remove_dir_all(folder).expect("removed");
}

/// A centre of mass that is half a billion links away: the curve of positions was followed in a billion steps.
#[test]
fn a_curve_that_bodies_run_along_is_left_in_time() {
    let mut json = bundled("andrews-squeezer");
    json["bodies"]["OF"]["com"][1] = json!(-12664853.6);
    check(&load(&json)).expect("sound");
}

/// A place, or a rate, of 1e308 in a table of results is none that a picture has: `r="inf"`, `points="NaN,NaN"`.
#[test]
fn pictures_of_places_further_than_they_reach_have_gaps() {
    let folder =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("finds-{}-far", std::process::id()));
    let out = folder.to_str().expect("UTF-8");
    let said = command("far", &["run", "-o", out], &slider_crank());
    assert_eq!(said.status, 0, "{}", said.stderr);
    let table = std::fs::read_to_string(folder.join("results.csv")).expect("readable");
    let header: Vec<&str> = table.lines().next().expect("a header").split(',').collect();
    for column in ["rod.x[m]", "rod.vx[m/s]", "slider.angle[rad]"] {
        let at = header
            .iter()
            .position(|name| *name == column)
            .expect("a column");
        let spoilt: Vec<String> = table
            .lines()
            .enumerate()
            .map(|(row, line)| {
                let mut cells: Vec<&str> = line.split(',').collect();
                if row == 4 {
                    cells[at] = "1e308";
                }
                cells.join(",")
            })
            .collect();
        std::fs::write(folder.join("results.csv"), spoilt.join("\n")).expect("written");
        let picture = folder.join("motion.svg");
        let words = [
            "linkdyn",
            "animate",
            out,
            "-o",
            picture.to_str().expect("UTF-8"),
            "--poses",
            "9",
        ];
        let said = captured(words.map(OsString::from));
        assert_eq!(said.status, 0, "{column}: {}", said.stderr);
        let text = std::fs::read_to_string(&picture).expect("readable");
        assert!(!text.contains("inf") && !text.contains("NaN"), "{column}");
    }
    std::fs::remove_dir_all(folder).expect("removed");
}
