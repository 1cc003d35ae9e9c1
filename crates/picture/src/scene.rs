//! Lines, areas and texts on a page, in points, y downwards.

/// Points per millimetre.
pub const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// A place on the page \[pt\].
pub type Place = [f64; 2];

/// A colour and how much it covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ink {
    pub rgb: [u8; 3],
    /// 0 … 1
    pub alpha: f64,
}

impl Ink {
    /// A covering colour.
    pub const fn new(rgb: [u8; 3]) -> Self {
        Ink { rgb, alpha: 1.0 }
    }

    /// A covering grey, 0 black … 255 white.
    pub const fn grey(level: u8) -> Self {
        Ink::new([level; 3])
    }

    /// The same, covering less.
    pub fn faded(self, factor: f64) -> Self {
        Ink {
            alpha: self.alpha * factor,
            ..self
        }
    }
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    pub ink: Ink,
    /// \[pt\]
    pub width: f64,
    /// Lengths of dashes and gaps in turn, in widths of the line; empty: solid.
    pub dash: &'static [f64],
}

impl Pen {
    /// A solid line.
    pub const fn new(ink: Ink, width: f64) -> Self {
        Pen {
            ink,
            width,
            dash: &[],
        }
    }
}

/// Where a text's place is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// A piece of a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    pub text: String,
    /// An exponent: smaller and higher.
    pub raised: bool,
}

impl Run {
    /// Ordinary text.
    pub fn plain(text: impl Into<String>) -> Self {
        Run {
            text: text.into(),
            raised: false,
        }
    }

    /// An exponent.
    pub fn raised(text: impl Into<String>) -> Self {
        Run {
            text: text.into(),
            raised: true,
        }
    }
}

/// Size of a raised run, and how far its baseline lies above, both as parts of the font size.
pub const RAISED_SIZE: f64 = 0.7;
pub const RAISED_BY: f64 = 0.35;

/// Something on the page; `class` says what it is, to whoever edits or tests the SVG.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    Line {
        class: &'static str,
        places: Vec<Place>,
        pen: Pen,
    },
    Area {
        class: &'static str,
        places: Vec<Place>,
        fill: Option<Ink>,
        pen: Option<Pen>,
    },
    Circle {
        class: &'static str,
        centre: Place,
        radius: f64,
        fill: Option<Ink>,
        pen: Option<Pen>,
    },
    Label {
        class: &'static str,
        at: Place,
        runs: Vec<Run>,
        size: f64,
        anchor: Anchor,
        turned: bool,
        ink: Ink,
    },
}

/// A page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// \[pt\]
    pub width: f64,
    pub height: f64,
    /// What it shows, for those who can't see it.
    pub title: String,
    pub about: String,
    pub items: Vec<Item>,
}

impl Scene {
    /// An empty white page.
    pub fn new(width: f64, height: f64) -> Self {
        Scene {
            width,
            height,
            ..Scene::default()
        }
    }

    /// A line through places.
    pub fn line(&mut self, class: &'static str, places: impl Into<Vec<Place>>, pen: Pen) {
        self.items.push(Item::Line {
            class,
            places: places.into(),
            pen,
        });
    }

    /// A closed area.
    pub fn area(
        &mut self,
        class: &'static str,
        places: impl Into<Vec<Place>>,
        fill: Option<Ink>,
        pen: Option<Pen>,
    ) {
        self.items.push(Item::Area {
            class,
            places: places.into(),
            fill,
            pen,
        });
    }

    /// A circle.
    pub fn circle(
        &mut self,
        class: &'static str,
        centre: Place,
        radius: f64,
        fill: Option<Ink>,
        pen: Option<Pen>,
    ) {
        self.items.push(Item::Circle {
            class,
            centre,
            radius,
            fill,
            pen,
        });
    }

    /// A text in black.
    pub fn label(
        &mut self,
        class: &'static str,
        at: Place,
        runs: Vec<Run>,
        size: f64,
        anchor: Anchor,
    ) {
        self.items.push(Item::Label {
            class,
            at,
            runs,
            size,
            anchor,
            turned: false,
            ink: Ink::grey(0),
        });
    }
}
