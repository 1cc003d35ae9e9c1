//! Figures: numbers can be read back from them, names can't break them, files are what they say.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use roxmltree::{Document, Node};

/// An empty directory of its own, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("figures-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a scratch directory");
        Scratch(path)
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).expect("UTF-8")
    }

    fn linkdyn(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        command
            .args(arguments)
            .current_dir(&self.0)
            .stdin(Stdio::null())
            .output()
            .expect("the binary runs")
    }

    /// Runs, asserts exit status 0 and silence on standard error.
    #[track_caller]
    fn done(&self, arguments: &[&str]) -> String {
        let output = self.linkdyn(arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(
            (output.status.code(), said.as_ref()),
            (Some(0), ""),
            "{arguments:?}"
        );
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    /// Runs, asserts exit status 2 and a text on standard error.
    #[track_caller]
    fn refused(&self, arguments: &[&str], said: &str) {
        let output = self.linkdyn(arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
        assert!(
            stderr.contains(said),
            "{arguments:?}: {said:?} is not in {stderr:?}"
        );
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Elements of a class, in order.
fn of_class<'a, 'input>(document: &'a Document<'input>, class: &str) -> Vec<Node<'a, 'input>> {
    document
        .descendants()
        .filter(|node| node.attribute("class") == Some(class))
        .collect()
}

fn points(node: Node) -> Vec<[f64; 2]> {
    let text = node.attribute("points").expect("points");
    let pair = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        [x.parse().expect("a number"), y.parse().expect("a number")]
    };
    text.split(' ').map(pair).collect()
}

/// The text of a label.
fn label(node: Node) -> String {
    node.descendants()
        .filter_map(|node| if node.is_text() { node.text() } else { None })
        .collect()
}

/// Value by place, from the outermost two printed numbers and their tick marks: slope and value at place 0.
fn axis(document: &Document, axis: usize) -> [f64; 2] {
    let [ticks, numbers] = [["x-tick", "x-number"], ["y-tick", "y-number"]][axis];
    let places: Vec<f64> = of_class(document, ticks)
        .into_iter()
        .map(|tick| points(tick)[0][axis])
        .collect();
    let numbers: Vec<f64> = of_class(document, numbers)
        .into_iter()
        .map(|number| {
            label(number)
                .replace('−', "-")
                .parse()
                .expect("a printed number")
        })
        .collect();
    assert_eq!(places.len(), numbers.len());
    let last = places.len() - 1;
    let slope = (numbers[last] - numbers[0]) / (places[last] - places[0]);
    [slope, numbers[0] - slope * places[0]]
}

/// Values of all curves as they can be read off the printed axes.
fn read_off(svg: &str) -> Vec<Vec<[f64; 2]>> {
    let document = Document::parse(svg).expect("XML");
    let axes = [axis(&document, 0), axis(&document, 1)];
    let value = |place: [f64; 2]| -> [f64; 2] {
        std::array::from_fn(|i| axes[i][1] + axes[i][0] * place[i])
    };
    of_class(&document, "curve")
        .into_iter()
        .map(|curve| points(curve).into_iter().map(value).collect())
        .collect()
}

fn cells(csv: &str, columns: [usize; 2]) -> Vec<[f64; 2]> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        columns.map(|column| cells[column].parse().unwrap_or(f64::NAN))
    };
    csv.lines().skip(1).map(row).collect()
}

#[test]
fn the_numbers_can_be_read_off_the_figure() {
    let scratch = Scratch::new("read-off");
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=101",
        "-o",
        "out",
    ]);
    let csv = scratch.text("out/results.csv");
    let column = |name: &str| {
        csv.lines()
            .next()
            .expect("a header")
            .split(',')
            .position(|c| c == name)
            .expect(name)
    };
    let [time, omega] = [column("time[s]"), column("rocker.omega[rad/s]")];
    scratch.done(&[
        "plot",
        "out",
        "--y",
        "rocker.omega",
        "--x-range",
        "0:2",
        "-o",
        "a.svg",
    ]);
    scratch.done(&[
        "plot",
        "out/results.csv",
        "--y",
        "rocker.omega[rad/s]",
        "--units",
        "rpm,ms",
        "-o",
        "b.svg",
    ]);
    for (file, factors) in [
        ("a.svg", [1.0, 1.0]),
        ("b.svg", [1e3, 30.0 / std::f64::consts::PI]),
    ] {
        let curves = read_off(&scratch.text(file));
        let data = cells(&csv, [time, omega]);
        assert_eq!((curves.len(), curves[0].len()), (1, data.len()));
        for axis in 0..2 {
            let size = data
                .iter()
                .map(|row| (factors[axis] * row[axis]).abs())
                .fold(0.0, f64::max);
            for (read, row) in curves[0].iter().zip(&data) {
                // Places are printed to a thousandth of a point, of some 200.
                let difference = (read[axis] - factors[axis] * row[axis]).abs();
                assert!(
                    difference < 3e-5 * size,
                    "{file} axis {axis}: {} is not {}",
                    read[axis],
                    factors[axis] * row[axis]
                );
            }
        }
    }
}

#[test]
fn empty_cells_are_gaps() {
    let scratch = Scratch::new("gaps");
    scratch.write(
        "r.csv",
        "time[s],a[m]\n0,0\n1,1\n2,\n3,1\n4,2\n5,\n6,3\n7,\n",
    );
    let said = scratch.done(&["plot", "r.csv", "--y", "a", "-o", "a.svg"]);
    assert!(said.contains("3 rows without a value"), "{said}");
    let svg = scratch.text("a.svg");
    let curves = read_off(&svg);
    let rounded: Vec<Vec<[f64; 2]>> = curves
        .iter()
        .map(|curve| {
            curve
                .iter()
                .map(|place| place.map(|value| (value * 1e3).round() / 1e3))
                .collect()
        })
        .collect();
    assert_eq!(
        rounded,
        [vec![[0.0, 0.0], [1.0, 1.0]], vec![[3.0, 1.0], [4.0, 2.0]]]
    );
    let document = Document::parse(&svg).expect("XML");
    assert_eq!(
        of_class(&document, "dot").len(),
        1,
        "a single value between gaps is a dot"
    );
}

#[test]
fn one_row_a_constant_and_a_log_axis_are_drawn() {
    let scratch = Scratch::new("few");
    scratch.write("one.csv", "time[s],a[m]\n0,5\n");
    scratch.done(&["plot", "one.csv", "--y", "a", "-o", "a.svg"]);
    assert!(scratch.text("a.svg").contains("class=\"dot\""));
    scratch.write(
        "log.csv",
        "time[s],a[m]\n0,1\n1,1000\n2,0\n3,-5\n4,10\n5,100\n",
    );
    let said = scratch.done(&[
        "plot", "log.csv", "--y", "a", "--log-y", "--grid", "-o", "b.svg",
    ]);
    assert!(said.contains("2 rows at or below 0"), "{said}");
    let svg = scratch.text("b.svg");
    let document = Document::parse(&svg).expect("XML");
    let curves: Vec<Vec<[f64; 2]>> = of_class(&document, "curve")
        .into_iter()
        .map(points)
        .collect();
    assert_eq!(curves.len(), 2);
    // Three decades up, one decade up.
    let rise = |curve: &Vec<[f64; 2]>| curve[0][1] - curve[1][1];
    assert!(
        (rise(&curves[0]) / rise(&curves[1]) - 3.0).abs() < 1e-3,
        "{curves:?}"
    );
}

#[test]
fn panels_and_legends_follow_units_and_runs() {
    let scratch = Scratch::new("panels");
    let table = |v: f64| format!("time[s],a.omega[rad/s],a.fx[N],b.fx[N]\n0,1,2,3\n1,{v},4,5\n");
    scratch.write("ideal/results.csv", &table(2.0));
    scratch.write("worn/results.csv", &table(3.0));
    let texts = |file: &str, class: &str| -> Vec<String> {
        let svg = scratch.text(file);
        let document = Document::parse(&svg).expect("XML");
        of_class(&document, class).into_iter().map(label).collect()
    };
    scratch.done(&["plot", "ideal", "worn", "--y", "a.omega", "-o", "a.svg"]);
    assert_eq!(texts("a.svg", "legend"), ["ideal", "worn"]);
    assert_eq!(texts("a.svg", "y-label"), ["a.omega [rad/s]"]);
    scratch.done(&[
        "plot",
        "ideal",
        "--y",
        "a.omega",
        "?.fx",
        "--mark",
        "0.5=middle",
        "-o",
        "b.svg",
    ]);
    assert_eq!(texts("b.svg", "legend"), ["a.omega", "a.fx", "b.fx"]);
    assert_eq!(texts("b.svg", "y-label"), ["a.omega [rad/s]", "force [N]"]);
    assert_eq!(texts("b.svg", "mark-label"), ["middle"]);
    scratch.done(&[
        "plot", "ideal", "worn", "--y", "*.fx", "--label", "new", "--label", "old", "-o", "c.svg",
    ]);
    assert_eq!(
        texts("c.svg", "legend"),
        ["a.fx, new", "b.fx, new", "a.fx, old", "b.fx, old"]
    );
}

/// A page that may have any height gives the legend its own; labels of neighbouring panels never meet, whatever the size.
#[test]
fn legends_and_many_panels_leave_room_for_the_curves() {
    let scratch = Scratch::new("room");
    let frames = |file: &str| -> Vec<[f64; 2]> {
        let svg = scratch.text(file);
        let document = Document::parse(&svg).expect("XML");
        let span = |frame: Node| {
            let heights: Vec<f64> = points(frame).into_iter().map(|[_, y]| y).collect();
            [
                heights.iter().copied().fold(f64::INFINITY, f64::min),
                heights.iter().copied().fold(0.0, f64::max),
            ]
        };
        of_class(&document, "frame").into_iter().map(span).collect()
    };
    let names: Vec<String> = (0..16)
        .map(|k| format!("a_body_with_a_long_name_{k}.omega"))
        .collect();
    let heads: Vec<String> = names.iter().map(|name| format!("{name}[rad/s]")).collect();
    let row = |t: usize| {
        (0..16)
            .map(|k| (k * t).to_string())
            .collect::<Vec<_>>()
            .join(",")
    };
    scratch.write(
        "r.csv",
        &format!("time[s],{}\n0,{}\n1,{}\n", heads.join(","), row(0), row(1)),
    );
    scratch.done(&["plot", "r.csv", "--y", "*.omega", "-o", "a.svg"]);
    let [[upper, lower]] = frames("a.svg")[..] else {
        panic!("one panel")
    };
    assert!(
        lower - upper > 100.0,
        "{} points are left of 16 rows of legend",
        lower - upper
    );
    // A height that is asked for is kept.
    scratch.refused(
        &[
            "plot", "r.csv", "--y", "*.omega", "-o", "b.svg", "--height", "60",
        ],
        "too small",
    );

    let units = [
        "m", "m/s", "m/s^2", "rad", "rad/s", "rad/s^2", "N", "N*m", "J",
    ];
    let heads: Vec<String> = units
        .iter()
        .zip(1..)
        .map(|(unit, k)| format!("crank.angular_acceleration_{k}[{unit}]"))
        .collect();
    scratch.write(
        "p.csv",
        &format!(
            "time[s],{}\n0{}\n1{}\n",
            heads.join(","),
            ",1".repeat(9),
            ",2".repeat(9)
        ),
    );
    for (size, whole) in [(&[][..], true), (&["--size", "88x240"], false)] {
        scratch.done(&[&["plot", "p.csv", "--y", "crank.*", "-o", "c.svg"], size].concat());
        let svg = scratch.text("c.svg");
        let document = Document::parse(&svg).expect("XML");
        let labels: Vec<(f64, String)> = of_class(&document, "y-label")
            .into_iter()
            .map(|node| {
                (
                    node.attribute("y")
                        .and_then(|y| y.parse().ok())
                        .expect("a place"),
                    label(node),
                )
            })
            .collect();
        assert_eq!((labels.len(), frames("c.svg").len()), (9, 9));
        assert!(
            !whole || labels.iter().all(|(_, text)| !text.contains('…')),
            "{labels:?}"
        );
        let long = |text: &str| linkdyn_picture::font::width(text, 8.0);
        for pair in labels.windows(2) {
            let (above, below) = (&pair[0], &pair[1]);
            let gap = below.0 - above.0 - 0.5 * (long(&above.1) + long(&below.1));
            assert!(gap > 2.0, "{gap} points between {above:?} and {below:?}");
        }
    }
}

#[test]
fn the_largest_numbers_are_read_off_as_they_are() {
    let scratch = Scratch::new("largest");
    scratch.write("r.csv", "time[s],a[m]\n0,-1e308\n1,1e308\n");
    scratch.done(&["plot", "r.csv", "--y", "a", "-o", "a.svg"]);
    let svg = scratch.text("a.svg");
    let curves = read_off(&svg);
    assert!(
        (curves[0][0][1] + 100.0).abs() < 0.1 && (curves[0][1][1] - 100.0).abs() < 0.1,
        "{curves:?}"
    );
    let document = Document::parse(&svg).expect("XML");
    assert_eq!(label(of_class(&document, "y-label")[0]), "a [10306 m]");
}

#[test]
fn tables_of_others_are_read_or_refused_with_the_reason() {
    let scratch = Scratch::new("foreign");
    scratch.write("semicolon.csv", "time[s];x[m]\n0;1\n");
    scratch.write("tab.csv", "time[s]\tx[m]\n0\t1\n");
    scratch.write("blanks.csv", "time[s], x[m], y [m]\n0, 1, 2\n1, 2, 3\n");
    scratch.write("mine.json", "{\n\"format\": \"linkdyn/1\" }");
    for (file, said) in [
        (
            "semicolon.csv",
            "semicolon.csv: its columns are separated by ';': commas are wanted",
        ),
        (
            "tab.csv",
            "tab.csv: its columns are separated by '\\t': commas are wanted",
        ),
        (
            "four-bar",
            "four-bar: a model, not its results (run it first: linkdyn run four-bar -o out; then name out)",
        ),
        ("mine.json", "mine.json: a model, not its results"),
    ] {
        scratch.refused(&["plot", file, "--y", "x", "-o", "a.svg"], said);
    }
    scratch.done(&["plot", "blanks.csv", "--y", "x", "y", "-o", "a.svg"]);
    scratch.done(&["plot", "blanks.csv", "--y", "x*", "-o", "a.svg"]);
}

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

#[test]
fn what_can_not_be_drawn_is_told() {
    let scratch = Scratch::new("refused");
    scratch.write(
        "r.csv",
        "time[s],crank.omega[rad/s],crank.x[m],what[m]\n0,1,2,no\n1,2,3,no\n",
    );
    scratch.write("empty.csv", "");
    scratch.write("header.csv", "time[s],a[m]\n");
    scratch.write("other.csv", "x,y\n1,2\n");
    scratch.write("void.csv", "time[s],a[m]\n0,\n1,\n");
    scratch.write("none/readme", "");
    let plot = |file: &str, rest: &[&str], said: &str| {
        let arguments = [&["plot", file, "-o", "a.svg"], rest].concat();
        scratch.refused(&arguments, said);
    };
    plot(
        "r.csv",
        &["--y", "crank.omga"],
        "r.csv: --y crank.omga: no column of that name (did you mean \"crank.omega\"",
    );
    plot(
        "r.csv",
        &["--y", "zz*"],
        "(there are: time, crank.omega, crank.x, what)",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--x", "tme"],
        "--x tme: no column of that name (did you mean \"time\"?)",
    );
    plot(
        "r.csv",
        &["--y", "what"],
        "line 2: \"no\" in column \"what[m]\" is not a number",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--units", "furlong"],
        "--units furlong: not a unit",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--x-unit", "deg"],
        "--x-unit deg: time[s] can't be told in it",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--x-range", "2:1"],
        "the first number must be less",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--size", "20x20", "--font-size", "40"],
        "too small",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--label", "a", "--label", "b"],
        "--label: 2 given for 1 columns",
    );
    plot("empty.csv", &["--y", "a"], "empty.csv: the file is empty");
    plot(
        "header.csv",
        &["--y", "a"],
        "header.csv: there is a header and no row",
    );
    plot("other.csv", &["--y", "y"], "names no column as name[unit]");
    plot("void.csv", &["--y", "a"], "nothing to draw");
    plot(
        "none",
        &["--y", "a"],
        "none: a directory without results.csv",
    );
    plot(
        "nowhere",
        &["--y", "a"],
        "nowhere: no such file or directory",
    );
    scratch.refused(
        &["plot", "r.csv", "--y", "time", "-o", "a.pdf"],
        "must end in .svg or .png",
    );
    let huge = [
        "plot",
        "r.csv",
        "--y",
        "crank.x",
        "--size",
        "2000x2000",
        "--dpi",
        "2400",
        "-o",
        "a.png",
    ];
    scratch.refused(&huge, "pixels are too many");
    assert!(
        !scratch.0.join("a.svg").exists(),
        "a refusal leaves no file"
    );
}

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

/// Width, height and pixels per metre of a PNG.
fn png_facts(bytes: &[u8]) -> [u32; 3] {
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("4 bytes"));
    let density = bytes
        .windows(4)
        .position(|word| word == b"pHYs")
        .expect("a resolution");
    assert_eq!(number(density + 4), number(density + 8));
    [number(16), number(20), number(density + 4)]
}

#[test]
fn a_png_has_the_size_and_resolution_asked_for() {
    let scratch = Scratch::new("png");
    scratch.write("r.csv", "time[s],a[m]\n0,1\n1,2\n");
    scratch.done(&[
        "plot", "r.csv", "--y", "a", "--size", "127x50.8", "--dpi", "200", "-o", "a.png",
    ]);
    // 5 in × 2 in; 200 dots per 25.4 mm.
    assert_eq!(png_facts(&scratch.read("a.png")), [1000, 400, 7874]);
    scratch.done(&["plot", "r.csv", "--y", "a", "--width", "180", "-o", "a.svg"]);
    let svg = scratch.text("a.svg");
    let root = Document::parse(&svg).expect("XML");
    assert_eq!(root.root_element().attribute("width"), Some("180mm"));
}

#[test]
fn figures_are_the_same_every_time() {
    let scratch = Scratch::new("same");
    scratch.write("r.csv", "time[s],a[m]\n0,1\n1,2\n2,0\n");
    for file in ["a.svg", "b.svg", "a.png", "b.png"] {
        scratch.done(&["plot", "r.csv", "--y", "a", "-o", file]);
    }
    assert_eq!(scratch.read("a.svg"), scratch.read("b.svg"));
    assert_eq!(scratch.read("a.png"), scratch.read("b.png"));
}

/// Width, height, and delay of each frame [1/100 s] of a GIF, by its blocks.
fn gif_facts(bytes: &[u8]) -> ([u16; 2], Vec<u16>) {
    assert_eq!(&bytes[..6], b"GIF89a");
    let number = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let table = |flags: u8| {
        if flags & 0x80 == 0 {
            0
        } else {
            3 << ((flags & 7) + 1)
        }
    };
    let mut at = 13 + table(bytes[10]);
    let mut delays = Vec::new();
    let skip = |mut at: usize| {
        while bytes[at] != 0 {
            at += 1 + usize::from(bytes[at]);
        }
        at + 1
    };
    while bytes[at] != 0x3b {
        match [bytes[at], bytes[at + 1]] {
            [0x21, 0xf9] => {
                delays.push(number(at + 4));
                at = skip(at + 2);
            }
            [0x21, _] => at = skip(at + 2),
            [0x2c, _] => at = skip(at + 10 + table(bytes[at + 9]) + 1),
            other => panic!("no block of a GIF: {other:?}"),
        }
    }
    assert_eq!(at + 1, bytes.len());
    ([number(6), number(8)], delays)
}

#[test]
fn a_film_has_the_frames_and_delays_asked_for() {
    let scratch = Scratch::new("film");
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=41",
        "-o",
        "out",
    ]);
    let said = scratch.done(&[
        "animate",
        "out",
        "-o",
        "a.gif",
        "--fps",
        "30",
        "--duration",
        "1",
        "--width",
        "200",
    ]);
    assert!(said.contains("30 frames in 1 s, 2 × real time"), "{said}");
    let ([width, _], delays) = gif_facts(&scratch.read("a.gif"));
    assert_eq!(
        (width, delays.len(), delays.iter().sum::<u16>()),
        (200, 30, 100)
    );
    assert!(
        delays.iter().all(|delay| (3..=4).contains(delay)),
        "{delays:?}"
    );
    // By itself as long as the motion.
    scratch.done(&[
        "animate",
        "out/results.csv",
        "-o",
        "b.gif",
        "--fps",
        "10",
        "--width",
        "100",
    ]);
    assert_eq!(gif_facts(&scratch.read("b.gif")).1, [10; 20]);
}

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

#[test]
fn what_can_not_be_animated_is_told() {
    let scratch = Scratch::new("not-animated");
    scratch.write("bare/results.csv", "time[s],crank.x[m]\n0,1\n");
    let animate = |results: &str, rest: &[&str], said: &str| {
        let arguments = [&["animate", results], rest].concat();
        scratch.refused(&arguments, said);
    };
    animate(
        "bare",
        &["-o", "a.gif"],
        "summary.json: no such file (name the model with --model",
    );
    animate(
        "bare",
        &["-o", "a.gif", "--model", "four-bar"],
        "no column crank.y, crank.angle",
    );
    animate(
        "bare",
        &["-o", "a.gif", "--model", "five-bar"],
        "no bundled model of that name",
    );
    animate("bare", &["-o", "a.mp4"], "must end in .gif, .svg or .png");
    animate(
        "bare",
        &["-o", "a.gif", "--fps", "1000"],
        "a number from 0.1 to 50 is wanted",
    );
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=3",
        "-o",
        "out",
    ]);
    animate(
        "out",
        &["-o", "a.svg", "--poses", "1000"],
        "1000 poses: from 1 to 64 can be drawn",
    );
    animate(
        "out",
        &["-o", "a.gif", "--width", "4000", "--duration", "600"],
        "pixels for all frames are too many",
    );
    scratch.write(
        "out/summary.json",
        r#"{"drawing":{"bodies":[],"joints":[],"springs":[],"traces":[[9,[0,0]]]}}"#,
    );
    animate(
        "out",
        &["-o", "a.gif"],
        "summary.json: the key \"drawing\" names a body that it does not have",
    );
    for (text, said) in [
        (
            r#"{"drawing":[1e999]}"#,
            "summary.json: not JSON that can be read (name the model with --model",
        ),
        (
            "{}",
            "summary.json: has no key \"drawing\", which tells the shape",
        ),
    ] {
        scratch.write("out/summary.json", text);
        animate("out", &["-o", "a.gif"], said);
    }
    for rest in [
        &["-o", "a.gif", "--poses", "4"][..],
        &["-o", "a.gif", "--strip"],
        &["-o", "a.gif", "--dpi", "100"],
    ] {
        animate("out", rest, "only for poses, and a .gif is a film");
    }
    animate(
        "out",
        &["-o", "a.svg", "--fps", "4"],
        "--fps: only for a film",
    );
    let ground = r#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "ground": { "points": { "O": [0, 0] } } },
        "analysis": { "type": "kinematics", "end": 1, "outputs": 3 } }"#;
    scratch.write("ground.json", ground);
    animate(
        "bare",
        &["-o", "a.gif", "--model", "ground.json"],
        "nothing to draw: the model has no body but the ground",
    );
    let columns = "analysis.columns=[\"crank.*\"]";
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=3",
        "--set",
        columns,
        "-o",
        "few",
    ]);
    animate(
        "few",
        &["-o", "a.gif"],
        "no column coupler.x, coupler.y, coupler.angle, rocker.x and 2 more",
    );
    assert!(
        !scratch.0.join("a.gif").exists(),
        "a refusal leaves no file"
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
