//! `report.html` of `linkdyn study`: what is written, and what it shows and does in a browser.

use crate::browser::{Scratch, ask, ask_in, find, sheets};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SCRIPT: &str = include_str!("page.js");
/// A slider-crank whose lengths scatter; its stroke is twice the crank.
const MODEL: &str = include_str!("feeder.json");
/// Largest page \[bytes\].
const LIMIT: usize = 5_000_000;

fn study(scratch: &Scratch, arguments: &[&str]) -> Output {
    fs::write(scratch.0.join("feeder.json"), MODEL).expect("a model");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("study").current_dir(&scratch.0);
    let output = command.args(arguments).stdin(Stdio::null()).output();
    let output = output.expect("the binary runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    output
}

fn page(scratch: &Scratch, arguments: &[&str]) -> String {
    study(
        scratch,
        &[&["feeder.json", "-o", "out"], arguments].concat(),
    );
    fs::read_to_string(scratch.0.join("out/report.html")).expect("a page")
}

/// What the page knows; no number in it is none.
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    let (data, _) = rest.split_once("</script>").expect("an end");
    assert!(!data.contains("NaN") && !data.contains("Infinity"));
    serde_json::from_str(data).expect("JSON")
}

fn summary(scratch: &Scratch) -> Value {
    let text = fs::read(scratch.0.join("out/study.json")).expect("a study");
    serde_json::from_slice(&text).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn a_study_is_written_as_a_page_with_motions() {
    let scratch = Scratch::new("study-page");
    let told = study(
        &scratch,
        &[
            "feeder.json",
            "-o",
            "out",
            "--vary",
            "parameters.crank=20 mm:240 mm:12",
        ],
    );
    let told = String::from_utf8_lossy(&told.stdout).into_owned();
    assert!(told.contains("report.html"), "{told}");
    let page = fs::read_to_string(scratch.0.join("out/report.html")).expect("a page");
    let data = data(&page);
    assert_eq!(data["summary"], summary(&scratch)["summary"]);
    assert_eq!(
        data["units"],
        json!({ "m": ["mm", 1e-3], "rad": ["°", std::f64::consts::PI / 180.0] })
    );
    assert_eq!(data["responses"][0]["shown"], json!(["cm", 0.01]));
    assert_eq!(data["reasons"], json!(["dead_centre"]));
    // All of them and the nominal mechanism; of the model only the crank differs.
    let played: Vec<&Value> = data["played"]["list"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|own| &own[0])
        .collect();
    let expected: Vec<Value> = std::iter::once(Value::Null)
        .chain((0..12).map(|k| json!(k)))
        .collect();
    assert_eq!(json!(played), json!(expected));
    let paths = data["played"]["paths"].as_array().expect("paths").iter();
    let of_model = paths
        .filter_map(Value::as_str)
        .filter(|path| path.starts_with("/mechanism"));
    assert_eq!(
        of_model.collect::<Vec<_>>(),
        ["/mechanism/bodies/1/points/1/1"]
    );
    assert_eq!(data["not_played"], Value::Null);
}

#[test]
fn without_a_page_an_older_one_goes_and_merge_has_no_motions() {
    let scratch = Scratch::new("study-no-page");
    let vary = [
        "feeder.json",
        "-o",
        "out",
        "--vary",
        "parameters.crank=40 mm:60 mm:3",
    ];
    let path = scratch.0.join("out/report.html");
    study(&scratch, &vary);
    assert!(path.exists());
    let table = fs::read(scratch.0.join("out/variants.csv")).expect("a table");
    let told = study(&scratch, &[&vary[..], &["--no-report"]].concat());
    assert!(!path.exists() && !String::from_utf8_lossy(&told.stdout).contains("report.html"));
    study(&scratch, &["merge", "out"]);
    assert_eq!(
        table,
        fs::read(scratch.0.join("out/variants.csv")).expect("a table")
    );
    let merged = data(&fs::read_to_string(&path).expect("a page"));
    assert_eq!(merged["played"], Value::Null);
    let why = merged["not_played"].as_str().expect("a reason");
    assert!(
        why.starts_with("No variant can be played: the chunks were joined without the model."),
        "{why}"
    );
    // The units of the model are kept.
    assert_eq!(merged["units"]["m"], json!(["mm", 1e-3]));
    study(&scratch, &["merge", "out", "--no-report"]);
    assert!(!path.exists());
}

#[test]
fn the_page_shows_samples_and_what_is_pressed_acts() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("study-samples");
    let page = page(&scratch, &["--samples", "2000"]);
    assert!(page.len() < LIMIT, "{}", page.len());
    let (found, visit) = ask(&browser, &page, SCRIPT, Some(6000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert_eq!(
        found["asked"],
        "study of 2\u{202f}000 variants (Monte Carlo, seed 1)"
    );
    let told = &summary(&scratch)["summary"];
    let within = told["within_limits"]["within"].to_string();
    assert_eq!(
        found["tiles"]["within limits"],
        format!("{within} of 2\u{202f}000")
    );
    let mean = 100.0 * number(&told["responses"]["stroke"]["mean"]);
    let first: Vec<&str> = found["responses"][0]
        .as_str()
        .expect("a row")
        .split('|')
        .collect();
    assert_eq!(first[0], "stroke");
    assert!(first[1].ends_with(" cm"), "{first:?}");
    let shown: f64 = first[1].trim_end_matches(" cm").parse().expect("a number");
    assert!((shown / mean - 1.0).abs() < 1e-5, "{shown}: {mean}");
    // Histogram and cloud of each response, matrix, parallel coordinates.
    assert_eq!(found["plots"], 2 * 3 + 2);
    assert_eq!(found["blank"], json!([]));
    acts(&found);
}

/// What brushes, clicks and keys do.
fn acts(found: &Value) {
    let boxed = &found["boxed"];
    assert!(
        number(&boxed["count"]) > 100.0 && number(&boxed["count"]) < 1900.0,
        "{boxed}"
    );
    assert_eq!(boxed["count"], boxed["expected"]);
    let told = format!("{} of 2000 variants selected", boxed["count"]);
    assert_eq!(boxed["told"], told);
    assert_eq!(boxed["unchanged"], json!([]), "all plots show it");
    assert_eq!(found["along"]["count"], found["along"]["expected"]);
    assert!(
        number(&found["along"]["count"]) < number(&boxed["count"]),
        "{found:#}"
    );
    assert_eq!(found["escaped"], json!({ "hidden": true, "count": 2000 }));
    // A click finds a variant near it, and it moves.
    let clicked = &found["clicked"];
    assert!(number(&clicked["row"]) >= 0.0, "{clicked}");
    assert_eq!(clicked["title"], format!("variant {}", clicked["row"]));
    assert_eq!(clicked["moves"], true, "{clicked}");
    let note = clicked["note"].as_str().expect("text");
    assert!(
        note.contains("can be played") || note.contains("the nearest variant that has one"),
        "{note}"
    );
    // Motions have the lengths of their variants.
    assert!(number(&found["lengths"]) < 1e-7, "{found:#}");
    let table = &found["table"];
    assert!(number(&table["rows"]) < 60.0, "{table}");
    assert_eq!(table["ascending"], true);
    assert_eq!(table["last"], true, "{table}");
    assert_eq!(table["chosen"], true);
}

#[test]
fn grids_are_curves_and_heat_maps() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("study-grid");
    let crank = "parameters.crank=20 mm:240 mm:45";
    let curves = page(&scratch, &["--vary", crank]);
    let script = "const ready = () => answer({ plots: linkdyn.frames.length, rows: document.querySelectorAll('#rows_body tr.chosen .bad').length, which: document.getElementById('which').textContent, ended: document.getElementById('ended').textContent, failures: document.getElementById('tiles').lastChild.textContent });\
        setTimeout(() => { const { canvas, plots: [{ at, x }] } = linkdyn.frames[0]; const box = canvas.getBoundingClientRect(); \
        const place = { clientX: box.left + at.x(x.values[44]), clientY: box.top + 80, bubbles: true }; \
        for (const type of ['pointerdown', 'pointerup']) canvas.dispatchEvent(new PointerEvent(type, place)); const rows = document.getElementById('rows'); \
        const until = (left) => { rows.scrollTop = 1e6; rows.dispatchEvent(new Event('scroll')); \
            if (left === 0 || document.querySelector('#rows_body tr.chosen .bad')) ready(); else setTimeout(until, 100, left - 1); }; \
        until(30); }, 300);";
    let (found, visit) = ask(&browser, &curves, script, Some(4000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    // A crank that is longer than the rod less the offset, 190 mm, does not come round: 195 mm to 240 mm.
    let expected = json!({ "plots": 5, "rows": 1, "which": "variant 44", "ended": "dead_centre", "failures": "failures10dead_centre" });
    assert_eq!(found, expected);
    let scratch = Scratch::new("study-grid");
    let both = page(
        &scratch,
        &[
            "--vary",
            crank,
            "--vary",
            "parameters.rod=100 mm, 200 mm, 300 mm",
        ],
    );
    let script = "setTimeout(() => { const { canvas, plots: [{ at, pick }] } = linkdyn.frames[0]; \
        answer({ plots: linkdyn.frames.length, ends: document.querySelector('#cards h2 .muted').textContent, first: pick(at.box.left + 2, at.box.top + at.box.tall - 2), last: pick(at.box.left + at.box.wide - 2, at.box.top + 2) }); }, 300);";
    let (found, visit) = ask(&browser, &both, script, Some(4000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    // The parameter that changes fastest goes up.
    // √((300 + 20)² − 10²) − √((300 − 20)² − 10²) mm, and the same of 240 mm.
    let ends =
        "least 4.002 cm at crank 20 mm, rod 300 mm; greatest 48.07 cm at crank 240 mm, rod 300 mm";
    assert_eq!(found["ends"], ends);
    assert_eq!(
        (&found["plots"], &found["first"], &found["last"]),
        (&json!(5), &json!(0), &json!(134))
    );
}

#[test]
fn a_large_study_opens_and_says_what_is_drawn() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("study-large");
    let page = page(
        &scratch,
        &["--samples", "100000", "--set", "analysis.outputs=5"],
    );
    assert!(page.len() < LIMIT, "{}", page.len());
    let data = data(&page);
    let rows = data["rows"].as_u64().expect("a count");
    assert!((20_000..=20_006).contains(&rows), "{rows}");
    let script = "answer({ ready: document.documentElement.dataset.ready, note: document.getElementById('notes').textContent, dom: document.querySelectorAll('#rows_body tr').length });";
    let (found, visit) = ask(&browser, &page, script, None);
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert_eq!(found["ready"], "true");
    assert!(number(&found["dom"]) < 60.0, "{found}");
    let note = found["note"]
        .as_str()
        .expect("text")
        .replace('\u{202f}', " ");
    assert!(
        note.starts_with(&format!(
            "20 0{:02} of 100 000 variants are drawn",
            rows % 100
        )),
        "{note}"
    );
}

#[test]
fn it_fits_screens_and_paper() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("study-fits");
    let page = page(&scratch, &["--samples", "300"]);
    let script = "setTimeout(() => answer({ wide: document.documentElement.scrollWidth, inner: document.documentElement.clientWidth, overview: document.getElementById('overview').getBoundingClientRect().bottom, \
        outside: [...document.querySelectorAll('.card h2, .tile, .plot, .caption')].filter((node) => node.getBoundingClientRect().right > innerWidth).length }), 400);";
    for [width, height] in [[390, 844], [1280, 720]] {
        let (found, visit) = ask_in(&browser, &page, script, Some(3000), [width, height]);
        assert!(visit.console.is_empty(), "{:#?}", visit.console);
        assert_eq!(found["wide"], found["inner"], "{width}: {found}");
        assert_eq!(found["outside"], 0, "{width}: {found}");
        assert!(
            number(&found["overview"]) < f64::from(height),
            "{width}: {found}"
        );
    }
    let sheets = sheets(&browser, &page);
    assert!((2..=6).contains(&sheets), "{sheets} sheets");
}

/// Nothing is left over beside the page.
#[test]
fn a_page_of_another_command_is_told_of() {
    let scratch = Scratch::new("study-replaced");
    let vary = [
        "feeder.json",
        "-o",
        "out",
        "--vary",
        "parameters.crank=40 mm:60 mm:3",
    ];
    study(&scratch, &vary);
    let page = scratch.0.join("out/report.html");
    fs::write(&page, "<title>linkdyn report</title>").expect("written");
    let told = study(&scratch, &vary);
    let said = String::from_utf8_lossy(&told.stderr).into_owned();
    let path = Path::new("out").join("report.html");
    let note = format!(
        "note: {} is the page of `linkdyn run`, and is replaced; another directory keeps both",
        path.display()
    );
    assert!(said.contains(&note), "{said}");
}
