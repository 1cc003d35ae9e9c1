//! How many threads share the work of a command.

use std::num::NonZeroUsize;
use std::thread::available_parallelism;

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::exit::Failure;
use super::streams::remark;

/// Threads for each processor at most: more of them only take memory from each other.
const MOST: usize = 4;

/// As many as are requested, up to what the machine has a use for, which is reported; one for each processor where none is said, or 0.
pub fn threads(asked: Option<usize>) -> NonZeroUsize {
    let processors = available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let most = processors.saturating_mul(NonZeroUsize::MIN.saturating_add(MOST - 1));
    match asked.and_then(NonZeroUsize::new) {
        None => processors,
        Some(asked) if asked > most => {
            remark(&format!(
                "note: --threads {asked}: {most} are taken, {MOST} for each processor"
            ));
            most
        }
        Some(asked) => asked,
    }
}

/// Threads that wait for work.
///
/// # Errors
/// When the system gives none.
pub fn pool(asked: Option<usize>) -> Result<ThreadPool, Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(threads(asked).get());
    let refuse = |error| Failure::BadInput(vec![format!("no threads: {error}")]);
    pool.build().map_err(refuse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_at_most_four_for_each_processor() {
        let processors = threads(None).get();
        assert_eq!(threads(Some(0)).get(), processors);
        assert_eq!(threads(Some(1)).get(), 1);
        assert_eq!(threads(Some(4 * processors)).get(), 4 * processors);
        assert_eq!(threads(Some(4 * processors + 1)).get(), 4 * processors);
        assert_eq!(threads(Some(usize::MAX)).get(), 4 * processors);
    }
}
