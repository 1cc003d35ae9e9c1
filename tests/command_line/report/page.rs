//! What stands in the file.

use super::*;

#[test]
fn a_page_needs_nothing_from_outside() {
    let (page, _, summary) = run(&["four-bar"]);
    for word in [
        " src=",
        "<link",
        "@import",
        "url(",
        "fetch(",
        "XMLHttpRequest",
        "WebSocket",
        "innerHTML =",
        "eval(",
    ] {
        let own = page
            .split("/*! https://github.com/leeoniya/uPlot")
            .next()
            .expect("a part");
        let rest = page.split_once("linkdyn = {}").expect("our scripts").1;
        assert!(!own.contains(word) && !rest.contains(word), "{word}");
    }
    let policy = page
        .split("Content-Security-Policy\" content=\"")
        .nth(1)
        .expect("a policy");
    assert!(
        policy.starts_with("default-src 'none'; script-src 'sha256-")
            && !policy.contains("'unsafe"),
        "{policy:.200}"
    );
    let data = data(&page);
    assert_eq!(data["summary"]["model"], summary["model"]);
    assert_eq!(data["summary"]["mobility"], summary["mobility"]);
    assert!(page.contains("Permission is hereby granted, free of charge"));
}

#[test]
fn names_reach_the_page_only_inside_escaped_json() {
    let page = hostile();
    let (before, rest) = page.split_once("id=\"data\">").expect("data");
    let (json, after) = rest.split_once("</script>").expect("an end");
    assert!(!json.contains(['<', '>', '&', '\u{2028}']));
    for text in ["hacked", "onerror", "toString\"", "🔒"] {
        assert!(
            !before.contains(text) && !after.split("uPlot").next().expect("a part").contains(text),
            "{text}"
        );
    }
    assert_eq!(
        data(&page)["mechanism"]["bodies"][1]["name"],
        "<!--<script>"
    );
    assert_eq!(
        data(&page)["about"],
        "<img src=x onerror=\"window.hacked=1\"> & &lt; {{script}}"
    );
}

/// Columns that are not wanted among the results are there for the drawing, and only for it.
#[test]
fn poses_are_there_even_when_the_results_leave_them_out() {
    let (page, csv, _) = run(&["four-bar", "--set", r#"analysis.columns=["driver.*"]"#]);
    assert!(!csv.contains("crank.x"), "{csv:.200}");
    let data = data(&page);
    let columns = data["columns"].as_array().expect("a list");
    assert!(columns.contains(&json!(["crank.x", "m", 0])), "{columns:?}");
    let value = columns
        .iter()
        .find(|column| column[0] == "driver.motor.value")
        .expect("the driver's value");
    assert_eq!(value[2], 1);
}

#[test]
fn a_page_stays_below_five_megabytes_and_says_what_it_leaves_out() {
    for (what, page) in [
        ("10 000 bodies", large(10_000, 101, |k| format!("body {k}"))),
        (
            "long names",
            large(400, 20, |k| format!("{k} {}", "long ".repeat(4000))),
        ),
        ("many rows", large(7, 60_000, |k| format!("body {k}"))),
    ] {
        let data = data(&page);
        println!(
            "{what}: {} bytes, {} rows, {} columns",
            page.len(),
            data["rows"],
            data["columns"].as_array().expect("a list").len()
        );
        assert!(page.len() < 5_000_000, "{what}: {}", page.len());
        assert!(
            !data["notes"].as_array().expect("a list").is_empty(),
            "{what} is cut in silence"
        );
    }
    let small = data(&large(20, 50, |k| format!("body {k}")));
    assert_eq!(
        (&small["notes"], &small["rows"], &small["bytes"]),
        (&json!([]), &json!(50), &json!(8))
    );
}

/// A strut is a spring with a damper beside it; a spring alone has no word about dampers, as before.
#[test]
fn springs_tell_whether_a_damper_stands_beside_them() {
    let strut = data(&run(&["double-wishbone"]).0);
    assert_eq!(strut["mechanism"]["springs"][0]["damped"], true);
    let spring = data(&run(&["andrews-squeezer"]).0);
    let spring = &spring["mechanism"]["springs"][0];
    assert!(
        spring.is_object() && spring.get("damped").is_none(),
        "{spring}"
    );
}
