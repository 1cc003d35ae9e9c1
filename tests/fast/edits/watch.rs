//! Work that must come to an end, step by step.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Longest time of one step, on a machine that is busy.
const LONGEST: Duration = Duration::from_secs(60);

/// Does some work, which says of each of its steps what it is; panics with the step that does not end.
pub fn in_time<T: Send + 'static>(work: impl FnOnce(&dyn Fn(String)) -> T + Send + 'static) -> T {
    let (sender, steps) = channel();
    let worker = std::thread::spawn(move || {
        work(&|step| {
            sender.send(step).expect("somebody listens");
        })
    });
    let mut now = String::from("the first step");
    loop {
        match steps.recv_timeout(LONGEST) {
            Ok(step) => now = step,
            Err(RecvTimeoutError::Timeout) => panic!("{now} does not end"),
            // The work is done, or panicked.
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    worker
        .join()
        .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
