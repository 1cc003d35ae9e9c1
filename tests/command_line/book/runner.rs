//! Runs what a page shows, in a folder of its own.

use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use linkdyn_engine::analysis::{Control, run};
use linkdyn_output::Status;
use serde_json::Value;

use super::blocks::{Block, blocks, is_as_shown, words};

/// Commands of a page that tests do not run: they build this repository, test it, or measure it.
const NOT_RUN: [&str; 9] = [
    "cargo test --release",
    "cargo install --path . --locked --profile dist --features dist",
    "cargo bench --bench six_bar",
    "cargo bench --bench dynamics",
    "cargo bench --bench contact",
    "cargo bench --bench stiff",
    "cargo bench --bench jams",
    "cargo bench --bench linear",
    "cargo bench --bench accuracy",
];

/// What a page had.
#[derive(Debug, Default, Clone, Copy)]
pub struct Tally {
    pub models: usize,
    pub pieces: usize,
    pub commands: usize,
}

/// A page while its blocks are run.
struct Page {
    name: String,
    folder: PathBuf,
    /// The model that pieces are put into.
    last: Value,
    tally: Tally,
}

/// Runs a page from its first block to its last.
pub fn run_page(path: &Path) -> Tally {
    let stem = path.file_stem().expect("a name").to_string_lossy();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!(
        "book-{}-{}-{stem}",
        std::process::id(),
        path.components().count()
    ));
    fs::create_dir_all(&folder).expect("a scratch directory");
    let mut page = Page {
        name: path.file_name().expect("a name").to_string_lossy().into(),
        folder,
        last: Value::Null,
        tally: Tally::default(),
    };
    for block in blocks(&fs::read_to_string(path).expect("readable")) {
        page.run(&block);
    }
    fs::remove_dir_all(&page.folder).expect("removed");
    page.tally
}

impl Page {
    fn run(&mut self, block: &Block) {
        let place = format!("{}, line {}", self.name, block.line);
        match block.words[0].as_str() {
            "json" => self.model(block, &place),
            "console" => self.console(block, &place),
            "sh" => self.commands(block, &place),
            "python" => self.python(block, &place),
            // Doctests are run by rustdoc, and by `python/tests`.
            "rust" | "pycon" => {}
            // Formulas, or files.
            "text" => {
                if let Some(file) = block.word("file") {
                    fs::write(self.folder.join(file), &block.body).expect("written");
                }
            }
            other => panic!("{place}: {other:?} is no kind of block"),
        }
    }

    /// A model, or a piece that is put into the last one.
    fn model(&mut self, block: &Block, place: &str) {
        let value: Value =
            serde_json::from_str(&block.body).unwrap_or_else(|e| panic!("{place}: {e}"));
        let text = if value.get("format").is_some() {
            self.tally.models += 1;
            if !block.is("apart") {
                self.last = value;
            }
            block.body.clone()
        } else {
            let mut whole = self.last.clone();
            put(&mut whole, value);
            self.tally.pieces += 1;
            whole.to_string()
        };
        if let Some(file) = block.word("file") {
            fs::write(self.folder.join(file), &text).expect("written");
        }
        sound(&text, place);
    }

    /// Commands with what they tell below them.
    fn console(&mut self, block: &Block, place: &str) {
        let wanted: i32 = block
            .word("exit")
            .map_or(0, |exit| exit.parse().expect("a number"));
        let commands = block
            .body
            .split("$ ")
            .filter(|part| !part.trim().is_empty());
        for command in commands {
            let (line, shown) = command.split_once('\n').expect("a line");
            let (told, exit) = self.execute(line);
            assert_eq!(exit, Some(wanted), "{place}: {line}\n{told}");
            let mut lines = told.lines();
            for shown in shown.lines().filter(|shown| !shown.trim().is_empty()) {
                assert!(
                    lines.any(|line| is_as_shown(line, shown)),
                    "{place}: {line}\n  lacks {shown}\n{told}"
                );
            }
            self.tally.commands += 1;
        }
    }

    /// Commands that end well.
    fn commands(&mut self, block: &Block, place: &str) {
        for line in block.body.lines().filter(|line| !NOT_RUN.contains(line)) {
            let line = line.replace("cargo run --release -- ", "linkdyn ");
            if line.ends_with(" --watch") {
                self.watch(&line);
            } else {
                let (told, exit) = self.execute(&line);
                assert_eq!(exit, Some(0), "{place}: {line}\n{told}");
            }
            self.tally.commands += 1;
        }
    }

    /// Runs a command: what it tells, and its exit status.
    fn execute(&self, command: &str) -> (String, Option<i32>) {
        let (command, file) = match command.split_once(" > ") {
            Some((command, file)) => (command, Some(file)),
            None => (command, None),
        };
        let mut words = words(command);
        match words[0].as_str() {
            "cat" => {
                let text = fs::read_to_string(self.folder.join(&words[1]));
                (text.expect("readable"), Some(0))
            }
            "linkdyn" => {
                if command == "linkdyn validate" {
                    // Every case is run by `tests/evidence`, once; here some of them, of both kinds.
                    words.extend(["four-bar", "four-bar-spring"].map(String::from));
                }
                let mut process = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
                process
                    .args(&words[1..])
                    .current_dir(&self.folder)
                    .stdin(Stdio::null());
                if let Some(file) = file {
                    process.stdout(File::create(self.folder.join(file)).expect("writable"));
                }
                let output = process.output().expect("runs");
                let told = [output.stdout, output.stderr].concat();
                let told = String::from_utf8(told).expect("UTF-8");
                (told, output.status.code())
            }
            other => panic!("{other}: no command of a page"),
        }
    }

    /// A command that waits for changes, until it waits.
    fn watch(&self, command: &str) {
        let mut child = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
            .args(&words(command)[1..])
            .current_dir(&self.folder)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("runs");
        let said = BufReader::new(child.stderr.take().expect("piped"));
        let first = said.lines().next().and_then(Result::ok);
        child.kill().expect("ended");
        child.wait().expect("ended");
        assert!(
            first
                .as_ref()
                .is_some_and(|line| line.starts_with("watching ")),
            "{first:?}"
        );
    }

    /// A program, where there is a Python that has pandas; it must end well and print something.
    fn python(&mut self, block: &Block, place: &str) {
        let python = |program: &str| {
            let binary = Path::new(env!("CARGO_BIN_EXE_linkdyn"));
            let own = binary.parent().expect("a folder").to_path_buf();
            let path = std::env::var_os("PATH").unwrap_or_default();
            let path = std::iter::once(own).chain(std::env::split_paths(&path));
            Command::new("python3")
                .args(["-c", program])
                .env("PATH", std::env::join_paths(path).expect("a path"))
                .env("PYTHONIOENCODING", "utf-8")
                .current_dir(&self.folder)
                .output()
        };
        if !python("import pandas").is_ok_and(|output| output.status.success()) {
            eprintln!("{place}: not run, since there is no Python with pandas");
            return;
        }
        let output = python(&block.body).expect("runs");
        let told = String::from_utf8_lossy(&output.stdout);
        let faults = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{place}: {faults}");
        assert!(!told.is_empty() && !told.contains("nan"), "{place}: {told}");
        println!("{told}");
    }
}

/// Puts a piece into a model: objects into objects, the rest in place of what was there; null takes it out.
fn put(into: &mut Value, piece: Value) {
    match (into, piece) {
        (Value::Object(into), Value::Object(piece)) => {
            for (key, value) in piece {
                if value.is_null() {
                    into.shift_remove(&key);
                } else {
                    put(into.entry(key).or_insert(Value::Null), value);
                }
            }
        }
        (into, piece) => *into = piece,
    }
}

/// Loads a model without any warning and runs its analysis to the end; a task, which has no bodies, is loaded alone.
fn sound(text: &str, place: &str) {
    let loaded = linkdyn_model::load(text.as_bytes(), &[])
        .unwrap_or_else(|said| panic!("{place}: {}", said[0]));
    assert!(loaded.warnings.is_empty(), "{place}: {:?}", loaded.warnings);
    if loaded.model.bodies.is_empty() {
        return;
    }
    let outcome = run(&loaded.model, &Control::default())
        .unwrap_or_else(|said| panic!("{place}: {}", said[0]));
    assert_eq!(
        (outcome.report.status, outcome.report.warnings),
        (Status::Completed, Vec::new()),
        "{place}"
    );
}
