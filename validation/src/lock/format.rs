//! Numbers and intervals as text for people.

/// Intervals printed per run; the rest is counted (all of them are in `intervals.csv`).
const MOST_INTERVALS: usize = 6;

/// Four significant digits.
pub fn short(value: f64) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let size = value.abs();
    if size == 0.0 {
        "0".into()
    } else if (1e-4..1e6).contains(&size) {
        let decimals = 3 - size.log10().floor() as i32;
        format!("{value:.*}", decimals.max(0) as usize)
    } else {
        format!("{value:.2e}")
    }
}

/// `117.5`, or `117.5…118` \[deg\].
fn interval([low, high]: [f64; 2]) -> String {
    // Outputs are multiples of a hundredth of a degree.
    let degrees = |x: f64| format!("{}", (x * 100.0).round() / 100.0);
    if low == high {
        degrees(low)
    } else {
        format!("{}…{}", degrees(low), degrees(high))
    }
}

/// Intervals in a line.
pub fn list(intervals: &[[f64; 2]]) -> String {
    if intervals.is_empty() {
        return "none".into();
    }
    let shown: Vec<String> = intervals
        .iter()
        .take(MOST_INTERVALS)
        .map(|&i| interval(i))
        .collect();
    let more = intervals.len().saturating_sub(MOST_INTERVALS);
    let rest = if more > 0 {
        format!(", and {more} more")
    } else {
        String::new()
    };
    format!("{}°{rest}", shown.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits() {
        for (value, text) in [
            (0.0184, "0.01840"),
            (61080.4, "61080"),
            (2.5e-7, "2.50e-7"),
            (1.5, "1.500"),
            (5e8, "5.00e8"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(short(value), text);
        }
    }

    #[test]
    fn long_lists_are_cut() {
        assert_eq!(list(&[]), "none");
        assert_eq!(list(&[[1.0, 1.0], [2.0, 2.499_999_999]]), "1, 2…2.5°");
        assert!(list(&[[1.0, 1.0]; 9]).ends_with("and 3 more"));
    }
}
