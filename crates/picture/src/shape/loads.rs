//! What the loads are over time. The law of a load is the engine's; here are its values at some instants.

use super::parts::{Load, Shape};
use linkdyn_output::{Channel, LoadQuantity, Trajectory};

/// Instants of one load, at most, and of all loads together.
const MOST_INSTANTS: usize = 400;
const MOST_VALUES: usize = 20_000;

impl Shape {
    /// Takes the values of the loads from a table of applied forces and torques, row by row at `times` \[s\].
    pub fn take_loads(&mut self, times: &[f64], applied: &Trajectory) {
        let most = MOST_INSTANTS.min(MOST_VALUES / self.loads.len().max(1));
        for load in &mut self.loads {
            let values = |wanted: LoadQuantity| {
                let is_wanted =
                    |channel| matches!(channel, Some(Channel::Load(_, found)) if found == wanted);
                let mut columns = applied.columns.iter();
                let heading = columns
                    .find(|column| column.owner == load.name && is_wanted(column.channel))?;
                let column = applied.column(applied.id_of(heading)?);
                Some(column.iter().collect::<Vec<f64>>())
            };
            let components = match load.at {
                Some(_) => values(LoadQuantity::Fx).zip(values(LoadQuantity::Fy)),
                None => values(LoadQuantity::Torque).map(|torque| {
                    let none = vec![0.0; torque.len()];
                    (torque, none)
                }),
            };
            if let Some((first, second)) = components {
                load.take(times, &first, &second, most.max(2));
            }
        }
    }
}

impl Load {
    /// Keeps `most` instants or so, the last among them; one where nothing changes.
    fn take(&mut self, times: &[f64], first: &[f64], second: &[f64], most: usize) {
        let rows: Vec<usize> = (0..times.len())
            .filter(|&row| [times, first, second].iter().all(|of| of[row].is_finite()))
            .collect();
        let Some(&last) = rows.last() else { return };
        let value = |row: usize| [first[row], second[row]];
        let is_constant = rows.iter().all(|&row| value(row) == value(last));
        let step = rows.len().div_ceil(most).max(1);
        let mut kept: Vec<usize> = rows.into_iter().step_by(step).collect();
        if is_constant {
            kept.truncate(1);
        } else if kept.last() != Some(&last) {
            kept.push(last);
        }
        self.times = kept.iter().map(|&row| times[row]).collect();
        self.values = kept.iter().map(|&row| value(row)).collect();
    }

    /// Value at a time, linear between instants; `None` if no value is known.
    pub fn at_time(&self, time: f64) -> Option<[f64; 2]> {
        let after = self.times.partition_point(|&t| t <= time);
        let [Some(low), Some(high)] = [after.checked_sub(1), Some(after)]
            .map(|row| row.filter(|&row| row < self.values.len()))
        else {
            return match after {
                0 => self.values.first().copied(),
                _ => self.values.last().copied(),
            };
        };
        let part = (time - self.times[low]) / (self.times[high] - self.times[low]);
        let [from, to] = [self.values[low], self.values[high]];
        Some([0, 1].map(|k| from[k] + part * (to[k] - from[k])))
    }

    /// Largest magnitude over time.
    pub fn largest(&self) -> f64 {
        let sizes = self.values.iter().map(|[x, y]| x.hypot(*y));
        sizes.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkdyn_output::Column;

    fn shape() -> Shape {
        let load = |name: &str, at| Load {
            name: name.into(),
            at,
            body: 1,
            ..Load::default()
        };
        Shape {
            loads: vec![load("push", Some((1, 0))), load("twist", None)],
            ..Shape::default()
        }
    }

    #[test]
    fn a_load_is_known_between_its_instants() {
        let column = |load, quantity: LoadQuantity, name| {
            Column::of(Channel::Load(load, quantity), name, quantity.unit())
        };
        let mut table = Trajectory::new(vec![
            column(0, LoadQuantity::Fx, "push"),
            column(0, LoadQuantity::Fy, "push"),
            column(1, LoadQuantity::Torque, "twist"),
        ]);
        let times: Vec<f64> = (0..1001).map(|row| f64::from(row) * 0.01).collect();
        for t in &times {
            table.push_row(&[2.0 * t, -1.0, 5.0]);
        }
        let mut shape = shape();
        shape.take_loads(&times, &table);
        let [push, twist] = &shape.loads[..] else {
            panic!("two loads")
        };
        assert!(
            (100..=401).contains(&push.times.len()),
            "{}",
            push.times.len()
        );
        for (time, expected) in [
            (-1.0, 0.0),
            (0.0, 0.0),
            (3.333, 6.666),
            (10.0, 20.0),
            (11.0, 20.0),
        ] {
            let [x, y] = push.at_time(time).expect("known");
            assert!((x - expected).abs() < 1e-9 && y == -1.0, "{time}: {x}");
        }
        assert_eq!(
            (twist.times.len(), twist.at_time(7.0)),
            (1, Some([5.0, 0.0]))
        );
        assert_eq!(push.largest(), 20.0_f64.hypot(1.0));
    }

    #[test]
    fn rows_without_a_value_are_left_out() {
        let mut table = Trajectory::new(vec![Column::of(
            Channel::Load(1, LoadQuantity::Torque),
            "twist",
            "N*m",
        )]);
        for value in [1.0, f64::NAN, 3.0] {
            table.push_row(&[value]);
        }
        let mut shape = shape();
        shape.take_loads(&[0.0, 1.0, 2.0], &table);
        assert_eq!(shape.loads[1].at_time(1.0), Some([2.0, 0.0]));
        assert_eq!(shape.loads[0].at_time(1.0), None, "no columns of this one");
    }
}
