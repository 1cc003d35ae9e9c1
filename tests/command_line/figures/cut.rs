//! Axes that end where a few peaks would flatten everything else, and what is told of the peaks.

use super::*;

/// Left, top, right, bottom \[pt\].
type Bounds = [f64; 4];

fn number(node: Node, name: &str) -> f64 {
    let text = node.attribute(name).expect(name);
    text.parse().expect("a number")
}

/// What a text that reads from left to right, or upwards, covers.
fn bounds(node: Node) -> Bounds {
    let [x, y, size] = ["x", "y", "font-size"].map(|name| number(node, name));
    let wide = linkdyn_picture::font::width(&label(node), size);
    let start = match node.attribute("text-anchor") {
        Some("middle") => 0.5,
        Some("end") => 1.0,
        _ => 0.0,
    };
    let [ascent, descent] = [0.72 * size, 0.2 * size];
    match node.attribute("transform") {
        None => [
            x - start * wide,
            y - ascent,
            x + (1.0 - start) * wide,
            y + descent,
        ],
        Some(_) => [
            x - ascent,
            y - (1.0 - start) * wide,
            x + descent,
            y + start * wide,
        ],
    }
}

fn meet(a: Bounds, b: Bounds) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// What places cover.
fn around(node: Node) -> Bounds {
    let places = points(node);
    let axis = |k: usize| places.iter().map(move |place| place[k]);
    let low = |k| axis(k).fold(f64::INFINITY, f64::min);
    let high = |k| axis(k).fold(f64::NEG_INFINITY, f64::max);
    [low(0), low(1), high(0), high(1)]
}

/// Two units, so two panels, with peaks to both sides and a pole; a curve without any.
fn table() -> String {
    let mut text = String::from("time[s],a.torque[N*m],b.torque[N*m],a.ratio[1],a.y[m]\n");
    for k in 0..400 {
        let t = 0.01 * f64::from(k);
        let calm = (3.0 * t).sin();
        let a = match k {
            120 => 628.6,
            300 => -55.0,
            _ => calm,
        };
        let b = if k == 125 { 1234.5 } else { 0.5 * calm };
        let pole = 1.0 / (t - 2.004);
        text += &format!("{t},{a},{b},{pole},{calm}\n");
    }
    text
}

const BOTH: [&str; 4] = ["--y", "?.torque", "a.ratio", "a.y"];

#[test]
fn peaks_have_a_mark_and_a_value() {
    let scratch = Scratch::new("cut");
    scratch.write("r.csv", &table());
    let said = scratch.done(&[&["plot", "r.csv", "-o", "a.svg"], &BOTH[..]].concat());
    for told in [
        "cut off       a.torque: 628.6 N·m at 1.200 s",
        "a.torque: −55.00 N·m at 3.000 s",
        "b.torque: 1234 N·m at 1.250 s",
        "a.ratio: 166.7 at 2.010 s",
        "a.ratio: −250.0 at 2.000 s",
    ] {
        assert!(said.contains(told), "{told:?} is not in {said}");
    }
    let svg = scratch.text("a.svg");
    let document = Document::parse(&svg).expect("XML");
    let texts: Vec<String> = of_class(&document, "peak").into_iter().map(label).collect();
    assert_eq!(texts.len(), 5, "{texts:?}");
    assert!(texts.contains(&"a.torque: 628.6 N·m at 1.200 s".to_string()));
    // A mark at each end that is cut, one before each text.
    assert_eq!(of_class(&document, "peak-mark").len(), 10);
    let frames: Vec<Bounds> = of_class(&document, "frame")
        .into_iter()
        .map(around)
        .collect();
    let at_edges = of_class(&document, "peak-mark")
        .into_iter()
        .map(around)
        .filter(|[_, top, _, bottom]| {
            let near = |a: f64, b: f64| (a - b).abs() < 0.01;
            let ends = |frame: &Bounds| near(*top, frame[1]) || near(*bottom, frame[3]);
            frames.iter().any(ends)
        });
    assert_eq!(at_edges.count(), 5);
    // Who wants all has all.
    let said = scratch.done(&[&["plot", "r.csv", "--whole", "-o", "b.svg"], &BOTH[..]].concat());
    assert!(!said.contains("cut off"), "{said}");
    assert!(!scratch.text("b.svg").contains("peak"));
    // A range that was asked for hides nothing unsaid either.
    let ranged = ["plot", "r.csv", "--y", "a.y", "--y-range=-0.5:0.5"];
    let said = scratch.done(&[&ranged[..], &["-o", "c.svg"]].concat());
    assert!(
        said.contains("cut off       a.y: 1.000 m at 2.620 s"),
        "{said}"
    );
    // Nor has a curve without peaks a mark.
    let said = scratch.done(&["plot", "r.csv", "--y", "a.y", "-o", "d.svg"]);
    assert!(!said.contains("cut off") && !scratch.text("d.svg").contains("peak"));
}

/// Values of peaks meet neither legend, ticks, frames, marks nor each other, whatever the size of the page.
#[test]
fn values_of_peaks_have_their_own_place() {
    let scratch = Scratch::new("cut-place");
    scratch.write("r.csv", &table());
    for size in [
        &[][..],
        &["--size", "180x80"],
        &["--size", "60x120", "--font-size", "6"],
        &["--size", "88x72"],
    ] {
        let more = [
            "--mark",
            "1.2=change point",
            "--title",
            "Torque",
            "-o",
            "a.svg",
        ];
        scratch.done(&[&["plot", "r.csv"], &BOTH[..], &more, size].concat());
        let svg = scratch.text("a.svg");
        let document = Document::parse(&svg).expect("XML");
        let peaks = of_class(&document, "peak");
        // A page too low for them has the marks alone.
        assert!(!peaks.is_empty() || size == ["--size", "88x72"], "{size:?}");
        let view = document.root_element().attribute("viewBox");
        let sizes: Vec<f64> = view
            .expect("a size")
            .split(' ')
            .map(|size| size.parse().expect("points"))
            .collect();
        let [wide, high] = [sizes[2], sizes[3]];
        let texts = document
            .descendants()
            .filter(|node| node.has_tag_name("text"));
        let others: Vec<(String, Bounds)> = texts
            .map(|node| (label(node), bounds(node)))
            .chain(
                of_class(&document, "frame")
                    .into_iter()
                    .map(|node| ("frame".into(), around(node))),
            )
            .chain(
                of_class(&document, "x-tick")
                    .into_iter()
                    .map(|node| ("tick".into(), around(node))),
            )
            .collect();
        for peak in peaks {
            let own = bounds(peak);
            assert!(
                own[0] >= 0.0 && own[1] >= 0.0 && own[2] <= wide && own[3] <= high,
                "{size:?}: {} at {own:?} of {wide} × {high}",
                label(peak)
            );
            for (text, other) in &others {
                assert!(
                    *text == label(peak) || !meet(own, *other),
                    "{size:?}: {} at {own:?} meets {text} at {other:?}",
                    label(peak)
                );
            }
        }
    }
}
