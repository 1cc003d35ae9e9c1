//! Files that somebody spoiled: they are refused with a complaint, or are what they print.

use super::*;

/// What is put somewhere.
const ODD: [&str; 18] = [
    "null",
    "true",
    "0",
    "-1",
    "1e308",
    "\"\"",
    "\"=l2\"",
    "\"=1/0\"",
    "\"2 %\"",
    "\"-3 mm\"",
    "\"20 H7/g6\"",
    "[]",
    "[1]",
    "[\"1 %\", 2]",
    "[2, 1]",
    "{}",
    "{ \"value\": 1 }",
    "{ \"position\": [0, 0], \"tolerance\": 1 }",
];

/// All values of a tree, by their paths.
fn places(value: &Value, path: &str, found: &mut Vec<String>) {
    found.push(path.to_owned());
    match value {
        Value::Object(members) => {
            for (key, one) in members {
                places(one, &format!("{path}/{key}"), found);
            }
        }
        Value::Array(items) => {
            for (index, one) in items.iter().enumerate() {
                places(one, &format!("{path}/{index}"), found);
            }
        }
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

#[test]
fn what_loads_is_what_it_prints() {
    let file: Value = serde_json::from_str(FILE).unwrap();
    let mut found = Vec::new();
    places(&file, "", &mut found);
    let (mut loaded, mut refused) = (0, 0);
    for place in &found {
        for odd in ODD {
            let mut spoiled = file.clone();
            *spoiled.pointer_mut(place).unwrap() = serde_json::from_str(odd).unwrap();
            match load(spoiled.to_string().as_bytes(), &[]) {
                Ok(one) => {
                    loaded += 1;
                    let printed = one.source.print(&one.model);
                    let again = load(printed.to_string().as_bytes(), &[])
                        .unwrap_or_else(|said| panic!("{place} = {odd}: {said}\n{printed:#}"));
                    assert_eq!(
                        again.model.into_model(),
                        one.model.into_model(),
                        "{place} = {odd}"
                    );
                    one.source.derivatives();
                    one.source.dependence().within(&[[-1e-3, 1e-3]; 7]);
                }
                Err(said) => {
                    refused += 1;
                    assert!(
                        !said.is_empty() && !said[0].message.is_empty(),
                        "{place} = {odd}"
                    );
                }
            }
        }
    }
    assert!(
        loaded > 200 && refused > 2000,
        "{loaded} loaded, {refused} refused"
    );
}
