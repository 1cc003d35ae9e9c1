//! `linkdyn export --fmu`: what is in the unit, and what is refused. That units move as they should is tested where their library is
//! (`crates/fmi/tests`), and with an importer (`python/tests/test_fmu.py`).

use crate::browser::Scratch;
use roxmltree::{Document, Node};
use std::collections::BTreeSet;
use std::fs;
use std::io::{Cursor, Read};
use std::process::{Command, Stdio};
use zip::ZipArchive;

/// The first bytes of a library for Linux on x86-64, and the name of the entry that makes it one of ours.
fn library() -> Vec<u8> {
    let mut bytes = b"\x7fELF".to_vec();
    bytes.resize(18, 0);
    bytes.extend([62, 0]);
    bytes.extend(b"fmi3InstantiateCoSimulation");
    bytes
}

/// A crank that its driver turns, and a model that moves freely.
const CRANK: &str = r#"{ "format": "linkdyn/1", "units": "SI", "name": "Crank <1>", "parameters": { "r": "50 mm", "k": 2 },
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "crank": { "mass": 1, "inertia": 2, "com": [0, 0], "points": { "O": [0, 0], "A": ["=r", 0] } } },
  "joints": { "pin": { "type": "revolute", "between": ["ground.O", "crank.O"] } },
  "drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": "60 rpm" } } },
  "inputs": { "brake": "3 N*m" }, "forces": { "brake": { "type": "torque", "body": "crank", "value": "=-k*input.brake" } },
  "points": ["crank.A"],
  "analysis": { "type": "inverse_dynamics", "end": 2, "outputs": 5 } }"#;

fn scratch(name: &str) -> Scratch {
    let scratch = Scratch::new(name);
    fs::write(scratch.0.join("lib.so"), library()).expect("written");
    fs::write(scratch.0.join("crank.json"), CRANK).expect("written");
    scratch
}

/// Runs `linkdyn export`: exit status, standard output, standard error.
fn export(scratch: &Scratch, arguments: &str) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("export").args(arguments.split(' '));
    command.current_dir(&scratch.0).stdin(Stdio::null());
    let output = command.output().expect("the binary runs");
    let [said, complained] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("UTF-8"));
    (output.status.code(), said, complained)
}

/// The paths in a unit, and the text of one of them.
fn opened(scratch: &Scratch, path: &str) -> (Vec<String>, String) {
    let bytes = fs::read(scratch.0.join("a.fmu")).expect("a unit");
    let mut archive = ZipArchive::new(Cursor::new(bytes)).expect("a ZIP file");
    let paths = archive.file_names().map(str::to_owned).collect();
    let mut text = String::new();
    let mut file = archive.by_name(path).expect("a file");
    file.read_to_string(&mut text).expect("a text");
    (paths, text)
}

/// Exports, and gives the attributes of each variable: name, causality, unit, start.
#[track_caller]
fn variables(scratch: &Scratch, arguments: &str) -> Vec<String> {
    let (status, _, complained) = export(scratch, arguments);
    assert_eq!((status, complained.as_str()), (Some(0), ""));
    let (_, text) = opened(scratch, "modelDescription.xml");
    let document = Document::parse(&text).expect("XML");
    let defined = document
        .descendants()
        .filter(|node| node.has_tag_name("Unit"));
    let defined: BTreeSet<&str> = defined.filter_map(|node| node.attribute("name")).collect();
    let of = |node: Node| {
        let real = node.first_element_child().unwrap_or(node);
        let unit = real.attribute("unit");
        assert!(
            unit.is_none_or(|unit| defined.contains(unit)),
            "{unit:?} of {defined:?}"
        );
        let attributes = [
            node.attribute("name"),
            node.attribute("causality"),
            unit,
            real.attribute("start"),
        ];
        attributes.map(|text| text.unwrap_or("-")).join(" ")
    };
    let all = document.descendants();
    let all = all
        .filter(|node| node.has_tag_name("ModelVariables"))
        .flat_map(|node| node.children());
    all.filter(Node::is_element).map(of).collect()
}

#[test]
fn a_unit_has_its_parts_and_is_the_same_each_time() {
    let scratch = scratch("fmu-parts");
    let arguments = "pendulum --fmu --library lib.so -o a.fmu";
    let (status, said, complained) = export(&scratch, arguments);
    assert_eq!((status, complained.as_str()), (Some(0), ""));
    assert!(
        said.contains("FMI 3.0 for co-simulation, 1 parameter, 0 inputs, 2 outputs"),
        "{said}"
    );
    let first = fs::read(scratch.0.join("a.fmu")).expect("a unit");
    let (paths, model) = opened(&scratch, "resources/model.json");
    let own = [
        "modelDescription.xml",
        "documentation/index.html",
        "resources/model.json",
    ];
    assert_eq!(paths[..3], own);
    assert_eq!(paths[3], "binaries/x86_64-linux/linkdyn_pendulum.so");
    assert!(
        model.contains(r#""length": "1 m""#),
        "parameters stay: {model}"
    );
    assert_eq!(export(&scratch, arguments).0, Some(0));
    assert_eq!(fs::read(scratch.0.join("a.fmu")).expect("a unit"), first);
    assert_eq!(
        export(&scratch, "pendulum --fmu --fmi 2 --library lib.so -o a.fmu").0,
        Some(0)
    );
    let (paths, _) = opened(&scratch, "modelDescription.xml");
    assert_eq!(paths[3], "binaries/linux64/linkdyn_pendulum.so");
}

#[test]
fn variables_are_time_parameters_inputs_columns_and_events() {
    let scratch = scratch("fmu-variables");
    for version in ["2", "3"] {
        let free = format!(
            "crank.json --fmu --fmi {version} --library lib.so --input driver.motor.effort --output crank.omega --output crank.A.? -o a.fmu"
        );
        let expected = [
            "time independent s -",
            "parameters.r parameter m 0.05",
            "parameters.k parameter - 2.0",
            "input.brake input N*m 3.0",
            "input.motor input N*m 0.0",
            "crank.omega output rad/s -",
            "crank.A.x output m -",
            "crank.A.y output m -",
            "events output - -",
        ];
        // FMI 2.0 needs no variable for the time.
        let first = usize::from(version == "2");
        assert_eq!(variables(&scratch, &free), expected[first..]);
    }
}

/// A driver of a mechanism that moves beside it is led.
#[test]
fn a_driver_can_be_led() {
    let scratch = scratch("fmu-led");
    let model = CRANK.replace(
        r#""joints": {"#,
        r#""joints": { "out": { "type": "revolute", "between": ["ground.O", "other.O"] },"#,
    );
    let model = model.replace(r#""bodies": {"#, r#""bodies": { "other": { "mass": 1, "inertia": 1, "com": [0, 0], "points": { "O": [0, 0] } },"#);
    let model = model.replace("inverse_dynamics", "dynamics");
    fs::write(scratch.0.join("led.json"), model).expect("written");
    let led = "led.json --fmu --library lib.so --input driver.motor.acceleration --output driver.* -o a.fmu";
    let all = variables(&scratch, led);
    assert!(
        all.contains(&"driver.motor.acceleration input rad/s^2 0.0".to_owned()),
        "{all:?}"
    );
    let (_, list) = opened(&scratch, "resources/steered.json");
    assert_eq!(list, r#"["motor"]"#);
}

#[test]
fn what_can_not_be_a_unit_is_refused() {
    let scratch = scratch("fmu-refused");
    fs::write(
        scratch.0.join("text.so"),
        "#!/bin/sh\necho no library, only text\n",
    )
    .expect("written");
    fs::write(scratch.0.join("other.so"), &library()[..30]).expect("written");
    let cases = [
        (
            "pendulum --fmu -o a.zip",
            "a.zip: the name of the file must end in .fmu",
        ),
        (
            "four-bar --fmu --library lib.so -o a.fmu",
            "four-bar: analysis.type is \"inverse_dynamics\": a functional mock-up unit moves by \"dynamics\" (--input driver.motor.effort lets a \
             driver go, so that its torque or force moves the mechanism; --set analysis.type=dynamics where forces move it)",
        ),
        (
            "pendulum --fmu --library lib.so --output rod.angel -o a.fmu",
            "--output rod.angel: matches no result column (did you mean \"rod.angle\"?)",
        ),
        (
            "pendulum --fmu --library lib.so --output zzz -o a.fmu",
            "--output zzz: matches no result column (`linkdyn run pendulum -o -` prints their names)",
        ),
        (
            "crank.json --fmu --library lib.so --input driver.mtor.effort -o a.fmu",
            "--input driver.mtor.effort: there is no driver \"mtor\" (did you mean \"motor\"?)",
        ),
        (
            "pendulum --fmu --library lib.so --input driver.motor.effort -o a.fmu",
            "--input driver.motor.effort: there is no driver \"motor\" (the model has none)",
        ),
        (
            "crank.json --fmu --library lib.so --input torque -o a.fmu",
            "--input torque: not driver.NAME.effort or driver.NAME.acceleration (other inputs are written into the model: \"inputs\": { \
             \"torque\": \"0 N*m\" })",
        ),
        (
            "crank.json --fmu --library lib.so --input driver.motor.effort --input driver.motor.acceleration -o a.fmu",
            "--input driver.motor.acceleration: the driver is let go by --input driver.motor.effort (give one of them)",
        ),
        (
            "pendulum --fmu --library none.so -o a.fmu",
            "--library none.so: can't be read: No such file or directory (os error 2)",
        ),
        (
            "pendulum --fmu --library text.so -o a.fmu",
            "--library text.so: no library for Linux, Windows or macOS on x86-64 or ARM (`cargo build --release -p linkdyn-fmi` makes one)",
        ),
        (
            "pendulum --fmu --library other.so -o a.fmu",
            "--library other.so: a library, but not that of linkdyn (`cargo build --release -p linkdyn-fmi` makes it)",
        ),
        (
            "pendulum --fmu --library lib.so --library lib.so -o a.fmu",
            "--library lib.so: there is a library for its system already",
        ),
        (
            "pendulun --fmu --library lib.so -o a.fmu",
            "pendulun: no such file, and no bundled model of that name (did you mean \"pendulum\"?)",
        ),
        (
            "pendulum --fmu --library lib.so -o crank.json/b.fmu",
            "crank.json: not a directory, so results can't be written into it (choose another with -o)",
        ),
    ];
    for (arguments, said) in cases {
        fs::write(scratch.0.join("a.fmu"), "").expect("written");
        let (status, _, complained) = export(&scratch, arguments);
        assert_eq!(status, Some(2), "{arguments}: {complained}");
        assert!(
            complained.contains(said),
            "{said:?} is not in {complained:?}"
        );
    }
    let (status, _, complained) = export(&scratch, "pendulum --fmu --fmi 1 -o a.fmu");
    assert_eq!(status, Some(2));
    assert!(complained.contains("1 is not in 2..=3"), "{complained}");
    let (status, _, complained) = export(&scratch, "pendulum -o a.fmu");
    assert_eq!(status, Some(2));
    assert!(complained.contains("--fmu"), "{complained}");
}
