//! Deviations of all sources that are tried together.

use super::sorted::{Line, Sorted};
use super::source::{Influence, Play};
use super::turn::Turn;

/// Deviations of all sources.
#[derive(Debug, Clone)]
pub(super) struct Chosen {
    /// e of the plays.
    pub extremes: Vec<Influence>,
    /// How those with two ends give way to their influence (plays); each that is not at rest is in `turned`.
    turns: Vec<Turn>,
    turned: Vec<usize>,
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
            turns: vec![Turn::default(); plays],
            turned: Vec::new(),
            steps: vec![0.0; dimensions],
            stepped: Vec::new(),
        }
    }

    /// The ends that the influences `g` ask for, for a side (±1); what spans no more than `still` stays where it was. Where
    /// sources stood between their ends, `place` says where they go on to.
    pub fn begin(
        &mut self,
        (sorted, plays): (&Sorted, &[Play]),
        (g, side): (&[Influence], f64),
        still: f64,
        place: impl Fn(usize) -> Option<f64>,
    ) {
        let turns = &mut self.turns;
        let extremes = &mut self.extremes;
        self.turned.retain(|&play| {
            let turn = &mut turns[play];
            let bent = place(play).filter(|_| turn.is_bent());
            let ahead = bent.zip(plays[play].ends());
            *turn = ahead.map_or_else(Turn::default, |(place, ends)| {
                turn.ahead([place, g[play][0]], ends)
            });
            if let (Some((place, _)), true) = (ahead, turn.is_bent()) {
                extremes[play] = [place, 0.0];
            }
            turn.is_bent()
        });
        for disc in &sorted.discs {
            let g = g[disc.play];
            if disc.span(g) > still {
                extremes[disc.play] = disc.extreme(g, side);
            }
        }
        let has_turned = !self.turned.is_empty();
        for line in &sorted.lines {
            let g = g[line.play][0];
            let is_bent = has_turned && turns[line.play].is_bent();
            if line.span(g) > still && !is_bent {
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
        let has_turned = !self.turned.is_empty();
        for line in &sorted.lines {
            let g = g[line.play][0];
            let e = self.extremes[line.play][0];
            let end = line.extreme(g, side);
            let asks = end != e && (g * (end - e)).abs() > worth.ended;
            if asks || (has_turned && self.turns[line.play].is_bent()) {
                self.press_line(line, (g, end), worth, &mut gain);
            }
        }
        gain
    }

    /// The same of a source with two ends that asks for the other one, or stands between them.
    fn press_line(&mut self, line: &Line, (g, end): (f64, f64), worth: Worth, gain: &mut Gain) {
        let e = &mut self.extremes[line.play][0];
        let turn = &mut self.turns[line.play];
        let was_at_rest = turn.is_at_rest();
        let worth = match turn.is_bent() {
            true => worth.still,
            false => worth.ended,
        };
        let next = turn.next([*e, g], end, (!line.bends).then_some(line.ends), worth);
        if was_at_rest && !turn.is_at_rest() {
            self.turned.push(line.play);
        }
        gain.steps |= line.is_parameter && next != *e;
        gain.ended += (g * (next - *e)).abs();
        *e = next;
    }
}
