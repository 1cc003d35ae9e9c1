//! The responses of a study: those of the model, and those of the command, which are put into it.

use super::super::exit::{BadInput, Failure};
use super::super::open::Opened;
use super::asked::Asked as Inputs;
use super::head::Asked;
use linkdyn_engine::analysis::Family;
use linkdyn_study::summary::Limits;

/// Whether there are any.
///
/// # Errors
/// A model without responses.
pub fn wanted(opened: &Opened) -> Result<(), Failure> {
    if opened.loaded.model.responses.is_empty() {
        return Err(BadInput(vec![format!(
            "{}: it has no responses, which a study asks for: add --response \"stroke = max(piston.x) - min(piston.x)\", or \"responses\" to the model",
            opened.label
        )]));
    }
    Ok(())
}

/// A model with the inputs of a study.
///
/// # Errors
/// An analysis that can't be run, names that it does not have.
pub fn family(opened: &Opened, inputs: &Inputs) -> Result<Family, Failure> {
    let family = Family::new(&opened.loaded, &inputs.parameters(), inputs.given());
    family.map_err(|complaints| opened.bad_input(complaints))
}

/// What is told of its responses.
pub fn asked(family: &Family) -> Vec<Asked> {
    let list = family.responses().list().iter();
    let asked = list.map(|own| Asked {
        name: own.name.clone(),
        unit: own.unit.clone(),
        value: own.text.clone(),
        limits: own
            .limits
            .map_or_else(Limits::default, |[lower, upper]| Limits {
                lower: Some(lower),
                upper: Some(upper),
            }),
    });
    asked.collect()
}
