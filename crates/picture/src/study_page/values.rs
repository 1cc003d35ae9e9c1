//! Rows and motions as compact numbers: binary32 of the difference from a middle, which has seven digits of what varies.

use serde_json::{Value, json};

use super::parts::{Motion, StudyPage, Variable};
use super::room::most_instants;
use crate::numbers::{Numbers, evenly};

/// Numbers of variants are split here, so that both parts are exact.
const PART: u64 = 1 << 20;

/// The numbers of a page.
#[derive(Debug)]
pub struct Values(Numbers);

impl Default for Values {
    fn default() -> Self {
        Values(Numbers::new(false))
    }
}

impl Values {
    pub fn text(&self) -> String {
        self.0.text()
    }

    /// Column after column; returns the middle of each variable.
    pub fn rows(&mut self, page: &StudyPage, reasons: &[&str]) -> Vec<f64> {
        for row in &page.rows {
            self.0.push((row.number / PART) as f64);
        }
        for row in &page.rows {
            self.0.push((row.number % PART) as f64);
        }
        for row in &page.rows {
            let of = |reason: &str| reasons.iter().position(|known| *known == reason);
            // reasons beyond those that are listed have one number
            let number = row.reason.as_deref();
            let number = number.map_or(0, |reason| 1 + of(reason).unwrap_or(reasons.len()));
            self.0.push(number as f64);
        }
        let variables = page.inputs.iter().chain(&page.responses);
        let column = |(k, _): (usize, &Variable)| {
            let values = page.rows.iter().map(|row| row.values[k]);
            let middle = middle(values.clone());
            values.for_each(|value| self.0.push(value - middle));
            middle
        };
        variables.enumerate().map(column).collect()
    }

    /// The instants of motion after motion. Says what of them the page must know: of the mechanism and its drawing what is not as in the
    /// first motion.
    pub fn motions(&mut self, motions: &[Motion]) -> Value {
        let Some(first) = motions.first() else {
            return json!([]);
        };
        let bodies = first.shape.bodies.len().saturating_sub(1);
        let (most, drawn) = (most_instants(motions.len(), bodies), first.drawn());
        let mut paths: Vec<String> = Vec::new();
        let list = motions.iter().map(|motion| {
            let instants = evenly(motion.times.len(), most);
            for &instant in &instants {
                self.0.push(motion.times[instant]);
                let from = 3 * bodies * instant;
                let poses = &motion.poses[from..from + 3 * bodies];
                poses.iter().for_each(|value| self.0.push(*value));
            }
            let [shape, drawing] = motion.drawn();
            let mut changes = Vec::new();
            differences("/mechanism", &drawn[0], &shape, &mut changes);
            differences("/drawing", &drawn[1], &drawing, &mut changes);
            let changes = changes.into_iter().map(|(path, value)| {
                let known = paths.iter().position(|known| *known == path);
                let number = known.unwrap_or(paths.len());
                if known.is_none() {
                    paths.push(path);
                }
                json!([number, value])
            });
            json!([motion.variant, instants.len(), changes.collect::<Value>()])
        });
        let list: Value = list.collect();
        json!({ "list": list, "paths": paths, "bodies": bodies })
    }
}

/// Half-way between the least and the greatest.
fn middle(values: impl Iterator<Item = f64>) -> f64 {
    let finite = values.filter(|value| value.is_finite());
    let ends = finite.fold(None, |ends: Option<[f64; 2]>, value| match ends {
        None => Some([value; 2]),
        Some([low, high]) => Some([low.min(value), high.max(value)]),
    });
    ends.map_or(0.0, |[low, high]| 0.5 * low + 0.5 * high)
}

/// Paths at which a value is another one, with what is there.
fn differences(path: &str, one: &Value, other: &Value, found: &mut Vec<(String, Value)>) {
    match (one, other) {
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (k, (a, b)) in a.iter().zip(b).enumerate() {
                differences(&format!("{path}/{k}"), a, b, found);
            }
        }
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            for ((key, a), b) in a.iter().zip(b.values()) {
                differences(&format!("{path}/{key}"), a, b, found);
            }
        }
        (a, b) if a != b => found.push((path.into(), b.clone())),
        (_, _) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Body, Shape};

    fn motion(variant: Option<u64>, length: f64) -> Motion {
        let body = |name: &str, x: f64| Body {
            name: name.into(),
            points: vec![("A".into(), x, 0.0)],
            ..Body::default()
        };
        Motion {
            variant,
            shape: Shape {
                bodies: vec![body("ground", 0.0), body("bar", length)],
                ..Shape::default()
            },
            times: (0..1000).map(f64::from).collect(),
            poses: (0..3000).map(f64::from).collect(),
        }
    }

    #[test]
    fn of_a_mechanism_only_what_varies_is_told_again() {
        let mut values = Values::default();
        let told = values.motions(&[motion(None, 1.0), motion(Some(3), 2.0)]);
        assert_eq!(told["list"][0], json!([null, 121, []]));
        let changes = told["list"][1][2].as_array().expect("a list");
        assert_eq!(
            (&told["paths"][0], &changes[0]),
            (&json!("/mechanism/bodies/1/points/0/1"), &json!([0, 2.0]))
        );
        // What is seen is another part of the plane; signs and parts are the same.
        let paths = told["paths"]
            .as_array()
            .expect("paths")
            .iter()
            .filter_map(Value::as_str);
        assert!(
            changes.len() > 1 && paths.skip(1).all(|path| path.starts_with("/drawing/box")),
            "{told}"
        );
        let mut expected = Numbers::new(false);
        for _ in 0..2 {
            for instant in evenly(1000, 121) {
                let instant = instant as f64;
                expected.extend([
                    instant,
                    3.0 * instant,
                    3.0 * instant + 1.0,
                    3.0 * instant + 2.0,
                ]);
            }
        }
        assert_eq!(values.text(), expected.text());
    }

    #[test]
    fn middles_have_all_digits_of_what_varies() {
        assert_eq!(middle([f64::NAN, 2.0, 4.0].into_iter()), 3.0);
        assert_eq!(middle([f64::NAN].into_iter()), 0.0);
    }
}
