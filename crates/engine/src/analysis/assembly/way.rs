//! The way from the drawing to the start: which of several assemblies a mechanism starts in.
//!
//! Meant is the assembly that is reached from the drawing by moving there. The joints are closed where the drawing has the drivers and the
//! `initial` values; from there these go straight to what is asked, and with them the coordinates that are free beside them go
//! to where Newton's iteration from the drawing found them. The way is followed as any driven motion is, so signs of det J on both sides show
//! the singular positions on it.

use super::drawing;
use super::messages;
use super::ranks::with_starts;
use super::values::Values;
use crate::analysis::branch::DOUBTFUL;
use crate::analysis::control::Control;
use crate::analysis::driven::path;
use crate::element::Marker;
use crate::element::coordinate::Coordinate;
use crate::mechanism::continuation::{Path, SingularKind, SingularPosition};
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, System};
use linkdyn_linear::hermite::Node;
use linkdyn_linear::math::Vec2;
use linkdyn_linear::rank::RankReport;

/// Positions that differ by less than this are the same, in rad or mechanism sizes: those of two branches lie so near only where
/// they cross.
const SAME: f64 = 1e-6;
/// The same in a singular position, where Newton's iteration is good to the root of round-off only.
const SAME_THERE: f64 = 1e-11;
/// A value is where it is drawn, in rad or mechanism sizes.
const STILL: f64 = 1e-12;
/// Farthest way that is followed, in rad or mechanism sizes: a hundred turns.
const FARTHEST: f64 = 630.0;
/// A singular position that is no farther from the end of the way is there, in rad or mechanism sizes.
const AT_END: f64 = 1e-7;
/// How often other free coordinates are chosen on the way.
const MOST_CHOICES: usize = 20;

/// Where a way leads.
pub(super) enum PathEnd {
    /// Drivers and initial values are where they are drawn, or hold more than there is freedom: no way tells anything.
    Nowhere,
    /// To an assembly.
    Reached(Reached),
    /// Not to the start; what is said of that.
    Ended(String),
}

/// An assembly that is reached.
pub(super) struct Reached {
    /// The position (n).
    pub q: Vec<f64>,
    /// In which direction it is reached, scaled, where it is a singular position (n).
    pub arrival: Option<Vec<f64>>,
    /// What is said of the way.
    pub warnings: Vec<String>,
}

impl Reached {
    /// Whether it is a position found otherwise: whole turns of bodies do not matter.
    pub fn is(&self, system: &System, found: &[f64]) -> bool {
        let same = match self.arrival {
            Some(_) => SAME_THERE,
            None => SAME,
        };
        let off = self.q.iter().zip(found).enumerate().map(|(k, (a, b))| {
            let off = (a - b) / system.column_scale(k);
            match system.layout.is_angle(k) {
                true => off - (off / std::f64::consts::TAU).round() * std::f64::consts::TAU,
                false => off,
            }
        });
        off.fold(0.0, |most: f64, off| most.max(off.abs())) <= same
    }
}

/// Goes from the drawing to the start; `found` is where Newton's iteration found an assembly.
pub(super) fn from_drawing(system: &System, inputs: &Inputs, found: Option<&[f64]>) -> PathEnd {
    let drawn = Values::at(system, &system.guess, inputs);
    if drawn.farthest(system).is_none_or(|(_, off)| off <= STILL) {
        return PathEnd::Nowhere;
    }
    let Some(mut q) = drawing::closed(system, inputs, &drawn) else {
        return PathEnd::Ended(messages::undrawn(system, &drawn));
    };
    let mut ranks = with_starts(system, &q, inputs);
    let mut warnings = Vec::new();
    if !ranks.dependent.is_empty() || ranks.smallest_kept <= DOUBTFUL {
        match drawing::left(system, inputs, &q) {
            Ok(None) => {}
            Ok(Some(left)) => {
                warnings.extend(left.warning);
                q = left.q;
                ranks = with_starts(system, &q, inputs);
            }
            Err(said) => return PathEnd::Ended(said),
        }
    }
    for _ in 0..MOST_CHOICES {
        let Some(lead) = Lead::new(system, inputs, (&q, &ranks), found) else {
            return PathEnd::Nowhere;
        };
        match lead.follow(&q) {
            PathOutcome::Reached(mut reached) => {
                reached.warnings.splice(0..0, warnings);
                return PathEnd::Reached(reached);
            }
            PathOutcome::Ended { at, said } => {
                let other = with_starts(system, &at, inputs);
                if other.free_columns == ranks.free_columns {
                    return PathEnd::Ended(said);
                }
                (q, ranks) = (at, other);
            }
        }
    }
    PathEnd::Ended(messages::stuck(system, &drawn))
}

/// What is said where the end of the way does not meet initial values that could not lead it.
pub(super) fn unmet(system: &System, inputs: &Inputs) -> String {
    messages::stuck(system, &Values::at(system, &system.guess, inputs))
}

/// A mechanism that is led to its start.
struct Lead<'s> {
    system: &'s System,
    values: Values,
    led: System,
    /// The led system's time at the start \[s\].
    end: f64,
}

/// What became of it.
enum PathOutcome {
    Reached(Reached),
    Ended {
        /// The last position (n).
        at: Vec<f64>,
        said: String,
    },
}

impl<'s> Lead<'s> {
    /// From `q`, at which the joints close; `None` if drivers hold what is not free.
    fn new(
        system: &'s System,
        inputs: &Inputs,
        (q, ranks): (&[f64], &RankReport),
        found: Option<&[f64]>,
    ) -> Option<Self> {
        let values = Values::at(system, q, inputs);
        let m = system.m();
        let dependent = |row: usize| ranks.dependent.iter().any(|d| d.row == row);
        if (system.joint_rows()..m).any(dependent) {
            return None;
        }
        // Of values that follow from others the first ones lead.
        let starts = system.starts.iter().zip(&values.starts).enumerate();
        let starts = starts.filter(|(k, _)| !dependent(m + k));
        let mut coordinates: Vec<(Coordinate, f64)> = starts
            .map(|(_, (start, off))| (start.clone(), *off))
            .collect();
        let target = found.unwrap_or(q);
        for &column in &ranks.free_columns {
            let (body, axis) = system.layout.coordinate(column);
            let origin = Marker {
                body,
                s: Vec2::zeros(),
            };
            let coordinate = Coordinate {
                origin,
                axis,
                value: target[column],
                drive: None,
            };
            coordinates.push((coordinate, target[column] - q[column]));
        }
        let scaled =
            |(coordinate, off): &(Coordinate, f64)| off / system.axis_scale(coordinate.axis);
        let farthest = values.farthest(system).map_or(0.0, |(_, off)| off);
        let way = coordinates
            .iter()
            .map(scaled)
            .fold(farthest, |most: f64, off| most.max(off.abs()));
        let end = way.max(STILL) * system.scale.time;
        Some(Lead {
            system,
            led: system.led(&values.drivers, coordinates, end),
            values,
            end,
        })
    }

    fn follow(&self, q: &[f64]) -> PathOutcome {
        let ended = |at: &[f64], said| PathOutcome::Ended {
            at: at.to_vec(),
            said,
        };
        let way = self.end / self.system.scale.time;
        if way > FARTHEST {
            return ended(q, messages::too_far(self.system, &self.values));
        }
        let led = &self.led;
        let q = q.to_vec();
        let mut driven = match Driven::new(led, &q, &Inputs::at_time(led, 0.0)) {
            Ok(driven) => driven,
            Err(_) => return ended(&q, messages::stuck(self.system, &self.values)),
        };
        // One value is the way's parameter itself, several go by time.
        let (first, last) = match &led.drivers[..] {
            [driver] => (driver.law.value(0.0), driver.law.value(self.end)),
            _ => (0.0, self.end),
        };
        let range = (first.min(last), first.max(last));
        let path = path(&mut driven, (first, &q), range, &Control::default());
        let Ok(path) = path else {
            return ended(&q, messages::stuck(self.system, &self.values));
        };
        let way = PathEnds {
            first,
            last,
            near: AT_END * (last - first).abs() / way,
        };
        let mut node = Node {
            s: last,
            q,
            d: vec![0.0; self.system.n()],
            dd: vec![0.0; self.system.n()],
        };
        let Node { q, d, dd, .. } = &mut node;
        let guessed = path.guess(last, q, d, dd).is_some();
        let arrives = way.is_singular_at_end(&path);
        let inputs = Inputs::at_time(led, self.end);
        let mut corrected = || {
            let prepared = driven.prepare(q, &inputs);
            prepared.and_then(|()| driven.correct(q, &inputs)).is_ok()
        };
        if !(guessed && (arrives || corrected())) {
            let at = path.ends().nth(usize::from(last > first)).unwrap_or(q);
            return ended(at, self.said_of_end(&path, &way));
        }
        let scaled = node.d.iter().enumerate();
        let scaled = scaled.map(|(k, d)| d / self.system.column_scale(k));
        PathOutcome::Reached(Reached {
            arrival: arrives.then(|| scaled.collect()),
            warnings: self.said_of_way(&path, &way),
            q: node.q,
        })
    }

    /// What is said of the singular positions on a way.
    fn said_of_way(&self, path: &Path, way: &PathEnds) -> Vec<String> {
        let on_way = path.singular_between(way.first.min(way.last), way.first.max(way.last));
        let passed = on_way.iter().filter(|position| {
            position.kind == SingularKind::ChangePoint && !way.is_at_end(position)
        });
        let first = passed.min_by(|a, b| way.part(a.s).total_cmp(&way.part(b.s)));
        let said = first.map(|position| {
            let place = (position, way.part(position.s));
            messages::passed(self.system, &self.led, &self.values, place)
        });
        said.into_iter().collect()
    }

    /// What is said of a way that ends before the start.
    fn said_of_end(&self, path: &Path, way: &PathEnds) -> String {
        let positions = path.singular_between(f64::NEG_INFINITY, f64::INFINITY);
        let dead = positions.iter().find(|position| {
            position.kind == SingularKind::DeadCentre && way.part(position.s) >= 0.0
        });
        match dead {
            Some(position) => {
                let place = (position, way.part(position.s));
                messages::ended(self.system, &self.led, &self.values, place)
            }
            None => messages::stuck(self.system, &self.values),
        }
    }
}

/// Where a way begins and ends, by the path's parameter, and what is as near to its end as to be there.
struct PathEnds {
    first: f64,
    last: f64,
    near: f64,
}

impl PathEnds {
    /// How much of the way leads to `s`.
    fn part(&self, s: f64) -> f64 {
        (s - self.first) / (self.last - self.first)
    }

    fn is_at_end(&self, position: &SingularPosition) -> bool {
        (position.s - self.last).abs() <= self.near
    }

    fn is_singular_at_end(&self, path: &Path) -> bool {
        let here = path.singular_between(self.last - self.near, self.last + self.near);
        here.iter()
            .any(|position| position.kind == SingularKind::ChangePoint)
    }
}
