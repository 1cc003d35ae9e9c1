//! The deviations, each where the load presses it.

use super::super::source::Play;
use super::super::turn::Turn;
use super::Displaced;
use super::bordered::Bordered;

/// A guided slider changes its corner so many times in one solution: then what it gains falls as it gives way.
const MOST_TURNS: u8 = 2;
/// Another end is tried where it gains more than this part of what all sources do.
const WORTH: f64 = 1e-11;

impl Bordered<'_, '_> {
    /// Chooses the deviations of a position.
    pub fn choose(&mut self, at: &Displaced) {
        self.turned.fill(0);
        let extremes = &mut self.mechanism.chosen.extremes;
        extremes.copy_from_slice(&at.extremes);
        let each = self.turns.iter_mut().zip(&at.turns).zip(extremes);
        for (((turn, own), e), play) in each.zip(self.mechanism.plays) {
            let ends = play.ends();
            *turn = ends.map_or(Turn::default(), |ends| own.ahead([e[0], 0.0], ends));
        }
    }

    /// Steps of the parameters, points and gaps for the deviations chosen, at the position taken.
    pub fn place(&mut self) -> Option<()> {
        if !self.mechanism.step_parameters() {
            return None;
        }
        self.mechanism.place(self.stand);
        self.mechanism.gap(self.stand);
        Some(())
    }

    /// Chooses the deviations that the load presses, at the position taken. Whether any went to another end; none where the
    /// model can't be had with them.
    pub fn press(&mut self) -> Option<bool> {
        self.mechanism
            .influences(self.stand, self.output, &self.load, &mut self.influences);
        let plays = self.mechanism.plays;
        let each = plays.iter().zip(&self.influences);
        let all: f64 = each
            .map(|(play, g)| {
                let [down, up] = play.reach(*g);
                up - down
            })
            .sum();
        let (mut has_jumped, mut is_moved) = (false, false);
        let extremes = &mut self.mechanism.chosen.extremes;
        let each = extremes.iter_mut().zip(&mut self.turns).zip(plays);
        for ((((e, turn), play), g), turned) in each.zip(&self.influences).zip(&mut self.turned) {
            let end = play.extreme(*g, 1.0);
            let gain = g[0] * (end[0] - e[0]) + g[1] * (end[1] - e[1]);
            let is_disc = matches!(play, Play::Pin { .. } | Play::Zone { .. });
            let is_free = is_disc || turn.is_bent() || *e == [0.0; 2];
            let least = if is_free { 0.0 } else { WORTH };
            let worth = all * self.still.max(least);
            let next = match play.ends() {
                Some(ends) => {
                    let bends = matches!(play, Play::Parameter { bends: true, .. });
                    let ends = (!bends).then_some(ends);
                    [turn.next([e[0], g[0]], end[0], ends, worth), 0.0]
                }
                None if gain <= worth || *turned >= MOST_TURNS => continue,
                None => end,
            };
            if next == *e {
                continue;
            }
            is_moved = true;
            if !is_disc {
                has_jumped |= !turn.is_bent();
                *turned += u8::from(play.ends().is_none());
            }
            *e = next;
        }
        if is_moved {
            self.place()?;
        }
        Some(has_jumped)
    }
}
