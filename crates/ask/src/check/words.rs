//! What a model says of its own study and optimisation, in words.

use linkdyn_model::Loaded;
use linkdyn_model::optimise::{Optimise, Range};
use linkdyn_model::study::{SampleIndices, SampleMethod, Study};

use crate::text::count;
use crate::text::responses::value;

/// What a model varies, a row each.
pub fn study(study: &Study) -> Vec<String> {
    let bare = |path: &str| path.strip_prefix("parameters.").unwrap_or(path).to_owned();
    let axes = study.vary.iter();
    let mut rows: Vec<String> = axes
        .map(|(name, values)| format!("{} over {values}", bare(name)))
        .collect();
    if let Some(samples) = study.samples {
        let how = match study.method {
            SampleMethod::Random => "random",
            SampleMethod::Latin => "a Latin hypercube",
            SampleMethod::Sobol => "Sobol points",
        };
        let indices = match study.indices {
            SampleIndices::None => "",
            SampleIndices::Sobol => ", for Sobol indices",
        };
        rows.push(format!("{samples} samples ({how}{indices})"));
    }
    rows
}

/// What a model looks for, a row each.
pub fn optimise(asked: &Optimise, loaded: &Loaded) -> Vec<String> {
    let mut rows = Vec::new();
    for (name, range) in &asked.design {
        let parameter = loaded.parameters.iter().find(|own| own.name == *name);
        let unit = parameter.map_or("", |own| own.unit.as_str());
        rows.push(match range {
            Range::Within([lower, upper]) => {
                let ends = [lower, upper].map(|end| value(*end, unit, &loaded.model.display));
                format!("{name} within {} … {}", ends[0], ends[1])
            }
            Range::Free(_) => format!("{name} around its value"),
        });
    }
    if let Some(objective) = &asked.objective {
        let least = objective.minimise.as_ref();
        let most = objective.maximise.as_ref();
        let least = least.map(|own| format!("least {}", own.text));
        rows.extend(least.or(most.map(|own| format!("greatest {}", own.text))));
    }
    if let Some(curve) = &asked.curve {
        let points = count(curve.through.len(), "point");
        rows.push(format!("{} through {points}", curve.point));
    }
    rows.extend(asked.constraints.iter().map(|one| one.text.clone()));
    rows
}
