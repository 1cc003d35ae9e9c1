//! Events in figures.

use super::*;

#[test]
fn events_are_marked_where_they_are() {
    let scratch = Scratch::new("events");
    scratch.done(&[
        "run",
        "lock",
        "--set",
        "analysis.sample.step=5 deg",
        "-o",
        "lock",
    ]);
    let rest = [
        "--y",
        "link2.angle",
        "--events",
        "-o",
        "a.svg",
        "--x-range",
        "100:130",
    ];
    scratch.done(
        &[
            &[
                "plot",
                "lock",
                "--x",
                "driver.motor.value",
                "--x-unit",
                "deg",
            ],
            rest.as_slice(),
        ]
        .concat(),
    );
    let svg = scratch.text("a.svg");
    let document = Document::parse(&svg).expect("XML");
    let [slope, start] = axis(&document, 0);
    let [mark] = of_class(&document, "mark")[..] else {
        panic!("one mark")
    };
    let place = start + slope * points(mark)[0][0];
    assert!((place - 117.512_207).abs() < 1e-3, "{place}");
    assert_eq!(label(of_class(&document, "mark-label")[0]), "change point");
    scratch.done(&[
        "plot",
        "lock",
        "--y",
        "link2.angle",
        "--events",
        "-o",
        "b.svg",
    ]);
    assert!(
        scratch.text("b.svg").contains("class=\"mark\""),
        "over time, too"
    );
}

/// Few are named; of many only where contacts begin, without their names.
#[test]
fn contacts_are_marked_and_named_while_they_are_few() {
    let scratch = Scratch::new("contacts");
    for (model, end, words) in [
        ("three_state", "0.8 ms", "impact"),
        ("contact", "0.8 ms", "contact"),
        ("contact", "24 ms", ""),
    ] {
        let model = format!("joints.wristpin.clearance.model={model}");
        let end = format!("analysis.end={end}");
        scratch.done(&[
            "run",
            "slider-crank-clearance",
            "--set",
            &model,
            "--set",
            &end,
            "-o",
            "run",
        ]);
        scratch.done(&[
            "plot", "run", "--y", "slider.x", "--events", "-o", "a.svg", "--size", "180x90",
        ]);
        let svg = scratch.text("a.svg");
        let document = Document::parse(&svg).expect("XML");
        let labels: Vec<String> = of_class(&document, "mark-label")
            .into_iter()
            .map(label)
            .collect();
        let marks = of_class(&document, "mark").len();
        if words.is_empty() {
            assert_eq!((marks, labels.as_slice()), (24, [].as_slice()));
        } else {
            assert!(
                marks >= 3 && !labels.is_empty() && labels.iter().all(|label| label == words),
                "{labels:?}"
            );
        }
    }
}
