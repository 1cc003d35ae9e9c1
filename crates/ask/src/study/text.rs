//! A study in words.

use linkdyn_study::summary::Share;

use super::Studied;
use super::display::Display;
use super::head::{Head, Sampling};
use super::inputs::How;
use super::sums::OfResponse;
use crate::text::{Page, number};

/// Reasons that are listed.
const MOST: usize = 8;

impl Studied {
    /// The study in words.
    pub fn text(&self) -> Page {
        let (head, totals, display) = (&self.head, &self.totals, &self.display);
        let mut page = Page::default();
        page.line(format!(
            "{}: study of {} variants ({})",
            head.model.name,
            head.variants,
            head.method_words()
        ));
        let inputs = head.inputs.iter().map(|own| {
            let how = how(&own.how, |x| display.words(x, &own.unit));
            format!("{}  {how}", own.name)
        });
        page.rows("inputs", inputs);
        if let Some(share) = &totals.completed {
            page.row("completed", shared(head, share));
        }
        if let Some(share) = &totals.within_limits {
            page.row("within limits", shared(head, share));
        }
        let failures = totals.failures.iter().take(MOST);
        let failures = failures.map(|(reason, count)| format!("{count} {reason}"));
        let more = totals.failures.len().saturating_sub(MOST);
        let more = (more > 0).then(|| format!("… and {more} reasons more"));
        page.rows("failures", failures.chain(more));
        for (name, response) in &totals.responses {
            of_response(&mut page, head, display, (name, response));
        }
        page
    }
}

impl Head {
    /// How the variants are chosen, in words.
    pub(super) fn method_words(&self) -> String {
        let seed = self.seed;
        match self.method.as_str() {
            "grid" => "grid".to_owned(),
            "monte_carlo" => format!("Monte Carlo, seed {seed}"),
            "sobol" => format!("Sobol points, seed {seed}"),
            "latin_hypercube" => format!("Latin hypercube, seed {seed}"),
            method => format!("{method}, seed {seed}"),
        }
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
