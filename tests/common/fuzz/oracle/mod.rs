//! What must hold of a command on a mutant.

mod files;
mod models;
mod pictures;

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use linkdyn::cli::Said;
use linkdyn_model::error::Complaint;

pub use models::model;

use super::rng::Rng;
use super::runner::Ran;
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

/// Time over its limit that a run may take [s].
const MARGIN: f64 = 1.0;
/// Characters of a line that anybody reads.
const LONGEST: usize = 1500;

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
    pub fn find(&mut self, kind: &'static str, command: &str, what: impl Into<String>) {
        self.finds.push(Find {
            kind,
            command: command.into(),
            what: what.into(),
        });
    }

    pub fn path(&self, name: &str) -> String {
        self.fuzzer.scratch.join(name).display().to_string()
    }

    /// Runs a command and looks at what it says; `allowed` besides 0 are its exit statuses.
    pub fn run(&mut self, arguments: &[String], allowed: &[u8], limit: f64) -> Option<Said> {
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

    pub fn complaints(&mut self, command: &str, complaints: &[Complaint]) {
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
}

/// Whether the input itself has words like NaN.
fn is_odd(mutant: &Mutant) -> bool {
    let files =
        [&mutant.bytes, &mutant.summary].map(|bytes| String::from_utf8_lossy(bytes).to_lowercase());
    let all = [&files[..], &[mutant.sets.join(" ").to_lowercase()]].concat();
    all.iter()
        .any(|text| text.contains("nan") || text.contains("inf"))
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
