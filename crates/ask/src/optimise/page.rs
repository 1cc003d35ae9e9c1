//! What was found, as a page: the mechanism before and after, the history of the search, limits that are reached.

use linkdyn_engine::analysis::Control;
use linkdyn_model::optimise::Relation;
use linkdyn_picture::optimise_page::{Cell, Facts, OptimisePage, Wanted};
use linkdyn_picture::study_page::Motion;

use super::optimised::Optimised;
use super::problem::Measured;
use super::search::Ended;
use super::target::{Told, Variable};
use super::text::verdict;
use crate::broken::caught;
use crate::run::unplaced;
use crate::shape::moving;
use crate::text::number;
use crate::text::responses::{value, value_in};

/// Digits of multipliers.
const FEW: usize = 3;

impl Optimised {
    /// The page. The mechanism is run once more, as it was and as it was found.
    pub fn html(&self) -> String {
        let model = self.file.model();
        let best = self.best();
        let before = [("before", self.motion(&[]))];
        let after = best.map(|(best, _)| ("after", self.motion(&best.x)));
        let motions = before.into_iter().chain(after);
        let motions: Vec<(&'static str, Motion)> = motions
            .filter_map(|(name, motion)| Some((name, motion?)))
            .collect();
        let wanted = motions.first().and_then(|(_, motion)| self.wanted(motion));
        let tables = match best {
            Some((best, measured)) => self.tables(best, measured),
            None => Vec::new(),
        };
        OptimisePage {
            model: self.file.name(),
            about: model.about.as_deref(),
            verdict: verdict(self),
            status: (self.status(), self.is_found()),
            notes: self.failure().into_iter().collect(),
            tables,
            motions,
            wanted,
            history: self.history(),
        }
        .html()
    }

    fn motion(&self, x: &[f64]) -> Option<Motion> {
        let of = || {
            let file = self.at(x).ok()?;
            let outcome = unplaced(&file, &Control::default()).ok()?;
            moving(None, file.model(), &outcome)
        };
        caught(of).ok().flatten()
    }

    /// The path that was looked for, where its point is drawn.
    fn wanted(&self, motion: &Motion) -> Option<Wanted> {
        let curve = self.target.curve.as_ref()?;
        let name = curve.point.to_string();
        let bodies = motion.shape.bodies.iter().enumerate();
        let mut points = bodies.flat_map(|(k, body)| {
            let points = body.points.iter().enumerate();
            points.map(move |(j, (point, ..))| ([k, j], format!("{}.{point}", body.name)))
        });
        let (point, _) = points.find(|(_, own)| *own == name)?;
        Some(Wanted {
            point,
            name,
            through: curve.through.clone(),
        })
    }

    fn tables(&self, best: &Ended, measured: &Measured) -> Vec<Facts> {
        let aims = Facts {
            title: "Objective and limits",
            heads: vec!["", "before", "after", "limit", "", "multiplier"],
            rows: self.aims(best, measured),
        };
        let design = Facts {
            title: "Design",
            heads: vec!["parameter", "before", "after", "from", "to", ""],
            rows: self.parameters(best),
        };
        let responses = Facts {
            title: "Responses",
            heads: vec!["response", "before", "after"],
            rows: self.responses(measured),
        };
        let all = [aims, design, responses].into_iter();
        all.filter(|table| !table.rows.is_empty()).collect()
    }

    /// Objective, distance from the path, constraints: with a mark what stands at its limit.
    fn aims(&self, best: &Ended, measured: &Measured) -> Vec<Vec<Cell>> {
        let target = &self.target;
        let before = self.before.as_ref().ok();
        let row = |what: &str, of: &dyn Fn(&Measured) -> String| {
            let before = before.map_or_else(none, of);
            let cells = [what.to_owned(), before, of(measured)];
            cells.map(Cell::Text).into_iter().collect::<Vec<_>>()
        };
        let mut rows = Vec::new();
        if let Some(aimed) = &target.objective {
            rows.push(row(&aimed.text, &|own| {
                self.words(own.objective, &aimed.unit)
            }));
        }
        if let Some(curve) = &target.curve {
            for (k, which) in ["largest", "root mean square"].iter().enumerate() {
                let what = format!("{which} distance from {} points", curve.through.len());
                rows.push(row(&what, &|own| {
                    let found = self.distances(own);
                    found.map_or_else(none, |found| self.words(found[k], "m"))
                }));
            }
        }
        rows.iter_mut()
            .for_each(|row| row.extend([(); 3].map(|()| Cell::Text(String::new()))));
        for (k, (one, sides)) in target.constraints.iter().zip(&measured.sides).enumerate() {
            let left = |own: &Measured| {
                let sides = own.sides.get(k);
                sides.map_or_else(none, |sides| self.words(sides[0], &one.unit))
            };
            let mut cells = row(&one.text, &left);
            cells.push(Cell::Text(self.words(sides[1], &one.unit)));
            cells.push(match (self.state(k, *sides), one.relation) {
                ((false, _), _) => Cell::Mark("not kept", "bad"),
                ((true, true), Relation::AtMost | Relation::AtLeast) => {
                    Cell::Mark("at its limit", "warn")
                }
                ((true, _), _) => Cell::Mark("kept", "good"),
            });
            let multiplier = best.multipliers.get(k);
            cells.push(Cell::Text(
                multiplier.map_or_else(String::new, |own| number(*own, FEW)),
            ));
            rows.push(cells);
        }
        rows
    }

    fn parameters(&self, best: &Ended) -> Vec<Vec<Cell>> {
        let all = self.target.variables.iter().zip(&best.x).enumerate();
        let row = |(k, (own, x)): (usize, (&Variable, &f64))| {
            let words = |value: f64| self.words(value, &own.parameter.unit);
            let end = |side: usize| own.range.map_or_else(String::new, |own| words(own[side]));
            let name = own.parameter.name.clone();
            let texts = [name, words(own.parameter.value), words(*x), end(0), end(1)];
            let mark = match self.bound(k, *x) {
                Some("lower") => Cell::Mark("at its lower bound", "warn"),
                Some(_) => Cell::Mark("at its upper bound", "warn"),
                None => Cell::Text(String::new()),
            };
            texts.map(Cell::Text).into_iter().chain([mark]).collect()
        };
        all.map(row).collect()
    }

    fn responses(&self, measured: &Measured) -> Vec<Vec<Cell>> {
        let all = self.target.responses.iter().enumerate();
        let display = &self.file.model().display;
        let row = |(k, told): (usize, &Told)| {
            let of = |own: Option<&Measured>| {
                let own = own.and_then(|own| own.responses.get(k));
                let own = own.filter(|own| own.is_finite());
                own.map_or_else(none, |own| {
                    value_in(told.shown.as_ref(), *own, &told.unit, display)
                })
            };
            let texts = [
                told.name.clone(),
                of(self.before.as_ref().ok()),
                of(Some(measured)),
            ];
            texts.map(Cell::Text).into_iter().collect()
        };
        all.map(row).collect()
    }

    fn words(&self, own: f64, unit: &str) -> String {
        value(own, unit, &self.file.model().display)
    }
}

fn none() -> String {
    "none".to_owned()
}
