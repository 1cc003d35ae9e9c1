//! Commands: in this process, or the binary.

use std::cell::RefCell;
use std::ffi::OsString;
use std::io::Read;
use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use cpu_time::ThreadTime;
use linkdyn::cli::{self, Said};

/// The exit status of a fault of linkdyn.
const BROKEN: u8 = 6;

/// How commands are run.
#[derive(Debug, Clone)]
pub enum Runner {
    /// In this process: panics are caught, time is that of the processor.
    Inside,
    /// The binary: signals are seen, time is that of the clock.
    Process(PathBuf),
}

/// What came of a command.
#[derive(Debug)]
pub enum Ran {
    Said(Said, Duration),
    Panicked(String),
    Killed(String),
}

thread_local! {
    static PANIC: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Keeps the words of panics instead of printing them.
pub fn keep_panics() {
    static KEPT: OnceLock<()> = OnceLock::new();
    KEPT.get_or_init(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            // Those of others, of tests above all, are printed as ever.
            if PANIC.with_borrow(Option::is_none) {
                return print(info);
            }
            let place = info
                .location()
                .map(|at| format!("{}:{}", at.file(), at.line()))
                .unwrap_or_default();
            let payload = info.payload();
            let words = payload
                .downcast_ref::<String>()
                .map(String::as_str)
                .or(payload.downcast_ref::<&str>().copied());
            let words = words
                .unwrap_or("no words")
                .lines()
                .next()
                .unwrap_or_default();
            PANIC.set(Some(format!("{place}: {words}")));
        }));
    });
}

/// Runs something that may panic.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    keep_panics();
    PANIC.set(Some(String::new()));
    let done = panic::catch_unwind(AssertUnwindSafe(work));
    let words = PANIC.take().unwrap_or_default();
    done.map_err(|_| words)
}

/// What runs at this moment and since when [ms since the first command], 0 for nothing.
static SINCE: AtomicU64 = AtomicU64::new(0);
static WHAT: Mutex<String> = Mutex::new(String::new());

/// The mutant that is tried at this moment.
static NUMBER: AtomicU64 = AtomicU64::new(0);

/// Tells which mutant is tried from now on.
pub fn at(number: u64) {
    NUMBER.store(number, Ordering::SeqCst);
}

fn clock() -> u64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_millis() as u64 + 1
}

/// Ends the process when one command takes longer than `most`: what hangs can't be stopped otherwise.
pub fn watch(most: Duration) {
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(Duration::from_millis(500));
            let since = SINCE.load(Ordering::SeqCst);
            if since > 0 && clock().saturating_sub(since) > most.as_millis() as u64 {
                let what = WHAT.lock().map(|what| what.clone()).unwrap_or_default();
                println!(
                    "FIND hang: no end after {most:?}: mutant {}: {what}",
                    NUMBER.load(Ordering::SeqCst)
                );
                std::process::exit(1);
            }
        }
    });
}

impl Runner {
    pub fn run(&self, arguments: &[String]) -> Ran {
        if let Ok(mut what) = WHAT.lock() {
            *what = arguments.join(" ");
        }
        SINCE.store(clock(), Ordering::SeqCst);
        let ran = match self {
            Runner::Inside => inside(arguments),
            Runner::Process(binary) => process(binary, arguments),
        };
        SINCE.store(0, Ordering::SeqCst);
        ran
    }
}

fn inside(arguments: &[String]) -> Ran {
    let start = ThreadTime::now();
    let words = ["linkdyn".to_string()]
        .into_iter()
        .chain(arguments.iter().cloned())
        .map(OsString::from);
    match caught(|| cli::captured(words)) {
        // A fault of linkdyn, which the command has caught.
        Ok(said) if said.status == BROKEN => Ran::Panicked(said.stderr),
        Ok(said) => Ran::Said(said, start.elapsed()),
        Err(words) => Ran::Panicked(words),
    }
}

fn process(binary: &PathBuf, arguments: &[String]) -> Ran {
    let start = Instant::now();
    let child = Command::new(binary)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = match child {
        Ok(child) => child,
        // A text that no argument can hold is none of ours.
        Err(_) => {
            return Ran::Said(
                Said {
                    status: 2,
                    stderr: "error: not an argument".into(),
                    ..Said::default()
                },
                Duration::ZERO,
            );
        }
    };
    let mut streams = [String::new(), String::new()];
    let error = child.stderr.take();
    let reader = std::thread::spawn(move || {
        let mut text = Vec::new();
        let _ = error.map(|mut error| error.read_to_end(&mut text));
        text
    });
    let mut text = Vec::new();
    let _ = child
        .stdout
        .take()
        .map(|mut out| out.read_to_end(&mut text));
    streams[0] = String::from_utf8_lossy(&text).into_owned();
    streams[1] = String::from_utf8_lossy(&reader.join().unwrap_or_default()).into_owned();
    let [stdout, stderr] = streams;
    match child.wait().map(|status| status.code()) {
        Ok(Some(code)) if code != i32::from(BROKEN) && !stderr.contains("panicked at") => {
            Ran::Said(
                Said {
                    status: u8::try_from(code).unwrap_or(u8::MAX),
                    stdout,
                    stderr,
                },
                start.elapsed(),
            )
        }
        Ok(Some(_)) => Ran::Panicked(stderr.lines().take(2).collect::<Vec<_>>().join(" ")),
        Ok(None) => Ran::Killed(format!("by a signal; {stderr}")),
        Err(error) => Ran::Killed(error.to_string()),
    }
}
