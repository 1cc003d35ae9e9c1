//! A study for people.

use std::path::PathBuf;

use super::asked::How;
use super::display::Display;
use super::head::{Head, Sampling};
use super::totals::{OfResponse, Told};
use crate::cli::page::{Page, number};
use linkdyn_study::summary::Share;

/// Reasons that are listed.
const MOST: usize = 8;

/// What is printed.
pub fn page(head: &Head, told: &Told, display: &Display, written: &[PathBuf]) -> String {
    let mut page = Page::default();
    let name = head.model["name"].as_str().unwrap_or_default();
    page.line(format!(
        "{name}: study of {} variants ({})",
        head.variants,
        method(head)
    ));
    page.rows(
        "inputs",
        head.inputs.iter().map(|own| {
            format!(
                "{}  {}",
                own.name,
                how(&own.how, |x| display.words(x, &own.unit))
            )
        }),
    );
    if let Some(share) = &told.completed {
        page.row("completed", shared(head, share));
    }
    if let Some(share) = &told.within_limits {
        page.row("within limits", shared(head, share));
    }
    let mut failures: Vec<String> = told
        .failures
        .iter()
        .take(MOST)
        .map(|(reason, count)| format!("{count} {reason}"))
        .collect();
    if told.failures.len() > MOST {
        failures.push(format!("… and {} reasons more", told.failures.len() - MOST));
    }
    page.rows("failures", failures);
    for (name, response) in &told.responses {
        of_response(&mut page, head, display, (name, response));
    }
    page.rows(
        "written",
        written.iter().map(|path| path.display().to_string()),
    );
    page.text().to_owned()
}

/// How the variants were chosen, in words.
pub fn method(head: &Head) -> String {
    match head.method.as_str() {
        "grid" => "grid".to_owned(),
        "monte_carlo" => format!("Monte Carlo, seed {}", head.seed),
        "sobol" => format!("Sobol points, seed {}", head.seed),
        "latin_hypercube" => format!("Latin hypercube, seed {}", head.seed),
        method => format!("{method}, seed {}", head.seed),
    }
}

fn how(how: &How, value: impl Fn(f64) -> String) -> String {
    match how {
        How::Linear { from, to, count } => {
            format!("{} to {}, {count} values", value(*from), value(*to))
        }
        How::Listed(values) => {
            let values: Vec<String> = values.iter().take(MOST).map(|x| value(*x)).collect();
            values.join(", ")
        }
        How::Scattered {
            distribution,
            lower,
            upper,
        } => {
            format!("{} / +{}, {distribution}", value(*lower), value(*upper))
        }
    }
}

fn shared(head: &Head, share: &Share) -> String {
    let percent = |share: f64| number(100.0 * share, 5);
    let interval = share.lower.zip(share.upper);
    let sure = interval.map(|(lower, upper)| {
        let [lower, upper] = [lower, upper].map(percent);
        format!("95 % sure: {lower} to {upper} %")
    });
    let why = match head.sampling() {
        Sampling::Each => None,
        Sampling::Ends(_) => Some("counted are the independent rows, two of each sample"),
        Sampling::Grid => Some("points of a grid, no sample"),
        Sampling::Repeated => Some("the same samples at each point of the grid"),
    };
    let told: Vec<String> = sure.into_iter().chain(why.map(str::to_owned)).collect();
    format!(
        "{} of {} = {} % ({})",
        share.within,
        share.total,
        percent(share.share),
        told.join("; ")
    )
}

fn of_response(
    page: &mut Page,
    head: &Head,
    display: &Display,
    (name, response): (&str, &OfResponse),
) {
    let summary = &response.summary;
    let Some((mean, deviation)) = summary.mean.zip(summary.deviation.or(Some(0.0))) else {
        page.row(name, "no variant has a value");
        return;
    };
    let value = |x: f64| display.words_of(name, x, &response.unit);
    let (min, max) = (summary.min.unwrap_or(mean), summary.max.unwrap_or(mean));
    let mut rows = vec![format!(
        "{} … {}, mean {}, σ {}",
        value(min),
        value(max),
        value(mean),
        value(deviation)
    )];
    if let Some(quantiles) = &summary.quantiles
        && head.method != "grid"
    {
        let [low, middle, high] = [0, 1, 2].map(|k| value(quantiles[k]));
        rows.push(format!("0.135 % {low}, median {middle}, 99.865 % {high}"));
    }
    if let Some(cpk) = summary.cpk {
        let outside = format!(
            "{} below, {} above the limits",
            summary.below, summary.above
        );
        let cp = summary.cp.map(|cp| format!("Cp {}, ", number(cp, 4)));
        // The points of a grid have no spread that says anything of parts.
        rows.push(match head.sampling() {
            Sampling::Grid => outside,
            Sampling::Each | Sampling::Ends(_) | Sampling::Repeated => {
                let cpk = number(cpk, 4);
                format!("{}Cpk {cpk}; {outside}", cp.unwrap_or_default())
            }
        });
    }
    if let Some(indices) = &response.indices {
        for (input, (first, total)) in head
            .inputs
            .iter()
            .zip(indices.first.iter().zip(&indices.total))
        {
            rows.push(format!(
                "index of {}: first {}, total {}",
                input.name,
                number(first.value, 3),
                number(total.value, 3)
            ));
        }
    }
    if summary.none > 0 {
        rows.push(format!("{} without a value", summary.none));
    }
    page.rows(name, rows);
}
