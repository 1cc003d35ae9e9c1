//! Numbers of the options of figures, each with its limits.

use linkdyn_picture::Mark;

/// `A:B`, ascending.
pub fn range(text: &str) -> Result<[f64; 2], String> {
    let numbers = text
        .split_once(':')
        .map(|(a, b)| (a.trim().parse::<f64>(), b.trim().parse::<f64>()));
    match numbers {
        Some((Ok(low), Ok(high))) if low.is_finite() && high.is_finite() && low < high => {
            Ok([low, high])
        }
        Some((Ok(_), Ok(_))) => Err("the first number must be less than the second".into()),
        Some(_) | None => Err("two numbers are wanted, such as -50:125".into()),
    }
}

/// `X`, or `X=TEXT`.
pub fn mark(text: &str) -> Result<Mark, String> {
    let (x, label) = text.split_once('=').unwrap_or((text, ""));
    let x = x.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    let x =
        x.ok_or("a number is wanted, with or without a text, such as 117.5=\"change point\"")?;
    Ok(Mark {
        x,
        label: label.to_string(),
    })
}

/// A number within limits.
pub fn number_within(text: &str, [low, high]: [f64; 2]) -> Result<f64, String> {
    let value = text
        .trim()
        .parse::<f64>()
        .ok()
        .filter(|value| (low..=high).contains(value));
    value.ok_or_else(|| format!("a number from {low} to {high} is wanted"))
}

/// A side of a figure \[mm\].
pub fn millimetres(text: &str) -> Result<f64, String> {
    number_within(text, [20.0, 2000.0])
}

/// Both sides of a figure, `WxH` \[mm\].
pub fn size(text: &str) -> Result<[f64; 2], String> {
    let sides = text
        .split_once(['x', 'X', '×'])
        .ok_or("width x height is wanted, such as 88x60")?;
    Ok([millimetres(sides.0)?, millimetres(sides.1)?])
}

/// Size of letters \[pt\].
pub fn points(text: &str) -> Result<f64, String> {
    number_within(text, [3.0, 72.0])
}

/// Width of lines \[pt\].
pub fn line_width(text: &str) -> Result<f64, String> {
    number_within(text, [0.1, 20.0])
}

/// Resolution of a PNG [dots per inch].
pub fn dpi(text: &str) -> Result<f64, String> {
    number_within(text, [36.0, 2400.0])
}
