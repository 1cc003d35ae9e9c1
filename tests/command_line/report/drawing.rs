//! The drawing and its controls.

use super::*;

/// Every pose that the page shows is the one of the file, to the last digit.
fn expect_poses(told: &Value, heads: &[&str], rows: &[Vec<Option<f64>>]) {
    for row in [0, 90, rows.len() - 1] {
        let bodies = told["poses"][row.to_string()].as_array().expect("poses");
        assert_eq!(bodies.len(), 3, "{bodies:?}");
        for body in bodies {
            let name = body[0].as_str().expect("a name");
            for (k, quantity) in ["x[m]", "y[m]", "angle[rad]"].iter().enumerate() {
                let column = heads
                    .iter()
                    .position(|head| *head == format!("{name}.{quantity}"))
                    .expect("a column");
                assert_eq!(
                    body[k + 1].as_f64(),
                    rows[row][column],
                    "{name}.{quantity} in row {row}"
                );
            }
        }
    }
}

#[test]
fn the_controls_move_the_mechanism() {
    let Some(browser) = find() else { return };
    let (page, csv, _) = run(&["four-bar"]);
    let (told, visit) = ask(
        &browser,
        &page,
        include_str!("../report/controls.js"),
        Some(12_000),
    );
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let (heads, rows) = cells(&csv);
    let last = rows.len() - 1;
    assert_eq!(told["rows"], json!(rows.len()));
    expect_poses(&told, &heads, &rows);
    assert!(
        told["inked"].as_u64() > Some(5000) && told["same"] == true && told["moves"] == true,
        "{told:#}"
    );
    let plots = told["plots"].as_array().expect("plots");
    assert!(
        plots.len() >= 4 && plots.iter().all(|plot| plot["built"] == true),
        "{plots:?}"
    );
    let number = |key: &str| {
        told[key]
            .as_u64()
            .unwrap_or_else(|| panic!("{key} in {told:#}")) as usize
    };
    assert!(number("played") > 5 && number("played") < last, "{told:#}");
    assert_eq!(number("stopped"), number("later"));
    assert_eq!(
        (number("right"), number("left"), number("end")),
        (11, 1, last)
    );
    assert_eq!(told["units"], "si");
    assert!(
        told["si"].as_str().expect("text").ends_with(" m") || told["si"] == "0 m",
        "{told:#}"
    );
    assert_eq!(told["dark"], "dark");
    assert!(number("hovered").abs_diff(last / 2) <= 1, "{told:#}");
    for line in told["lines"].as_array().expect("lines") {
        assert!(
            (line.as_f64().expect("a place") - 1.0).abs() < 0.01,
            "{told:#}"
        );
    }
    for range in told["zoomed"].as_array().expect("ranges") {
        assert_eq!(range, &json!([0.2, 0.4]));
    }
    assert_eq!(told["over"], "motor", "one driver that goes one way");
    // The driver's value in degrees.
    let value = heads
        .iter()
        .position(|head| *head == "driver.motor.value[rad]")
        .expect("a column");
    for (k, row) in [0, last].into_iter().enumerate() {
        let expected = rows[row][value].expect("a value").to_degrees();
        assert!(
            (told["across"][k].as_f64().expect("a bound") - expected).abs() < 1e-9 * expected.abs(),
            "{told:#}"
        );
    }
    assert_eq!(told["arrows"], true, "the arrows are not drawn");
}

/// Names that wrap have lines of their own; lengths are in the unit that suits them; settings have units; columns are those of
/// the file.
#[test]
fn what_stands_beside_the_drawing_can_be_read() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("long-names");
    let path = scratch.0.join("model.json");
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/models/four-bar.json"))
        .expect("bundled");
    let long = text
        .replace("\"P\"", "\"outer_ball_joint_front_left_point\"")
        .replace("coupler.P", "coupler.outer_ball_joint_front_left_point");
    fs::write(&path, long.replace("coupler", "left_upper_control_arm")).expect("written");
    let sample = r#"analysis={"type":"inverse_dynamics","sample":{"driver":"motor","from":"60 deg","to":"160 deg","step":"1 deg"}}"#;
    let (page, csv, _) = run(&[path.to_str().expect("UTF-8"), "--set", sample]);
    let probe = "linkdyn.drawer.open = true; const boxes = [...document.querySelectorAll('#traces label')].map((label) => label.getBoundingClientRect()); \
        const units = linkdyn.units, lengths = () => [1e-5, 2e-3, 0.5, 1, 10, 2000].map(units.length); \
        const engineering = lengths(); units.system = 'si'; const si = lengths(); units.system = 'engineering'; \
        const cell = (head) => [...document.querySelectorAll('#tables th')].find((th) => th.textContent === head)?.nextSibling.textContent; \
        answer({ over: boxes.filter((box, k) => k && box.top < boxes[k - 1].bottom - 0.5).length, engineering, si, \
        wrapped: boxes.filter((box) => box.height > 30).length, from: cell('sample from'), analysis: document.getElementById('line').textContent });";
    let (told, visit) = ask(&browser, &page, probe, Some(1000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert!(
        told["wrapped"].as_u64() > Some(0) && told["over"] == 0,
        "{told:#}"
    );
    assert_eq!(
        told["engineering"],
        json!(["10 µm", "2 mm", "500 mm", "1 m", "10 m", "2000 m"])
    );
    assert_eq!(
        told["si"],
        json!(["1e−5 m", "0.002 m", "0.5 m", "1 m", "10 m", "2000 m"])
    );
    assert_eq!(told["from"], "60°");
    let columns = format!(", {} columns", cells(&csv).0.len());
    assert!(
        told["analysis"]
            .as_str()
            .is_some_and(|text| text.ends_with(&columns)),
        "{told:#}, {columns}"
    );
}
