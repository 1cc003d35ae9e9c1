//! Where the coordinates of each body stand in the vectors of the whole, q, v, a, Q (n).
//!
//! ```text
//! body     ground   1         2         3      …
//! q        –        x y θ     x y θ     x y θ  …      x, y of the centre of mass [m], θ [rad]
//! ```
//!
//! The columns of a body stand together. Nobody else counts them: a body with more coordinates than these (elastic ones,
//! behind its θ) changes [`Layout`] alone.

use std::ops::Range;

/// A body of the system; 0 is ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct BodyId(pub usize);

impl BodyId {
    /// The body that does not move, and has no coordinates.
    pub const GROUND: BodyId = BodyId(0);

    /// The moving body at `index` of those that move.
    pub fn moving(index: usize) -> Self {
        BodyId(index + 1)
    }

    /// Its place among the bodies that move; none of ground.
    pub fn index(self) -> Option<usize> {
        self.0.checked_sub(1)
    }
}

/// Coordinate of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Of the centre of mass \[m\].
    X = 0,
    /// Of the centre of mass \[m\].
    Y = 1,
    /// Of the body's frame \[rad\].
    Theta = 2,
}

impl Axis {
    /// All of a body, in the order of their columns.
    pub const ALL: [Axis; 3] = [Axis::X, Axis::Y, Axis::Theta];

    /// Whether it is measured in radians.
    pub fn is_angle(self) -> bool {
        match self {
            Axis::X | Axis::Y => false,
            Axis::Theta => true,
        }
    }
}

/// Number of coordinates that the place of a rigid body takes.
const PLACE: usize = Axis::ALL.len();

/// Columns of one moving body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BodyColumns {
    first: usize,
}

impl BodyColumns {
    /// Column of x.
    pub fn x(self) -> usize {
        self.first
    }

    /// Column of y.
    pub fn y(self) -> usize {
        self.first + 1
    }

    /// Column of θ.
    pub fn theta(self) -> usize {
        self.first + 2
    }

    /// Column of one coordinate.
    pub fn column(self, axis: Axis) -> usize {
        self.first + axis as usize
    }

    /// All columns of the body.
    pub fn range(self) -> Range<usize> {
        self.first..self.first + PLACE
    }

    /// (x, y, θ) of a vector (n).
    pub fn read(self, values: &[f64]) -> [f64; 3] {
        let place = &values[self.range()];
        [place[0], place[1], place[2]]
    }

    /// Sets (x, y, θ) of a vector (n).
    pub fn write(self, values: &mut [f64], place: [f64; 3]) {
        values[self.range()].copy_from_slice(&place);
    }
}

/// The columns of all moving bodies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layout {
    bodies: usize,
}

impl Layout {
    /// Of rigid bodies, so many of which move.
    pub fn rigid(bodies: usize) -> Self {
        Layout { bodies }
    }

    /// Number of coordinates n.
    pub fn n(&self) -> usize {
        PLACE * self.bodies
    }

    /// Columns of a body; none of ground.
    pub fn columns(&self, body: BodyId) -> Option<BodyColumns> {
        body.index().map(|index| self.moving(index))
    }

    /// Columns of the moving body at `index` of those that move.
    pub fn moving(&self, index: usize) -> BodyColumns {
        BodyColumns {
            first: PLACE * index,
        }
    }

    /// Columns of every moving body.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = BodyColumns> + use<'_> {
        (0..self.bodies).map(move |index| self.moving(index))
    }

    /// Column of a coordinate; none of ground's.
    pub fn column(&self, body: BodyId, axis: Axis) -> Option<usize> {
        self.columns(body).map(|columns| columns.column(axis))
    }

    /// The coordinate that has a column.
    pub fn coordinate(&self, column: usize) -> (BodyId, Axis) {
        (BodyId::moving(column / PLACE), Axis::ALL[column % PLACE])
    }

    /// Whether a column is an angle \[rad\], else a length \[m\].
    pub fn is_angle(&self, column: usize) -> bool {
        let (_, axis) = self.coordinate(column);
        axis.is_angle()
    }

    /// The angles of all moving bodies in a vector (n).
    pub fn angles<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.bodies().map(|body| values[body.theta()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_belongs_to_one_coordinate() {
        let layout = Layout::rigid(4);
        let mut seen = vec![0; layout.n()];
        for body in 1..=4 {
            let columns = layout.columns(BodyId(body)).expect("a moving body");
            assert_eq!(columns.range().len(), Axis::ALL.len());
            for axis in Axis::ALL {
                let column = columns.column(axis);
                seen[column] += 1;
                assert!(columns.range().contains(&column));
                assert_eq!(layout.column(BodyId(body), axis), Some(column));
                assert_eq!(layout.coordinate(column), (BodyId(body), axis));
                assert_eq!(layout.is_angle(column), axis == Axis::Theta);
            }
        }
        assert!(seen.iter().all(|times| *times == 1), "{seen:?}");
        assert_eq!(layout.columns(BodyId::GROUND), None);
        assert_eq!(layout.column(BodyId::GROUND, Axis::X), None);
    }

    #[test]
    fn what_is_written_is_read() {
        let layout = Layout::rigid(3);
        let mut q = vec![0.0; layout.n()];
        for (index, body) in layout.bodies().enumerate() {
            let k = index as f64;
            body.write(&mut q, [k, 10.0 + k, 20.0 + k]);
        }
        assert_eq!(layout.moving(2).read(&q), [2.0, 12.0, 22.0]);
        assert_eq!(q[layout.moving(1).y()], 11.0);
        assert_eq!(layout.angles(&q).collect::<Vec<_>>(), [20.0, 21.0, 22.0]);
    }
}
