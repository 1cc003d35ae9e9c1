//! A diagnosis in words.

use linkdyn_engine::analysis::Lack;

use super::{Diagnosis, tolerances, words};
use crate::text::responses;
use crate::text::words::{analysis_words, mobility};
use crate::text::{Page, names, number, shorten, wrapped};

/// Width of long texts on the page.
const WIDTH: usize = 96;

impl Diagnosis {
    /// The diagnosis in words.
    pub fn text(&self) -> Page {
        let (file, check) = (&self.file, &self.found);
        let model = file.model();
        let mut page = Page::default();
        page.line(format!(
            "{} ({}): {}",
            file.name(),
            file.label(),
            self.verdict()
        ));
        let parts = [
            ("moving bodies", check.bodies),
            ("joints", check.joints),
            ("drivers", model.drivers.len()),
        ];
        let parts = parts.map(|(what, n)| format!("{what} {n}"));
        page.row(
            "parts",
            format!("{}, forces {}", parts.join(", "), model.forces.len()),
        );
        let loops = check.loops.iter().zip(&check.loop_bodies);
        let loops: Vec<String> = loops
            .map(|(joints, bodies)| format!("{joints}  (through {})", bodies.join(", ")))
            .collect();
        page.rows(
            "loops",
            if loops.is_empty() {
                vec!["none".to_string()]
            } else {
                folded(loops)
            },
        );
        page.rows("mobility", wrapped(&check.words, WIDTH));
        match &check.open {
            None => page.row("", mobility(&check.mobility)),
            Some(open) => {
                page.row("", format!("ideal pins: {}", mobility(&check.mobility)));
                page.row("", format!("free journals: {}", mobility(&open.mobility)));
            }
        }
        let residual = check.assembly_residual;
        let assembly = format!("constraint residual {}", number(residual, 2));
        page.row(
            "assembly",
            if residual.is_nan() {
                "none".to_string()
            } else {
                assembly
            },
        );
        let parameters = &file.loaded.parameters;
        let resolved = parameters
            .iter()
            .map(|p| format!("{} = {} {}", p.name, number(p.value, 6), p.unit));
        page.rows(
            "parameters",
            resolved.map(|text| text.trim_end().to_string()),
        );
        tolerances::rows(&mut page, &file.loaded);
        responses::rows(&mut page, model);
        if let Some(own) = &model.study {
            page.rows("study", words::study(own));
        }
        if let Some(own) = &model.optimise {
            page.rows("optimise", words::optimise(own, &file.loaded));
        }
        page.rows(
            "lacking",
            folded(check.lacks.iter().map(lack_words).collect()),
        );
        page.rows("warnings", folded(check.warnings.clone()));
        page
    }
}

/// Not more texts than anybody reads, none wider than the page.
fn folded(texts: Vec<String>) -> Vec<String> {
    shorten(texts)
        .iter()
        .flat_map(|text| wrapped(text, WIDTH))
        .collect()
}

/// `mass and inertia of coupler, rocker: for inverse dynamics, dynamics`.
pub fn lack_words(lack: &Lack) -> String {
    let kinds: Vec<&str> = lack
        .analyses
        .iter()
        .map(|kind| analysis_words(*kind))
        .collect();
    format!(
        "{} of {}: for {}",
        lack.keys.join(" and "),
        names(&lack.bodies),
        kinds.join(", ")
    )
}
