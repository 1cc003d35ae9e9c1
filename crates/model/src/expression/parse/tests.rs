//! Where a unit ends and a name begins, with values by hand.

use super::super::{Expression, Fixed, Known, Misfit, Moving, Place, Quantity, Results};
use crate::dimension::{Dimension, Powers, powers};
use crate::error::Complaint;

/// The motion of a body that is called `s`, with time.
struct Motion;

const NAMES: [(&str, Dimension, f64); 5] = [
    ("t", Dimension::Time, 0.02),
    ("time", Dimension::Time, 0.02),
    ("s.angle", Dimension::Angle, 0.5),
    ("s.x", Dimension::Length, 0.3),
    ("min.x", Dimension::Length, 0.7),
];

impl Results for Motion {
    fn find(&self, name: &str) -> Option<Known> {
        let index = NAMES.iter().position(|row| row.0 == name)?;
        Some(Known {
            place: Place::Row(index),
            powers: NAMES[index].1.powers(),
        })
    }

    fn table(&self, name: &str) -> Option<(usize, [Powers; 2])> {
        let columns = [Dimension::Time, Dimension::Length].map(Dimension::powers);
        (name == "h").then_some((0, columns))
    }

    fn missing(&self, name: &str, _: &[String]) -> Complaint {
        Complaint::new("", format!("nothing is called {name:?}"))
    }
}

fn moving(text: &str) -> Result<Moving, Misfit> {
    let parameters = [
        ("g", Quantity::si(9.81, powers(1, 0, -2, 0))),
        ("n", Quantity::plain(4.0)),
    ];
    Moving::read(text, &parameters, &Motion, false)
}

#[test]
fn a_unit_joins_units_and_leaves_names_to_what_moves() {
    for (text, value, unit) in [
        // `t` is time behind an operator, and the tonne behind a number
        ("=5 N/s*t", 5.0 * 0.02, "N"),
        ("=5 N/s * t", 5.0 * 0.02, "N"),
        ("=3 N/t", 3.0 / 0.02, "kg*m/s^3"),
        ("=2 t*t", 2000.0 * 0.02, "kg*s"),
        ("=2 t/s*t", 2000.0 * 0.02, "kg"),
        ("=5 kg/s^2*t^2", 5.0 * 0.02 * 0.02, "kg"),
        ("=5 N/(t)", 5.0 / 0.02, "kg*m/s^3"),
        ("=5 N/s*time", 5.0 * 0.02, "N"),
        // functions
        ("=500 N*min(1, t/(0.05 s))", 500.0 * 0.4, "N"),
        ("=500 N*min(1, t/0.05 s)", 500.0 * 0.4, "N"),
        ("=500 N*min (1, n)", 500.0, "N"),
        ("=3 m*max(0, 1 - t/(1 s))", 3.0 * 0.98, "m"),
        ("=2 N*step(t - 1 s)", 0.0, "N"),
        ("=2 N*mod(t, 0.015 s)/(1 s)", 2.0 * 0.005, "N"),
        ("=2 N*table(t; 0 s, 1; 1 s, 2)", 2.0 * 1.02, "N"),
        ("=6 rad/min*t", 0.1 * 0.02, "rad"),
        (
            "=2 rev/min*sin(s.angle)",
            4.0 * std::f64::consts::PI / 60.0 * 0.5_f64.sin(),
            "rad/s",
        ),
        // bodies that are called like units
        ("=5 N/rad*s.angle", 2.5, "N"),
        ("=5 N*s/m*s.x", 1.5, "kg*m/s"),
        ("=5 N/m*min.x", 3.5, "N"),
        // brackets of units alone
        ("=5 N/(rad*s)*t*s.angle", 5.0 * 0.02 * 0.5, "N"),
        ("=5 N/(2 rad*s)*t*s.angle", 2.5 * 0.02 * 0.5, "N"),
        ("=2 N*m/(rad/s)", 2.0, "N*m*s/rad"),
        ("=4 N/(mm)^2*t", 4e6 * 0.02, "kg/m/s"),
        ("=4 N/(mm^2)*t", 4e6 * 0.02, "kg/m/s"),
        // a parameter in brackets
        ("=2 kg*(g)", 19.62, "N"),
    ] {
        let read = moving(text).unwrap_or_else(|misfit| panic!("{text}: {misfit:?}"));
        let inputs = NAMES.map(|row| row.2);
        let parameters = [9.81, 4.0];
        let fixed = Fixed {
            parameters: &parameters,
            ..Fixed::default()
        };
        let found = read.program.value_on(&inputs, fixed, None);
        assert!(
            (found - value).abs() <= 1e-14 * value.abs().max(1e-2),
            "{text}: {found}"
        );
        assert_eq!(read.quantity.unit(), unit, "{text}");
    }
}

#[test]
fn a_name_that_is_used_as_one_is_no_unit() {
    let quantity = |text: &str| moving(text).map(|read| read.quantity.unit());
    // a table that is called like the hour
    assert_eq!(quantity("=5 N/m*h(t)"), Ok("N".to_owned()));
    for (text, at, message, hint) in [
        (
            "=2 s.angle",
            3,
            "\"s\" where a unit or an operator is expected",
            "a product is written with *: 2*s",
        ),
        (
            "=2 min(1, n)",
            3,
            "\"min\" where a unit or an operator is expected",
            "a product is written with *: 2*min",
        ),
        (
            "=2 m/s*g",
            7,
            "\"g\" is a unit here, and a parameter, too",
            "put the parameter in brackets, *(g), or give it another name",
        ),
        ("=2 m/s*(rad/foo)", 8, "nothing is called \"rad\"", ""),
    ] {
        let Misfit { at: place, fault } = moving(text).unwrap_err();
        let said = (
            place,
            fault.message.as_str(),
            fault.hint.unwrap_or_default(),
        );
        assert_eq!(said, (at, message, hint.to_owned()), "{text}");
    }
}

/// Where nothing moves there is no time, and `t` is the tonne as ever.
#[test]
fn expressions_of_parameters_keep_their_units() {
    let (names, values) = (["m".to_owned()], [Some(Quantity::plain(3.0))]);
    let find = |name: &str| (name == "m").then_some(0);
    for (text, value) in [
        ("=6 kN/t", 6.0),
        ("=2 N*s/mm", 2000.0),
        ("=3 N*min(1, m)", 3.0),
        ("=3 J/(rad/s)", 3.0),
        ("=4 N/(m)", 4.0 / 3.0),
        ("=4 N/(mm)^2", 4e6),
        ("=1/2 mm", 500.0),
    ] {
        let read = Expression::parse(text, &find, &names);
        let found = read.and_then(|read| read.evaluate(&values, false));
        let found = found.unwrap_or_else(|misfit| panic!("{text}: {misfit:?}"));
        let found = found.map_or(f64::NAN, |found| found.value);
        assert!((found - value).abs() <= 1e-14 * value, "{text}: {found}");
    }
}
