//! The fastest motion for programs: `path-time.json`, and the law as a table.

use linkdyn_output::csv::push_field;
use serde::{Serialize, Serializer};

use super::FastestMotion;
use crate::{ENGINE, Varying};

#[derive(Serialize)]
struct Document<'a> {
    engine: &'a str,
    model: Varying,
    driver: &'a str,
    unit: &'a str,
    from: f64,
    to: f64,
    time: f64,
    gap: f64,
    iterations: usize,
    rounds: usize,
    limits: Vec<Limit<'a>>,
    check: Excess<'a>,
    law: LawTable<'a>,
}

#[derive(Serialize)]
struct Limit<'a> {
    name: &'a str,
    unit: &'a str,
    lower: Option<f64>,
    upper: f64,
    largest_part: f64,
    intervals: usize,
    worth: f64,
}

#[derive(Serialize)]
struct Excess<'a> {
    excess: f64,
    limit: &'a str,
    time: f64,
    outputs: usize,
}

#[derive(Serialize)]
struct LawTable<'a> {
    time: Vec<f64>,
    value: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    limit: Vec<Option<&'a str>>,
    limit_curve: Vec<Option<f64>>,
}

/// `path-time.json`.
impl Serialize for FastestMotion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (excess, bound, time) = self.excess;
        let (stroke, law) = (&self.stroke, &self.law);
        let limits = self.bounds.iter().zip(self.shares()).enumerate();
        Document {
            engine: ENGINE,
            model: self.file.varying(),
            driver: &stroke.driver,
            unit: self.unit,
            from: stroke.from,
            to: stroke.to,
            time: self.time(),
            gap: law.found.gap,
            iterations: law.iterations,
            rounds: law.rounds,
            limits: limits
                .map(|(k, (bound, intervals))| Limit {
                    name: &bound.name,
                    unit: bound.unit,
                    lower: bound.has_lower().then_some(bound.range[0]),
                    upper: bound.range[1],
                    largest_part: self.largest(k),
                    intervals,
                    worth: law.worth(k),
                })
                .collect(),
            check: Excess {
                excess: excess.max(0.0),
                limit: &self.bounds[bound].name,
                time,
                outputs: self.run.len(),
            },
            law: self.law_table(),
        }
        .serialize(serializer)
    }
}

impl FastestMotion {
    /// The law at the nodes; accelerations and limits are those of the interval that begins there.
    fn law_table(&self) -> LawTable<'_> {
        let direction = (self.stroke.to - self.stroke.from).signum();
        let last = self.stroke.intervals - 1;
        let nodes = 0..self.law.nodes.len();
        let all: Vec<(f64, [f64; 2])> = self.law.instants().collect();
        let limit = |node: usize| Some(self.bounds[self.binding(node.min(last))?].name.as_str());
        let top = |node| self.law.top(&self.bounds, &self.coefficients, node);
        LawTable {
            time: all.iter().map(|(time, _)| *time).collect(),
            value: self
                .law
                .nodes
                .iter()
                .map(|x| self.stroke.from + direction * x)
                .collect(),
            velocity: all.iter().map(|(_, [b, _])| direction * b.sqrt()).collect(),
            acceleration: all.iter().map(|(_, [_, a])| direction * a).collect(),
            limit: nodes.clone().map(limit).collect(),
            limit_curve: nodes.map(top).collect(),
        }
    }

    /// The law as a table, `law.csv`.
    pub fn table(&self) -> String {
        let unit = self.unit;
        let mut out = format!(
            "time [s],value [{unit}],velocity [{unit}/s],acceleration [{unit}/s^2],limit,limit_curve [{unit}/s]\n"
        );
        let law = self.law_table();
        for k in 0..law.time.len() {
            let [time, value] = [law.time[k], law.value[k]];
            out += &format!(
                "{time:?},{value:?},{:?},{:?},",
                law.velocity[k], law.acceleration[k]
            );
            let mut cell = Vec::new();
            push_field(&mut cell, law.limit[k].unwrap_or_default());
            out += &String::from_utf8_lossy(&cell);
            let top = law.limit_curve[k].map(|top| format!("{top:?}"));
            out += &format!(",{}\n", top.unwrap_or_default());
        }
        out
    }
}
