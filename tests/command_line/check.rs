//! `linkdyn check` as a colleague: what the mobility means, what bodies lack, and what looks like a slip.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use linkdyn_model::bundled;
use serde_json::{Map, Value, json};

/// A file of its own, removed at the end.
struct File(PathBuf);

impl File {
    fn new(name: &str, text: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("check-{}-{name}.json", std::process::id()));
        fs::write(&path, text).expect("written");
        File(path)
    }

    fn path(&self) -> &str {
        self.0.to_str().expect("UTF-8")
    }
}

impl Drop for File {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

/// Exit status, standard output, standard error.
fn linkdyn(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("runs");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[track_caller]
fn checked(arguments: &[&str]) -> Value {
    let (status, stdout, stderr) = linkdyn(&[&["check", "--json"], arguments].concat());
    assert_eq!(status, Some(0), "{stderr}");
    serde_json::from_str(&stdout).expect("JSON")
}

#[test]
fn bundled_models_raise_no_alarm() {
    for bundled in bundled::MODELS {
        let told = checked(&[bundled.name]);
        assert_eq!(
            (&told["warnings"], &told["suspicious"]),
            (&json!([]), &json!([])),
            "{}",
            bundled.name
        );
        assert_eq!(told["status"], "completed", "{}", bundled.name);
    }
}

#[test]
fn the_mobility_is_said_in_a_sentence() {
    let cases: &[(&[&str], &str)] = &[
        (
            &["four-bar"],
            "1 degree of freedom, driven by motor: kinematics, inverse dynamics and statics are possible; forward dynamics \
             has nothing free",
        ),
        (
            &["double-pendulum"],
            "2 degrees of freedom, none driven: forward dynamics and statics are possible; kinematics and inverse dynamics \
             need 2 drivers",
        ),
        (
            &[
                "double-pendulum",
                "--set",
                r#"drivers.m={"type":"rotation","body":"upper","motion":{"type":"constant_velocity","velocity":1}}"#,
            ],
            "2 degrees of freedom, 1 driven by m: forward dynamics and statics are possible; kinematics and inverse dynamics \
             need 1 driver more",
        ),
        (
            &[
                "slider-crank-clearance",
                "--set",
                "joints.wristpin.clearance.model=ideal",
            ],
            "1 degree of freedom, driven by motor: kinematics, inverse dynamics and statics are possible; forward dynamics has nothing \
             free",
        ),
        (
            &["slider-crank-clearance"],
            "with ideal pins 1 degree of freedom, driven by motor: kinematics, inverse dynamics and forward dynamics are \
             possible; the journal of wristpin is free in its bearing: 3 degrees of freedom in motion",
        ),
        // Free journals are integrated, driven or not.
        (
            &["slider-crank-clearance", "--set", "drivers={}"],
            "with ideal pins 1 degree of freedom, none driven: kinematics, inverse dynamics and forward dynamics are \
             possible; the journal of wristpin is free in its bearing: 3 degrees of freedom in motion",
        ),
        (
            &["hoeken"],
            "1 degree of freedom, driven by motor: kinematics and statics are possible; forward dynamics has nothing free; \
             inverse dynamics needs data that bodies lack",
        ),
        (
            &[
                "four-bar",
                "--set",
                "drivers={}",
                "--set",
                r#"joints.weld={"type":"fixed","between":["ground.O2","crank.O2"],"angle":60}"#,
            ],
            "no degree of freedom, a structure: nothing in it can move: kinematics, inverse dynamics and statics are possible",
        ),
    ];
    for (arguments, sentence) in cases {
        let (_, stdout, stderr) = linkdyn(&[&["check", "--json"], *arguments].concat());
        let told: Value =
            serde_json::from_str(&stdout).unwrap_or_else(|_| panic!("{arguments:?}: {stderr}"));
        assert_eq!(told["mobility"]["words"], *sentence, "{arguments:?}");
    }
}

#[test]
fn loops_and_lacks_are_named() {
    let told = checked(&[
        "hoeken",
        "--set",
        "bodies.rocker.mass=1",
        "--set",
        "bodies.rocker.com=[0, 0]",
    ]);
    assert_eq!(told["loops"], json!(["a – b – c – d"]));
    assert_eq!(told["loop_bodies"], json!([["crank", "coupler", "rocker"]]));
    assert_eq!(
        told["lacks"],
        json!([
            { "bodies": ["crank", "coupler"], "keys": ["mass", "inertia"], "for": ["inverse_dynamics", "dynamics"] },
            { "bodies": ["rocker"], "keys": ["inertia"], "for": ["inverse_dynamics", "dynamics"] },
        ])
    );
    // As it was before: each analysis with what it lacks.
    assert_eq!(
        told["missing"]["inverse_dynamics"][2],
        "inertia of body \"rocker\""
    );
}

/// Millimetres as metres, degrees as radians, grams as kilograms, and more of the kind.
const SLIPS: &str = r#"{ "format": "linkdyn/1", "units": "SI", "gravity": [0, -9810],
  "bodies": {
    "ground": { "points": { "O": [0, 0], "Q": [300, 0] } },
    "crank":  { "mass": 800, "inertia": 0.001, "com": [50, 0], "points": { "O": [0, 0], "A": [100, 0] }, "pose": { "angle": 60 } },
    "rod":    { "mass": 1, "inertia": 2000, "points": { "A": [0, 0], "B": [250, 0] }, "com": [100, 0], "pose": { "position": [50, 80] } },
    "rocker": { "points": { "Q": [0, 0], "B": [200, 0] }, "pose": { "position": [300, 0], "angle": "90 deg" } } },
  "joints": {
    "a": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "b": { "type": "revolute", "between": ["crank.A", "rod.A"], "clearance": { "model": "ideal", "radius": 2, "bearing_radius": 1 } },
    "c": { "type": "revolute", "between": ["rod.B", "rocker.B"], "clearance": { "model": "ideal", "radius": 500 } },
    "d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] } },
  "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": "600 rpm", "start": "60 deg" } } },
  "forces": {
    "s": { "type": "spring", "between": ["crank.A", "rod.A"], "stiffness": 5, "free_length": 1 },
    "t": { "type": "spring", "between": ["ground.O", "ground.Q"], "stiffness": 5, "free_length": 1 },
    "u": { "type": "torque", "body": "rod", "value": { "type": "harmonic", "amplitude": 1, "frequency": 20 } } },
  "analysis": { "type": "kinematics", "end": 1, "outputs": 61 } }
"#;

#[test]
fn slips_are_named_with_place_and_mend() {
    let file = File::new("slips", SLIPS);
    let told = checked(&[file.path()]);
    let said: Vec<&str> = told["suspicious"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(Value::as_str)
        .collect();
    let wanted = [
        r#"line 5, column 55: bodies.rod.points: the bodies are very long, this one 250 m (check the unit of length: "units": { "length": "mm" } reads plain numbers as millimetres)"#,
        r#"line 4, column 25: bodies.crank.mass: 800: the body is heavy, 800 kg, where others weigh near 1 kg (check the unit: a plain mass is in kg unless "units" names another)"#,
        r#"line 1, column 52: gravity: gravity is 9810 m/s^2, that of the earth is 9.81 m/s^2 (a plain number is in m/s^2 whatever the unit of length; write 9.81, or its unit, as in "9810 mm/s^2")"#,
        r#"line 4, column 125: bodies.crank.pose.angle: 60: the angle is 60 rad, 9.549 turns (for degrees write "60 deg", or name "angle": "deg" in units)"#,
        r#"line 9, column 108: joints.b.clearance.radius: 2: the radial clearance, 2 m, leaves no journal in a bearing of 1 m (radius is the bearing's radius minus the journal's)"#,
        r#"line 10, column 109: joints.c.clearance.radius: 500: the radial clearance, 500 m, is longer than the link, 200 m (check its unit: clearances are mostly some micrometres)"#,
        r#"line 12, column 74: drivers.motor.motion: 6 outputs per turn, one every 0.01667 s: they show another motion than there is (take "outputs" of 82 or more, a shorter "end", or check the unit of the motion)"#,
        r#"line 16, column 10: forces.u: 3 outputs per period, one every 0.01667 s: they show another motion than there is (take "outputs" of 163 or more, a shorter "end", or check the unit of the motion)"#,
        r#"line 4, column 114: bodies.crank.pose: it assembles turned by -2.4 rad (-138°) from this drawing, perhaps on the other branch (draw the pose nearer to the assembly that you want)"#,
        r#"line 14, column 41: forces.s.between: the spring's ends coincide at the start: it has no direction there (check its two points)"#,
        r#"line 15, column 41: forces.t.between: both ends are on "ground": the spring moves nothing (a spring acts between two bodies)"#,
    ];
    assert_eq!(said, wanted, "{said:#?}");
    // The same among the warnings, and none of them changes the exit status.
    assert_eq!(told["warnings"], told["suspicious"]);
}

#[test]
fn single_slips_among_sound_values_are_found() {
    let cases: &[(&str, &[&str], &str)] = &[
        (
            "hoeken",
            &["bodies.rocker.points={\"O4\": [0, 0], \"B\": [62.5, 0], \"far\": [50000, 0]}"],
            "the points are 50000 mm apart, much longer than most lengths of the mechanism, near 50 mm",
        ),
        (
            "hoeken",
            &["bodies.crank.pose.angle=1.5708"],
            "the angle is 1.571 deg, which looks like radians",
        ),
        (
            "four-bar",
            &["bodies.coupler.inertia=9000 kg*m^2"],
            "the inertia is large: that of the mass at 68820 mm, where the body reaches 262.5 mm",
        ),
        (
            "four-bar",
            &["gravity=[0, -0.00981]"],
            "gravity is 0.00981 m/s^2",
        ),
        (
            "four-bar",
            &[
                "analysis={\"type\": \"kinematics\", \"sample\": {\"driver\": \"motor\", \"from\": 60, \"to\": 420, \"step\": 60}}",
            ],
            "6 outputs per turn",
        ),
        (
            "four-bar",
            &["bodies.rocker.mass=0.001"],
            "the body is light, 0.001 kg, where others weigh near 0.8 kg",
        ),
    ];
    for (model, sets, wanted) in cases {
        let mut arguments = vec!["check", "--json", *model];
        arguments.extend(sets.iter().flat_map(|set| ["--set", *set]));
        let (_, stdout, stderr) = linkdyn(&arguments);
        let told: Value =
            serde_json::from_str(&stdout).unwrap_or_else(|_| panic!("{model} {sets:?}: {stderr}"));
        let said = told["suspicious"].as_array().expect("a list");
        assert!(
            said.len() == 1 && said[0].as_str().is_some_and(|said| said.contains(wanted)),
            "{sets:?}: {said:#?}"
        );
    }
}

/// Plain numbers in millimetres and degrees.
const MILLIMETRES: &str = r#"{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg", "inertia": "kg*mm^2", "stiffness": "N/mm", "angular_velocity": "deg/s" },
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "crank": { "mass": 1, "inertia": 500, "com": [25, 0], "points": { "O": [0, 0], "A": [50, 0] } },
    "rod": { "mass": 2, "inertia": 7000, "com": [100, 0], "points": { "A": [0, 0], "B": [200, 0] }, "pose": { "position": [50, 0] } },
    "slider": { "mass": 1, "inertia": 100, "com": [0, 0], "points": { "P": [0, 0] }, "pose": { "position": [250, 0] } } },
  "joints": { "a": { "type": "revolute", "between": ["ground.O", "crank.O"] },
    "b": { "type": "revolute", "between": ["crank.A", "rod.A"] },
    "c": { "type": "revolute", "between": ["rod.B", "slider.P"] },
    "d": { "type": "prismatic", "between": ["ground.O", "slider.P"], "axis": [1, 0] } },
  "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "polynomial", "coefficients": [0, 360] } } },
  "forces": { "s": { "type": "spring", "between": ["ground.O", "slider.P"], "stiffness": 1, "free_length": 240 } },
  "analysis": { "type": "kinematics", "end": 1, "outputs": 101 } }
"#;

#[test]
fn lengths_and_angles_that_do_not_fit_the_mechanism_are_found() {
    let file = File::new("millimetres", MILLIMETRES);
    let motion = "drivers.motor.motion=";
    let radians = |number: &str, key: &str, per: &str| {
        let goes = if key == "points" {
            "the motion goes over"
        } else {
            "this is"
        };
        format!(
            "drivers.motor.motion.{key}: {goes} {number} deg{per}, which looks like radians (plain numbers are in degrees here; write degrees, or text with the unit rad{per})"
        )
    };
    let lengths = |body: &str, than: &str| {
        format!(
            "bodies.{body}.points: the points are {than} than most lengths of the mechanism, near 50 mm (check its points and their unit)"
        )
    };
    let com = "check its numbers and their unit; \"com\" is in the body's frame";
    let free = |than: &str, length: &str| {
        format!(
            "forces.s.free_length: the free length is very {than}, {length}: the two points are 250 mm apart at the start (check its unit)"
        )
    };
    let cases = [
        (
            r#"{"type": "polynomial", "coefficients": [0, 6.2832]}"#,
            motion,
            radians("6.2832", "coefficients[1]", "/s"),
        ),
        (
            r#"{"type": "polynomial", "coefficients": [0, 104.72]}"#,
            motion,
            radians("104.72", "coefficients[1]", "/s"),
        ),
        (
            r#"{"type": "harmonic", "amplitude": 0.5236, "frequency": 1}"#,
            motion,
            radians("0.5236", "amplitude", ""),
        ),
        (
            r#"{"type": "table", "points": [[0, 0], [1, 6.2832]]}"#,
            motion,
            radians("6.2832", "points", ""),
        ),
        (
            r#"{"type": "constant_velocity", "velocity": 3.14}"#,
            motion,
            radians("3.14", "velocity", "/s"),
        ),
        (
            "[100000, 0]",
            "bodies.rod.com=",
            format!(
                "bodies.rod.com: the centre of mass is 99800 mm from the nearest point, B, in a mechanism of 200 mm ({com})"
            ),
        ),
        (
            "[0.1, 0]",
            "bodies.rod.com=",
            format!(
                "bodies.rod.com: the centre of mass is beside point A, 0.1 mm off it, in a body of 200 mm ({com})"
            ),
        ),
        (
            "[0.2, 0]",
            "bodies.rod.points.B=",
            lengths("rod", "0.2 mm apart, much shorter"),
        ),
        (
            "[200000, 0]",
            "bodies.rod.points.B=",
            lengths("rod", "200000 mm apart, much longer"),
        ),
        ("0.25", "forces.s.free_length=", free("short", "0.25 mm")),
        ("250000", "forces.s.free_length=", free("long", "250000 mm")),
    ];
    for (value, path, wanted) in cases {
        let set = format!("{path}{value}");
        let (_, stdout, stderr) = linkdyn(&["check", "--json", file.path(), "--set", &set]);
        let told: Value =
            serde_json::from_str(&stdout).unwrap_or_else(|_| panic!("{set}: {stderr}"));
        let said = told["suspicious"].as_array().expect("a list");
        let fits = said.len() == 1 && said[0].as_str().is_some_and(|said| said.ends_with(&wanted));
        // A --set that says the whole path is not followed by it once more.
        let fits = fits
            || (said.len() == 1
                && said[0]
                    == *format!(
                        "--set {set}: {}",
                        wanted.split_once(": ").expect("a path").1
                    ));
        assert!(fits, "{set}: {said:#?}, not {wanted}");
    }
    // What is no slip: a turn and 355 degrees, text in radians, a centre of mass on a pin or a little off it.
    for set in [
        "drivers.motor.motion.coefficients=[0, 360]",
        "drivers.motor.motion.coefficients=[0, 355, 22]",
        "drivers.motor.motion.coefficients=[0, \"6.2832 rad/s\"]",
        "bodies.rod.com=[0, 0]",
        "bodies.rod.com=[-0.01, 0.02]",
        "forces.s.free_length=0",
    ] {
        assert_eq!(
            checked(&[file.path(), "--set", set])["suspicious"],
            json!([]),
            "{set}"
        );
    }
}

/// 10 000 bodies, held in chains of a hundred or not at all, with names that try everything the contract allows.
fn hostile(count: usize, held: bool) -> Value {
    let tricks = [
        "🔒\u{202e}",
        "\"'`",
        "</script><script>alert(1)</script>",
        "a b\u{301}",
        "$(rm -r)",
        "%s%n",
        "\\",
        "ーー",
        "<!--",
        "&amp;",
    ];
    let name = |k: usize| format!("{} {k} {}", tricks[k % tricks.len()], "long ".repeat(k % 7));
    let (mut bodies, mut joints) = (Map::new(), Map::new());
    bodies.insert("ground".into(), json!({ "points": { "O": [0, 0] } }));
    for k in 0..count {
        bodies.insert(
            name(k),
            json!({ "mass": 1, "inertia": 0.1, "com": [0.5, 0], "points": { "\"A\"": [0, 0], "</b>": [1, 0] },
            "pose": { "position": [k % 100, 0] } }),
        );
        if held {
            let first = if k % 100 == 0 {
                "ground.O".to_string()
            } else {
                format!("{}.</b>", name(k - 1))
            };
            joints.insert(
                format!("🦾 {k}"),
                json!({ "type": "revolute", "between": [first, format!("{}.\"A\"", name(k))] }),
            );
        }
    }
    json!({ "format": "linkdyn/1", "name": "</script>\u{202e}", "units": "SI", "gravity": [0, -9.81], "bodies": bodies, "joints": joints,
            "analysis": { "type": "assembly" } })
}

/// Lines that a terminal shows, none endless, nothing in them that it would obey.
#[track_caller]
fn readable(text: &str) {
    assert!(
        text.lines().count() <= 120,
        "{} lines",
        text.lines().count()
    );
    let widest = text
        .lines()
        .map(|line| line.chars().count())
        .max()
        .unwrap_or(0);
    assert!(widest <= 1200, "a line of {widest} characters: {text}");
    assert!(
        !text.contains(|c: char| c.is_control() && c != '\n' || c == '\u{202e}'),
        "{text}"
    );
}

#[test]
fn ten_thousand_bodies_with_wild_names_are_told_of_in_few_words() {
    let started = Instant::now();
    let folder =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("hostile-{}", std::process::id()));
    for held in [true, false] {
        let file = File::new(
            &format!("hostile-{held}"),
            &hostile(10_000, held).to_string(),
        );
        let (status, stdout, stderr) = linkdyn(&["check", file.path()]);
        assert_eq!(status, Some(0), "{stderr}");
        readable(&stdout);
        readable(&stderr);
        let (status, stdout, stderr) =
            linkdyn(&["run", file.path(), "-o", folder.to_str().expect("UTF-8")]);
        assert_eq!(status, Some(0), "{stderr}");
        readable(&stdout);
        let header = fs::read_to_string(folder.join("results.csv")).expect("results");
        assert_eq!(header.lines().count(), 2);
        // Each other end: data missing everywhere, too few drivers, a name that is not there.
        for sets in [
            &[
                "--set",
                "analysis={\"type\": \"kinematics\", \"end\": 1, \"outputs\": 2}",
            ][..],
            &["--set", "points=[\"nobody.A\"]"],
        ] {
            let (status, stdout, stderr) = linkdyn(&[&["run", file.path()], sets].concat());
            assert_eq!(status, Some(2), "{stderr}");
            readable(&stdout);
            readable(&stderr);
        }
    }
    let mut bare = hostile(10_000, true);
    for body in bare["bodies"].as_object_mut().expect("bodies").values_mut() {
        body.as_object_mut()
            .expect("a body")
            .retain(|key, _| key == "points" || key == "pose");
    }
    bare["analysis"] = json!({ "type": "inverse_dynamics", "end": 1, "outputs": 2 });
    let file = File::new("hostile-bare", &bare.to_string());
    let (status, _, stderr) = linkdyn(&["run", file.path()]);
    assert_eq!(status, Some(2), "{stderr}");
    readable(&stderr);
    let (status, stdout, _) = linkdyn(&["check", file.path()]);
    assert_eq!(status, Some(0));
    readable(&stdout);
    let _ = fs::remove_dir_all(&folder);
    // Some seconds on a slow machine; what grows with the square or cube of 10 000 takes minutes or hours.
    assert!(
        started.elapsed() < Duration::from_secs(60),
        "{:?}",
        started.elapsed()
    );
}

/// What `run` refuses as bad input `check` refuses in the same words.
#[test]
fn outputs_that_can_not_be_are_refused_by_check_as_by_run() {
    let file = File::new("samples", MILLIMETRES);
    let sample = |from: &str, to: &str, step: &str| {
        let sample =
            format!("{{\"driver\": \"motor\", \"from\": {from}, \"to\": {to}, \"step\": {step}}}");
        format!("\"type\": \"kinematics\", \"sample\": {sample}")
    };
    let cases = [
        (
            r#""type": "kinematics", "end": 1, "outputs": 1000000000000"#.to_string(),
            "line 12, column 60: analysis.outputs: 1000000000000: must not be greater than 10000000",
        ),
        (
            sample("0", "360", "1e-9"),
            "line 12, column 99: analysis.sample.step: 1e-9: more than 10000000 outputs between \"from\" and \"to\" (take a \
             larger step)",
        ),
        (
            sample("360", "0", "1"),
            "line 12, column 49: analysis.sample: driver \"motor\" passes the values in the other order (exchange from and to)",
        ),
    ];
    for (analysis, wanted) in cases {
        let text = MILLIMETRES.replace(
            r#""type": "kinematics", "end": 1, "outputs": 101"#,
            &analysis,
        );
        fs::write(file.path(), text).expect("written");
        for command in ["check", "run"] {
            let (status, _, stderr) = linkdyn(&[command, file.path()]);
            assert_eq!(status, Some(2), "{command} {analysis}");
            assert_eq!(
                stderr.trim_end(),
                format!("error: {}: {wanted}", file.path()),
                "{command} {analysis}"
            );
        }
    }
}

/// A block on a guide between stops.
const STOP: &str = r#"{ "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "block": { "mass": 1, "inertia": 0.01, "com": [0, 0], "points": { "P": [0, 0] } } },
  "joints": { "guide": { "type": "prismatic", "between": ["ground.O", "block.P"], "axis": [0, 1] },
    "j": { "type": "revolute", "between": ["ground.O", "block.P"], "clearance": { "model": "contact", "radius": 0.05, "bearing_radius": 0.1,
      "normal": { "law": "kelvin_voigt", "stiffness": 1e5, "damping": 100 }, "surface": { "stiffness": 1e5, "damping": 100 },
      "impact": { "restitution": 0.5 } } } },
  "analysis": { "type": "dynamics", "end": 0.1, "outputs": 11 } }
"#;

#[test]
fn a_stop_leaves_its_body_free() {
    let file = File::new("stop", STOP);
    let driver = r#"drivers.m={"type":"translation","joint":"guide","motion":{"type":"constant_velocity","velocity":0.01}}"#;
    let possible = "kinematics, inverse dynamics and forward dynamics are possible";
    for model in ["contact", "two_state", "three_state"] {
        let model = format!("joints.j.clearance.model={model}");
        let told = checked(&[file.path(), "--set", &model]);
        let free = "the journal of j is free in its bearing: 1 degree of freedom in motion";
        assert_eq!(
            told["mobility"]["words"],
            format!("with ideal pins no degree of freedom: {possible}; {free}")
        );
        assert_eq!(
            told["mobility"]["free_journals"],
            json!({ "joints": ["j"], "grubler": 1, "rank": 1 })
        );
        // What run says of it.
        let (status, stdout, _) = linkdyn(&["run", file.path(), "--set", &model]);
        assert!(
            status == Some(0) && stdout.contains("1 by Grübler, 1 by rank"),
            "{stdout}"
        );
    }
    // A driver of what only ideal pins hold is none too many.
    let told = checked(&[file.path(), "--set", driver]);
    let words = told["mobility"]["words"].as_str().expect("words");
    assert!(
        words.contains("kinematics") && words.contains("possible") && !words.contains("take"),
        "{words}"
    );
    assert_eq!(
        linkdyn(&[
            "run",
            file.path(),
            "--set",
            driver,
            "--set",
            "analysis.type=kinematics"
        ])
        .0,
        Some(0)
    );
}

/// A chain of bodies none of which is fixed, and those that something holds.
#[test]
fn a_mechanism_that_nothing_holds_is_said_to_be_loose() {
    let model = |fixed: &str, mass: &str, forces: &str| {
        format!(
            r#"{{ "format": "linkdyn/1", "units": "SI", "bodies": {{
  "{fixed}": {{ {mass} "points": {{ "O": [0, 0] }} }},
  "arm": {{ "mass": 1, "inertia": 0.1, "com": [0.5, 0], "points": {{ "O": [0, 0], "A": [1, 0] }} }} }},
  "joints": {{ "o": {{ "type": "revolute", "between": ["{fixed}.O", "arm.O"] }} }}, "forces": {{ {forces} }},
  "analysis": {{ "type": "dynamics", "end": 1, "outputs": 3 }} }}"#
        )
    };
    let warned = |name: &str, text: &str| {
        let file = File::new(name, text);
        let told = checked(&[file.path()]);
        assert_eq!(
            told["mobility"]["rank"],
            if text.contains("ground\": {") { 1 } else { 4 }
        );
        told["warnings"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|text| text.as_str().expect("text").to_string())
            .collect::<Vec<_>>()
    };
    let heavy = r#""mass": 10, "inertia": 1, "com": [0, 0],"#;
    let loose = |hint: &str| {
        vec![format!(
            "line 1, column 51: bodies: nothing holds the mechanism: no body is called \"ground\", which is the name of the fixed one \
             (rename the fixed body{hint} to \"ground\", unless all of it is to move freely)"
        )]
    };
    assert_eq!(
        warned("frame", &model("machine_frame", heavy, "")),
        loose(", probably \"machine_frame\",")
    );
    assert_eq!(
        warned("massless", &model("block", "", "")),
        loose(", probably \"block\",")
    );
    assert_eq!(warned("heavy", &model("block", heavy, "")), loose(""));
    assert_eq!(
        warned("ground", &model("ground", "", "")),
        Vec::<String>::new()
    );
    // A spring holds it, too, though nothing stays where it is.
    let spring =
        r#""s": { "type": "torsion_spring", "between": ["ground", "arm"], "stiffness": 1 }"#;
    assert_eq!(
        warned("spring", &model("block", heavy, spring)),
        Vec::<String>::new()
    );
    // There is a ground, and nothing on it.
    let text = model("base", heavy, "").replace(
        r#""bodies": {"#,
        r#""bodies": { "ground": { "points": { "O": [0, 0] } },"#,
    );
    let file = File::new("untouched", &text);
    let told = checked(&[file.path()])["warnings"].to_string();
    assert!(
        told.contains(
            "no joint or spring is on \\\"ground\\\" (rename the fixed body, probably \\\"base\\\""
        ),
        "{told}"
    );
}

/// A body of another length keeps its old mass, if nobody says otherwise.
#[test]
fn a_point_moved_by_set_leaves_the_mass_behind() {
    let cases: &[(&[&str], &[&str])] = &[
        (
            &["bodies.crank.points.A=[120, 0]"],
            &[
                "--set bodies.crank.points.A=[120, 0]: \"com\", \"mass\" and \"inertia\" of \"crank\" stay as they were, those of the old shape \
               (set them, too, or change a parameter from which all of them follow)",
            ],
        ),
        (
            &[
                "bodies.crank.points.A[0]=120",
                "bodies.crank.com=[60, 0]",
                "bodies.crank.mass=1",
            ],
            &[
                "--set bodies.crank.points.A[0]=120: \"inertia\" of \"crank\" stays as it was, that of the old shape \
               (set them, too, or change a parameter from which all of them follow)",
            ],
        ),
        // All is set, through parameters or one by one; or the point only draws a curve.
        (&["parameters.crank=120 mm"], &[]),
        (
            &[
                "bodies.crank.points.A=[120, 0]",
                "bodies.crank.com=[60, 0]",
                "bodies.crank.mass=1",
                "bodies.crank.inertia=1200",
            ],
            &[],
        ),
        (&["bodies.coupler.points.P=[120, 90]"], &[]),
        (
            &["bodies.ground.points.O4=[310, 0]", "parameters.base=300 mm"],
            &[],
        ),
    ];
    for (sets, expected) in cases {
        let arguments: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        let told = checked(&[&["four-bar"], arguments.as_slice()].concat());
        assert_eq!(told["warnings"], json!(expected), "{sets:?}");
    }
}

/// The lock's dead centre at 132.743310°, and t² = 182.743310° by its motion; six digits of both.
#[test]
fn messages_speak_the_units_of_the_file_with_six_digits() {
    let (status, _, stderr) = linkdyn(&["run", "lock", "--set", "analysis.sample.to=135 deg"]);
    assert!(
        status == Some(3)
            && stderr.contains("\"motor\" can't go on beyond 132.743°, t = 1.78591 s,"),
        "{stderr}"
    );
    let late = [
        "run",
        "lock",
        "--set",
        "analysis.sample.to=135 deg",
        "--set",
        "units.time=ms",
    ];
    let (_, _, stderr) = linkdyn(&late);
    assert!(
        stderr.contains("beyond 132.743°, t = 1785.91 ms,"),
        "{stderr}"
    );
    // However late it is.
    for command in ["run", "check"] {
        let (_, stdout, stderr) = linkdyn(&[command, "four-bar", "--set", "analysis.end=1e300"]);
        let longest = format!("{stdout}{stderr}")
            .split(|c: char| !c.is_ascii_digit())
            .map(str::len)
            .max();
        assert!(longest < Some(10), "{stdout}{stderr}");
    }
}
