//! Figures of studies: responses over what was varied, and how often they have their values.

use std::path::Path;

use serde_json::Value;

use super::options::Options;
use crate::cli::exit::{BadInput, Failure};
use crate::cli::results::Results;
use linkdyn_ask::text::number;
use linkdyn_output::Table;
use linkdyn_output::read::ReadColumn;

/// Curves of one study, at most.
const MOST_CURVES: usize = 12;
/// Bars of a histogram.
const FEWEST_BINS: usize = 8;
const MOST_BINS: usize = 80;
/// Digits of a value in the legend.
const DIGITS: usize = 4;
/// The column of a histogram.
const SHARE: &str = "share of variants";

/// Puts curves in the place of studies: one for each value of what is varied besides the x axis, or histograms.
///
/// # Errors
/// A study of samples without `--histogram`, axes that are not clear, more curves than can be told apart.
pub fn unfold(options: Options, runs: Vec<Results>) -> Result<(Options, Vec<Results>), Failure> {
    if options.histogram {
        return histograms(options, &runs);
    }
    if !runs.iter().any(is_study) {
        return Ok((options, runs));
    }
    let (mut options, several) = (options, runs.len() > 1);
    let (mut all, mut labels) = (Vec::new(), Vec::new());
    for run in runs {
        match facts(&run) {
            Some(facts) => {
                let curves = curves(&mut options, &run, &facts)?;
                for (label, curve) in curves {
                    labels.push(match several {
                        true => format!("{}, {label}", run.file_name()),
                        false => label,
                    });
                    all.push(curve);
                }
            }
            None => {
                labels.push(run.file_name());
                all.push(run);
            }
        }
    }
    if options.label.is_empty() && all.len() > 1 {
        options.label = labels;
    }
    Ok((options, all))
}

fn is_study(run: &Results) -> bool {
    let name = run.table.path.file_name();
    name.is_some_and(|name| name == "variants.csv")
}

/// `study.json` beside the rows of a study.
fn facts(run: &Results) -> Option<Value> {
    if !is_study(run) {
        return None;
    }
    let path = run.table.path.with_file_name("study.json");
    serde_json::from_slice(&std::fs::read(path).ok()?).ok()
}

/// The names of what was varied over a grid.
fn grid(facts: &Value) -> Vec<&str> {
    let inputs = facts["inputs"].as_array().into_iter().flatten();
    let inputs = inputs.filter(|input| input["how"].get("scattered").is_none());
    inputs.filter_map(|input| input["name"].as_str()).collect()
}

fn refused(path: &Path, why: String) -> Failure {
    BadInput(vec![format!("{}: {why}", path.display())])
}

/// A curve for each set of values of the other parameters, its rows in the order of the x axis.
fn curves(
    options: &mut Options,
    run: &Results,
    facts: &Value,
) -> Result<Vec<(String, Results)>, Failure> {
    let varied = grid(facts);
    let is_grid = facts["method"] == "grid";
    if !is_grid {
        let why = "samples are no curve: --histogram draws how often a response has its values";
        return Err(refused(&run.path, why.to_owned()));
    }
    if options.x == "time" {
        let [one] = varied[..] else {
            let why = format!("which one is the x axis? --x {}", varied.join(", or --x "));
            return Err(refused(&run.path, why));
        };
        one.clone_into(&mut options.x);
    }
    let plain = |name: &str| name.strip_prefix("parameters.").unwrap_or(name).to_owned();
    let find = |name: &str| {
        let columns = run.columns(name);
        let columns = columns.first().copied();
        columns.ok_or_else(|| BadInput(vec![run.unknown("--x", name)]))
    };
    if let Some(name) = varied.iter().find(|name| plain(name) == options.x) {
        (*name).clone_into(&mut options.x);
    }
    let x = find(&options.x)?;
    let others = varied.iter().filter(|name| **name != x.name);
    let others = others.map(|name| find(name));
    let others = others.collect::<Result<Vec<_>, _>>()?;
    let mut groups: Vec<(Vec<u64>, Vec<usize>)> = Vec::new();
    for row in 0..run.table.len() {
        let values = others.iter().map(|column| column.values[row].to_bits());
        let values: Vec<u64> = values.collect();
        match groups.iter().position(|(known, _)| *known == values) {
            Some(place) => groups[place].1.push(row),
            None if groups.len() == MOST_CURVES => {
                let why = format!(
                    "more than {MOST_CURVES} curves: vary fewer values of {}",
                    others
                        .iter()
                        .map(|own| plain(&own.name))
                        .collect::<Vec<_>>()
                        .join(" and ")
                );
                return Err(refused(&run.path, why));
            }
            None => groups.push((values, vec![row])),
        }
    }
    let of_group = |(values, mut rows): (Vec<u64>, Vec<usize>)| {
        rows.sort_by(|a, b| x.values[*a].total_cmp(&x.values[*b]));
        let values = others.iter().zip(values).map(|(column, bits)| {
            let value = number(f64::from_bits(bits), DIGITS);
            format!("{} = {value} {}", plain(&column.name), column.unit)
        });
        let label: Vec<String> = values.map(|text| text.trim_end().to_owned()).collect();
        (label.join(", "), picked(run, &rows))
    };
    Ok(groups.into_iter().map(of_group).collect())
}

/// Some rows of a run.
fn picked(run: &Results, rows: &[usize]) -> Results {
    let columns = run.table.columns.iter().map(|column| ReadColumn {
        values: rows.iter().map(|&row| column.values[row]).collect(),
        ..column.clone()
    });
    Results {
        table: Table {
            columns: columns.collect(),
            path: run.table.path.clone(),
        },
        path: run.path.clone(),
        summary: None,
    }
}

/// How often columns have their values.
fn histograms(mut options: Options, runs: &[Results]) -> Result<(Options, Vec<Results>), Failure> {
    let [name] = &options.y[..] else {
        let why = "--histogram draws one column: give --y once, without * and ?";
        return Err(BadInput(vec![why.to_owned()]));
    };
    let name = name.clone();
    let (mut all, mut labels, mut limits) = (Vec::new(), Vec::new(), Vec::new());
    for run in runs {
        let columns = run.columns(&name);
        let [column] = columns[..] else {
            return Err(BadInput(vec![run.unknown("--y", &name)]));
        };
        let values = run.table.values(column)?;
        let Some([edges, shares]) = bins(values) else {
            let why = format!("{name}: no row has a value");
            return Err(refused(&run.path, why));
        };
        let most = shares.iter().fold(0.0, |most: f64, share| most.max(*share));
        limits.extend(limit_lines(run, column, most));
        all.push(outline(run, column, [edges, shares]));
        labels.push(run.file_name());
        column.name.clone_into(&mut options.x);
    }
    if let Some(limits) = limits.into_iter().next() {
        all.push(limits);
        labels.push("limits".to_owned());
        if options.label.len() < all.len() {
            options
                .label
                .extend_from_slice(&labels[options.label.len()..]);
        }
    }
    options.y = vec![SHARE.to_owned()];
    options.whole = true;
    Ok((options, all))
}

/// A line over the values of a column.
fn outline(run: &Results, column: &ReadColumn, [x, y]: [Vec<f64>; 2]) -> Results {
    let columns = vec![
        ReadColumn::new(&column.name, &column.unit, x),
        ReadColumn::new(SHARE, "%", y),
    ];
    Results {
        table: Table {
            columns,
            path: run.table.path.clone(),
        },
        path: run.path.clone(),
        summary: run.summary.clone(),
    }
}

/// Lines where a response of a study has its limits, so high.
fn limit_lines(run: &Results, column: &ReadColumn, high: f64) -> Option<Results> {
    let facts = facts(run)?;
    let mut responses = facts["responses"].as_array()?.iter();
    let own = responses.find(|own| own["name"] == column.name.as_str())?;
    let limits = ["lower", "upper"].map(|side| own["limits"][side].as_f64());
    let mut line = [Vec::new(), Vec::new()];
    for limit in limits.into_iter().flatten() {
        line[0].extend([limit, limit, limit]);
        line[1].extend([0.0, high, 0.0]);
    }
    (!line[0].is_empty()).then(|| outline(run, column, line))
}

/// The outline of the bars: places, and shares of the values in percent. As wide as Freedman and Diaconis (1981) find good,
/// two quartile ranges over the cube root of the count.
fn bins(values: &[f64]) -> Option<[Vec<f64>; 2]> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (least, most) = (*sorted.first()?, *sorted.last()?);
    let part = |share: f64| sorted[(share * (sorted.len() - 1) as f64).round() as usize];
    let count = sorted.len() as f64;
    let wide = 2.0 * (part(0.75) - part(0.25)) / count.cbrt();
    let wanted = ((most - least) / wide).ceil();
    let bins = match wanted.is_finite() {
        true => (wanted as usize).clamp(FEWEST_BINS, MOST_BINS),
        false => FEWEST_BINS,
    };
    // of values that are all the same, a bar about them
    let room = if most > least {
        0.0
    } else {
        least.abs().max(1.0) * 1e-6
    };
    let (low, high) = (least - room, most + room);
    let edge = |k: usize| low + (high - low) * k as f64 / bins as f64;
    let mut found = vec![0_u32; bins];
    for value in &sorted {
        let place = (value - low) / (high - low) * bins as f64;
        found[(place as usize).min(bins - 1)] += 1;
    }
    let (mut edges, mut shares) = (vec![low], vec![0.0]);
    for (k, found) in found.into_iter().enumerate() {
        edges.extend([edge(k), edge(k + 1)]);
        shares.extend([100.0 * f64::from(found) / count; 2]);
    }
    edges.push(high);
    shares.push(0.0);
    Some([edges, shares])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_hold_all_values() {
        let values: Vec<f64> = (0..1000)
            .map(|k| f64::from(k).sqrt())
            .chain([f64::NAN])
            .collect();
        let [edges, shares] = bins(&values).expect("values");
        assert_eq!(edges.len(), shares.len());
        assert_eq!((edges[0], edges[edges.len() - 1]), (0.0, 999f64.sqrt()));
        // each bar has two corners
        let whole: f64 = shares.iter().sum::<f64>() / 2.0;
        assert!((whole - 100.0).abs() < 1e-9, "{whole} %");
        // of the root of what is even, the density grows
        let bar = |k: usize| shares[2 * k + 1];
        assert!(bar(1) < bar(shares.len() / 2 - 2));
    }

    #[test]
    fn one_value_is_one_bar_and_none_is_none() {
        let [edges, shares] = bins(&[3.0; 5]).expect("values");
        assert!(edges[0] < 3.0 && edges[edges.len() - 1] > 3.0);
        assert_eq!(shares.iter().filter(|share| **share == 100.0).count(), 2);
        assert!(bins(&[f64::NAN]).is_none());
    }
}
