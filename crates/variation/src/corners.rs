//! What parameters that bend do together.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Steps of all dimensions for deviations of the parameters, in the order of their plays; `None` if the model can't be had
/// with them.
pub(super) type Stepping<'c> = dyn Fn(&[f64]) -> Option<Vec<f64>> + Sync + 'c;

/// By the bits of the deviations.
type Known = HashMap<Vec<u64>, Option<Arc<[f64]>>>;

/// The same, each worked out once.
pub(super) struct Corners<'c> {
    stepping: &'c Stepping<'c>,
    known: Mutex<Known>,
}

impl<'c> Corners<'c> {
    pub fn new(stepping: &'c Stepping<'c>) -> Self {
        Corners {
            stepping,
            known: Mutex::new(HashMap::new()),
        }
    }

    pub fn steps(&self, deviations: &[f64]) -> Option<Arc<[f64]>> {
        let key = deviations.iter().map(|by| by.to_bits()).collect();
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let steps = known
            .entry(key)
            .or_insert_with(|| (self.stepping)(deviations).map(Arc::from));
        steps.clone()
    }
}
