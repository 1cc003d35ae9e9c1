//! A mechanism as a linear system: A, B, C, D about rest or at instants of its motion.

mod figures;
mod text;

pub use figures::Figures;

use std::f64::consts::TAU;

use linkdyn_engine::analysis::{
    Control, LinearSystem, NoLinearSystem, StateSpaceQuestion, Variable, state_space,
};
use linkdyn_linear::state_space::response;
use linkdyn_output::{Status, summary};
use serde::{Serialize, Serializer};
use serde_json::Value;

use crate::{ENGINE, ModelFile, Question, Subject, Unanswered};

/// Frequencies of a response where nobody says how many.
const POINTS: usize = 400;
/// How far responses go beyond the slowest and the fastest pole.
const BESIDE: f64 = 30.0;
/// The range around 1 Hz, where no pole says one.
const DECADE: f64 = 10.0;

/// Asks for the linear system of a model.
#[derive(Debug, Clone, Default)]
pub struct StateSpace {
    /// Inputs: `driver.NAME` (its torque or force), `driver.NAME.acceleration`, `input.NAME`, `force.NAME`, `BODY.POINT.fx`, `BODY.POINT.fy`,
    /// `BODY.torque`.
    pub inputs: Vec<String>,
    /// Columns of results, or patterns of them; where none are given, the positions of the states.
    pub outputs: Vec<String>,
    /// Whether it is about the assembled position, instead of the equilibrium.
    pub pose: bool,
    /// Instants of the motion \[s\]; about rest where there are none.
    pub at: Vec<f64>,
    /// Range of the frequency responses \[Hz\]; from the poles where not given.
    pub frequencies: Option<[f64; 2]>,
}

/// The linear system of a model, one for each instant.
#[derive(Debug, Clone)]
pub struct Linearisation {
    /// The model.
    pub file: ModelFile,
    /// The question.
    pub question: StateSpace,
    /// How it ended.
    pub status: Status,
    /// Why there is no linear system.
    pub message: Option<String>,
    /// The linear systems, in the order of the instants.
    pub systems: Vec<LinearSystem>,
    /// What to doubt of the model.
    pub warnings: Vec<String>,
}

impl Question for StateSpace {
    type Answer = Linearisation;

    fn answer(&self, file: &ModelFile, control: &Control) -> Result<Linearisation, Unanswered> {
        if let Some([from, to]) = self.frequencies
            && !(0.0 < from && from < to && to.is_finite())
        {
            return Err(Unanswered::question(format!(
                "frequencies {from} to {to}: they go from a number above 0 to a larger one"
            )));
        }
        let question = StateSpaceQuestion {
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            pose: self.pose,
            at: self.at.clone(),
        };
        let (status, message, systems) = match state_space(file.model(), &question, control) {
            Ok(systems) => (Status::Completed, None, systems),
            Err(NoLinearSystem::Model(complaints)) => return Err(file.refused(complaints)),
            Err(NoLinearSystem::Question(why)) => return Err(Unanswered::question(why)),
            Err(NoLinearSystem::Failed { status, message }) => (status, Some(message), Vec::new()),
        };
        Ok(Linearisation {
            file: file.clone(),
            question: self.clone(),
            status,
            message,
            systems,
            warnings: file.loaded.warnings.clone(),
        })
    }
}

/// G(i ω) of one frequency after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct FrequencyResponse {
    /// \[Hz\]
    pub frequencies: Vec<f64>,
    /// By frequency, the entries of G by rows: real and imaginary part; empty at a pole.
    pub values: Vec<Vec<[f64; 2]>>,
}

impl Linearisation {
    /// The range of frequencies of a response \[Hz\].
    fn range(&self) -> [f64; 2] {
        if let Some(range) = self.question.frequencies {
            return range;
        }
        let poles = self.systems.iter().flat_map(|system| &system.poles);
        let sizes = poles
            .map(|[re, im]| re.hypot(*im) / TAU)
            .filter(|size| *size > 0.0);
        let [slow, fast] = sizes.fold([f64::INFINITY, 0.0], |[slow, fast], size| {
            [f64::min(slow, size), f64::max(fast, size)]
        });
        match slow <= fast {
            true => [slow / BESIDE, fast * BESIDE],
            false => [1.0 / DECADE, DECADE],
        }
    }

    /// G(i ω) of a system over the range.
    pub fn frequency_response(&self, system: &LinearSystem) -> FrequencyResponse {
        let [from, to] = self.range();
        let place = |k: usize| from * (to / from).powf(k as f64 / (POINTS - 1) as f64);
        let mut frequencies: Vec<f64> = (0..POINTS).map(place).collect();
        for [re, im] in &system.poles {
            // Equal parts of the circle that the response goes through there.
            let (centre, width) = (im / TAU, re.abs().max(1e-6 * im) / TAU);
            let near = (-44..=44).map(|k| centre + width * (2.0 * f64::from(k)).to_radians().tan());
            frequencies.extend(near.filter(|f| (from..=to).contains(f)));
        }
        frequencies.sort_by(f64::total_cmp);
        frequencies.dedup();
        let [a, b, c, d] = [&system.a, &system.b, &system.c, &system.d].map(|rows| rows.concat());
        let size = [
            system.states.len(),
            system.inputs.len(),
            system.outputs.len(),
        ];
        let values = frequencies.iter().map(|frequency| {
            response([&a, &b, &c, &d], size, [0.0, TAU * frequency]).unwrap_or_default()
        });
        FrequencyResponse {
            values: values.collect(),
            frequencies,
        }
    }

    /// What it is about, in words.
    fn about(&self, system: &LinearSystem) -> String {
        match system.time {
            Some(time) => format!("the motion at {time} s"),
            None if self.question.pose => "the assembled position".into(),
            None => "the equilibrium".into(),
        }
    }
}

#[derive(Serialize)]
struct VariableJson<'a> {
    name: &'a str,
    unit: &'a str,
    value: f64,
}

impl<'a> From<&'a Variable> for VariableJson<'a> {
    fn from(own: &'a Variable) -> Self {
        VariableJson {
            name: &own.name,
            unit: &own.unit,
            value: own.value,
        }
    }
}

#[derive(Serialize)]
struct PoleJson {
    re: f64,
    im: f64,
    frequency: f64,
    damping_ratio: Option<f64>,
}

#[derive(Serialize)]
struct Errors {
    #[serde(rename = "A")]
    a: f64,
    #[serde(rename = "B")]
    b: f64,
    #[serde(rename = "C")]
    c: f64,
    #[serde(rename = "D")]
    d: f64,
}

#[derive(Serialize)]
struct SystemJson<'a> {
    time: Option<f64>,
    equilibrium: Option<Value>,
    phases: &'a [String],
    states: Vec<VariableJson<'a>>,
    inputs: Vec<VariableJson<'a>>,
    outputs: Vec<VariableJson<'a>>,
    rates: &'a [f64],
    #[serde(rename = "A")]
    a: &'a [Vec<f64>],
    #[serde(rename = "B")]
    b: &'a [Vec<f64>],
    #[serde(rename = "C")]
    c: &'a [Vec<f64>],
    #[serde(rename = "D")]
    d: &'a [Vec<f64>],
    errors: Errors,
    poles: Vec<PoleJson>,
    gain: Option<&'a [Vec<f64>]>,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct Document<'a> {
    status: &'a str,
    message: Option<&'a str>,
    engine: &'a str,
    model: Subject<'a>,
    about: &'a str,
    systems: Vec<SystemJson<'a>>,
    warnings: &'a [String],
}

impl<'a> From<&'a LinearSystem> for SystemJson<'a> {
    fn from(own: &'a LinearSystem) -> Self {
        let all = |variables: &'a [Variable]| variables.iter().map(VariableJson::from).collect();
        let pole = |[re, im]: &[f64; 2]| {
            let size = re.hypot(*im);
            PoleJson {
                re: *re,
                im: *im,
                frequency: size / TAU,
                damping_ratio: (size > 0.0).then(|| 0.0 - re / size),
            }
        };
        let [a, b, c, d] = own.errors;
        SystemJson {
            time: own.time,
            equilibrium: own.equilibrium.as_ref().map(summary::equilibrium),
            phases: &own.phases,
            states: all(&own.states),
            inputs: all(&own.inputs),
            outputs: all(&own.outputs),
            rates: &own.rates,
            a: &own.a,
            b: &own.b,
            c: &own.c,
            d: &own.d,
            errors: Errors { a, b, c, d },
            poles: own.poles.iter().map(pole).collect(),
            gain: own.gain.as_deref(),
            warnings: &own.warnings,
        }
    }
}

/// `state-space.json`.
impl Serialize for Linearisation {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let about = match (self.question.at.is_empty(), self.question.pose) {
            (false, _) => "motion",
            (true, true) => "pose",
            (true, false) => "equilibrium",
        };
        let document = Document {
            status: self.status.word(),
            message: self.message.as_deref(),
            engine: ENGINE,
            model: self.file.subject(),
            about,
            systems: self.systems.iter().map(SystemJson::from).collect(),
            warnings: &self.warnings,
        };
        document.serialize(serializer)
    }
}
