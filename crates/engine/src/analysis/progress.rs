//! How far a run has come, for whoever watches from another thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Share of a run that is done; clones look at the same one.
#[derive(Debug, Clone)]
pub struct Progress(Arc<AtomicU64>);

impl Default for Progress {
    fn default() -> Self {
        Progress(Arc::new(AtomicU64::new(f64::NAN.to_bits())))
    }
}

impl Progress {
    /// Notes that `done` of `whole` is behind us.
    pub fn note(&self, done: f64, whole: f64) {
        self.0
            .store((done / whole).clamp(0.0, 1.0).to_bits(), Ordering::Relaxed);
    }

    /// From 0 to 1; `None` if unknown.
    pub fn share(&self) -> Option<f64> {
        let share = f64::from_bits(self.0.load(Ordering::Relaxed));
        share.is_finite().then_some(share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_is_between_nothing_and_all_or_unknown() {
        let progress = Progress::default();
        let watched = progress.clone();
        assert_eq!(watched.share(), None);
        for (done, whole, share) in [
            (1.0, 4.0, Some(0.25)),
            (5.0, 4.0, Some(1.0)),
            (0.0, 0.0, None),
        ] {
            progress.note(done, whole);
            assert_eq!(watched.share(), share);
        }
    }
}
