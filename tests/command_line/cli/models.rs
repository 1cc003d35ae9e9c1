//! Bundled models and templates.

use super::*;

#[test]
fn models_are_listed_and_printed() {
    let list = done(&["models"]);
    assert!(
        list.lines().any(|line| line.starts_with("four-bar ")),
        "{list}"
    );
    assert!(
        list.lines().all(|line| line.chars().count() <= 110),
        "{list}"
    );
    let names: Vec<&str> = list
        .lines()
        .filter(|line| !line.starts_with(' '))
        .filter_map(|line| line.split([',', ' ']).next())
        .collect();
    assert!(names.len() >= 20, "{names:?}");
    for name in names {
        let model: Value = serde_json::from_str(&done(&["models", name])).expect("valid JSON");
        assert_eq!(model["format"], "linkdyn/1", "{name}");
    }
    refused(&["models", "fuor-bar"], 2, "did you mean \"four-bar\"?");
    refused(
        &["models", "wishbone"],
        2,
        "did you mean \"double-wishbone\"?",
    );
}

#[test]
fn the_row_of_four_bars_comes_in_any_size() {
    assert_eq!(
        done(&["models", "nfourbar", "--n", "2"]),
        done(&["models", "nfourbar"])
    );
    let model: Value =
        serde_json::from_str(&done(&["models", "a02", "--n", "40"])).expect("valid JSON");
    assert_eq!(
        model["bodies"].as_object().map(|bodies| bodies.len()),
        Some(82)
    );
    assert!(done(&["run", "nfourbar:3"]).contains("N = 3 (nfourbar:3): dynamics, completed"));
    refused(
        &["models", "nfourbar:7", "--n", "3"],
        2,
        "nfourbar:7: --n 3 beside the size 7 (give one: nfourbar:3,",
    );
    refused(
        &["models", "nfourbar", "--n", "0"],
        2,
        "a whole number from 1 to 50000, as in \"nfourbar:40\"",
    );
    refused(
        &["check", "nfourbar:many"],
        2,
        "nfourbar:many: the size of \"nfourbar\" is its number of loops",
    );
    refused(
        &["models", "jansen", "--n", "3"],
        2,
        "the model \"jansen-leg\" has one size",
    );
    refused(&["models", "--n", "3"], 2, "<NAME>");
}

#[test]
fn every_template_checks_and_runs_clean() {
    let scratch = Scratch::new("new");
    for template in [
        "four-bar",
        "slider-crank",
        "pendulum",
        "spring-mass",
        "clearance",
    ] {
        let file = scratch.path(&format!("{template}.json"));
        let told = done(&["new", template, "-o", &file]);
        assert!(
            told.contains(&format!("linkdyn check {file}")) && told.contains("linkdyn run"),
            "{told}"
        );
        let told: Value =
            serde_json::from_str(&done(&["check", "--json", &file])).expect("valid JSON");
        assert_eq!(
            (&told["warnings"], &told["faults"]),
            (&serde_json::json!([]), &serde_json::json!([])),
            "{template}"
        );
        let told = done(&["run", &file, "-o", &scratch.path("out")]);
        assert!(
            told.contains("completed") && !told.contains("warnings"),
            "{told}"
        );
        assert_eq!(
            json(&format!("{}/summary.json", scratch.path("out")))["status"],
            "completed",
            "{template}"
        );
    }
}

#[test]
fn a_new_model_overwrites_nothing_unasked() {
    let scratch = Scratch::new("new-twice");
    let file = scratch.write("mine.json", "precious");
    refused(
        &["new", "-o", &file],
        2,
        "there is such a file already (--force overwrites it)",
    );
    assert_eq!(fs::read_to_string(&file).expect("there"), "precious");
    done(&["new", "-o", &file, "--force"]);
    assert_eq!(json(&file)["name"], "My four-bar");
    refused(
        &["new", "-o", &scratch.path("none/mine.json")],
        2,
        "its folder does not exist",
    );
    for force in [&[][..], &["--force"]] {
        refused(
            &[&["new", "-o", &scratch.path("")], force].concat(),
            2,
            ": a directory (name a file, such as ",
        );
    }
    if Path::new("/proc/self").is_dir() {
        refused(
            &["new", "-o", "/proc/x.json"],
            5,
            "/proc/x.json: can't be written: ",
        );
    }
    refused(
        &["new", "fourbar"],
        2,
        "no template of that name (did you mean \"four-bar\"?)",
    );
    // Where no file is named it is called after the template, here.
    let ran: Ran = command(&["new", "pendulum"])
        .current_dir(&scratch.0)
        .output()
        .expect("runs")
        .into();
    assert!(
        ran.status == Some(0) && ran.stdout.starts_with("pendulum.json: "),
        "{ran:?}"
    );
    assert_eq!(json(&scratch.path("pendulum.json"))["name"], "My pendulum");
}

#[test]
fn models_are_drawn() {
    let scratch = Scratch::new("gallery");
    let listed = done(&["models", "-o", &scratch.path("all")]);
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let count = fs::read_dir(models).expect("models").count();
    assert_eq!(listed.lines().count(), count, "{listed}");
    for path in listed.lines() {
        let bytes = fs::read(path).expect("written");
        assert!(
            bytes.starts_with(b"\x89PNG") && bytes.len() > 3000,
            "{path}"
        );
    }
    let one = done(&["models", "nfourbar", "--n", "2", "-o", &scratch.path("one")]);
    assert!(one.trim().ends_with("nfourbar-2.png"), "{one}");
    refused(
        &["models", "four-bra", "-o", &scratch.path("none")],
        2,
        "four-bar",
    );
}
