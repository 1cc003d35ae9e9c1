//! Tolerances, ranges, fits, play and accuracy: read, printed back, and set.

mod mutants;

use super::*;
use crate::{At, JointKind, Loaded, Measured, Pins, load};
use serde_json::{Value, json};

const FILE: &str = r#"{
  "format": "linkdyn/1",
  "units": { "length": "mm", "angle": "deg" },
  "parameters": {
    "l2": { "value": "100 mm", "tolerance": "0.05 mm", "note": "ground" },
    "l3": { "value": "=2.5*l2", "tolerance": ["-0.02 mm", "0.05 mm"], "distribution": "uniform", "cost": "2 mm" },
    "l4": { "value": 200, "tolerance": "2 %", "sigma": 4 },
    "l1": "300 mm",
    "lean": { "value": "-50 deg", "tolerance": ["-1 %", "=0.01*lean"], "distribution": "triangular" },
    "free": { "value": "1 mm", "cost": "3 mm" },
    "bare": { "value": "1 mm" }
  },
  "bodies": {
    "ground": { "points": { "O": [0, "=free-bare"], "Q": { "position": ["=l1", 0], "tolerance": 0.1, "note": "bored" } } },
    "crank": { "points": { "O": [0, 0], "A": ["=l2", 0] }, "pose": { "angle": "=lean" } },
    "coupler": { "points": { "A": [0, 0], "B": ["=l3", 0] } },
    "rocker": { "points": { "Q": [0, 0], "B": { "position": ["=l4", 0] } } },
    "block": { "points": { "C": [0, 0] } }
  },
  "joints": {
    "a": { "type": "revolute", "between": ["ground.O", "crank.O"], "clearance": { "model": "ideal", "fit": "20 H7/g6" } },
    "b": { "type": "revolute", "between": ["crank.A", "coupler.A"], "clearance": { "model": "ideal", "radius": ["5 um", 0.02] } },
    "c": { "type": "revolute", "between": ["coupler.B", "rocker.B"], "clearance": { "model": "ideal", "radius": "10 um" } },
    "d": { "type": "revolute", "between": ["ground.Q", "rocker.Q"] },
    "e": { "type": "prismatic", "between": ["ground.Q", "block.C"], "axis": [1, 0], "guide_length": 50, "play": "20 um" },
    "f": { "type": "slot", "between": ["block.C", "rocker.B"], "axis": [1, 0], "play": [0.01, "30 um"] },
    "g": { "type": "gear", "between": ["crank.O", "rocker.Q"], "ratio": -2, "carrier": "ground", "backlash": "0.1 mm" }
  },
  "drivers": {
    "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "start": 60, "velocity": "10 rpm" }, "tolerance": 0.5 }
  },
  "accuracy": {
    "outputs": {
      "swing": { "column": "rocker.angle", "at": { "value": 90 }, "limits": [-0.1, "2 mrad"] },
      "gap": { "distance": ["crank.A", "ground.Q"], "at": { "driver": "motor", "value": "1 rev" }, "limits": [-0.1, 0.2] },
      "push": { "column": "driver.motor.effort", "limits": ["-1 N*mm", 1] },
      "P": { "column": "coupler.B.x", "note": "tip" }
    },
    "pins": "rim"
  }
}"#;

fn read(sets: &[&str]) -> Loaded {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    load(FILE.as_bytes(), &sets).unwrap_or_else(|said| panic!("{said}"))
}

fn tolerance(loaded: &Loaded, name: &str) -> Option<Tolerance> {
    let found = loaded
        .parameters
        .iter()
        .find(|parameter| parameter.name == name);
    found.unwrap_or_else(|| panic!("no {name}")).tolerance
}

#[test]
fn tolerances_of_parameters_are_read_in_si() {
    let loaded = read(&[]);
    let normal = |sigma| Distribution::Normal { sigma };
    let wanted = [
        ("l2", Some((-5e-5, 5e-5, normal(3.0), None))),
        ("l3", Some((-2e-5, 5e-5, Distribution::Uniform, Some(2e-3)))),
        ("l4", Some((-4.0, 4.0, normal(4.0), None))),
        ("l1", None),
        ("free", Some((0.0, 0.0, normal(3.0), Some(3e-3)))),
        ("bare", None),
    ];
    for (name, wanted) in wanted {
        let wanted = wanted.map(|(lower, upper, distribution, cost)| Tolerance {
            lower,
            upper,
            distribution,
            cost,
        });
        assert_eq!(tolerance(&loaded, name), wanted, "{name}");
    }
    // 1 % is that of the size, an expression has its sign
    let lean = tolerance(&loaded, "lean").unwrap();
    let angle = 50f64.to_radians();
    assert!(
        (lean.lower + 0.01 * angle).abs() < 1e-16 && lean.lower == lean.upper,
        "{lean:?}"
    );
    assert_eq!(lean.distribution, Distribution::Triangular);
    assert_eq!(loaded.parameters[0].value, 0.1);
    assert_eq!(loaded.parameters[1].text, "=2.5*l2");
}

#[test]
fn clearances_and_plays_have_ranges() {
    let loaded = read(&[]);
    let clearance = |name: &str| match &loaded.model.joints[name].kind {
        JointKind::Revolute { clearance, .. } => clearance.as_deref().unwrap(),
        other => panic!("{other:?}"),
    };
    let (a, b, c) = (clearance("a"), clearance("b"), clearance("c"));
    assert_eq!(
        (a.radius, a.limits()),
        (Some(12e-6), Some([3.5e-6, 20.5e-6]))
    );
    assert_eq!(a.read_fit().unwrap().hole, [0.0, 21.0]);
    assert_eq!((b.radius, b.limits()), (Some(12.5e-6), Some([5e-6, 2e-5])));
    assert_eq!(
        (c.radius, c.range, c.limits()),
        (Some(1e-5), None, Some([1e-5, 1e-5]))
    );
    let joints = &loaded.model.joints;
    let JointKind::Prismatic { play, .. } = &joints["e"].kind else {
        panic!()
    };
    assert_eq!(
        *play,
        Some(Play {
            least: 2e-5,
            most: 2e-5
        })
    );
    let JointKind::Slot { play, .. } = &joints["f"].kind else {
        panic!()
    };
    assert_eq!(
        *play,
        Some(Play {
            least: 1e-5,
            most: 3e-5
        })
    );
    let JointKind::Gear { backlash, .. } = &joints["g"].kind else {
        panic!()
    };
    assert_eq!(*backlash, Some(1e-4));
    let driver = &loaded.model.drivers["motor"];
    assert_eq!(driver.tolerance, Some(0.5_f64.to_radians()));
    let bodies = &loaded.model.bodies;
    assert_eq!(bodies["ground"].points["Q"], [0.3, 0.0]);
    assert_eq!(bodies["ground"].point_tolerances["Q"], 1e-4);
    assert_eq!(bodies["rocker"].points["B"], [0.2, 0.0]);
    assert!(bodies["rocker"].point_tolerances.is_empty());
}

#[test]
fn outputs_are_in_the_units_of_their_columns() {
    let loaded = read(&[]);
    let accuracy = loaded.model.accuracy.as_ref().unwrap();
    assert_eq!(accuracy.pins, Pins::Rim);
    let output = |name: &str| &accuracy.outputs[name];
    assert_eq!(output("swing").of, Measured::Column("rocker.angle".into()));
    assert_eq!(
        output("swing").limits,
        Some([(-0.1_f64).to_radians(), 2e-3])
    );
    let at = |driver: Option<&str>, degrees: f64| At {
        driver: driver.map(str::to_owned),
        value: degrees.to_radians(),
    };
    assert_eq!(output("swing").at, Some(at(None, 90.0)));
    assert_eq!(output("gap").at, Some(at(Some("motor"), 360.0)));
    assert_eq!(output("gap").limits, Some([-1e-4, 2e-4]));
    assert!(matches!(&output("gap").of, Measured::Distance([first, _]) if first.point == "A"));
    assert_eq!(output("push").limits, Some([-1e-3, 1.0]));
    assert_eq!((&output("P").at, output("P").limits), (&None, None));
}

#[test]
fn all_of_it_is_printed_back() {
    let loaded = read(&[]);
    assert_eq!(loaded.source.print(&loaded.model), loaded.document);
    // without the file the same model comes back
    let printed = loaded.model.to_json();
    let again = load(printed.to_string().as_bytes(), &[]).unwrap();
    let mut model = again.model.into_model();
    model.display = loaded.model.display.clone();
    // the file's degrees are plain radians then
    assert_eq!(model, loaded.model.clone().into_model());
    assert_eq!(
        printed["joints"]["a"]["clearance"],
        json!({ "model": "ideal", "fit": "20 H7/g6" })
    );
    assert_eq!(
        printed["joints"]["b"]["clearance"]["radius"],
        json!([5e-6, 2e-5])
    );
    assert_eq!(printed["joints"]["e"]["play"], json!(2e-5));
}

#[test]
fn what_is_changed_is_printed_as_it_is() {
    let loaded = read(&[]);
    let changed = loaded.model.edit(|model| {
        for name in ["a", "b"] {
            let JointKind::Revolute {
                clearance: Some(clearance),
                ..
            } = &mut model.joints[name].kind
            else {
                panic!()
            };
            clearance.radius = Some(1e-4);
        }
        let ground = &mut model.bodies["ground"];
        ground.point_tolerances.shift_remove("Q");
        ground.point_tolerances.insert("O".into(), 2e-4);
        let JointKind::Slot { play, .. } = &mut model.joints["f"].kind else {
            panic!()
        };
        *play = Some(Play {
            least: 1e-5,
            most: 1e-5,
        });
        let outputs = &mut model.accuracy.as_mut().unwrap().outputs;
        outputs["P"].of = Measured::Distance(
            ["crank.A", "ground.Q"].map(|point| point.to_owned().try_into().unwrap()),
        );
    });
    let printed = loaded.source.print(&changed.unwrap());
    let at = |path: &str| printed.pointer(path).unwrap_or(&Value::Null).clone();
    assert_eq!(
        at("/joints/a/clearance"),
        json!({ "model": "ideal", "radius": "0.0001 m" })
    );
    assert_eq!(at("/joints/b/clearance/radius"), json!("0.0001 m"));
    assert_eq!(at("/joints/f/play"), json!("1e-5 m"));
    assert_eq!(
        at("/bodies/ground/points/Q"),
        json!({ "position": ["=l1", 0], "note": "bored" })
    );
    assert_eq!(
        at("/bodies/ground/points/O"),
        json!({ "position": [0, "=free-bare"], "tolerance": "0.0002 m" })
    );
    assert_eq!(
        at("/accuracy/outputs/P"),
        json!({ "note": "tip", "distance": ["crank.A", "ground.Q"] })
    );
    let again = load(printed.to_string().as_bytes(), &[]).unwrap_or_else(|said| panic!("{said}"));
    assert_eq!(again.source.print(&again.model), printed);
}

#[test]
fn sets_of_a_value_leave_its_tolerance() {
    let loaded = read(&["parameters.l2=120 mm", "bodies.ground.points.Q=[310, 5]"]);
    assert_eq!(loaded.parameters[0].value, 0.12);
    assert_eq!(tolerance(&loaded, "l2").unwrap().upper, 5e-5);
    assert_eq!(loaded.model.bodies["coupler"].points["B"][0], 0.3);
    assert_eq!(loaded.model.bodies["ground"].points["Q"], [0.31, 5e-3]);
    assert_eq!(loaded.model.bodies["ground"].point_tolerances["Q"], 1e-4);
    let loaded = read(&[
        "bodies.ground.points.Q[1]=5",
        "parameters.l2={\"value\": \"120 mm\"}",
    ]);
    assert_eq!(loaded.model.bodies["ground"].points["Q"], [0.3, 5e-3]);
    assert_eq!(tolerance(&loaded, "l2"), None);
}

#[test]
fn tolerances_are_set_beside_values() {
    let loaded = read(&[
        "parameters.l1.tolerance=1 mm",
        "parameters.l2.tolerance=[0, \"1 %\"]",
    ]);
    assert_eq!(tolerance(&loaded, "l1").unwrap().lower, -1e-3);
    assert_eq!(tolerance(&loaded, "l2").unwrap().upper, 1e-3);
    assert_eq!(
        loaded.document["parameters"]["l1"],
        json!({ "value": "300 mm", "tolerance": "1 mm" })
    );
    let loaded = read(&["bodies.crank.points.A.tolerance=20 um"]);
    assert_eq!(loaded.model.bodies["crank"].point_tolerances["A"], 2e-5);
    assert_eq!(loaded.model.bodies["crank"].points["A"], [0.1, 0.0]);
}

#[test]
fn radius_and_fit_take_each_others_place_when_set() {
    let clearance = |sets: &[&str], joint: &str| match &read(sets).model.joints[joint].kind {
        JointKind::Revolute { clearance, .. } => clearance.as_deref().unwrap().clone(),
        other => panic!("{other:?}"),
    };
    let a = clearance(&["joints.a.clearance.radius=30 um"], "a");
    assert_eq!((a.limits(), a.fit), (Some([3e-5, 3e-5]), None));
    let b = clearance(&["joints.b.clearance.fit=20 H7/h6"], "b");
    assert_eq!((b.limits(), b.radius), (Some([0.0, 17e-6]), Some(8.5e-6)));
}
