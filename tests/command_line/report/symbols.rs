//! Symbols that move with the mechanism: a cylinder, a torsion spring.

use super::*;

/// An arm that a cylinder lifts from 500 to 750 mm of length, with a coil at its hinge.
const ARM: &str = r#"{ "format": "linkdyn/1", "name": "arm", "units": { "length": "mm", "angle": "deg" },
  "bodies": {
    "ground": { "points": { "hinge": [0, 0], "foot": [200, -400] } },
    "arm": { "points": { "hinge": [0, 0], "eye": [500, 0] } },
    "tube": { "points": { "foot": [0, 0] }, "pose": { "position": [200, -400], "angle": -36.87 } },
    "rod": { "points": { "eye": [0, 0] }, "pose": { "position": [500, 0], "angle": -36.87 } } },
  "joints": {
    "hinge": { "type": "revolute", "between": ["ground.hinge", "arm.hinge"] },
    "foot": { "type": "revolute", "between": ["ground.foot", "tube.foot"] },
    "eye": { "type": "revolute", "between": ["arm.eye", "rod.eye"] },
    "cylinder": { "type": "prismatic", "between": ["tube.foot", "rod.eye"], "axis": [0, 1] } },
  "drivers": { "oil": { "type": "translation", "joint": "cylinder", "motion": { "type": "constant_velocity", "start": 500, "velocity": "50 mm/s" } } },
  "forces": { "coil": { "type": "torsion_spring", "between": ["ground", "arm"], "stiffness": "3 N*m/rad", "free_angle": 90 } },
  "analysis": { "type": "kinematics", "end": 5, "outputs": 11 } }"#;

#[test]
fn a_cylinder_and_a_coil_move_with_what_they_join() {
    let Some(browser) = find() else { return };
    let scratch = Scratch::new("symbols");
    let path = scratch.0.join("model.json");
    fs::write(&path, ARM).expect("written");
    let (page, _, _) = run(&[path.to_str().expect("UTF-8")]);
    let (told, visit) = ask(&browser, &page, include_str!("symbols.js"), None);
    assert!(visit.console.is_empty(), "{:#?}", visit.console);
    let number = |row: usize, key: &str| {
        told[row][key]
            .as_f64()
            .unwrap_or_else(|| panic!("{key} in {told:#}"))
    };
    for (row, length) in [(0, 500.0), (1, 750.0)] {
        for key in ["barrels", "rods", "coils"] {
            assert_eq!(told[row][key], 1, "{key}: {told:#}");
        }
        // The barrel begins at its foot, the rod ends at its eye; what is between them is the driver's value. Poses are those of
        // an assembly to 1e-9 of the mechanism's length, which is below 1e-3 mm.
        assert!(number(row, "foot_to_base") < 1e-3, "{told:#}");
        assert!(number(row, "tip_to_eye") < 1e-3, "{told:#}");
        assert!((number(row, "tip") - length).abs() < 1e-3, "{told:#}");
        // The piston stays inside, the eye outside.
        let barrel = number(row, "barrel");
        assert!(number(row, "inner") > 0.0 && number(row, "inner") < barrel);
        assert!(barrel < length, "{told:#}");
        // The coil lies around the hinge; one end stays with the ground, the other one turns with the arm.
        assert!(number(row, "inner_radius") > 5.0 && number(row, "outer_radius") < 20.0);
        for end in ["inner_end", "outer_end"] {
            assert!((number(row, end) - 1.0).abs() < 1e-6, "{end}: {told:#}");
        }
        assert!(
            number(row, "turned") > 3.0 * std::f64::consts::PI,
            "{told:#}"
        );
    }
    assert!((number(0, "barrel") - number(1, "barrel")).abs() < 1e-3);
    assert!(
        (number(0, "turned") - number(1, "turned")).abs() > 0.1,
        "the coil winds up: {told:#}"
    );
}
