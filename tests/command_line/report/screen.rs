//! What is on the screen: sizes, what stands beside what, what covers what.

use super::*;

/// Sizes of windows: a phone, a tablet, laptops, a desk.
const SIZES: [[u32; 2]; 6] = [
    [390, 844],
    [820, 1180],
    [1024, 768],
    [1280, 720],
    [1440, 900],
    [1920, 1080],
];

/// What a page looks like in a window.
fn look(page: &str, size: [u32; 2]) -> Option<Value> {
    let browser = find()?;
    let script = include_str!("screen.js");
    let (told, visit) = ask_in(&browser, page, script, Some(3000), size);
    assert!(visit.console.is_empty(), "{size:?}: {:#?}", visit.console);
    Some(told)
}

/// Of several kinds: inverse dynamics with a declared point, a change point, contact with events, no driver.
#[test]
fn mechanism_and_first_plot_are_on_the_first_screen() {
    let usual = [SIZES[0], SIZES[3]];
    for (model, sizes) in [
        ("four-bar", &usual[..]),
        ("lock", &SIZES[..]),
        ("slider-crank-clearance", &usual[..]),
        ("double-pendulum", &usual[..]),
    ] {
        let (page, _, _) = run(&[model]);
        for &size in sizes {
            let Some(told) = look(&page, size) else {
                return;
            };
            let number = |key: &str| told[key].as_f64().expect("a number");
            let [width, height] = size.map(f64::from);
            let of = format!("{model} {size:?}: {told:#}");
            assert_eq!((number("width"), number("height")), (width, height));
            assert!(
                number("scroll_width") <= width,
                "wider than the window: {of}"
            );
            assert!(
                number("first_bottom") <= height,
                "the first plot is below the fold: {of}"
            );
            assert!(
                number("first_tall") > 100.0 && number("stage_tall") >= 180.0,
                "{of}"
            );
            assert!(number("stage_bottom") <= height, "{of}");
            let beside = width >= 1100.0 || (width >= 900.0 && width > height);
            assert_eq!(told["beside"], beside, "{of}");
            // Whoever reads the last table still sees the mechanism.
            assert_eq!(told["in_sight_below"], true, "{of}");
        }
    }
}

#[test]
fn no_label_covers_another_one() {
    let Some(browser) = find() else { return };
    let script = include_str!("labels.js");
    let pages = [
        "lock",
        "jansen-leg",
        "andrews-squeezer",
        "slider-crank-clearance",
        "four-bar-spring",
        "double-wishbone",
    ];
    let pages = pages.map(|model| (model, run(&[model]).0));
    for (model, page) in pages.into_iter().chain([("hostile names", hostile())]) {
        for size in [[1280, 720], [390, 844]] {
            let (told, visit) = ask_in(&browser, &page, script, Some(8000), size);
            assert!(visit.console.is_empty(), "{model}: {:#?}", visit.console);
            assert!(
                told["drawn"].as_u64() > Some(13 * 3),
                "{model} {size:?}: {told:#}"
            );
            assert_eq!(told["covering"], json!([]), "{model} {size:?}");
            assert_eq!(told["outside"], json!([]), "{model} {size:?}");
            // Near its change point arrows are cut, and the drawing says from which force on.
            assert!(model != "lock" || told["cut"] != json!([]), "{told:#}");
            // The ruler at the foot and the signs of the ground, which are held apart as well.
            assert!(
                told["feet"].as_u64() > Some(0) && told["signs"].as_u64() > Some(0),
                "{model} {size:?}: {told:#}"
            );
        }
    }
}

/// A report of few bodies fits two or three sheets.
#[test]
fn a_report_is_printed_on_three_sheets() {
    let Some(browser) = find() else { return };
    for model in ["four-bar", "lock", "slider-crank-clearance"] {
        let sheets = crate::browser::sheets(&browser, &run(&[model]).0);
        assert!((1..=3).contains(&sheets), "{model}: {sheets} sheets");
    }
}
