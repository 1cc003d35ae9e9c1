//! Mechanisms in motion, to and fro, each with a text → a page without scripts.

use super::mechanism::Mechanism;
use super::{played, sheet};

/// Width of a drawing \[pt\], and how long a motion takes \[s\].
const WIDTH: f64 = 260.0;
const SECONDS: f64 = 5.0;
/// Several drawings abreast.
const NARROW: &str =
    ".many { grid-template-columns: repeat(auto-fill, minmax(min(100%, 22rem), 1fr)); }
.many svg { max-height: 55vh; }";
/// Size of all drawings \[bytes\], at most.
const LARGEST: usize = 12_000_000;

/// A mechanism in motion.
#[derive(Debug)]
pub struct MovingMechanism {
    /// What is said of it, a title first.
    pub texts: Vec<String>,
    /// The mechanism, with a pose at each whole number.
    pub mechanism: Mechanism,
    /// How many poses there are.
    pub rows: usize,
    /// The way of a point \[m\].
    pub path: Vec<[f64; 2]>,
    /// Places that are marked \[m\].
    pub marks: Vec<[f64; 2]>,
}

/// The page with a heading, facts below it, the films, and notes with a heading of their own.
pub fn films_page(
    heading: &str,
    facts: &[String],
    films: &[MovingMechanism],
    (about, notes): (&str, &[String]),
) -> String {
    let mut main = String::from("<div class=\"many\">\n");
    let mut left = 0;
    for film in films {
        if main.len() > LARGEST {
            left += 1;
            continue;
        }
        main += &figure(film);
    }
    main += "</div>\n";
    if left > 0 {
        main += &format!("<p class=\"muted\">{left} more are not drawn.</p>\n");
    }
    main += &format!("<h2>{}</h2>\n", sheet::text(about));
    for note in notes {
        main += &format!("<p>{}</p>\n", sheet::text(note));
    }
    sheet::styled_page(heading, facts, &main, NARROW)
}

fn figure(film: &MovingMechanism) -> String {
    let mut behind = film.mechanism.plain(0.0, WIDTH, Some(0.15));
    film.mechanism.trace(&mut behind, WIDTH, &film.path);
    // To and fro, so that it does not jump where the crank does not turn fully.
    let there = 0..film.rows;
    let back = (1..film.rows.saturating_sub(1)).rev();
    let mut scenes: Vec<_> = there
        .chain(back)
        .chain([0])
        .map(|row| film.mechanism.plain(row as f64, WIDTH, None))
        .collect();
    // On top, and in the first scene alone, so that they stand still.
    film.mechanism.mark(&mut scenes[0], WIDTH, &film.marks);
    let drawing = played::write(&behind, &scenes, SECONDS);
    sheet::figure(&drawing, &film.texts)
}
