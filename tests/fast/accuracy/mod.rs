//! What tolerances and clearances do to outputs: against references with 40 digits, and by laws that hold for all models.

mod complaints;
mod farthest;
mod forces;
mod laws;
#[path = "../../common/accuracy/linkages/mod.rs"]
mod linkages;
mod needed;
#[path = "../../common/accuracy/newton.rs"]
mod newton;
mod orders;
mod references;
#[path = "../../common/accuracy/samples.rs"]
mod samples;
mod sensitivities;
mod spread;
#[path = "../../common/accuracy/told.rs"]
pub mod told;
mod within;

use std::ffi::OsString;
use std::path::PathBuf;

use linkdyn::cli::captured;
use serde_json::Value;

/// Path of a file of the repository.
fn file(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// `linkdyn accuracy MODEL --json` with values set.
fn asked(model: &str, sets: &[String]) -> Value {
    let mut words: Vec<OsString> = ["linkdyn", "accuracy", model, "--json"]
        .map(Into::into)
        .into();
    for set in sets {
        words.extend(["--set".into(), set.into()]);
    }
    let said = captured(words);
    assert_eq!(said.status, 0, "{model} {sets:?}: {}", said.stderr);
    serde_json::from_str(&said.stdout).expect("JSON")
}

/// A clearance of radius c \[m\] in joints.
fn clearances<'a>(joints: impl IntoIterator<Item = &'a String>, c: f64) -> Vec<String> {
    let set =
        |joint| format!("joints.{joint}.clearance={{\"model\":\"ideal\",\"radius\":\"{c:e} m\"}}");
    joints.into_iter().map(set).collect()
}

/// Exit status of `linkdyn accuracy` on a model of this text, and what it complains of.
fn asked_in_vain(number: usize, text: &str, options: &[&str]) -> (u8, String) {
    let name = format!("linkdyn-accuracy-{}-{number}.json", std::process::id());
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, text).expect("a file");
    let mut words: Vec<OsString> = ["linkdyn", "accuracy"].map(Into::into).into();
    words.push(path.clone().into());
    words.extend(options.iter().map(Into::into));
    let said = captured(words);
    std::fs::remove_file(&path).expect("a file");
    let own = format!("error: {}: ", path.display());
    let lines = said.stderr.lines().map(|line| line.replace(&own, ""));
    let lines: Vec<String> = lines.collect();
    (said.status, lines.join("\n"))
}
