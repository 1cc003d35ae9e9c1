//! A linear system in words.

use std::f64::consts::TAU;

use linkdyn_engine::analysis::{LinearSystem, Variable};

use super::Linearisation;
use crate::text::words::{equilibrium, status_words};
use crate::text::{Page, Side, Table, number};

const DIGITS: usize = 6;
/// Rates in SI that are round-off.
const STILL: f64 = 1e-12;
/// States, inputs and outputs up to which matrices are printed.
const MOST: usize = 12;

impl Linearisation {
    /// The linear system in words.
    pub fn text(&self) -> Page {
        let mut page = Page::default();
        page.line(format!(
            "{} ({}): linear state space, {}",
            self.file.name(),
            self.file.label(),
            status_words(self.status)
        ));
        for system in &self.systems {
            self.of(system, &mut page);
        }
        let own = self.systems.iter().flat_map(|system| &system.warnings);
        let mut warnings: Vec<&String> = self.warnings.iter().chain(own).collect();
        warnings.dedup();
        page.rows("warnings", warnings);
        page
    }

    fn of(&self, system: &LinearSystem, page: &mut Page) {
        page.row("about", self.about(system));
        let place = match self.question.pose {
            true => "position",
            false => "equilibrium",
        };
        page.rows(place, system.equilibrium.iter().map(equilibrium));
        page.rows("contacts", &system.phases);
        let rates = system.states.iter().zip(&system.rates);
        let states = rates.map(|(state, rate)| {
            let drift = match rate.abs() < STILL {
                true => String::new(),
                false => format!(", rate {}", number(*rate, DIGITS)),
            };
            format!("{}{drift}", told(state))
        });
        page.rows("states x", states);
        page.rows("inputs w", system.inputs.iter().map(told));
        page.rows("outputs y", system.outputs.iter().map(told));
        let shown = [&system.a, &system.b, &system.c, &system.d];
        for (name, rows) in ["A", "B", "C", "D"].into_iter().zip(shown) {
            let columns = rows.first().map_or(0, Vec::len);
            if rows.len() <= MOST && columns <= MOST && columns > 0 {
                page.rows(name, matrix(rows).lines());
            }
        }
        page.rows("poles", poles(&system.poles).lines());
        if let Some(gain) = system.gain.as_ref().filter(|_| !system.inputs.is_empty()) {
            let columns = gain.first().map_or(0, Vec::len);
            if gain.len() <= MOST && columns <= MOST {
                page.rows("static gain", matrix(gain).lines());
            }
        }
        let worst = system
            .errors
            .iter()
            .fold(0.0, |most: f64, own| most.max(*own));
        page.row(
            "error",
            format!("at most {} of the largest entry of a row", number(worst, 2)),
        );
    }
}

fn told(own: &Variable) -> String {
    let unit = match own.unit.as_str() {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    format!("{} = {}{unit}", own.name, number(own.value, DIGITS))
}

fn matrix(rows: &[Vec<f64>]) -> Table {
    let columns = rows.first().map_or(0, Vec::len);
    let mut table = Table::new(2, vec![(Side::Right, 0); columns]);
    for row in rows {
        table.row(row.iter().map(|own| number(*own, DIGITS)));
    }
    table
}

fn poles(poles: &[[f64; 2]]) -> Table {
    let mut table = Table::new(0, [14, 14, 0].map(|width| (Side::Left, width)));
    table.row(["f [Hz]", "ζ [–]", "pole [1/s]"]);
    for [re, im] in poles {
        let size = re.hypot(*im);
        let pole = match (*re == 0.0, *im == 0.0) {
            (_, true) => number(*re, DIGITS),
            (true, false) => format!("± {} i", number(*im, DIGITS)),
            (false, false) => format!("{} ± {} i", number(*re, DIGITS), number(*im, DIGITS)),
        };
        let damping = match size > 0.0 {
            true => number(0.0 - re / size, DIGITS),
            false => "–".into(),
        };
        table.row([number(size / TAU, DIGITS), damping, pole]);
    }
    table
}
