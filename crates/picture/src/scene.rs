//! Lines, areas and texts on a page, in points, y downwards.

/// Points per millimetre.
pub const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// A place on the page \[pt\].
pub type Place = [f64; 2];

/// A colour and how much it covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ink {
    /// Red, green, blue.
    pub rgb: [u8; 3],
    /// How much it covers, 0 … 1.
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
    /// Its colour.
    pub ink: Ink,
    /// Width of the line \[pt\].
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
    /// At its left end.
    Start,
    /// In its middle.
    Middle,
    /// At its right end.
    End,
}

/// A piece of a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Its letters.
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

/// Size of a raised run, as a part of the font size.
pub const RAISED_SIZE: f64 = 0.7;
/// How far the baseline of a raised run lies above, as a part of the font size.
pub const RAISED_BY: f64 = 0.35;

/// Something on the page; `class` says what it is, to whoever edits or tests the SVG.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// Straight from place to place.
    Line {
        /// What it is.
        class: &'static str,
        /// Its corners.
        places: Vec<Place>,
        /// How it is drawn.
        pen: Pen,
    },
    /// What places enclose.
    Area {
        /// What it is.
        class: &'static str,
        /// Its corners.
        places: Vec<Place>,
        /// What it is filled with.
        fill: Option<Ink>,
        /// How its edge is drawn.
        pen: Option<Pen>,
    },
    /// A circle.
    Circle {
        /// What it is.
        class: &'static str,
        /// Its centre.
        centre: Place,
        /// Its radius \[pt\].
        radius: f64,
        /// What it is filled with.
        fill: Option<Ink>,
        /// How its edge is drawn.
        pen: Option<Pen>,
    },
    /// A text on one line.
    Label {
        /// What it is.
        class: &'static str,
        /// Where its anchor stands.
        at: Place,
        /// Its pieces, one after the other.
        runs: Vec<Run>,
        /// Size of the font \[pt\].
        size: f64,
        /// What stands at its place.
        anchor: Anchor,
        /// Whether it reads upwards.
        turned: bool,
        /// Its colour.
        ink: Ink,
    },
}

/// A page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// Width \[pt\].
    pub width: f64,
    /// Height \[pt\].
    pub height: f64,
    /// What it shows, for those who can't see it.
    pub title: String,
    /// What it shows in a sentence or two, for the same readers.
    pub about: String,
    /// What is drawn, from below to above.
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

    /// Takes all items of another scene, moved so far.
    pub fn take(&mut self, other: &Scene, [dx, dy]: Place) {
        let moved = |place: &Place| [place[0] + dx, place[1] + dy];
        self.items.extend(other.items.iter().map(|item| {
            let mut item = item.clone();
            match &mut item {
                Item::Line { places, .. } | Item::Area { places, .. } => {
                    places.iter_mut().for_each(|place| *place = moved(place));
                }
                Item::Circle { centre: place, .. } | Item::Label { at: place, .. } => {
                    *place = moved(place);
                }
            }
            item
        }));
    }

    /// Least and greatest x and y of lines, areas and circles with their edges \[pt\]; infinite where there are none.
    pub fn bounds(&self) -> [Place; 2] {
        let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let mut add = |places: &[Place], room: f64| {
            for place in places {
                for axis in 0..2 {
                    bounds[0][axis] = bounds[0][axis].min(place[axis] - room);
                    bounds[1][axis] = bounds[1][axis].max(place[axis] + room);
                }
            }
        };
        let edge = |pen: Option<Pen>| pen.map_or(0.0, |pen| pen.width / 2.0);
        for item in &self.items {
            match item {
                Item::Line { places, pen, .. } => add(places, edge(Some(*pen))),
                Item::Area { places, pen, .. } => add(places, edge(*pen)),
                Item::Circle {
                    centre,
                    radius,
                    pen,
                    ..
                } => add(&[*centre], radius + edge(*pen)),
                Item::Label { .. } => {}
            }
        }
        bounds
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
