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
