//! Tables of ISO 286-1:2010: standard tolerances and fundamental deviations up to 500 mm \[µm\].

use std::collections::HashMap;
use std::sync::LazyLock;

/// Coarsest grade in which holes from K to N have Δ.
pub const DELTAS_TO: u32 = 8;

/// The rows of the table by their names, those of grades and of letters.
static ROWS: LazyLock<HashMap<&str, Vec<f64>>> = LazyLock::new(|| {
    let rows = include_str!("table.txt")
        .lines()
        .filter(|row| !row.starts_with('#'));
    let rows = rows.filter_map(|row| row.split_once(' '));
    let numbers = |text: &str| {
        text.split_whitespace()
            .filter_map(|cell| cell.parse().ok())
            .collect()
    };
    rows.map(|(name, cells)| (name, numbers(cells))).collect()
});

/// Where the field of a letter is, seen from the shaft.
#[derive(Debug, Clone, Copy)]
pub enum Deviation {
    /// The upper deviation of the shaft is below zero.
    Below,
    /// Half to either side.
    Middle,
    /// The lower deviation of the shaft is above zero.
    Above,
}

impl Deviation {
    /// All letters, small.
    pub const ALL: [(&'static str, Deviation); 13] = [
        ("a", Deviation::Below),
        ("b", Deviation::Below),
        ("c", Deviation::Below),
        ("d", Deviation::Below),
        ("e", Deviation::Below),
        ("f", Deviation::Below),
        ("g", Deviation::Below),
        ("h", Deviation::Below),
        ("js", Deviation::Middle),
        ("k", Deviation::Above),
        ("m", Deviation::Above),
        ("n", Deviation::Above),
        ("p", Deviation::Above),
    ];
}

/// The ranges of a nominal size.
#[derive(Debug, Clone, Copy)]
pub struct Sizes {
    main: usize,
    fine: usize,
}

impl Sizes {
    /// Of a size \[mm\] within the tables.
    pub fn of(nominal: f64) -> Sizes {
        let range = |ends: &str| {
            let ends = &ROWS[ends];
            let beyond = ends.partition_point(|end| *end < nominal);
            beyond.min(ends.len() - 1)
        };
        Sizes {
            main: range("main"),
            fine: range("fine"),
        }
    }

    /// The standard tolerance of a grade, where there is one.
    pub fn grade(self, grade: u32) -> Option<f64> {
        let row = ROWS.get(format!("IT{grade}").as_str())?;
        Some(row[self.main])
    }

    /// How far the field of a letter is from zero.
    pub fn distance(self, letter: &str) -> f64 {
        let place = match letter {
            "a" | "b" | "c" => self.fine,
            _ => self.main,
        };
        ROWS.get(letter).map_or(0.0, |row| row[place])
    }

    /// Whether it is up to 3 mm, where holes have no Δ.
    pub fn is_smallest(self) -> bool {
        self.main == 0
    }

    /// Whether ES of M6 is −9 µm and not −11: above 250 up to 315 mm.
    pub fn is_m6_exception(self, grade: u32) -> bool {
        self.main == 10 && grade == 6
    }
}
