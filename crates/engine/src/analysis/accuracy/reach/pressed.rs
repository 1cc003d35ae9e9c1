//! The deviations, each where the load presses it.

use super::super::source::Play;
use super::Displaced;
use super::bordered::Bordered;

/// What has ends changes them so many times in one solution: then what it gains falls as it gives way.
const MOST_TURNS: u8 = 2;
/// Another end is tried where it gains more than this part of what all sources do.
const WORTH: f64 = 1e-11;

impl Bordered<'_, '_> {
    /// Chooses the deviations of a position.
    pub fn choose(&mut self, at: &Displaced) {
        self.turned.fill(0);
        let extremes = &mut self.mechanism.chosen.extremes;
        extremes.copy_from_slice(&at.extremes);
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
        let each = extremes.iter_mut().zip(plays).zip(&self.influences);
        for (((e, play), g), turned) in each.zip(&mut self.turned) {
            let end = play.extreme(*g, 1.0);
            let gain = g[0] * (end[0] - e[0]) + g[1] * (end[1] - e[1]);
            let is_disc = matches!(play, Play::Pin { .. } | Play::Zone { .. });
            let is_free = is_disc || *e == [0.0; 2];
            let worth = all * self.still.max(if is_free { 0.0 } else { WORTH });
            if gain <= worth || end == *e || (!is_disc && *turned >= MOST_TURNS) {
                continue;
            }
            is_moved = true;
            if !is_disc {
                has_jumped = true;
                *turned += 1;
            }
            *e = end;
        }
        if is_moved {
            self.place()?;
        }
        Some(has_jumped)
    }
}
