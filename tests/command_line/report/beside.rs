//! What stands beside a plot has the unit of its axis; what stands beside the cursor leaves free what it is about.

use super::*;

#[test]
fn values_beside_an_axis_have_its_unit_and_tips_leave_the_cursor_free() {
    let Some(browser) = find() else { return };
    let (page, _, _) = run(&["lock"]);
    let script = include_str!("beside.js");
    for size in [[1440, 900], [1024, 600], [390, 500]] {
        let (told, visit) = ask_in(&browser, &page, script, Some(4000), size);
        assert!(visit.console.is_empty(), "{:#?}", visit.console);
        let chip = told["chip"].as_str().expect("a text");
        assert!(chip.ends_with(" N"), "{told:#}");
        assert!(told["largest"].as_f64() > Some(1e4), "{told:#}");
        // The table stands alone: thousands are easier to read.
        assert!(
            told["table"]
                .as_str()
                .is_some_and(|text| text.ends_with(" kN")),
            "{told:#}"
        );
        assert_eq!(told["shown"], json!([true, true]), "{told:#}");
        assert_eq!(told["covered"], json!([false, false]), "{size:?}: {told:#}");
    }
}
