//! What the page shows: the last run that has a report, and what is wrong with the file since.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use linkdyn_ask::ModelFile;
use linkdyn_ask::run::parameters;
use linkdyn_engine::analysis::Outcome;
use serde_json::{Value, json};

/// How long a page waits for news before it asks again.
const WAIT: Duration = Duration::from_secs(20);

/// What the command and the page share.
#[derive(Debug)]
pub struct State {
    /// The model's file.
    pub model: PathBuf,
    /// The page of the last run.
    pub report: PathBuf,
    shown: Mutex<Shown>,
    news: Condvar,
    /// Ends the run of values that are not wanted any more.
    running: Mutex<Arc<AtomicBool>>,
    /// One such run at a time.
    turn: Mutex<()>,
}

#[derive(Debug, Default)]
struct Shown {
    /// Counts what the page hears of.
    version: u64,
    /// Counts runs.
    run: u64,
    faults: Vec<String>,
    last: Option<ShownRun>,
}

/// A run, for the page.
#[derive(Debug, Clone)]
pub struct ShownRun {
    pub file: Arc<ModelFile>,
    /// The data of its report.
    pub data: Arc<String>,
}

/// Nothing that is kept behind a lock is ever half done.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl State {
    /// Begins with no run.
    pub fn new(model: PathBuf, report: PathBuf) -> Self {
        State {
            model,
            report,
            shown: Mutex::default(),
            news: Condvar::new(),
            running: Mutex::default(),
            turn: Mutex::default(),
        }
    }

    fn change(&self, change: impl FnOnce(&mut Shown)) {
        let mut shown = locked(&self.shown);
        change(&mut shown);
        shown.version += 1;
        self.news.notify_all();
    }

    /// Another run.
    pub fn show(&self, file: ModelFile, outcome: &Outcome) {
        let data = Arc::new(file.origin().data(outcome));
        let file = Arc::new(file);
        self.change(|shown| {
            shown.run += 1;
            shown.faults.clear();
            shown.last = Some(ShownRun { file, data });
        });
    }

    /// What is wrong with the file.
    pub fn tell(&self, faults: Vec<String>) {
        self.change(|shown| shown.faults = faults);
    }

    /// The last run.
    pub fn last(&self) -> Option<ShownRun> {
        locked(&self.shown).last.clone()
    }

    /// What the page shows, once that is another version than the one it has.
    pub fn news(&self, version: &str) -> Value {
        let shown = locked(&self.shown);
        let is_known = |shown: &mut Shown| shown.version.to_string() == version;
        let waited = self.news.wait_timeout_while(shown, WAIT, is_known);
        let (shown, _) = waited.unwrap_or_else(PoisonError::into_inner);
        let knobs = shown.last.as_ref().map(|run| parameters(&run.file));
        json!({
            "version": shown.version,
            "run": shown.run,
            "faults": shown.faults,
            "knobs": knobs.unwrap_or_default(),
        })
    }

    /// Runs with values that are the newest now: ends an older run that is not done.
    pub fn newest<T>(&self, run: impl FnOnce(&Arc<AtomicBool>) -> T) -> T {
        let own = Arc::new(AtomicBool::new(false));
        let before = std::mem::replace(&mut *locked(&self.running), Arc::clone(&own));
        before.store(true, Ordering::SeqCst);
        let _turn = locked(&self.turn);
        run(&own)
    }
}
