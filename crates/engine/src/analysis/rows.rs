//! Rows of results read back: poses, velocities and joint forces by name, for what follows from them.

use std::collections::HashMap;

use linkdyn_linear::math::Vec2;
use linkdyn_model::{GROUND, Model, PointRef};
use linkdyn_output::Trajectory;

/// Where the columns of a table stand.
pub struct Columns<'t>(HashMap<&'t str, usize>);

impl<'t> Columns<'t> {
    pub fn of(table: &'t Trajectory) -> Self {
        Columns(
            table
                .columns
                .iter()
                .enumerate()
                .map(|(index, column)| (column.name.as_str(), index))
                .collect(),
        )
    }

    /// Columns `owner.quantity` of all these quantities; none where one is missing.
    pub fn find<const N: usize>(&self, owner: &str, quantities: [&str; N]) -> Option<[usize; N]> {
        let found =
            quantities.map(|quantity| self.0.get(format!("{owner}.{quantity}").as_str()).copied());
        found
            .iter()
            .all(Option::is_some)
            .then(|| found.map(Option::unwrap_or_default))
    }
}

/// A body's frame in a row; ground where there are no columns.
#[derive(Debug, Clone, Copy)]
pub struct Frame(Option<[usize; 3]>);

impl Frame {
    /// The frame of the named body; none where its pose is not in the table.
    pub fn of(columns: &Columns, body: &str) -> Option<Self> {
        if body == GROUND {
            Some(Frame(None))
        } else {
            Some(Frame(Some(columns.find(body, ["x", "y", "angle"])?)))
        }
    }

    /// Origin \[m\] and angle \[rad\].
    pub fn pose(self, row: &[f64]) -> (Vec2, f64) {
        self.0.map_or((Vec2::zeros(), 0.0), |[x, y, angle]| {
            (Vec2::new(row[x], row[y]), row[angle])
        })
    }

    /// A vector of the body in the ground's axes.
    pub fn turn(self, row: &[f64], vector: Vec2) -> Vec2 {
        let (sin, cos) = self.pose(row).1.sin_cos();
        Vec2::new(
            cos * vector.x - sin * vector.y,
            sin * vector.x + cos * vector.y,
        )
    }
}

/// A body's point in a row.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub frame: Frame,
    /// In the body's frame \[m\].
    pub point: Vec2,
}

impl Place {
    /// Where the named point is; none where its body's pose is not in the table.
    pub fn of(model: &Model, columns: &Columns, point: &PointRef) -> Option<Self> {
        let at = *model.bodies.get(&point.body)?.points.get(&point.point)?;
        Some(Place {
            frame: Frame::of(columns, &point.body)?,
            point: Vec2::from(at),
        })
    }

    /// Global coordinates \[m\].
    pub fn at(&self, row: &[f64]) -> Vec2 {
        self.frame.pose(row).0 + self.frame.turn(row, self.point)
    }
}
