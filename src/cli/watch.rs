//! Runs again when a file changes. The file is looked at by its time and length, which works on every file system.

use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};

use super::exit::{BadInput, Exit, Failure};
use super::interrupt;
use super::streams::{complain, remark};

/// Between two looks: nobody notices it, and it takes a thousandth of a processor.
const INTERVAL: Duration = Duration::from_millis(10);
/// How long an empty file is waited for: an editor that empties a file is about to write it.
const EMPTY: Duration = Duration::from_millis(200);

/// What tells one version of a file from another; none while there is no file, as between two steps of an editor.
type Version = Option<(SystemTime, u64)>;

fn version(path: &Path) -> Version {
    let metadata = fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// Runs, and again whenever the file has changed. Faults of the file are reported and waited out; an interrupt is the end.
/// A run returns how it ended, and a word about where to look, if there is one.
///
/// # Errors
/// When there is no file to watch.
pub fn watch(
    path: &Path,
    mut run: impl FnMut() -> Result<(Exit, String), Failure>,
) -> Result<Exit, Failure> {
    let label = path.display();
    if !path.is_file() {
        return Err(BadInput(vec![format!(
            "{label}: --watch wants the path of a model file (`linkdyn models NAME > FILE` writes a bundled model)"
        )]));
    }
    let mut look = String::new();
    loop {
        let seen = version(path);
        match run() {
            Ok((Exit::Interrupted, _)) => return Ok(Exit::Interrupted),
            Ok((_, word)) => look = word,
            Err(failure) => failure.parts().1.iter().for_each(|line| complain(line)),
        }
        remark(&format!(
            "watching {label}: save it to run again, Ctrl-C ends{look}"
        ));
        if !changed(path, seen) {
            return Ok(Exit::Interrupted);
        }
    }
}

/// Waits until the file is another one and rests; false where Ctrl-C comes first.
fn changed(path: &Path, seen: Version) -> bool {
    let waiting = interrupt::Waiting::start();
    let mut last = seen;
    let mut since = Instant::now();
    while !waiting.is_interrupted() {
        sleep(INTERVAL);
        let now = version(path);
        if now != last {
            (last, since) = (now, Instant::now());
            continue;
        }
        // One more look: an editor may be in the midst of writing.
        let rests = match now {
            None => false,
            Some((_, 0)) => since.elapsed() >= EMPTY,
            Some(_) => true,
        };
        if rests && now != seen {
            return true;
        }
    }
    false
}
