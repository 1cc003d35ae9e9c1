//! The cheapest tolerances: digits of a reference in closed form, limits that are kept, and what is refused.

use std::ffi::OsString;

use linkdyn::cli::{Said, captured};
use serde_json::Value;

const LENGTHS: [(&str, &str); 4] = [
    ("base", "300 mm"),
    ("crank", "100 mm"),
    ("coupler", "250 mm"),
    ("rocker", "200 mm"),
];

/// `linkdyn allocate four-bar` with a cost of 1 mm for every length, and more words.
fn said(limits: &str, more: &[&str]) -> Said {
    let mut words: Vec<OsString> = ["linkdyn", "allocate", "four-bar"].map(Into::into).into();
    let outputs = format!(
        "accuracy={{\"outputs\":{{\"rocker\":{{\"column\":\"rocker.angle\",\"at\":{{\"value\":\"60 deg\"}}{limits}}}}}}}"
    );
    let costs = LENGTHS.map(|(name, value)| {
        format!("parameters.{name}={{\"value\":\"{value}\",\"cost\":\"1 mm\"}}")
    });
    for set in costs.iter().chain([&outputs]) {
        words.extend(["--set".into(), set.into()]);
    }
    words.extend(more.iter().map(Into::into));
    captured(words)
}

const LIMITS: &str = ",\"limits\":[\"-0.05 deg\",\"0.05 deg\"]";

fn json(said: &Said) -> Value {
    assert_eq!(said.status, 0, "{}", said.stderr);
    serde_json::from_str(&said.stdout).expect("JSON")
}

/// Digits of `validation/accuracy-four-bar`: a closed form, with 40 digits.
#[test]
fn one_limit_gives_the_tolerances_of_the_closed_form() {
    let text = include_str!("../../validation/accuracy-four-bar/expected.json");
    let reference: Value = serde_json::from_str(text).expect("JSON");
    let all = reference["poses"][0]["outputs"][0]["allocation"]
        .as_array()
        .expect("two kinds");
    for (expected, more) in all.iter().zip([&["--json"][..], &["--json", "--rss"]]) {
        let found = json(&said(LIMITS, more));
        for (name, _) in LENGTHS {
            let digits = expected["tolerances"][format!("parameters.{name}")]
                .as_str()
                .expect("digits");
            let digits: f64 = digits.parse().expect("a number");
            let own = found["parameters"][name]["first_order"]
                .as_f64()
                .expect("a number");
            // The cost is flat at its minimum: a gap of 1e-11 leaves tolerances open by the root of that.
            assert!(
                (own / digits - 1.0).abs() < 3e-6,
                "{more:?} {name}: {own} {digits}"
            );
        }
        let cost: f64 = expected["cost"]
            .as_str()
            .expect("digits")
            .parse()
            .expect("a number");
        let own = found["first_order_cost"].as_f64().expect("a number");
        assert!((own / cost - 1.0).abs() < 1e-9, "{more:?}: {own} {cost}");
    }
}

#[test]
fn what_is_written_keeps_its_limits_by_certificate() {
    let folder = tempfile("allocate");
    let file = folder.join("cheap.json");
    let path = file.display().to_string();
    let found = json(&said(LIMITS, &["--json", "--write", &path]));
    let used = found["limits"]["rocker"]["used"]
        .as_f64()
        .expect("a number");
    assert!(
        used <= 1.0 + 1e-9 && used > 0.995,
        "{used}: kept, and nothing given away"
    );
    let again = captured(["linkdyn", "accuracy", &path, "--json"].map(OsString::from));
    let again = json(&again);
    let pose = &again["outputs"]["rocker"]["poses"][0];
    let limit = 0.05_f64.to_radians();
    let certified = pose["certified"][1].as_f64().expect("certified");
    assert!(
        certified <= limit && certified > 0.995 * limit,
        "{certified} {limit}"
    );
    std::fs::remove_dir_all(folder).expect("removed");
}

fn tempfile(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("linkdyn-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn what_can_not_be_chosen_is_told() {
    let free = said("", &[]);
    assert_eq!(free.status, 2);
    assert_eq!(
        free.stderr,
        "error: four-bar: --set accuracy={\"outputs\":{\"rocker\":{\"column\":\"rocker.angle\",\"at\":…: accuracy.outputs: no output has limits, so any tolerance will do (as in \"limits\": [\"-0.1 deg\", \"0.1 deg\"])\n"
    );
    let pin = "joints.a.clearance={\"model\":\"ideal\",\"radius\":\"0.2 mm\"}";
    let tight = said(LIMITS, &["--set", pin]);
    assert_eq!(tight.status, 3);
    assert_eq!(
        tight.stderr,
        "error: the limits of rocker leave no room for tolerances where the drivers stand at 60°: what has no cost uses them up (widen the limits, or narrow the clearances)\n"
    );
    let words = [
        "linkdyn",
        "allocate",
        "four-bar",
        "--set",
        "parameters.base={\"value\":\"300 mm\",\"tolerance\":\"0.1 mm\"}",
    ];
    let outputs =
        format!("accuracy={{\"outputs\":{{\"rocker\":{{\"column\":\"rocker.angle\"{LIMITS}}}}}}}");
    let none = captured(
        words
            .iter()
            .map(OsString::from)
            .chain(["--set".into(), outputs.into()]),
    );
    assert_eq!(none.status, 2);
    assert!(
        none.stderr
            .contains("no parameter of the mechanism has a cost, so there is nothing to choose"),
        "{}",
        none.stderr
    );
}

/// A slider-crank in millimetres whose parameters are plain numbers.
fn feeder(folder: &std::path::Path, crank: &str, rod: &str) -> String {
    let pin = r#""type": "revolute", "clearance": { "model": "ideal", "radius": 0.01 }"#;
    let text = format!(
        r#"{{ "format": "linkdyn/1", "name": "Feeder", "units": {{ "length": "mm", "angle": "deg" }},
  "parameters": {{ "crank": {{ "value": 50, "cost": 1, {crank} }}, "rod": {{ "value": 200, "cost": 2, {rod} }} }},
  "bodies": {{
    "ground": {{ "points": {{ "O": [0, 0] }} }},
    "crank": {{ "points": {{ "O": [0, 0], "A": ["=crank", 0] }}, "pose": {{ "angle": 60 }} }},
    "rod": {{ "points": {{ "A": [0, 0], "B": ["=rod", 0] }}, "pose": {{ "position": [25, 43], "angle": -13 }} }},
    "slide": {{ "points": {{ "B": [0, 0] }}, "pose": {{ "position": [220, 0] }} }} }},
  "joints": {{
    "main": {{ {pin}, "between": ["ground.O", "crank.O"] }},
    "big": {{ {pin}, "between": ["crank.A", "rod.A"] }},
    "small": {{ {pin}, "between": ["rod.B", "slide.B"] }},
    "guide": {{ "type": "prismatic", "between": ["ground.O", "slide.B"], "axis": [1, 0] }} }},
  "drivers": {{ "motor": {{ "type": "rotation", "body": "crank", "tolerance": "0.05 deg",
    "motion": {{ "type": "constant_velocity", "start": 60, "velocity": "60 rpm" }} }} }},
  "analysis": {{ "type": "kinematics", "end": 1, "outputs": 121 }},
  "accuracy": {{ "outputs": {{ "drop": {{ "column": "slide.x", "at": {{ "value": 120 }}, "limits": [-0.25, 0.25] }} }} }} }}"#
    );
    let path = folder.join("feeder.json");
    std::fs::write(&path, text).expect("written");
    path.display().to_string()
}

fn words(words: &[&str]) -> Said {
    captured(["linkdyn"].iter().chain(words).map(OsString::from))
}

#[test]
fn plain_numbers_are_chosen_and_written_as_such() {
    let folder = tempfile("allocate-plain");
    let path = feeder(&folder, r#""tolerance": 0.05"#, r#""tolerance": [0, 0.2]"#);
    let found = json(&words(&["allocate", &path, "--json", "--write", &path]));
    let text = std::fs::read_to_string(&path).expect("there");
    let model: Value = serde_json::from_str(&text).expect("JSON");
    let own = &model["parameters"];
    let crank = own["crank"]["tolerance"].as_f64().expect("a number");
    let half = |name: &str| {
        found["parameters"][name]["tolerance"]
            .as_f64()
            .expect("a number")
    };
    // Written with few digits, and no wider.
    assert!(
        crank <= half("crank") && crank > 0.999 * half("crank"),
        "{crank}"
    );
    let [low, high] = [0, 1].map(|k| own["rod"]["tolerance"][k].as_f64().expect("a number"));
    assert!((0.5 * (low + high) - 0.1).abs() < 1e-12, "{low} {high}");
    assert!(
        (0.5 * (high - low) - half("rod")).abs() < 1e-12,
        "{low} {high}"
    );
    let again = json(&words(&["accuracy", &path, "--json"]));
    let certified = &again["outputs"]["drop"]["poses"][0]["certified"];
    let most = certified[0]
        .as_f64()
        .zip(certified[1].as_f64())
        .expect("certified");
    let used = most.1.max(-most.0) / 0.25e-3;
    assert!(used < 1.0 && used > 0.995, "{used}");
    std::fs::remove_dir_all(folder).expect("removed");
}

/// Uniform in [0, 1): splitmix64.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Of mean 0 and variance 1 (Box and Muller).
    fn normal(&mut self) -> f64 {
        let size = (-2.0 * (1.0 - self.next()).ln()).sqrt();
        size * (std::f64::consts::TAU * self.next()).cos()
    }
}

/// x = r cos θ + e_x + √(l² − (r sin θ + e_y)²) with three pins anywhere on their rims, drawn 200 000 times: what is chosen by
/// squares keeps 99.73 % within the limits, and not more than that takes.
#[test]
fn what_is_chosen_by_squares_scatters_as_far_as_its_limits() {
    const DRAWS: u32 = 200_000;
    let folder = tempfile("allocate-squares");
    let normal = r#""tolerance": 0.05"#;
    let wide = r#""tolerance": 0.05, "sigma": 2"#;
    let uniform = r#""tolerance": 0.05, "distribution": "uniform""#;
    let triangular = r#""tolerance": 0.05, "distribution": "triangular""#;
    for (crank, rod) in [
        (normal, normal),
        (wide, normal),
        (uniform, triangular),
        (normal, uniform),
    ] {
        let path = feeder(&folder, crank, rod);
        let found = json(&words(&["allocate", &path, "--json", "--rss"]));
        let half = |name: &str| {
            found["parameters"][name]["tolerance"]
                .as_f64()
                .expect("a number")
        };
        let (crank_by, rod_by) = (half("crank"), half("rod"));
        let mut chance = Chance(7);
        let mut draw = |words: &str, half: f64| match words {
            _ if words == normal => chance.normal() * half / 3.0,
            _ if words == wide => chance.normal() * half / 2.0,
            _ if words == uniform => half * (2.0 * chance.next() - 1.0),
            _ => half * (chance.next() - chance.next()),
        };
        let mut pins = Chance(8);
        let at = |r: f64, l: f64, theta: f64, [x, y]: [f64; 2]| {
            r * theta.cos() + x + (l * l - (r * theta.sin() + y).powi(2)).sqrt()
        };
        let theta = 120_f64.to_radians();
        let nominal = at(50.0, 200.0, theta, [0.0; 2]);
        let (mut within, mut squares) = (0, 0.0);
        for _ in 0..DRAWS {
            let (r, l) = (50.0 + draw(crank, crank_by), 200.0 + draw(rod, rod_by));
            let mut gap = [0.0; 2];
            for _ in 0..3 {
                let direction = std::f64::consts::TAU * pins.next();
                gap = [
                    gap[0] + 0.01 * direction.cos(),
                    gap[1] + 0.01 * direction.sin(),
                ];
            }
            let motor = pins.normal() * 0.05_f64.to_radians() / 3.0;
            let off = at(r, l, theta + motor, gap) - nominal;
            within += u32::from(off.abs() <= 0.25);
            squares += off * off;
        }
        let share = f64::from(within) / f64::from(DRAWS);
        // Three standard errors of a share of 99.73 %.
        assert!(share > 0.9973 - 0.00035, "{crank} {rod}: {share}");
        // σ is known to 0.16 %; four of them.
        let spread = 3.0 * (squares / f64::from(DRAWS)).sqrt() / 0.25;
        assert!((spread - 1.0).abs() < 0.0064, "{crank} {rod}: {spread}");
    }
    std::fs::remove_dir_all(folder).expect("removed");
}
