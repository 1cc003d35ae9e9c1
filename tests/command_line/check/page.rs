//! The page of `check`.

use super::linkdyn;
use std::fs;
use std::path::Path;

/// The page about a bundled model.
fn page(model: &str) -> String {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join(format!("check-page-{}-{model}", std::process::id()));
    let (status, _, said) = linkdyn(&["check", model, "-o", out.to_str().expect("UTF-8")]);
    assert_eq!(status, Some(0), "{said}");
    let page = fs::read_to_string(out.join("check.html")).expect("written");
    fs::remove_dir_all(&out).expect("removed");
    page
}

/// The value of an attribute in a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> &'a str {
    let (_, rest) = tag.split_once(&format!("{name}=\"")).expect(name);
    rest.split_once('"').expect("an end").0
}

/// At its dead centre everything lies on one line, also the force on the piston.
#[test]
fn names_keep_clear_of_the_arrows_of_loads() {
    let page = page("slider-crank");
    let place = |text: &str| -> [f64; 2] {
        let (x, y) = text.split_once(',').expect("two numbers");
        [x, y].map(|number| number.parse().expect("a number"))
    };
    let (_, arrow) = page.split_once("<polyline class=\"load\"").expect("a load");
    let [tail, head] = {
        let mut places = attribute(arrow, "points").split(' ').map(place);
        [(); 2].map(|()| places.next().expect("two places"))
    };
    let names = page.split("<text class=\"").skip(1);
    let names: Vec<&str> = names
        .filter(|text| text.starts_with("body-name") || text.starts_with("joint-name"))
        .collect();
    assert_eq!(names.len(), 7, "{names:?}");
    for name in names {
        let [x, y] = ["x", "y"].map(|axis| {
            let text = attribute(name, &format!(" {axis}"));
            text.parse::<f64>().expect("a number")
        });
        let text = name.split('>').nth(1).expect("a text");
        let letters = text.split('<').next().unwrap_or_default().trim();
        let half = 2.3 * letters.chars().count() as f64;
        let beside = x + half < head[0].min(tail[0]) || x - half > head[0].max(tail[0]);
        assert!(
            beside || (y - tail[1]).abs() > 8.0,
            "{letters} lies on the arrow"
        );
    }
}

/// As the pages with scripts are.
#[test]
fn the_page_has_the_type_of_the_others_and_a_dark_side() {
    let page = page("four-bar");
    let shared = fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/crates/picture/src/page/page.css"
    ))
    .expect("there");
    let font = |text: &str| {
        let (_, rest) = text.split_once("body {").expect("a rule");
        let (_, rest) = rest.split_once("font: ").expect("a font");
        rest.split_once(';').expect("an end").0.to_owned()
    };
    assert_eq!(font(&page), font(&shared));
    assert!(page.contains(":root { color-scheme: light dark; }"));
    assert!(page.contains("@media (prefers-color-scheme: dark)"));
}
