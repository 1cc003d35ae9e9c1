//! What looks like a slip.

use super::*;

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

/// Values that do not fit the mechanism, where they stand, and the end of what is said of each.
fn slips_beside_the_mechanism() -> [(&'static str, &'static str, String); 11] {
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
    [
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
    ]
}

#[test]
fn lengths_and_angles_that_do_not_fit_the_mechanism_are_found() {
    let file = File::new("millimetres", MILLIMETRES);
    for (value, path, wanted) in slips_beside_the_mechanism() {
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
}

#[test]
fn lengths_and_angles_that_fit_are_no_slips() {
    let file = File::new("fitting", MILLIMETRES);
    // A turn and 355 degrees, text in radians, a centre of mass on a pin or a little off it.
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
