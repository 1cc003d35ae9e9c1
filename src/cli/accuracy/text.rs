//! Accuracy for people: the worst pose of each output, its levels, and who contributes.

use std::path::PathBuf;

use super::super::open::Opened;
use super::super::page::{Page, number};
use linkdyn_engine::analysis::accuracy::{Accuracy, OutputAccuracy, PoseAccuracy};
use linkdyn_model::display::DisplayUnits;
use linkdyn_model::{Distribution, Pins};

/// Digits of deviations and of sensitivities.
const DIGITS: usize = 5;
/// Contributions that are printed of one output.
const MOST: usize = 12;
const NO_FIRST: &str =
    "does not exist: a change point, where accuracy goes with the root of the clearance";
/// Shares of the clearances and tolerances whose reach is printed where nothing is certified.
const SHARES: [f64; 3] = [0.1, 0.5, 1.0];
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

/// A value in the units of the file.
fn value(display: &DisplayUnits, unit: &str, value: f64) -> String {
    match unit {
        "rad" => display.angle_to(value, DIGITS),
        _ => display.length_to(value, DIGITS),
    }
}

/// `±a`, or `-a / +b`.
fn both(display: &DisplayUnits, unit: &str, [low, high]: [f64; 2]) -> String {
    let [below, above] = [-low, high].map(|by| value(display, unit, by));
    if below == above {
        format!("±{above}")
    } else {
        format!(
            "{} / {}",
            signed(display, unit, low),
            signed(display, unit, high)
        )
    }
}

fn signed(display: &DisplayUnits, unit: &str, by: f64) -> String {
    let sign = if by < 0.0 { "-" } else { "+" };
    format!("{sign}{}", value(display, unit, by.abs()))
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
        .zip(&pose.drivers)
        .zip(&pose.driver_units)
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
    let worst = output
        .poses
        .iter()
        .max_by(|a, b| extent(a).total_cmp(&extent(b)));
    let Some(worst) = worst else { return };
    let where_ = match output.poses.len() {
        1 => format!("at {}", at(display, drivers, worst)),
        poses => format!(
            "over {poses} poses; farthest at {}",
            at(display, drivers, worst)
        ),
    };
    page.line(format!("{} = {}, {where_}", output.name, output.of));
    page.row("nominal", value(display, unit, worst.nominal));
    page.row(
        "first order",
        worst
            .first
            .map_or(NO_FIRST.into(), |first| both(display, unit, first)),
    );
    page.row(
        "worst found",
        match worst.found {
            [Some(low), Some(high)] => both(display, unit, [low, high]),
            [low, high] => {
                let side = |by: Option<f64>| {
                    by.map_or("not found".to_owned(), |by| signed(display, unit, by))
                };
                format!("{} / {}", side(low), side(high))
            }
        },
    );
    page.row(
        "certified",
        match worst.certified {
            Some(bound) => both(display, unit, bound),
            None => "no bound could be proved here (near a singular position, or an axis or gear centre has a tolerance)".into(),
        },
    );
    page.rows("allowed by", allowed(display, unit, worst));
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
        page.row("limits", of_limits(display, unit, limits, worst));
    }
    if output.poses.len() > 1 {
        page.rows("stroke", stroke(display, unit, drivers, output));
    }
    page.rows("contributions", contributions(display, unit, found, worst));
}

/// How far parts of all clearances and tolerances let the output go, where nothing is certified: beside a change point a part
/// of them allows more than that part of the deviation.
fn allowed(display: &DisplayUnits, unit: &str, pose: &PoseAccuracy) -> Vec<String> {
    let at = |side: usize, share: f64| {
        let points = pose.needed[side].iter();
        points
            .clone()
            .find(|[_, needed]| *needed == share)
            .map(|[by, _]| *by)
    };
    let row = |share: f64| {
        let by = match [at(0, share), at(1, share)] {
            [None, None] => return None,
            [Some(low), Some(high)] => both(display, unit, [low, high]),
            [Some(by), None] | [None, Some(by)] => signed(display, unit, by),
        };
        let part = number(100.0 * share, 3);
        Some(format!("{part} % of all clearances and tolerances: {by}"))
    };
    SHARES.iter().filter_map(|share| row(*share)).collect()
}

fn of_limits(display: &DisplayUnits, unit: &str, limits: [f64; 2], pose: &PoseAccuracy) -> String {
    let allowed = both(display, unit, limits);
    let held = |bound: Option<[f64; 2]>| {
        bound.is_some_and(|bound| bound[0] >= limits[0] && bound[1] <= limits[1])
    };
    let found = match pose.found {
        [Some(low), Some(high)] => Some([low, high]),
        _ => None,
    };
    let verdict = if held(pose.certified) {
        "always kept (certified)"
    } else if found.is_some_and(|found| found[0] < limits[0] || found[1] > limits[1]) {
        "exceeded by the worst found"
    } else {
        "kept by the worst found, not certified"
    };
    match &pose.capability {
        Some(capability) => format!(
            "{allowed}: {verdict}; {} % within, Cp {}, Cpk {}",
            number(100.0 * capability.within, 6),
            number(capability.cp, 4),
            number(capability.cpk, 4)
        ),
        None => format!("{allowed}: {verdict}"),
    }
}

/// Some poses along the stroke.
fn stroke(
    display: &DisplayUnits,
    unit: &str,
    drivers: &[&str],
    output: &OutputAccuracy,
) -> Vec<String> {
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
            format!("{}: {found}, {certified}", at(display, drivers, pose))
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
    let mut rows = vec![format!(
        "{:width$}  {:>18}  {:>10}  {:>10}",
        "source", "carries it by", "worst case", "variance"
    )];
    for &k in order.iter().take(MOST) {
        let by = both(display, unit, pose.contributions[k].reach);
        let [worst, variance] = shares[k].map(|share| format!("{:.2} %", 100.0 * share));
        rows.push(format!(
            "{:width$}  {by:>18}  {worst:>10}  {variance:>10}",
            found.sources[k]
        ));
    }
    if order.len() > MOST {
        rows.push(format!("… and {} more", order.len() - MOST));
    }
    rows
}
