//! `compare.html` in a browser: what it shows, what the switches do, what stands where.

use super::*;
use crate::browser::{ask, ask_in, find};
use serde_json::json;

const HALF_A_TURN: [&str; 4] = [
    "--set",
    "analysis.end=0.006",
    "--set",
    "analysis.outputs=121",
];

/// All models of the worn pin over half a turn, with peaks that are cut; one of them has no parameters.
fn page(name: &str) -> String {
    let scratch = Scratch::new(name);
    scratch.done(&[&["--joint", "b", "-o", "out"], &HALF_A_TURN[..]].concat());
    fs::read_to_string(scratch.0.join("out/compare.html")).expect("readable")
}

#[test]
fn the_page_shows_what_the_files_hold() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("page-files");
    let told = scratch.done(&["--joint", "b", "-o", "out"]);
    assert!(told.contains("out/compare.html"), "{told}");
    let page = fs::read_to_string(scratch.0.join("out/compare.html")).expect("readable");
    let summary = scratch.json("out/compare.json");
    let (found, visit) = ask(&browser, &page, include_str!("page.js"), Some(3000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert_eq!(found["requests"], json!([]));
    let names: Vec<String> = summary["columns"]
        .as_array()
        .expect("columns")
        .iter()
        .map(|label| {
            let label = label.as_str().expect("text");
            label[..label.find('[').expect("a unit")].to_string()
        })
        .collect();
    assert_eq!(found["columns"], json!(names));
    let models = [
        "ideal",
        "massless_link",
        "two_state",
        "three_state",
        "contact",
    ];
    assert_eq!(found["models"], json!(models));
    assert_eq!(
        found["switches"],
        json!(["ideal", "massless_link", "three_state", "contact"])
    );
    // The largest force on the page, in newtons, is the largest of the file.
    let largest = &summary["extremes"]["joint.b.force[N]"]["contact"]["max"];
    assert_eq!(found["largest_force"], *largest);
    let rms = &summary["differences"]["joint.b.force[N]"]["contact"]["rms"];
    assert_eq!(found["rms_force"], *rms);
}

/// Curves are counted by the pixels of their colour.
#[test]
fn a_model_that_is_switched_off_has_no_curve() {
    let Some(browser) = find() else { return };
    let (found, visit) = ask(
        &browser,
        &page("page-switch"),
        include_str!("page.js"),
        Some(3000),
    );
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let pixels = |key: &str| found[key].as_u64().expect("a number");
    for part in ["upper", "lower"] {
        assert!(pixels(&format!("{part}_on")) > 50, "{part}: {found:#}");
        assert_eq!(pixels(&format!("{part}_off")), 0, "{part}: {found:#}");
        assert_eq!(
            pixels(&format!("{part}_again")),
            pixels(&format!("{part}_on")),
            "{part}"
        );
    }
    assert!(pixels("marks_on") > 0, "impacts are marked: {found:#}");
    assert_eq!(
        found["hovered"], true,
        "values follow the cursor: {found:#}"
    );
}

/// What is beyond an axis is told beside a mark, and no label covers another one.
#[test]
fn peaks_are_never_hidden() {
    let Some(browser) = find() else { return };
    let (found, _) = ask(
        &browser,
        &page("page-peaks"),
        include_str!("page.js"),
        Some(3000),
    );
    let peaks = found["peaks"].as_array().expect("peaks");
    let cards = found["columns"].as_array().expect("columns").len();
    assert_eq!(peaks.len(), cards);
    let mut cut = 0;
    for card in peaks {
        assert_eq!(card["beyond"], card["told"], "{card:#}");
        cut += card["beyond"].as_array().expect("a list").len();
        assert_eq!(card["covered"], 0, "{card:#}");
    }
    assert!(cut > 0, "no axis is cut: {found:#}");
}

#[test]
fn the_first_plot_is_on_the_first_screen() {
    let Some(browser) = find() else { return };
    let page = page("page-screen");
    for size in [[390, 844], [820, 1180], [1280, 720], [1920, 1080]] {
        let (found, visit) = ask_in(&browser, &page, include_str!("page.js"), Some(3000), size);
        assert!(visit.console.is_empty(), "{size:?}: {:#?}", visit.console);
        let number = |key: &str| found[key].as_f64().expect("a number");
        let [width, height] = size.map(f64::from);
        assert_eq!(number("width"), width);
        assert!(number("scroll_width") <= width, "{size:?}: {found:#}");
        assert!(number("first_bottom") <= height, "{size:?}: {found:#}");
        assert!(number("first_tall") > 150.0, "{size:?}: {found:#}");
        assert_eq!(found["texts_covered"], json!([]), "{size:?}");
        assert_eq!(found["texts_outside"], json!([]), "{size:?}");
    }
}

/// Names of the model are text wherever they stand.
#[test]
fn hostile_names_stay_text() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("page-hostile");
    let joint = "</script><img><script>{{script}}</script>";
    let model = MODEL
        .replace("\"b\": {", &format!("{}: {{", json!(joint)))
        .replace(
            "Slider-crank with a worn piston pin",
            "<!--<script>window.hacked=1</script>",
        );
    fs::write(scratch.0.join("model.json"), model).expect("written");
    scratch.done(&[
        "--joint",
        joint,
        "--models",
        "ideal,massless_link",
        "-o",
        "out",
    ]);
    let page = fs::read_to_string(scratch.0.join("out/compare.html")).expect("readable");
    let probe = "setTimeout(() => answer({ hacked: typeof window.hacked, images: document.images.length, scripts: document.scripts.length, \
        name: document.getElementById('name').textContent, changes: document.getElementById('line').textContent, \
        cards: linkdyn.cards.list.length }), 300);";
    let (found, visit) = ask(&browser, &page, probe, Some(2000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert_eq!(found["hacked"], "undefined");
    assert_eq!(
        (&found["images"], &found["scripts"]),
        (&json!(0), &json!(5)),
        "{found:#}"
    );
    assert_eq!(found["name"], "<!--<script>window.hacked=1</script>");
    assert_eq!(
        found["changes"],
        format!("models of the clearance of joint {joint}")
    );
    assert!(found["cards"].as_u64() > Some(3), "{found:#}");
}

/// One model alone is a page too, and says that there is nothing to compare with.
#[test]
fn a_lone_model_has_plots_and_no_differences() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("page-lone");
    scratch.done(&["--joint", "b", "--models", "contact", "-o", "out"]);
    let page = fs::read_to_string(scratch.0.join("out/compare.html")).expect("readable");
    let probe = "setTimeout(() => answer({ plots: linkdyn.cards.list.map(({ plots }) => plots.length), notes: document.getElementById('notes').textContent }), 300);";
    let (found, visit) = ask(&browser, &page, probe, Some(2000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let plots = found["plots"].as_array().expect("a list");
    assert!(
        !plots.is_empty() && plots.iter().all(|count| *count == 1),
        "{found:#}"
    );
    assert_eq!(
        found["notes"],
        "There is nothing to compare contact with: no other model was run."
    );
}

/// `massless_link` does not converge in some intervals, where its forces are a hundred times those of the others.
#[test]
fn models_that_do_not_converge_do_not_set_the_scale() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("page-scale");
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.args(["compare", "slider-crank-clearance", "--joint", "wristpin"]);
    command.args(["-o", "out"]).current_dir(&scratch.0);
    assert!(command.output().expect("it runs").status.success());
    let page = fs::read_to_string(scratch.0.join("out/compare.html")).expect("readable");
    let probe = "setTimeout(() => { const { cards, ran, units } = linkdyn; answer({ failed: ran.filter((run) => !run.sets_scale).map(({ name }) => name), \
        beyond: cards.list.filter((card, k) => { const { factor } = card, { min, max } = card.plots[0].u.scales.y; \
            const ends = ran.filter((run) => run.sets_scale).map((run) => [run.extremes[k][0], run.extremes[k][2]].map((end) => end * factor)); \
            return max > Math.max(...ends.map(([, high]) => high)) + 0.08 * (max - min); }).length }); }, 400);";
    let (found, visit) = ask(&browser, &page, probe, Some(2000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert_eq!(found["failed"], json!(["massless_link"]));
    assert_eq!(found["beyond"], 0);
    assert_eq!(crate::browser::sheets(&browser, &page), 2);
}
