//! Every symbol of a unit, and the names of units that are written out.
//!
//! Definitions: SI brochure (2019); inch, pound, standard gravity: NIST SP 811 (2008), all exact.

use crate::dimension::{Powers, powers};

/// Symbol, num, den, ten, pi, exponents.
pub type Row = (&'static str, f64, f64, i32, i32, Powers);

const LENGTH: Powers = powers(1, 0, 0, 0);
const MASS: Powers = powers(0, 1, 0, 0);
const TIME: Powers = powers(0, 0, 1, 0);
const ANGLE: Powers = powers(0, 0, 0, 1);
const FORCE: Powers = powers(1, 1, -2, 0);
const TORQUE: Powers = powers(2, 1, -2, 0);
const POWER: Powers = powers(2, 1, -3, 0);
const STRESS: Powers = powers(-1, 1, -2, 0);
const RATE: Powers = powers(0, 0, -1, 0);

/// Pound-force: 0.45359237 kg · 9.80665 m/s² = 4.4482216152605 N.
const LBF: f64 = 44_482_216_152_605.0;

/// Every symbol. `g` is the gram; standard gravity has none.
pub const SYMBOLS: [Row; 61] = [
    ("m", 1.0, 1.0, 0, 0, LENGTH),
    ("km", 1.0, 1.0, 3, 0, LENGTH),
    ("dm", 1.0, 1.0, -1, 0, LENGTH),
    ("cm", 1.0, 1.0, -2, 0, LENGTH),
    ("mm", 1.0, 1.0, -3, 0, LENGTH),
    ("um", 1.0, 1.0, -6, 0, LENGTH),
    ("µm", 1.0, 1.0, -6, 0, LENGTH),
    ("μm", 1.0, 1.0, -6, 0, LENGTH),
    ("nm", 1.0, 1.0, -9, 0, LENGTH),
    ("in", 254.0, 1.0, -4, 0, LENGTH),
    ("ft", 3048.0, 1.0, -4, 0, LENGTH),
    ("rad", 1.0, 1.0, 0, 0, ANGLE),
    ("mrad", 1.0, 1.0, -3, 0, ANGLE),
    ("deg", 1.0, 180.0, 0, 1, ANGLE),
    ("°", 1.0, 180.0, 0, 1, ANGLE),
    ("rev", 2.0, 1.0, 0, 1, ANGLE),
    ("turn", 2.0, 1.0, 0, 1, ANGLE),
    ("kg", 1.0, 1.0, 0, 0, MASS),
    ("g", 1.0, 1.0, -3, 0, MASS),
    ("mg", 1.0, 1.0, -6, 0, MASS),
    ("t", 1.0, 1.0, 3, 0, MASS),
    ("lb", 45_359_237.0, 1.0, -8, 0, MASS),
    ("lbm", 45_359_237.0, 1.0, -8, 0, MASS),
    ("slug", LBF, 3048.0, -9, 0, MASS),
    ("s", 1.0, 1.0, 0, 0, TIME),
    ("ms", 1.0, 1.0, -3, 0, TIME),
    ("us", 1.0, 1.0, -6, 0, TIME),
    ("µs", 1.0, 1.0, -6, 0, TIME),
    ("μs", 1.0, 1.0, -6, 0, TIME),
    ("min", 60.0, 1.0, 0, 0, TIME),
    ("h", 3600.0, 1.0, 0, 0, TIME),
    ("N", 1.0, 1.0, 0, 0, FORCE),
    ("mN", 1.0, 1.0, -3, 0, FORCE),
    ("daN", 1.0, 1.0, 1, 0, FORCE),
    ("kN", 1.0, 1.0, 3, 0, FORCE),
    ("MN", 1.0, 1.0, 6, 0, FORCE),
    ("lbf", LBF, 1.0, -13, 0, FORCE),
    ("kgf", 980_665.0, 1.0, -5, 0, FORCE),
    ("kp", 980_665.0, 1.0, -5, 0, FORCE),
    ("Nm", 1.0, 1.0, 0, 0, TORQUE),
    ("Nmm", 1.0, 1.0, -3, 0, TORQUE),
    ("Ncm", 1.0, 1.0, -2, 0, TORQUE),
    ("mNm", 1.0, 1.0, -3, 0, TORQUE),
    ("kNm", 1.0, 1.0, 3, 0, TORQUE),
    ("J", 1.0, 1.0, 0, 0, TORQUE),
    ("mJ", 1.0, 1.0, -3, 0, TORQUE),
    ("kJ", 1.0, 1.0, 3, 0, TORQUE),
    ("W", 1.0, 1.0, 0, 0, POWER),
    ("mW", 1.0, 1.0, -3, 0, POWER),
    ("kW", 1.0, 1.0, 3, 0, POWER),
    ("Pa", 1.0, 1.0, 0, 0, STRESS),
    ("hPa", 1.0, 1.0, 2, 0, STRESS),
    ("kPa", 1.0, 1.0, 3, 0, STRESS),
    ("MPa", 1.0, 1.0, 6, 0, STRESS),
    ("GPa", 1.0, 1.0, 9, 0, STRESS),
    ("bar", 1.0, 1.0, 5, 0, STRESS),
    ("psi", LBF, 64_516.0, -5, 0, STRESS),
    ("ksi", LBF, 64_516.0, -2, 0, STRESS),
    ("Hz", 1.0, 1.0, 0, 0, RATE),
    ("kHz", 1.0, 1.0, 3, 0, RATE),
    ("rpm", 1.0, 30.0, 0, 1, powers(0, 0, -1, 1)),
];

/// Names of units that are written out, and the symbols that are meant; a plural s is left out.
const NAMES: [(&str, &str); 33] = [
    ("meter", "m"),
    ("metre", "m"),
    ("millimeter", "mm"),
    ("millimetre", "mm"),
    ("centimeter", "cm"),
    ("centimetre", "cm"),
    ("kilometer", "km"),
    ("kilometre", "km"),
    ("micrometer", "um"),
    ("micrometre", "um"),
    ("micron", "um"),
    ("inch", "in"),
    ("inche", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("radian", "rad"),
    ("degree", "deg"),
    ("revolution", "rev"),
    ("kilogram", "kg"),
    ("gram", "g"),
    ("ton", "t"),
    ("tonne", "t"),
    ("pound", "lb"),
    ("sec", "s"),
    ("second", "s"),
    ("minute", "min"),
    ("hour", "h"),
    ("newton", "N"),
    ("joule", "J"),
    ("watt", "W"),
    ("pascal", "Pa"),
    ("hertz", "Hz"),
    ("lb", "lb"),
];

/// The symbol of a unit that is written out, or the one most like this one.
pub fn nearest(symbol: &str) -> Option<&'static str> {
    let lower = symbol.to_lowercase();
    let singular = lower.strip_suffix('s').unwrap_or(&lower);
    if let Some((_, meant)) = NAMES
        .iter()
        .find(|(name, _)| *name == lower || *name == singular)
    {
        return Some(meant);
    }
    crate::suggest::nearest(symbol, SYMBOLS.iter().map(|row| row.0))
}
