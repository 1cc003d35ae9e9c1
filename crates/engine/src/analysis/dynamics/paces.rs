//! How long the first steps of a piece of motion may be, by what they were before.
//!
//! A journal that meets its bearing after a long flight needs steps some hundred times as short from there on, and as long
//! ones again when it leaves. To find that out costs rejected steps at each contact, and growing ones after it; but one contact
//! is like the one before.

use super::modes::Change;

/// Kinds of changes.
const KINDS: usize = 5;

/// How a piece of motion begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Begun {
    /// The contact that has changed.
    pub contact: usize,
    /// What it did.
    pub change: Change,
    /// Whether others press.
    pub is_loaded: bool,
}

/// Lengths of steps \[s\].
#[derive(Clone)]
pub struct Paces {
    /// At the beginning of pieces, by contact and kind of its change.
    first: Vec<[Option<f64>; KINDS]>,
    /// The piece at hand, and how many of its steps have been taken.
    piece: Option<Begun>,
    taken: usize,
    /// The last step, before it was cut at an event.
    last: Option<f64>,
}

impl Paces {
    /// Of a motion with so many contacts, before its first step.
    pub fn new(contacts: usize) -> Self {
        Paces {
            first: vec![[None; KINDS]; contacts],
            piece: None,
            taken: 0,
            last: None,
        }
    }

    /// A step of this length was accepted.
    pub fn note(&mut self, length: f64) {
        self.last = Some(length);
        let Some(Begun {
            contact, change, ..
        }) = self.piece
        else {
            return;
        };
        let known = &mut self.first[contact][change as usize];
        match self.taken {
            0 => *known = Some(length),
            // The first one may have been shorter than it had to be.
            1 => *known = known.map(|known| known.max(length)),
            _ => return,
        }
        self.taken += 1;
    }

    /// A piece begins: the length of its first step; `None` if nothing is known.
    pub fn begin(&mut self, begun: Begun) -> Option<f64> {
        let known = self.first[begun.contact][begun.change as usize];
        (self.piece, self.taken) = (Some(begun), 0);
        match begun.change {
            // It becomes stiffer, and never softer.
            Change::Begin | Change::Press => known.and_then(|known| Some(known.min(self.last?))),
            // It becomes softer, unless others press.
            Change::End | Change::Release if !begun.is_loaded => known,
            Change::End | Change::Release | Change::Piece => self.last,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_begins_as_the_one_before_like_it() {
        let begun = |change| Begun {
            contact: 0,
            change,
            is_loaded: false,
        };
        let mut paces = Paces::new(1);
        paces.note(1.0);
        assert_eq!(paces.begin(begun(Change::Begin)), None);
        for length in [0.01, 0.02, 0.03] {
            paces.note(length);
        }
        assert_eq!(paces.begin(begun(Change::Piece)), Some(0.03));
        assert_eq!(paces.begin(begun(Change::End)), None);
        paces.note(0.5);
        assert_eq!(paces.begin(begun(Change::Begin)), Some(0.02));
        paces.note(0.001);
        assert_eq!(paces.begin(begun(Change::End)), Some(0.5));
        // others press, or steps are shorter anyway
        paces.note(0.002);
        let loaded = Begun {
            is_loaded: true,
            ..begun(Change::End)
        };
        assert_eq!(paces.begin(loaded), Some(0.002));
        paces.note(0.0001);
        assert_eq!(paces.begin(begun(Change::Begin)), Some(0.0001));
    }
}
