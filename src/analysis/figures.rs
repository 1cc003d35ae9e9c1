//! Numbers in messages: six digits at most, which is what anybody reads.

use crate::element::Measure;

/// Digits that count.
const DIGITS: i32 = 6;

/// A number with at most six digits that count, without zeros behind them.
pub fn number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{}", x + 0.0);
    }
    let power = x.abs().log10().floor() as i32;
    let text = if (-4..DIGITS).contains(&power) {
        format!("{x:.*}", (DIGITS - 1 - power).max(0) as usize)
    } else {
        let text = format!("{x:.*e}", (DIGITS - 1) as usize);
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", trimmed(digits));
    };
    trimmed(&text).to_string()
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

/// A time [s].
pub fn time(t: f64) -> String {
    format!("t = {} s", number(t))
}

/// The value of a driver or coordinate [rad or m].
pub fn value(measure: Measure, x: f64) -> String {
    match measure {
        // An angle this small is round-off of a whole turn.
        Measure::Angle if x.abs() < 1e-12 => "0 rad (0°)".into(),
        Measure::Angle => format!("{} rad ({}°)", number(x), number(x.to_degrees())),
        Measure::Length => format!("{} m", number(x)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_count() {
        for (x, text) in [
            (0.494_952_985_523_115_1, "0.494953"),
            (-0.125_439_957, "-0.12544"),
            (132.743_309_602, "132.743"),
            (1e-9, "1e-9"),
            (1_234_567.0, "1.23457e6"),
            (999_999.7, "1000000"),
            (0.5, "0.5"),
            (-0.0, "0"),
            (2000.0, "2000"),
        ] {
            assert_eq!(number(x), text);
        }
    }
}
