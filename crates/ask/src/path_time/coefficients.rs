//! What the limited numbers are of speed and acceleration, along the stroke.

use linkdyn_engine::analysis::{AlongStroke, Rates};
use linkdyn_optimise::fastest::Affine;

use super::asked::Stroke;
use super::bounds::{Bound, Of};
use crate::Unanswered;
use crate::text::words::unit_words;

/// Places at which it is checked that nothing but ẋ² and ẍ counts.
const CHECKS: usize = 17;
/// Another time, which no period of a force divides \[s\].
const LATER: f64 = 0.731_058_578_630_004_9;
/// Departure of a number from its two terms that is round-off, by their size \[–\].
const STRAIGHT: f64 = 1e-7;
/// The same by its limit \[–\].
const OF_LIMIT: f64 = 1e-9;

/// How a limited number goes with the speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Course {
    /// With its square.
    Square,
    /// With itself: velocities. Their square is what is limited.
    Speed,
}

/// Coefficients at all places, by bound: of a size two behind each other.
pub(super) struct Coefficients {
    pub courses: Vec<Course>,
    /// (places × components)
    values: Vec<Affine>,
    /// The first component of each bound, and how many there are.
    first: Vec<usize>,
    width: usize,
}

impl Coefficients {
    /// Of all bounds at evenly spaced places, both ends among them.
    pub fn new(
        along: &mut AlongStroke,
        stroke: &Stroke,
        bounds: &[Bound],
        places: usize,
    ) -> Result<Self, Unanswered> {
        let mut first = Vec::new();
        let mut columns: Vec<Option<usize>> = Vec::new();
        for bound in bounds {
            first.push(columns.len());
            match bound.of {
                Of::Column(k) => columns.push(Some(k)),
                Of::Size([x, y]) => columns.extend([Some(x), Some(y)]),
                Of::Speed | Of::Acceleration => columns.push(None),
            }
        }
        let mut all = Coefficients {
            courses: vec![Course::Square; bounds.len()],
            values: Vec::with_capacity(places * columns.len()),
            first,
            width: columns.len(),
        };
        let mut probe = Probe {
            along,
            direction: (stroke.to - stroke.from).signum(),
            columns,
            rows: Vec::new(),
        };
        let length = (stroke.to - stroke.from).abs();
        let square = all.square(&mut probe, bounds, length)?;
        let paces = [square.sqrt(), square / (2.0 * length)];
        all.check(&mut probe, bounds, paces)?;
        for place in 0..places {
            let part = place as f64 / (places - 1) as f64;
            let rows = probe.at(part, &[[0.0, 0.0], [paces[0], 0.0], [0.0, paces[1]]], 0.0)?;
            all.push(bounds, &rows, paces);
        }
        Ok(all)
    }

    /// Coefficients from an instant at rest, one with a speed, one with an acceleration.
    fn push(&mut self, bounds: &[Bound], rows: &[Vec<f64>], [v, a]: [f64; 2]) {
        for (k, bound) in bounds.iter().enumerate() {
            let components = self.first[k]..self.first.get(k + 1).copied().unwrap_or(self.width);
            let of = components.map(|column| match (bound.of, self.courses[k]) {
                (Of::Speed, _) => Affine {
                    square: 1.0,
                    ..Affine::default()
                },
                (Of::Acceleration, _) => Affine {
                    acceleration: 1.0,
                    ..Affine::default()
                },
                (Of::Column(_) | Of::Size(_), Course::Square) => Affine {
                    acceleration: (rows[2][column] - rows[0][column]) / a,
                    square: (rows[1][column] - rows[0][column]) / (v * v),
                    rest: rows[0][column],
                },
                // The sign is kept for the end of the range that counts.
                (Of::Column(_) | Of::Size(_), Course::Speed) => {
                    let slope = rows[1][column] / v;
                    Affine {
                        square: slope * slope.abs(),
                        ..Affine::default()
                    }
                }
            });
            self.values.extend(of);
        }
    }

    /// What ẋ² may be about: what the limits allow where they allow most.
    fn square(
        &mut self,
        probe: &mut Probe,
        bounds: &[Bound],
        length: f64,
    ) -> Result<f64, Unanswered> {
        let mut most = 0.0_f64;
        for place in 0..CHECKS {
            let part = place as f64 / (CHECKS - 1) as f64;
            let rows = probe.at(part, &[[0.0, 0.0], [length, 0.0], [0.0, length]], 0.0)?;
            self.push(bounds, &rows, [length, length]);
            let sizes = bounds.iter().enumerate().map(|(k, bound)| {
                let of = &self.values[self.first[k]];
                let scale = match bound.of {
                    Of::Speed => bound.scale() * bound.scale(),
                    Of::Column(_) | Of::Size(_) | Of::Acceleration => bound.scale(),
                };
                scale / (of.square.abs() + of.acceleration.abs() / (2.0 * length))
            });
            let least = sizes.fold(f64::INFINITY, f64::min);
            most = most.max(if least.is_finite() { least } else { 0.0 });
            self.values.clear();
        }
        Ok(if most > 0.0 { most } else { length * length })
    }

    /// Whether all numbers go with ẋ² and ẍ in straight lines, or with ẋ alone.
    fn check(
        &mut self,
        probe: &mut Probe,
        bounds: &[Bound],
        [v, a]: [f64; 2],
    ) -> Result<(), Unanswered> {
        let mut may_be_speed: Vec<bool> = vec![true; bounds.len()];
        let mut is_square: Vec<bool> = vec![true; bounds.len()];
        for place in 0..CHECKS {
            let part = place as f64 / (CHECKS - 1) as f64;
            let instants = [
                [0.0, 0.0],
                [v, 0.0],
                [0.0, a],
                [2.0 * v, 0.0],
                [v, -a],
                [0.5 * v, 2.0 * a],
            ];
            let rows = probe.at(part, &instants, 0.0)?;
            let later = probe.at(part, &instants[..1], LATER)?;
            for (k, bound) in bounds.iter().enumerate() {
                let components =
                    self.first[k]..self.first.get(k + 1).copied().unwrap_or(self.width);
                for column in components {
                    let own: Vec<f64> = rows.iter().map(|row| row[column]).collect();
                    let [g, c, m] = [own[0], own[1] - own[0], own[2] - own[0]];
                    let size = STRAIGHT * (g.abs() + 4.0 * c.abs() + 2.0 * m.abs())
                        + OF_LIMIT * bound.scale();
                    let is = |k: usize, value: f64| (own[k] - value).abs() <= size;
                    if (later[0][column] - g).abs() > size {
                        return Err(Unanswered::question(format!(
                            "{} changes with time at the same place: forces that depend on time can't be limited along a stroke",
                            bound.name
                        )));
                    }
                    is_square[k] &=
                        is(3, g + 4.0 * c) && is(4, g + c - m) && is(5, g + 0.25 * c + 2.0 * m);
                    may_be_speed[k] &=
                        is(0, 0.0) && is(2, 0.0) && is(3, 2.0 * c) && is(4, c) && is(5, 0.5 * c);
                }
            }
        }
        for (k, bound) in bounds.iter().enumerate() {
            self.courses[k] = match (is_square[k], may_be_speed[k], bound.of) {
                (true, ..) => Course::Square,
                (false, true, Of::Column(_)) => Course::Speed,
                (false, ..) => {
                    return Err(Unanswered::question(format!(
                        "{} does not follow acceleration and square of the speed in straight lines, as with friction, damping, or a formula with \
                         velocities: its fastest motion is no convex problem. Remove what depends on velocities, or the limit",
                        bound.name
                    )));
                }
            };
        }
        Ok(())
    }

    /// The components of a bound at a place.
    pub fn at(&self, bound: usize, place: usize) -> &[Affine] {
        let end = self.first.get(bound + 1).copied().unwrap_or(self.width);
        let from = place * self.width;
        &self.values[from + self.first[bound]..from + end]
    }

    /// Between three places, by the parabola through them; `part` from 0 at the first to 1 at the last.
    pub fn between(&self, bound: usize, first: usize, part: f64) -> Vec<Affine> {
        let weights = [
            (1.0 - part) * (1.0 - 2.0 * part),
            4.0 * part * (1.0 - part),
            part * (2.0 * part - 1.0),
        ];
        let mut sum = vec![Affine::default(); self.at(bound, first).len()];
        for (place, weight) in (first..).zip(weights) {
            for (sum, of) in sum.iter_mut().zip(self.at(bound, place)) {
                sum.acceleration += weight * of.acceleration;
                sum.square += weight * of.square;
                sum.rest += weight * of.rest;
            }
        }
        sum
    }
}

struct Probe<'a, 's> {
    along: &'a mut AlongStroke<'s>,
    direction: f64,
    columns: Vec<Option<usize>>,
    rows: Vec<f64>,
}

impl Probe<'_, '_> {
    /// The numbers at a part of the stroke, for speeds and accelerations along it.
    fn at(
        &mut self,
        part: f64,
        instants: &[[f64; 2]],
        time: f64,
    ) -> Result<Vec<Vec<f64>>, Unanswered> {
        let rates: Vec<Rates> = instants
            .iter()
            .map(|[v, a]| Rates {
                velocity: self.direction * v,
                acceleration: self.direction * a,
                time,
            })
            .collect();
        self.along
            .rows(part, &rates, &mut self.rows)
            .map_err(Unanswered::Failed)?;
        let rows = self.rows.chunks_exact(self.along.columns().len());
        let rows: Vec<Vec<f64>> = rows
            .map(|row| {
                self.columns
                    .iter()
                    .map(|column| column.map_or(0.0, |k| row[k]))
                    .collect()
            })
            .collect();
        match rows.iter().flatten().all(|value| value.is_finite()) {
            true => Ok(rows),
            false => Err(Unanswered::Failed(
                "a limited number has no value on the stroke".into(),
            )),
        }
    }
}

/// A number with its unit in words.
pub(super) fn quantity(value: f64, unit: &str, digits: usize) -> String {
    format!(
        "{} {}",
        crate::text::number(value, digits),
        unit_words(unit)
    )
}
