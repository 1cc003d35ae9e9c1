//! The JSON Schema of a model file, from the types of this module.
//!
//! Beyond the standard keywords, which any editor understands, our own loader reads
//!
//! | keyword       | at                | says                                                                   |
//! | ------------- | ----------------- | ---------------------------------------------------------------------- |
//! | `x-dimension` | number or text    | dimension of the quantity; `driven …`: that of the enclosing `x-driven` |
//! | `x-driven`    | object            | dimension of what a motion inside drives                               |
//! | `x-unit-of`   | text              | the dimension that this names a unit for                               |
//! | `x-reference` | text              | names a `point`, `body`, `joint` or `driver` of the model              |
//! | `x-plain`     | number or text    | a number without unit, `number` or `integer`                           |
//! | `x-linear`    | plain number      | `x-dimension` of it where the `law` beside it is `kelvin_voigt`        |
//! | `x-parameters` | object           | the parameters, which are read before everything else                  |
//! | `x-refused`   | object            | keys that have a reason of their own for not being allowed             |

use std::sync::LazyLock;

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use super::body::{Body, Ground};
use super::dimension::Dimension;
use super::driver::Motion;
use super::{Model, NAME_PATTERN};

/// Text with a unit, or an expression.
const QUANTITY_PATTERN: &str =
    r"^\s*(=|[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?(\s*[^\s0-9.=+\-eE]|\s+1\s*/))";

/// An expression.
const EXPRESSION_PATTERN: &str = r"^\s*=";

/// Name of a parameter.
const PARAMETER_PATTERN: &str = "^[A-Za-z_][A-Za-z0-9_]*$";

/// The whole file: what the loader consumes, and the model.
#[derive(JsonSchema)]
#[schemars(title = "linkdyn/1")]
#[expect(dead_code, reason = "only its schema is wanted")]
struct File {
    /// The format of the file.
    format: Format,
    /// `"SI"`, or another unit per dimension; SI for the rest. Each dimension stands alone.
    #[schemars(schema_with = "units")]
    units: (),
    /// Numbers with a name, for use in expressions.
    #[serde(default)]
    #[schemars(schema_with = "parameters")]
    parameters: (),
    #[serde(flatten)]
    model: Model,
}

/// Formats that this version reads.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "only its schema is wanted")]
enum Format {
    #[schemars(rename = "linkdyn/1")]
    One,
}

/// The JSON Schema (draft 2020-12) of a model file.
pub fn schema() -> Value {
    SCHEMA.clone()
}

/// The same, made once.
pub(super) static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let generator = SchemaSettings::draft2020_12().into_generator();
    let mut schema = generator.into_root_schema_for::<File>().to_value();
    close(&mut schema);
    schema
});

/// Makes every object closed (its keys, `note`, nothing else), tagged unions flat, and drops nulls.
fn close(schema: &mut Value) {
    match schema {
        Value::Array(items) => items.iter_mut().for_each(close),
        Value::Object(object) => {
            if object.contains_key("properties") && is_tagged(object) {
                distribute(object);
            }
            object.values_mut().for_each(close);
            if object.get("default") == Some(&Value::Null) {
                object.remove("default");
            }
            allow_expression(object);
            close_object(object);
        }
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

/// Whether `oneOf` lists objects told apart by `type`.
fn is_tagged(object: &Map<String, Value>) -> bool {
    object
        .get("oneOf")
        .and_then(Value::as_array)
        .is_some_and(|variants| {
            variants
                .iter()
                .all(|variant| variant.pointer("/properties/type/const").is_some())
        })
}

/// Moves the keys that all variants share into each of them.
fn distribute(object: &mut Map<String, Value>) {
    let shared = object.remove("properties");
    let required = object.remove("required");
    object.remove("type");
    for variant in object
        .get_mut("oneOf")
        .and_then(Value::as_array_mut)
        .into_iter()
        .flatten()
    {
        if let (Some(Value::Object(own)), Some(Value::Object(shared))) =
            (variant.get_mut("properties"), &shared)
        {
            own.extend(shared.clone());
        }
        if let (Some(Value::Array(own)), Some(Value::Array(required))) =
            (variant.get_mut("required"), &required)
        {
            own.extend(required.clone());
        }
    }
}

/// Where a plain number may stand, so may an expression.
fn allow_expression(object: &mut Map<String, Value>) {
    if let Some(plain @ ("number" | "integer")) = object.get("type").and_then(Value::as_str) {
        let plain = plain.to_owned();
        object.insert("type".into(), json!([plain, "string"]));
        object.insert("pattern".into(), json!(EXPRESSION_PATTERN));
        object.insert("x-plain".into(), json!(plain));
    }
}

/// Adds `note`, and forbids what is not listed; names of maps must be names.
fn close_object(object: &mut Map<String, Value>) {
    if object.get("type") != Some(&json!("object")) {
        return;
    }
    let note = json!({ "description": "A remark, for whoever reads the file.", "type": "string" });
    if let Some(additional) = object
        .get("additionalProperties")
        .filter(|value| value.is_object())
        .cloned()
    {
        object
            .entry("propertyNames")
            .or_insert_with(|| json!({ "pattern": NAME_PATTERN }));
        let properties = object.entry("properties").or_insert_with(|| json!({}));
        properties["note"] = json!({ "anyOf": [note, additional] });
    } else if let Some(properties) = object.get_mut("properties") {
        properties["note"] = note;
        object.insert("additionalProperties".into(), json!(false));
    }
}

fn quantity(dimension: &str) -> Schema {
    json_schema!({ "type": ["number", "string"], "pattern": QUANTITY_PATTERN, "x-dimension": dimension })
}

fn pair(items: Schema) -> Schema {
    json_schema!({ "type": "array", "items": items, "minItems": 2, "maxItems": 2 })
}

fn or_motion(generator: &mut SchemaGenerator, dimension: Dimension) -> Schema {
    let motion = generator.subschema_for::<Motion>();
    json_schema!({ "anyOf": [quantity(dimension.name()), motion], "x-driven": dimension.name() })
}

fn units(_: &mut SchemaGenerator) -> Schema {
    let mut properties = Map::new();
    for dimension in Dimension::NAMED {
        let description = format!(
            "Unit of a plain number for {}, SI: {}.",
            dimension.name(),
            dimension.si()
        );
        properties.insert(
            dimension.name().into(),
            json!({ "description": description, "type": "string", "x-unit-of": dimension.name() }),
        );
    }
    json_schema!({ "anyOf": [{ "const": "SI" }, { "type": "object", "properties": properties }] })
}

fn parameters(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": "object", "propertyNames": { "pattern": PARAMETER_PATTERN }, "x-parameters": true,
        "additionalProperties": {
            "description": "A plain number, text with a unit, or \"=\" and an expression of other parameters.",
            "type": ["number", "string"], "pattern": QUANTITY_PATTERN
        }
    })
}

/// `bodies`: `ground` is one of its own kind.
pub(super) fn bodies(generator: &mut SchemaGenerator) -> Schema {
    let (ground, body) = (
        generator.subschema_for::<Ground>(),
        generator.subschema_for::<Body>(),
    );
    json_schema!({ "type": "object", "properties": { "ground": ground }, "additionalProperties": body, "minProperties": 1 })
}

/// A plain number.
pub(super) fn number(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "number" })
}

/// A plain number; where the law is linear it has a unit, which text may name.
pub(super) fn contact_stiffness(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": ["number", "string"], "pattern": QUANTITY_PATTERN, "x-plain": "number", "x-linear": "linear stiffness" })
}

/// A whole number.
pub(super) fn count(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "integer" })
}

pub(super) fn length(_: &mut SchemaGenerator) -> Schema {
    quantity("length")
}

pub(super) fn angle(_: &mut SchemaGenerator) -> Schema {
    quantity("angle")
}

pub(super) fn mass(_: &mut SchemaGenerator) -> Schema {
    quantity("mass")
}

pub(super) fn inertia(_: &mut SchemaGenerator) -> Schema {
    quantity("inertia")
}

pub(super) fn stiffness(_: &mut SchemaGenerator) -> Schema {
    quantity("stiffness")
}

pub(super) fn damping(_: &mut SchemaGenerator) -> Schema {
    quantity("damping")
}

pub(super) fn angular_stiffness(_: &mut SchemaGenerator) -> Schema {
    quantity("angular_stiffness")
}

pub(super) fn angular_damping(_: &mut SchemaGenerator) -> Schema {
    quantity("angular_damping")
}

pub(super) fn velocity(_: &mut SchemaGenerator) -> Schema {
    quantity("velocity")
}

pub(super) fn angular_velocity(_: &mut SchemaGenerator) -> Schema {
    quantity("angular_velocity")
}

pub(super) fn time(_: &mut SchemaGenerator) -> Schema {
    quantity("time")
}

pub(super) fn stress(_: &mut SchemaGenerator) -> Schema {
    quantity("stress")
}

pub(super) fn frequency(_: &mut SchemaGenerator) -> Schema {
    quantity("frequency")
}

/// A value of what is driven.
pub(super) fn driven(_: &mut SchemaGenerator) -> Schema {
    quantity("driven")
}

pub(super) fn driven_velocity(_: &mut SchemaGenerator) -> Schema {
    quantity("driven velocity")
}

pub(super) fn driven_acceleration(_: &mut SchemaGenerator) -> Schema {
    quantity("driven acceleration")
}

/// Coefficients of a polynomial: per second to the power of their index.
pub(super) fn driven_coefficients(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "array", "items": quantity("driven coefficient"), "minItems": 1 })
}

/// Points (t, value).
pub(super) fn driven_table(_: &mut SchemaGenerator) -> Schema {
    let point = json_schema!({
        "type": "array", "prefixItems": [quantity("time"), quantity("driven")], "items": false, "minItems": 2, "maxItems": 2
    });
    json_schema!({ "type": "array", "items": point, "minItems": 2 })
}

pub(super) fn length_pair(_: &mut SchemaGenerator) -> Schema {
    pair(quantity("length"))
}

pub(super) fn acceleration_pair(_: &mut SchemaGenerator) -> Schema {
    pair(quantity("acceleration"))
}

/// Named points.
pub(super) fn length_pairs(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "object", "additionalProperties": pair(quantity("length")) })
}

pub(super) fn body_pair(_: &mut SchemaGenerator) -> Schema {
    pair(json_schema!({ "type": "string", "x-reference": "body" }))
}

pub(super) fn length_or_motion(generator: &mut SchemaGenerator) -> Schema {
    or_motion(generator, Dimension::Length)
}

pub(super) fn angle_or_motion(generator: &mut SchemaGenerator) -> Schema {
    or_motion(generator, Dimension::Angle)
}

pub(super) fn torque_or_motion(generator: &mut SchemaGenerator) -> Schema {
    or_motion(generator, Dimension::Torque)
}

pub(super) fn force_or_motion_pair(generator: &mut SchemaGenerator) -> Schema {
    pair(or_motion(generator, Dimension::Force))
}
