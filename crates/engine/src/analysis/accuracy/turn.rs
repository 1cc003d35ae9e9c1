//! Sources whose influence vanishes as they give way to it: farthest is a place between their ends.
//!
//! Where g = ∂y/∂e is hardly anything, it may ask for one end while the source is at the other, and for that one while it is at
//! this. So g falls on the way between, and the output is farthest where it vanishes; by the straight line through both
//!
//! ```text
//! e − g/k,   k = (g₂ − g₁)/(e₂ − e₁)      of the last two
//! ```

/// An influence vanishes where it is less than this part of what it is across the whole play.
const VANISHED: f64 = 0.1;

/// A source to either side on its way.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Turn {
    /// Where it was before it went on, and its influence there.
    before: Option<[f64; 2]>,
    /// ∂g/∂e, once each end asked for the other.
    bend: Option<f64>,
}

impl Turn {
    /// At the next pose, where the last one's `place` and `influence` go on to these: if it still stands between its `ends`, it
    /// bends as before.
    pub fn ahead(&self, [place, influence]: [f64; 2], [low, high]: [f64; 2]) -> Turn {
        let inside = low < place && place < high;
        let bend = self
            .bend
            .filter(|bend| inside && influence.abs() <= VANISHED * bend.abs() * (high - low));
        Turn { before: None, bend }
    }

    /// Whether nothing is known of it.
    pub fn is_at_rest(&self) -> bool {
        self.before.is_none() && self.bend.is_none()
    }

    /// Whether the source stands where its influence vanishes, or may.
    pub fn is_bent(&self) -> bool {
        self.bend.is_some()
    }

    /// The e to try after one with its influence (`now`): `end` is what the influence asks for; `ends` are those that it may
    /// stand between, where it may. What gains no more than `worth` is left as it is.
    pub fn next(&mut self, now: [f64; 2], end: f64, ends: Option<[f64; 2]>, worth: f64) -> f64 {
        let [e, g] = now;
        if self.bend.is_none() && (end == e || (g * (end - e)).abs() <= worth) {
            return e;
        }
        // Others that give way at the same time have a part in it, and stop at their ends: so it is measured at each step.
        if let Some([other, then]) = self.before
            && e != other
        {
            let bend = (g - then) / (e - other);
            match self.bend {
                None if other == end => self.bend = Some(bend),
                Some(before) if before * bend > 0.0 => self.bend = Some(bend),
                None | Some(_) => {}
            }
        }
        let next = match (self.bend, ends) {
            (None, _) => end,
            (Some(_), None) => e,
            (Some(bend), Some([low, high])) => (e - g / bend).clamp(low, high),
        };
        // It does not bend that way, if the way on is not where the influence asks.
        let next = if (next - e) * (end - e) < 0.0 {
            self.bend = None;
            end
        } else {
            next
        };
        if next.is_nan() || (g * (next - e)).abs() <= worth {
            return e;
        }
        self.before = Some(now);
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of y = g₀ e − ½ k e² the farthest place is g₀/k where that is between the ends, and found as each end asked for the other.
    #[test]
    fn a_source_ends_where_its_influence_vanishes() {
        let (g0, k, ends) = (0.3, 2.0, [-0.4, 1.0]);
        let influence = |e: f64| g0 - k * e;
        let end = |g: f64| if g >= 0.0 { ends[1] } else { ends[0] };
        for (between, last) in [(Some(ends), g0 / k), (None, ends[0])] {
            let mut turn = Turn::default();
            let mut e = ends[1];
            for (pass, expected) in [ends[0], last, last].into_iter().enumerate() {
                let g = influence(e);
                e = turn.next([e, g], end(g), between, 0.0);
                assert!((e - expected).abs() < 1e-15, "{between:?} {pass}: {e}");
            }
        }
    }

    /// Where the influence keeps its sign, or the other end is worth nothing, the source stays at its end.
    #[test]
    fn a_source_with_an_influence_stays_at_its_end() {
        let mut turn = Turn::default();
        for _ in 0..3 {
            assert_eq!(turn.next([1.0, -1e-3], -1.0, None, 0.01), 1.0);
            assert_eq!(turn.next([1.0, 0.2], 1.0, Some([-1.0, 1.0]), 0.0), 1.0);
        }
    }

    /// Two sources with one influence give way together; one may not stand between its ends, and the other goes on alone, as fast.
    #[test]
    fn a_source_goes_on_where_another_has_stopped() {
        let (g0, k, ends) = (-0.6, 2.0, [-1.0, 1.0]);
        let mut turns = [Turn::default(); 2];
        let mut e = [1.0; 2];
        for _ in 0..6 {
            let g = g0 - k * (e[0] + e[1]);
            let end = if g >= 0.0 { ends[1] } else { ends[0] };
            let [first, second] = &mut turns;
            e = [
                first.next([e[0], g], end, Some(ends), 0.0),
                second.next([e[1], g], end, None, 0.0),
            ];
        }
        assert_eq!(e[1], -1.0);
        assert!((k * (e[0] + e[1]) - g0).abs() < 1e-14, "{e:?}");
    }
}
