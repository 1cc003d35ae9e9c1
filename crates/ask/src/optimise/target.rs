//! What is looked for, as the search takes it.

use linkdyn_engine::analysis::Prepared;
use linkdyn_model::optimise::{Curve, Optimise, Range, Relation};
use linkdyn_model::{Parameter, PointRef};

use crate::scatter::distribution;
use crate::{ModelFile, Unanswered};

/// What names of responses begin with that the search adds.
pub const OWN: &str = "number of the search ";

/// Starts where nobody says how many.
const STARTS: u64 = 8;
/// Seed where nobody says one.
const SEED: u64 = 1;

/// A parameter that may change.
#[derive(Debug, Clone)]
pub struct Variable {
    pub parameter: Parameter,
    /// Lower and upper bound [SI]; none: around its value.
    pub range: Option<[f64; 2]>,
}

/// What is to be least or greatest.
#[derive(Debug, Clone)]
pub struct Aimed {
    pub text: String,
    /// −1 where it is to be greatest.
    pub sign: f64,
    /// SI unit; empty of a plain number.
    pub unit: String,
}

/// What must hold.
#[derive(Debug, Clone)]
pub struct Compared {
    pub text: String,
    pub relation: Relation,
    /// SI unit of both sides.
    pub unit: String,
}

/// How many standard deviations count, and what scatters.
#[derive(Debug, Clone)]
pub struct Robust {
    pub sigmas: f64,
    /// Parameters with their standard deviations [SI].
    pub scatter: Vec<(String, f64)>,
}

/// A response of the model.
#[derive(Debug, Clone)]
pub struct Told {
    pub name: String,
    /// SI unit; empty of a plain number.
    pub unit: String,
    /// The unit in which it is shown, with its size in SI.
    pub shown: Option<(String, f64)>,
}

/// Which kind of search it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// One parameter and one equation.
    Goal,
    /// Equations, as near as possible.
    Goals,
    /// An objective, with or without constraints.
    Objective,
    /// A curve alone.
    Curve,
    /// A curve, with constraints.
    ConstrainedCurve,
}

/// What is looked for.
#[derive(Debug, Clone)]
pub struct Target {
    pub aim: Aim,
    pub variables: Vec<Variable>,
    pub objective: Option<Aimed>,
    pub constraints: Vec<Compared>,
    pub curve: Option<Curve>,
    pub robust: Option<Robust>,
    pub starts: u64,
    pub seed: u64,
    /// The model's own responses.
    pub responses: Vec<Told>,
}

/// The name of the number that an expression of the search gives.
fn hidden(number: usize) -> String {
    format!("{OWN}{number}")
}

impl Target {
    /// Reads the question of a model; the model again, with a response for each number that the search needs, in their order before
    /// those of the model.
    ///
    /// # Errors
    /// What an analysis of the model has no place for.
    pub fn new(file: &ModelFile) -> Result<(Target, ModelFile), Unanswered> {
        let default = Optimise::default();
        let asked = file.model().optimise.as_ref().unwrap_or(&default);
        let mut expressions: Vec<&str> = Vec::new();
        let sought = asked.objective.as_ref().and_then(|objective| {
            let least = objective.minimise.as_ref().map(|sought| (sought, 1.0));
            least.or(objective.maximise.as_ref().map(|sought| (sought, -1.0)))
        });
        expressions.extend(sought.map(|(sought, _)| sought.value.as_str()));
        for constraint in &asked.constraints {
            expressions.extend([constraint.left.as_str(), constraint.right.as_str()]);
        }
        let numbered = expressions.iter().enumerate();
        let numbered =
            numbered.map(|(number, text)| format!("responses.{}={text}", hidden(number)));
        let mut sets: Vec<String> = numbered.collect();
        // What is looked for is known: variants need not read it again.
        sets.push("optimise=null".to_owned());
        if file.model().study.is_some() {
            sets.push("study=null".to_owned());
        }
        let with = file.with(&sets).map_err(|said| file.refused(said))?;
        let prepared = Prepared::new(with.model()).map_err(|said| with.refused(said))?;
        let list = prepared.responses().list();
        let unit = |number: usize| {
            let name = hidden(number);
            let found = list.iter().find(|one| one.name == name);
            found.map_or_else(String::new, |one| one.unit.clone())
        };
        let first = usize::from(sought.is_some());
        let constraints = asked.constraints.iter().enumerate();
        let own = list.iter().filter(|one| !one.name.starts_with(OWN));
        let target = Target {
            aim: aim(asked),
            variables: variables(asked, file),
            objective: sought.map(|(sought, sign)| Aimed {
                text: sought.text.clone(),
                sign,
                unit: unit(0),
            }),
            constraints: constraints
                .map(|(k, one)| Compared {
                    text: one.text.clone(),
                    relation: one.relation,
                    unit: unit(first + 2 * k),
                })
                .collect(),
            curve: asked.curve.clone(),
            robust: asked
                .robust
                .map(|sigmas| robust(sigmas, file))
                .transpose()?,
            starts: asked.starts.unwrap_or(STARTS),
            seed: asked.seed.unwrap_or(SEED),
            responses: own
                .map(|one| Told {
                    name: one.name.clone(),
                    unit: one.unit.clone(),
                    shown: one.shown.clone(),
                })
                .collect(),
        };
        target.check()?;
        Ok((target, with))
    }

    /// How many numbers the search needs of a run.
    pub fn numbers(&self) -> usize {
        usize::from(self.objective.is_some()) + 2 * self.constraints.len()
    }

    /// The point whose curve is looked for.
    pub fn point(&self) -> Option<&PointRef> {
        self.curve.as_ref().map(|curve| &curve.point)
    }

    /// What belongs together but is known only now.
    fn check(&self) -> Result<(), Unanswered> {
        let follows = |own: &&Variable| own.parameter.text.trim_start().starts_with('=');
        if self.robust.is_some()
            && let Some(variable) = self.variables.iter().find(follows)
        {
            return Err(Unanswered::question(format!(
                "--vary parameters.{}: it follows from others, and can't change where tolerances count, too",
                variable.parameter.name
            )));
        }
        Ok(())
    }
}

fn aim(asked: &Optimise) -> Aim {
    match (&asked.objective, &asked.curve) {
        (Some(_), _) => Aim::Objective,
        (None, Some(_)) if asked.constraints.is_empty() => Aim::Curve,
        (None, Some(_)) => Aim::ConstrainedCurve,
        (None, None) if asked.goal().is_some() => Aim::Goal,
        (None, None) => Aim::Goals,
    }
}

fn variables(asked: &Optimise, file: &ModelFile) -> Vec<Variable> {
    let parameters = &file.loaded.parameters;
    let all = asked.design.iter().filter_map(|(name, range)| {
        let parameter = parameters.iter().find(|own| own.name == *name)?.clone();
        let range = match range {
            Range::Within(range) => Some(*range),
            Range::Free(_) => None,
        };
        Some(Variable { parameter, range })
    });
    all.collect()
}

/// What scatters by its tolerance.
fn robust(sigmas: f64, file: &ModelFile) -> Result<Robust, Unanswered> {
    let mut scatter = Vec::new();
    for parameter in &file.loaded.parameters {
        let Some(by) = &parameter.tolerance else {
            continue;
        };
        if by.lower == 0.0 && by.upper == 0.0 {
            continue;
        }
        let (distribution, _) = distribution(&parameter.name, by)?;
        scatter.push((parameter.name.clone(), distribution.deviation()));
    }
    if scatter.is_empty() {
        return Err(Unanswered::question(format!(
            "{}: no parameter has a tolerance, so that nothing scatters; as in \"rod\": {{ \"value\": \"200 mm\", \"tolerance\": \"0.1 mm\" }}",
            file.label()
        )));
    }
    Ok(Robust { sigmas, scatter })
}
