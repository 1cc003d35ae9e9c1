//! The choice of tolerances for people, and for programs.

use serde_json::{Value, json};

use super::super::open::Opened;
use super::super::page::{Page, number};
use super::{Chosen, DIGITS, Found, unit};
use linkdyn_engine::analysis::accuracy::OutputAccuracy;
use linkdyn_model::Parameter;

/// A deviation of a parameter in the units of the file.
pub fn quantity(opened: &Opened, parameter: &Parameter, value: f64, digits: usize) -> String {
    let display = &opened.loaded.model.display;
    match parameter.unit.as_str() {
        "m" => display.length_to(value, digits),
        "rad" => display.angle_to(value, digits).replace('°', " deg"),
        _ => format!("{}{}", number(value, digits), unit(parameter)),
    }
}

fn total(found: &Found) -> f64 {
    found
        .chosen
        .iter()
        .map(|chosen| chosen.cost / chosen.half)
        .sum()
}

/// The choice for people.
pub fn page(opened: &Opened, rss: bool, found: &Found, written: Option<&str>) -> String {
    let mut page = Page::default();
    page.line(format!(
        "{} ({}): cheapest tolerances that keep all limits, {}",
        opened.name,
        opened.label,
        how(rss)
    ));
    let width = found
        .chosen
        .iter()
        .map(|chosen| chosen.parameter.name.chars().count())
        .max()
        .unwrap_or(0)
        .max(9);
    let header = format!(
        "{:width$}  {:>16}  {:>16}  {:>16}  {:>10}  {:>8}",
        "parameter", "was", "to first order", "tolerance", "cost", "share"
    );
    let sum = total(found);
    let rows = found.chosen.iter().map(|chosen| {
        let was = chosen
            .parameter
            .tolerance
            .as_ref()
            .map_or(0.0, |tolerance| tolerance.half_width());
        let cost = chosen.cost / chosen.half;
        let of = |half: f64| format!("±{}", quantity(opened, chosen.parameter, half, DIGITS));
        format!(
            "{:width$}  {:>16}  {:>16}  {:>16}  {:>10}  {:>6.2} %",
            chosen.parameter.name,
            of(was),
            of(chosen.first),
            of(chosen.half),
            number(cost, DIGITS),
            100.0 * cost / sum
        )
    });
    page.rows("tolerances", std::iter::once(header).chain(rows));
    let first: f64 = found
        .chosen
        .iter()
        .map(|chosen| chosen.cost / chosen.first)
        .sum();
    page.row(
        "cost",
        format!(
            "{} ({} to first order)",
            number(sum, DIGITS + 1),
            number(first, DIGITS + 1)
        ),
    );
    let limits = found.accuracy.outputs.iter();
    page.rows("limits", limits.filter_map(|output| kept(output, rss)));
    if !found.idle.is_empty() {
        page.row(
            "left as they are",
            found.idle.join(", ") + ": no limit depends on them",
        );
    }
    page.rows("written", written);
    page.text().to_string()
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

fn how(rss: bool) -> &'static str {
    if rss {
        "by the sum of squares"
    } else {
        "worst case"
    }
}

/// Everything, for programs.
pub fn to_json(opened: &Opened, rss: bool, found: &Found) -> Value {
    let of = |chosen: &Chosen| {
        let value = json!({ "first_order": chosen.first, "tolerance": chosen.half, "unit": chosen.parameter.unit, "cost": chosen.cost / chosen.half });
        (chosen.parameter.name.clone(), value)
    };
    let limits = found
        .accuracy
        .outputs
        .iter()
        .filter_map(|output| Some((output.name.clone(), json!({ "used": output.used()? }))));
    json!({
        "engine": env!("CARGO_PKG_VERSION"),
        "model": { "name": opened.name, "sha256": opened.sha256 },
        "sum": if rss { "squares" } else { "worst" },
        "parameters": found.chosen.iter().map(of).collect::<serde_json::Map<_, _>>(),
        "cost": total(found),
        "first_order_cost": found.chosen.iter().map(|chosen| chosen.cost / chosen.first).sum::<f64>(),
        "limits": limits.collect::<serde_json::Map<_, _>>(),
        "left": found.idle,
        "rounds": found.rounds,
    })
}
