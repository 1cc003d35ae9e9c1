//! Number and unit of a text.

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
