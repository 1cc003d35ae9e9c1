//! Laws that repeat, held between two of their breaks: beyond these they go on as they are there.
//!
//! So a motion over which such a law stands is smooth until the break that it comes to is located.

use super::{Jet, Pieces};

impl Pieces {
    /// Where the stretches between breaks begin in a cycle.
    fn breaks(&self) -> impl Iterator<Item = usize> + '_ {
        let pieces = self.pieces.iter().enumerate();
        let broken = pieces.filter(|(k, piece)| *k == 0 || !piece.is_smooth);
        broken.map(|(k, _)| k)
    }

    /// The number of the stretch between breaks around `t`, within a cycle.
    pub fn stretch(&self, t: f64) -> i32 {
        let (_, local) = self.fold(t);
        let begun = self.breaks().take_while(|&k| self.pieces[k].from <= local);
        begun.count().max(1) as i32 - 1
    }

    /// f, f′, f″ at `t` as of this stretch, and how far beyond its ends that is.
    pub fn held(&self, t: f64, stretch: i32) -> (Jet, f64) {
        let mut breaks = self.breaks().skip(stretch.max(0) as usize);
        let first = breaks.next().unwrap_or(0);
        let next = breaks.next().unwrap_or(self.pieces.len());
        let to = self.pieces.get(next).map_or(self.end, |piece| piece.from);
        let from = self.pieces[first].from;
        let turns = ((t - 0.5 * (from + to)) / self.period()).round();
        let local = t - turns * self.period();
        let own = &self.pieces[first..next];
        let after = own.partition_point(|piece| piece.from <= local).max(1);
        (own[after - 1].jet(local), (from - local).max(local - to))
    }
}
