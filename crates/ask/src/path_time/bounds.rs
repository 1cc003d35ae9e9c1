//! Limits in words, and the columns that they are of.

use linkdyn_output::{Channel, Column, JointQuantity, matches};
use serde_json::{Value, json};

use crate::near::did_you_mean;
use crate::put::{Put, number, read};
use crate::{ModelFile, Unanswered};

/// What a limit is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// A column.
    Column(usize),
    /// The size of two columns.
    Size([usize; 2]),
    /// The driver's speed.
    Speed,
    /// The driver's acceleration.
    Acceleration,
}

/// A limit.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bound {
    /// A column, `joint.b` or `speed`.
    pub name: String,
    pub unit: &'static str,
    pub of: Of,
    /// Lower and upper end [SI].
    pub range: [f64; 2],
}

impl Bound {
    /// A limit to both sides.
    pub fn of(name: &str, unit: &'static str, of: Of, most: f64) -> Bound {
        Bound {
            name: name.into(),
            unit,
            of,
            range: [-most, most],
        }
    }

    /// Whether it has a lower end.
    pub fn has_lower(&self) -> bool {
        match self.of {
            Of::Column(_) | Of::Acceleration => true,
            Of::Size(_) | Of::Speed => false,
        }
    }

    /// Size of the larger end.
    pub fn scale(&self) -> f64 {
        self.range[0].abs().max(self.range[1].abs())
    }
}

/// What the response that reads a limit is called.
const OWN: &str = "limit of path-time";

fn bad(text: &str, why: impl AsRef<str>) -> Unanswered {
    Unanswered::question(format!("--limit {text:?}: {}", why.as_ref()))
}

/// `joint.*=300 N`: a limit for each column of the pattern.
pub(super) fn bounds(
    text: &str,
    columns: &[Column],
    file: &ModelFile,
) -> Result<Vec<Bound>, Unanswered> {
    let Some((pattern, ends)) = text.split_once('=') else {
        return Err(bad(
            text,
            "write it as in \"driver.motor.effort=5 N*m\", or with both ends, as in \"driver.motor.effort=-2 N*m:5 N*m\"",
        ));
    };
    let pattern = pattern.trim();
    let found = found(pattern, columns);
    let Some((_, first)) = found.first().map(|(name, of)| (name, *of)) else {
        let names = columns.iter().map(|column| column.name.as_str());
        let hint = did_you_mean(
            pattern,
            names,
            "columns such as \"driver.motor.effort\", or \"joint.b\" for the size of its force",
        );
        return Err(bad(
            text,
            format!("the results have no column {pattern:?} ({hint})"),
        ));
    };
    let column = |of: Of| match of {
        Of::Column(k) | Of::Size([k, _]) => Some(&columns[k]),
        Of::Speed | Of::Acceleration => None,
    };
    let unit = column(first).map_or("", |column| column.unit);
    let others = |(_, of): &(String, Of)| column(*of).is_none_or(|column| column.unit != unit);
    if let Some((other, _)) = found.iter().find(|one| others(one)) {
        return Err(bad(
            text,
            format!(
                "{} and {other} have different units; limit each of them",
                found[0].0
            ),
        ));
    }
    let name = column(first).map_or("", |column| &column.name);
    let range = range(text, name, ends, file)?;
    let is_size = matches!(first, Of::Size(_));
    if is_size && range[0] != -range[1] {
        return Err(bad(
            text,
            "the size of a force has one limit, and no lower one",
        ));
    }
    Ok(found
        .into_iter()
        .map(|(name, of)| Bound {
            name,
            unit,
            of,
            range,
        })
        .collect())
}

/// Columns by their names, else joints by theirs.
fn found(pattern: &str, columns: &[Column]) -> Vec<(String, Of)> {
    let named = columns.iter().enumerate();
    let named = named.filter(|(_, column)| matches(pattern, &column.name));
    let named: Vec<(String, Of)> = named
        .map(|(k, column)| (column.name.clone(), Of::Column(k)))
        .collect();
    // `joint.*` are the forces of all joints, not all their columns.
    let joints = columns.iter().enumerate().filter_map(|(k, column)| {
        let Some(Channel::Joint(joint, JointQuantity::Fx)) = column.channel else {
            return None;
        };
        let name = column.name.strip_suffix(".fx")?;
        let fy = Some(Channel::Joint(joint, JointQuantity::Fy));
        let other = columns.iter().position(|column| column.channel == fy)?;
        matches(pattern, name).then(|| (name.to_owned(), Of::Size([k, other])))
    });
    let joints: Vec<(String, Of)> = joints.collect();
    if joints.is_empty() { named } else { joints }
}

/// `5 N*m` to both sides, or `-2 N*m:5 N*m`.
fn range(text: &str, column: &str, ends: &str, file: &ModelFile) -> Result<[f64; 2], Unanswered> {
    let ends: Vec<&str> = ends.split(':').collect();
    let both: [Value; 2] = match ends[..] {
        [most] => [json!(0), number(most)],
        [lower, upper] => [number(lower), number(upper)],
        _ => {
            return Err(bad(
                text,
                "a limit is one value, or a lower and an upper one, as in \"-2 N*m:5 N*m\"",
            ));
        }
    };
    let response = json!({ "value": format!("max({column})"), "limits": both });
    let put = Put {
        set: format!("responses.{OWN}={response}"),
        labels: vec![(format!("responses.{OWN}"), format!("--limit {text:?}"))],
    };
    if both[0] == json!(0) && ends[0].trim().starts_with('-') {
        return Err(bad(
            text,
            "a limit to both sides is positive; one with two ends is LOWER:UPPER",
        ));
    }
    let read = read(&file.text, &file.sets, &[put]).map_err(|mut found| {
        for complaint in &mut found.0 {
            complaint.message = complaint.message.replace(", as the response is", "");
        }
        found
    })?;
    let limits = read.model().responses.get(OWN).and_then(|own| own.limits);
    let [lower, upper] = limits.ok_or_else(|| bad(text, "it can't be read"))?;
    match ends.len() {
        1 => Ok([-upper, upper]),
        _ if lower == 0.0 && upper == 0.0 => Err(bad(text, "between these ends nothing can move")),
        _ => Ok([lower, upper]),
    }
}
