//! Pages of `modes -o` and `check -o`: drawings that move, and drawings that say what is wrong.

use super::*;

/// The drawings of a page, and the page without them.
fn drawings(html: &str) -> (Vec<String>, String) {
    let mut rest = html;
    let (mut found, mut text) = (Vec::new(), String::new());
    while let Some(at) = rest.find("<svg") {
        let end = at + rest[at..].find("</svg>").expect("an end") + "</svg>".len();
        found.push(rest[at..end].to_string());
        text += &rest[..at];
        rest = &rest[end..];
    }
    (found, text + rest)
}

/// Nothing comes from anywhere else, and nothing runs.
fn assert_alone(html: &str) {
    for outside in ["<script", "<link", "src=", "url(", "@import", "href="] {
        assert!(!html.contains(outside), "{outside}");
    }
}

/// Corners over time of all parts of a class.
fn motions(svg: &str, class: &str) -> Vec<Vec<Vec<[f64; 2]>>> {
    let document = Document::parse(svg).expect("XML");
    let corners = |text: &str| -> Vec<[f64; 2]> {
        let pairs = text
            .split(' ')
            .map(|pair| pair.split_once(',').expect("x,y"));
        pairs
            .map(|(x, y)| [x, y].map(|number| number.parse().expect("a number")))
            .collect()
    };
    let frames = |node: Node| -> Option<Vec<Vec<[f64; 2]>>> {
        let animate = node
            .children()
            .find(|child| child.has_tag_name("animate"))?;
        let values = animate.attribute("values").expect("values");
        Some(values.split(';').map(corners).collect())
    };
    let parts = of_class(&document, class).into_iter();
    parts.filter_map(frames).collect()
}

#[test]
fn modes_move_on_a_page() {
    let scratch = Scratch::new("modes-page");
    let said = scratch.done(&["modes", "double-pendulum", "-o", "out"]);
    assert!(said.contains("modes.html"), "{said}");
    let html = scratch.text("out/modes.html");
    assert_alone(&html);
    let (drawings, text) = drawings(&html);
    assert_eq!(drawings.len(), 2, "one for each mode");
    for words in [
        "Mode 1: 0.381526 Hz",
        "Mode 2: 0.921086 Hz",
        "damping ratio ζ 0",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    // Middles of outlines over time. Equal rods have the shapes (1, √2) and (1, −√2) of angles, so that the middle of the lower rod
    // goes 2 + √2 and 2 − √2 times as far as that of the upper one. Angles are below 0.15: sines are short of them by 0.4 %.
    let middle =
        |frame: &Vec<[f64; 2]>| frame.iter().map(|[x, _]| x).sum::<f64>() / frame.len() as f64;
    for (svg, ratio) in drawings
        .iter()
        .zip([2.0 + 2.0_f64.sqrt(), 2.0 - 2.0_f64.sqrt()])
    {
        let bodies = motions(svg, "body");
        assert_eq!(bodies.len(), 2);
        let [upper, lower] = [0, 1].map(|k| {
            let frames: Vec<f64> = bodies[k].iter().map(middle).collect();
            let half = frames.len() / 2;
            assert!((frames[0] - frames[2 * half]).abs() < 0.01, "it comes back");
            frames[0] - frames[half]
        });
        assert!(upper.abs() > 1.0 && lower.abs() > 1.0, "{upper} {lower}");
        assert!(
            (lower / upper / ratio - 1.0).abs() < 0.03,
            "{upper} {lower}, not {ratio} times"
        );
        // Not so far that it leaves the page: 7 % of the mechanism's size to each side.
        let width = 420.0;
        let places = bodies.iter().flatten().flatten();
        assert!(places.clone().all(|[x, _]| (0.0..=width).contains(x)));
    }
}

/// A mode without oscillation goes back to rest once, and no page is left of a model without modes.
#[test]
fn an_overdamped_mode_fades() {
    let scratch = Scratch::new("fading-mode");
    scratch.write(
        "m.json",
        r#"{ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "O": [0, 0] } },
            "arm": { "mass": 1, "inertia": 1, "com": [0, 0], "points": { "O": [0, 0], "A": [1, 0] } } },
        "joints": { "o": { "type": "revolute", "between": ["ground.O", "arm.O"] } },
        "forces": { "s": { "type": "torsion_spring", "between": ["ground", "arm"], "stiffness": 1, "damping": 10 } } }"#,
    );
    scratch.done(&["modes", "m.json", "-o", "out"]);
    let html = scratch.text("out/modes.html");
    let (drawings, text) = drawings(&html);
    assert_eq!(drawings.len(), 2);
    assert!(
        text.contains("Mode 1: does not swing: it fades by e in"),
        "{text}"
    );
    let arm = &motions(&drawings[0], "body")[0];
    let ends: Vec<f64> = arm.iter().map(|frame| frame[0][1]).collect();
    let falls = ends
        .windows(2)
        .all(|pair| (pair[1] - ends[16]).abs() <= (pair[0] - ends[16]).abs());
    assert!(falls, "{ends:?}");
}

#[test]
fn a_model_is_drawn_with_its_names_and_loops() {
    let scratch = Scratch::new("check-page");
    let said = scratch.done(&["check", "watt-i-lock", "-o", "out"]);
    assert!(said.contains("written       out/check.html"), "{said}");
    let html = scratch.text("out/check.html");
    assert_alone(&html);
    let (drawings, text) = drawings(&html);
    let document = Document::parse(&drawings[0]).expect("XML");
    let names = |class: &str| -> Vec<String> {
        of_class(&document, class).into_iter().map(label).collect()
    };
    assert_eq!(
        names("body-name"),
        ["link2", "link3", "link4", "link5", "link6"]
    );
    assert_eq!(names("joint-name"), ["a", "b", "c", "d", "e", "f", "g"]);
    assert_eq!(of_class(&document, "loop").len(), 2);
    assert_eq!(points(of_class(&document, "loop")[1]).len(), 4);
    assert!(text.contains("a – b – c – g"), "{text}");
    assert!(text.contains("Nothing is wrong"), "{text}");
    assert_eq!(of_class(&document, "gap").len(), 0, "all pins are closed");
}

/// What does not close is seen open, with the message's text beside, and the exit status stays.
#[test]
fn what_is_wrong_stands_at_its_place() {
    let scratch = Scratch::new("check-open");
    let run = |arguments: &[&str]| {
        let output = scratch.linkdyn(arguments);
        (output.status.code(), scratch.text("out/check.html"))
    };
    let (code, html) = run(&[
        "check",
        "four-bar",
        "--set",
        "parameters.coupler=20 mm",
        "-o",
        "out",
    ]);
    assert_ne!(code, Some(0));
    let (found, text) = drawings(&html);
    assert!(
        text.contains("the loop a – b – c – d does not close"),
        "{text}"
    );
    let document = Document::parse(&found[0]).expect("XML");
    assert_eq!(of_class(&document, "gap").len(), 1, "pin c is open");
    assert_eq!(of_class(&document, "finding").len(), 1);
    // A joint too many, at its pin; a body of odd mass, near its middle.
    let (code, html) = run(&[
        "check",
        "parallel-crank",
        "--set",
        "bodies.crank2.mass=5000 kg",
        "-o",
        "out",
    ]);
    assert_eq!(code, Some(0));
    let (found, text) = drawings(&html);
    assert!(text.contains("Redundant: b"), "{text}");
    assert!(text.contains("bodies.crank2.mass"), "{text}");
    let document = Document::parse(&found[0]).expect("XML");
    let numbers: Vec<String> = of_class(&document, "finding-number")
        .into_iter()
        .map(label)
        .collect();
    assert!(numbers.len() >= 2 && numbers[0] == "1", "{numbers:?}");
}

/// Names are text, whatever they are.
#[test]
fn hostile_names_stay_text_on_pages() {
    let scratch = Scratch::new("check-hostile");
    scratch.write(
        "m.json",
        r#"{ "format": "linkdyn/1", "units": "SI", "name": "</title><script>alert(1)</script>",
        "bodies": { "ground": { "points": { "O": [0, 0] } },
            "<b>&\"'": { "mass": 1, "inertia": 1, "com": [1, 0], "points": { "O": [0, 0], "A": [1, 0] } } },
        "gravity": [0, -9.81],
        "joints": { "</svg><img>": { "type": "revolute", "between": ["ground.O", "<b>&\"'.O"] } } }"#,
    );
    scratch.done(&["check", "m.json", "-o", "out"]);
    scratch.done(&["modes", "m.json", "-o", "out"]);
    for page in ["out/check.html", "out/modes.html"] {
        let html = scratch.text(page);
        assert!(
            !html.contains("<script") && !html.contains("<img"),
            "{page}"
        );
        for svg in drawings(&html).0 {
            Document::parse(&svg).expect("XML");
        }
    }
}

/// A model that is refused is drawn without what is wrong in it, and broken text is shown.
#[test]
fn what_is_refused_is_drawn_as_far_as_it_goes() {
    let scratch = Scratch::new("check-refused");
    let crank = |joint: &str, force: &str| {
        format!(
            r#"{{ "format": "linkdyn/1", "units": "SI",
  "bodies": {{ "ground": {{ "points": {{ "O": [0, 0] }} }},
             "crank": {{ "points": {{ "O": [0, 0], "A": [0.1, 0] }} }},
             "rod": {{ "points": {{ "A": [0, 0], "B": [0.2, 0] }}, "pose": {{ "position": [0.1, 0] }} }} }},
  "joints": {{ "a": {{ "type": "revolute", "between": ["ground.O", "crank.O"] }},
             "b": {{ "type": "revolute", "between": ["{joint}", "rod.A"] }} }},
  "forces": {{ "push": {{ "type": "force", "at": "{force}", "vector": [1, 0] }} }} }}"#
        )
    };
    let page = |model: &str, said: &str| {
        scratch.write("m.json", model);
        scratch.refused(&["check", "m.json", "-o", "out"], said);
        let html = scratch.text("out/check.html");
        assert_alone(&html);
        html
    };
    let html = page(&crank("crank.Q", "rod.Z"), "has no point \"Q\"");
    let (found, text) = drawings(&html);
    assert!(
        text.contains("has no point &quot;Q&quot;") || text.contains("has no point \"Q\""),
        "{text}"
    );
    let document = Document::parse(&found[0]).expect("XML");
    let names: Vec<String> = of_class(&document, "body-name")
        .into_iter()
        .map(label)
        .collect();
    assert_eq!(names, ["crank", "rod"]);
    let joints: Vec<String> = of_class(&document, "joint-name")
        .into_iter()
        .map(label)
        .collect();
    assert_eq!(joints, ["a"], "the joint that is wrong is left out");
    let text = html.replace("&quot;", "\"");
    for quote in [
        r#"<pre><span class="line">6</span>…"type": "revolute", "between": [<mark>"crank.Q"</mark>, "rod.A"] } },</pre>"#,
        r#"<mark>"rod.Z"</mark>"#,
    ] {
        assert!(text.contains(quote), "{quote} in {text}");
    }
    let numbers: Vec<String> = of_class(&document, "finding-number")
        .into_iter()
        .map(label)
        .collect();
    assert!(
        ["1", "2"]
            .iter()
            .all(|number| numbers.contains(&number.to_string())),
        "{numbers:?}"
    );
    let html = page(
        &crank("crank.A", "rod.B").replace("\"joints\": {", "\"joints\": {,"),
        "not JSON",
    );
    let marked = html
        .lines()
        .find(|line| line.contains('▸'))
        .expect("the line");
    assert!(
        marked.contains("joints") && html.contains("There is no drawing"),
        "{marked}"
    );
}

/// All loops can be seen, six of them at once.
#[test]
fn many_loops_are_drawn_on_choice() {
    let scratch = Scratch::new("check-loops");
    let points = |y: f64| -> String {
        let all: Vec<String> = (0..9).map(|k| format!("\"P{k}\": [{k}, {y}]")).collect();
        all.join(", ")
    };
    let bars: String = (0..9)
        .map(|k| {
            format!(", \"l{k}\": {{ \"points\": {{ \"A\": [0, 0], \"B\": [0, 1] }}, \"pose\": {{ \"position\": [{k}, 0] }} }}")
        })
        .collect();
    let joints: Vec<String> = (0..9)
        .flat_map(|k| {
            [("a", format!("ground.P{k}"), "A"), ("b", format!("top.P{k}"), "B")].map(|(name, at, end)| {
                format!("\"{name}{k}\": {{ \"type\": \"revolute\", \"between\": [\"{at}\", \"l{k}.{end}\"] }}")
            })
        })
        .collect();
    let model = format!(
        "{{ \"format\": \"linkdyn/1\", \"units\": \"SI\", \"bodies\": {{ \"ground\": {{ \"points\": {{ {} }} }}, \
         \"top\": {{ \"points\": {{ {} }}, \"pose\": {{ \"position\": [0, 1] }} }}{bars} }}, \"joints\": {{ {} }} }}",
        points(0.0),
        points(0.0),
        joints.join(", ")
    );
    scratch.write("m.json", &model);
    scratch.linkdyn(&["check", "m.json", "-o", "out"]);
    let html = scratch.text("out/check.html");
    let (found, _) = drawings(&html);
    let document = Document::parse(&found[0]).expect("XML");
    let loops = of_class(&document, "loop");
    let names: Vec<&str> = loops
        .iter()
        .filter_map(|node| node.attribute("id"))
        .collect();
    assert_eq!(names.len(), 8, "{names:?}");
    for (index, name) in names.iter().enumerate() {
        assert_eq!(*name, format!("loop-{index}"));
        assert!(html.contains(&format!("#{name}{{display:none}}")), "{name}");
        let shown = format!("id=\"show-{index}\" checked>");
        assert_eq!(html.contains(&shown), index < 6, "{name}");
    }
}

/// Forces and drivers that a message names have its number where they act.
#[test]
fn findings_stand_at_forces_and_drivers() {
    let scratch = Scratch::new("check-forces");
    let model = r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg" },
  "bodies": { "ground": { "points": { "O": [0, 0], "F": [0, 300] } },
              "arm": { "points": { "O": [0, 0], "A": [400, 0] }, "mass": 1, "inertia": 1, "com": [200, 0] } },
  "joints": { "o": { "type": "revolute", "between": ["ground.O", "arm.O"] } },
  "forces": { "strut": { "type": "spring", "between": ["ground.F", "arm.A"], "stiffness": 2000, "free_length": 500000 } },
  "analysis": { "type": "dynamics", "end": 1, "outputs": 11 } }"#;
    scratch.write("m.json", model);
    scratch.linkdyn(&["check", "m.json", "-o", "out"]);
    let html = scratch.text("out/check.html");
    let (found, text) = drawings(&html);
    assert!(text.contains("forces.strut"), "{text}");
    let document = Document::parse(&found[0]).expect("XML");
    assert!(!of_class(&document, "finding-number").is_empty(), "{text}");
}
