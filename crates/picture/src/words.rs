//! Names and units as printed: no character of a name may break a file, turn the direction of writing, or fill the page.

/// Longest text that goes into a figure; layout cuts it further to the room that there is in characters.
const LONGEST: usize = 300;

/// `text` as it may be printed: control, direction-changing and forbidden characters replaced, long ones cut.
pub fn printable(text: &str) -> String {
    let is_trick = |c: char| {
        c.is_control()
            || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
            // XML knows no such characters.
            || matches!(c, '\u{fffe}' | '\u{ffff}')
    };
    let mut printable: String = text
        .chars()
        .take(LONGEST)
        .map(|c| if is_trick(c) { '\u{fffd}' } else { c })
        .collect();
    if text.chars().nth(LONGEST).is_some() {
        printable.push('…');
    }
    printable
}

/// A unit as people write it: `N·m`, `rad/s²`, `°`, `µm`.
pub fn unit(unit: &str) -> String {
    let text = unit.replace('*', "·").replace("^2", "²").replace("^3", "³");
    let mut written = String::with_capacity(text.len());
    let mut word = String::new();
    for c in text.chars().chain(['\n']) {
        if c.is_alphabetic() {
            word.push(c);
            continue;
        }
        written += match word.as_str() {
            "deg" => "°",
            "um" | "μm" => "µm",
            "us" | "μs" => "µs",
            other => other,
        };
        word.clear();
        written.push(c);
    }
    printable(written.trim_end_matches('\n'))
}

/// Three digits with a unit, in thousands or millions of it where there are many: `1.25 kN`.
pub fn quantity(value: f64, of: &str) -> String {
    let size = value.abs();
    let (part, prefix) = match size {
        size if size >= 1e6 => (1e-6, "M"),
        size if size >= 1e3 => (1e-3, "k"),
        _ => (1.0, ""),
    };
    if value == 0.0 {
        return format!("0 {}", unit(of));
    }
    let shown = value * part;
    let number = if !(1e-3..1e9).contains(&size) {
        return minus(&format!("{value:.2e} {}", unit(of)));
    } else {
        let order = shown.abs().max(1e-3).log10().floor();
        format!("{shown:.*}", (2.0 - order).clamp(0.0, 5.0) as usize)
    };
    minus(&format!("{number} {prefix}{}", unit(of)))
}

/// A number with a real minus.
pub fn minus(number: &str) -> String {
    number.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_written_as_people_do() {
        for (unit_text, written) in [
            ("N*m", "N·m"),
            ("rad/s^2", "rad/s²"),
            ("deg", "°"),
            ("deg/s", "°/s"),
            ("um", "µm"),
            ("kg*m^2", "kg·m²"),
            ("", ""),
        ] {
            assert_eq!(unit(unit_text), written);
        }
    }

    #[test]
    fn quantities_have_three_digits() {
        for (value, of, written) in [
            (1250.0, "N", "1.25 kN"),
            (76129.0, "N", "76.1 kN"),
            (-2e6, "N*m", "−2.00 MN·m"),
            (30.0, "N", "30.0 N"),
            (0.0123, "N", "0.0123 N"),
            (5e-7, "N", "5.00e−7 N"),
            (0.0, "N", "0 N"),
        ] {
            assert_eq!(quantity(value, of), written);
        }
    }

    #[test]
    fn tricks_are_replaced() {
        assert_eq!(
            printable("a\u{1b}[31m\u{202e}b\u{ffff}\u{0}"),
            "a\u{fffd}[31m\u{fffd}b\u{fffd}\u{fffd}"
        );
        assert_eq!(printable("</script>\"&'🔒"), "</script>\"&'🔒");
        assert_eq!(printable(&"x".repeat(1000)).chars().count(), LONGEST + 1);
    }
}
