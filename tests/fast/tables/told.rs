//! Exact texts.

use super::*;

/// A table without fault.
const SOUND: &str = r#"{ "points": [["0 rad", "0 N*m"], ["1 rad", "1 N*m"]] }"#;

/// A table, the torque, and what is said.
const FAULTS: &[(&str, &str, &str)] = &[
    (
        "{}",
        "",
        r#"tables.gas: "points" is missing (as in "points": [["0 deg", "30 bar"], ["90 deg", "5 bar"]], or "file": "gas.csv")"#,
    ),
    (
        r#"{ "points": [["0 rad", "1 N*m"]] }"#,
        "",
        r#"tables.gas.points: a table has 2 to 100000 points, this one has 1 (as in [["0 deg", "30 bar"], ["90 deg", "5 bar"]])"#,
    ),
    (
        r#"{ "points": [["0 rad", "1 N*m"], ["1 rad"]] }"#,
        "",
        "tables.gas.points[1]: a list of 2 is expected, this one has 1",
    ),
    (
        r#"{ "points": [["0 rad", "1 N*m"], ["0 rad", "2 N*m"]] }"#,
        "",
        r#"tables.gas.points[1][0]: "0 rad": the place is not beyond that of the point before (the places of a table increase)"#,
    ),
    (
        r#"{ "points": [["0 rad", "1 N*m"], ["1 mm", "2 N*m"]] }"#,
        "",
        r#"tables.gas.points[1][0]: "1 mm": this is a length [m], where an angle [rad] is wanted"#,
    ),
    (
        r#"{ "points": [["0 rad", "1 N*m"], [1, "2 N*m"]] }"#,
        "",
        r#"tables.gas.points[1][0]: 1: a plain number, where an angle [rad] is wanted as in the other entries (give it a unit, or the column one by "units")"#,
    ),
    (
        r#"{ "points": [["0 rad", "1,5 N*m"], ["1 rad", "2 N*m"]] }"#,
        "",
        r#"tables.gas.points[0][1]: "1,5 N*m": a number has no comma (a decimal point is a point: "1.5 N*m")"#,
    ),
    (
        r#"{ "points": [["0 rad", "high"], ["1 rad", "2 N*m"]] }"#,
        "",
        r#"tables.gas.points[0][1]: "high": this does not begin with a number (a number, or text such as "5 bar")"#,
    ),
    (
        r#"{ "points": [["0 rad", "1 Nm*"], ["1 rad", "2 N*m"]] }"#,
        "",
        r#"tables.gas.points[0][1]: "1 Nm*": "Nm*" cannot be read as a unit"#,
    ),
    (
        r#"{ "points": [[0, 1], [1, 2]], "units": ["deg", "bur"] }"#,
        "",
        r#"tables.gas.units[1]: "bur": unknown unit "bur" (did you mean "bar"?)"#,
    ),
    (
        r#"{ "points": [[0, 1], [1, 2]], "units": ["deg", "N*m"], "interpolation": "cubic" }"#,
        "",
        r#"tables.gas.interpolation: "cubic": unknown interpolation (one of "natural", "linear", "monotone" or "periodic")"#,
    ),
    (
        r#"{ "points": [[0, 1], [1, 2]], "units": ["rad", "N*m"], "interpolation": "periodic" }"#,
        "",
        r#"tables.gas.points[1][1]: 2: the last value of a table that repeats is not its first (the last point is the first one of the next period)"#,
    ),
    (
        r#"{ "points": [[0, 1], [1, 2]], "units": ["rad", "N*m"], "interpolation": "natural", "period": 3 }"#,
        "",
        r#"tables.gas.interpolation: "natural": a natural spline has ends, and does not repeat ("periodic" is the spline that does)"#,
    ),
    (
        r#"{ "points": [[0, 1], [4, 2]], "units": ["rad", "N*m"], "period": 3 }"#,
        "",
        "tables.gas.period: 3: the points go further than one period (leave out those that come again)",
    ),
    (
        r#"{ "points": [[0, 1], [4, 2]], "units": ["rad", "N*m"], "period": -3 }"#,
        "",
        "tables.gas.period: -3: must be greater than 0 (after which the table repeats)",
    ),
    (
        r#"{ "points": [[0, 1], [1, 2]], "units": ["m", "N*m"] }"#,
        "",
        r#"forces.m.value: "=gas(rotor.angle)": this table takes a length [m], not an angle [rad]"#,
    ),
    (
        r#"{ "points": [[0, 1], [1, 2]], "units": ["rad", "N"] }"#,
        "",
        r#"forces.m.value: "=gas(rotor.angle)": this is a force [N], where a torque [N*m] is wanted (its factors carry units, as in -0.5 N*s/m * slider.vx)"#,
    ),
    (
        SOUND,
        "=gas(rotor.angle, 2)",
        "forces.m.value: \"=gas(rotor.angle, 2)\": gas takes 1 value, here it has 2",
    ),
    (
        SOUND,
        "=gaz(rotor.angle)",
        r#"forces.m.value: "=gaz(rotor.angle)": there is no function "gaz" (did you mean "gas"?)"#,
    ),
    (
        SOUND,
        r#"{ "of": "rotor.x", "points": [["0 rad", "1 N*m"], ["1 rad", "2 N*m"]] }"#,
        r#"forces.m.value.of: "rotor.x": this is a length [m], where the places of the table are an angle [rad]"#,
    ),
    (
        SOUND,
        r#"{ "of": "rotor.angle", "points": [["0 rad", "1 N"], ["1 rad", "2 N"]] }"#,
        "forces.m.value: the table gives a force [N], where a torque [N*m] is wanted",
    ),
    (
        SOUND,
        r#"{ "of": "1 rad", "points": [["0 rad", "1 N*m"], ["1 rad", "2 N*m"]] }"#,
        r#"forces.m.value.of: "1 rad": nothing moves here (as in "of": "crank.angle")"#,
    ),
    (
        SOUND,
        r#"{ "of": "rotor.angel", "points": [["0 rad", "1 N*m"], ["1 rad", "2 N*m"]] }"#,
        r#"forces.m.value.of: "rotor.angel": there is no parameter, and nothing that moves, called "rotor.angel" (did you mean "rotor.angle"?)"#,
    ),
    (
        SOUND,
        r#"{ "of": "rotor.angle", "type": "table", "points": [["0 rad", "1 N*m"], ["1 rad", "2 N*m"]] }"#,
        r#"forces.m.value.type: "type": a table over what moves has no type, a motion over time has no "of""#,
    ),
];

#[test]
fn faults_of_tables_are_told_in_their_place() {
    let mut wrong = String::new();
    for &(of, value, expected) in FAULTS {
        let table: Value = serde_json::from_str(of).expect("JSON");
        let value = match value {
            "" => json!("=gas(rotor.angle)"),
            text if text.starts_with('{') => serde_json::from_str(text).expect("JSON"),
            text => json!(text),
        };
        let model = rotor(value, json!({ "gas": table })).to_string();
        let said = linkdyn_model::load(model.as_bytes(), &[]).expect_err(expected);
        let text = said[0].to_string();
        let text = text.split_once(": ").map_or("", |(_, said)| said);
        if text != expected {
            wrong += &format!("{expected}\n    {text}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn names_of_tables_are_those_of_functions() {
    let told = |name: &str| {
        let points = json!({ "points": [["0 rad", "0 N*m"], ["1 rad", "1 N*m"]] });
        let mut model = rotor(json!(1.0), json!({ name: points }));
        model["parameters"] = json!({ "peak": 1 });
        let read = linkdyn_model::load(model.to_string().as_bytes(), &[]);
        match read {
            Ok(loaded) => loaded.warnings[0].clone(),
            Err(said) => said[0].to_string(),
        }
    };
    let said = |name: &str| {
        told(name)
            .split_once(": ")
            .map(|(_, said)| said.to_owned())
            .unwrap_or_default()
    };
    assert_eq!(
        said("sin"),
        r#"tables.sin: "sin" is a function already (give the table another name)"#
    );
    assert_eq!(
        said("max"),
        r#"tables.max: "max" is a function already (give the table another name)"#
    );
    assert_eq!(
        said("gas force"),
        r#"tables.gas force: "gas force" can't be called in a formula (letters, digits and _, a letter first)"#
    );
    assert_eq!(
        said("peak"),
        r#"tables.peak: "peak": there is a parameter "peak", too (give one of them another name)"#
    );
    assert!(
        told("gas").ends_with("tables.gas: no formula calls this table"),
        "{}",
        told("gas")
    );
}
