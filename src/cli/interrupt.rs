//! Ctrl-C: the first one asks the run to stop and to write what it has, the second one ends the process.

use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use super::Exit;

/// Characters of a line of progress, at most.
const WIDTH: usize = 78;

/// The flag that Ctrl-C sets, the same for all runs of a command: the process can have one handler only.
pub fn watch() -> Arc<AtomicBool> {
    static INTERRUPTED: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    let begin = || {
        let interrupted = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&interrupted);
        // Where no handler can be set, Ctrl-C ends the process as it always does.
        let _ = ctrlc::set_handler(move || handle(&flag));
        interrupted
    };
    Arc::clone(INTERRUPTED.get_or_init(begin))
}

/// Whether Ctrl-C was pressed.
pub fn is_set() -> bool {
    watch().load(Ordering::SeqCst)
}

/// Whether nothing runs that has something to write.
static WAITING: AtomicBool = AtomicBool::new(false);

/// As long as this lives an interrupt has nothing to write, and says nothing.
#[derive(Debug)]
pub struct Waiting(Arc<AtomicBool>);

impl Waiting {
    /// Begins to wait.
    pub fn start() -> Self {
        let flag = watch();
        WAITING.store(true, Ordering::SeqCst);
        Waiting(flag)
    }

    /// Whether Ctrl-C was pressed.
    pub fn is_interrupted(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        WAITING.store(false, Ordering::SeqCst);
    }
}

fn handle(flag: &AtomicBool) {
    if flag.swap(true, Ordering::SeqCst) {
        std::process::exit(Exit::Interrupted.code().into());
    }
    if WAITING.load(Ordering::SeqCst) {
        return;
    }
    // over a line of progress, where there may be one
    let back = if io::stderr().is_terminal() { "\r" } else { "" };
    let _ = writeln!(
        io::stderr(),
        "{back}{:WIDTH$}",
        "interrupted: writing what there is; once more to stop at once"
    );
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::process::Command;
    use std::time::Duration;

    #[test]
    fn the_first_interrupt_sets_the_flag_and_ends_nothing() {
        let interrupted = watch();
        let killed = Command::new("kill")
            .args(["-INT", &std::process::id().to_string()])
            .status();
        assert!(killed.is_ok_and(|status| status.success()));
        let is_set = (0..500).any(|_| {
            std::thread::sleep(Duration::from_millis(10));
            interrupted.load(Ordering::SeqCst)
        });
        assert!(is_set);
        // The next run of the same command sees it too.
        assert!(watch().load(Ordering::SeqCst));
    }
}
