//! Pages opened in a browser.

use super::*;

/// Runs of all kinds, and how each ends.
const OUTCOMES: &[(&[&str], &str)] = &[
    (&["four-bar"], "completed"),
    (
        &["slider-crank", "--set", "analysis.type=kinematics"],
        "completed",
    ),
    (&["geared-five-bar"], "completed"),
    (&["scotch-yoke"], "completed"),
    (&["parallel-crank"], "completed"),
    (
        &[
            "quick-return",
            "--set",
            "drivers={}",
            "--set",
            "analysis.type=dynamics",
        ],
        "completed",
    ),
    (
        &[
            "scotch-yoke",
            "--set",
            "drivers={}",
            "--set",
            "analysis.type=statics",
        ],
        "completed",
    ),
    (&["lock", "--set", "analysis.type=assembly"], "completed"),
    (
        &[
            "lock",
            "--set",
            "joints.a.clearance.model=massless_link",
            "--set",
            "joints.d.clearance.model=massless_link",
        ],
        "completed_with_gaps",
    ),
    (
        &[
            "lock",
            "--set",
            "analysis.sample.to=135 deg",
            "--set",
            "analysis.sample.step=1 deg",
        ],
        "dead_centre",
    ),
    (
        &["four-bar", "--set", r#"bodies.coupler.points.B=["9 m", 0]"#],
        "assembly_failed",
    ),
    (
        &[
            "quick-return",
            "--set",
            "drivers={}",
            "--set",
            "analysis.type=dynamics",
            "--set",
            "analysis.solver.max_wall_time=1e-9",
        ],
        "time_limit",
    ),
    (
        &["four-bar", "--set", r#"analysis.columns=["driver.*"]"#],
        "completed",
    ),
];

#[test]
fn every_outcome_opens_without_a_word_on_the_console() {
    let Some(browser) = find() else { return };
    for (arguments, status) in OUTCOMES {
        let (page, _, summary) = run(arguments);
        assert_eq!(summary["status"], *status, "{arguments:?}");
        let visit = open(&browser, &page, Some(1000));
        assert!(
            visit.console.is_empty(),
            "{arguments:?}: {:#?}",
            visit.console
        );
        assert!(
            visit.dom.contains("data-ready=\"true\""),
            "{arguments:?} does not get ready"
        );
        assert!(
            !visit
                .dom
                .split("id=\"data\"")
                .next()
                .expect("a part")
                .contains("NaN"),
            "{arguments:?}"
        );
    }
}

/// A run that came to its end begins at the beginning, one that is stuck shows where.
#[test]
fn a_page_opens_where_the_run_is_stuck() {
    let Some(browser) = find() else { return };
    let stuck = [
        "lock",
        "--set",
        "analysis.sample.to=135 deg",
        "--set",
        "analysis.sample.step=1 deg",
    ];
    for (arguments, early) in [
        (&["lock", "--set", "analysis.sample.step=1 deg"][..], false),
        (&stuck, true),
    ] {
        let (page, csv, summary) = run(arguments);
        assert_eq!(summary["status"] == "dead_centre", early);
        let probe = "setTimeout(() => { const { player, rows } = linkdyn; const row = player.row, scrub = Number(document.getElementById('scrub').value); \
            player.toggle(); const played = player.row; player.pause(); answer({ row, rows, scrub, played }); }, 300);";
        let (told, visit) = ask(&browser, &page, probe, Some(2000));
        assert!(visit.console.is_empty(), "{:#?}", visit.console);
        let last = csv.lines().count() - 2;
        let opened = if early { last } else { 0 };
        assert_eq!(
            told,
            json!({ "row": opened, "rows": last + 1, "scrub": opened, "played": 0 })
        );
    }
}

#[test]
fn hostile_names_do_nothing() {
    let Some(browser) = find() else { return };
    let probe = "setTimeout(() => answer({ hacked: typeof window.hacked, scripts: document.scripts.length, \
        odd: document.querySelectorAll('img,svg:not(.chip svg, .icon, #icons),iframe').length, title: document.title, \
        heading: document.getElementById('name').textContent, origin: document.getElementById('origin').textContent, \
        bodies: [...document.querySelectorAll('#poses tbody tr')].map((line) => line.cells[0].textContent), \
        names: linkdyn.plots.shown.length }), 300);";
    let (told, visit) = ask(&browser, &hostile(), probe, Some(2000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    assert_eq!(
        (&told["hacked"], &told["scripts"], &told["odd"]),
        (&json!("undefined"), &json!(5), &json!(0)),
        "{told:#}"
    );
    assert_eq!(
        told["heading"],
        "</script><script>window.hacked=1</script><!--<script>"
    );
    assert_eq!(told["origin"], "\\u{202e}evil\\u{2028}line");
    assert_eq!(told["bodies"], json!(["<!--<script>", "__proto__"]));
}

#[test]
fn a_page_without_results_says_so_where_the_drawing_would_be() {
    let Some(browser) = find() else { return };
    let (page, _, _) = run(&["four-bar", "--set", r#"bodies.coupler.points.B=["9 m", 0]"#]);
    let probe = "const box = (name) => document.getElementById(name).getBoundingClientRect(); \
        const [card, said] = [box('motion'), box('undrawn')]; answer({ text: document.getElementById('undrawn').textContent, \
        high: said.height, inside: said.top >= card.top && said.bottom <= card.bottom, wide: card.width });";
    let (told, _) = ask(&browser, &page, probe, Some(1000));
    assert_eq!(
        told["text"],
        "There is no result to show: assembly failed, for the reason given above."
    );
    assert!(
        told["inside"] == true
            && told["high"].as_f64() > Some(15.0)
            && told["wide"].as_f64() > Some(1000.0),
        "{told:#}"
    );
}

/// The policy refuses what is not ours, even if it got in.
#[test]
fn foreign_scripts_are_refused() {
    let Some(browser) = find() else { return };
    let (page, _, _) = run(&["four-bar", "--set", "analysis.outputs=3"]);
    let visit = open(
        &browser,
        &page.replace(
            "</body>",
            "<script>document.title = 'hacked'</script></body>",
        ),
        Some(500),
    );
    assert!(!visit.dom.contains("<title>hacked"));
    assert!(
        visit
            .console
            .iter()
            .any(|line| line.contains("Content Security Policy")),
        "{:?}",
        visit.console
    );
}

/// When a page is ready, the first pose and the plots on the first screen are drawn, and the others wait. How long that takes
/// `benches/report.mjs --open` measures (a second for the first of these); the bounds here are for what grows with the square.
#[test]
fn a_page_is_ready_with_its_first_screen() {
    let Some(browser) = find() else { return };
    let probe = "addEventListener('DOMContentLoaded', () => answer({ ready: performance.now(), columns: linkdyn.width, rows: linkdyn.rows, \
        plots: linkdyn.plots.list.length, drawn: linkdyn.plots.list.filter((plot) => plot.u).length, \
        pose: linkdyn.stage.labels.length, known: linkdyn.shapes.known }));";
    for (what, page, bound) in [
        (
            "2000 rows, 127 columns",
            large(14, 2000, |k| format!("body {k}")),
            10_000.0,
        ),
        (
            "10 000 bodies",
            large(10_000, 101, |k| format!("body {k}")),
            60_000.0,
        ),
    ] {
        let told = ask(&browser, &page, probe, None).0;
        let ready = told["ready"].as_f64().expect("a time");
        println!("{what}: {} bytes, drawn after {ready} ms", page.len());
        assert!(ready < bound, "{what}: {ready} ms, {told}");
        let [drawn, all] = ["drawn", "plots"].map(|key| told[key].as_u64().expect("a number"));
        assert!((1..=4).contains(&drawn) && drawn <= all, "{told:#}");
        assert!(
            told["known"] == true && told["pose"].as_u64() > Some(0),
            "{told:#}"
        );
    }
}

/// What waited is drawn a moment later, seen or not: whoever scrolls or searches finds it.
#[test]
fn plots_below_the_first_screen_are_drawn_after_it() {
    let Some(browser) = find() else { return };
    let probe = "addEventListener('DOMContentLoaded', () => { const drawn = () => linkdyn.plots.list.map((plot) => Boolean(plot.u)); \
        const first = drawn(); const look = () => drawn().every(Boolean) ? answer({ first, later: drawn() }) : setTimeout(look, 50); look(); });";
    let (page, _, _) = run(&["lock"]);
    let (told, visit) = ask(&browser, &page, probe, Some(10_000));
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let count = |key: &str| {
        let list = told[key].as_array().expect("a list");
        (
            list.iter().filter(|drawn| **drawn == true).count(),
            list.len(),
        )
    };
    let ((first, all), (later, _)) = (count("first"), count("later"));
    assert!(first >= 1 && first < all && later == all, "{told:#}");
}
