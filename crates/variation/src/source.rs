//! Where deviations come from, and how far each can carry an output.
//!
//! With g = ∂y/∂e of the deviation e that a source makes (of a joint −λ, the reaction under a unit load on the output):
//!
//! ```text
//!                                        e that are allowed (`Room`)       reach                  e with the greatest g·e
//! pin, clearance c                       |e| ≤ c                           c|g|                   c g/|g|
//! zone about a point, diameter t         |e| ≤ t/2                         t/2·|g|
//! slot, slide without length, play c     |e| ≤ c                           c|g|
//! slide of length L on its guide         |e| + |γ| L/2 ≤ c                 c·max(|g_e|, 2|g_γ|/L) one corner
//! gear, backlash j                       |e| ≤ j/2 on the pitch circle     j/2·|g|/R₂
//! driver, tolerance t                    |e| ≤ t                           t|g|
//! parameter, from l to u                 l ≤ e ≤ u                         max(l g, u g)
//! ```

use super::geometry::PointId;

/// How a parameter scatters within its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scatter {
    /// Normal, its limits at so many standard deviations.
    Normal(f64),
    /// All values alike.
    Uniform,
    /// Falling from the middle to the limits in straight lines.
    Triangular,
}

/// What is off: one or two numbers of a source, or ∂y by them.
pub(super) type Pair = [f64; 2];

/// a·b.
pub(super) fn dot(a: Pair, b: Pair) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// |g|.
pub(super) fn length(g: Pair) -> f64 {
    dot(g, g).sqrt()
}

/// What is off, and by how much.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Source {
    /// What the file calls it.
    pub name: String,
    pub kind: Kind,
    pub room: Room,
    pub acts: Acts,
}

/// What it is, as far as statistics and forces ask.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// A clearance or play, from its least on; the greatest is the size of the room.
    Clearance {
        least: f64,
    },
    Driver,
    Zone,
    Parameter(Scatter),
}

/// The deviations that are allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Room {
    /// Any direction, up to a radius \[m\].
    Disc(f64),
    /// One number from one end to the other.
    Line([f64; 2]),
    /// A gap and a turn together: |e| + |γ| L/2 ≤ gap.
    Guide { gap: f64, length: f64 },
}

/// Where in the equations it stands.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Acts {
    /// In rows from this one on.
    Row(usize),
    /// A point is anywhere in its zone.
    Point(PointId),
    /// What a unit of a parameter changes in the dimensions, and whether what it changes is curved: then steps are read from
    /// the model, and it stands at its ends only.
    Dimensions {
        steps: Vec<(usize, f64)>,
        is_curved: bool,
    },
}

impl Source {
    /// Whether it lets anything be off.
    pub fn is_off(&self) -> bool {
        self.room.most() > 0.0
    }

    /// Whether it goes only from one end to the other.
    pub fn is_curved(&self) -> bool {
        matches!(
            self.acts,
            Acts::Dimensions {
                is_curved: true,
                ..
            }
        )
    }

    /// Least and greatest clearance, where it is one.
    pub fn clearance(&self) -> Option<[f64; 2]> {
        match self.kind {
            Kind::Clearance { least } => Some([least, self.room.most()]),
            Kind::Driver | Kind::Zone | Kind::Parameter(_) => None,
        }
    }
}

impl Room {
    /// The greatest of its numbers.
    pub fn most(&self) -> f64 {
        match *self {
            Room::Disc(radius) => radius,
            Room::Line([low, high]) => low.abs().max(high.abs()),
            Room::Guide { gap, .. } => gap,
        }
    }

    /// How many numbers it has.
    pub fn numbers(&self) -> usize {
        match self {
            Room::Disc(_) | Room::Guide { .. } => 2,
            Room::Line(_) => 1,
        }
    }

    /// How far a unit of its size carries the output.
    pub fn norm(&self, g: Pair) -> f64 {
        match *self {
            Room::Disc(_) => length(g),
            Room::Line(_) => g[0].abs(),
            Room::Guide { length, .. } => g[0].abs().max(2.0 * g[1].abs() / length),
        }
    }

    /// Least and greatest g·e.
    pub fn reach(&self, g: Pair) -> [f64; 2] {
        match *self {
            Room::Line([low, high]) => {
                let (a, b) = (low * g[0], high * g[0]);
                [a.min(b), a.max(b)]
            }
            Room::Disc(most) | Room::Guide { gap: most, .. } => {
                let reach = most * self.norm(g);
                [-reach, reach]
            }
        }
    }

    /// By how much the output differs between both sides.
    pub fn span(&self, g: Pair) -> f64 {
        let [down, up] = self.reach(g);
        up - down
    }

    /// The e with the greatest g·e; `None` if nothing has an influence.
    pub fn extreme(&self, g: Pair) -> Option<Pair> {
        if g == [0.0; 2] {
            return None;
        }
        Some(match *self {
            Room::Disc(radius) => g.map(|own| own * (radius / length(g))),
            Room::Line([low, high]) => [if g[0] >= 0.0 { high } else { low }, 0.0],
            Room::Guide { gap, length } if g[0].abs() >= 2.0 * g[1].abs() / length => {
                [gap * g[0].signum(), 0.0]
            }
            Room::Guide { gap, length } => [0.0, g[1].signum() * 2.0 * gap / length],
        })
    }

    /// The e nearest to none.
    pub fn rest(&self) -> Pair {
        match *self {
            Room::Line([low, high]) => [0.0_f64.clamp(low, high), 0.0],
            Room::Disc(_) | Room::Guide { .. } => [0.0; 2],
        }
    }

    /// How far each number may be off.
    pub fn radii(&self) -> Pair {
        match *self {
            Room::Disc(radius) => [radius; 2],
            Room::Line([low, high]) => [0.5 * (high - low); 2],
            Room::Guide { gap, length } => [gap, 2.0 * gap / length],
        }
    }

    /// The allowed e nearest to another one, each number measured by its radius.
    pub fn nearest(&self, e: Pair) -> Pair {
        match *self {
            Room::Disc(radius) => {
                let scale = (radius / length(e)).min(1.0);
                e.map(|own| scale * own)
            }
            Room::Line([low, high]) => [e[0].clamp(low, high), 0.0],
            Room::Guide { .. } => {
                let radii = self.radii();
                let [u, v] = [e[0] / radii[0], e[1] / radii[1]];
                let beyond = 0.5 * (u.abs() + v.abs() - 1.0);
                if beyond <= 0.0 {
                    return e;
                }
                let less = |u: f64| u.signum() * (u.abs() - beyond).clamp(0.0, 1.0);
                [radii[0] * less(u), radii[1] * less(v)]
            }
        }
    }

    /// The sides opposite to an e.
    pub fn others(&self, e: Pair) -> Vec<Pair> {
        match *self {
            Room::Line(ends) => {
                let others = ends.into_iter().filter(|end| *end != e[0]);
                others.map(|end| [end, 0.0]).collect()
            }
            Room::Disc(_) | Room::Guide { .. } => vec![e.map(|e| -e)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of all gaps and turns that |e| + |γ| L/2 ≤ c allows the extreme one carries the output farthest, as far as the reach says.
    #[test]
    fn a_guided_slider_goes_to_a_corner_of_its_room() {
        let (gap, length) = (0.03, 0.4);
        let room = Room::Guide { gap, length };
        // By the gap, by the turn, both alike, either sign.
        let cases = [
            ([2.0, 0.1], gap * 2.0),
            ([-0.3, 0.5], gap * 2.5),
            ([1.0, -0.2], gap * 1.0),
        ];
        for (g, reach) in cases {
            let [down, up] = room.reach(g);
            assert!((up - reach).abs() < 1e-16 && down == -up, "{g:?}: {up}");
            let e = room.extreme(g).expect("an influence");
            let used = e[0].abs() + 0.5 * length * e[1].abs();
            assert!((used - gap).abs() < 1e-17, "{e:?}");
            assert!((dot(g, e) - up).abs() < 1e-16, "{g:?}: {e:?}");
            // Nothing nearer than a corner is allowed beyond it.
            let there = room.nearest(e.map(|e| 3.0 * e));
            assert!(dot(there, g) <= up * (1.0 + 1e-15), "{there:?}");
        }
        assert_eq!(room.extreme([0.0; 2]), None);
    }
}
