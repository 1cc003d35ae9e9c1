//! A headless browser that opens a page and answers questions.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use serde_json::Value;
use sha2::{Digest, Sha256};

const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// What a page came to.
#[derive(Debug)]
pub struct Visit {
    /// The document at the end.
    pub dom: String,
    /// Lines of the console: errors, refused scripts, anything.
    pub console: Vec<String>,
}

/// A directory of its own, removed at the end.
pub struct Scratch(pub PathBuf);

impl Scratch {
    pub fn new(name: &str) -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("{name}-{}-{number}", std::process::id()));
        fs::create_dir_all(&path).expect("a scratch directory");
        Scratch(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The browser's path; none, and a word about it, where there is none. On the gate that is a failure.
pub fn find() -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let found = std::env::split_paths(&folders)
        .flat_map(|folder| NAMES.map(|name| folder.join(name)))
        .find(|p| p.is_file());
    if found.is_none() {
        assert!(
            std::env::var("CI").as_deref() != Ok("true"),
            "no Chromium: the report can't be tested"
        );
        eprintln!("skipped: no Chromium is installed");
    }
    found
}

/// The browser, ready to open a file, with a profile of its own in a folder.
pub fn command(browser: &Path, folder: &Path) -> Command {
    let mut command = Command::new(browser);
    command.args([
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-quic",
        "--no-first-run",
    ]);
    command.args([
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
    ]);
    command.args(["--enable-logging=stderr", "--window-size=1280,900"]);
    command.arg(format!(
        "--user-data-dir={}",
        folder.join("profile").display()
    ));
    command.stdin(Stdio::null());
    command
}

/// Opens a page; `budget` milliseconds of virtual time pass, or the page's loading alone where there is none.
pub fn open(browser: &Path, page: &str, budget: Option<u32>) -> Visit {
    let scratch = Scratch::new("browser");
    let file = scratch.0.join("page.html");
    fs::write(&file, page).expect("written");
    for _ in 0..ATTEMPTS {
        let mut command = command(browser, &scratch.0);
        command
            .arg("--dump-dom")
            .args(budget.map(|budget| format!("--virtual-time-budget={budget}")))
            .arg(format!("file://{}", file.display()));
        if let Some([dom, said]) = finished(command, &scratch.0) {
            let console = said.lines().filter(|line| line.contains("CONSOLE"));
            let console = console.map(String::from).collect();
            return Visit { dom, console };
        }
    }
    panic!("the browser stood still {ATTEMPTS} times");
}

/// A browser under virtual time stands still for ever now and then, mostly while it records a film: then it is asked again.
const ATTEMPTS: usize = 3;
/// How long a visit may take.
const LONGEST: Duration = Duration::from_secs(60);

/// What a command printed, and what it complained of; none where it had to be stopped.
fn finished(mut command: Command, folder: &Path) -> Option<[String; 2]> {
    let files = ["printed", "said"].map(|name| folder.join(name));
    let [printed, said] = files
        .clone()
        .map(|file| fs::File::create(file).expect("made"));
    let mut child = command
        .stdout(printed)
        .stderr(said)
        .spawn()
        .expect("it starts");
    let begun = Instant::now();
    while child.try_wait().expect("it can be asked").is_none() {
        if begun.elapsed() > LONGEST {
            child.kill().expect("it can be stopped");
            child.wait().expect("it ends");
            return None;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    Some(files.map(|file| String::from_utf8_lossy(&fs::read(file).expect("there")).into_owned()))
}

/// On how many sheets a page is printed.
pub fn sheets(browser: &Path, page: &str) -> usize {
    let scratch = Scratch::new("print");
    let [file, paper] = ["page.html", "paper.pdf"].map(|name| scratch.0.join(name));
    fs::write(&file, page).expect("written");
    let status = command(browser, &scratch.0)
        .arg("--virtual-time-budget=2000")
        .arg(format!("--print-to-pdf={}", paper.display()))
        .arg(format!("file://{}", file.display()))
        .stderr(Stdio::null())
        .status();
    assert!(status.expect("it starts").success(), "not printed");
    let paper = fs::read(&paper).expect("printed");
    String::from_utf8_lossy(&paper)
        .split("/Type /Page\n")
        .count()
        - 1
}

/// The answer of a script that runs behind the page's own and calls `answer(value)`. The page's policy stays in force, with this
/// script allowed.
pub fn ask(browser: &Path, page: &str, script: &str, budget: Option<u32>) -> (Value, Visit) {
    let page = with_script(page, &format!("{WRITE}\n{script}"));
    told(open(browser, &page, budget))
}

/// As `ask`, of a page in a window of that width and height \[px\]: a frame, since windows have a least size.
pub fn ask_in(
    browser: &Path,
    page: &str,
    script: &str,
    budget: Option<u32>,
    [width, height]: [u32; 2],
) -> (Value, Visit) {
    let send = "const answer = (value) => parent.postMessage(value, '*');";
    let page = with_script(page, &format!("{send}\n{script}"));
    let page = page.replace('&', "&amp;").replace('"', "&quot;");
    let outer = format!(
        "<!doctype html><meta charset=\"utf-8\"><body><script>{WRITE} addEventListener('message', (event) => answer(event.data));</script>\
         <iframe width={width} height={height} style=\"border:0\" srcdoc=\"{page}\"></iframe></body>"
    );
    told(open(browser, &outer, budget))
}

/// Leaves an answer in the document.
const WRITE: &str = "const answer = (value) => { const box = document.createElement('pre'); box.id = 'answer'; \
    box.textContent = encodeURIComponent(JSON.stringify(value)); document.body.append(box); };";

/// A page with one more script, which its policy allows.
fn with_script(page: &str, script: &str) -> String {
    let hash = base64(&Sha256::digest(script.as_bytes()));
    let page = page.replacen("script-src 'none'", "script-src ", 1);
    let page = page.replacen("script-src ", &format!("script-src 'sha256-{hash}' "), 1);
    let (before, after) = page.rsplit_once("</body>").expect("a body");
    format!("{before}<script>{script}</script></body>{after}")
}

/// The answer that a visit left.
fn told(visit: Visit) -> (Value, Visit) {
    let text = visit
        .dom
        .split_once("id=\"answer\">")
        .and_then(|(_, rest)| rest.split_once("</pre>"));
    let Some((text, _)) = text else {
        panic!("no answer: {:?}", visit.console)
    };
    (serde_json::from_str(&decoded(text)).expect("JSON"), visit)
}

/// What `encodeURIComponent` was given.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let [first, tail @ ..] = rest {
        let code = if *first == b'%' {
            std::str::from_utf8(&tail[..2]).ok()
        } else {
            None
        };
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &tail[2..];
            }
            None => {
                bytes.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8(bytes).expect("UTF-8")
}

fn base64(bytes: &[u8]) -> String {
    let digits: Vec<char> = ('A'..='Z')
        .chain('a'..='z')
        .chain('0'..='9')
        .chain(['+', '/'])
        .collect();
    let bit = |at: usize| {
        bytes
            .get(at / 8)
            .is_some_and(|byte| byte >> (7 - at % 8) & 1 == 1)
    };
    let mut text: String = (0..bytes.len() * 8)
        .step_by(6)
        .map(|at| digits[(at..at + 6).fold(0, |digit, at| digit << 1 | usize::from(bit(at)))])
        .collect();
    while !text.len().is_multiple_of(4) {
        text.push('=');
    }
    text
}
