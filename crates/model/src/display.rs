//! Numbers as messages say them: in the units of the file, with six significant digits at most.
//!
//! ```text
//! angles     117.512°               "angle": "deg"        2.05097 rad (117.512°)    radians
//! others     3.12 mm, 0.221 s       number and unit
//! ```

/// Significant digits of a number in a message, at most.
pub const DIGITS: usize = 6;

/// A unit: its symbol, and its size in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    /// Its symbol.
    pub symbol: String,
    /// Its size in SI.
    pub size: f64,
}

impl Shown {
    /// A unit that is `size` SI units.
    pub fn new(symbol: impl Into<String>, size: f64) -> Self {
        Shown {
            symbol: symbol.into(),
            size,
        }
    }

    fn number(&self, value: f64, digits: usize) -> String {
        let value = value / self.size;
        let rounded = format!("{value:.*e}", digits.saturating_sub(1))
            .parse()
            .ok();
        // The largest numbers have none with so few digits above them.
        let rounded = rounded
            .filter(|rounded: &f64| rounded.is_finite())
            .unwrap_or(value);
        number(rounded, digits)
    }

    fn text(&self, value: f64, digits: usize) -> String {
        let gap = if self.symbol == "°" { "" } else { " " };
        format!("{}{gap}{}", self.number(value, digits), self.symbol)
    }
}

/// The units in which messages speak of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct DisplayUnits {
    /// Of lengths.
    pub length: Shown,
    /// Of angles.
    pub angle: Shown,
    /// Of masses.
    pub mass: Shown,
    /// Of times.
    pub time: Shown,
}

impl Default for DisplayUnits {
    /// SI.
    fn default() -> Self {
        let [length, angle, mass, time] =
            ["m", "rad", "kg", "s"].map(|symbol| Shown::new(symbol, 1.0));
        DisplayUnits {
            length,
            angle,
            mass,
            time,
        }
    }
}

impl DisplayUnits {
    /// A length \[m\].
    pub fn length(&self, value: f64) -> String {
        self.length.text(value, DIGITS)
    }

    /// A length \[m\] that is known to fewer digits.
    pub fn length_to(&self, value: f64, digits: usize) -> String {
        self.length.text(value, digits)
    }

    /// An angle \[rad\]; radians with degrees behind them.
    pub fn angle(&self, value: f64) -> String {
        self.angle_to(value, DIGITS)
    }

    /// An angle \[rad\] that is known to fewer digits.
    pub fn angle_to(&self, value: f64, digits: usize) -> String {
        match self.angle.symbol.as_str() {
            "rad" => format!(
                "{} ({}°)",
                self.angle.text(value, digits),
                number(value.to_degrees(), digits)
            ),
            _ => self.angle.text(value, digits),
        }
    }

    /// A mass \[kg\].
    pub fn mass_to(&self, value: f64, digits: usize) -> String {
        self.mass.text(value, digits)
    }

    /// A time \[s\].
    pub fn time(&self, value: f64) -> String {
        self.time.text(value, DIGITS)
    }

    /// Two times \[s\]: `1.7 to 2 s`.
    pub fn times(&self, from: f64, to: f64) -> String {
        format!("{} to {}", self.time.number(from, DIGITS), self.time(to))
    }

    /// A time \[s\] that is known to fewer digits.
    pub fn time_to(&self, value: f64, digits: usize) -> String {
        self.time.text(value, digits)
    }
}

/// A number with `digits` significant digits, trailing zeros dropped: `0.1235`, `12.3`, `1.5e-9`.
pub fn number(value: f64, digits: usize) -> String {
    if value.is_infinite() {
        return format!("more than {}", number(f64::MAX.copysign(value), digits));
    }
    if value.is_nan() {
        return "–".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return scientific;
    };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-4..7).contains(&exponent) {
        return format!("{}e{exponent}", trim(mantissa));
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    trim(&format!("{value:.decimals$}")).to_string()
}

/// Without trailing zeros behind a decimal point.
fn trim(number: &str) -> &str {
    if number.contains('.') {
        number.trim_end_matches('0').trim_end_matches('.')
    } else {
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_asked_for() {
        for (value, text) in [
            (0.0, "0"),
            (2.0, "2"),
            (117.512_206_5, "117.5"),
            (0.123_456, "0.1235"),
            (-12_345.6, "-12346"),
            (999.96, "1000"),
            (1.5e-9, "1.5e-9"),
            (1.0e7, "1e7"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(number(value, 4), text);
        }
    }

    #[test]
    fn quantities_are_told_in_the_units_of_the_file() {
        let si = DisplayUnits::default();
        let angle = 117.512_206_5_f64.to_radians();
        assert_eq!(
            [si.length(0.003_12), si.angle(angle), si.time(1e300)],
            ["0.00312 m", "2.05097 rad (117.512°)", "1e300 s"]
        );
        let units = DisplayUnits {
            length: Shown::new("mm", 1e-3),
            angle: Shown::new("°", 1f64.to_radians()),
            mass: Shown::new("g", 1e-3),
            time: Shown::new("ms", 1e-3),
        };
        let told = [
            units.length(0.003_12),
            units.angle(angle),
            units.mass_to(0.8, 4),
            units.time(0.221),
        ];
        assert_eq!(told, ["3.12 mm", "117.512°", "800 g", "221 ms"]);
        assert_eq!(units.times(1.7, 2.0), "1700 to 2000 ms");
        assert_eq!(
            [units.length_to(1.0 / 3.0, 2), units.time_to(1e-9 / 3.0, 2)],
            ["330 mm", "3.3e-7 ms"]
        );
    }
}
