//! The tree of a file against the schema: all faults at once, and every quantity turned into SI on the way.
//!
//! What is faulty becomes null in the result, so that later checks know not to blame anything else for it.

use indexmap::IndexMap;
use serde_json::{Map, Value, json};

use super::dimension::Dimension;
use super::examples;
use super::expression::{Parameter, Parameters};
use super::node::{Kind, Member, Node, Origin, join};
use super::quantity::{Driven, Units};
use super::schema::SCHEMA;
use super::source::Source;
use super::suggest;
use crate::error::Complaint;

/// Complaints after which the rest is only counted; placing them takes time.
pub(super) const ENOUGH: usize = 200;

/// A text that names something of the model.
pub(super) struct Reference {
    pub path: String,
    /// `point`, `body`, `joint` or `driver`.
    pub kind: String,
    pub text: String,
}

/// What the walk found.
pub(super) struct Findings {
    /// The model in SI units; null where there is a complaint.
    pub value: Value,
    pub complaints: Vec<Complaint>,
    /// How many more there would be.
    pub more: usize,
    pub references: Vec<Reference>,
    pub warnings: Vec<String>,
    pub parameters: Vec<Parameter>,
}

/// Checks the whole file against the schema.
pub(super) fn validate(source: &Source) -> Findings {
    let units = Units::read(source.root.get("units"));
    let written = source.root.get("parameters");
    let (parameters, faults) = Parameters::read(written, !units.in_radians());
    let mut walk = Walk {
        source,
        units,
        parameters,
        complaints: Vec::new(),
        more: 0,
        references: Vec::new(),
    };
    for fault in faults {
        walk.complain_at(fault.node, fault.at, fault.complaint);
    }
    let value = walk.value(&source.root, &SCHEMA, "", Driven::Nothing);
    let mut warnings = walk.units.warnings(source);
    // what nothing uses may stay in a file, but a --set would be in vain
    let unused = walk.parameters.unused(written);
    let (in_vain, idle): (Vec<_>, Vec<_>) = unused.into_iter().partition(|(_, is_set)| *is_set);
    warnings.extend(
        idle.into_iter()
            .map(|(complaint, _)| source.place(complaint).to_string()),
    );
    if walk.complaints.is_empty() {
        walk.complaints.extend(
            in_vain
                .into_iter()
                .map(|(complaint, _)| source.place(complaint)),
        );
    }
    let parameters = walk.parameters.resolved();
    Findings {
        value,
        complaints: walk.complaints,
        more: walk.more,
        references: walk.references,
        warnings,
        parameters,
    }
}

/// The state of the walk.
pub(super) struct Walk<'a> {
    pub source: &'a Source,
    pub units: Units,
    pub parameters: Parameters,
    complaints: Vec<Complaint>,
    more: usize,
    references: Vec<Reference>,
}

/// Follows a `$ref`.
fn target(schema: &Value) -> &Value {
    let reference = schema.get("$ref").and_then(Value::as_str);
    reference
        .and_then(|text| SCHEMA.pointer(text.trim_start_matches('#')))
        .unwrap_or(schema)
}

/// The texts that `const`, `enum` or a `oneOf` of them allow.
fn choices(schema: &Value) -> Option<Vec<&str>> {
    if let Some(text) = schema.get("const").and_then(Value::as_str) {
        return Some(vec![text]);
    }
    if let Some(texts) = schema.get("enum").and_then(Value::as_array) {
        return texts.iter().map(Value::as_str).collect();
    }
    let variants: Vec<_> = schema
        .get("oneOf")?
        .as_array()?
        .iter()
        .map(choices)
        .collect::<Option<_>>()?;
    Some(variants.concat())
}

/// The variants of a union told apart by `type`, with their names.
fn variants(schema: &Value) -> Option<Vec<(&str, &Value)>> {
    let variants = schema.get("oneOf")?.as_array()?.iter();
    variants
        .map(|variant| {
            Some((
                variant.pointer("/properties/type/const")?.as_str()?,
                variant,
            ))
        })
        .collect()
}

impl Walk<'_> {
    /// Complains about a value.
    pub(super) fn complain(&mut self, node: &Node, complaint: Complaint) {
        let found = self.source.found(node);
        self.add(node.origin, found, complaint);
    }

    /// Complains about a value, at a byte of its text.
    pub(super) fn complain_at(&mut self, node: &Node, at: Option<usize>, complaint: Complaint) {
        let origin = at.map_or(node.origin, |at| self.source.within(node, at));
        let found = self.source.found(node);
        self.add(origin, found, complaint);
    }

    /// Complains about a key.
    fn complain_key(&mut self, origin: Origin, key: &str, complaint: Complaint) {
        let key = format!("{:?}", super::node::excerpt(key));
        self.add(origin, Some(key), complaint);
    }

    fn add(&mut self, origin: Origin, found: Option<String>, complaint: Complaint) {
        if self.complaints.len() < ENOUGH {
            self.complaints
                .push(self.source.complain(origin, found, complaint));
        } else {
            self.more += 1;
        }
    }

    /// The value in SI units, or null and a complaint.
    fn value(&mut self, node: &Node, schema: &Value, path: &str, driven: Driven) -> Value {
        let driven = match schema.get("x-driven").and_then(Value::as_str) {
            Some(name) => match Dimension::from_name(name) {
                Some(dimension) => Driven::Dimension(dimension),
                None => self.driver_of_sample(node),
            },
            None => driven,
        };
        if schema.get("$ref").is_some() {
            return self.value(node, target(schema), path, driven);
        }
        if let Some(variants) = variants(schema) {
            return self.tagged(node, &variants, path, driven);
        }
        if let Some(choices) = choices(schema) {
            return self.choice(node, &choices, path);
        }
        if let (Some(branches), None) = (
            schema.get("anyOf").and_then(Value::as_array),
            schema.get("properties"),
        ) {
            return self.value(node, branch(node, branches), path, driven);
        }
        if let Some(dimension) = schema.get("x-dimension").and_then(Value::as_str) {
            let number = self.quantity(node, dimension, path, driven);
            return number
                .and_then(|number| self.bounded(node, number, schema, path))
                .map_or(Value::Null, Value::from);
        }
        match schema.get("x-plain").and_then(Value::as_str) {
            Some("integer") => {
                return self
                    .whole(node, schema, path)
                    .map_or(Value::Null, Value::from);
            }
            Some(_) => {
                let number = self.plain_number(node, path);
                let number = number.and_then(|number| self.bounded(node, number, schema, path));
                return number.map_or(Value::Null, Value::from);
            }
            // they are read already
            None if schema.get("x-parameters").is_some() => return Value::Null,
            None => {}
        }
        match schema.get("type").and_then(Value::as_str) {
            Some("object") => self.object(node, schema, path, driven),
            Some("array") => self.array(node, schema, path, driven),
            Some(_) | None => self.text(node, schema, path),
        }
    }

    /// The dimension of the driver that a sample names.
    fn driver_of_sample(&self, sample: &Node) -> Driven {
        let name = sample.get("driver").and_then(Node::as_str);
        let driver = name.and_then(|name| self.source.root.get("drivers")?.get(name));
        match driver.and_then(|driver| driver.get("type")?.as_str()) {
            Some("rotation") => Driven::Dimension(Dimension::Angle),
            Some("translation") => Driven::Dimension(Dimension::Length),
            Some(_) | None => Driven::Unknown,
        }
    }

    fn tagged(
        &mut self,
        node: &Node,
        variants: &[(&str, &Value)],
        path: &str,
        driven: Driven,
    ) -> Value {
        let names: Vec<&str> = variants.iter().map(|(name, _)| *name).collect();
        let Kind::Object(members) = &node.kind else {
            self.complain(node, wrong_kind(path, "an object", node));
            return Value::Null;
        };
        let Some(member) = members.get("type") else {
            let misspelt = members
                .iter()
                .find(|(key, _)| suggest::nearest(key, ["type"]).is_some());
            match misspelt {
                Some((key, member)) => {
                    let complaint = Complaint::new(join(path, key), "unknown key")
                        .hint("did you mean \"type\"?");
                    self.complain_key(member.key, key, complaint);
                }
                None => {
                    let complaint = Complaint::new(path, "\"type\" is missing");
                    self.complain(
                        node,
                        complaint.hint(format!("one of {}", suggest::any_of(names))),
                    );
                }
            }
            return Value::Null;
        };
        let kind = member.node.as_str();
        if let Some((_, variant)) = variants.iter().find(|(name, _)| Some(*name) == kind) {
            return self.value(node, variant, path, driven);
        }
        // a misspelt type is read as the one that was probably meant, to find what else is wrong
        match kind.and_then(|kind| suggest::nearest(kind, names.iter().copied())) {
            Some(name) => {
                let variant = variants.iter().find(|(known, _)| *known == name);
                variant.map_or(Value::Null, |(_, variant)| {
                    self.value(node, variant, path, driven)
                })
            }
            None => self.choice(&member.node, &names, &join(path, "type")),
        }
    }

    fn choice(&mut self, node: &Node, choices: &[&str], path: &str) -> Value {
        let Some(text) = node.as_str() else {
            let complaint = wrong_kind(path, "text", node);
            self.complain(
                node,
                complaint.hint(format!(
                    "one of {}",
                    suggest::any_of(choices.iter().copied())
                )),
            );
            return Value::Null;
        };
        if choices.contains(&text) {
            return Value::from(text);
        }
        let word = path.rsplit(['.', ']']).next().unwrap_or(path);
        let hint = match (choices, suggest::meant(text, choices)) {
            (["SI"], _) => format!("write {}", examples::UNITS),
            ([only], _) if word != "type" => format!("{only:?} is expected"),
            (_, Some(near)) => format!("did you mean {near:?}?"),
            (_, None) => format!("one of {}", suggest::any_of(choices.iter().copied())),
        };
        self.complain(
            node,
            Complaint::new(path, format!("unknown {word}")).hint(hint),
        );
        Value::Null
    }

    fn object(&mut self, node: &Node, schema: &Value, path: &str, driven: Driven) -> Value {
        let Kind::Object(members) = &node.kind else {
            self.complain(node, wrong_kind(path, "an object", node));
            return Value::Null;
        };
        let empty = Map::new();
        let properties = schema
            .get("properties")
            .and_then(Value::as_object)
            .unwrap_or(&empty);
        let additional = schema
            .get("additionalProperties")
            .filter(|value| value.is_object());
        let mut out = Map::new();
        for (key, member) in members.iter() {
            let here = join(path, key);
            match (properties.get(key), additional) {
                // in a map, `note` is a remark if it is text, else a name like any other
                (Some(_), Some(_)) if key == "note" && member.node.as_str().is_some() => {}
                (Some(property), _) if is_linear(property, members) => {
                    let number = self.quantity(&member.node, "linear stiffness", &here, driven);
                    let number = number
                        .and_then(|number| self.bounded(&member.node, number, property, &here));
                    out.insert(key.clone(), number.map_or(Value::Null, Value::from));
                }
                (Some(property), _) => {
                    out.insert(
                        key.clone(),
                        self.value(&member.node, property, &here, driven),
                    );
                }
                (None, Some(additional)) => {
                    self.name(key, member, &here);
                    out.insert(
                        key.clone(),
                        self.value(&member.node, additional, &here, driven),
                    );
                }
                (None, None) => {
                    if let Some(meant) = self.unknown_key(key, schema, members, &here) {
                        out.insert(meant, Value::Null);
                    }
                }
            }
        }
        let required = schema
            .get("required")
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
            .filter_map(Value::as_str);
        for key in required
            .filter(|key| !out.contains_key(*key))
            .collect::<Vec<_>>()
        {
            let mut complaint = Complaint::new(path, format!("{key:?} is missing"));
            complaint.hint = examples::of_missing(path, key).or_else(|| {
                let choices = choices(target(properties.get(key)?))?;
                Some(format!("one of {}", suggest::any_of(choices)))
            });
            self.complain(node, complaint);
        }
        if out.is_empty() && schema.get("minProperties").is_some() {
            self.complain(
                node,
                Complaint::new(path, "it is empty, at least one is needed"),
            );
            return Value::Null;
        }
        Value::Object(out)
    }

    /// Complains about a key that is not known; the known one that was probably meant.
    fn unknown_key(
        &mut self,
        key: &str,
        schema: &Value,
        members: &IndexMap<String, Member>,
        path: &str,
    ) -> Option<String> {
        let origin = members.get(key)?.key;
        if let Some(reason) = schema
            .get("x-refused")
            .and_then(|refused| refused.get(key)?.as_str())
        {
            self.complain_key(origin, key, Complaint::new(path, reason));
            return None;
        }
        let known: Vec<&str> = schema["properties"]
            .as_object()?
            .keys()
            .map(String::as_str)
            .collect();
        let free = known
            .iter()
            .copied()
            .filter(|known| !members.contains_key(*known));
        let meant = suggest::nearest(key, free);
        let complaint = Complaint::new(path, "unknown key").hint(match meant {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => format!("known keys: {}", known.join(", ")),
        });
        self.complain_key(origin, key, complaint);
        meant.map(str::to_owned)
    }

    /// Complains about a name that the format does not allow.
    fn name(&mut self, name: &str, member: &Member, path: &str) {
        if name.is_empty() {
            self.complain_key(
                member.key,
                name,
                Complaint::new(path, "a name must not be empty"),
            );
        } else if let Some(bad) = name
            .chars()
            .find(|&c| ".[],=*?".contains(c) || c.is_control())
        {
            let complaint = Complaint::new(
                path,
                format!("a name must not contain {:?}", bad.to_string()),
            );
            self.complain_key(
                member.key,
                name,
                complaint.hint("nor any of . [ ] , = * ? and control characters"),
            );
        }
    }

    fn array(&mut self, node: &Node, schema: &Value, path: &str, driven: Driven) -> Value {
        let Kind::Array(items) = &node.kind else {
            self.complain(node, wrong_kind(path, "a list", node));
            return Value::Null;
        };
        let bound = |key: &str| {
            schema
                .get(key)
                .and_then(Value::as_u64)
                .and_then(|bound| usize::try_from(bound).ok())
        };
        let (least, most) = (
            bound("minItems").unwrap_or(0),
            bound("maxItems").unwrap_or(usize::MAX),
        );
        if items.len() < least || items.len() > most {
            let wanted = if least == most {
                format!("{least}")
            } else {
                format!("at least {least}")
            };
            let found = items.len();
            self.complain(
                node,
                Complaint::new(
                    path,
                    format!("a list of {wanted} is expected, this one has {found}"),
                ),
            );
            return Value::Null;
        }
        let each = schema.get("items").unwrap_or(&Value::Null);
        let first = schema.get("prefixItems").and_then(Value::as_array);
        let mut values = Vec::with_capacity(items.len());
        for (index, item) in items.iter().enumerate() {
            let schema = first.and_then(|first| first.get(index)).unwrap_or(each);
            let driven = if schema.get("x-dimension") == Some(&json!("driven coefficient")) {
                driven.derivative(index)
            } else {
                driven
            };
            values.push(self.value(item, schema, &format!("{path}[{index}]"), driven));
        }
        let values = Value::Array(values);
        if is_zero(&values) && schema.pointer("/not/const").is_some_and(is_zero) {
            self.complain(
                node,
                Complaint::new(path, "both components are zero, which is no direction"),
            );
            return Value::Null;
        }
        values
    }

    fn text(&mut self, node: &Node, schema: &Value, path: &str) -> Value {
        let Some(text) = node.as_str() else {
            self.complain(node, wrong_kind(path, "text", node));
            return Value::Null;
        };
        if let Some(dimension) = schema
            .get("x-unit-of")
            .and_then(Value::as_str)
            .and_then(Dimension::from_name)
        {
            self.unit(node, text, dimension, path);
        }
        if let Some(kind) = schema.get("x-reference").and_then(Value::as_str) {
            self.references.push(Reference {
                path: path.into(),
                kind: kind.into(),
                text: text.into(),
            });
        }
        Value::from(text)
    }

    fn whole(&mut self, node: &Node, schema: &Value, path: &str) -> Option<u64> {
        let number = self.plain_number(node, path)?;
        if number.fract() != 0.0 {
            self.complain(node, Complaint::new(path, "a whole number is expected"));
            return None;
        }
        // bounds keep it far below 2⁵³
        self.bounded(node, number, schema, path)
            .map(|number| number as u64)
    }

    /// The number, where it is within the schema's bounds.
    fn bounded(&mut self, node: &Node, number: f64, schema: &Value, path: &str) -> Option<f64> {
        let bound = |key: &str| schema.get(key).and_then(Value::as_f64);
        let fault = if let Some(least) = bound("minimum").filter(|least| number < *least) {
            if least == 0.0 {
                "must not be negative".to_owned()
            } else {
                format!("must not be less than {least}")
            }
        } else if let Some(most) = bound("maximum").filter(|most| number > *most) {
            format!("must not be greater than {most}")
        } else if let Some(limit) = bound("exclusiveMinimum").filter(|limit| number <= *limit) {
            format!("must be greater than {limit}")
        } else if number == 0.0 && schema.pointer("/not/const").is_some_and(is_zero) {
            "must not be zero".to_owned()
        } else {
            return Some(number);
        };
        self.complain(node, Complaint::new(path, fault));
        None
    }
}

/// The branch of a union that this value is most likely meant for.
fn branch<'s>(node: &Node, branches: &'s [Value]) -> &'s Value {
    let keys = |branch: &Value| -> usize {
        let Kind::Object(members) = &node.kind else {
            return 0;
        };
        let schema = target(branch);
        let properties = schema.get("properties").and_then(Value::as_object);
        properties.map_or(0, |properties| {
            members
                .keys()
                .filter(|key| properties.contains_key(*key))
                .count()
        })
    };
    let is_object = |branch: &Value| {
        let schema = target(branch);
        variants(schema).is_some() || schema.get("type") == Some(&json!("object"))
    };
    let wanted = matches!(node.kind, Kind::Object(_));
    let fitting = branches.iter().filter(|branch| is_object(branch) == wanted);
    fitting
        .rev()
        .max_by_key(|branch| keys(branch))
        .unwrap_or(&branches[0])
}

/// Whether this is the stiffness of a law that is linear, so that it has a unit of its own.
fn is_linear(property: &Value, members: &IndexMap<String, Member>) -> bool {
    let law = || members.get("law").and_then(|member| member.node.as_str());
    property.get("x-linear").is_some() && law() == Some("kelvin_voigt")
}

/// Whether this is zero, or a list of zeros.
fn is_zero(value: &Value) -> bool {
    match value {
        Value::Array(items) => !items.is_empty() && items.iter().all(is_zero),
        Value::Number(number) => number.as_f64() == Some(0.0),
        Value::Null | Value::Bool(_) | Value::String(_) | Value::Object(_) => false,
    }
}

/// Something else is expected here.
pub(super) fn wrong_kind(path: &str, wanted: &str, node: &Node) -> Complaint {
    let hint = examples::example(path).map(|example| format!("as in {example}"));
    Complaint {
        hint,
        ..Complaint::new(
            path,
            format!("{wanted} is expected, not {}", node.kind_name()),
        )
    }
}
