//! Units by hand.

use std::f64::consts::PI;

use super::table::nearest;
use super::*;
use crate::dimension::Dimension;

fn si(text: &str, dimension: Dimension) -> f64 {
    let (number, unit) = split_quantity(text).expect(text);
    let unit = Unit::parse(unit).unwrap_or_else(|fault| panic!("{text}: {fault:?}"));
    assert!(
        dimension.powers().accepts(unit.powers),
        "{text} is no {dimension:?}"
    );
    unit.to_si(number)
}

#[test]
fn powers_of_ten_are_rounded_once() {
    for (text, dimension, value) in [
        ("410 mm", Dimension::Length, 0.41),
        ("0.1 mm", Dimension::Length, 1e-4),
        ("10 µm", Dimension::Length, 1e-5),
        ("1.7 km", Dimension::Length, 1700.0),
        ("700 kg*mm^2", Dimension::Inertia, 7e-4),
        ("3 g·mm²", Dimension::Inertia, 3e-9),
        ("207 GPa", Dimension::Stress, 207e9),
        ("0.7 N/mm", Dimension::Stiffness, 700.0),
        ("-9810 mm/s^2", Dimension::Acceleration, -9.81),
        ("1e-3 N*mm", Dimension::Torque, 1e-6),
        ("2.5e3 N mm", Dimension::Torque, 2.5),
        ("7 N*s/mm", Dimension::Damping, 7000.0),
        ("5ms", Dimension::Time, 0.005),
    ] {
        assert_eq!(si(text, dimension), value, "{text}");
    }
}

#[test]
fn exact_definitions() {
    for (text, dimension, value) in [
        ("1 in", Dimension::Length, 0.0254),
        ("10 in", Dimension::Length, 0.254),
        ("1 ft", Dimension::Length, 0.3048),
        ("1 lb", Dimension::Mass, 0.45359237),
        ("1 lbf", Dimension::Force, 4.4482216152605),
        ("1 kgf", Dimension::Force, 9.80665),
        ("1 slug", Dimension::Mass, 14.593902937206364),
        ("1 psi", Dimension::Stress, 6894.757293168362),
        ("1 lbf*in", Dimension::Torque, 0.1129848290276167),
        ("1 lb*in^2", Dimension::Inertia, 2.926396534292e-4),
        ("90 min", Dimension::Time, 5400.0),
    ] {
        let found = si(text, dimension);
        assert!(
            (found / value - 1.0).abs() <= f64::EPSILON,
            "{text}: {found} instead of {value}"
        );
    }
}

#[test]
fn angles_agree_with_the_library() {
    for degrees in [1.0, 30.0, 60.0, 90.0, 180.0, 213.7] {
        assert_eq!(
            si(&format!("{degrees} deg"), Dimension::Angle),
            f64::to_radians(degrees)
        );
    }
    assert_eq!(si("1 rev", Dimension::Angle), 2.0 * PI);
    assert_eq!(si("60 rpm", Dimension::AngularVelocity), 60.0 * (PI / 30.0));
    assert_eq!(si("1 deg/s^2", Dimension::AngularAcceleration), PI / 180.0);
    assert_eq!(si("1 N*m/deg", Dimension::AngularStiffness), 180.0 / PI);
    assert_eq!(si("3 N*m", Dimension::AngularStiffness), 3.0);
    assert_eq!(si("3 N*m/(rad/s)", Dimension::AngularDamping), 3.0);
}

#[test]
fn the_radian_stands_for_itself() {
    let accepts = |dimension: Dimension, text: &str| {
        dimension
            .powers()
            .accepts(Unit::parse(text).unwrap().powers)
    };
    assert!(!accepts(Dimension::AngularVelocity, "Hz"));
    assert!(!accepts(Dimension::Frequency, "rad/s"));
    assert!(!accepts(Dimension::Torque, "N*m/rad"));
    assert!(!accepts(Dimension::AngularStiffness, "N*m*rad"));
    assert!(accepts(Dimension::Stiffness, "kg/s^2"));
}

#[test]
fn what_is_no_unit_is_said_so() {
    assert_eq!(Unit::parse(""), Err(UnitFault::Missing));
    assert_eq!(
        Unit::parse("Mm"),
        Err(UnitFault::Unknown {
            symbol: "Mm".into(),
            nearest: Some("mm")
        })
    );
    for text in ["mm^", "*", "N*", "N//m", "(N", "N)", "m^x", "m3", "5"] {
        assert_eq!(Unit::parse(text), Err(UnitFault::Malformed), "{text}");
    }
    for text in [
        "m^99",
        "m^99999999999",
        "m*m*m*m*m*m*m*m*m*m*m*m*m",
        &"(".repeat(1000),
    ] {
        assert_eq!(Unit::parse(text), Err(UnitFault::TooLarge), "{text}");
    }
}

#[test]
fn units_that_are_written_out_have_their_symbol() {
    for (name, meant) in [
        ("inch", "in"),
        ("inches", "in"),
        ("degree", "deg"),
        ("Degrees", "deg"),
        ("millimeter", "mm"),
        ("millimetres", "mm"),
        ("Newton", "N"),
        ("lbs", "lb"),
        ("seconds", "s"),
        ("RPM", "rpm"),
    ] {
        assert_eq!(nearest(name), Some(meant), "{name}");
    }
}

#[test]
fn numbers_and_units_are_told_apart() {
    for (text, parts) in [
        ("5 mm", Some(("5", "mm"))),
        (" -.5e3mm ", Some(("-.5e3", "mm"))),
        ("1 eV", Some(("1", "eV"))),
        ("1e", Some(("1", "e"))),
        ("5", Some(("5", ""))),
        ("+5. N", Some(("+5.", "N"))),
        ("mm", None),
        ("- 5 mm", None),
        (".", None),
        ("inf m", None),
        ("", None),
    ] {
        assert_eq!(split_quantity(text), parts, "{text}");
    }
}
