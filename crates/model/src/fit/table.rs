//! Tables of ISO 286-1:2010: standard tolerances and fundamental deviations up to 500 mm \[µm\].

/// Coarsest grade in which holes from K to N have Δ.
pub const DELTAS_TO: u32 = 8;

/// Upper ends of the ranges of sizes \[mm\], the lower end excluded.
const MAIN: [f64; 13] = [
    3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0, 315.0, 400.0, 500.0,
];

/// The finer ranges, in which a, b and c are given.
const FINE: [f64; 25] = [
    3.0, 6.0, 10.0, 14.0, 18.0, 24.0, 30.0, 40.0, 50.0, 65.0, 80.0, 100.0, 120.0, 140.0, 160.0,
    180.0, 200.0, 225.0, 250.0, 280.0, 315.0, 355.0, 400.0, 450.0, 500.0,
];

/// Standard tolerances IT1 … IT18, a row each (ISO 286-1:2010, table 1).
const GRADES: [[f64; 13]; 18] = [
    [
        0.8, 1.0, 1.0, 1.2, 1.5, 1.5, 2.0, 2.5, 3.5, 4.5, 6.0, 7.0, 8.0,
    ],
    [
        1.2, 1.5, 1.5, 2.0, 2.5, 2.5, 3.0, 4.0, 5.0, 7.0, 8.0, 9.0, 10.0,
    ],
    [
        2.0, 2.5, 2.5, 3.0, 4.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 13.0, 15.0,
    ],
    [
        3.0, 4.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0,
    ],
    [
        4.0, 5.0, 6.0, 8.0, 9.0, 11.0, 13.0, 15.0, 18.0, 20.0, 23.0, 25.0, 27.0,
    ],
    [
        6.0, 8.0, 9.0, 11.0, 13.0, 16.0, 19.0, 22.0, 25.0, 29.0, 32.0, 36.0, 40.0,
    ],
    [
        10.0, 12.0, 15.0, 18.0, 21.0, 25.0, 30.0, 35.0, 40.0, 46.0, 52.0, 57.0, 63.0,
    ],
    [
        14.0, 18.0, 22.0, 27.0, 33.0, 39.0, 46.0, 54.0, 63.0, 72.0, 81.0, 89.0, 97.0,
    ],
    [
        25.0, 30.0, 36.0, 43.0, 52.0, 62.0, 74.0, 87.0, 100.0, 115.0, 130.0, 140.0, 155.0,
    ],
    [
        40.0, 48.0, 58.0, 70.0, 84.0, 100.0, 120.0, 140.0, 160.0, 185.0, 210.0, 230.0, 250.0,
    ],
    [
        60.0, 75.0, 90.0, 110.0, 130.0, 160.0, 190.0, 220.0, 250.0, 290.0, 320.0, 360.0, 400.0,
    ],
    [
        100.0, 120.0, 150.0, 180.0, 210.0, 250.0, 300.0, 350.0, 400.0, 460.0, 520.0, 570.0, 630.0,
    ],
    [
        140.0, 180.0, 220.0, 270.0, 330.0, 390.0, 460.0, 540.0, 630.0, 720.0, 810.0, 890.0, 970.0,
    ],
    [
        250.0, 300.0, 360.0, 430.0, 520.0, 620.0, 740.0, 870.0, 1000.0, 1150.0, 1300.0, 1400.0,
        1550.0,
    ],
    [
        400.0, 480.0, 580.0, 700.0, 840.0, 1000.0, 1200.0, 1400.0, 1600.0, 1850.0, 2100.0, 2300.0,
        2500.0,
    ],
    [
        600.0, 750.0, 900.0, 1100.0, 1300.0, 1600.0, 1900.0, 2200.0, 2500.0, 2900.0, 3200.0,
        3600.0, 4000.0,
    ],
    [
        1000.0, 1200.0, 1500.0, 1800.0, 2100.0, 2500.0, 3000.0, 3500.0, 4000.0, 4600.0, 5200.0,
        5700.0, 6300.0,
    ],
    [
        1400.0, 1800.0, 2200.0, 2700.0, 3300.0, 3900.0, 4600.0, 5400.0, 6300.0, 7200.0, 8100.0,
        8900.0, 9700.0,
    ],
];

/// Sizes of a column's fundamental deviations.
#[derive(Debug, Clone, Copy)]
pub enum Column {
    /// One for all.
    Zero,
    /// One for each range.
    Main(&'static [f64; 13]),
    /// One for each finer range.
    Fine(&'static [f64; 25]),
}

/// Where the field of a letter is, seen from the shaft.
#[derive(Debug, Clone, Copy)]
pub enum Deviation {
    /// The upper deviation of the shaft is this much below zero.
    Below(Column),
    /// Half to either side.
    Middle,
    /// The lower deviation of the shaft is this much above zero.
    Above(Column),
}

impl Deviation {
    /// All letters, small (ISO 286-1:2010, tables 2 to 5).
    pub const ALL: [(&'static str, Deviation); 13] = [
        ("a", Deviation::Below(Column::Fine(&A))),
        ("b", Deviation::Below(Column::Fine(&B))),
        ("c", Deviation::Below(Column::Fine(&C))),
        ("d", Deviation::Below(Column::Main(&D))),
        ("e", Deviation::Below(Column::Main(&E))),
        ("f", Deviation::Below(Column::Main(&F))),
        ("g", Deviation::Below(Column::Main(&G))),
        ("h", Deviation::Below(Column::Zero)),
        ("js", Deviation::Middle),
        ("k", Deviation::Above(Column::Main(&K))),
        ("m", Deviation::Above(Column::Main(&M))),
        ("n", Deviation::Above(Column::Main(&N))),
        ("p", Deviation::Above(Column::Main(&P))),
    ];
}

const A: [f64; 25] = [
    270.0, 270.0, 280.0, 290.0, 290.0, 300.0, 300.0, 310.0, 320.0, 340.0, 360.0, 380.0, 410.0,
    460.0, 520.0, 580.0, 660.0, 740.0, 820.0, 920.0, 1050.0, 1200.0, 1350.0, 1500.0, 1650.0,
];
const B: [f64; 25] = [
    140.0, 140.0, 150.0, 150.0, 150.0, 160.0, 160.0, 170.0, 180.0, 190.0, 200.0, 220.0, 240.0,
    260.0, 280.0, 310.0, 340.0, 380.0, 420.0, 480.0, 540.0, 600.0, 680.0, 760.0, 840.0,
];
const C: [f64; 25] = [
    60.0, 70.0, 80.0, 95.0, 95.0, 110.0, 110.0, 120.0, 130.0, 140.0, 150.0, 170.0, 180.0, 200.0,
    210.0, 230.0, 240.0, 260.0, 280.0, 300.0, 330.0, 360.0, 400.0, 440.0, 480.0,
];
const D: [f64; 13] = [
    20.0, 30.0, 40.0, 50.0, 65.0, 80.0, 100.0, 120.0, 145.0, 170.0, 190.0, 210.0, 230.0,
];
const E: [f64; 13] = [
    14.0, 20.0, 25.0, 32.0, 40.0, 50.0, 60.0, 72.0, 85.0, 100.0, 110.0, 125.0, 135.0,
];
const F: [f64; 13] = [
    6.0, 10.0, 13.0, 16.0, 20.0, 25.0, 30.0, 36.0, 43.0, 50.0, 56.0, 62.0, 68.0,
];
const G: [f64; 13] = [
    2.0, 4.0, 5.0, 6.0, 7.0, 9.0, 10.0, 12.0, 14.0, 15.0, 17.0, 18.0, 20.0,
];
const K: [f64; 13] = [
    0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0, 5.0,
];
const M: [f64; 13] = [
    2.0, 4.0, 6.0, 7.0, 8.0, 9.0, 11.0, 13.0, 15.0, 17.0, 20.0, 21.0, 23.0,
];
const N: [f64; 13] = [
    4.0, 8.0, 10.0, 12.0, 15.0, 17.0, 20.0, 23.0, 27.0, 31.0, 34.0, 37.0, 40.0,
];
const P: [f64; 13] = [
    6.0, 12.0, 15.0, 18.0, 22.0, 26.0, 32.0, 37.0, 43.0, 50.0, 56.0, 62.0, 68.0,
];

/// The ranges of a nominal size.
#[derive(Debug, Clone, Copy)]
pub struct Sizes {
    main: usize,
    fine: usize,
}

impl Sizes {
    /// Of a size \[mm\] within the tables.
    pub fn of(nominal: f64) -> Sizes {
        let range = |ends: &[f64]| {
            ends.partition_point(|end| *end < nominal)
                .min(ends.len() - 1)
        };
        Sizes {
            main: range(&MAIN),
            fine: range(&FINE),
        }
    }

    /// The standard tolerance of a grade, where there is one.
    pub fn grade(self, grade: u32) -> Option<f64> {
        let row = usize::try_from(grade).ok()?.checked_sub(1)?;
        Some(GRADES.get(row)?[self.main])
    }

    /// A fundamental deviation.
    pub fn column(self, column: Column) -> f64 {
        match column {
            Column::Zero => 0.0,
            Column::Main(values) => values[self.main],
            Column::Fine(values) => values[self.fine],
        }
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
