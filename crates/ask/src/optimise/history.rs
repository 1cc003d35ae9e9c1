//! How the search went: the best value so far, start by start.

use linkdyn_picture::accuracy_page::Unit;
use linkdyn_picture::optimise_page::History;

use super::optimised::Optimised;
use super::problem::Measured;
use super::target::Aim;
use crate::text::words::unit_words;

/// Constraints that are off by less than this part of their sides count as kept here: a search goes along their edges.
const NEARLY: f64 = 1e-3;

impl Optimised {
    /// How it went; the start that found the best comes first. There is nothing if evaluations were not kept.
    pub(super) fn history(&self) -> History {
        let target = &self.target;
        let (label, unit, is_rest) = match (&target.objective, &target.curve) {
            (Some(aimed), _) => (aimed.text.clone(), aimed.unit.as_str(), false),
            (None, Some(curve)) => (
                format!("{}: distance from its points", curve.point),
                "m",
                true,
            ),
            (None, None) => ("Largest relative distance from a goal".to_owned(), "", true),
        };
        let sign = target.objective.as_ref().map_or(1.0, |aimed| aimed.sign);
        let starts = self.starts.iter().map(|start| {
            let records = start.records.iter().enumerate();
            let values = records.filter(|(_, record)| record.missing.is_none());
            let values =
                values.filter_map(|(k, record)| Some((k, self.progress(&record.measured)?)));
            let mut better: Vec<[f64; 2]> = Vec::new();
            for (k, value) in values.filter(|(_, value)| value.is_finite()) {
                if better
                    .last()
                    .is_none_or(|last| sign * value < sign * last[1])
                {
                    better.push([k as f64, value]);
                }
            }
            let end = (start.records.len().max(1) - 1) as f64;
            if let Some(&[at, value]) = better.last()
                && at < end
            {
                better.push([end, value]);
            }
            better
        });
        History {
            label,
            unit: self.shown(unit),
            is_rest,
            starts: starts.collect(),
        }
    }

    /// What gets less or greater as the search goes on; `None` of a variant that does not keep the constraints.
    fn progress(&self, measured: &Measured) -> Option<f64> {
        let sides = measured.sides.iter().enumerate();
        if matches!(self.target.aim, Aim::Goal | Aim::Goals) {
            return Some(sides.fold(0.0, |most, (k, &[left, right])| {
                f64::max(most, self.off(k, left - right).abs())
            }));
        }
        let mut all = sides.map(|(k, sides)| self.violation(k, *sides));
        let kept = all.all(|violation| violation <= NEARLY);
        let value = match self.target.objective {
            Some(_) => measured.objective,
            None => self.distances(measured)?[1],
        };
        kept.then_some(value)
    }

    /// The unit of the file for a unit in SI.
    fn shown(&self, unit: &str) -> Unit {
        let display = &self.file.model().display;
        let named = match unit {
            "m" => &display.length,
            "rad" => &display.angle,
            "kg" => &display.mass,
            "s" => &display.time,
            unit => {
                return Unit {
                    symbol: unit_words(unit),
                    size: 1.0,
                };
            }
        };
        Unit {
            symbol: named.symbol.clone(),
            size: named.size,
        }
    }
}
