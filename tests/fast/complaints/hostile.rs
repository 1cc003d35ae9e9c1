//! Texts made to break the reader.

use super::*;

#[test]
fn nothing_hostile_in_an_expression_hangs() {
    let with = |text: &str| said(BASE.replace("-9.81", &format!("{text:?}")).as_bytes(), &[]);
    let begin = |text: String| text.chars().take(60).collect::<String>();
    for (text, words) in [
        (
            format!("={}", "(".repeat(1_000_000)),
            "an expression has at most 4096 characters",
        ),
        (
            format!("={}1{}", "(".repeat(2000), ")".repeat(2000)),
            "nested more than 64 deep",
        ),
        (
            format!("={}", "2^".repeat(2000)),
            "nested more than 64 deep",
        ),
        (
            format!("=2{}", "^2".repeat(60)),
            "the result is too large for a double",
        ),
    ] {
        let said = with(&text);
        assert!(
            said.len() == 1 && said[0].ends_with(words),
            "{}: {:?}",
            begin(text),
            said.into_iter().map(begin)
        );
    }
    // a chain and a circle of a hundred thousand
    for last in ["1", "\"=p0\""] {
        let chain: String = (0..100_000)
            .map(|index| format!("\"p{index}\": \"=p{}+p{}\", ", index + 1, index + 1))
            .collect();
        let text = BASE
            .replace(
                "\"name\": \"four-bar and slider\"",
                &format!("\"parameters\": {{ {chain} \"p100000\": {last} }}"),
            )
            .replace("-9.81", "\"=p99990\"");
        let said = said(text.as_bytes(), &[]);
        assert_eq!(said.len(), 1, "{last}");
        let words = if last == "1" {
            "the result is too large for a double"
        } else {
            "p0 → p1 → p2 → p3 → p4 → p5 → p6 → p7 → … → p0"
        };
        assert!(said[0].contains(words), "{}", said[0]);
    }
}

/// Whatever comes, every complaint has words.
fn survives(text: &[u8]) {
    if let Err(complaints) = linkdyn_model::load(text, &[]) {
        assert!(!complaints.is_empty());
        assert!(
            complaints
                .iter()
                .all(|complaint| !complaint.message.is_empty())
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_make_it_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        survives(&bytes);
    }

    #[test]
    fn no_mutation_of_a_model_makes_it_panic(
        at in 0..BASE.len(), length in 0usize..40, insert in "[\\[\\]{}\":,=.0-9a-zé\\\\ -]{0,12}"
    ) {
        let mut bytes = BASE.as_bytes().to_vec();
        let end = (at + length).min(bytes.len());
        bytes.splice(at..end, insert.into_bytes());
        survives(&bytes);
    }

    #[test]
    fn no_value_in_place_of_another_makes_it_panic(which in 0usize..400, kind in 0usize..9) {
        let values = ["null", "true", "-1", "1e308", "\"\"", "\"5 mm\"", "[]", "{}", "[{\"type\": 1}, 2]"];
        let mut model: serde_json::Value = serde_json::from_str(BASE).unwrap();
        let mut left = which;
        replace(&mut model, &mut left, &serde_json::from_str(values[kind]).unwrap());
        survives(model.to_string().as_bytes());
    }

    #[test]
    fn no_expression_makes_it_panic(
        one in "[-+*/^(),.0-9a-e πµ°²=]{0,24}", two in "([-+*/^(,]|sin\\(|min\\(|sqrt\\(|a|b|pi|2|0\\.5|3 mm|1e3 N/m|\\)| ){0,12}"
    ) {
        let mut model: serde_json::Value = serde_json::from_str(BASE).unwrap();
        model["parameters"] = serde_json::json!({ "a": "2 mm", "b": format!("={two}"), "c": format!("={one}") });
        model["bodies"]["rocker"]["points"]["B"] = serde_json::json!([format!("={one}"), format!("={two}")]);
        survives(model.to_string().as_bytes());
        if let Ok(loaded) = linkdyn_model::load(model.to_string().as_bytes(), &[]) {
            prop_assert!(loaded.model.bodies["rocker"].points["B"].iter().all(|value| value.is_finite()));
        }
    }

    #[test]
    fn no_set_makes_it_panic(set in "[a-z.\\[\\]=0-9{}\": ]{0,40}", path in "(joints|bodies|analysis|units)(\\.[a-e]|\\[[0-2]\\]){0,4}=") {
        for set in [set.clone(), path + &set] {
            let _ = linkdyn_model::load(BASE.as_bytes(), &[set]);
        }
    }
}

/// Replaces the value that `left` counts down to.
fn replace(value: &mut serde_json::Value, left: &mut usize, by: &serde_json::Value) {
    if *left == 0 {
        *value = by.clone();
    }
    *left = left.wrapping_sub(1);
    match value {
        serde_json::Value::Array(items) => {
            items.iter_mut().for_each(|item| replace(item, left, by))
        }
        serde_json::Value::Object(members) => members
            .values_mut()
            .for_each(|member| replace(member, left, by)),
        _ => {}
    }
}
