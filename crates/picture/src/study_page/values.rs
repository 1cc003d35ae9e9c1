//! Rows and motions as compact numbers: binary32 of the difference from a middle, which has seven digits of what varies.

use serde_json::{Value, json};

use super::parts::{Motion, StudyPage, Variable, most_instants};

/// Size of a number \[bytes\].
const BYTES: usize = 4;
/// Columns of a row besides its values: its number in two parts, and its reason.
const OWN: usize = 3;
/// Numbers of variants are split here, so that both parts are exact.
const PART: u64 = 1 << 20;
/// With fewer instants a motion jerks.
pub const FEWEST_INSTANTS: usize = 24;

/// Size of a row \[bytes\].
pub fn row_bytes(columns: usize) -> usize {
    BYTES * (OWN + columns)
}

/// Size of an instant of a motion \[bytes\].
pub fn instant_bytes(bodies: usize) -> usize {
    BYTES * (1 + 3 * bodies)
}

/// The numbers of a page.
#[derive(Debug, Default)]
pub struct Values {
    bytes: Vec<u8>,
}

impl Values {
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    fn push(&mut self, value: f64) {
        let value = value as f32;
        let value = if value.is_finite() { value } else { f32::NAN };
        self.bytes.extend(value.to_le_bytes());
    }

    /// Column after column; tells the middle of each variable.
    pub fn rows(&mut self, page: &StudyPage, reasons: &[&str]) -> Vec<f64> {
        for row in &page.rows {
            self.push((row.number / PART) as f64);
        }
        for row in &page.rows {
            self.push((row.number % PART) as f64);
        }
        for row in &page.rows {
            let of = |reason: &str| reasons.iter().position(|known| *known == reason);
            // reasons beyond those that are listed have one number
            let number = row.reason.as_deref();
            let number = number.map_or(0, |reason| 1 + of(reason).unwrap_or(reasons.len()));
            self.push(number as f64);
        }
        let variables = page.inputs.iter().chain(&page.responses);
        let column = |(k, _): (usize, &Variable)| {
            let values = page.rows.iter().map(|row| row.values[k]);
            let middle = middle(values.clone());
            values.for_each(|value| self.push(value - middle));
            middle
        };
        variables.enumerate().map(column).collect()
    }

    /// Motion after motion: the numbers of its shape that vary, then its instants. Says what of them the page must know.
    pub fn motions(&mut self, motions: &[Motion]) -> Value {
        let Some(first) = motions.first() else {
            return json!([]);
        };
        let leaves: Vec<Vec<(String, f64)>> = motions
            .iter()
            .map(|motion| numbers(&motion.shape.to_json()))
            .collect();
        let alike = |one: &[(String, f64)]| {
            one.len() == leaves[0].len() && one.iter().zip(&leaves[0]).all(|(a, b)| a.0 == b.0)
        };
        let kept: Vec<usize> = (0..motions.len()).filter(|&k| alike(&leaves[k])).collect();
        let varies = |&place: &usize| {
            let value = |k: &usize| leaves[*k][place].1.to_bits();
            kept.iter().any(|k| value(k) != value(&0))
        };
        let varying: Vec<usize> = (0..leaves[0].len()).filter(varies).collect();
        let bodies = first.shape.bodies.len().saturating_sub(1);
        let most = most_instants(kept.len(), bodies);
        let list = kept.iter().map(|&k| {
            let motion = &motions[k];
            for &place in &varying {
                self.push(leaves[k][place].1);
            }
            let instants = evenly(motion.times.len(), most);
            for &instant in &instants {
                self.push(motion.times[instant]);
                let from = 3 * bodies * instant;
                let poses = &motion.poses[from..from + 3 * bodies];
                poses.iter().for_each(|value| self.push(*value));
            }
            json!([motion.variant, instants.len()])
        });
        let list: Value = list.collect();
        let paths = varying.iter().map(|&place| leaves[0][place].0.as_str());
        json!({ "list": list, "varying": paths.collect::<Vec<_>>(), "bodies": bodies })
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

/// All numbers below `count`, or so many of them, evenly spread, both ends included.
fn evenly(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|k| k * (count - 1) / (most - 1)).collect()
}

/// All numbers of a value, each with its path.
fn numbers(value: &Value) -> Vec<(String, f64)> {
    fn walk(value: &Value, path: &str, found: &mut Vec<(String, f64)>) {
        match value {
            Value::Number(number) => found.push((path.into(), number.as_f64().unwrap_or(f64::NAN))),
            Value::Array(list) => {
                for (k, value) in list.iter().enumerate() {
                    walk(value, &format!("{path}/{k}"), found);
                }
            }
            Value::Object(fields) => {
                for (key, value) in fields {
                    walk(value, &format!("{path}/{key}"), found);
                }
            }
            Value::Null | Value::Bool(_) | Value::String(_) => {}
        }
    }
    let mut found = Vec::new();
    walk(value, "", &mut found);
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Body, Shape};

    fn motion(variant: Option<u64>, length: f64) -> Motion {
        let body = |name: &str, x: f64| Body {
            name: name.into(),
            points: vec![("A".into(), x, 0.0)],
            com: None,
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
    fn of_a_shape_only_what_varies_is_told_again() {
        let mut values = Values::default();
        let told = values.motions(&[motion(None, 1.0), motion(Some(3), 2.0)]);
        assert_eq!(told["varying"], json!(["/bodies/1/points/0/1"]));
        assert_eq!(told["list"], json!([[null, 121], [3, 121]]));
        let length = 2 * (BYTES + 121 * instant_bytes(1));
        assert_eq!(values.bytes().len(), length);
        let first: Vec<f32> = values.bytes()[..20]
            .chunks(4)
            .map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]]))
            .collect();
        assert_eq!(first, [1.0, 0.0, 0.0, 1.0, 2.0]);
    }

    #[test]
    fn middles_have_all_digits_of_what_varies() {
        assert_eq!(middle([f64::NAN, 2.0, 4.0].into_iter()), 3.0);
        assert_eq!(middle([f64::NAN].into_iter()), 0.0);
        assert_eq!(evenly(5, 3), [0, 2, 4]);
    }
}
