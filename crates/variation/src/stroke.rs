//! The poses of a stroke, in stretches that several threads share.
//!
//! Pivots of a pose's factors may be those of the one before. No stretch depends on another, and where they begin does not depend on
//! the threads, so that the answers do not either.

use super::displaced::Mechanism;
use super::levels::PoseAnalysis;
use super::poses::Way;
use super::{PoseAccuracy, Question};
use linkdyn_engine::analysis::Stop;
use linkdyn_engine::analysis::instants::OutputInstant;
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Poses of a stretch: enough that a solver of its own costs little.
const STRETCH: usize = 64;

/// The answers about outputs (by number) at all instants where the mechanism has a pose, one after the other.
///
/// # Errors
/// As [`Way::another`].
pub(super) fn poses(
    way: &Way,
    question: &Question,
    outputs: &[usize],
    threads: NonZeroUsize,
) -> Result<Vec<Vec<PoseAccuracy>>, Stop> {
    let stretch = |instants: &[OutputInstant]| {
        let mut places = way.poses();
        let mut analysis = PoseAnalysis::new(Mechanism::new(way.another()?, question));
        let stands = instants
            .iter()
            .filter_map(|instant| places.stand(instant, None));
        let poses = stands.map(|stand| analysis.answer(outputs, &stand));
        Ok(poses.collect::<Vec<_>>())
    };
    let stretches = question.instants.par_chunks(STRETCH);
    let all = || stretches.map(stretch).collect::<Result<Vec<_>, Stop>>();
    let pool = ThreadPoolBuilder::new().num_threads(threads.get()).build();
    // Where no threads can be had, those that there are do it.
    let answers = match pool {
        Ok(pool) => pool.install(all),
        Err(_) => all(),
    };
    Ok(answers?.into_iter().flatten().collect())
}
