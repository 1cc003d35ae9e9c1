//! `compare.json`.

use indexmap::IndexMap;
use linkdyn_output::Column;
use serde::{Serialize, Serializer};

use super::{Compared, Rung, cpu, numbers};
use crate::{ENGINE, Subject};

#[derive(Serialize)]
struct Document<'a> {
    engine: &'a str,
    model: Subject<'a>,
    joints: &'a [String],
    reference: Option<&'a str>,
    models: Vec<RungJson<'a>>,
    columns: Vec<String>,
    differences: IndexMap<String, IndexMap<&'a str, Difference>>,
    extremes: IndexMap<String, IndexMap<&'a str, Extremes>>,
}

#[derive(Serialize)]
struct RungJson<'a> {
    model: &'a str,
    status: &'a str,
    message: Option<&'a str>,
    #[serde(flatten)]
    ran: Option<Ran<'a>>,
}

#[derive(Serialize)]
struct Ran<'a> {
    instants: usize,
    steps: u64,
    evaluations: u64,
    contacts: Option<u64>,
    cpu: f64,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct Difference {
    max: f64,
    max_time: f64,
    mean: f64,
    rms: f64,
    instants: usize,
}

#[derive(Serialize)]
struct Extremes {
    min: f64,
    min_time: f64,
    max: f64,
    max_time: f64,
}

impl Serialize for Compared {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let columns = &self.comparison.columns;
        let mut differences: IndexMap<String, IndexMap<&str, Difference>> = IndexMap::new();
        for one in &self.comparison.differences {
            let [max, max_time, mean, rms] = numbers(one);
            let difference = Difference {
                max,
                max_time,
                mean,
                rms,
                instants: one.instants,
            };
            let of_column = differences.entry(one.column.label()).or_default();
            of_column.insert(&one.run, difference);
        }
        let extremes = columns.iter().map(|column| {
            let by_model = self.extremes(column);
            let by_model = by_model.map(|(model, [min, min_time, max, max_time])| {
                let extremes = Extremes {
                    min,
                    min_time,
                    max,
                    max_time,
                };
                (model, extremes)
            });
            (column.label(), by_model.collect())
        });
        let document = Document {
            engine: ENGINE,
            model: self.file.subject(),
            joints: &self.joints,
            reference: self.ran().next().map(|(model, _)| model),
            models: self.rungs.iter().map(|rung| self.rung(rung)).collect(),
            columns: columns.iter().map(Column::label).collect(),
            differences,
            extremes: extremes.collect(),
        };
        document.serialize(serializer)
    }
}

impl Compared {
    fn rung<'a>(&self, rung: &'a Rung) -> RungJson<'a> {
        let model = rung.model;
        match &rung.ran {
            Err(why) => RungJson {
                model,
                status: self.refusal(),
                message: Some(why),
                ran: None,
            },
            Ok((_, outcome)) => RungJson {
                model,
                status: outcome.report.status.word(),
                message: outcome.report.message.as_deref(),
                ran: Some(Ran {
                    instants: outcome.trajectory.len(),
                    steps: outcome.report.statistics.steps,
                    evaluations: outcome.report.statistics.evaluations,
                    contacts: self.contacts(outcome),
                    cpu: cpu(outcome),
                    warnings: &outcome.report.warnings,
                }),
            },
        }
    }
}
