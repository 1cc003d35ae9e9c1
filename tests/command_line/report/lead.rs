//! A point that is dragged leads the mechanism along its motion.

use super::*;

/// The crank turns more than three times: each place of the path belongs to several instants.
#[test]
fn a_dragged_point_stays_on_its_turn() {
    let Some(browser) = find() else { return };
    let page = run(&["four-bar"]).0;
    let script = include_str!("lead.js");
    let (told, visit) = ask(&browser, &page, script, Some(8000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let number = |key: &str| told[key].as_i64().expect("a number");
    assert!(number("far") <= 3, "{told:#}");
    assert!(number("last") >= number("rows") - 3, "{told:#}");
    assert!((number("back") - number("rows") / 2).abs() <= 3, "{told:#}");
    // Who leads it stops the film, and neither plots nor moves the view.
    assert_eq!(
        (&told["playing"], &told["opened"], &told["moved"]),
        (&json!(false), &json!(0), &Value::Null)
    );
    // Where nothing moves the view is moved.
    assert_eq!(told["kept"], true);
    assert!(told["view"].is_array(), "{told:#}");
}
