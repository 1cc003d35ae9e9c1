//! Units, parameters, ranges and places of the schema.

use serde_json::json;

use super::{Keys, QUANTITY_PATTERN, at, keys, list, note, target};
use crate::dimension::Dimension;
use crate::shape::{Asked, Bound, Measure, Shape};
use crate::words::LENGTH;

/// Name of a parameter.
const PARAMETER_PATTERN: &str = "^[A-Za-z_][A-Za-z0-9_]*$";

/// `"SI"`, or a unit per dimension.
pub fn units() -> Keys {
    let mut properties = Keys::new();
    for dimension in Dimension::NAMED {
        let (name, si) = (dimension.name(), dimension.si());
        let description = format!("Unit of a plain number for {name}, SI: {si}.");
        properties.insert(
            name.into(),
            json!({ "description": description, "type": "string", "x-unit-of": name }),
        );
    }
    properties.insert("note".into(), note());
    let named =
        json!({ "type": "object", "properties": properties, "additionalProperties": false });
    keys(json!({ "anyOf": [{ "const": "SI" }, named] }))
}

/// A number of any dimension.
pub fn value() -> Keys {
    keys(json!({ "type": ["number", "string"], "pattern": QUANTITY_PATTERN }))
}

/// A quantity, or nothing.
pub fn end(quantity: &Keys) -> Keys {
    keys(json!({ "anyOf": [quantity, { "type": "null" }] }))
}

/// Points of a table, with what both entries of each are.
pub fn points(entries: &serde_json::Value) -> Keys {
    let mut point = keys(json!({ "type": "array" }));
    point.extend(keys(entries.clone()));
    point.extend(keys(json!({ "minItems": 2, "maxItems": 2 })));
    keys(json!({ "type": "array", "items": point, "minItems": 2 }))
}

/// The parameters, alone or with tolerances.
pub fn parameters() -> (Keys, Keys) {
    let mut plain = keys(json!({
        "description": "A plain number, text with a unit, or \"=\" and an expression of other parameters."
    }));
    plain.extend(value());
    let value = json!({ "anyOf": [plain, { "$ref": target("Parameter") }] });
    let behind = json!({ "properties": { "note": { "anyOf": [note(), value] } } });
    let all = json!({
        "type": "object", "propertyNames": { "pattern": PARAMETER_PATTERN }, "x-parameters": true,
        "additionalProperties": value
    });
    (keys(all), keys(behind))
}

/// A number, or two of it: the least and the greatest one, or one along each axis.
pub fn range(measure: Measure, bound: Bound) -> Keys {
    let each = Shape::Quantity(measure, bound);
    keys(json!({ "anyOf": [at(&each, None), list(&each, 2, Some(2))] }))
}

/// Two coordinates, or these with a tolerance.
pub fn place() -> Keys {
    keys(json!({ "anyOf": [list(&LENGTH, 2, Some(2)), { "$ref": target("Place") }] }))
}

/// A deviation to either side, or both.
pub fn deviations() -> Keys {
    keys(json!({ "anyOf": [
        value(), { "type": "array", "items": value(), "minItems": 2, "maxItems": 2 }
    ] }))
}

/// The text of a response, alone or with limits.
pub fn response() -> Keys {
    keys(json!({ "anyOf": [{ "type": "string" }, { "$ref": target("Response") }] }))
}

/// What is asked of an optimisation: parameters with their bounds, or text.
pub fn asked(asked: Asked) -> Keys {
    match asked {
        Asked::Design => {}
        Asked::Value | Asked::Constraint => return keys(json!({ "type": "string" })),
    }
    let bounds = json!({ "anyOf": [
        { "type": "array", "items": value(), "minItems": 2, "maxItems": 2 }, { "const": "free" }
    ] });
    keys(json!({
        "type": "object", "propertyNames": { "pattern": PARAMETER_PATTERN },
        "properties": { "note": { "anyOf": [note(), bounds] } },
        "additionalProperties": bounds, "minProperties": 1
    }))
}
