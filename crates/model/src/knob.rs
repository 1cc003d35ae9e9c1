//! Parameters as knobs: those that can be turned, between which ends, in the unit that the file uses; and the text of the file with
//! other numbers in their place.

use serde::Serialize;

use super::error::Complaint;
use super::expression::{Fault, Parameter, is_expression, quantity};
use super::literal::Literal;
use super::load::Loaded;
use super::node::{Origin, excerpt};
use super::optimise::Range;
use super::units::{Unit, split_quantity};

/// A parameter that has a number of its own, in the unit in which the file gives it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Knob {
    /// The parameter's name.
    pub name: String,
    /// What the file says.
    pub value: f64,
    /// As the file writes it; empty of a plain number.
    pub unit: String,
    /// What is worth trying: the range of `optimise.design`, of `study.vary`, the tolerance, or half to double the value.
    pub least: f64,
    /// The other end.
    pub most: f64,
    #[serde(skip)]
    scale: Option<Unit>,
}

/// All knobs of a model, in the order of the file. What follows from other parameters has none.
pub fn knobs(loaded: &Loaded) -> Vec<Knob> {
    let own = loaded.parameters.iter();
    let own = own.filter(|parameter| !is_expression(&parameter.text));
    own.filter_map(|parameter| knob(parameter, loaded))
        .collect()
}

fn knob(parameter: &Parameter, loaded: &Loaded) -> Option<Knob> {
    let (number, unit) = split_quantity(&parameter.text)?;
    let scale = match unit {
        "" => None,
        unit => Some(Unit::parse(unit).ok()?),
    };
    let value: f64 = number.parse().ok()?;
    let mut knob = Knob {
        name: parameter.name.clone(),
        value,
        unit: unit.to_owned(),
        least: value,
        most: value,
        scale,
    };
    let [a, b] = knob.range(parameter, loaded);
    (knob.least, knob.most) = (a.min(b).min(value), a.max(b).max(value));
    (knob.least.is_finite() && knob.most.is_finite()).then_some(knob)
}

impl Knob {
    /// In SI → in the file's unit.
    fn in_unit(&self, value: f64) -> f64 {
        let own = self
            .scale
            .and_then(|unit| Unit::si(unit.powers).convert(value, unit));
        own.unwrap_or(value)
    }

    fn range(&self, parameter: &Parameter, loaded: &Loaded) -> [f64; 2] {
        let (model, name) = (&loaded.model, &self.name);
        let design = model
            .optimise
            .as_ref()
            .and_then(|optimise| match optimise.design.get(name) {
                Some(Range::Within(ends)) => Some(ends.map(|end| self.in_unit(end))),
                Some(Range::Free(_)) | None => None,
            });
        let vary = || self.varied(model.study.as_ref()?.vary.get(name)?);
        let tolerance = || {
            let tolerance = parameter.tolerance.as_ref()?;
            let ends = [tolerance.lower, tolerance.upper];
            Some(ends.map(|end| self.value + self.in_unit(end)))
        };
        let found = design.or_else(vary).or_else(tolerance);
        let found = found.filter(|[a, b]| a != b);
        found.unwrap_or_else(|| match (self.value, self.unit.as_str()) {
            (0.0, "mm") => [-10.0, 10.0],
            (0.0, "deg" | "°") => [-45.0, 45.0],
            (0.0, _) => [-1.0, 1.0],
            (value, _) => [0.5 * value, 2.0 * value],
        })
    }

    /// Least and greatest value of `FROM:TO:COUNT` or a list.
    fn varied(&self, text: &str) -> Option<[f64; 2]> {
        let parts: Vec<&str> = match text.split(':').collect::<Vec<_>>()[..] {
            [from, to, _] => vec![from, to],
            _ => text.split(',').collect(),
        };
        let values = parts.into_iter().map(|part| self.read(part).ok());
        let values: Vec<f64> = values.collect::<Option<_>>()?;
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Some([least, most])
    }

    /// A number in the file's unit, from a number without a unit or one with any unit of the same dimension.
    ///
    /// # Errors
    /// What is no such number.
    pub fn read(&self, text: &str) -> Result<f64, Complaint> {
        let path = format!("parameters.{}", self.name);
        let fault = |fault: Fault| {
            let found = Complaint::new(path.clone(), fault.message).found(excerpt(text));
            Complaint {
                hint: fault.hint,
                ..found
            }
        };
        let plain = text.trim().parse::<f64>().ok();
        if let Some(plain) = plain.filter(|plain| plain.is_finite()) {
            return Ok(plain);
        }
        let given = quantity(text).map_err(fault)?;
        let unit = split_quantity(text).and_then(|(_, unit)| Unit::parse(unit).ok());
        let is_like = |own: Unit| unit.is_some_and(|unit| unit.powers == own.powers);
        match self.scale {
            Some(own) if is_like(own) => {
                // rounded to what a double can hold of both units
                let value = Unit::si(own.powers).convert(given.value, own);
                let value = value.unwrap_or(given.value);
                Ok(format!("{value:.12e}").parse().unwrap_or(value))
            }
            Some(_) => Err(fault(
                Fault::new(format!("this is {}", given.words()))
                    .hint(format!("the parameter is in {}", self.unit)),
            )),
            None => Err(fault(
                Fault::new("the parameter is a plain number").hint("write it without a unit"),
            )),
        }
    }

    /// `PATH=VALUE`, as `--set` takes it.
    pub fn set(&self, value: f64) -> String {
        format!("parameters.{}={value} {}", self.name, self.unit)
            .trim_end()
            .to_owned()
    }
}

/// The text of a model's file with other numbers for some parameters, each in the file's unit; every other byte stays.
///
/// # Errors
/// A parameter that has no number in the file.
pub fn rewritten(loaded: &Loaded, values: &[(&str, f64)]) -> Result<String, Complaint> {
    let source = &loaded.source;
    let mut edits = Vec::new();
    for &(name, value) in values {
        let path = format!("parameters.{name}");
        let refuse = |why: &str| Complaint::new(path.clone(), why);
        let node = source.root.get("parameters").and_then(|all| all.get(name));
        let node = node.map(|node| node.get("value").unwrap_or(node));
        let node = node.ok_or_else(|| refuse("there is no such parameter"))?;
        if matches!(node.origin, Origin::Set(_)) {
            return Err(refuse("the file does not say it: --set gives it"));
        }
        let literal = Literal::of(source, node, 1.0);
        let literal = literal.ok_or_else(|| refuse("the file has no number for it"))?;
        if !value.is_finite() {
            return Err(refuse("a finite number is expected"));
        }
        edits.push((literal, value.to_string()));
    }
    Ok(source.replaced(edits))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "{ \"format\": \"linkdyn/1\",\n\t\"units\": \"SI\", \"note\": \"a = 90 mm\",
  \"parameters\": {\"a\":90e0 ,  \"b\" : \" +90.0  mm\", \"c\": { \"note\": \"90\", \"tolerance\": \"1 mm\", \"value\": \"90 mm\" },
    \"note\": \"90\", \"d\": \"=2*b\", \"e\": \"0 deg\", \"f\": -2 },
  \"bodies\": { \"bar\": { \"points\": { \"A\": [\"=b + c + d + a*e*f*(1 m)/(1 rad)\", 0] } } } }\r\n";

    fn loaded() -> Loaded {
        crate::load(FILE.as_bytes(), &[]).expect("legal")
    }

    #[test]
    fn knobs_have_the_units_of_the_file_and_a_range() {
        let all = knobs(&loaded());
        let seen: Vec<_> = all
            .iter()
            .map(|own| {
                (
                    own.name.as_str(),
                    own.value,
                    own.unit.as_str(),
                    own.least,
                    own.most,
                )
            })
            .collect();
        let expected = [
            ("a", 90.0, "", 45.0, 180.0),
            ("b", 90.0, "mm", 45.0, 180.0),
            ("c", 90.0, "mm", 89.0, 91.0),
            ("e", 0.0, "deg", -45.0, 45.0),
            ("f", -2.0, "", -4.0, -1.0),
        ];
        assert_eq!(seen, expected);
        assert_eq!(all[1].set(87.5), "parameters.b=87.5 mm");
        assert_eq!(all[0].set(1e-7), "parameters.a=0.0000001");
    }

    #[test]
    fn values_are_read_in_any_unit_of_the_dimension() {
        let all = knobs(&loaded());
        let read = |knob: usize, text: &str| all[knob].read(text).map_err(|why| why.to_string());
        assert_eq!(read(1, " 85 "), Ok(85.0));
        assert_eq!(read(1, "8.5 cm"), Ok(85.0));
        assert_eq!(read(1, "1 in"), Ok(25.4));
        assert_eq!(read(0, "2.5"), Ok(2.5));
        for (knob, text) in [
            (1, "2 s"),
            (0, "2 mm"),
            (1, "two"),
            (1, "1,5 mm"),
            (1, "inf"),
            (1, ""),
        ] {
            assert!(read(knob, text).is_err(), "{text}");
        }
    }

    #[test]
    fn only_the_numbers_change() {
        let loaded = loaded();
        let text = rewritten(&loaded, &[("c", 91.5), ("a", 7.0), ("b", -0.25)]).expect("written");
        let expected = FILE
            .replace("90e0", "7")
            .replace("+90.0", "-0.25")
            .replace("\"value\": \"90 mm\"", "\"value\": \"91.5 mm\"");
        assert_eq!(text, expected);
        assert!(
            rewritten(&loaded, &[("d", 1.0)]).is_err(),
            "it follows from others"
        );
        assert!(rewritten(&loaded, &[("none", 1.0)]).is_err());
        let sets = ["parameters.a=5".to_owned()];
        let set = crate::load(FILE.as_bytes(), &sets).expect("legal");
        assert!(rewritten(&set, &[("a", 1.0)]).is_err(), "it is set");
    }
}
