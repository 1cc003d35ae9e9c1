//! What a study varies: axes of a grid from `--vary`, samples from the tolerances of parameters.

use linkdyn_model::{Given, Parameter, Tolerance};
use linkdyn_study::design::{Axis, Design, Grid, Layout, Samples};
use linkdyn_study::distribution::Distribution;
use serde::{Deserialize, Serialize};

use super::question::{Study, Varied};
use crate::near::did_you_mean;
use crate::scatter::distribution;
use crate::{ModelFile, Unanswered};

/// What is reported about a column of inputs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// `parameters.NAME`, or `parameters.NAME.deviation` of one that follows from others.
    pub name: String,
    /// SI unit; empty of a plain number.
    pub unit: String,
    /// How it varies: the values of an axis, or a distribution between limits [SI].
    pub how: How,
}

/// One column of inputs.
#[derive(Debug, Clone)]
pub struct Input {
    pub column: Column,
    parameter: String,
    /// Whether it follows from other parameters.
    follows: bool,
    /// The value of the file [SI].
    nominal: f64,
}

/// How an input varies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum How {
    /// Evenly, both ends included.
    Linear { from: f64, to: f64, count: u64 },
    /// Values one by one.
    Listed(Vec<f64>),
    /// Scattered, deviations from its value.
    Scattered {
        distribution: String,
        lower: f64,
        upper: f64,
    },
}

/// What is varied, and all variants.
#[derive(Debug)]
pub struct Inputs {
    pub inputs: Vec<Input>,
    pub design: Design,
    /// Rows that belong together for Sobol indices; `None` if they are not requested.
    pub rows_per_point: Option<u64>,
    /// Inputs of the grid come first.
    pub varied: usize,
}

impl Inputs {
    /// Reads the options against the parameters of the model.
    ///
    /// # Errors
    /// Unknown parameters, empty ranges, values of another dimension, nothing to vary.
    pub fn new(wanted: &Study, file: &ModelFile) -> Result<Self, Unanswered> {
        let mut inputs = Vec::new();
        let mut axes = Vec::new();
        for own in &wanted.varied {
            let (input, axis) = axis(own, file)?;
            if inputs
                .iter()
                .any(|own: &Input| own.parameter == input.parameter)
            {
                let name = &input.parameter;
                return Err(bad(format!("{}: {name} is varied twice", own.label)));
            }
            inputs.push(input);
            axes.push(axis);
        }
        let grid = Grid::new(axes).map_err(|fault| bad(format!("--vary: {fault}")))?;
        let varied = inputs.len();
        if wanted.indices && varied > 0 {
            return Err(bad(
                "--indices: Sobol indices are those of samples; not together with --vary",
            ));
        }
        let Some(points) = wanted.samples else {
            if inputs.is_empty() {
                return Err(bad(
                    "nothing is varied: say --vary \"parameters.NAME=FROM:TO:COUNT\", or --samples N for tolerances",
                ));
            }
            return Ok(Inputs {
                inputs,
                design: Design::of_grid(grid),
                rows_per_point: None,
                varied,
            });
        };
        let distributions = scatter(file, &mut inputs)?;
        if let Some(follows) = inputs[..varied].iter().find(|input| input.follows) {
            return Err(bad(format!(
                "--vary parameters.{}: it follows from others, and can't be varied together with samples",
                follows.parameter
            )));
        }
        let layout = if wanted.indices {
            Layout::Saltelli
        } else {
            Layout::Plain
        };
        let fault = |fault| bad(format!("--samples: {fault}"));
        let samples = Samples::new(
            wanted.method,
            layout,
            points,
            distributions.len(),
            wanted.seed,
        )
        .map_err(fault)?;
        let rows_per_point = wanted.indices.then(|| samples.rows_per_point());
        let design = Design::of_samples(grid, samples, distributions).map_err(fault)?;
        Ok(Inputs {
            inputs,
            design,
            rows_per_point,
            varied,
        })
    }

    /// The names of the parameters, in the order of the inputs.
    pub fn parameters(&self) -> Vec<&str> {
        let names = self.inputs.iter();
        names.map(|input| input.parameter.as_str()).collect()
    }

    /// How a variant gives them.
    pub fn given(&self) -> Given {
        match self.varied == self.inputs.len() {
            true => Given::Values,
            false => Given::Deviations,
        }
    }

    /// The inputs of a variant as they are reported, and as the model is given them.
    pub fn values(&self, variant: u64, told: &mut [f64], given: &mut [f64]) {
        self.design.row(variant, told);
        given.copy_from_slice(told);
        if self.given() == Given::Values {
            return;
        }
        // Values of the grid as deviations, those of samples are some.
        let inputs = self.inputs.iter().zip(told).zip(given);
        for (k, ((input, told), given)) in inputs.enumerate() {
            match k < self.varied {
                true => *given -= input.nominal,
                false if input.follows => {}
                false => *told += input.nominal,
            }
        }
    }
}

/// The parameters that scatter, behind those that are varied, and how.
fn scatter(file: &ModelFile, inputs: &mut Vec<Input>) -> Result<Vec<Distribution>, Unanswered> {
    let varied = inputs.len();
    let mut distributions = Vec::new();
    for parameter in &file.loaded.parameters {
        let Some(tolerance) = scattering(parameter) else {
            continue;
        };
        if inputs[..varied]
            .iter()
            .any(|own| own.parameter == parameter.name)
        {
            continue;
        }
        let (input, distribution) = scattered(parameter, tolerance)?;
        inputs.push(input);
        distributions.push(distribution);
    }
    if distributions.is_empty() {
        return Err(bad(
            "--samples: no parameter has a tolerance to sample from; as in \"rod\": { \"value\": \"200 mm\", \"tolerance\": \"0.1 mm\" }",
        ));
    }
    Ok(distributions)
}

fn bad(text: impl Into<String>) -> Unanswered {
    Unanswered::question(text)
}

/// `parameters.r=40 mm:60 mm:21`, or `parameters.r=40 mm, 50 mm`.
fn axis(own: &Varied, file: &ModelFile) -> Result<(Input, Axis), Unanswered> {
    let Varied {
        label,
        name,
        values,
    } = own;
    let parameters = &file.loaded.parameters;
    let Some(parameter) = parameters.iter().find(|own| own.name == *name) else {
        let known: Vec<&str> = parameters.iter().map(|own| own.name.as_str()).collect();
        let otherwise = if known.is_empty() {
            "it has none: give what is to vary a name under \"parameters\"".to_owned()
        } else {
            format!("it has {}", known.join(", "))
        };
        let hint = did_you_mean(name, known.iter().copied(), &otherwise);
        return Err(bad(format!(
            "{label}: the model has no parameter {name:?} ({hint})"
        )));
    };
    let read = |value: &str| {
        value_of(parameter, value.trim()).map_err(|why| bad(format!("{label}: {why}")))
    };
    let parts: Vec<&str> = values.split(':').collect();
    let (how, axis) = match parts[..] {
        [from, to, count] => {
            let count: u64 = count
                .trim()
                .parse()
                .map_err(|_| bad(format!("{label}: {:?} is no count of values", count.trim())))?;
            let (from, to) = (read(from)?, read(to)?);
            (
                How::Linear { from, to, count },
                Axis::Linear { from, to, count },
            )
        }
        [list] => {
            let list: Vec<f64> = list.split(',').map(read).collect::<Result<_, _>>()?;
            (How::Listed(list.clone()), Axis::Listed(list))
        }
        _ => return Err(bad(format!("{label}: {}", Varied::FORM))),
    };
    axis.check()
        .map_err(|fault| bad(format!("{label}: {fault}")))?;
    Ok((input(parameter, how, ""), axis))
}

/// A value as a parameter of a file would say it [SI], of the same dimension.
fn value_of(parameter: &Parameter, value: &str) -> Result<f64, String> {
    let found = quantity(value)?;
    if found.unit == parameter.unit {
        return Ok(found.value);
    }
    let named = |unit: &str| match unit {
        "" => "a plain number".to_owned(),
        unit => format!("in {unit}"),
    };
    Err(format!(
        "{value:?} is {}, {} is {} ({})",
        named(&found.unit),
        parameter.name,
        named(&parameter.unit),
        parameter.text
    ))
}

/// What a text says as the value of a parameter of a file in SI units.
pub fn quantity(value: &str) -> Result<Parameter, String> {
    let said = match value.parse::<f64>() {
        Ok(number) => serde_json::json!(number),
        Err(_) => serde_json::json!(value),
    };
    let file = serde_json::json!({ "format": "linkdyn/1", "units": "SI", "parameters": { "value": said },
        "bodies": { "bar": { "points": { "A": [0, 0] } } } });
    let loaded = linkdyn_model::load(file.to_string().as_bytes(), &[]);
    let loaded = loaded.map_err(|complaints| {
        let first = complaints.0.first();
        first.map_or_else(String::new, |own| format!("{value:?}: {}", own.message))
    })?;
    loaded
        .parameters
        .first()
        .cloned()
        .ok_or_else(|| "no value".to_owned())
}

fn input(parameter: &Parameter, how: How, what: &str) -> Input {
    Input {
        column: Column {
            name: format!("parameters.{}{what}", parameter.name),
            unit: parameter.unit.clone(),
            how,
        },
        parameter: parameter.name.clone(),
        follows: follows(parameter),
        nominal: parameter.value,
    }
}

fn follows(parameter: &Parameter) -> bool {
    parameter.text.trim_start().starts_with('=')
}

fn scattering(parameter: &Parameter) -> Option<&Tolerance> {
    let tolerance = parameter.tolerance.as_ref()?;
    (tolerance.lower != 0.0 || tolerance.upper != 0.0).then_some(tolerance)
}

fn scattered(parameter: &Parameter, by: &Tolerance) -> Result<(Input, Distribution), Unanswered> {
    let (distribution, word) = distribution(&parameter.name, by)?;
    let how = How::Scattered {
        distribution: word.to_owned(),
        lower: by.lower,
        upper: by.upper,
    };
    let what = if follows(parameter) { ".deviation" } else { "" };
    Ok((input(parameter, how, what), distribution))
}
