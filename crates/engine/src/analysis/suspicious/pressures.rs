//! Pressures that act against nothing: what a gas does to a piston it does to the head of the cylinder, too.

use linkdyn_model::error::Complaint;
use linkdyn_model::formula::{Argument, Coordinate, Order};
use linkdyn_model::response::Catalogue;
use linkdyn_model::{
    Dimension, DriverKind, Force, ForceKind, Formula, JointKind, Model, Unit, Value,
};

/// Exponents of length, mass, time and angle of a pressure.
const PRESSURE: [f64; 4] = [-1.0, 1.0, -2.0, 0.0];

/// Forces on sliders that look like pressures: with a pressure in their formula, or looked up over an angle.
pub fn pressures(model: &Model) -> Vec<Complaint> {
    let mut found = Vec::new();
    let catalogue = Catalogue::of(model);
    for (name, force) in &model.forces {
        let ForceKind::Load { at, vector, .. } = &force.kind else {
            continue;
        };
        let Some(frame) = frame_of(model, &at.body) else {
            continue;
        };
        let acts_there =
            |other: &Force| matches!(&other.kind, ForceKind::Load { at, .. } if at.body == frame);
        if model.forces.values().any(acts_there) {
            continue;
        }
        let is_pressure = |value: &Value| match value {
            Value::Formula(formula) => is_pressure(model, &catalogue, formula),
            Value::Constant(_) | Value::Motion(_) => false,
        };
        if vector.iter().any(is_pressure) {
            let message = format!(
                "this looks like a pressure on {:?}, which slides in {frame:?}, and acts on {frame:?} with nothing: shaking \
                 forces lack it there",
                at.body
            );
            let hint = format!(
                "an actuator pushes both apart: \"type\": \"actuator\", \"between\": [\"{frame}.HEAD\", \"{at}\"], \"force\": …, \
                 with a point HEAD at the end of the cylinder"
            );
            found.push(Complaint::new(format!("forces.{name}.vector"), message).hint(hint));
        }
    }
    found
}

/// In what a body slides.
fn frame_of<'m>(model: &'m Model, slider: &str) -> Option<&'m str> {
    let mut guides = model.joints.values();
    guides.find_map(|joint| {
        let is_guide = matches!(joint.kind, JointKind::Prismatic { .. });
        let [first, second] = &joint.between;
        match [first.body == slider, second.body == slider] {
            [false, true] if is_guide => Some(first.body.as_str()),
            [true, false] if is_guide => Some(second.body.as_str()),
            [_, _] => None,
        }
    })
}

fn is_pressure(model: &Model, catalogue: &Catalogue, formula: &Formula) -> bool {
    let Ok(compiled) = formula.compile(catalogue) else {
        return false;
    };
    let of_pressure = |unit: &str| {
        let unit = Unit::parse(unit);
        unit.is_ok_and(|unit| unit.powers == Dimension::Stress.powers())
    };
    let words = || {
        let text = formula.formula.as_str();
        text.split(|c: char| !c.is_alphanumeric() && c != '_')
    };
    let tables = || words().filter_map(|word| model.tables.get(word));
    let parameters = || words().filter_map(|word| formula.parameters.get(word));
    if words().any(of_pressure)
        || tables().any(|table| of_pressure(&table.units[1]))
        || parameters().any(|one| one.powers == PRESSURE)
    {
        return true;
    }
    let is_looked_up =
        formula.table.is_some() || tables().next().is_some() || words().any(|word| word == "table");
    let is_angle = |argument: &Argument| match argument {
        Argument::Body(_, Coordinate::Angle, Order::Value) | Argument::Turn(_, Order::Value) => {
            true
        }
        Argument::Driver(name) => model
            .drivers
            .get(name)
            .is_some_and(|driver| matches!(driver.kind, DriverKind::Rotation { .. })),
        Argument::Body(..)
        | Argument::Turn(..)
        | Argument::Time
        | Argument::Input(_)
        | Argument::State(_)
        | Argument::Measure(..)
        | Argument::Point(..)
        | Argument::Spring(..)
        | Argument::Slide(..) => false,
    };
    is_looked_up && compiled.arguments.iter().any(is_angle)
}
