//! `linkdyn edit`: the editor for a model file, in a browser on this computer.

use std::collections::hash_map::DefaultHasher;
use std::fs;
use std::hash::{Hash, Hasher};
use std::io;
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Mutex, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};

use clap::Args;
use linkdyn_ask::{ModelFile, Text, Unanswered, editor};
use linkdyn_engine::analysis::Control;
use linkdyn_model::FileAccess;

use super::exit::{BadInput, Exit, Failure};
use super::interrupt;
use super::serve::Server;
use super::serve::http::{Answer, Request};
use super::streams::remark;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub struct Options {
    /// Path of a model file; one that is not there is begun
    #[arg(value_name = "FILE")]
    model: PathBuf,
    /// The editor's page, where this command was built without it
    #[arg(long, value_name = "HTML")]
    page: Option<PathBuf>,
}

const HELP: &str = "  linkdyn models four-bar > mine.json
  linkdyn edit mine.json

The page is served to this computer alone, at an address with a random key. What is saved there is saved in the file, and what is saved
in the file is shown there.";

#[cfg(has_editor)]
const PAGE: Option<&str> = Some(include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/web/dist/editor.html"
)));
#[cfg(not(has_editor))]
const PAGE: Option<&str> = None;

/// How long a page waits for news of the file before it asks again, and how often the file is looked at.
const WAIT: Duration = Duration::from_secs(20);
const LOOK: Duration = Duration::from_millis(50);
/// A model of more bytes is no model.
const LONGEST: usize = 4 << 20;
const TEXT: &str = "text/plain; charset=utf-8";

/// Serves the page until Ctrl-C.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let page = page(options)?;
    let path = options.model.clone();
    if !path.is_file() && path.extension().is_none_or(|ending| ending != "json") {
        return Err(BadInput(vec![format!(
            "{0}: there is no such file (`linkdyn models NAME > FILE.json` writes a bundled model; a new file is called FILE.json)",
            path.display()
        )]));
    }
    let (asked_last, ran_last) = (Running::default(), Running::default());
    let answers = move |request: &Request, asked: &str| match (request.method.as_str(), asked) {
        ("POST", "ask") => worded(sent(request, &path), &request.query, &asked_last),
        ("POST", "run") => ran(sent(request, &path), &ran_last),
        _ => answer(&page, &path, request, asked),
    };
    let server = Server::start(LONGEST, Box::new(answers));
    let server = server.map_err(|why| BadInput(vec![format!("no page can be served: {why}")]))?;
    remark(&format!(
        "{} edits {}; Ctrl-C ends",
        server.address(),
        options.model.display()
    ));
    let waiting = interrupt::Waiting::start();
    while !waiting.is_interrupted() {
        sleep(LOOK);
    }
    Ok(Exit::Interrupted)
}

/// The page, which may talk with this server.
fn page(options: &Options) -> Result<String, Failure> {
    let page = match (&options.page, PAGE) {
        (Some(path), _) => fs::read_to_string(path)
            .map_err(|why| BadInput(vec![format!("--page {}: {why}", path.display())]))?,
        (None, Some(page)) => page.to_owned(),
        (None, None) => {
            return Err(BadInput(vec![
                "this command was built without the editor's page (give --page editor.html: `node web/build.mjs` makes it as \
                 web/dist/editor.html; `cargo build --features edit` after that builds it in)"
                    .into(),
            ]));
        }
    };
    let name = options.model.file_name().unwrap_or_default();
    let name = name.to_string_lossy().replace(['&', '"', '<', '>'], "_");
    let head = format!("<meta name=\"linkdyn-file\" content=\"{name}\">\n<meta name=\"viewport\"");
    let page = page.replacen("connect-src 'none'", "connect-src 'self'", 1);
    Ok(page.replacen("<meta name=\"viewport\"", &head, 1))
}

fn answer(page: &str, path: &Path, request: &Request, asked: &str) -> Answer {
    match (request.method.as_str(), asked) {
        ("GET", "") => Answer::new(200, "text/html; charset=utf-8", page),
        ("GET", "model") => match fs::read(path) {
            Ok(text) => Answer::new(200, TEXT, text),
            Err(_) => Answer::bare(404),
        },
        ("GET", "state") => {
            let since = Instant::now();
            while version(path) == request.query && since.elapsed() < WAIT {
                sleep(LOOK);
            }
            Answer::new(200, TEXT, version(path))
        }
        // Only over the version that the page knows: what another program has saved stays.
        ("POST", "save") if version(path) != request.query => Answer::bare(409),
        ("POST", "save") => match written(path, &request.body) {
            Ok(()) => Answer::new(200, TEXT, version(path)),
            Err(why) => Answer::new(422, TEXT, why.to_string()),
        },
        (_, "" | "model" | "state" | "save" | "ask" | "run") => Answer::bare(405),
        _ => Answer::bare(404),
    }
}

/// What is computed for the page, of one kind; a newer question ends the one before.
#[derive(Default)]
struct Running(Mutex<Control>);

impl Running {
    fn next(&self) -> Control {
        let next = Control::default();
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let before = mem::replace(&mut *last, next.clone());
        before.interrupted.store(true, Ordering::SeqCst);
        next
    }
}

/// The model that a page has sent.
fn sent(request: &Request, path: &Path) -> Result<ModelFile, Unanswered> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let text = Text::new(
        name.clone().into_owned(),
        name.into_owned(),
        request.body.clone(),
        FileAccess::default(),
    );
    Ok(ModelFile::read(text, Vec::new())?)
}

/// The answer to the question that is named, in words; they say, too, why there is none.
fn worded(sent: Result<ModelFile, Unanswered>, name: &str, running: &Running) -> Answer {
    let control = running.next();
    match sent.and_then(|file| editor::words(&file, name, &control)) {
        Ok(Some(page)) => Answer::new(200, TEXT, page.text()),
        Ok(None) => Answer::bare(404),
        Err(why) => Answer::new(200, TEXT, why.to_string()),
    }
}

/// What a run comes to: a line of JSON with what is drawn, then its numbers, of 8 bytes each, the lowest first.
fn ran(sent: Result<ModelFile, Unanswered>, running: &Running) -> Answer {
    let control = running.next();
    match sent.and_then(|file| editor::drawn(&file, &control)) {
        Ok((file, outcome)) => {
            let (facts, values) = file.origin().numbers(&outcome);
            let mut body = facts.into_bytes();
            body.push(b'\n');
            body.extend(values.iter().flat_map(|value| value.to_le_bytes()));
            Answer::new(200, "application/octet-stream", body)
        }
        Err(why) => Answer::new(422, TEXT, why.to_string()),
    }
}

/// What tells one content of the file from another; `none` where there is no file.
fn version(path: &Path) -> String {
    let Ok(bytes) = fs::read(path) else {
        return "none".into();
    };
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// Writes the file as a whole: who reads it meanwhile finds the old one or the new one.
fn written(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A link stays one.
    let path = &fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let beside = path.with_extension("json.part");
    fs::write(&beside, bytes)?;
    if let Ok(kept) = fs::metadata(path) {
        fs::set_permissions(&beside, kept.permissions())?;
    }
    fs::rename(&beside, path)
}
