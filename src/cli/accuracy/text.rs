//! Accuracy for people: the worst pose of each output, its levels, and who contributes.

use std::path::PathBuf;

use super::super::open::Opened;
use super::super::page::Page;
use super::levels::{allowed, both, certified, first_of, found_of, of_limits, signed, value};
use linkdyn_engine::analysis::accuracy::{Accuracy, Levels, OutputAccuracy, PoseAccuracy};
use linkdyn_model::display::DisplayUnits;
use linkdyn_model::{Distribution, Pins};

/// Contributions that are printed of one output.
const MOST: usize = 12;
/// Poses of a stroke that are printed.
const POSES: usize = 9;

/// All outputs.
pub fn page(opened: &Opened, found: &Accuracy, written: &[PathBuf]) -> String {
    let mut page = Page::default();
    let plural = if found.outputs.len() == 1 { "" } else { "s" };
    page.line(format!(
        "{} ({}): accuracy of {} output{plural}",
        opened.name,
        opened.label,
        found.outputs.len()
    ));
    page.row("assumed", assumed(opened));
    for output in &found.outputs {
        of_output(
            &mut page,
            &opened.loaded.model.display,
            found,
            output,
            &opened
                .loaded
                .model
                .drivers
                .keys()
                .map(String::as_str)
                .collect::<Vec<_>>(),
        );
    }
    page.rows("warnings", &opened.loaded.warnings);
    page.rows(
        "written",
        written.iter().map(|path| path.display().to_string()),
    );
    page.text().to_string()
}

/// What the numbers assume of pins and parameters.
pub fn assumed(opened: &Opened) -> String {
    let pins = opened
        .loaded
        .model
        .accuracy
        .as_ref()
        .map_or(Pins::Worst, |accuracy| accuracy.pins);
    let pins = match pins {
        Pins::Worst | Pins::Rim => "pins on the rim of their bearings, any direction",
        Pins::Disc => "pins anywhere in their bearings",
        Pins::Load => {
            "pins where the loads press them, for the spread; on the rim, in the worst case"
        }
        Pins::None => "pins in the middle of their bearings",
    };
    let mut words: Vec<String> = Vec::new();
    for parameter in &opened.loaded.parameters {
        let Some(tolerance) = &parameter.tolerance else {
            continue;
        };
        let word = match tolerance.distribution {
            Distribution::Normal { sigma } => format!("normal, limits at ±{sigma} σ"),
            Distribution::Uniform => "uniform".to_owned(),
            Distribution::Triangular => "triangular".to_owned(),
        };
        if !words.contains(&word) {
            words.push(word);
        }
    }
    if words.is_empty() {
        pins.to_owned()
    } else {
        format!("{pins}; parameters {}", words.join(", "))
    }
}

/// Whether more is known than the first order, which beside singular positions means nothing.
fn is_found(pose: &PoseAccuracy) -> bool {
    pose.found.iter().any(Option::is_some)
}

/// How far a pose lets the output go, by the best that is known of it.
fn extent(pose: &PoseAccuracy) -> f64 {
    let found = pose
        .found
        .iter()
        .flatten()
        .map(|by| by.abs())
        .fold(0.0, f64::max);
    let first = pose.first.map_or(0.0, |first| first[1].max(-first[0]));
    if found > 0.0 { found } else { first }
}

fn at(display: &DisplayUnits, drivers: &[&str], pose: &PoseAccuracy) -> String {
    let said: Vec<String> = drivers
        .iter()
        .zip(&*pose.drivers)
        .zip(&*pose.driver_units)
        .map(|((name, by), unit)| format!("{name} = {}", value(display, unit, *by)))
        .collect();
    said.join(", ")
}

fn of_output(
    page: &mut Page,
    display: &DisplayUnits,
    found: &Accuracy,
    output: &OutputAccuracy,
    drivers: &[&str],
) {
    let unit = output.unit;
    let worst = output.poses.iter().max_by(|a, b| {
        is_found(a)
            .cmp(&is_found(b))
            .then(extent(a).total_cmp(&extent(b)))
    });
    let Some(worst) = worst else { return };
    let where_ = match output.poses.len() {
        1 => format!("at {}", at(display, drivers, worst)),
        poses => format!(
            "over {poses} poses; farthest at {}",
            at(display, drivers, worst)
        ),
    };
    page.line(format!("{} = {}, {where_}", output.name, output.of));
    if worst.nominal.is_finite() {
        page.row("nominal", value(display, unit, worst.nominal));
    }
    page.row("first order", first_of(display, unit, worst));
    if worst.missing.is_none() && found.levels >= Levels::Worst {
        page.row("worst found", found_of(display, unit, worst));
    }
    if worst.missing.is_none() && found.levels >= Levels::Certified {
        page.row("certified", certified(display, output, worst));
    }
    page.rows("allowed by", allowed(display, unit, worst));
    if output.is_force()
        && found
            .sources
            .iter()
            .any(|source| source.starts_with("joints."))
    {
        page.row(
            "pins",
            "here pressed by the load, from their least to their greatest clearance",
        );
    }
    if let Some([mean, sigma]) = worst.moments {
        let mean = if mean == 0.0 {
            String::new()
        } else {
            format!(", mean {}", signed(display, unit, mean))
        };
        page.row(
            "spread",
            format!("±{} (3σ){mean}", value(display, unit, 3.0 * sigma)),
        );
    }
    if let Some(pressed) = worst.pressed.filter(|by| *by != 0.0) {
        page.row(
            "lost motion",
            format!(
                "{} as the loads reverse (pins pressed by them: {})",
                value(display, unit, 2.0 * pressed.abs()),
                signed(display, unit, pressed)
            ),
        );
    }
    if let Some(limits) = output.limits {
        page.row(
            "limits",
            of_limits(display, unit, (limits, found.levels), worst),
        );
    }
    page.rows("without", without(display, drivers, output));
    if output.poses.len() > 1 {
        page.rows("stroke", stroke(display, drivers, output, found.levels));
    }
    page.rows("contributions", contributions(display, unit, found, worst));
}

/// The first of a stroke's poses at which there is no force, or none of its levels.
fn without(display: &DisplayUnits, drivers: &[&str], output: &OutputAccuracy) -> Option<String> {
    let mut poses = output.poses.iter().filter(|pose| pose.missing.is_some());
    let first = poses.next().filter(|_| output.poses.len() > 1)?;
    let more = match poses.count() {
        0 => String::new(),
        count => format!(" (and {count} more)"),
    };
    let missing = first.missing.as_deref()?;
    Some(format!("{}{more}: {missing}", at(display, drivers, first)))
}

/// Some poses along the stroke.
fn stroke(
    display: &DisplayUnits,
    drivers: &[&str],
    output: &OutputAccuracy,
    levels: Levels,
) -> Vec<String> {
    let unit = output.unit;
    let last = output.poses.len() - 1;
    let shown = POSES.min(output.poses.len());
    (0..shown)
        .map(|k| {
            let pose = &output.poses[k * last / (shown - 1).max(1)];
            let found = match pose.found {
                [Some(low), Some(high)] => both(display, unit, [low, high]),
                _ => "not found".into(),
            };
            let certified = pose.certified.map_or("not certified".into(), |bound| {
                format!("certified {}", both(display, unit, bound))
            });
            let said = match &pose.missing {
                Some(missing) => missing.clone(),
                None => match levels {
                    Levels::First => pose.first.map_or("no first order".into(), |first| {
                        format!("{} to first order", both(display, unit, first))
                    }),
                    Levels::Worst => found,
                    Levels::Certified if output.is_force() => found,
                    Levels::Certified => format!("{found}, {certified}"),
                },
            };
            format!("{}: {said}", at(display, drivers, pose))
        })
        .collect()
}

/// Who contributes, the greatest first.
fn contributions(
    display: &DisplayUnits,
    unit: &str,
    found: &Accuracy,
    pose: &PoseAccuracy,
) -> Vec<String> {
    let shares = pose.shares();
    let mut order: Vec<usize> = (0..pose.contributions.len())
        .filter(|&k| shares[k][0] > 0.0)
        .collect();
    order.sort_by(|&a, &b| shares[b][0].total_cmp(&shares[a][0]));
    if order.is_empty() {
        return Vec::new();
    }
    let width = order
        .iter()
        .map(|&k| found.sources[k].chars().count())
        .max()
        .unwrap_or(0)
        .max(6);
    let shown = order.iter().take(MOST);
    let carried = shown.map(|&k| (k, both(display, unit, pose.contributions[k].reach)));
    let carried: Vec<(usize, String)> = carried.collect();
    let wide = carried
        .iter()
        .map(|(_, by)| by.chars().count())
        .max()
        .unwrap_or(0)
        .max(18);
    let mut rows = vec![format!(
        "{:width$}  {:>wide$}  {:>10}  {:>10}",
        "source", "carries it by", "worst case", "variance"
    )];
    for (k, by) in carried {
        let [worst, variance] = shares[k].map(|share| format!("{:.2} %", 100.0 * share));
        rows.push(format!(
            "{:width$}  {by:>wide$}  {worst:>10}  {variance:>10}",
            found.sources[k]
        ));
    }
    if order.len() > MOST {
        rows.push(format!("… and {} more", order.len() - MOST));
    }
    rows
}
