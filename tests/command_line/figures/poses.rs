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
    // Crank, rod and slider without a body of its own; where there is no pose none is asked for.
    let backdrops = of_class(&document, "time").len();
    assert_eq!((backdrops, bodies), (5, 5 * 3), "five poses, none missing");
}

/// Numbers at the end of labels, `motor = −20.8°`.
fn values(document: &Document) -> Vec<f64> {
    let number = |node: Node| {
        let text = label(node).replace('−', "-");
        let (_, value) = text.split_once(" = ").expect("a name");
        let value = value.trim_end_matches(|c: char| !c.is_ascii_digit());
        value.parse().expect("a number")
    };
    of_class(document, "value")
        .into_iter()
        .map(number)
        .collect()
}

#[test]
fn poses_are_equally_spaced_in_the_drivers_value() {
    let scratch = Scratch::new("spaced");
    for (model, first, last, spaces) in [
        // From rest, with a constant acceleration: not equal in time.
        ("watt-i-lock", -50.0, 125.0, 5.0),
        // A whole turn: the end, which is the beginning, is left out.
        ("jansen-leg", 0.0, 300.0, 5.0),
        // Up and down: the whole way once.
        ("double-wishbone", 11.0, -11.0, 5.0),
    ] {
        scratch.done(&["run", model, "-o", model, "--no-report"]);
        scratch.done(&[
            "animate", model, "-o", "a.svg", "--strip", "--poses", "6", "--width", "180",
        ]);
        let svg = scratch.text("a.svg");
        let document = Document::parse(&svg).expect("XML");
        let values = values(&document);
        assert_eq!(values.len(), 6, "{model}");
        for (k, value) in values.iter().enumerate() {
            let expected = first + (last - first) * k as f64 / spaces;
            // Labels have one decimal.
            assert!((value - expected).abs() <= 0.051, "{model}: {values:?}");
        }
    }
}

/// Rows of a strip are full, or the last one stands in the middle; nothing is cut off at the edges.
#[test]
fn strips_have_no_holes_and_signs_are_whole() {
    let scratch = Scratch::new("holes");
    for model in ["four-bar", "geared-five-bar", "scotch-yoke"] {
        scratch.done(&["run", model, "-o", model, "--no-report"]);
        scratch.done(&[
            "animate", model, "-o", "a.svg", "--strip", "--poses", "7", "--width", "180",
        ]);
        let svg = scratch.text("a.svg");
        let document = Document::parse(&svg).expect("XML");
        let size: Vec<f64> = (document.root_element().attribute("viewBox"))
            .expect("a size")
            .split(' ')
            .map(|number| number.parse().expect("a number"))
            .collect();
        let places: Vec<[f64; 2]> = of_class(&document, "time")
            .into_iter()
            .map(|node| ["x", "y"].map(|key| node.attribute(key).expect(key).parse().expect(key)))
            .collect();
        let last = places[6][1];
        for row in [last, places[0][1]] {
            let row: Vec<f64> = places
                .iter()
                .filter(|at| at[1] == row)
                .map(|at| at[0])
                .collect();
            let middle = row.iter().sum::<f64>() / row.len() as f64;
            assert!((middle - size[2] / 2.0).abs() < 0.1, "{model}: {row:?}");
        }
        for class in [
            "body", "driver", "load", "support", "hatch", "wheel", "block", "ground",
        ] {
            for node in of_class(&document, class) {
                let inside =
                    |[x, y]: [f64; 2]| (0.0..=size[2]).contains(&x) && (0.0..=size[3]).contains(&y);
                let whole = points(node).into_iter().all(inside);
                assert!(whole, "{model}: {class}");
            }
        }
    }
}

/// A driven slide between moving bodies is drawn as a cylinder, whose piston stays inside of its barrel.
#[test]
fn a_driven_slide_is_a_cylinder() {
    let scratch = Scratch::new("cylinder");
    scratch.write(
        "lift.json",
        r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg" },
        "bodies": { "ground": { "points": { "hinge": [0, 0], "foot": [200, -400] } },
            "arm": { "points": { "hinge": [0, 0], "eye": [500, 0] } },
            "tube": { "points": { "foot": [0, 0] }, "pose": { "position": [200, -400], "angle": -36.87 } },
            "rod": { "points": { "eye": [0, 0] }, "pose": { "position": [500, 0], "angle": -36.87 } } },
        "joints": { "hinge": { "type": "revolute", "between": ["ground.hinge", "arm.hinge"] },
            "foot": { "type": "revolute", "between": ["ground.foot", "tube.foot"] },
            "eye": { "type": "revolute", "between": ["arm.eye", "rod.eye"] },
            "slide": { "type": "prismatic", "between": ["tube.foot", "rod.eye"], "axis": [0, 1] } },
        "drivers": { "oil": { "type": "translation", "joint": "slide",
            "motion": { "type": "constant_velocity", "start": 500, "velocity": "50 mm/s" } } },
        "analysis": { "type": "kinematics", "end": 5, "outputs": 21 } }"#,
    );
    scratch.done(&["run", "lift.json", "-o", "out"]);
    scratch.done(&["animate", "out", "-o", "a.svg", "--strip", "--poses", "3"]);
    let svg = scratch.text("a.svg");
    let document = Document::parse(&svg).expect("XML");
    assert_eq!(values(&document), [500.0, 625.0, 750.0]);
    let [barrels, pistons, rods] =
        ["barrel", "piston", "rod"].map(|class| of_class(&document, class));
    assert_eq!([barrels.len(), pistons.len(), rods.len()], [3; 3]);
    // The arm alone is a bar; tube and rod are parts of the cylinder.
    assert_eq!(of_class(&document, "body").len(), 3);
    pistons_are_inside(barrels, pistons);
}

/// How far along its barrel each piston reaches lies between the ends of the barrel.
#[track_caller]
fn pistons_are_inside(barrels: Vec<Node>, pistons: Vec<Node>) {
    for (barrel, piston) in barrels.into_iter().zip(pistons) {
        let [a, b, ..] = points(barrel)[..] else {
            panic!("a barrel has corners")
        };
        let along = |place: [f64; 2]| {
            ((place[0] - a[0]) * (b[0] - a[0]) + (place[1] - a[1]) * (b[1] - a[1]))
                / ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2))
        };
        let inside = points(piston).into_iter().map(along);
        let inside: Vec<f64> = inside.collect();
        assert!(
            inside.iter().all(|far| (0.0..=1.0).contains(far)),
            "{inside:?}"
        );
    }
}

/// An actuator is drawn as a cylinder between its points, in front of the bodies, with an eye at either end.
#[test]
fn an_actuator_is_a_cylinder() {
    let scratch = Scratch::new("actuator");
    scratch.write(
        "lift.json",
        r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg" },
        "bodies": { "ground": { "points": { "hinge": [0, 0], "foot": [200, -400] } },
            "arm": { "points": { "hinge": [0, 0], "eye": [500, 0] } } },
        "joints": { "hinge": { "type": "revolute", "between": ["ground.hinge", "arm.hinge"] } },
        "drivers": { "motor": { "type": "rotation", "body": "arm", "motion": { "type": "constant_velocity", "velocity": "8 deg/s" } } },
        "forces": { "oil": { "type": "actuator", "between": ["ground.foot", "arm.eye"], "force": "3 kN" } },
        "analysis": { "type": "kinematics", "end": 5, "outputs": 21 } }"#,
    );
    scratch.done(&["run", "lift.json", "-o", "out"]);
    scratch.done(&["animate", "out", "-o", "a.svg", "--strip", "--poses", "3"]);
    let svg = scratch.text("a.svg");
    let document = Document::parse(&svg).expect("XML");
    let [barrels, pistons, rods, eyes, dampers] =
        ["barrel", "piston", "rod", "eye", "damper"].map(|class| of_class(&document, class));
    let counts = [
        barrels.len(),
        pistons.len(),
        rods.len(),
        eyes.len(),
        dampers.len(),
    ];
    assert_eq!(counts, [3, 3, 3, 6, 0]);
    // what stands later is in front
    let bodies = of_class(&document, "body");
    assert!(bodies[0] < eyes[0]);
    pistons_are_inside(barrels, pistons);
}

/// A spring and the damper beside it, a load with its value.
const STRUT: &str = r#"{
  "format": "linkdyn/1", "units": "SI",
  "bodies": {
    "ground": { "points": { "O": [0, 0], "F": [0.3, 0] } },
    "arm": { "points": { "O": [0, 0], "A": [0.4, 0], "B": [0.2, 0.1] }, "mass": 1, "com": [0.2, 0], "inertia": 0.02 }
  },
  "joints": { "o": { "type": "revolute", "between": ["ground.O", "arm.O"] } },
  "forces": {
    "strut": { "type": "spring", "between": ["ground.F", "arm.B"], "stiffness": 2000, "damping": 30, "free_length": 0.15 },
    "push": { "type": "force", "at": "arm.A", "vector": [0, -1250] },
    "twist": { "type": "torque", "body": "arm", "value": 12.5 }
  },
  "analysis": { "type": "dynamics", "end": 0.1, "outputs": 11 }
}"#;

#[test]
fn struts_and_the_values_of_loads_are_drawn() {
    let scratch = Scratch::new("struts");
    let class = |model: &str, class: &str| {
        scratch.write("m.json", model);
        scratch.done(&["run", "m.json", "-o", "out", "--no-report"]);
        scratch.done(&["animate", "out", "-o", "a.svg", "--poses", "1"]);
        let svg = scratch.text("a.svg");
        let document = Document::parse(&svg).expect("XML");
        let found = of_class(&document, class);
        let texts: Vec<String> = found.iter().map(|node| label(*node)).collect();
        (found.len(), texts)
    };
    // The coils, and two bars with a rod each; the dashpot's four strokes.
    assert_eq!(class(STRUT, "spring").0, 5);
    assert_eq!(class(STRUT, "damper").0, 4);
    let spring = STRUT.replace("\"damping\": 30, ", "");
    assert_eq!(class(&spring, "spring").0, 1);
    assert_eq!(class(&spring, "damper").0, 0);
    let damper = STRUT.replace("\"stiffness\": 2000", "\"stiffness\": 0");
    assert_eq!(class(&damper, "spring").0, 0);
    assert_eq!(class(&damper, "damper").0, 4);
    assert_eq!(class(STRUT, "load-value").1, ["1.25 kN", "12.5 N·m"]);
}
