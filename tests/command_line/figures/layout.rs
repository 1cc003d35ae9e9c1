//! Axes, panels and legends.

use super::*;

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

/// Upper and lower edges of a figure's panels.
fn frames(scratch: &Scratch, file: &str) -> Vec<[f64; 2]> {
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
}

/// A page that may have any height gives the legend its own.
#[test]
fn legends_leave_room_for_the_curves() {
    let scratch = Scratch::new("room");
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
    let [[upper, lower]] = frames(&scratch, "a.svg")[..] else {
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
}

/// Labels of neighbouring panels never meet, whatever the size.
#[test]
fn labels_of_many_panels_never_meet() {
    let scratch = Scratch::new("labels");
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
        assert_eq!((labels.len(), frames(&scratch, "c.svg").len()), (9, 9));
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
