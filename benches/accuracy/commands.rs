//! What users wait for: `linkdyn accuracy` beside `linkdyn run`, as whole processes, without and with the files that they write.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Rounds of processes.
const ROUNDS: usize = 15;

/// A directory of its own, gone at the end.
pub struct Place(PathBuf);

impl Place {
    pub fn new(name: &str) -> Place {
        let own = format!("linkdyn-accuracy-{}-{name}", std::process::id());
        let path = std::env::temp_dir().join(own);
        fs::create_dir_all(&path).expect("a directory");
        Place(path)
    }

    fn model(&self, name: &str, model: &Value) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, model.to_string()).expect("a file");
        path
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Seconds of a command; what it writes goes into a directory.
fn seconds(question: &str, model: &Path, directory: Option<&Path>) -> f64 {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg(question).arg(model).stdin(Stdio::null());
    if let Some(directory) = directory {
        command.arg("-o").arg(directory);
    }
    let start = Instant::now();
    let output = command.output().expect("the binary runs");
    let seconds = start.elapsed().as_secs_f64();
    assert!(output.status.success(), "{question}: {output:?}");
    seconds
}

/// What commands cost.
pub struct Waits {
    /// The run, median \[s\].
    pub run: f64,
    /// In such runs: one output, another one, the mean of all.
    pub costs: [Vec<f64>; 3],
}

/// Times of a run and of the same model asked for one output and for `count`, beside each other, without and with files.
pub fn waits(place: &Place, plain: &Value, [one, all]: [&Value; 2], count: usize) -> [Waits; 2] {
    let plain = place.model("plain.json", plain);
    let [one, all] =
        [("one.json", one), ("all.json", all)].map(|(name, own)| place.model(name, own));
    let [of_run, of_accuracy] = ["run", "accuracy"].map(|own| place.0.join(own));
    [false, true].map(|writes| {
        let into = |directory| writes.then_some(directory);
        let mut runs = Vec::with_capacity(ROUNDS);
        let mut costs: [Vec<f64>; 3] = Default::default();
        for _ in 0..ROUNDS {
            let run = seconds("run", &plain, into(of_run.as_path()));
            let [first, whole] =
                [&one, &all].map(|own| seconds("accuracy", own, into(of_accuracy.as_path())));
            runs.push(run);
            costs[0].push(first / run);
            costs[1].push((whole - first) / (count - 1) as f64 / run);
            costs[2].push(whole / count as f64 / run);
        }
        Waits {
            run: super::median(&mut runs),
            costs,
        }
    })
}
