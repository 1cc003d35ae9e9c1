//! Files that are read and written.

use super::*;

#[test]
fn a_run_writes_its_files_and_tells_about_them() {
    let scratch = Scratch::new("run");
    let output = scratch.path("deep/out");
    let told = done(&["run", "four-bar", "-o", &output]);
    for word in [
        "Four-bar (four-bar): inverse dynamics, completed",
        "mobility",
        "outputs",
        "motor: ",
        "results.csv",
        "time",
    ] {
        assert!(told.contains(word), "{word:?} is not in {told}");
    }
    let summary = json(&format!("{output}/summary.json"));
    assert_eq!(summary["status"], "completed");
    assert_eq!(summary["model"]["sha256"].as_str().map(str::len), Some(64));
    let results = fs::read_to_string(format!("{output}/results.csv")).expect("readable");
    assert!(results.starts_with("time[s],"), "{results}");
    let left: Vec<_> = fs::read_dir(&output)
        .expect("a directory")
        .filter_map(Result::ok)
        .collect();
    assert!(
        left.iter()
            .all(|entry| !entry.file_name().to_string_lossy().starts_with('.')),
        "{left:?}"
    );
    // A second run overwrites.
    done(&["run", "four-bar", "-o", &output]);
}

#[test]
fn a_file_is_run_like_the_bundled_model() {
    let scratch = Scratch::new("file");
    let model = scratch.write("mine.json", &done(&["models", "four-bar"]));
    assert!(done(&["run", &model]).contains("mine.json): inverse dynamics, completed"));
}

#[test]
fn a_directory_of_a_bundled_models_name_does_not_hide_it() {
    let scratch = Scratch::new("hide");
    fs::create_dir(scratch.path("four-bar")).expect("made");
    let ran: Ran = command(&["run", "four-bar"])
        .current_dir(&scratch.0)
        .output()
        .expect("runs")
        .into();
    assert_eq!(ran.status, Some(0), "{ran:?}");
}

#[test]
fn results_that_can_not_be_written_are_bad_input() {
    let scratch = Scratch::new("unwritable");
    let file = scratch.write("file", "");
    refused(&["run", "four-bar", "-o", &file], 2, "not a directory");
    refused(
        &["run", "four-bar", "-o", &format!("{file}/below")],
        2,
        "can't be made",
    );
    fs::create_dir(scratch.path("results.csv")).expect("made");
    refused(
        &["run", "four-bar", "-o", &scratch.path("")],
        2,
        "stands where a result file would go",
    );
    refused(&["validate", "-o", &file], 2, "not a directory");
}

#[test]
fn a_broken_file_is_bad_input_with_its_place() {
    let scratch = Scratch::new("broken");
    let model = scratch.write(
        "broken.json",
        "{\n  \"format\": \"linkdyn/1\",\n  oops\n}\n",
    );
    for command in ["run", "check"] {
        let ran = refused(&[command, &model], 2, "broken.json: line 3, column ");
        assert_eq!(ran.stdout, "", "{ran:?}");
    }
}

#[test]
fn a_bad_model_makes_no_directory() {
    let scratch = Scratch::new("no-directory");
    let model = scratch.write("broken.json", "{");
    refused(
        &["run", &model, "-o", &scratch.path("out")],
        2,
        "broken.json",
    );
    assert!(!Path::new(&scratch.path("out")).exists());
}

/// A model whose torque is a table in a file of this name.
fn with_table(file: &str) -> String {
    format!(
        r#"{{ "format": "linkdyn/1", "units": "SI", "tables": {{ "gas": {{ "file": {file:?}, "units": ["rad", "N*m"] }} }},
  "bodies": {{ "ground": {{ "points": {{ "O": [0, 0] }} }},
    "rotor": {{ "mass": 1, "inertia": 1, "com": [0, 0], "points": {{ "O": [0, 0] }} }} }},
  "joints": {{ "o": {{ "type": "revolute", "between": ["ground.O", "rotor.O"] }} }},
  "forces": {{ "t": {{ "type": "torque", "body": "rotor", "value": "=gas(rotor.angle)" }} }},
  "analysis": {{ "type": "dynamics", "end": 1, "outputs": 3 }} }}"#
    )
}

#[test]
#[cfg(unix)]
fn a_model_names_files_below_its_own_folder_alone() {
    let scratch = Scratch::new("beside");
    for folder in ["own/sub", "other"] {
        fs::create_dir_all(scratch.path(folder)).expect("made");
    }
    let secret = scratch.write("other/gas.csv", "0,1\nroot:x:0:0\n9,1\n");
    let good = scratch.write("other/good.csv", "0,1\n9,1\n");
    fs::copy(&good, scratch.path("own/sub/gas.csv")).expect("copied");
    std::os::unix::fs::symlink(&good, scratch.path("own/link.csv")).expect("linked");
    std::os::unix::fs::symlink("sub/gas.csv", scratch.path("own/inner.csv")).expect("linked");
    let model = |file: &str| scratch.write("own/model.json", &with_table(file));
    for inside in ["sub/gas.csv", "./sub/gas.csv", "inner.csv"] {
        done(&["run", &model(inside)]);
    }
    let other = scratch.path("other");
    for outside in ["../other/good.csv", "link.csv", &good, "../own/sub/gas.csv"] {
        let said = "the file is not below the model's own folder (put it beside the model, or allow its folder with --allow-files DIR)";
        refused(&["run", &model(outside)], 2, said);
        // nothing is told of what is there, or whether
        let missing = outside.replace("good", "nothing").replace("sub", "none");
        if missing != outside {
            refused(&["run", &model(&missing)], 2, said);
        }
    }
    for outside in ["../other/good.csv", "link.csv", &good] {
        done(&["run", &model(outside), "--allow-files", &other]);
    }
    let ran = refused(
        &["run", &model(&secret), "--allow-files", &other],
        2,
        "line 2",
    );
    assert!(!ran.stderr.contains("root"), "{ran:?}");
    refused(
        &["run", &model("/dev/zero"), "--allow-files", "/dev"],
        2,
        "this is no file",
    );
    let pipe = scratch.path("own/pipe");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()));
    refused(&["run", &model("pipe")], 2, "this is no file");
}

#[test]
#[cfg(target_os = "linux")]
fn a_model_without_end_is_refused() {
    for command in ["run", "check"] {
        let said = "65 MB are too much for a model, at most 64 MB are read";
        refused(&[command, "/dev/zero"], 2, said);
    }
}

#[test]
fn a_table_that_memory_has_no_room_for_is_refused_with_its_size() {
    let said = "analysis.outputs";
    let ran = refused(
        &["run", "four-bar", "--set", "analysis.outputs=10000000"],
        2,
        said,
    );
    assert!(
        ran.stderr.contains("GB, and at most 1 GB are kept"),
        "{ran:?}"
    );
}
