//! Where the bodies of a mechanism are, at any time between the first and the last output.
//!
//! Between outputs x, y and angle follow the cubic polynomials through values and rates of both outputs where the table has
//! rates, else straight lines; across a gap there is no pose.

use std::collections::HashMap;

use super::fault::Fault;
use super::shape::{Body, Shape};
use linkdyn_output::{Table, Trajectory};

/// Place and angle of a body's frame: x, y \[m\], angle \[rad\].
pub type Pose = [f64; 3];

/// Values of a coordinate, and its rates where the table has them.
type Coordinate = (Vec<f64>, Option<Vec<f64>>);

/// What lies farther is no place [m, rad]: tables of others may hold any number, and pictures can't.
const FARTHEST: f64 = 1e60;

/// Most poses of single bodies from which the extent of a mechanism is computed.
const MOST_POSES: usize = 200_000;

fn is_place(value: &f64) -> bool {
    value.abs() <= FARTHEST
}

/// Poses of all bodies over time.
#[derive(Debug, Clone)]
pub struct Poses {
    /// Ascending \[s\].
    pub time: Vec<f64>,
    /// x, y and angle of each body but the ground.
    bodies: Vec<[Coordinate; 3]>,
}

impl Shape {
    /// Poses of all bodies, the ground first, in so many rows of a table of results or fewer, evenly chosen; empty if columns are
    /// missing.
    pub(crate) fn poses_in(&self, table: &Trajectory, most: usize) -> Vec<Vec<Pose>> {
        let places = table
            .columns
            .iter()
            .map(|column| column.name.as_str())
            .zip(0..);
        let places: HashMap<&str, usize> = places.collect();
        let names = self.bodies.iter().skip(1);
        let columns: Option<Vec<[usize; 3]>> = names
            .map(|Body { name, .. }| {
                let [x, y, angle] =
                    ["x", "y", "angle"].map(|axis| places.get(format!("{name}.{axis}").as_str()));
                Some([*x?, *y?, *angle?])
            })
            .collect();
        let Some(columns) = columns else {
            return Vec::new();
        };
        let count = table.len();
        let step = count
            .div_ceil(most.min(MOST_POSES / self.bodies.len().max(1)).max(2))
            .max(1);
        let rows = (0..count).step_by(step).chain(count.checked_sub(1));
        let pose = |row: usize| {
            let row = &table.data[row * table.width()..];
            let moving = columns.iter().map(|places| places.map(|place| row[place]));
            let pose: Vec<Pose> = [[0.0; 3]].into_iter().chain(moving).collect();
            pose.iter().flatten().all(is_place).then_some(pose)
        };
        rows.filter_map(pose).collect()
    }
}

impl Poses {
    /// The poses of these bodies in a table of results.
    ///
    /// # Errors
    /// When columns are missing, time does not ascend, or no row has all poses.
    pub fn read(table: &Table, shape: &Shape) -> Result<Poses, Fault> {
        let fault = |error: String| Fault::Drawing(error);
        let mut missing = Vec::new();
        let mut column = |name: String, needed: bool| -> Result<Option<Vec<f64>>, Fault> {
            match table.column(&name) {
                Some(column) => table
                    .values(column)
                    .map(|values| Some(values.to_vec()))
                    .map_err(|error| fault(error.to_string())),
                None => {
                    missing.extend(needed.then_some(name));
                    Ok(None)
                }
            }
        };
        let time = column("time".into(), true)?.unwrap_or_default();
        let mut bodies = Vec::new();
        for body in shape.bodies.iter().skip(1) {
            let mut one = [const { (Vec::new(), None) }; 3];
            for (entry, [value, rate]) in
                one.iter_mut()
                    .zip([["x", "vx"], ["y", "vy"], ["angle", "omega"]])
            {
                entry.0 = column(format!("{}.{value}", body.name), true)?.unwrap_or_default();
                entry.1 = column(format!("{}.{rate}", body.name), false)?;
            }
            bodies.push(one);
        }
        if !missing.is_empty() {
            let more = missing.len().saturating_sub(4);
            let rest = if more > 0 {
                format!(" and {more} more")
            } else {
                String::new()
            };
            missing.truncate(4);
            let path = table.path.display();
            return Err(fault(format!(
                "{path}: no column {}{rest}: a picture needs the pose of every body",
                missing.join(", ")
            )));
        }
        let mut poses = Poses { time, bodies };
        poses.empty_rows_without_time();
        if poses.time.windows(2).any(|pair| pair[1] < pair[0]) {
            return Err(fault(format!(
                "{}: time does not ascend",
                table.path.display()
            )));
        }
        if (0..poses.time.len()).all(|row| poses.row(row).is_none()) {
            return Err(Fault::Nothing(
                "no instant has the poses of all bodies".into(),
            ));
        }
        Ok(poses)
    }

    /// The poses of all bodies, the ground first, one row after the other, a second apart.
    pub fn of(rows: &[Vec<Pose>]) -> Poses {
        let count = rows.iter().map(Vec::len).min().unwrap_or(0);
        let of_axis = |body: usize, axis: usize| rows.iter().map(|row| row[body][axis]).collect();
        Poses {
            time: (0..rows.len()).map(|row| row as f64).collect(),
            bodies: (1..count)
                .map(|body| [0, 1, 2].map(|axis| (of_axis(body, axis), None)))
                .collect(),
        }
    }

    /// Makes a gap of each row without a time, between its neighbours; leaves out those at the ends.
    fn empty_rows_without_time(&mut self) {
        let has_time = |time: &f64| time.is_finite();
        let first = self
            .time
            .iter()
            .position(has_time)
            .unwrap_or(self.time.len());
        let end = self
            .time
            .iter()
            .rposition(has_time)
            .map_or(first, |last| last + 1);
        let missing: Vec<usize> = (first..end)
            .filter(|&row| !self.time[row].is_finite())
            .map(|row| row - first)
            .collect();
        for column in self.columns() {
            column.truncate(end);
            column.drain(..first.min(column.len()));
        }
        for row in missing {
            self.columns().for_each(|column| column[row] = f64::NAN);
            self.time[row] = self.time[row - 1];
        }
    }

    /// Time, and values and rates of all bodies.
    fn columns(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        let coordinates = self
            .bodies
            .iter_mut()
            .flatten()
            .flat_map(|(values, rates)| [Some(values), rates.as_mut()]);
        std::iter::once(&mut self.time).chain(coordinates.flatten())
    }

    /// Poses of all bodies, the ground first, at an output.
    pub fn row(&self, row: usize) -> Option<Vec<Pose>> {
        let one = |body: &[Coordinate; 3]| -> Option<Pose> {
            let pose: Pose =
                std::array::from_fn(|axis| body[axis].0.get(row).copied().unwrap_or(f64::NAN));
            pose.iter().all(is_place).then_some(pose)
        };
        let ground = std::iter::once(Some([0.0; 3]));
        ground.chain(self.bodies.iter().map(one)).collect()
    }

    /// Poses of all bodies at a time; none in a gap.
    pub fn at(&self, time: f64) -> Option<Vec<Pose>> {
        let after = self.time.partition_point(|&t| t < time);
        if after == 0 || after == self.time.len() {
            return self.row(after.min(self.time.len() - 1));
        }
        if self.time[after] == time {
            return self.row(after);
        }
        let (from, to) = (self.row(after - 1)?, self.row(after)?);
        let span = self.time[after] - self.time[after - 1];
        let part = (time - self.time[after - 1]) / span;
        let rate = |body: usize, axis: usize, row: usize| -> Option<f64> {
            let rates = self.bodies[body].get(axis)?.1.as_ref()?;
            rates.get(row).copied().filter(is_place)
        };
        let between = |body: usize, axis: usize| {
            let (a, b) = (from[body][axis], to[body][axis]);
            let straight = a + part * (b - a);
            let rates = if body == 0 {
                None
            } else {
                rate(body - 1, axis, after - 1).zip(rate(body - 1, axis, after))
            };
            let curved = rates.map(|(va, vb)| {
                let rest = 1.0 - part;
                let bend = rest * (va * span - (b - a)) - part * (vb * span - (b - a));
                straight + part * rest * bend
            });
            curved.filter(is_place).unwrap_or(straight)
        };
        Some(
            (0..from.len())
                .map(|body| std::array::from_fn(|axis| between(body, axis)))
                .collect(),
        )
    }

    /// First and last time with all poses.
    pub fn span(&self) -> [f64; 2] {
        let mut rows = (0..self.time.len()).filter(|&row| self.row(row).is_some());
        let first = rows.next().unwrap_or(0);
        [
            self.time[first],
            self.time[rows.next_back().unwrap_or(first)],
        ]
    }
}

/// A point of a body, in global coordinates.
pub fn global([x, y, angle]: Pose, [u, v]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x + cos * u - sin * v, y + sin * u + cos * v]
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_output::read::ReadColumn;

    /// A body that turns by t², of which only every full second is known.
    fn table(with_rates: bool) -> Table {
        let column = |name: &str, value: fn(f64) -> f64| {
            let values = (0..5).map(|t| value(f64::from(t)));
            ReadColumn::new(name, "m", values.collect())
        };
        let mut columns = vec![
            column("time", |t| t),
            column("a.x", |_| 1.0),
            column("a.y", |_| 2.0),
            column("a.angle", |t| t * t),
        ];
        if with_rates {
            columns.push(column("a.omega", |t| 2.0 * t));
        }
        Table {
            path: "r.csv".into(),
            columns,
        }
    }

    fn shape() -> Shape {
        let body = |name: &str| Body {
            name: name.into(),
            ..Body::default()
        };
        Shape {
            bodies: vec![body("ground"), body("a")],
            ..Shape::default()
        }
    }

    #[test]
    fn between_outputs_rates_are_followed() {
        let poses = Poses::read(&table(true), &shape()).expect("sound");
        for t in [0.0, 0.25, 1.5, 3.75, 4.0] {
            let pose = poses.at(t).expect("no gap")[1];
            assert!(
                (pose[2] - t * t).abs() < 1e-12 && pose[..2] == [1.0, 2.0],
                "{t}: {pose:?}"
            );
        }
        let straight = Poses::read(&table(false), &shape()).expect("sound");
        assert_eq!(straight.at(1.5).expect("no gap")[1][2], 2.5);
    }

    #[test]
    fn across_gaps_there_is_no_pose() {
        let mut table = table(true);
        table.columns[3].values[2] = f64::NAN;
        let poses = Poses::read(&table, &shape()).expect("sound");
        assert!(
            poses.at(1.5).is_none()
                && poses.at(2.0).is_none()
                && poses.at(0.5).is_some()
                && poses.at(3.0).is_some()
        );
        assert_eq!(poses.span(), [0.0, 4.0]);
    }

    #[test]
    fn a_row_without_time_is_a_gap() {
        let mut table = table(true);
        table.columns[0].values = vec![f64::NAN, 1.0, f64::NAN, 3.0, 4.0];
        let poses = Poses::read(&table, &shape()).expect("sound");
        assert_eq!(
            (poses.span(), poses.time.as_slice()),
            ([1.0, 4.0], [1.0, 1.0, 3.0, 4.0].as_slice())
        );
        assert!(poses.at(1.5).is_none() && poses.at(2.9).is_none());
        for t in [1.0, 3.0, 3.5, 4.0] {
            assert!(
                (poses.at(t).expect("no gap")[1][2] - t * t).abs() < 1e-12,
                "{t}"
            );
        }
        table.columns[0].values.fill(f64::NAN);
        let said = Poses::read(&table, &shape())
            .expect_err("no time at all")
            .to_string();
        assert!(
            said.contains("no instant has the poses of all bodies"),
            "{said}"
        );
    }

    #[test]
    fn missing_columns_are_named() {
        let mut table = table(true);
        table.columns.remove(1);
        let said = Poses::read(&table, &shape()).expect_err("no x").to_string();
        assert_eq!(
            said,
            "r.csv: no column a.x: a picture needs the pose of every body"
        );
    }

    #[test]
    fn points_turn_with_their_body() {
        let [x, y] = global([1.0, 2.0, std::f64::consts::FRAC_PI_2], [3.0, 0.0]);
        assert!((x - 1.0).abs() < 1e-15 && (y - 5.0).abs() < 1e-15);
    }
}
