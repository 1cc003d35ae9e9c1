//! Units: a small reader of unit texts such as `kg*mm^2` or `N*m/(rad/s)`.
//!
//! A unit is kept as num/den · 10^ten · π^pi, with num and den whole where the definition is exact, so that
//! `"410 mm"` is the double nearest to 0.41 and not two roundings away from it.
//! Definitions: SI brochure (2019); inch, pound, standard gravity: NIST SP 811 (2008), all exact.

use std::f64::consts::PI;

use super::dimension::{Powers, powers};

/// A unit: num/den · 10^ten · π^pi in SI, and its exponents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    pub powers: Powers,
    num: f64,
    den: f64,
    ten: i32,
    pi: i32,
}

/// What is wrong with a unit text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum UnitFault {
    /// There is none.
    Missing,
    /// No unit has this symbol; the nearest that one has.
    Unknown {
        symbol: String,
        nearest: Option<&'static str>,
    },
    /// Neither a product, a quotient nor a power of units.
    Malformed,
    /// Too many factors or too high a power.
    TooLarge,
}

/// Symbol, num, den, ten, pi, exponents.
type Row = (&'static str, f64, f64, i32, i32, Powers);

const LENGTH: Powers = powers(1, 0, 0, 0);
const MASS: Powers = powers(0, 1, 0, 0);
const TIME: Powers = powers(0, 0, 1, 0);
const ANGLE: Powers = powers(0, 0, 0, 1);
const FORCE: Powers = powers(1, 1, -2, 0);
const TORQUE: Powers = powers(2, 1, -2, 0);
const STRESS: Powers = powers(-1, 1, -2, 0);
const RATE: Powers = powers(0, 0, -1, 0);

/// Pound-force: 0.45359237 kg · 9.80665 m/s² = 4.4482216152605 N.
const LBF: f64 = 44_482_216_152_605.0;

/// Every symbol. `g` is the gram; standard gravity has none.
const SYMBOLS: [Row; 58] = [
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
const NAMES: [(&str, &str); 32] = [
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
    ("pascal", "Pa"),
    ("hertz", "Hz"),
    ("lb", "lb"),
];

/// Highest power, number of factors and depth of brackets that a unit text may have.
const MOST: i32 = 12;

impl Unit {
    const ONE: Unit = Unit {
        powers: powers(0, 0, 0, 0),
        num: 1.0,
        den: 1.0,
        ten: 0,
        pi: 0,
    };

    /// Reads a unit text.
    ///
    /// # Errors
    /// A symbol is unknown, or the text is no product, quotient or power of symbols.
    pub fn parse(text: &str) -> Result<Unit, UnitFault> {
        let mut reader = Reader {
            rest: text.trim(),
            factors: 0,
        };
        if reader.rest.is_empty() {
            return Err(UnitFault::Missing);
        }
        let unit = reader.product(0)?;
        if !reader.rest.is_empty() {
            return Err(UnitFault::Malformed);
        }
        let factor = unit.factor();
        if factor.is_finite() && factor > 0.0 {
            Ok(unit)
        } else {
            Err(UnitFault::TooLarge)
        }
    }

    /// The SI unit of a dimension.
    pub fn si(powers: Powers) -> Unit {
        Unit {
            powers,
            ..Unit::ONE
        }
    }

    /// The same unit, per second^order.
    pub fn per_second(self, order: i32) -> Unit {
        Unit {
            powers: self.powers.per_second(order),
            ..self
        }
    }

    /// A decimal number of this unit, in SI: rounded once where the factor is a power of ten.
    pub fn to_si(self, number: &str) -> f64 {
        let plain: f64 = number.parse().unwrap_or(f64::NAN);
        if self.pi != 0 {
            return plain * self.factor();
        }
        if self.num == 1.0 && self.den == 1.0 {
            return shifted(number, self.ten).unwrap_or(plain * self.factor());
        }
        // whole numbers times whole factors are exact, and so are powers of ten up to 10²²
        match self.ten {
            -22..0 => plain * self.num / (self.den * 10f64.powi(-self.ten)),
            0..=22 => plain * self.num * 10f64.powi(self.ten) / self.den,
            _ => plain * self.factor(),
        }
    }

    /// A number of this unit in another one of the same dimension; none where that is not so.
    pub fn convert(self, number: f64, to: Unit) -> Option<f64> {
        (self.powers == to.powers).then(|| number * (self.factor() / to.factor()))
    }

    fn factor(self) -> f64 {
        let scale: f64 = format!("1e{}", self.ten).parse().unwrap_or(f64::NAN);
        match self.pi {
            0 => self.num / self.den * scale,
            1 => PI * self.num / self.den * scale,
            -1 => self.num / (self.den * PI) * scale,
            pi => self.num / self.den * PI.powi(pi) * scale,
        }
    }

    fn times(self, other: Unit, power: i32) -> Unit {
        let (num, den) = if power < 0 {
            (other.den, other.num)
        } else {
            (other.num, other.den)
        };
        let count = power.abs();
        let mut unit = Unit {
            powers: Powers {
                length: self.powers.length + power * other.powers.length,
                mass: self.powers.mass + power * other.powers.mass,
                time: self.powers.time + power * other.powers.time,
                angle: self.powers.angle + power * other.powers.angle,
            },
            num: self.num * num.powi(count),
            den: self.den * den.powi(count),
            ten: self.ten + power * other.ten,
            pi: self.pi + power * other.pi,
        };
        // mm/mm, ft/ft and the like are plain again
        if unit.num == unit.den {
            (unit.num, unit.den) = (1.0, 1.0);
        }
        unit
    }
}

/// The decimal number with its point moved, rounded once.
fn shifted(number: &str, ten: i32) -> Option<f64> {
    let (mantissa, exponent) = match number.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (number, 0),
    };
    format!("{mantissa}e{}", exponent.checked_add(ten)?)
        .parse()
        .ok()
}

/// Splits `"5 mm"` into number and unit text, where it begins with a decimal number.
pub fn split_quantity(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let start = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let mut end = digits(start);
    let mut count = end - start;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits(end + 1);
        count += fraction - end - 1;
        end = fraction;
    }
    if count == 0 {
        return None;
    }
    // an exponent only where digits follow the `e`
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(sign);
        if exponent > sign {
            end = exponent;
        }
    }
    Some((&text[..end], text[end..].trim()))
}

/// The same text with a decimal point, where it begins with a number that has a decimal comma.
pub fn with_decimal_point(text: &str) -> Option<String> {
    let (number, rest) = split_quantity(text)?;
    let rest = rest
        .strip_prefix(',')
        .filter(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))?;
    let is_whole = !number.contains(['.', 'e', 'E']);
    is_whole.then(|| format!("{number}.{rest}"))
}

/// Reads products, quotients, powers and brackets.
struct Reader<'a> {
    rest: &'a str,
    factors: i32,
}

impl Reader<'_> {
    fn skip(&mut self, signs: &[char]) -> Option<char> {
        let sign = self
            .rest
            .chars()
            .next()
            .filter(|sign| signs.contains(sign))?;
        self.rest = self.rest[sign.len_utf8()..].trim_start();
        Some(sign)
    }

    fn product(&mut self, depth: i32) -> Result<Unit, UnitFault> {
        let mut unit = Unit::ONE.times(self.power(depth)?, 1);
        loop {
            let sign = match self.skip(&['*', '·', '⋅', '×', '/']) {
                Some('/') => -1,
                Some(_) => 1,
                // a blank is a product, as in "N m"
                None if self.rest.is_empty() || self.rest.starts_with(')') => return Ok(unit),
                None => 1,
            };
            unit = unit.times(self.power(depth)?, sign);
        }
    }

    fn power(&mut self, depth: i32) -> Result<Unit, UnitFault> {
        self.factors += 1;
        if self.factors > MOST || depth > MOST {
            return Err(UnitFault::TooLarge);
        }
        let base = if self.skip(&['(']).is_some() {
            let inner = self.product(depth + 1)?;
            self.skip(&[')']).ok_or(UnitFault::Malformed)?;
            inner
        } else {
            self.symbol()?
        };
        let power = self.exponent()?;
        if power.abs() > MOST {
            return Err(UnitFault::TooLarge);
        }
        Ok(Unit::ONE.times(base, power))
    }

    fn symbol(&mut self) -> Result<Unit, UnitFault> {
        if self.rest.starts_with('1') {
            self.skip(&['1']);
            return Ok(Unit::ONE);
        }
        let end = self
            .rest
            .find(|c: char| !(c.is_alphabetic() || "°%_'\"$".contains(c)))
            .unwrap_or(self.rest.len());
        let (symbol, rest) = self.rest.split_at(end);
        if symbol.is_empty() {
            return Err(UnitFault::Malformed);
        }
        let row = SYMBOLS.iter().find(|row| row.0 == symbol);
        let &(_, num, den, ten, pi, powers) = row.ok_or_else(|| UnitFault::Unknown {
            symbol: symbol.into(),
            nearest: nearest(symbol),
        })?;
        self.rest = rest.trim_start();
        Ok(Unit {
            powers,
            num,
            den,
            ten,
            pi,
        })
    }

    fn exponent(&mut self) -> Result<i32, UnitFault> {
        if self.skip(&['^']).is_none() {
            return Ok(match self.skip(&['²', '³']) {
                Some('²') => 2,
                Some(_) => 3,
                None => 1,
            });
        }
        let sign = if self.skip(&['-']).is_some() { -1 } else { 1 };
        let end = self
            .rest
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(self.rest.len());
        let (digits, rest) = self.rest.split_at(end);
        if digits.is_empty() {
            return Err(UnitFault::Malformed);
        }
        let power: i32 = digits.parse().map_err(|_| UnitFault::TooLarge)?;
        self.rest = rest.trim_start();
        Ok(sign * power)
    }
}

/// The symbol of a unit that is written out, or the one most like this one.
fn nearest(symbol: &str) -> Option<&'static str> {
    let lower = symbol.to_lowercase();
    let singular = lower.strip_suffix('s').unwrap_or(&lower);
    if let Some((_, meant)) = NAMES
        .iter()
        .find(|(name, _)| *name == lower || *name == singular)
    {
        return Some(meant);
    }
    super::suggest::nearest(symbol, SYMBOLS.iter().map(|row| row.0))
}

#[cfg(test)]
mod tests {
    use super::super::dimension::Dimension;
    use super::*;

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
}
