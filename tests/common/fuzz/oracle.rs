//! What must hold of a command on a mutant.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use linkdyn::cli::Said;
use linkdyn_engine::analysis::{self, Control};
use linkdyn_model::error::Complaint;
use linkdyn_model::{self, DriverKind, JointKind, Loaded, Model};
use serde_json::Value;

use super::rng::Rng;
use super::runner::{Ran, caught};
use super::{Fuzzer, Mutant};

/// What did not hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Find {
    /// `panic`, `slow`, `words`, …
    pub kind: &'static str,
    pub command: String,
    pub what: String,
}

impl Find {
    /// The same for finds of one cause: without numbers and names.
    pub fn signature(&self) -> String {
        let plain: String = self
            .what
            .chars()
            .filter(|c| !c.is_ascii_digit())
            .take(70)
            .collect();
        format!(
            "{} {} {plain}",
            self.kind,
            self.command.split(' ').next().unwrap_or_default()
        )
    }
}

/// Time over its limit that a run may take, and that of commands without a limit [s].
const MARGIN: f64 = 1.0;
const CHECK: f64 = 2.0;
const PICTURE: f64 = 4.0;
/// Characters of a line that anybody reads.
const LONGEST: usize = 1500;
/// Rows that are wanted at most.
const MOST_ROWS: f64 = 2000.0;

/// Words that no file and no message has: numbers that do not exist.
pub fn odd_words(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    // The reader of JSON says that "JSON knows neither NaN nor Infinity".
    let is_said = text.contains("JSON knows neither");
    words.filter(move |word| !is_said && ["NaN", "nan", "inf", "Infinity"].contains(word))
}

/// How commands ended, for people: by exit status.
pub static ENDS: [AtomicUsize; 5] = [const { AtomicUsize::new(0) }; 5];

/// The same of a page, without the numbers that it holds as Base64, in which any letters may stand.
pub fn odd_words_of_page(page: &str) -> usize {
    let is_data = |text: &str| {
        text.len() > 40
            && text
                .bytes()
                .all(|c| c.is_ascii_alphanumeric() || b"+/=".contains(&c))
    };
    page.split(['"', '`', '<', '>', ' ', '\n'])
        .filter(|text| !is_data(text))
        .map(|text| odd_words(text).count())
        .sum()
}

struct Trial<'f> {
    fuzzer: &'f Fuzzer,
    finds: Vec<Find>,
    /// The input speaks of numbers that do not exist itself.
    odd: bool,
}

impl Trial<'_> {
    fn find(&mut self, kind: &'static str, command: &str, what: impl Into<String>) {
        self.finds.push(Find {
            kind,
            command: command.into(),
            what: what.into(),
        });
    }

    fn path(&self, name: &str) -> String {
        self.fuzzer.scratch.join(name).display().to_string()
    }

    /// Runs a command and looks at what it says; `allowed` besides 0 are its exit statuses.
    fn run(&mut self, arguments: &[String], allowed: &[u8], limit: f64) -> Option<Said> {
        let command = arguments.join(" ");
        match self.fuzzer.runner.run(arguments) {
            Ran::Said(said, time) => {
                self.look(&command, &said, allowed, time, limit);
                Some(said)
            }
            Ran::Panicked(words) => {
                self.find("panic", &command, words);
                None
            }
            Ran::Killed(words) => {
                self.find("signal", &command, words);
                None
            }
        }
    }

    fn look(&mut self, command: &str, said: &Said, allowed: &[u8], time: Duration, limit: f64) {
        ENDS[usize::from(said.status).min(4)].fetch_add(1, Ordering::Relaxed);
        if time.as_secs_f64() > limit + MARGIN {
            self.find("slow", command, format!("{:.1} s", time.as_secs_f64()));
        }
        if said.status == 130 {
            println!("interrupted");
            std::process::exit(130);
        }
        if said.status != 0 && !allowed.contains(&said.status) {
            self.find(
                "status",
                command,
                format!("exit status {}: {}", said.status, said.stderr),
            );
        }
        let lines: Vec<&str> = said.stderr.lines().collect();
        let is_quiet = said.stderr.is_empty();
        if (said.status == 0) != is_quiet {
            self.find(
                "words",
                command,
                format!(
                    "exit status {} and on standard error {:?}",
                    said.status, said.stderr
                ),
            );
        }
        if said.status >= 2 {
            let is_clap =
                said.stderr.contains("Usage:") || said.stderr.contains("For more information");
            if !is_clap
                && !lines
                    .iter()
                    .all(|line| line.starts_with("error: ") && line.len() > 20)
            {
                self.find(
                    "words",
                    command,
                    format!("no clear complaint: {:?}", said.stderr),
                );
            }
        }
        if let Some(line) = said
            .stdout
            .lines()
            .chain(lines.iter().copied())
            .find(|line| line.len() > LONGEST)
        {
            let begin: String = line.chars().take(120).collect();
            self.find(
                "words",
                command,
                format!("a line of {} characters: {begin}", line.len()),
            );
        }
        if !self.odd {
            for text in [&said.stdout, &said.stderr] {
                if let Some(line) = text.lines().find(|line| odd_words(line).next().is_some()) {
                    self.find("nan", command, format!("in words: {line}"));
                }
            }
        }
    }

    fn complaints(&mut self, command: &str, complaints: &[Complaint]) {
        if complaints.is_empty() {
            self.find("words", command, "refused without a complaint");
        }
        for complaint in complaints {
            let whole = ["the file is empty", "and ", "a model is an object"];
            let is_whole = whole
                .iter()
                .any(|begin| complaint.message.starts_with(begin));
            let of_set = complaint
                .found
                .as_deref()
                .is_some_and(|found| found.starts_with("--set"));
            if complaint.path.is_empty() && complaint.place.is_none() && !is_whole && !of_set {
                self.find("place", command, format!("no place: {complaint}"));
            }
            if complaint.message.trim().is_empty() {
                self.find("words", command, format!("no words: {complaint:?}"));
            }
            if complaint
                .message
                .contains("the schema allows what the model does not")
            {
                self.find("schema", command, complaint.to_string());
            }
        }
    }

    /// A table of results: each cell empty or a finite number.
    fn table(&mut self, command: &str, path: &Path, is_complete: bool) -> usize {
        let Ok(text) = fs::read_to_string(path) else {
            self.find("file", command, format!("{}: not there", path.display()));
            return 0;
        };
        let mut reader = csv::ReaderBuilder::new().from_reader(text.as_bytes());
        let header: Vec<String> = reader
            .headers()
            .map(|row| row.iter().map(String::from).collect())
            .unwrap_or_default();
        let is_place = |name: &str| {
            name == "time[s]"
                || !name.starts_with("joint.")
                    && !name.starts_with("driver.")
                    && !name.starts_with("transmission.")
                    && [".x[m]", ".y[m]", ".angle[rad]"]
                        .iter()
                        .any(|end| name.ends_with(end))
        };
        let mut before = f64::NEG_INFINITY;
        let mut rows = 0;
        for row in reader.records() {
            let Ok(row) = row else {
                self.find(
                    "file",
                    command,
                    format!("row {rows} has not the cells of the header"),
                );
                break;
            };
            rows += 1;
            for (cell, name) in row.iter().zip(&header) {
                let is_number = cell.parse::<f64>().is_ok_and(f64::is_finite);
                if !is_number && (!cell.is_empty() || is_complete && is_place(name)) {
                    self.find(
                        "nan",
                        command,
                        format!(
                            "{name} is {cell:?} in row {rows} of {}",
                            if is_complete {
                                "a complete run"
                            } else {
                                "a run"
                            }
                        ),
                    );
                    return rows;
                }
            }
            let time = row
                .get(0)
                .and_then(|cell| cell.parse::<f64>().ok())
                .unwrap_or(f64::NAN);
            if time < before {
                self.find("file", command, format!("time goes back in row {rows}"));
                return rows;
            }
            before = time;
        }
        rows
    }

    fn json(&mut self, command: &str, text: &str) -> Option<Value> {
        let read = serde_json::from_str(text);
        if let Err(error) = &read {
            self.find("file", command, format!("no JSON: {error}"));
        }
        read.ok()
    }

    /// All that `run -o` leaves; the number of rows.
    fn files(&mut self, command: &str, said: &Said, folder: &Path) -> usize {
        let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap_or_default();
        let Some(summary) = self.json(command, &read("summary.json")) else {
            return 0;
        };
        let status = summary["status"].as_str().unwrap_or_default().to_string();
        if status.starts_with("completed") != (said.status == 0) {
            self.find(
                "status",
                command,
                format!("exit status {} of a run that is {status}", said.status),
            );
        }
        let rows = self.table(command, &folder.join("results.csv"), status == "completed");
        if status == "completed" && rows == 0 {
            self.find("file", command, "a completed run without rows");
        }
        let report = read("report.html");
        let odd = odd_words_of_page(&report);
        if !self.odd && odd > self.fuzzer.odd_in_report {
            self.find(
                "nan",
                command,
                format!("{odd} words like NaN in report.html"),
            );
        }
        if !self.odd && odd_words(&read("summary.json")).next().is_some() {
            self.find("nan", command, "in summary.json");
        }
        if !report.ends_with("</html>\n") && !report.trim_end().ends_with("</html>") {
            self.find("file", command, "report.html has no end");
        }
        rows
    }

    /// Figures and films of results.
    fn pictures(&mut self, rng: &mut Rng, results: &str) {
        let file = self.path(["figure.svg", "figure.png"][rng.below(2)]);
        let columns = rng.word(&[
            "*",
            "*.x",
            "*.angle",
            "joint.*.fx",
            "time",
            "*.omega",
            "*.effort",
            "d*",
        ]);
        let mut arguments: Vec<String> = ["plot", results, "--y", columns, "-o", &file]
            .map(String::from)
            .into();
        for (times, more) in [
            (3, &["--log-y"][..]),
            (4, &["--grid", "--events"]),
            (4, &["--units", "deg,mm,kN"]),
            (5, &["--log-x"]),
            (5, &["--x", "*.angle"]),
        ] {
            if rng.once_in(times) {
                arguments.extend(more.iter().map(|word| word.to_string()));
            }
        }
        self.picture(&arguments, &file);
        let file = self.path(["motion.svg", "motion.png", "motion.gif"][rng.below(3)]);
        let mut arguments: Vec<String> = ["animate", results, "-o", &file].map(String::from).into();
        if file.ends_with("gif") {
            arguments
                .extend(["--fps", "10", "--duration", "0.4", "--width", "160"].map(String::from));
        } else if rng.once_in(2) {
            arguments.extend(["--strip", "--poses", "3"].map(String::from));
        }
        self.picture(&arguments, &file);
    }

    fn picture(&mut self, arguments: &[String], file: &str) {
        let _ = fs::remove_file(file);
        let Some(said) = self.run(arguments, &[2], PICTURE) else {
            return;
        };
        let command = arguments.join(" ");
        match fs::read(file) {
            Ok(content) if said.status == 0 => {
                let text = if file.ends_with("svg") {
                    String::from_utf8_lossy(&content)
                } else {
                    "".into()
                };
                if content.is_empty() || !self.odd && odd_words(&text).next().is_some() {
                    self.find("nan", &command, "in a figure");
                }
            }
            Ok(_) => self.find("file", &command, "a figure, and a fault"),
            Err(_) if said.status == 0 => self.find("file", &command, "no figure, and no fault"),
            Err(_) => {}
        }
    }
}

/// Whether the input itself has words like NaN.
fn is_odd(mutant: &Mutant) -> bool {
    let files =
        [&mutant.bytes, &mutant.summary].map(|bytes| String::from_utf8_lossy(bytes).to_lowercase());
    let all = [&files[..], &[mutant.sets.join(" ").to_lowercase()]].concat();
    all.iter()
        .any(|text| text.contains("nan") || text.contains("inf"))
}

/// A mutant of a model.
pub fn model(fuzzer: &Fuzzer, mut rng: Rng, mutant: &Mutant) -> Vec<Find> {
    let mut trial = Trial {
        fuzzer,
        finds: Vec::new(),
        odd: is_odd(mutant),
    };
    let file = trial.path("mutant.json");
    let _ = fs::write(&file, &mutant.bytes);
    let loaded = match caught(|| linkdyn_model::load(&mutant.bytes, &mutant.sets)) {
        Ok(loaded) => loaded,
        Err(words) => {
            trial.find("panic", "load", words);
            return trial.finds;
        }
    };
    let mut base = vec![file];
    base.extend(
        mutant
            .sets
            .iter()
            .flat_map(|set| ["--set".to_string(), set.clone()]),
    );
    let with = |first: &str, more: &[String], last: &[&str]| -> Vec<String> {
        let sets = more
            .iter()
            .flat_map(|set| ["--set".to_string(), set.clone()]);
        let last = last.iter().map(|word| word.to_string());
        std::iter::once(first.to_string())
            .chain(base.iter().cloned())
            .chain(sets)
            .chain(last)
            .collect()
    };
    let loaded = match loaded {
        Ok(loaded) => loaded,
        Err(complaints) => {
            trial.complaints("load", &complaints);
            if rng.once_in(8)
                && let Some(said) = trial.run(&with("check", &[], &[]), &[2], CHECK)
                && said.status != 2
            {
                trial.find(
                    "status",
                    "check",
                    format!("exit status {} of a model that is refused", said.status),
                );
            }
            return trial.finds;
        }
    };
    if let Some(said) = trial.run(
        &with("check", &[], if rng.once_in(2) { &["--json"] } else { &[] }),
        &[1, 2, 3],
        CHECK,
    ) && said.stdout.starts_with('{')
    {
        trial.json("check --json", &said.stdout);
    }
    if loaded.model.analysis.is_some() {
        let sets = limits(fuzzer.limit, &loaded);
        run(&mut trial, &mut rng, &with, &sets, &loaded);
    }
    if rng.once_in(2) {
        let kind = rng.word(&[
            "assembly",
            "kinematics",
            "inverse_dynamics",
            "dynamics",
            "statics",
        ]);
        let end = [0.01, 0.3, 2.0][rng.below(3)];
        let analysis = format!(
            "analysis={{\"type\":\"{kind}\",\"end\":\"{end} s\",\"outputs\":12,\"solver\":{{\"max_wall_time\":\"{} s\"}}}}",
            fuzzer.limit
        );
        run(&mut trial, &mut rng, &with, &[analysis], &loaded);
    }
    if rng.once_in(3) {
        let folder = trial.path("modes");
        let all = ["-o", folder.as_str(), "--pose"];
        let arguments = with("modes", &[], if rng.once_in(3) { &all } else { &all[..2] });
        if let Some(said) = trial.run(&arguments, &[2, 3], CHECK)
            && said.status == 0
        {
            trial.table("modes", &Path::new(&folder).join("modes.csv"), true);
        }
    }
    if rng.once_in(4) && has_clearance(&loaded.model) && loaded.model.analysis.is_some() {
        let folder = trial.path("compared");
        let _ = fs::remove_dir_all(&folder);
        let arguments = with(
            "compare",
            &limits(fuzzer.limit, &loaded),
            &["--joint", "all", "-o", &folder],
        );
        if let Some(said) = trial.run(&arguments, &[2, 3], 5.0 * fuzzer.limit)
            && said.status != 2
        {
            trial.table("compare", &Path::new(&folder).join("compare.csv"), false);
            let text =
                fs::read_to_string(Path::new(&folder).join("compare.json")).unwrap_or_default();
            trial.json("compare", &text);
        }
    }
    trial.finds
}

fn has_clearance(model: &Model) -> bool {
    model.joints.values().any(|joint| {
        matches!(
            &joint.kind,
            JointKind::Revolute {
                clearance: Some(_),
                ..
            }
        )
    })
}

/// A limit of time, and of rows where there would be very many.
fn limits(limit: f64, loaded: &Loaded) -> Vec<String> {
    let mut sets = vec![format!("analysis.solver.max_wall_time=\"{limit} s\"")];
    let Some(analysis) = &loaded.model.analysis else {
        return sets;
    };
    if analysis
        .outputs
        .is_some_and(|outputs| outputs as f64 > MOST_ROWS)
    {
        sets.push("analysis.outputs=101".into());
    }
    if let Some(sample) = &analysis.sample {
        let rows = ((sample.to - sample.from) / sample.step).abs();
        if rows > MOST_ROWS {
            let step = sample.step.abs() * rows / 100.0;
            let unit = if loaded
                .model
                .drivers
                .get(&sample.driver)
                .is_some_and(|driver| matches!(driver.kind, DriverKind::Rotation { .. }))
            {
                "rad"
            } else {
                "m"
            };
            sets.push(format!("analysis.sample.step=\"{step:e} {unit}\""));
        }
    }
    sets
}

/// `run -o`, its files, and sometimes pictures of them.
fn run(
    trial: &mut Trial,
    rng: &mut Rng,
    with: &impl Fn(&str, &[String], &[&str]) -> Vec<String>,
    sets: &[String],
    loaded: &Loaded,
) {
    let folder = trial.path("out");
    for name in ["results.csv", "summary.json", "report.html"] {
        let _ = fs::remove_file(Path::new(&folder).join(name));
    }
    let arguments = with("run", sets, &["-o", &folder]);
    let Some(said) = trial.run(&arguments, &[2, 3], trial.fuzzer.limit) else {
        return;
    };
    if said.status == 2 {
        // The complaints of an analysis are those of the command.
        if let Ok(Err(complaints)) = caught(|| {
            analysis::run(
                &loaded.model,
                &Control {
                    interrupted: std::sync::Arc::new(true.into()),
                    ..Control::default()
                },
            )
        }) {
            trial.complaints("run", &complaints);
        }
        return;
    }
    let rows = trial.files(&arguments.join(" "), &said, Path::new(&folder));
    if rows > 0 && rng.once_in(6) {
        trial.pictures(rng, &folder);
    }
}

/// A mutant of results.
pub fn results(fuzzer: &Fuzzer, mut rng: Rng, mutant: &Mutant) -> Vec<Find> {
    let mut trial = Trial {
        fuzzer,
        finds: Vec::new(),
        odd: is_odd(mutant),
    };
    let folder = trial.path("results");
    let _ = fs::create_dir_all(&folder);
    let _ = fs::write(Path::new(&folder).join("results.csv"), &mutant.bytes);
    let _ = fs::write(Path::new(&folder).join("summary.json"), &mutant.summary);
    trial.pictures(&mut rng, &folder);
    trial.finds
}
