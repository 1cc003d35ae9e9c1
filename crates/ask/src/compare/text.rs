//! A comparison in words.

use linkdyn_engine::analysis::Outcome;
use linkdyn_output::Column;

use super::{Compared, cpu, numbers};
use crate::text::words::{status_words, unit_words};
use crate::text::{Page, Side, Table, count, number, seconds, shorten};

/// Digits of numbers.
const DIGITS: usize = 4;

impl Compared {
    /// The comparison in words.
    pub fn text(&self) -> Page {
        let mut page = Page::default();
        page.line(format!(
            "{} ({}): clearance of {} {}",
            self.file.name(),
            self.file.label(),
            self.joint_word(),
            self.joints.join(", ")
        ));
        for rung in &self.rungs {
            match &rung.ran {
                Err(why) => page.row(rung.model, format!("{}: {why}", self.refusal())),
                Ok((_, outcome)) => {
                    let ended = status_words(outcome.report.status);
                    page.row(rung.model, format!("{ended}, {}", self.went(outcome)));
                    page.rows("", shorten(outcome.report.warnings.clone()));
                }
            }
        }
        let ran: Vec<&str> = self.ran().map(|(model, _)| model).collect();
        match ran[..] {
            [] => {}
            [only] => page.line(format!(
                "  nothing to compare {only} with: no other model was run"
            )),
            [first, ..] if self.comparison.columns.is_empty() => {
                page.line(format!(
                    "  nothing to compare with {first}: the results have none of the columns that are compared"
                ));
                page.line("  unless --columns names others (efforts, forces in the joints, motion of the last body)");
            }
            [first, ..] => self.numbers(first).lines().for_each(|line| page.line(line)),
        }
        page
    }

    /// How far the columns are from those of the first model, and their smallest and largest values by model.
    fn numbers(&self, first: &str) -> Table {
        let mut table = Table::new(
            0,
            [34, 12, 12, 12, 12].map(|width| match width {
                34 => (Side::Left, width),
                _ => (Side::Right, width),
            }),
        );
        table.row([
            &format!("  difference from {first}"),
            "max",
            "at t [s]",
            "mean",
            "RMS",
        ]);
        for column in &self.comparison.columns {
            table.row([heading(column)]);
            let differences = self.comparison.differences.iter();
            for difference in differences.filter(|difference| difference.column == *column) {
                table.row(cells(&difference.run, numbers(difference)));
            }
        }
        table.row([
            "  smallest and largest",
            "min",
            "at t [s]",
            "max",
            "at t [s]",
        ]);
        for column in &self.comparison.columns {
            table.row([heading(column)]);
            for (model, extremes) in self.extremes(column) {
                table.row(cells(model, extremes));
            }
        }
        table
    }

    /// How a run went.
    pub(super) fn went(&self, outcome: &Outcome) -> String {
        let contacts = self.contacts(outcome);
        let contacts = contacts.map(|n| format!(", {}", count(n as usize, "contact")));
        format!(
            "{}, {}{}, CPU {}",
            count(outcome.trajectory.len(), "instant"),
            count(outcome.report.statistics.steps as usize, "step"),
            contacts.unwrap_or_default(),
            seconds(cpu(outcome))
        )
    }
}

fn heading(column: &Column) -> String {
    format!("  {} [{}]", column.name, unit_words(column.unit))
}

fn cells(model: &str, numbers: [f64; 4]) -> Vec<String> {
    let numbers = numbers.map(|value| number(value, DIGITS));
    [format!("    {model}")]
        .into_iter()
        .chain(numbers)
        .collect()
}
