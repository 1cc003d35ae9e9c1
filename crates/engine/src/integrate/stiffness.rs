//! When an explicit method takes its problem to be stiff.
//!
//! The difference of the two slopes at t + h (the last stage and the end) over that of their arguments estimates |λ|. When
//! h |λ| lies beyond 6.1, about where the stability of DOP853 ends, in 15 steps without 6 others in a row, the problem is
//! taken to be stiff (Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, §IV.2).

/// h |λ| beyond which a step speaks for stiffness [-].
const STABLE: f64 = 6.1;
/// As many such steps decide, unless they are interrupted by `CALM` others.
const HITS: u32 = 15;
const CALM: u32 = 6;

/// Steps that speak for stiffness.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stiffness {
    hits: u32,
    calm: u32,
    found: bool,
    /// As many hits decide.
    enough: u32,
}

impl Default for Stiffness {
    fn default() -> Self {
        Stiffness {
            hits: 0,
            calm: 0,
            found: false,
            enough: HITS,
        }
    }
}

impl Stiffness {
    /// Counts a step with this (h λ)².
    pub(super) fn count(&mut self, square: f64) {
        if square > STABLE * STABLE {
            self.calm = 0;
            self.hits += 1;
            self.found |= self.hits >= self.enough;
        } else if self.hits > 0 {
            self.calm += 1;
            if self.calm >= CALM {
                self.hits = 0;
            }
        }
    }

    /// Forgets the steps counted, not what was found.
    pub(super) fn restart(&mut self) {
        (self.hits, self.calm) = (0, 0);
    }

    /// Forgets what was found; twice as many steps must speak for it the next time.
    pub(super) fn doubt(&mut self) {
        self.restart();
        self.found = false;
        self.enough = self.enough.saturating_mul(2);
    }

    /// Whether the last steps speak for stiffness.
    pub(super) fn is_suspected(&self) -> bool {
        self.hits > 0
    }

    /// Whether the problem is taken to be stiff.
    pub(super) fn is_found(&self) -> bool {
        self.found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calm_steps_in_a_row_interrupt_the_count() {
        let (hit, calm) = (STABLE * STABLE * 1.01, 1.0);
        let mut steady = Stiffness::default();
        (1..HITS).for_each(|_| steady.count(hit));
        assert!(!steady.is_found());
        (1..CALM).for_each(|_| steady.count(calm));
        steady.count(hit);
        assert!(steady.is_found());
        let mut broken = Stiffness::default();
        (1..HITS).for_each(|_| broken.count(hit));
        (0..CALM).for_each(|_| broken.count(calm));
        broken.count(hit);
        assert!(!broken.is_found());
        steady.restart();
        assert!(steady.is_found());
        steady.doubt();
        (0..HITS).for_each(|_| steady.count(hit));
        assert!(!steady.is_found() && steady.is_suspected());
        (0..HITS).for_each(|_| steady.count(hit));
        assert!(steady.is_found());
    }
}
