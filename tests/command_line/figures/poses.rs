//! Mechanisms in their poses.

use super::*;

#[test]
fn poses_are_drawn_from_the_results_alone() {
    let scratch = Scratch::new("poses");
    for model in ["four-bar", "geared-five-bar", "scotch-yoke", "quick-return"] {
        scratch.done(&["run", model, "--set", "analysis.outputs=21", "-o", model]);
        scratch.done(&["animate", model, "-o", "a.svg", "--poses", "3"]);
        scratch.done(&[
            "animate", model, "--model", model, "-o", "b.svg", "--poses", "3",
        ]);
        assert_eq!(
            scratch.read("a.svg"),
            scratch.read("b.svg"),
            "{model}: summary.json and the model tell the same shape"
        );
    }
    scratch.done(&[
        "animate", "four-bar", "-o", "c.svg", "--poses", "5", "--strip",
    ]);
    let svg = scratch.text("c.svg");
    let document = Document::parse(&svg).expect("XML");
    let times: Vec<String> = of_class(&document, "time").into_iter().map(label).collect();
    assert_eq!(
        times,
        [
            "t = 0.00 s",
            "t = 0.50 s",
            "t = 1.00 s",
            "t = 1.50 s",
            "t = 2.00 s"
        ]
    );
    // Crank, coupler, rocker.
    assert_eq!(of_class(&document, "body").len(), 5 * 3);
    scratch.done(&[
        "animate", "four-bar", "-o", "d.png", "--width", "127", "--dpi", "100",
    ]);
    assert_eq!(png_facts(&scratch.read("d.png"))[0], 500);
}

/// Pins of the drawn four-bar lie where its poses say: crank length to coupler length on the page as in the model, 100 to 250 mm.
#[test]
fn what_is_drawn_has_the_proportions_of_the_model() {
    let scratch = Scratch::new("proportions");
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=11",
        "-o",
        "out",
    ]);
    scratch.done(&["animate", "out", "-o", "a.svg", "--poses", "1"]);
    let svg = scratch.text("a.svg");
    let document = Document::parse(&svg).expect("XML");
    let pins: Vec<[f64; 2]> = of_class(&document, "pin")
        .into_iter()
        .map(|pin| {
            ["cx", "cy"].map(|key| pin.attribute(key).expect(key).parse().expect("a number"))
        })
        .collect();
    let [a, b, c, d] = pins[..] else {
        panic!("four pins: {pins:?}")
    };
    let distance = |[x, y]: [f64; 2], [u, v]: [f64; 2]| (x - u).hypot(y - v);
    let scale = distance(a, d) / 300.0;
    for (length, drawn) in [
        (100.0, distance(a, b)),
        (250.0, distance(b, c)),
        (200.0, distance(c, d)),
    ] {
        assert!(
            (drawn / scale - length).abs() < 0.01,
            "{length}: {}",
            drawn / scale
        );
    }
}

/// The bar of a slot in a moving body begins at the body's point, and does not float beside it.
#[test]
fn a_guide_on_a_moving_body_reaches_to_the_body() {
    let scratch = Scratch::new("slot");
    scratch.write(
        "m.json",
        r#"{ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "O": [0, 0], "Q": [0, -2] } }, "crank": { "points": { "O": [0, 0], "A": [1, 0] } },
            "lever": { "points": { "Q": [0, 0] }, "pose": { "position": [0, -2], "angle": 1.1 } } },
        "joints": { "o": { "type": "revolute", "between": ["ground.O", "crank.O"] },
            "q": { "type": "revolute", "between": ["ground.Q", "lever.Q"] },
            "s": { "type": "slot", "between": ["lever.Q", "crank.A"], "axis": [1, 0] } },
        "drivers": { "d": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": 1 } } },
        "analysis": { "type": "kinematics", "end": 0.5, "outputs": 11 } }"#,
    );
    scratch.done(&["run", "m.json", "-o", "out"]);
    let told = scratch.done(&["animate", "out", "-o", "a.svg", "--poses", "1"]);
    assert!(told.contains(", 1 pose,"), "{told}");
    let svg = scratch.text("a.svg");
    let document = Document::parse(&svg).expect("XML");
    let guide = points(of_class(&document, "guide")[0]);
    let pins: Vec<[f64; 2]> = of_class(&document, "pin")
        .into_iter()
        .map(|pin| {
            ["cx", "cy"].map(|key| pin.attribute(key).expect(key).parse().expect("a number"))
        })
        .collect();
    let near = |end: [f64; 2]| {
        pins.iter()
            .any(|pin| (pin[0] - end[0]).hypot(pin[1] - end[1]) < 0.01)
    };
    assert!(guide.iter().any(|end| near(*end)), "{guide:?} and {pins:?}");
}

#[test]
fn gaps_have_no_pose() {
    let scratch = Scratch::new("film-gaps");
    scratch.done(&[
        "run",
        "slider-crank",
        "--set",
        "analysis.outputs=5",
        "-o",
        "out",
    ]);
    let csv = scratch.text("out/results.csv");
    let hole = |(index, line): (usize, &str)| {
        let cells: Vec<&str> = line.split(',').collect();
        if index == 3 {
            format!("{}{}", cells[0], ",".repeat(cells.len() - 1))
        } else {
            line.to_string()
        }
    };
    let lines: Vec<String> = csv.lines().enumerate().map(hole).collect();
    scratch.write("out/results.csv", &(lines.join("\n") + "\n"));
    scratch.done(&["animate", "out", "-o", "a.svg", "--poses", "5", "--strip"]);
    let svg = scratch.text("a.svg");
    let document = Document::parse(&svg).expect("XML");
    let bodies = of_class(&document, "body").len();
    assert_eq!(
        (of_class(&document, "time").len(), bodies % 4, bodies > 0),
        (5, 0, true),
        "one of five poses is missing"
    );
}
