//! Threads that are kept: a run of a millisecond should not wait for a new one, whose memory is cold, too.

use std::io;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// As much room as a main thread has: text of a model may be nested deeply \[bytes\].
const STACK: usize = 8 << 20;
/// Threads that are kept at most; more than these end with their work.
const KEPT: usize = 16;

/// What a thread is given to do; it never panics.
pub type Job = Box<dyn FnOnce() + Send>;

/// A thread that waits for work. It ends when this is dropped.
pub struct Worker {
    jobs: Sender<Job>,
    /// The process that the thread lives in: one that was forked from it has no such thread.
    process: u32,
}

/// Those that have nothing to do.
static IDLE: Mutex<Vec<Worker>> = Mutex::new(Vec::new());

impl Worker {
    /// One that was kept, or a new one. The caller holds the interpreter, so that no fork finds the list locked.
    pub fn take() -> io::Result<Self> {
        let process = std::process::id();
        let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
        idle.retain(|worker| worker.process == process);
        match idle.pop() {
            Some(worker) => Ok(worker),
            None => Worker::new(process),
        }
    }

    fn new(process: u32) -> io::Result<Self> {
        let (jobs, given) = channel::<Job>();
        let work = move || {
            for job in given {
                job();
            }
        };
        thread::Builder::new()
            .name("linkdyn".into())
            .stack_size(STACK)
            .spawn(work)?;
        Ok(Worker { jobs, process })
    }

    /// Gives it work; whether there is still a thread.
    pub fn give(&self, job: Job) -> bool {
        self.jobs.send(job).is_ok()
    }

    /// Keeps it for the next work. The caller holds the interpreter.
    pub fn keep(self) {
        let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
        if idle.len() < KEPT {
            idle.push(self);
        }
    }
}
