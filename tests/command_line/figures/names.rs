//! Names break nothing.

use super::*;

const HOSTILE: [&str; 6] = [
    "</text></svg><script>alert(1)</script>",
    "a\"b'c&amp;<>",
    "🔒 emoji",
    "\u{1b}[31mred\u{202e}\u{7}",
    "]]><!--",
    "&#x0;",
];

#[test]
fn hostile_names_break_nothing() {
    let scratch = Scratch::new("hostile");
    let long = "very long name ".repeat(5000);
    let names: Vec<&str> = HOSTILE.iter().copied().chain([long.as_str()]).collect();
    let header: Vec<String> = names
        .iter()
        .map(|name| format!("\"{}[m]\"", name.replace('"', "\"\"")))
        .collect();
    let row = |value: usize| {
        (0..names.len())
            .map(|i| (i + value).to_string())
            .collect::<Vec<_>>()
            .join(",")
    };
    scratch.write(
        "r.csv",
        &format!("time[s],{}\n0,{}\n1,{}\n", header.join(","), row(0), row(5)),
    );
    let rest = [
        "--y",
        "*",
        "--title",
        HOSTILE[0],
        "--note",
        HOSTILE[1],
        "--x-label",
        HOSTILE[3],
        "--mark",
        "0.5=</text>",
    ];
    for file in ["a.svg", "a.png"] {
        let arguments = [
            &["plot", "r.csv", "-o", file, "--height", "120"],
            rest.as_slice(),
        ]
        .concat();
        let said = scratch.done(&arguments);
        assert!(
            said.chars().all(|c| c == '\n' || !c.is_control()),
            "{said:?}"
        );
    }
    let svg = scratch.text("a.svg");
    let document = Document::parse(&svg).expect("XML in spite of the names");
    let known = [
        "svg", "title", "desc", "rect", "polyline", "polygon", "circle", "text", "tspan",
    ];
    for node in document.descendants().filter(Node::is_element) {
        assert!(known.contains(&node.tag_name().name()), "{node:?}");
    }
    assert_eq!(of_class(&document, "legend").len(), names.len());
    assert_eq!(label(of_class(&document, "legend")[0]), HOSTILE[0]);
    assert!(svg.len() < 20_000, "a long name is cut: {}", svg.len());
    assert!(
        svg.chars()
            .all(|c| c == '\n' || !c.is_control() && c != '\u{202e}')
    );
}

#[test]
fn hostile_body_names_are_drawn() {
    let scratch = Scratch::new("hostile-bodies");
    let names: Vec<String> = HOSTILE
        .iter()
        .map(|name| {
            name.replace(|c: char| c.is_control(), "")
                .replace(['.', ',', '=', '*', '?', '[', ']'], "")
        })
        .collect();
    let body = |name: &String| {
        format!(
            "{}: {{ \"points\": {{ \"O\": [0, 0], \"A\": [1, 0] }} }}",
            serde_json::json!(name)
        )
    };
    let joint = |name: &String| {
        let between = serde_json::json!(["ground.O", format!("{name}.O")]);
        format!(
            "{}: {{ \"type\": \"revolute\", \"between\": {between} }}",
            serde_json::json!(name)
        )
    };
    let driver = |name: &String| {
        let motion = r#"{ "type": "constant_velocity", "velocity": 1 }"#;
        format!(
            "{0}: {{ \"type\": \"rotation\", \"body\": {0}, \"motion\": {motion} }}",
            serde_json::json!(name)
        )
    };
    let all = |of: &dyn Fn(&String) -> String| names.iter().map(of).collect::<Vec<_>>().join(", ");
    let model = format!(
        r#"{{ "format": "linkdyn/1", "units": "SI", "name": "</title><script>", "bodies": {{ "ground": {{ "points": {{ "O": [0, 0] }} }}, {} }},
        "joints": {{ {} }}, "drivers": {{ {} }}, "analysis": {{ "type": "kinematics", "end": 1, "outputs": 5 }} }}"#,
        all(&body),
        all(&joint),
        all(&driver)
    );
    scratch.write("m.json", &model);
    scratch.done(&["run", "m.json", "-o", "out"]);
    scratch.done(&["animate", "out", "-o", "a.svg"]);
    scratch.done(&["animate", "out", "-o", "a.gif", "--width", "80"]);
    scratch.done(&[
        "plot", "out", "--y", "*.omega", "*.x", "-o", "b.svg", "--size", "180x150",
    ]);
    for file in ["a.svg", "b.svg"] {
        Document::parse(&scratch.text(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    }
    gif_facts(&scratch.read("a.gif"));
}
