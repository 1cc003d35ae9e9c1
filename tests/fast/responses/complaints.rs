//! What is said of responses that can't be read: place, cause, mend.

use super::{model, with_responses};
use linkdyn_engine::analysis::Prepared;
use linkdyn_model::load;

/// What stands at the name `a`, and all that is said.
const CASES: &[(&str, &str)] = &[
    (
        r##""max(pistn.x)""##,
        r##"line 1, column 28: responses.a: "max(pistn.x)": there is no column, parameter or number "pistn.x" (did you mean "piston.x"?)"##,
    ),
    (
        r##""piston.x""##,
        r##"line 1, column 24: responses.a: "piston.x": this has many values: which one of them? (max( … ), mean( … ), last( … ), or at( … , driver.NAME = value))"##,
    ),
    (
        r##""max(piston.x) + max(rod.angle)""##,
        r##"line 1, column 38: responses.a: "max(piston.x) + max(rod.angle)": a length [m] and an angle [rad] can't be added"##,
    ),
    (
        r##""max(5 mm)""##,
        r##"line 1, column 24: responses.a: "max(5 mm)": max takes what changes along the run, this is one number (such as a column: rod.angle, driver.motor.effort)"##,
    ),
    (
        r##""""##,
        r##"line 1, column 23: responses.a: "": the text is empty (as in "max(piston.x) - min(piston.x)")"##,
    ),
    (
        r##""at(piston.x, 3)""##,
        r##"line 1, column 24: responses.a: "at(piston.x, 3)": at takes an expression and an equation (as in at(rod.angle, driver.motor = 90 deg))"##,
    ),
    (
        r##""at(piston.x, driver.motor = 5 mm)""##,
        r##"line 1, column 50: responses.a: "at(piston.x, driver.motor = 5 mm)": an angle [rad] and a length [m] can't be compared"##,
    ),
    (
        r##""at(piston.x, driver.motor = 125)""##,
        r##"line 1, column 50: responses.a: "at(piston.x, driver.motor = 125)": an angle [rad] and a plain number can't be compared (a number gets a unit as in 2 rad)"##,
    ),
    (
        r##""max(piston.x = 3 mm)""##,
        r##"line 1, column 28: responses.a: "max(piston.x = 3 mm)": there is no place for an equation here (an equation stands in at( … , column = value) or count(column = value))"##,
    ),
    (
        r##""sum(piston.x)""##,
        r##"line 1, column 24: responses.a: "sum(piston.x)": sum takes contacts or events; a sum of rows would depend on how many there are (over time write integral( … ))"##,
    ),
    (
        r##""count(piston.x)""##,
        r##"line 1, column 24: responses.a: "count(piston.x)": count takes contacts, events or an equation (as in count(events.contact) or count(piston.x = 20 mm))"##,
    ),
    (
        r##""integral(contacts.impulse)""##,
        r##"line 1, column 24: responses.a: "integral(contacts.impulse)": integral takes columns, not contacts or events (of these there are max, min, mean, range, first, last, count and sum)"##,
    ),
    (
        r##""contacts.impulse""##,
        r##"line 1, column 24: responses.a: "contacts.impulse": this has many values: which one of them? (max( … ), sum( … ) or count( … ))"##,
    ),
    (
        r##""max(piston.x - mean(piston.x))""##,
        r##"line 1, column 39: responses.a: "max(piston.x - mean(piston.x))": this is known at the end only, and can't be taken into account row by row (a number of the run stands outside of max( … ) and the like)"##,
    ),
    (
        r##""max(rod.B.x)""##,
        r##"line 1, column 28: responses.a: "max(rod.B.x)": the motion of rod.B is not among the results (write "rod.B" into "points")"##,
    ),
    (
        r##""maxx(piston.x)""##,
        r##"line 1, column 24: responses.a: "maxx(piston.x)": there is no function "maxx" (did you mean "max"?)"##,
    ),
    (
        r##""max(piston.x""##,
        r##"line 1, column 27: responses.a: "max(piston.x": this "(" is not closed"##,
    ),
    (
        r##""max(piston.x) = 3 mm""##,
        r##"line 1, column 38: responses.a: "max(piston.x) = 3 mm": "=" where an operator is expected (an equation stands in at( … , column = value) or count(column = value))"##,
    ),
    (
        r##""at(piston.x, driver.motor == 90 deg)""##,
        r##"line 1, column 50: responses.a: "at(piston.x, driver.motor == 90 deg)": unknown operator "==" (an equation is written with one =)"##,
    ),
    (
        r##""max(piston.x) max(piston.y)""##,
        r##"line 1, column 38: responses.a: "max(piston.x) max(piston.y)": "m" where an operator is expected (a product is written with *)"##,
    ),
    (
        r##""at(piston.x, 3 mm = 4 mm)""##,
        r##"line 1, column 37: responses.a: "at(piston.x, 3 mm = 4 mm)": no column is in this equation (as in driver.motor = 90 deg)"##,
    ),
    (
        r##""max(piston.x + contacts.impulse)""##,
        r##"line 1, column 39: responses.a: "max(piston.x + contacts.impulse)": this has not as many values as what stands before it (reduce each of them on its own, as in max( … ))"##,
    ),
    (
        r##""max""##,
        r##"line 1, column 24: responses.a: "max": "max" is a function (write max( … ))"##,
    ),
    (
        r##""range(piston.x, rod.angle)""##,
        r##"line 1, column 24: responses.a: "range(piston.x, rod.angle)": range takes 1 value, here it has 2"##,
    ),
    (
        r##""max('left rod.x)""##,
        r##"line 1, column 28: responses.a: "max('left rod.x)": this "'" is not closed"##,
    ),
    (
        r##""count(events.contat)""##,
        r##"line 1, column 30: responses.a: "count(events.contat)": there is no column, parameter or number "events.contat" (did you mean "events.contact"?)"##,
    ),
    (
        r##"5"##,
        r##"line 1, column 23: responses.a: 5: text is expected, not a number (as in "stroke": "max(piston.x) - min(piston.x)")"##,
    ),
    (
        r##"["a"]"##,
        r##"line 1, column 23: responses.a: text is expected, not a list (as in "stroke": "max(piston.x) - min(piston.x)")"##,
    ),
    (
        r##"{"limits": [1, 2]}"##,
        r##"line 1, column 23: responses.a: "value" is missing (as in "value": "max(piston.x) - min(piston.x)")"##,
    ),
    (
        r##"{"value": "max(piston.x)", "limits": [2, 1]}"##,
        r##"line 1, column 60: responses.a.limits: the limits are the wrong way round (the lower limit comes first, as in [79, 81])"##,
    ),
    (
        r##"{"value": "max(piston.x)", "limits": ["2 deg", 1]}"##,
        r##"line 1, column 61: responses.a.limits[0]: "2 deg": this is an angle [rad], where a length [m] is wanted, as the response is"##,
    ),
    (
        r##"{"value": "max(piston.x)", "unit": "deg"}"##,
        r##"line 1, column 58: responses.a.unit: "deg": "deg" is no unit of a length [m], which this is (such as "m")"##,
    ),
    (
        r##"{"value": "max(piston.x)", "unit": "mmm"}"##,
        r##"line 1, column 58: responses.a.unit: "mmm": unknown unit "mmm" (did you mean "mm"?)"##,
    ),
    (
        r##"{"value": "max(piston.x)", "limit": [1, 2]}"##,
        r##"line 1, column 50: responses.a.limit: "limit": unknown key (did you mean "limits"?)"##,
    ),
    (
        r##"{"value": "max(piston.x)", "limits": [1]}"##,
        r##"line 1, column 60: responses.a.limits: a list of 2 is expected, this one has 1"##,
    ),
];

#[test]
fn every_bad_response_is_refused_in_these_words() {
    let mut wrong = String::new();
    for (response, expected) in CASES {
        let text = with_responses(&format!("{{ \"a\": {response} }}"));
        let said = match load(text.as_bytes(), &[]) {
            Ok(_) => "nothing".to_owned(),
            Err(complaints) => complaints.to_string(),
        };
        if said != *expected {
            wrong += &format!("    (r##\"{response}\"##, r##\"{said}\"##),\n");
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn a_response_is_not_called_like_a_parameter() {
    let text = with_responses(r#"{ "r": "max(piston.x)" }"#);
    let said = load(text.as_bytes(), &[]).expect_err("a parameter has this name");
    assert_eq!(
        said.to_string(),
        "line 1, column 18: responses.r: \"r\": a parameter has this name (give the response another name)"
    );
}

#[test]
fn columns_that_the_analysis_lacks_are_refused() {
    let with = model(&["max(driver.motor.effort)"]);
    let with = with.edit(|model| {
        let analysis = model.analysis.as_mut().expect("an analysis");
        analysis.kind = linkdyn_model::AnalysisKind::Kinematics;
    });
    let said = Prepared::new(&with.expect("a model")).expect_err("no efforts");
    assert_eq!(
        said[0].message,
        "this analysis has no column \"driver.motor.effort\""
    );
}
