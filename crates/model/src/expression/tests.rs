use super::super::dimension::powers;
use super::*;

/// r = 50 mm, l = 3 r, k = 2 N/mm, mass = 3 kg, phi = 30 deg, n = 4, omega = 10 rad/s.
fn known() -> (Vec<String>, Vec<Option<Quantity>>) {
    let quantities = [
        ("r", Quantity::si(0.05, powers(1, 0, 0, 0))),
        ("l", Quantity::si(0.15, powers(1, 0, 0, 0))),
        ("k", Quantity::si(2000.0, powers(0, 1, -2, 0))),
        ("mass", Quantity::si(3.0, powers(0, 1, 0, 0))),
        ("phi", Quantity::si(30f64.to_radians(), powers(0, 0, 0, 1))),
        ("n", Quantity::plain(4.0)),
        ("omega", Quantity::si(10.0, powers(0, 0, -1, 1))),
        ("m", Quantity::plain(1.0)),
    ];
    (
        quantities
            .iter()
            .map(|(name, _)| name.to_string())
            .collect(),
        quantities.map(|(_, value)| Some(value)).into(),
    )
}

fn evaluate(text: &str) -> Result<Quantity, Misfit> {
    let (names, values) = known();
    let find = |name: &str| names.iter().position(|known| known == name);
    let expression = Expression::parse(text, &find, &names)?;
    Ok(expression
        .evaluate(&values, true)?
        .expect("all have values"))
}

#[test]
fn values_and_units_are_those_of_the_hand() {
    for (text, value, unit) in [
        ("=2+3*4", 14.0, ""),
        ("= 2 - 3 - 4", -5.0, ""),
        ("=2/4/2", 0.25, ""),
        ("=2^3^2", 512.0, ""),
        ("=-2^2", -4.0, ""),
        ("=2^-2", 0.25, ""),
        ("=--2 + +3", 5.0, ""),
        ("=(1+2)*(3-1)", 6.0, ""),
        ("=3*r", 0.15000000000000002, "m"),
        ("=r^2", 0.0025000000000000005, "m^2"),
        ("=mass*r^2/12", 3.0 * 0.0025000000000000005 / 12.0, "kg*m^2"),
        ("=sqrt(k/mass)", (2000.0_f64 / 3.0).sqrt(), "Hz"),
        ("=r*omega", 0.5, "m*rad/s"),
        ("=r*omega + 1 m/s", 1.5, "m/s"),
        ("=sqrt(r)", 0.05_f64.sqrt(), "m^0.5"),
        ("=sqrt(r)^4", 0.05_f64.sqrt().powi(4), "m^2"),
        (
            "=r^(1/3)*r^(2/3)",
            0.05_f64.powf(1.0 / 3.0) * 0.05_f64.powf(2.0 / 3.0),
            "m",
        ),
        ("=r + 5 mm", 0.055, "m"),
        ("=r+5mm*2", 0.060000000000000005, "m"),
        ("=2 N/mm", 2000.0, "N/m"),
        ("=2 kg*mm^2/12", 2e-6 / 12.0, "kg*m^2"),
        ("=1/2 mm", 500.0, "1/m"),
        ("=3 mm²", 3e-6, "m^2"),
        ("=(3 mm)^2", 9.0e-6, "m^2"),
        ("=sin(phi)", 30f64.to_radians().sin(), ""),
        ("=sin(30 deg)", 30f64.to_radians().sin(), ""),
        ("=cos(pi)", -1.0, ""),
        ("=cos(r/l)", (0.05_f64 / 0.15).cos(), ""),
        ("=tan(0)", 0.0, ""),
        ("=asin(1)", std::f64::consts::FRAC_PI_2, "rad"),
        ("=acos(-1)", std::f64::consts::PI, "rad"),
        ("=atan(1)", std::f64::consts::FRAC_PI_4, "rad"),
        ("=atan2(l, -r)", 0.15_f64.atan2(-0.05), "rad"),
        ("=hypot(3*r, 4*r)", 0.15000000000000002_f64.hypot(0.2), "m"),
        ("=min(r, l, 1 mm)", 0.001, "m"),
        ("=max(1, n, 2)", 4.0, ""),
        ("=abs(-r)", 0.05, "m"),
        ("=exp(ln(n))", 4.0_f64.ln().exp(), ""),
        ("=round(l/r)", 3.0, ""),
        ("=floor(2.7)+ceil(2.1)", 5.0, ""),
        ("=2e3*n", 8000.0, ""),
        ("=2·3×n", 24.0, ""),
        ("=3−1", 2.0, ""),
        ("=.5*n", 2.0, ""),
    ] {
        let found = evaluate(text).unwrap_or_else(|misfit| panic!("{text}: {misfit:?}"));
        assert_eq!(
            (found.value, found.unit().as_str()),
            (value, unit),
            "{text}"
        );
    }
}

/// Texts, the byte at which each fails, and what is said.
const FAULTS: &[(&str, usize, &str)] = &[
    ("=", 1, "the expression ends where a value is expected"),
    ("=r+  ", 3, "the expression ends where a value is expected"),
    ("=r+*2", 3, "\"*\" where a value is expected"),
    ("=2**3", 2, "unknown operator \"**\" (a power is written ^)"),
    (
        "=2(3)",
        2,
        "\"(\" where an operator is expected (a product is written with *)",
    ),
    (
        "=r l",
        3,
        "\"l\" where an operator is expected (a product is written with *)",
    ),
    (
        "=2 r",
        3,
        "\"r\" where a unit or an operator is expected (a product is written with *: 2*r)",
    ),
    (
        "=2 parsec",
        3,
        "unknown unit \"parsec\" (a product is written with *)",
    ),
    (
        "=2 m",
        3,
        "\"m\" is a unit here, and a parameter, too (put the parameter in brackets, *(m), or give it another name)",
    ),
    (
        "=2 mm * m",
        8,
        "\"m\" is a unit here, and a parameter, too (put the parameter in brackets, *(m), or give it another name)",
    ),
    (
        "=2 mm^n",
        5,
        "the power of a unit is a whole number (put the quantity in brackets: (2 mm)^ …)",
    ),
    ("=(r", 1, "this \"(\" is not closed"),
    ("=r)", 2, "this \")\" closes nothing"),
    ("=(r, l)", 3, "\",\" where an operator or \")\" is expected"),
    ("=r%2", 2, "\"%\" where an operator is expected"),
    (
        "=3*omga",
        3,
        "there is no parameter \"omga\" (did you mean \"omega\"?)",
    ),
    (
        "=2*kg",
        3,
        "there is no parameter \"kg\" (the parameters: r, l, k, mass, phi, n, omega, m; a unit stands behind a number, as in 1 kg)",
    ),
    (
        "=2*deg",
        3,
        "there is no parameter \"deg\" (the parameters: r, l, k, mass, phi, n, omega, m; a unit stands behind a number, as in 1 deg)",
    ),
    (
        "=2*width",
        3,
        "there is no parameter \"width\" (the parameters: r, l, k, mass, phi, n, omega, m)",
    ),
    ("=sin", 1, "\"sin\" is a function (write sin( … ))"),
    (
        "=sinn(1)",
        1,
        "there is no function \"sinn\" (did you mean \"sin\"?)",
    ),
    (
        "=r(2)",
        1,
        "\"r\" is no function (a product is written with *)",
    ),
    ("=atan2(1)", 1, "atan2 takes 2 values, here it has 1"),
    ("=sin(1, 2)", 1, "sin takes 1 value, here it has 2"),
    ("=min(1)", 1, "min takes at least 2 values, here it has 1"),
    (
        "=r+2",
        2,
        "a length [m] and a plain number can't be added (a number gets a unit as in 2 m)",
    ),
    (
        "=r-mass",
        2,
        "a length [m] and a mass [kg] can't be subtracted",
    ),
    (
        "=phi+1",
        4,
        "an angle [rad] and a plain number can't be added (a number gets a unit as in 2 rad)",
    ),
    (
        "=omega+1 Hz",
        6,
        "an angular velocity [rad/s] and a frequency [Hz] can't be added",
    ),
    (
        "=max(r, n)",
        1,
        "a length [m] and a plain number can't be compared (a number gets a unit as in 2 m)",
    ),
    ("=1/(n-4)", 2, "this divides by zero"),
    ("=0^-1", 2, "this divides by zero"),
    ("=sqrt(-n)", 1, "a negative number has no square root"),
    (
        "=(-2)^0.5",
        5,
        "a negative number has no power that is not whole",
    ),
    (
        "=r^0.123",
        2,
        "the exponent of a length [m] must be whole or a simple fraction (as in ^2, ^0.5 or ^(1/3))",
    ),
    ("=2^r", 2, "an exponent is a plain number, not a length [m]"),
    ("=r^1000", 2, "the power of a unit gets too high"),
    ("=10^400", 3, "the result is too large for a double"),
    ("=1e999", 1, "the number is too large for a double"),
    ("=2^2^2^2^2^2^2", 6, "the result is too large for a double"),
    ("=ln(0)", 1, "ln takes numbers greater than zero"),
    (
        "=ln(r)",
        1,
        "ln takes a plain number, not a length [m] (divide it by 1 m)",
    ),
    (
        "=acos(1.5)",
        1,
        "acos takes numbers from -1 to 1, this is 1.5",
    ),
    ("=sin(r)", 1, "sin takes an angle, not a length [m]"),
    (
        "=sin(30)",
        1,
        "sin of a plain number, although the file's angles are not in radians (give it a unit, as in 30 deg or 0.5 rad)",
    ),
    (
        "=atan2(r, 1)",
        1,
        "a length [m] and a plain number can't be the components of one vector (a number gets a unit as in 2 m)",
    ),
];

#[test]
fn what_does_not_go_is_told_where_and_why() {
    for &(text, at, words) in FAULTS {
        let misfit = evaluate(text).expect_err(text);
        let hint = misfit
            .fault
            .hint
            .map(|hint| format!(" ({hint})"))
            .unwrap_or_default();
        assert_eq!(
            (
                misfit.at,
                format!("{}{hint}", misfit.fault.message).as_str()
            ),
            (at, words),
            "{text}"
        );
    }
}

#[test]
fn nothing_hostile_hangs_or_overflows() {
    let deep = |open: &str, close: &str, count: usize| {
        format!("={}1{}", open.repeat(count), close.repeat(count))
    };
    for text in [
        deep("(", ")", 500_000),
        "=".to_owned() + &"(".repeat(1_000_000),
        "=".to_owned() + &"1+".repeat(1_000_000),
    ] {
        assert_eq!(
            evaluate(&text).expect_err("long").fault.message,
            "an expression has at most 4096 characters"
        );
    }
    for text in [
        deep("(", ")", 2000),
        deep("abs(", ")", 500),
        deep("2^", "", 2000),
        deep("min(1,", ")", 500),
        deep("(-", ")", 1000),
    ] {
        assert_eq!(
            evaluate(&text).expect_err("deep").fault.message,
            "nested more than 64 deep"
        );
    }
    assert_eq!(
        evaluate(&deep("-", "", 4000)).map(|found| found.value),
        Ok(1.0)
    );
    assert_eq!(
        evaluate(&format!("=1{}", "+1".repeat(2000))).map(|found| found.value),
        Ok(2001.0)
    );
    assert_eq!(
        evaluate(&deep("(", ")", 64)).map(|found| found.value),
        Ok(1.0)
    );
}
