//! Accuracy for people: the worst pose of each output, its levels, and who contributes.

use linkdyn_model::display::DisplayUnits;
use linkdyn_model::{Distribution, Pins};
use linkdyn_variation::{Levels, OutputAccuracy, PoseAccuracy};

use super::levels::{allowed, both, certified, first_of, found_of, of_limits, signed, value};
use super::{Deviations, Found};
use crate::ModelFile;
use crate::text::{Page, Side, Table, count};

/// Contributions that are printed of one output.
const MOST: usize = 12;
/// Poses of a stroke that are printed.
const POSES: usize = 9;

impl Deviations {
    /// All outputs in words.
    pub fn text(&self) -> Page {
        let (file, found) = (&self.file, &self.found);
        let mut page = Page::default();
        let outputs = count(found.outputs.len(), "output");
        let (name, label) = (file.name(), file.label());
        page.line(format!("{name} ({label}): accuracy of {outputs}"));
        page.row("assumed", assumed(file));
        let drivers: Vec<&str> = file.model().drivers.keys().map(String::as_str).collect();
        for output in &found.outputs {
            of_output(&mut page, &file.model().display, found, output, &drivers);
        }
        page.rows("warnings", &file.loaded.warnings);
        page
    }
}

/// What the numbers assume of pins and parameters.
pub fn assumed(file: &ModelFile) -> String {
    let accuracy = file.model().accuracy.as_ref();
    let pins = accuracy.map_or(Pins::Worst, |accuracy| accuracy.pins);
    let pins = match pins {
        Pins::Worst | Pins::Rim => "pins on the rim of their bearings, any direction",
        Pins::Disc => "pins anywhere in their bearings",
        Pins::Load => {
            "pins where the loads press them, for the spread; on the rim, in the worst case"
        }
        Pins::None => "pins in the middle of their bearings",
    };
    let mut words: Vec<String> = Vec::new();
    for parameter in &file.loaded.parameters {
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
    found: &Found,
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
    found: &Found,
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
    let names = order.iter().map(|&k| found.sources[k].chars().count());
    let width = names.max().unwrap_or(0).max(6);
    let columns = [
        (Side::Left, width),
        (Side::Right, 18),
        (Side::Right, 10),
        (Side::Right, 10),
    ];
    let mut table = Table::new(2, columns);
    table.row(["source", "carries it by", "worst case", "variance"]);
    for &k in order.iter().take(MOST) {
        let by = both(display, unit, pose.contributions[k].reach);
        let [worst, variance] = shares[k].map(|share| format!("{:.2} %", 100.0 * share));
        table.row([found.sources[k].clone(), by, worst, variance]);
    }
    let more = order.len().saturating_sub(MOST);
    let more = (more > 0).then(|| format!("… and {more} more"));
    table.lines().chain(more).collect()
}
