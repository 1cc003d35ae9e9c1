//! Ctrl-C, and the signals by which a system asks a process to end (SIGTERM, SIGHUP): the first one asks the run to stop and to
//! write what it has, the second one ends the process.
//!
//! In another program, which has its own way with signals, it is that program's flag that asks (`hosted`).

use std::cell::RefCell;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use super::Exit;
use linkdyn_engine::analysis::Control;

/// Characters of a line of progress, at most.
#[cfg(unix)]
const WIDTH: usize = 78;

thread_local! {
    /// The flag of the program that runs commands in this thread.
    static HOST: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
}

/// Runs a command in this thread that this flag interrupts; Ctrl-C stays with the program.
pub fn hosted<T>(flag: Arc<AtomicBool>, run: impl FnOnce() -> T) -> T {
    let outer = HOST.replace(Some(flag));
    let done = run();
    HOST.set(outer);
    done
}

/// The flag that Ctrl-C sets, the same for all runs of a command: the process can have one handler only.
pub fn watch() -> Arc<AtomicBool> {
    if let Some(flag) = HOST.with_borrow(Clone::clone) {
        return flag;
    }
    static INTERRUPTED: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    let begin = || {
        let interrupted = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&interrupted);
        listen(flag);
        interrupted
    };
    Arc::clone(INTERRUPTED.get_or_init(begin))
}

/// What Ctrl-C interrupts.
pub fn control() -> Control {
    Control {
        interrupted: watch(),
        ..Control::default()
    }
}

/// Handles signals from now on. Where no handler can be set, they end the process as they always do.
#[cfg(unix)]
fn listen(flag: Arc<AtomicBool>) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let others = [SIGTERM, SIGHUP].into_iter();
    let signals = others.filter(|&signal| !is_ignored(signal)).chain([SIGINT]);
    let Ok(mut signals) = signal_hook::iterator::Signals::new(signals) else {
        return;
    };
    std::thread::spawn(move || signals.forever().for_each(|_| handle(&flag)));
}

/// Whether whoever started the process has it live on after a signal, as `nohup` does; known on Linux.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|text| u64::from_str_radix(text.trim(), 16).ok());
    ignored.is_some_and(|ignored| ignored >> (signal - 1) & 1 == 1)
}

#[cfg(not(unix))]
fn listen(flag: Arc<AtomicBool>) {
    use signal_hook::{consts::SIGINT, flag};
    // in this order the second one finds the flag set
    let end = Exit::Interrupted.code().into();
    let _ = flag::register_conditional_shutdown(SIGINT, end, Arc::clone(&flag));
    let _ = flag::register(SIGINT, flag);
}

/// Whether Ctrl-C was pressed, or the process is to end.
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

#[cfg(unix)]
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
    fn a_command_of_another_program_looks_at_the_flag_of_that_program() {
        let flag = Arc::new(AtomicBool::new(false));
        let inside = hosted(Arc::clone(&flag), || {
            let before = is_set();
            flag.store(true, Ordering::SeqCst);
            (before, is_set(), Arc::ptr_eq(&watch(), &flag))
        });
        assert_eq!(inside, (false, true, true));
        assert!(!Arc::ptr_eq(&watch(), &flag), "its own again");
    }

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
