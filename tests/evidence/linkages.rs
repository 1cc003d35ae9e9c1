//! Linkages of PMKS+ and pylinkage, read and run: positions over their range of motion against independent solutions and against what
//! the other programs publish or compute. The files and where they are from stand in `crates/exchange/tests/linkages`.

use linkdyn::prelude::*;
use linkdyn_exchange::{Format, Imported, Options, import};

const FILES: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/crates/exchange/tests/linkages"
);

fn file(name: &str) -> String {
    std::fs::read_to_string(format!("{FILES}/{name}")).expect("a file of the tests")
}

/// Names, and [x, y] at some instants.
type Places = Vec<(String, Vec<[f64; 2]>)>;

/// What a link of the collection says.
fn link(name: &str) -> String {
    let links = file("pmks-links.txt");
    let found = links
        .lines()
        .find_map(|line| line.strip_prefix(name)?.strip_prefix('\t'));
    found.expect("a link of this name").to_owned()
}

fn read(text: &str, format: Format) -> Imported {
    let read = import("", text.as_bytes(), Some(format), &Options::default());
    read.unwrap_or_else(|refused| panic!("{refused}"))
}

/// The unit of lengths \[m\].
fn unit(imported: &Imported) -> f64 {
    match imported
        .draft
        .units
        .get("length")
        .and_then(|unit| unit.as_str())
    {
        None => 1.0,
        Some("cm") => 0.01,
        Some(other) => panic!("{other}"),
    }
}

/// Positions of all points of moving bodies at the outputs: `body.point`, and [x, y] of each output in the unit of the file.
fn positions(imported: &Imported, end: f64, outputs: usize) -> Places {
    let mut draft = imported.draft.clone();
    draft.points.clear();
    for (body, entry) in draft.bodies.iter().filter(|(body, _)| *body != "ground") {
        let points = entry["points"].as_object().expect("points");
        draft
            .points
            .extend(points.keys().map(|point| format!("{body}.{point}")));
    }
    // Rank and mobility are asked for elsewhere; here no row is left out.
    draft.analysis.insert("type".into(), "kinematics".into());
    draft.analysis.insert("end".into(), end.into());
    draft.analysis.insert("outputs".into(), outputs.into());
    let mechanism: Mechanism = draft.text().parse().expect("a model");
    let run = mechanism.run().expect("it runs");
    assert_eq!(run.status(), Status::Completed, "{:?}", run.report());
    let unit = unit(imported);
    let points = draft.points.iter().map(|point| {
        let [x, y] = ["x", "y"].map(|axis| {
            let column = mechanism
                .column(&format!("{point}.{axis}"))
                .expect("a column");
            run.column(column).to_vec()
        });
        let both = x.iter().zip(&y).map(|(x, y)| [x / unit, y / unit]);
        (point.clone(), both.collect())
    });
    points.collect()
}

/// Named rows of a table of positions: a mechanism, its head, and the numbers of each joint.
fn table(name: &str) -> Vec<(String, String, Places)> {
    let mut all: Vec<(String, String, Places)> = Vec::new();
    for line in file(name).lines().filter(|line| !line.starts_with('#')) {
        let cells: Vec<&str> = line.split('\t').collect();
        match cells[..] {
            ["", joint, numbers] => {
                let numbers: Vec<f64> = numbers
                    .split(' ')
                    .map(|n| n.parse().expect("a number"))
                    .collect();
                let pairs = numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect();
                all.last_mut()
                    .expect("a head")
                    .2
                    .push((joint.to_owned(), pairs));
            }
            [head, what] => all.push((head.to_owned(), what.to_owned(), Vec::new())),
            _ => panic!("{line:?}"),
        }
    }
    all
}

/// The larger side of what is expected.
fn size(joints: &[(String, Vec<[f64; 2]>)]) -> f64 {
    let span = |k: usize| {
        let all = || joints.iter().flat_map(|(_, at)| at).map(|at| at[k]);
        all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
    };
    span(0).max(span(1))
}

/// The largest difference of points from joints of their name, and how many were compared.
fn difference(
    found: &[(String, Vec<[f64; 2]>)],
    expected: &[(String, Vec<[f64; 2]>)],
    rows: &[usize],
) -> (f64, usize) {
    let (mut worst, mut compared) = (0.0_f64, 0);
    for (point, at) in found {
        let name = point.split_once('.').expect("body.point").1;
        let Some((_, expected)) = expected.iter().find(|(joint, _)| legal(joint) == name) else {
            continue;
        };
        for (row, expected) in rows.iter().zip(expected) {
            let [x, y] = at[*row];
            worst = worst.max((x - expected[0]).hypot(y - expected[1]));
            compared += 1;
        }
    }
    (worst, compared)
}

/// A name as it is written into models.
fn legal(name: &str) -> String {
    let legal = |c: char| {
        if c.is_alphanumeric() || c == '-' {
            c
        } else {
            '_'
        }
    };
    let name: String = name.chars().map(legal).collect();
    name.trim_matches('_').to_owned()
}

/// Newton's method ends at 1e-12 of the size, and the program that computed the references at 1e-14.
const AS_COMPUTED: f64 = 1e-9;

#[test]
fn links_of_pmks_move_as_an_independent_program_moves_them() {
    let mut told = Vec::new();
    let all = table("pmks-positions.txt");
    assert!(all.len() >= 30, "{}", all.len());
    for (name, end, joints) in all {
        let imported = read(&link(&name), Format::Pmks);
        let end: f64 = end.parse().expect("a time");
        let found = positions(&imported, end, 181);
        let (worst, compared) = difference(&found, &joints, &[45, 90, 135, 180]);
        let share = worst / size(&joints);
        println!("{name:28} {share:.1e} of its size, {compared} places");
        if !(share <= AS_COMPUTED && compared >= 8) {
            told.push(format!("{name}: {share:.1e}, {compared} places"));
        }
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
}

/// How far points stand at the start from where they are drawn, in which all bodies have the frame of the drawing.
fn from_drawing(imported: &Imported, found: &[(String, Vec<[f64; 2]>)]) -> f64 {
    let off = found.iter().map(|(point, at)| {
        let (body, point) = point.split_once('.').expect("body.point");
        let drawn = &imported.draft.bodies[body]["points"][point];
        let [x, y] = [0, 1].map(|k| drawn[k].as_f64().expect("a number") - at[0][k]);
        x.hypot(y)
    });
    off.fold(0.0, f64::max)
}

/// A share of the size that is left of the rounding of sums of doubles.
const ROUNDING: f64 = 4e-12;

#[test]
fn links_of_pmks_stand_as_they_are_drawn() {
    for (name, _, joints) in table("pmks-positions.txt") {
        let imported = read(&link(&name), Format::Pmks);
        let found = positions(&imported, 1e-3, 2);
        let off = from_drawing(&imported, &found) / size(&joints);
        assert!(off <= ROUNDING, "{name}: {off:e}");
        let mechanism: Mechanism = imported.draft.text().parse().expect("a model");
        let told = serde_json::to_value(mechanism.check().expect("an answer")).expect("JSON");
        let residual = told["assembly_residual"].as_f64().expect("a number");
        assert!(residual <= ROUNDING, "{name}: {residual:e}");
    }
}

/// A link of the collection that turns against the clock at 10 rpm, in metres and kilograms: as the cases of PMKS_Verification do.
fn as_verified(name: &str) -> Imported {
    let told = link(name);
    let mut sections: Vec<&str> = told.split('.').collect();
    // Flags without the first, 10 rpm, and metres; the length, which the last character says, stays.
    (sections[0], sections[2], sections[3]) = ("2O", "A,0", "2010");
    read(&sections.join("."), Format::Pmks)
}

/// Columns of a run over some degrees of the crank, one output for each.
fn by_degrees(imported: &Imported, degrees: usize, columns: &[&str]) -> Vec<Vec<f64>> {
    let mut draft = imported.draft.clone();
    draft.points = columns
        .iter()
        .filter_map(|c| c.rsplit_once('.').filter(|(p, _)| !p.starts_with("driver")))
        .map(|(point, _)| point.to_owned())
        .collect();
    draft.points.sort();
    draft.points.dedup();
    // 10 rpm are 60 degrees a second.
    draft
        .analysis
        .insert("end".into(), (degrees as f64 / 60.0).into());
    draft
        .analysis
        .insert("outputs".into(), (degrees + 1).into());
    let mechanism: Mechanism = draft.text().parse().expect("a model");
    let run = mechanism.run().expect("it runs");
    assert_eq!(run.status(), Status::Completed);
    let column = |name: &&str| {
        run.column(mechanism.column(name).expect("a column"))
            .to_vec()
    };
    columns.iter().map(column).collect()
}

/// Printed digits of a case agree to the rounding of MATLAB's and of our sums, relative to the largest.
fn agrees(found: &[f64], rows: &[(usize, f64)]) {
    agrees_to(2e-12, found, rows);
}

fn agrees_to(share: f64, found: &[f64], rows: &[(usize, f64)]) {
    let largest = rows
        .iter()
        .map(|(_, value)| value.abs())
        .fold(0.0, f64::max);
    for (row, expected) in rows {
        let off = (found[*row] - expected).abs() / largest;
        assert!(
            off < share,
            "row {row}: {} is not {expected}, off by {off:e}",
            found[*row]
        );
    }
}

/// PMKS-Web/PMKS_Verification, reference-data/v1/cases/slider_crank_tracer/matlab: joints/C.csv and points/D.csv at 37c1cb5c and 9b485b38.
#[test]
fn a_slider_crank_moves_as_matlab_says() {
    let imported = as_verified("slider-crank-tracer");
    let columns = [
        "BCD.C.x", "BCD.C.vx", "BCD.C.ax", "BCD.D.x", "BCD.D.y", "BCD.D.vx", "BCD.D.ay",
    ];
    let found = by_degrees(&imported, 180, &columns);
    let [x, vx, ax, dx, dy, dvx, day] = &found[..] else {
        panic!("seven columns")
    };
    agrees(
        x,
        &[
            (0, 12.0),
            (30, 9.817454372195208),
            (90, 5.211102550927974),
            (150, 3.7777551677889862),
            (180, 3.999999999999984),
        ],
    );
    agrees(
        vx,
        &[
            (0, -std::f64::consts::PI),
            (30, -5.2178267684704585),
            (90, -3.0270288305157265),
            (150, -0.12861446489651343),
        ],
    );
    agrees(
        ax,
        &[
            (0, -6.168502750680848),
            (30, -1.7637910505056802),
            (90, 3.8309676654406988),
            (150, 2.250632574280879),
        ],
    );
    agrees(
        dx,
        &[
            (0, 20.0),
            (30, 18.061966008454785),
            (60, 15.419776361327255),
            (90, 13.456193037040897),
            (120, 12.240603983436188),
        ],
    );
    agrees(
        dy,
        &[
            (0, 2.0),
            (30, 0.16741529076037942),
            (60, -0.6761448229137192),
            (90, -0.13595174073976946),
            (120, 1.5290620826134944),
        ],
    );
    agrees(
        dvx,
        &[
            (0, -2.0943951023931953),
            (30, -5.159078245498161),
            (60, -4.882823340831882),
            (90, -2.9875429602266426),
        ],
    );
    agrees(
        day,
        &[
            (0, 1.0966227112321505),
            (30, 4.052762651370025),
            (60, 5.795216050523566),
            (90, 4.641125918690595),
        ],
    );
}

/// PMKS-Web/PMKS_Verification, reference-data/v1/cases/stephenson_iii_example_2/matlab: joints/F.csv at 9b485b38, and the torque with
/// gravity, masses and the load of 50 N, dynamics/newton_gravity/input_torque.csv at 37c1cb5c.
#[test]
fn a_six_bar_needs_the_torque_that_matlab_says() {
    let imported = as_verified("stephenson-iii");
    let columns = [
        "FG.F.x",
        "FG.F.y",
        "FG.F.vx",
        "FG.F.ay",
        "driver.motor.effort",
    ];
    let found = by_degrees(&imported, 30, &columns);
    let [x, y, vx, ay, effort] = &found[..] else {
        panic!("five columns")
    };
    agrees(
        x,
        &[
            (0, 43.0),
            (10, 40.240922415901196),
            (20, 37.54185462545194),
            (30, 34.88184895723876),
        ],
    );
    agrees(
        y,
        &[
            (0, 32.0),
            (10, 31.364928838965),
            (20, 30.16723462129036),
            (30, 28.252689433014208),
        ],
    );
    agrees(
        vx,
        &[
            (0, -16.705164880012152),
            (10, -16.383413118615096),
            (20, -16.016231163457856),
            (30, -16.068402638970756),
        ],
    );
    agrees(
        ay,
        &[
            (0, -18.730960876346256),
            (10, -19.99149417595813),
            (20, -24.707238706715348),
            (30, -45.63153606619353),
        ],
    );
    // The link has the centre of mass of BCE to a thousandth, a third of one off in 25.
    agrees_to(
        1e-5,
        effort,
        &[
            (0, -243.8543929532343),
            (10, -499.6811511091006),
            (20, -481.35974422394315),
            (30, 1393.1260064619275),
        ],
    );
}

/// PMKS-Web/PMKS_Verification, reference-data/v1/cases/watt_i/matlab/joints/F.csv at 9b485b38; with the clock, as the link turns.
#[test]
fn watts_six_bar_swings_as_matlab_says() {
    let imported = read(&link("watt-i"), Format::Pmks);
    // 20 rpm are 120 degrees a second.
    let found = positions(&imported, 5.0 / 120.0, 6);
    let (_, at) = found.iter().find(|(point, _)| point == "EF.F").expect("F");
    let [x, y] = [0, 1].map(|k| at.iter().map(|at| at[k]).collect::<Vec<f64>>());
    agrees(
        &x,
        &[
            (0, 8.14),
            (1, 8.25897945053306),
            (3, 8.4695048669453),
            (5, 8.652687257926084),
        ],
    );
    agrees(
        &y,
        &[
            (0, 3.35),
            (1, 3.3347291832092694),
            (3, 3.302535398870897),
            (5, 3.2690814032995235),
        ],
    );
}

/// PMKS+ printed this torque for its link of plain text, at rest: four decimals.
#[test]
fn a_plain_link_needs_the_torque_that_pmks_says() {
    let mut imported = read(&link("plain-six-bar"), Format::Pmks);
    for (_, body) in imported
        .draft
        .bodies
        .iter_mut()
        .filter(|(body, _)| *body != "ground")
    {
        (body["mass"], body["inertia"]) = (0.into(), 0.into());
    }
    let found = by_degrees(&imported, 1, &["driver.motor.effort"]);
    assert!(
        (found[0][0].abs() - 97.9126).abs() <= 0.5e-4,
        "{}",
        found[0][0]
    );
}

/// Places agree with those that pylinkage computes with doubles from its own formulas.
#[test]
fn linkages_of_pylinkage_move_as_it_moves_them() {
    let mut told = Vec::new();
    let all = table("pylinkage-positions.txt");
    assert_eq!(all.len(), 6);
    for (name, steps, joints) in all {
        let imported = read(&file(&format!("{name}.json")), Format::Pylinkage);
        let steps: Vec<usize> = steps
            .split(' ')
            .map(|step| step.parse().expect("a step"))
            .collect();
        let last = *steps.last().expect("a step");
        let found = positions(&imported, last as f64, last + 1);
        let (worst, compared) = difference(&found, &joints, &steps);
        let share = worst / size(&joints);
        println!("{name:28} {share:.1e} of its size, {compared} places");
        if !(share <= AS_COMPUTED && compared >= 2 * steps.len()) {
            told.push(format!("{name}: {share:.1e}, {compared} places"));
        }
    }
    assert!(told.is_empty(), "{}", told.join("\n"));
}
