//! Drivers as inputs of a unit: let go, with their torque or force from outside, or led by an acceleration.

use crate::cli::exit::{BadInput, Failure};
use crate::cli::open::ModelOptions;
use crate::mechanism::Mechanism;
use linkdyn_ask::ModelFile;
use linkdyn_ask::near::did_you_mean;

/// The model with drivers let go, and names of the drivers that are led.
///
/// # Errors
/// Names that are none of a driver, and drivers that can't be let go.
pub fn given(
    file: ModelFile,
    inputs: &[String],
    model: &ModelOptions,
) -> Result<(Mechanism, Vec<String>), Failure> {
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
    let mechanism = Mechanism::of_file(file).map_err(|why| model.refuse(why))?;
    if released.is_empty() {
        return Ok((mechanism, steered));
    }
    let names: Vec<&str> = released.iter().map(String::as_str).collect();
    let released = mechanism.release(&names);
    Ok((released.map_err(|why| model.refuse(why))?, steered))
}
