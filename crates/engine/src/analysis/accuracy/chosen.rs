//! Deviations of all sources that are tried together.

use super::sorted::Sorted;
use super::source::{Influence, Play};

/// Deviations of all sources.
#[derive(Debug, Clone)]
pub(super) struct Chosen {
    /// e of the plays.
    pub extremes: Vec<Influence>,
    /// Steps of the dimensions …
    pub steps: Vec<f64>,
    /// … for these deviations of the parameters.
    pub stepped: Vec<f64>,
}

/// What changed deviations gain [rad or m].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Gain {
    /// Of those whose direction turned: what they gain is the square of what they turned by.
    pub smooth: f64,
    /// Of those that left an end.
    pub ended: f64,
    /// Whether parameters changed, and whether points moved in their zones.
    pub steps: bool,
    pub moves: bool,
}

/// What counts as a gain [rad or m]: of another end, and of what hardly gains anything.
#[derive(Debug, Clone, Copy)]
pub(super) struct Worth {
    pub ended: f64,
    pub still: f64,
}

impl Chosen {
    pub fn new(plays: usize, dimensions: usize) -> Self {
        Chosen {
            extremes: vec![[0.0; 2]; plays],
            steps: vec![0.0; dimensions],
            stepped: Vec::new(),
        }
    }

    /// The ends that the influences `g` ask for, for a side (±1); what spans no more than `still` stays where it was.
    pub fn begin(
        &mut self,
        (sorted, plays): (&Sorted, &[Play]),
        (g, side): (&[Influence], f64),
        still: f64,
    ) {
        let extremes = &mut self.extremes;
        for disc in &sorted.discs {
            let g = g[disc.play];
            if disc.span(g) > still {
                extremes[disc.play] = disc.extreme(g, side);
            }
        }
        for line in &sorted.lines {
            let g = g[line.play][0];
            if line.span(g) > still {
                extremes[line.play][0] = line.extreme(g, side);
            }
        }
        for &play in &sorted.guided {
            let [down, up] = plays[play].reach(g[play]);
            if up - down > still {
                extremes[play] = plays[play].extreme(g[play], side);
            }
        }
    }

    /// Goes on to what the influences `g` ask for, but for changes that are not worth it; what they gain.
    pub fn press(
        &mut self,
        (sorted, plays): (&Sorted, &[Play]),
        (g, side): (&[Influence], f64),
        worth: Worth,
    ) -> Gain {
        let mut gain = Gain::default();
        let gained = |g: Influence, from: Influence, to: Influence| {
            (g[0] * (to[0] - from[0]) + g[1] * (to[1] - from[1])).abs()
        };
        for disc in &sorted.discs {
            let g = g[disc.play];
            let e = &mut self.extremes[disc.play];
            let end = disc.extreme(g, side);
            let gained = gained(g, *e, end);
            // What has no influence has no direction, either.
            if gained > worth.still {
                gain.moves |= disc.is_zone;
                gain.smooth += gained;
                *e = end;
            }
        }
        for &play in &sorted.guided {
            let e = &mut self.extremes[play];
            let end = plays[play].extreme(g[play], side);
            let gained = gained(g[play], *e, end);
            if gained > worth.still {
                gain.smooth += gained;
                *e = end;
            }
        }
        for line in &sorted.lines {
            let g = g[line.play][0];
            let e = &mut self.extremes[line.play][0];
            let end = line.extreme(g, side);
            let gained = (g * (end - *e)).abs();
            if gained > worth.ended {
                gain.steps |= line.is_parameter;
                gain.ended += gained;
                *e = end;
            }
        }
        gain
    }
}
