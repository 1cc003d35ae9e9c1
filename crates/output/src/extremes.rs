//! Smallest and largest values of columns.

/// Smallest and largest value of a column over its non-empty cells, each with its first instant \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremes {
    /// Smallest value.
    pub min: f64,
    /// Its time \[s\].
    pub min_time: f64,
    /// Largest value.
    pub max: f64,
    /// Its time \[s\].
    pub max_time: f64,
}

impl Extremes {
    /// Takes a value for an extreme where it is one.
    pub(super) fn note(extremes: &mut Option<Extremes>, value: f64, time: f64) {
        if !value.is_finite() {
            return;
        }
        match extremes {
            None => {
                *extremes = Some(Extremes {
                    min: value,
                    min_time: time,
                    max: value,
                    max_time: time,
                })
            }
            Some(known) if value < known.min => (known.min, known.min_time) = (value, time),
            Some(known) if value > known.max => (known.max, known.max_time) = (value, time),
            Some(_) => {}
        }
    }
}
