//! Numbers are read back from figures.

use super::*;

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
