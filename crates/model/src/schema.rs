//! The JSON Schema of a model file, printed from the descriptions of its [words](crate::words).
//!
//! Beyond the standard keywords, which any editor understands, it says
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

mod places;

use serde_json::{Map, Value, json};

use crate::NAME_PATTERN;
use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Field, Measure, Named, Need, Object, Shape, Tagged,
};
use crate::words::{self, Definition};

/// Text with a unit, or an expression.
const QUANTITY_PATTERN: &str =
    r"^\s*(=|[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?(\s*[^\s0-9.=+\-eE]|\s+1\s*/))";

/// An expression.
const EXPRESSION_PATTERN: &str = r"^\s*=";

/// Keys of a schema, in the order in which they are printed.
type Keys = Map<String, Value>;

/// The JSON Schema (draft 2020-12) of a model file.
pub fn schema() -> Value {
    let mut file = object(words::file(), None);
    let closed = file.remove("additionalProperties");
    file.insert("title".into(), words::file().name.into());
    file.insert(
        "$schema".into(),
        "https://json-schema.org/draft/2020-12/schema".into(),
    );
    let definitions = words::definitions().map(|(name, one)| (name.to_owned(), definition(one)));
    file.insert("$defs".into(), Value::Object(definitions.collect()));
    file.extend(closed.map(|closed| ("additionalProperties".to_owned(), closed)));
    Value::Object(file)
}

fn definition(definition: Definition) -> Value {
    match definition {
        Definition::Format(about) => {
            json!({ "type": "string", "enum": [crate::FORMAT], "description": about })
        }
        Definition::Point(about) => json!({
            "type": "string", "description": about, "pattern": "^[^.]+\\.[^.]+$", "x-reference": "point"
        }),
        Definition::Materials(about) => {
            let same = json!({ "$ref": target("Material"), "description": "One for both." });
            json!({ "anyOf": [object(words::object("Separate"), None), same], "description": about })
        }
        Definition::Choice(choice) => choices(choice),
        Definition::Object(one) => Value::Object(object(one, None)),
        Definition::Tagged(one) => tagged(one),
    }
}

fn choices(choice: &Choice) -> Value {
    let words = choice
        .words
        .iter()
        .map(|one| json!({ "type": "string", "const": one.word, "description": one.about }));
    json!({ "oneOf": words.collect::<Vec<_>>(), "description": choice.about })
}

fn tagged(tagged: &Tagged) -> Value {
    let variants: Vec<Value> = tagged
        .variants
        .iter()
        .map(|variant| Value::Object(object(variant, Some(variant.name))))
        .collect();
    // The order of the keys is that of the first schema that was published.
    match tagged.name {
        "Driver" => json!({ "description": tagged.about, "oneOf": variants }),
        "Force" => json!({ "type": "object", "oneOf": variants, "description": tagged.about }),
        _ => json!({ "oneOf": variants, "description": tagged.about }),
    }
}

/// An object, closed but for `note`; with its `type` where it is one of several kinds.
fn object(object: &Object, kind: Option<&str>) -> Keys {
    let mut properties = Keys::new();
    properties.extend(kind.map(|kind| ("type".into(), json!({ "type": "string", "const": kind }))));
    for field in &object.fields {
        properties.insert(
            field.key.into(),
            Value::Object(at(&field.shape, Some(field))),
        );
    }
    properties.insert("note".into(), note());
    let required = object
        .fields
        .iter()
        .filter(|field| field.need == Need::Required);
    let required: Vec<&str> = kind
        .map(|_| "type")
        .into_iter()
        .chain(required.map(|field| field.key))
        .collect();
    let mut keys = keys(json!({ "type": "object", "properties": properties }));
    if !required.is_empty() {
        keys.insert("required".into(), json!(required));
    }
    keys.insert("description".into(), object.about.into());
    match object.drives {
        Drives::Nothing => {}
        Drives::Always(dimension) => {
            keys.insert("x-driven".into(), dimension.name().into());
        }
        Drives::Sampled => {
            keys.insert("x-driven".into(), "driver of this sample".into());
        }
        Drives::Posed => {
            keys.insert("x-driven".into(), "driver of this position".into());
        }
        Drives::Measured => {
            keys.insert("x-driven".into(), "column of this output".into());
        }
    }
    if let Some(either) = &object.either {
        let each = either.keys.iter().map(|key| json!({ "required": [key] }));
        let each: Value = each.collect();
        match (either.needed, either.exclusive) {
            (Some(_), false) => keys.insert("anyOf".into(), each),
            (Some(_), true) => keys.insert("oneOf".into(), each),
            (None, _) => keys.insert("not".into(), json!({ "required": either.keys })),
        };
    }
    if !object.refused.is_empty() {
        let refused: Keys = object
            .refused
            .iter()
            .map(|(key, reason)| ((*key).to_owned(), (*reason).into()))
            .collect();
        keys.insert("x-refused".into(), Value::Object(refused));
    }
    keys.insert("additionalProperties".into(), json!(false));
    keys
}

fn keys(value: Value) -> Keys {
    match value {
        Value::Object(keys) => keys,
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) | Value::Array(_) => {
            Keys::new()
        }
    }
}

fn note() -> Value {
    json!({ "description": "A remark, for whoever reads the file.", "type": "string" })
}

fn target(name: &str) -> String {
    format!("#/$defs/{name}")
}

/// What a key says beside its shape: description and default.
fn said(keys: &mut Keys, field: Option<&Field>) {
    let Some(field) = field else { return };
    if !field.about.is_empty() {
        keys.insert("description".into(), field.about.into());
    }
    if let Need::Default(default) = field.need {
        let value = match default {
            Default::Zero => json!(0.0),
            Default::Zeros => json!([0.0, 0.0]),
            Default::Empty => match field.shape {
                Shape::List(..) => json!([]),
                _ => json!({}),
            },
            Default::Number(number) => json!(number),
            Default::Text(text) => json!(text),
            Default::Same => return,
        };
        keys.insert("default".into(), value);
    }
}

/// A bound; whole numbers without a decimal point.
fn bounded(bound: Bound, most_first: bool) -> Keys {
    let number = |number: f64| match number.fract() {
        0.0 => json!(number as i64),
        _ => json!(number),
    };
    keys(match bound {
        Bound::Any => json!({}),
        Bound::AtLeast(least) => json!({ "minimum": number(least) }),
        Bound::Above(limit) => json!({ "exclusiveMinimum": number(limit) }),
        Bound::Between(least, most) if most_first => {
            json!({ "maximum": number(most), "minimum": number(least) })
        }
        Bound::Between(least, most) => {
            json!({ "minimum": number(least), "maximum": number(most) })
        }
        Bound::Within(limit, most) => {
            json!({ "exclusiveMinimum": number(limit), "maximum": number(most) })
        }
        Bound::NotZero => json!({ "not": { "const": 0 } }),
    })
}

/// The name of a measure in the schema.
fn measure_name(measure: Measure) -> &'static str {
    match measure {
        Measure::Of(dimension) => dimension.name(),
        Measure::LinearStiffness => "linear stiffness",
        Measure::Driven(0) => "driven",
        Measure::Driven(1) => "driven velocity",
        Measure::Driven(2) => "driven acceleration",
        Measure::Driven(_) => "driven jerk",
        Measure::DrivenCoefficient => "driven coefficient",
    }
}

fn named(kind: Named) -> &'static str {
    match kind {
        Named::Body => "body",
        Named::Joint => "joint",
        Named::Driver => "driver",
    }
}

/// A number with a dimension, without what a key says beside.
fn quantity(measure: Measure) -> Keys {
    keys(json!({
        "type": ["number", "string"], "pattern": QUANTITY_PATTERN, "x-dimension": measure_name(measure)
    }))
}

fn list(items: &Shape, least: usize, most: Option<usize>) -> Keys {
    let mut keys = keys(json!({ "type": "array", "items": at(items, None) }));
    if least > 0 {
        keys.insert("minItems".into(), json!(least));
    }
    keys.extend(most.map(|most| ("maxItems".to_owned(), json!(most))));
    keys
}

/// What stands at a place: before and behind what its key says.
fn at(shape: &Shape, field: Option<&Field>) -> Keys {
    let reference = |name: &str| keys(json!({ "$ref": target(name) }));
    let (mut keys, behind) = match shape {
        Shape::Name(kind) => (
            keys(json!({ "type": "string" })),
            keys(json!({ "x-reference": named(*kind) })),
        ),
        Shape::Quantity(measure, bound) => (quantity(*measure), bounded(*bound, true)),
        Shape::Number(bound) => number("number", true, *bound),
        Shape::Coefficient(bound) => number("number", false, *bound),
        Shape::Count(least, most) => number(
            "integer",
            false,
            Bound::Between(*least as f64, *most as f64),
        ),
        Shape::Flag => (keys(json!({ "type": "boolean" })), Keys::new()),
        Shape::ContactStiffness => (
            keys(json!({
                "type": ["number", "string"], "pattern": QUANTITY_PATTERN, "x-plain": "number",
                "x-linear": measure_name(Measure::LinearStiffness)
            })),
            bounded(Bound::Above(0.0), true),
        ),
        Shape::Alike(bound) => (places::value(), bounded(*bound, true)),
        Shape::Direction => (
            list(&Shape::Number(Bound::Any), 2, Some(2)),
            keys(json!({ "not": { "const": [0, 0] } })),
        ),
        Shape::Parameters => places::parameters(),
        Shape::Map(of) => map(of),
        Shape::Responses => map(&Shape::Response),
        Shape::Bodies => bodies(),
        shape => {
            let own = match shape {
                Shape::Format => reference("Format"),
                Shape::Point => reference("PointRef"),
                Shape::Materials => reference("Elastic"),
                Shape::Choice(choice) => reference(choice.name),
                Shape::Object(of) | Shape::Curve(of) | Shape::State(of) => reference(of.name),
                Shape::Tagged(tagged) => reference(tagged.name),
                Shape::Units => places::units(),
                Shape::Response => places::response(),
                Shape::Asked(asked) => places::asked(*asked),
                Shape::Range(measure, bound) | Shape::PerAxis(measure, bound) => {
                    places::range(*measure, *bound)
                }
                Shape::End(measure) => places::end(&quantity(*measure)),
                Shape::Place => places::place(),
                Shape::Limit | Shape::Nominal | Shape::Entry | Shape::Input => places::value(),
                Shape::Deviations => places::deviations(),
                Shape::Pair(of) => list(of, 2, Some(2)),
                Shape::List(of, least) => list(of, *least, None),
                Shape::Table => {
                    let pair = [Measure::Of(Dimension::Time), Measure::Driven(0)].map(quantity);
                    places::points(&json!({ "prefixItems": pair, "items": false }))
                }
                Shape::Entries => places::points(&json!({ "items": places::value() })),
                Shape::Varying(dimension) => varying(*dimension, &["Motion"]),
                Shape::Formula(dimension) => varying(*dimension, &["Motion", "TableOf"]),
                _ => keys(json!({ "type": "string" })),
            };
            (own, Keys::new())
        }
    };
    said(&mut keys, field);
    keys.extend(behind);
    keys
}

/// A quantity, or what gives one.
fn varying(dimension: Dimension, others: &[&str]) -> Keys {
    let others = others
        .iter()
        .map(|name| keys(json!({ "$ref": target(name) })));
    let all: Vec<Keys> = std::iter::once(quantity(Measure::Of(dimension)))
        .chain(others)
        .collect();
    keys(json!({ "anyOf": all, "x-driven": dimension.name() }))
}

/// A number without dimension, or an expression.
fn number(kind: &str, is_double: bool, bound: Bound) -> (Keys, Keys) {
    let mut number = keys(json!({ "type": [kind, "string"] }));
    if is_double {
        number.insert("format".into(), "double".into());
    }
    let mut behind = bounded(bound, !is_double);
    behind.extend(keys(
        json!({ "pattern": EXPRESSION_PATTERN, "x-plain": kind }),
    ));
    (number, behind)
}

fn map(of: &Shape) -> (Keys, Keys) {
    let each = at(of, None);
    let behind = json!({
        "propertyNames": { "pattern": NAME_PATTERN },
        "properties": { "note": { "anyOf": [note(), each] } }
    });
    let map = json!({ "type": "object", "additionalProperties": each });
    (keys(map), keys(behind))
}

/// `bodies`: `ground` is one of its own kind.
fn bodies() -> (Keys, Keys) {
    let body = json!({ "$ref": target("Body") });
    let all = json!({
        "type": "object",
        "properties": { "ground": { "$ref": target("Ground") }, "note": { "anyOf": [note(), body] } },
        "additionalProperties": body,
        "minProperties": 1
    });
    let behind = json!({ "propertyNames": { "pattern": NAME_PATTERN } });
    (keys(all), keys(behind))
}
