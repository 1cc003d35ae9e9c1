//! The choice of tolerances in words, and for programs.

use indexmap::IndexMap;
use linkdyn_model::Tolerance;
use linkdyn_variation::OutputAccuracy;
use serde::{Serialize, Serializer};

use super::Allocation;
use super::written::{DIGITS, quantity};
use crate::text::{Page, Side, Table, number};
use crate::{ENGINE, Subject};

impl Allocation {
    /// What the tolerances cost together, and what they would cost to first order.
    fn costs(&self) -> [f64; 2] {
        let chosen = || self.chosen.iter();
        [
            chosen().map(|chosen| chosen.cost / chosen.half).sum(),
            chosen().map(|chosen| chosen.cost / chosen.first).sum(),
        ]
    }

    /// The choice in words.
    pub fn text(&self) -> Page {
        let mut page = Page::default();
        let how = if self.squares {
            "by the sum of squares"
        } else {
            "worst case"
        };
        page.line(format!(
            "{} ({}): cheapest tolerances that keep all limits, {how}",
            self.file.name(),
            self.file.label()
        ));
        page.rows("tolerances", self.table().lines());
        let [sum, first] = self.costs().map(|cost| number(cost, DIGITS + 1));
        page.row("cost", format!("{sum} ({first} to first order)"));
        let limits = self.accuracy.found.outputs.iter();
        page.rows(
            "limits",
            limits.filter_map(|output| kept(output, self.squares)),
        );
        if !self.idle.is_empty() {
            let idle = self.idle.join(", ");
            page.row(
                "left as they are",
                format!("{idle}: no limit depends on them"),
            );
        }
        page
    }

    fn table(&self) -> Table {
        let right = [16, 16, 16, 10, 8].map(|width| (Side::Right, width));
        let columns: Vec<_> = [(Side::Left, 9)].into_iter().chain(right).collect();
        let mut table = Table::new(2, columns);
        table.row([
            "parameter",
            "was",
            "to first order",
            "tolerance",
            "cost",
            "share",
        ]);
        let [sum, _] = self.costs();
        for chosen in &self.chosen {
            let was = chosen.parameter.tolerance.as_ref();
            let was = was.map_or(0.0, Tolerance::half_width);
            let cost = chosen.cost / chosen.half;
            let [was, first, half] = [was, chosen.first, chosen.half]
                .map(|half| format!("±{}", quantity(&self.file, &chosen.parameter, half, DIGITS)));
            let share = format!("{:.2} %", 100.0 * cost / sum);
            let name = chosen.parameter.name.clone();
            table.row([name, was, first, half, number(cost, DIGITS), share]);
        }
        table
    }
}

/// How far an output uses its limits.
fn kept(output: &OutputAccuracy, rss: bool) -> Option<String> {
    let used = output.used()?;
    if rss {
        let least = output
            .poses
            .iter()
            .filter_map(|pose| pose.capability)
            .map(|found| found.within);
        let least = least.fold(1.0, f64::min);
        let within = number(100.0 * least, 6);
        return Some(format!(
            "{}: {within} % within; the worst case uses {} %",
            output.name,
            number(100.0 * used, 5)
        ));
    }
    let certified = output.poses.iter().all(|pose| pose.certified.is_some());
    let word = if certified {
        "certified"
    } else {
        "by the worst found"
    };
    Some(format!(
        "{}: {} % used, {word}",
        output.name,
        number(100.0 * used, 5)
    ))
}

#[derive(Serialize)]
struct Document<'a> {
    engine: &'a str,
    model: Subject<'a>,
    sum: &'a str,
    parameters: IndexMap<&'a str, Cost<'a>>,
    cost: f64,
    first_order_cost: f64,
    limits: IndexMap<&'a str, Used>,
    left: &'a [String],
    rounds: usize,
}

#[derive(Serialize)]
struct Cost<'a> {
    first_order: f64,
    tolerance: f64,
    unit: &'a str,
    cost: f64,
}

#[derive(Serialize)]
struct Used {
    used: f64,
}

/// The choice for programs.
impl Serialize for Allocation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [cost, first_order_cost] = self.costs();
        let chosen = self.chosen.iter().map(|chosen| {
            let of = Cost {
                first_order: chosen.first,
                tolerance: chosen.half,
                unit: &chosen.parameter.unit,
                cost: chosen.cost / chosen.half,
            };
            (chosen.parameter.name.as_str(), of)
        });
        let limits = self.accuracy.found.outputs.iter();
        let limits = limits.filter_map(|output| {
            let used = Used {
                used: output.used()?,
            };
            Some((output.name.as_str(), used))
        });
        let document = Document {
            engine: ENGINE,
            model: self.file.subject(),
            sum: if self.squares { "squares" } else { "worst" },
            parameters: chosen.collect(),
            cost,
            first_order_cost,
            limits: limits.collect(),
            left: &self.idle,
            rounds: self.rounds,
        };
        document.serialize(serializer)
    }
}
