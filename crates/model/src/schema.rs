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
        .map(|(word, about)| json!({ "type": "string", "const": word, "description": about }));
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
    if let Some(either) = object.either {
        let [first, second] = either.keys.map(|key| json!({ "required": [key] }));
        match (either.needed, either.exclusive) {
            (Some(_), false) => keys.insert("anyOf".into(), json!([first, second])),
            (Some(_), true) => keys.insert("oneOf".into(), json!([first, second])),
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
fn bounded(keys: &mut Keys, bound: Bound, most_first: bool) {
    let number = |number: f64| match number.fract() {
        0.0 => json!(number as i64),
        _ => json!(number),
    };
    match bound {
        Bound::Any => {}
        Bound::AtLeast(least) => {
            keys.insert("minimum".into(), number(least));
        }
        Bound::Above(limit) => {
            keys.insert("exclusiveMinimum".into(), number(limit));
        }
        Bound::Between(least, most) => {
            let (least, most) = (("minimum", number(least)), ("maximum", number(most)));
            let pair = if most_first {
                [most, least]
            } else {
                [least, most]
            };
            keys.extend(pair.map(|(key, value)| (key.to_owned(), value)));
        }
        Bound::Within(limit, most) => {
            keys.insert("exclusiveMinimum".into(), number(limit));
            keys.insert("maximum".into(), number(most));
        }
        Bound::NotZero => {
            keys.insert("not".into(), json!({ "const": 0 }));
        }
    }
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

/// What stands at a place, with what its key says.
fn at(shape: &Shape, field: Option<&Field>) -> Keys {
    let reference = |name: &str| keys(json!({ "$ref": target(name) }));
    let mut keys = match shape {
        Shape::Format => reference("Format"),
        Shape::Point => reference("PointRef"),
        Shape::Materials => reference("Elastic"),
        Shape::Choice(choice) => reference(choice.name),
        Shape::Object(of) | Shape::Curve(of) | Shape::State(of) => reference(of.name),
        Shape::Tagged(tagged) => reference(tagged.name),
        Shape::Units => places::units(),
        Shape::Parameters => return places::parameters(field),
        Shape::Map(of) => return map(of, field),
        Shape::Responses => return map(&Shape::Response, field),
        Shape::Response => places::response(),
        Shape::Asked(asked) => places::asked(*asked),
        Shape::Bodies => return bodies(field),
        Shape::Text | Shape::Event => keys(json!({ "type": "string" })),
        Shape::Name(kind) => {
            let mut keys = keys(json!({ "type": "string" }));
            said(&mut keys, field);
            keys.insert("x-reference".into(), named(*kind).into());
            return keys;
        }
        Shape::Quantity(measure, bound) => {
            let mut keys = quantity(*measure);
            said(&mut keys, field);
            bounded(&mut keys, *bound, true);
            return keys;
        }
        Shape::Number(bound) => return number("number", true, *bound, field),
        Shape::Coefficient(bound) => return number("number", false, *bound, field),
        Shape::Count(least, most) => {
            let bound = Bound::Between(*least as f64, *most as f64);
            return number("integer", false, bound, field);
        }
        Shape::ContactStiffness => {
            let mut keys = keys(json!({
                "type": ["number", "string"], "pattern": QUANTITY_PATTERN, "x-plain": "number",
                "x-linear": measure_name(Measure::LinearStiffness)
            }));
            said(&mut keys, field);
            bounded(&mut keys, Bound::Above(0.0), true);
            return keys;
        }
        Shape::Range(measure, bound) | Shape::PerAxis(measure, bound) => {
            places::range(*measure, *bound)
        }
        Shape::End(measure) => places::end(&quantity(*measure)),
        Shape::Place => places::place(),
        Shape::Limit | Shape::Nominal | Shape::Entry => places::value(),
        Shape::Deviations => places::deviations(),
        Shape::Alike(bound) => {
            let mut keys = places::value();
            said(&mut keys, field);
            bounded(&mut keys, *bound, true);
            return keys;
        }
        Shape::Direction => return places::direction(field),
        Shape::Pair(of) => list(of, 2, Some(2)),
        Shape::List(of, least) => list(of, *least, None),
        Shape::Table => {
            let time = quantity(Measure::Of(Dimension::Time));
            places::points(
                &json!({ "prefixItems": [time, quantity(Measure::Driven(0))], "items": false }),
            )
        }
        Shape::Entries => places::points(&json!({ "items": places::value() })),
        Shape::Varying(dimension) => keys(json!({
            "anyOf": [quantity(Measure::Of(*dimension)), reference("Motion")],
            "x-driven": dimension.name()
        })),
        Shape::Formula(dimension) => keys(json!({
            "anyOf": [quantity(Measure::Of(*dimension)), reference("Motion"), reference("TableOf")],
            "x-driven": dimension.name()
        })),
    };
    said(&mut keys, field);
    keys
}

/// A number without dimension, or an expression.
fn number(kind: &str, is_double: bool, bound: Bound, field: Option<&Field>) -> Keys {
    let mut keys = keys(json!({ "type": [kind, "string"] }));
    if is_double {
        keys.insert("format".into(), "double".into());
    }
    said(&mut keys, field);
    bounded(&mut keys, bound, !is_double);
    keys.insert("pattern".into(), EXPRESSION_PATTERN.into());
    keys.insert("x-plain".into(), kind.into());
    keys
}

fn map(of: &Shape, field: Option<&Field>) -> Keys {
    let each = at(of, None);
    let mut keys = keys(json!({ "type": "object", "additionalProperties": each }));
    said(&mut keys, field);
    keys.insert("propertyNames".into(), json!({ "pattern": NAME_PATTERN }));
    keys.insert(
        "properties".into(),
        json!({ "note": { "anyOf": [note(), each] } }),
    );
    keys
}

/// `bodies`: `ground` is one of its own kind.
fn bodies(field: Option<&Field>) -> Keys {
    let body = json!({ "$ref": target("Body") });
    let mut keys = keys(json!({
        "type": "object",
        "properties": { "ground": { "$ref": target("Ground") }, "note": { "anyOf": [note(), body] } },
        "additionalProperties": body,
        "minProperties": 1
    }));
    said(&mut keys, field);
    keys.insert("propertyNames".into(), json!({ "pattern": NAME_PATTERN }));
    keys
}
