//! The numbers of a page as compact text: base64 (RFC 4648) of little-endian floats; what is no number, or has none so large, is a NaN.

use std::io::{self, Write};

use data_encoding::BASE64;

/// Bytes whose text stands for itself.
const GROUP: usize = 3;

/// Numbers on their way into a page.
#[derive(Debug)]
pub struct Numbers {
    binary64: bool,
    bytes: Vec<u8>,
}

impl Numbers {
    /// None yet; each of 16 digits, or of 7.
    pub fn new(binary64: bool) -> Self {
        Numbers {
            binary64,
            bytes: Vec::new(),
        }
    }

    /// One more.
    pub fn push(&mut self, value: f64) {
        let narrow = value as f32;
        match self.binary64 {
            true if value.is_finite() => self.bytes.extend(value.to_le_bytes()),
            true => self.bytes.extend(f64::NAN.to_le_bytes()),
            false if narrow.is_finite() => self.bytes.extend(narrow.to_le_bytes()),
            false => self.bytes.extend(f32::NAN.to_le_bytes()),
        }
    }

    /// Several more.
    pub fn extend(&mut self, values: impl IntoIterator<Item = f64>) {
        values.into_iter().for_each(|value| self.push(value));
    }

    /// Hands on the text of those so far, but for the bytes of a group that is not whole yet.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn hand_on(&mut self, out: &mut impl Write) -> io::Result<()> {
        let whole = self.bytes.len() / GROUP * GROUP;
        let bytes = self.bytes.drain(..whole);
        out.write_all(BASE64.encode(bytes.as_slice()).as_bytes())
    }

    /// The text of all.
    pub fn text(&self) -> String {
        BASE64.encode(&self.bytes)
    }
}

/// All numbers below `count`, or so many of them, evenly spread, both ends included.
pub fn evenly(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    let last = most.saturating_sub(1).max(1);
    (0..=last).map(|k| k * (count - 1) / last).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_a_nan() {
        let mut numbers = Numbers::new(false);
        // 1e300 has no binary32.
        numbers.extend([1.0, f64::INFINITY, 1e300]);
        let expected = [1.0, f32::NAN, f32::NAN].map(f32::to_le_bytes).concat();
        assert_eq!(numbers.text(), BASE64.encode(&expected));
    }

    #[test]
    fn what_is_handed_on_piece_by_piece_is_the_same_text() {
        let [mut pieces, mut whole] = [Numbers::new(false), Numbers::new(false)];
        let mut text = Vec::new();
        for value in [1.0, -2.5, 1e-7, 3.0, f64::NAN] {
            pieces.push(value);
            pieces.hand_on(&mut text).expect("memory takes it");
            whole.push(value);
        }
        text.extend(pieces.text().bytes());
        assert_eq!(text, whole.text().into_bytes());
    }

    #[test]
    fn ends_are_among_those_that_are_chosen() {
        assert_eq!(evenly(5, 3), [0, 2, 4]);
        assert_eq!(evenly(2, 3), [0, 1]);
        assert_eq!(evenly(9, 1), [0, 8]);
    }
}
