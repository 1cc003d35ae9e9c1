//! Where the motion starts, and the coordinates that are independent there.
//!
//! Dependent coordinates are the pivots of Gaussian elimination of the rows of loops and drivers; what remains is independent. Of pivots
//! that are good enough the one is taken whose coordinate one would give last: those of cranks, and of bodies that come first in the
//! model, stay independent where that is possible.

use linkdyn_model::error::{Complaint, Complaints};

use super::linkage::{CoordinateKind, Linkage};
use super::place::{Plane, dot, turned};

/// Pivots are as good as the largest down to this part of it \[1\].
const GOOD: f64 = 0.1;
/// Rows whose largest entry is below this part of the mechanism's length depend on others \[1\].
const DEPENDENT: f64 = 1e-8;

/// A body at an instant, by the origin of its frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyState {
    /// \[m\]
    pub position: Plane,
    /// \[rad\]
    pub angle: f64,
    /// [m/s]
    pub velocity: Plane,
    /// [rad/s]
    pub omega: f64,
    /// [m/s²]
    pub acceleration: Plane,
    /// [rad/s²]
    pub alpha: f64,
}

/// The state at t = 0 that was computed otherwise.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StartState {
    /// Bodies but the ground, in the order of the model.
    pub bodies: Vec<BodyState>,
    /// What drivers exert, in the order of the model \[N·m, N\].
    pub efforts: Vec<f64>,
}

/// A linkage at a start, with its independent coordinates: all that is written.
#[derive(Debug, Clone, PartialEq)]
pub struct Equations {
    /// The terms.
    pub linkage: Linkage,
    /// Independent coordinates, ascending.
    pub independent: Vec<usize>,
    /// Coordinates \[rad, m\].
    pub start: Vec<f64>,
    /// Their rates.
    pub rates: Vec<f64>,
    /// What one radian and the mechanism's length are to each coordinate: 1 or metres.
    pub scales: Vec<f64>,
    /// Accelerations of the centres of mass [m/s²] and angular ones [rad/s²].
    pub accelerations: Vec<(Plane, f64)>,
    /// What drivers exert \[N·m, N\].
    pub efforts: Vec<f64>,
}

impl Linkage {
    /// At a start.
    ///
    /// # Errors
    /// Where loops and drivers are not independent of each other.
    pub fn at(self, state: &StartState) -> Result<Equations, Complaints> {
        let (start, rates) = self.coordinates_of(state);
        let lengths = self.vectors.iter().filter(|own| !own.is_direction);
        let lengths = lengths.map(|own| own.value[0].hypot(own.value[1]));
        let length = match lengths.fold(0.0, f64::max) {
            0.0 => 1.0,
            length => length,
        };
        let scales = self.coordinates.iter().map(|own| match own.kind {
            CoordinateKind::Angle => 1.0,
            CoordinateKind::Slide | CoordinateKind::Free(_) => length,
        });
        let scales: Vec<f64> = scales.collect();
        let dependent = self.dependent(&start, &scales, length)?;
        let all = 0..self.coordinates.len();
        let independent: Vec<usize> = all.filter(|k| !dependent.contains(k)).collect();
        if independent.is_empty() && self.drives.is_empty() {
            let message =
                "the joints let no body move, so that there is nothing to write as equations";
            let hint = "`linkdyn check` counts the degrees of freedom";
            return Err(Complaint::new("joints", message).hint(hint).into());
        }
        let bodies = self.bodies.iter().zip(&state.bodies);
        let accelerations = bodies.map(|(body, state)| {
            let arm = turned(body.com, state.angle);
            let part = |k: usize| {
                let across = [-arm[1], arm[0]][k];
                state.acceleration[k] + state.alpha * across - state.omega * state.omega * arm[k]
            };
            ([part(0), part(1)], state.alpha)
        });
        let accelerations = accelerations.collect();
        Ok(Equations {
            independent,
            start,
            rates,
            scales,
            accelerations,
            efforts: state.efforts.clone(),
            linkage: self,
        })
    }

    /// Coordinates and rates of a state.
    fn coordinates_of(&self, state: &StartState) -> (Vec<f64>, Vec<f64>) {
        let body = |name: &str| {
            let number = self.bodies.iter().position(|own| own.name == name);
            let state = number.and_then(|number| state.bodies.get(number));
            state.copied().unwrap_or_default()
        };
        let mut slides = self.slides.iter();
        let values = self.coordinates.iter().map(|own| match own.kind {
            CoordinateKind::Angle => (body(&own.of).angle, body(&own.of).omega),
            CoordinateKind::Slide => {
                let Some(slide) = slides.next() else {
                    return (0.0, 0.0);
                };
                let [first, second] = slide.bodies.each_ref().map(|name| body(name));
                let (place, rate) = first.at(slide.points[0]);
                let (other, other_rate) = second.at(slide.points[1]);
                let axis = turned(slide.axis, first.angle);
                let difference = |a: Plane, b: Plane| [b[0] - a[0], b[1] - a[1]];
                // The points are on the line, so that its turning does not count.
                (
                    dot(axis, difference(place, other)),
                    dot(axis, difference(rate, other_rate)),
                )
            }
            CoordinateKind::Free(axis) => {
                let com = self.bodies.iter().find(|one| one.name == own.of);
                let com = com.map_or([0.0; 2], |one| one.com);
                let (place, rate) = body(&own.of).at(com);
                (place[axis], rate[axis])
            }
        });
        values.unzip()
    }

    /// The coordinates that loops and drivers determine, by elimination of scaled rows \[m\].
    fn dependent(
        &self,
        start: &[f64],
        scales: &[f64],
        length: f64,
    ) -> Result<Vec<usize>, Complaint> {
        let mut rows = Vec::new();
        for closure in &self.closures {
            let slopes = closure.gap.slopes(start);
            for axis in 0..2 {
                let scaled = slopes.iter().zip(scales);
                let row: Vec<f64> = scaled.map(|(slope, scale)| slope[axis] * scale).collect();
                rows.push(row);
            }
        }
        let loops = rows.len();
        for drive in &self.drives {
            let mut row = vec![0.0; start.len()];
            drive
                .row
                .iter()
                .for_each(|&(k, factor)| row[k] = factor * length);
            rows.push(row);
        }
        let mut order: Vec<usize> = (0..start.len()).collect();
        order.sort_by_key(|&k| !self.coordinates[k].is_first);
        let mut pivots = Vec::new();
        let mut open: Vec<usize> = (0..rows.len()).collect();
        while !open.is_empty() {
            // Loops first: a driver that depends on them is at fault, not they.
            let is_of_loops = open[0] < loops;
            let now = open.iter().filter(|&&row| row < loops || !is_of_loops);
            let largest = |row: &&usize| {
                let entries = order.iter().filter(|column| !pivots.contains(*column));
                entries
                    .map(|&column| rows[**row][column].abs())
                    .fold(0.0, f64::max)
            };
            let best = now.rev().max_by(|a, b| largest(a).total_cmp(&largest(b)));
            let Some((row, most)) = best.map(|row| (*row, largest(&row))) else {
                break;
            };
            if most <= DEPENDENT * length {
                return Err(match open[0].checked_sub(loops) {
                    None => loop_complaint(&self.closures[row / 2].joint),
                    Some(_) => driver_complaint(&self.drives[row - loops].name),
                });
            }
            let mut last_first = order.iter().rev();
            let is_good = |column: &&usize| {
                !pivots.contains(*column) && rows[row][**column].abs() >= GOOD * most
            };
            let Some(&column) = last_first.find(is_good) else {
                break;
            };
            pivots.push(column);
            open.retain(|&other| other != row);
            let pivot = rows[row].clone();
            for &other in &open {
                let factor = rows[other][column] / pivot[column];
                let entries = rows[other].iter_mut().zip(&pivot);
                entries.for_each(|(entry, of_pivot)| *entry -= factor * of_pivot);
            }
        }
        Ok(pivots)
    }
}

fn loop_complaint(joint: &str) -> Complaint {
    let message = "the loop that this joint closes depends on others here, and a redundant joint or a singular position is not \
                   written as equations";
    let hint = "remove what is redundant, `linkdyn check` names it, or start from another position";
    Complaint::new(format!("joints.{joint}"), message).hint(hint)
}

fn driver_complaint(driver: &str) -> Complaint {
    let message = "what this driver moves is determined without it, and more drivers than degrees of freedom, or one at a dead \
                   centre, are not written as equations";
    let hint = "remove a driver, or start from another position";
    Complaint::new(format!("drivers.{driver}"), message).hint(hint)
}

impl BodyState {
    /// Place and velocity of a point of the body's frame.
    fn at(&self, point: Plane) -> (Plane, Plane) {
        let [x, y] = turned(point, self.angle);
        let place = [self.position[0] + x, self.position[1] + y];
        let rate = [
            self.velocity[0] - self.omega * y,
            self.velocity[1] + self.omega * x,
        ];
        (place, rate)
    }
}
