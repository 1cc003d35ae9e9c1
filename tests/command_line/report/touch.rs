//! What a page tells under the cursor, what a click adds, what can be taken away.

use super::*;

/// The lock: its largest forces are those in g, its torque has a peak at the end of a change point.
fn told() -> Option<Value> {
    let browser = find()?;
    let (page, _, _) = run(&["lock"]);
    let (told, visit) = ask(&browser, &page, include_str!("touch.js"), Some(12_000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    Some(told)
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

fn texts(value: &Value) -> Vec<&str> {
    value.as_array().expect("a list").iter().map(text).collect()
}

#[test]
fn things_answer_the_cursor_and_can_be_taken_away() {
    let Some(told) = told() else { return };
    plots_come_in_order(&told);
    // Under the cursor.
    let pin = text(&told["pin"]);
    assert!(
        pin.starts_with('d') && pin.contains("revolute") && pin.contains(" N"),
        "{pin}"
    );
    let opened = texts(&told["opened"][0]);
    assert!(opened.contains(&"joint.d.f"), "{opened:?}");
    assert_eq!(
        told["opened_twice"], 1,
        "a second click shows the same plot"
    );
    assert!(
        text(&told["body"]).starts_with("link6") && text(&told["body"]).contains("omega"),
        "{told:#}"
    );
    assert_eq!(told["left"], true);
    assert!(
        (590..=610).contains(&told["curve"][0].as_u64().expect("a row")),
        "{told:#}"
    );
    assert!(
        text(&told["curve"][1]).starts_with("driver.motor.effort"),
        "{told:#}"
    );
    // Names.
    assert!(texts(&told["part"]).contains(&"shaking.moment"), "{told:#}");
    assert_eq!(told["pattern"], 7);
    // Taken away.
    for key in ["plot_svg", "pose_svg"] {
        assert_eq!(told[key]["sound"], true, "{key}");
        assert!(told[key]["paths"].as_u64() > Some(8), "{key}: {told:#}");
    }
    assert!(
        texts(&told["plot_svg"]["texts"]).contains(&"driver.motor.effort"),
        "{told:#}"
    );
    assert!(
        texts(&told["pose_svg"]["texts"]).contains(&"link4"),
        "{told:#}"
    );
    // Who looks for a name finds it once: text is not laid over itself.
    for (index, text) in texts(&told["pose_svg"]["texts"]).iter().enumerate() {
        let rest = &texts(&told["pose_svg"]["texts"])[index + 1..];
        assert!(!rest.contains(text), "{text} stands twice: {told:#}");
    }
    // A header, 1751 rows, and what stands behind the last line end.
    assert_eq!(told["csv"], 1753);
    assert!(told["png"].as_u64() > Some(10_000), "{told:#}");
    let instant = told["instant"].as_f64().expect("a time");
    assert!((instant - 1.2).abs() < 2e-3, "{instant}");
    assert_eq!(told["requests"], 0);
}

/// The peaks that an axis leaves out are told, over the driver's value and over time; numbers that matter come first.
fn plots_come_in_order(told: &Value) {
    assert_eq!(told["over"], "driver.motor.value");
    let first = &told["first"];
    assert_eq!(first[0], json!(["driver.motor.effort"]));
    assert_eq!(first[1][0], "joint.g.f", "the largest force: {first}");
    let peaks = texts(&told["peaks"]);
    assert!(peaks.contains(&"628.6 N·m at 125°"), "{peaks:?}");
    // Of the four-bar loop that is flat there no row is the largest.
    assert!(peaks.contains(&"no bound near 117.5°"), "{peaks:?}");
    assert!(!peaks.iter().any(|peak| peak.contains("kN")), "{peaks:?}");
    assert!(
        texts(&told["peaks_in_time"]).contains(&"628.6 N·m at 1.748 s"),
        "{told:#}"
    );
    assert!(told["uncut"].as_f64() > Some(628.0), "{told:#}");
    assert_eq!(
        told["short"][0],
        json!(["Peak driving torque of motor", "628.6 N·m"])
    );
    let extremes = &told["extremes"];
    assert_eq!(extremes[0], "driver.motor.effort");
    // 1e-13 N beside 76 kN.
    assert_eq!([&extremes[1][1], &extremes[1][3]], ["0 N", "0 N"]);
}

/// A film is made by the browser of what the canvas shows: WebM, whose file begins with the mark of EBML (RFC 8794).
#[test]
fn a_film_can_be_taken_away() {
    let Some(browser) = find() else { return };
    let (page, _, _) = run(&["four-bar"]);
    let (told, visit) = ask(&browser, &page, include_str!("film.js"), Some(20_000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert!(text(&told["type"]).starts_with("video/webm"), "{told:#}");
    assert_eq!(told["head"], json!([0x1a, 0x45, 0xdf, 0xa3]), "{told:#}");
    assert!(told["webm"] == true && told["video"] == true, "{told:#}");
    // Pictures that differ: one alone is a few kilobytes.
    assert!(told["size"].as_u64() > Some(20_000), "{told:#}");
    assert!(told["clusters"].as_u64() >= Some(1), "{told:#}");
    // All of the run was played, and the page is as it was.
    assert!(told["shown"].as_u64() > Some(30), "{told:#}");
    assert_eq!((&told["row"], &told["repeats"]), (&json!(7), &json!(true)));
    assert_eq!(told["word"], "Film");
    assert_eq!(told["given"], "Four-bar.webm", "{told:#}");
    assert_eq!(told["requests"], 0);
}
