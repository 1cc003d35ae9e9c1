//! Numbers that are too large or too small to be computed with.

use crate::system::{Block, DriverData, DriverRole, Evaluation, Inputs, Origin, System};
use linkdyn_model::error::Complaint;

/// Lengths up to which squares, and what is made of them, do not overflow \[m\]; as large angles may be \[rad\], and what a
/// coordinate changes a residual by, each measured by its scale.
const LONGEST: f64 = 1e60;

/// Lengths down to which squares, and what is made of them, do not vanish \[m\].
const SHORTEST: f64 = 1e-60;

/// Complains of what can't be computed with.
pub(super) fn beyond_numbers(system: &System, inputs: &Inputs) -> Option<Complaint> {
    too_long(system)
        .or_else(|| too_short(system))
        .or_else(|| no_length(system, inputs))
        .or_else(|| too_far(system, inputs))
        .or_else(|| too_steep(system, &system.guess, inputs))
}

/// Complains of lengths of which the squares overflow.
fn too_long(system: &System) -> Option<Complaint> {
    let mut lengths = system.guess.iter().chain([&system.size, &system.reach]);
    let is_far = lengths.any(|x| x.is_nan() || x.abs() > LONGEST);
    is_far.then(|| {
        Complaint::new(
            "bodies",
            format!(
                "the mechanism is larger than {}, where numbers overflow",
                system.display.length(LONGEST)
            ),
        )
        .hint("look for a length with a wrong exponent or unit")
    })
}

/// Complains of a mechanism, or the clearance of a contact, of which the squares vanish.
pub fn too_short(system: &System) -> Option<Complaint> {
    let complaint = |path: String, what: &str| {
        let shortest = system.display.length(SHORTEST);
        Complaint::new(
            path,
            format!("{what} is smaller than {shortest}, where squares of numbers vanish"),
        )
        .hint("look for a length with a wrong exponent or unit")
    };
    if system.size < SHORTEST {
        return Some(complaint("bodies".to_owned(), "the mechanism"));
    }
    let joint = system.joints.iter().find(|joint| {
        joint
            .extras()
            .contact
            .is_some_and(|id| system.contacts[id.0].size() < SHORTEST)
    })?;
    let path = format!("joints.{}.clearance.radius", joint.name);
    Some(complaint(path, "the radial clearance"))
}

/// Complains of a driven length that no two points have.
fn no_length(system: &System, inputs: &Inputs) -> Option<Complaint> {
    let mut drivers = system.drivers.iter().zip(&inputs.drive);
    let is_none = |driver: &DriverData, value: f64| {
        matches!(driver.role, DriverRole::Length { .. }) && value <= 0.0
    };
    let (driver, value) = drivers.find(|(driver, value)| is_none(driver, value[0]))?;
    let length = system.display.length(value[0]);
    let path = format!("drivers.{}.motion", driver.name);
    let message = format!(
        "the length begins at {length}, and points that are driven apart have a distance above 0"
    );
    let hint = "a driven length is the whole distance of its points, not the stroke";
    Some(Complaint::new(path, message).hint(hint))
}

/// Complains of a joint, driver or initial value that is further from the drawing than can be computed with.
fn too_far(system: &System, inputs: &Inputs) -> Option<Complaint> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(&system.guess);
    let at = evaluation.kinematics(inputs);
    let is_far = |block: &&Block| {
        let mut phi = vec![0.0; block.rows().len()];
        block.constraint.position(&at, &mut phi);
        phi.iter().any(|x| x.is_nan() || x.abs() > LONGEST)
    };
    let block = system.blocks.iter().chain(&system.initial).find(is_far)?;
    Some(
        Complaint::new(
            path(system, block),
            format!("it wants bodies further than {LONGEST:e} m or rad from the drawing, where numbers overflow"),
        )
        .hint("look for an angle or a length with a wrong exponent or unit"),
    )
}

/// Complains of a joint that moves its bodies at `q` by more than can be computed with: of a gear ratio.
pub(super) fn too_steep(system: &System, q: &[f64], inputs: &Inputs) -> Option<Complaint> {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    evaluation.eval_jacobian(system, inputs);
    let is_steep = |block: &&Block| {
        let entries = block.entries();
        entries.into_iter().any(|index| {
            let (entry, value) = (&system.entries[index], evaluation.jacobian[index]);
            entry.column().is_some_and(|column| {
                let scaled = system.scaled_entry(value, entry.row as usize, column as usize);
                scaled.is_nan() || scaled.abs() > LONGEST
            })
        })
    };
    let block = system.blocks.iter().find(is_steep)?;
    Some(
        Complaint::new(
            path(system, block),
            format!("it moves one body by more than {LONGEST:e} times as much as another, where numbers overflow"),
        )
        .hint("look for a ratio or a length with a wrong exponent or unit"),
    )
}

/// Where the model says what a block holds.
fn path(system: &System, block: &Block) -> String {
    match &block.origin {
        Origin::Joint(id) => format!("joints.{}", system.joints[id.0].name),
        Origin::Driver(id) => format!("drivers.{}", system.drivers[id.0].name),
        Origin::Stop(id) => format!("{}.limits", system.owner_path(*id)),
        Origin::Initial(name) => format!("initial.{name}"),
    }
}
