//! The guide (`docs/*.md`): its models load and run, its commands do what it shows.
//!
//! In each page, in order: a `json` block with `format` is a model, kept as `file:…` where that is said; one without is a
//! piece that is put into the last model; a `text` may be kept as a file, too. Of a `console` block each line `$ …` is run, and the lines below it must be
//! found, in that order, in what it tells; `…` stands for anything. `exit:…` is the exit status wanted.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use linkdyn_engine::analysis::{Control, run};
use linkdyn_output::Status;
use serde_json::Value;

struct Block {
    line: usize,
    /// Words behind the opening fence.
    words: Vec<String>,
    body: String,
}

impl Block {
    /// The value of `key:…` behind the fence.
    fn word(&self, key: &str) -> Option<&str> {
        self.words
            .iter()
            .find_map(|word| word.strip_prefix(key)?.strip_prefix(':'))
    }
}

fn blocks(text: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut open = false;
    for (index, line) in text.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(words) => {
                open = true;
                let words = words.split([' ', ',']).map(String::from).collect();
                blocks.push(Block {
                    line: index + 1,
                    words,
                    body: String::new(),
                });
            }
            None if open => {
                let body = &mut blocks.last_mut().expect("open").body;
                body.push_str(line);
                body.push('\n');
            }
            None => {}
        }
    }
    assert!(!open, "a block is not closed");
    blocks
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

/// Loads a model without any warning and runs its analysis to the end.
fn sound(text: &str, place: &str) {
    let loaded = linkdyn_model::load(text.as_bytes(), &[])
        .unwrap_or_else(|said| panic!("{place}: {}", said[0]));
    assert!(loaded.warnings.is_empty(), "{place}: {:?}", loaded.warnings);
    let outcome = run(&loaded.model, &Control::default())
        .unwrap_or_else(|said| panic!("{place}: {}", said[0]));
    assert_eq!(
        (outcome.report.status, outcome.report.warnings),
        (Status::Completed, Vec::new()),
        "{place}"
    );
}

/// The words of a command line, as a shell splits it.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for c in line.chars() {
        match (c, quote) {
            ('"' | '\'', None) => quote = Some(c),
            (c, Some(open)) if c == open => quote = None,
            (' ', None) => words.push(String::new()),
            (c, _) => words.last_mut().expect("one").push(c),
        }
    }
    words
}

/// Runs a command in a folder: what it tells, and its exit status.
fn execute(command: &str, folder: &Path) -> (String, Option<i32>) {
    let words = words(command);
    match words[0].as_str() {
        "cat" => (
            fs::read_to_string(folder.join(&words[1])).expect("readable"),
            Some(0),
        ),
        "linkdyn" => {
            let mut process = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
            let output = process
                .args(&words[1..])
                .current_dir(folder)
                .stdin(Stdio::null())
                .output()
                .expect("runs");
            let told = [output.stdout, output.stderr].concat();
            (
                String::from_utf8(told).expect("UTF-8"),
                output.status.code(),
            )
        }
        other => panic!("{other}: no command of the guide"),
    }
}

/// Whether a line is as shown, `…` standing for anything.
fn is_as_shown(line: &str, shown: &str) -> bool {
    let mut rest = line.trim();
    let parts: Vec<&str> = shown.trim().split('…').collect();
    for (index, part) in parts.iter().enumerate() {
        match rest.find(part) {
            Some(at) if index > 0 || at == 0 => rest = &rest[at + part.len()..],
            Some(_) | None => return false,
        }
    }
    rest.is_empty() || parts.last().is_some_and(|last| last.is_empty())
}

/// Runs the commands of a block; how many.
fn console(block: &Block, folder: &Path, place: &str) -> usize {
    let wanted: i32 = block
        .word("exit")
        .map_or(0, |exit| exit.parse().expect("a number"));
    let commands: Vec<&str> = block
        .body
        .split("$ ")
        .filter(|part| !part.trim().is_empty())
        .collect();
    for command in &commands {
        let (line, shown) = command.split_once('\n').expect("a line");
        let (told, exit) = execute(line, folder);
        assert_eq!(exit, Some(wanted), "{place}: {line}\n{told}");
        let mut lines = told.lines();
        for shown in shown.lines().filter(|shown| !shown.trim().is_empty()) {
            assert!(
                lines.any(|line| is_as_shown(line, shown)),
                "{place}: {line}\n  lacks {shown}\n{told}"
            );
        }
    }
    commands.len()
}

fn pages() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let entries = fs::read_dir(folder)
        .expect("docs")
        .map(|entry| entry.expect("readable").path());
    let mut pages: Vec<_> = entries
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .collect();
    pages.sort();
    pages
}

#[test]
fn what_the_guide_shows_is_so() {
    let (mut models, mut pieces, mut commands) = (0, 0, 0);
    for page in pages() {
        let name = page
            .file_stem()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("guide-{}-{name}", std::process::id()));
        fs::create_dir_all(&folder).expect("a scratch directory");
        let mut last = Value::Null;
        for block in blocks(&fs::read_to_string(&page).expect("readable")) {
            let place = format!("{name}.md, line {}", block.line);
            match block.words[0].as_str() {
                "json" => {
                    let mut value: Value = serde_json::from_str(&block.body)
                        .unwrap_or_else(|e| panic!("{place}: {e}"));
                    let is_model = value.get("format").is_some();
                    if is_model {
                        last = value.clone();
                        models += 1;
                    } else {
                        let mut whole = last.clone();
                        put(&mut whole, value);
                        value = whole;
                        pieces += 1;
                    }
                    if let Some(file) = block.word("file") {
                        let text = if is_model {
                            block.body.clone()
                        } else {
                            value.to_string()
                        };
                        fs::write(folder.join(file), text).expect("written");
                    }
                    sound(
                        &if is_model {
                            block.body
                        } else {
                            value.to_string()
                        },
                        &place,
                    );
                }
                "console" => commands += console(&block, &folder, &place),
                // doctests are run by rustdoc; texts are formulas, or files
                "rust" => {}
                "text" => {
                    if let Some(file) = block.word("file") {
                        fs::write(folder.join(file), &block.body).expect("written");
                    }
                }
                other => panic!("{place}: {other:?} is no kind of block"),
            }
        }
        fs::remove_dir_all(&folder).expect("removed");
    }
    assert!(
        models >= 2 && pieces >= 10 && commands >= 20,
        "{models} models, {pieces} pieces, {commands} commands"
    );
}

#[test]
fn lines_are_compared_as_a_reader_would() {
    for (line, shown, same) in [
        ("  a b", "a b", true),
        ("a b c", "a …", true),
        ("a b c", "… c", true),
        ("a b c", "a … c", true),
        ("a b c", "a b", false),
        ("a b c", "b c", false),
        ("a b c", "a … d", false),
    ] {
        assert_eq!(is_as_shown(line, shown), same, "{line:?} {shown:?}");
    }
}
