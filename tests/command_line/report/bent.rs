//! Elastic links bend on the page.

use super::*;

const STRIP: &str = r#"{ "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "strip": { "points": { "A": [0, 0], "B": [1, 0] }, "elastic": { "from": "A", "to": "B", "frame": "tangent", "modes": 2,
      "section": { "type": "rectangle", "width": 0.02, "height": 0.005 }, "material": "steel" } } },
  "joints": { "clamp": { "type": "fixed", "between": ["ground.O", "strip.A"] } },
  "points": ["strip.B"], "analysis": { "type": "dynamics", "end": 0.5, "outputs": 101 } }"#;

/// The largest deflection is about a tenth of the length until the reader asks for the true one; points are where they are.
#[test]
fn an_elastic_link_bends() {
    let scratch = Scratch::new("bent");
    let file = scratch.0.join("strip.json");
    fs::write(&file, STRIP).expect("written");
    let (page, csv, _) = run(&[file.to_str().expect("a path")]);
    let script = "// Elastic links as they bend";
    assert!(page.contains(script) && !run(&["four-bar"]).0.contains(script));

    let (heads, rows) = cells(&csv);
    let column = heads.iter().position(|head| *head == "strip.B.y[m]");
    let column = column.expect("a column");
    let tip = |row: &Vec<Option<f64>>| row[column].expect("a number").abs();
    let largest = rows.iter().map(tip).fold(0.0, f64::max);
    assert!((0.1 / 5.0..0.1 / 2.0).contains(&largest), "{largest}");

    let Some(browser) = find() else { return };
    let script = include_str!("bent.js");
    let (told, visit) = ask(&browser, &page, script, Some(8000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let number = |key: &str| told[key].as_f64().expect("a number");
    assert!((number("place") + tip(&rows[20])).abs() < 1e-9, "{told:#}");
    for (key, factor, text) in [
        ("enlarged", 2.0, "deflection × 2"),
        ("true", 1.0, "deflection × 1"),
    ] {
        let lowest = told[key]["lowest"].as_f64().expect("a number");
        assert!((lowest - factor * tip(&rows[20])).abs() < 1e-4, "{told:#}");
        assert_eq!(told[key]["text"], text, "{told:#}");
    }
}

#[test]
fn chains_have_places_and_modes_bend_links() {
    let scratch = Scratch::new("bent-chain");
    let file = scratch.0.join("strip.json");
    let chain = STRIP.replace(r#""frame": "tangent", "modes": 2"#, r#""elements": 4"#);
    fs::write(&file, chain).expect("written");
    let (page, ..) = run(&[file.to_str().expect("a path")]);
    let bending = &data(&page)["mechanism"]["bodies"][1]["bending"];
    let places = json!([[0.0, 0.0], [0.25, 0.0], [0.5, 0.0], [0.75, 0.0], [1.0, 0.0]]);
    assert_eq!(bending["places"], places);

    fs::write(&file, STRIP).expect("written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("modes").arg(&file).arg("-o").arg(&scratch.0);
    let output = command.stdin(Stdio::null()).output();
    assert!(output.expect("the binary runs").status.success());
    let page = fs::read_to_string(scratch.0.join("modes.html")).expect("a page");
    // Nothing else can move.
    assert_eq!(page.matches("<animate attributeName=\"points\"").count(), 2);
}
