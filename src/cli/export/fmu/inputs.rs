//! Drivers as inputs of a unit: let go, with their torque or force from outside, or led by an acceleration.

use crate::cli::exit::{BadInput, Failure};
use crate::cli::open::{ModelOptions, bad_input};
use linkdyn_ask::ModelFile;
use linkdyn_ask::near::did_you_mean;
use linkdyn_model::analysis::AnalysisKind;

/// The model with drivers let go, and names of the drivers that are led.
///
/// # Errors
/// Names that are none of a driver, and drivers that can't be let go.
pub fn given(
    file: ModelFile,
    inputs: &[String],
    model: &ModelOptions,
) -> Result<(ModelFile, Vec<String>), Failure> {
    let (mut released, mut steered) = (Vec::new(), Vec::new());
    let drivers = &file.model().drivers;
    let mut faults = Vec::new();
    for input in inputs {
        let parts: Vec<&str> = input.split('.').collect();
        let list = match parts[..] {
            ["driver", _, "effort"] => &mut released,
            ["driver", _, "acceleration"] => &mut steered,
            _ => {
                faults.push(format!(
                    "--input {input}: not driver.NAME.effort or driver.NAME.acceleration (other inputs are written into the model: \
                     \"inputs\": {{ \"torque\": \"0 N*m\" }})"
                ));
                continue;
            }
        };
        let name = parts[1];
        if !drivers.contains_key(name) {
            let hint = did_you_mean(
                name,
                drivers.keys().map(String::as_str),
                "the model has none",
            );
            faults.push(format!(
                "--input {input}: there is no driver {name:?} ({hint})"
            ));
        } else if !list.iter().any(|known| known == name) {
            list.push(name.to_owned());
        }
    }
    let both = released.iter().filter(|name| steered.contains(name));
    faults.extend(both.map(|name| {
        format!("--input driver.{name}.acceleration: the driver is let go by --input driver.{name}.effort (give one of them)")
    }));
    if !faults.is_empty() {
        return Err(BadInput(faults));
    }
    if released.is_empty() {
        return Ok((file, steered));
    }
    let refuse = |complaints| bad_input(&model.label(), complaints);
    let before = file.model().clone();
    let mut after = before.clone();
    let mut sets = Vec::new();
    for name in &released {
        after = after.release(name).map_err(refuse)?;
        sets.push(format!("drivers.{name}=null"));
    }
    let json = after.to_json();
    let new_inputs = after
        .inputs
        .keys()
        .filter(|name| !before.inputs.contains_key(*name));
    sets.extend(new_inputs.map(|name| format!("inputs.{name}={}", json["inputs"][name])));
    let new_forces = after
        .forces
        .keys()
        .filter(|name| !before.forces.contains_key(*name));
    sets.extend(new_forces.map(|name| format!("forces.{name}={}", json["forces"][name])));
    let kind = before.analysis.as_ref().map(|analysis| analysis.kind);
    if kind != Some(AnalysisKind::Dynamics) {
        sets.push("analysis.type=dynamics".into());
    }
    Ok((file.set(sets).map_err(refuse)?, steered))
}
