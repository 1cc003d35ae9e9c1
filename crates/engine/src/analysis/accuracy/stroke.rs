//! The poses of a stroke, in stretches that several threads share.
//!
//! What is found at a pose leads to the next one of its stretch. No stretch hangs on another, and where they begin does not hang
//! on the threads, so that the answers do not either.

use super::displaced::Mechanism;
use super::levels::Asked;
use super::poses::Way;
use super::source::Play;
use super::{PoseAccuracy, Question};
use crate::analysis::control::Stop;
use crate::analysis::instants::OutputInstant;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Most poses of a stretch.
const MOST: usize = 64;

/// The poses of some outputs at the instants of a stretch, by pose.
type Stretch = Result<Vec<Vec<PoseAccuracy>>, Stop>;

/// What is asked along a stroke.
pub(super) struct Stroke<'a> {
    pub way: &'a Way<'a>,
    pub question: &'a Question<'a>,
    pub plays: &'a [Play],
    /// Numbers of the outputs.
    pub outputs: &'a [usize],
}

impl Stroke<'_> {
    /// The answers at all instants where the mechanism has a pose, one after the other.
    ///
    /// # Errors
    /// As [`Way::another`].
    pub fn poses(&self, threads: NonZeroUsize) -> Stretch {
        let instants = &self.question.instants;
        let count = instants.len().div_ceil(MOST).max(1);
        let stretches: Vec<&[OutputInstant]> = instants
            .chunks(instants.len().div_ceil(count).max(1))
            .collect();
        let answers = shared(&stretches, threads, |stretch| self.stretch(stretch));
        let answers: Result<Vec<_>, Stop> = answers.into_iter().collect();
        Ok(answers?.into_iter().flatten().collect())
    }

    fn stretch(&self, instants: &[OutputInstant]) -> Stretch {
        let mut poses = self.way.poses();
        let mechanism = Mechanism::new(self.way.another()?, self.question, self.plays);
        let mut asked = Asked::new(self.way.system, self.question, mechanism);
        let stands = instants
            .iter()
            .filter_map(|instant| poses.stand(instant, None));
        Ok(stands
            .map(|stand| asked.poses(self.outputs, &stand))
            .collect())
    }
}

/// What work makes of each item, in their order; the threads take one after the other.
fn shared<Item: Sync, Made: Send>(
    items: &[Item],
    threads: NonZeroUsize,
    work: impl Fn(&Item) -> Made + Sync,
) -> Vec<Made> {
    let threads = threads.get().min(items.len());
    if threads <= 1 {
        return items.iter().map(work).collect();
    }
    // The last ones first: a stroke ends where locks and toggles do, where much is searched.
    let left = AtomicUsize::new(items.len());
    let made = Mutex::new(Vec::with_capacity(items.len()));
    let take = || {
        let another = || {
            left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| {
                left.checked_sub(1)
            })
        };
        while let Ok(left) = another() {
            let number = left - 1;
            let own = work(&items[number]);
            let mut made = made.lock().unwrap_or_else(PoisonError::into_inner);
            made.push((number, own));
        }
    };
    std::thread::scope(|scope| {
        (1..threads).for_each(|_| {
            scope.spawn(take);
        });
        take();
    });
    let mut made = made.into_inner().unwrap_or_else(PoisonError::into_inner);
    made.sort_unstable_by_key(|(number, _)| *number);
    made.into_iter().map(|(_, own)| own).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_shared_comes_in_order() {
        let items: Vec<usize> = (0..100).collect();
        for threads in [1, 2, 7, 200] {
            let threads = NonZeroUsize::new(threads).expect("some");
            let squares = shared(&items, threads, |item| item * item);
            assert!(
                squares
                    .iter()
                    .enumerate()
                    .all(|(k, square)| *square == k * k)
            );
            assert_eq!(squares.len(), 100);
        }
        let none: [usize; 0] = [];
        assert!(shared(&none, NonZeroUsize::MIN, |item| *item).is_empty());
    }
}
