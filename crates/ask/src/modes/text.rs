//! Modes in words.

use std::f64::consts::TAU;

use linkdyn_engine::analysis::{Linearised, Mode};

use super::SmallMotions;
use crate::text::words::{equilibrium, mobility, status_words};
use crate::text::{Page, Side, Table, number};

/// Digits of numbers in the table, and of shapes.
pub const DIGITS: usize = 6;
const SHAPE_DIGITS: usize = 3;
/// Modes whose shapes are printed.
const MOST_SHAPES: usize = 8;

impl SmallMotions {
    /// The modes in words.
    pub fn text(&self) -> Page {
        let found = &self.found;
        let mut page = Page::default();
        page.line(format!(
            "{} ({}): modes about the {}, {}",
            self.file.name(),
            self.file.label(),
            self.about(),
            status_words(found.status)
        ));
        page.row("mobility", mobility(&found.mobility));
        let place = if self.pose { "position" } else { "equilibrium" };
        page.rows(place, found.equilibrium.iter().map(equilibrium));
        let places = found.bodies.iter().map(|(name, place)| {
            if let Some(amplitudes) = amplitudes(name, place.map(|value| number(value, DIGITS))) {
                return amplitudes;
            }
            let [x, y, angle] = place.map(|value| number(value, DIGITS));
            format!("{name}: x {x} m, y {y} m, angle {angle} rad")
        });
        page.rows("bodies", places);
        if !found.modes.is_empty() {
            page.rows("modes", table(&found.modes).lines());
        }
        let shapes = found.modes.iter().enumerate().take(MOST_SHAPES);
        page.rows("shapes", shapes.map(|mode| shape(found, mode)));
        page.rows("warnings", &found.warnings);
        page
    }
}

fn table(modes: &[Mode]) -> Table {
    let widths = [6, 14, 14, 14, 0];
    let mut table = Table::new(0, widths.map(|width| (Side::Left, width)));
    table.row(["mode", "f [Hz]", "ω₀ [rad/s]", "ζ [–]", "eigenvalue [1/s]"]);
    for (k, mode) in modes.iter().enumerate() {
        let [re, im] = mode.eigenvalue;
        let eigenvalue = match (re == 0.0, im == 0.0) {
            (_, true) => number(re, DIGITS),
            (true, false) => format!("± {} i", number(im, DIGITS)),
            (false, false) => format!("{} ± {} i", number(re, DIGITS), number(im, DIGITS)),
        };
        let omega = mode.frequency();
        let zeta = mode.damping_ratio();
        table.row([
            (k + 1).to_string(),
            number(omega / TAU, DIGITS),
            number(omega, DIGITS),
            zeta.map_or("–".into(), |zeta| number(zeta, DIGITS)),
            eigenvalue,
        ]);
    }
    table
}

/// `1: crank 0, 0, 1; …`: a shape as far as it is in phase.
fn shape(found: &Linearised, (k, mode): (usize, &Mode)) -> String {
    // Round-off beside the largest component, which is 1, is not shown.
    let digits = |value: f64| {
        if value.abs() < 1e-12 {
            "0".into()
        } else {
            number(value, SHAPE_DIGITS)
        }
    };
    let complex = |[re, im]: [f64; 2]| match im.abs() < 1e-12 {
        true => digits(re),
        false => format!(
            "{}{}{} i",
            digits(re),
            if im < 0.0 { " − " } else { " + " },
            digits(im.abs())
        ),
    };
    let bodies = found.bodies.iter().zip(&mode.shape);
    let bodies = bodies.map(|((name, _), shape)| {
        let shape = shape.map(complex);
        amplitudes(name, shape.clone()).unwrap_or_else(|| format!("{name} ({})", shape.join(", ")))
    });
    format!("{}: {}", k + 1, bodies.collect::<Vec<_>>().join(", "))
}

/// What is said of two amplitudes of an elastic link, `rod.q1-q2`; nothing of a body.
fn amplitudes(name: &str, values: [String; 3]) -> Option<String> {
    let (link, modes) = name.split_once(".q")?;
    let modes = modes.split('-').map(|mode| mode.trim_start_matches('q'));
    let all = modes
        .zip(values)
        .map(|(mode, value)| format!("q{mode} {value} m"));
    Some(format!("{link}: {}", all.collect::<Vec<_>>().join(", ")))
}
