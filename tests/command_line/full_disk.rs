//! A disk that is full: the model that would be written over stays as it was, and the command says so.

use crate::browser::Scratch;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

/// The four-bar with costs, more than a disk of 512 bytes takes.
fn model() -> String {
    let text = include_str!("../../models/four-bar.json");
    let mut model: serde_json::Value = serde_json::from_str(text).expect("JSON");
    model["parameters"]["crank"] =
        serde_json::json!({ "value": "100 mm", "cost": "1 mm", "tolerance": "0.1 mm" });
    model["responses"] = serde_json::json!({ "most": "max(rocker.angle)" });
    model["accuracy"] = serde_json::json!({ "outputs": { "rocker": {
        "column": "rocker.angle", "at": { "value": "60 deg" }, "limits": ["-0.05 deg", "0.05 deg"] } } });
    model.to_string()
}

#[test]
fn a_model_stays_whole_where_it_can_not_be_written() {
    let scratch = Scratch::new("full-disk");
    let path = scratch.0.join("mine.json");
    let old = model();
    for asked in [
        "allocate mine.json --write mine.json",
        "optimise mine.json --vary crank --goal 'most = 130 deg' --write mine.json",
    ] {
        fs::write(&path, &old).expect("a model");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o604)).expect("set");
        let run = |limit: &str| {
            let binary = env!("CARGO_BIN_EXE_linkdyn");
            let script = format!("trap '' XFSZ; {limit} exec {binary} {asked}");
            let mut shell = Command::new("sh");
            let ran = shell.args(["-c", &script]).current_dir(&scratch.0).output();
            ran.expect("a shell")
        };
        let ran = run("ulimit -f 1;");
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert!(
            said.starts_with("error: mine.json: can't be written: ")
                && said.ends_with("(the file is as it was)\n"),
            "{asked}: {said}"
        );
        assert_ne!(ran.status.code(), Some(0), "{asked}");
        assert_eq!(fs::read_to_string(&path).expect("there"), old, "{asked}");
        let ran = run("");
        assert_eq!(ran.status.code(), Some(0), "{asked}: {ran:?}");
        let new = fs::read_to_string(&path).expect("there");
        assert!(new != old && serde_json::from_str::<serde_json::Value>(&new).is_ok());
        let mode = fs::metadata(&path).expect("there").permissions().mode();
        assert_eq!(mode & 0o777, 0o604, "{asked}");
        let left = fs::read_dir(&scratch.0).expect("a folder").count();
        assert_eq!(left, 1, "{asked}: nothing else is left");
    }
}
