//! What drawings are made of, and how it is moved.

/// A part of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// Straights and arcs, one after the other.
    Line {
        /// Where they begin; the last one leads back to the first corner where it is closed.
        corners: Vec<Corner>,
        /// Whether it ends where it began.
        closed: bool,
    },
    /// A circle.
    Circle {
        /// Its centre.
        centre: [f64; 2],
        /// Its radius.
        radius: f64,
    },
    /// A place.
    Point([f64; 2]),
    /// A text on one line.
    Text {
        /// Its lower left corner.
        at: [f64; 2],
        /// Height of a letter.
        height: f64,
        /// What it says.
        text: String,
    },
}

/// Where a straight or an arc begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// The place.
    pub place: [f64; 2],
    /// What follows: tangent of a quarter of the arc's angle, positive to the left, 0 of a straight.
    pub bulge: f64,
}

impl Corner {
    /// Where a straight begins.
    pub fn straight(place: [f64; 2]) -> Self {
        Corner { place, bulge: 0.0 }
    }
}

/// Width of a letter, in heights: nobody measures fonts here.
const LETTER: f64 = 0.6;
/// Chords of an arc where one is needed \[rad\].
const CHORD: f64 = 0.2;

impl Form {
    /// Straights from place to place.
    pub fn line(places: impl IntoIterator<Item = [f64; 2]>, closed: bool) -> Self {
        Form::Line {
            corners: places.into_iter().map(Corner::straight).collect(),
            closed,
        }
    }

    /// Places that it reaches: its corners, of a circle those of its box.
    pub fn places(&self) -> Vec<[f64; 2]> {
        match self {
            Form::Line { corners, closed } => chords(corners, *closed),
            Form::Circle {
                centre: [x, y],
                radius,
            } => vec![[x - radius, y - radius], [x + radius, y + radius]],
            Form::Point(at) => vec![*at],
            Form::Text { at, .. } => {
                let [width, height] = self.text_size();
                vec![*at, [at[0] + width, at[1] + height]]
            }
        }
    }

    /// Width and height of a text, about; of others nothing.
    pub fn text_size(&self) -> [f64; 2] {
        match self {
            Form::Text { height, text, .. } => {
                [LETTER * height * text.chars().count() as f64, *height]
            }
            Form::Line { .. } | Form::Circle { .. } | Form::Point(_) => [0.0; 2],
        }
    }

    /// The same, moved; nothing where that is no such form, as of a circle that becomes an ellipse.
    pub fn moved(&self, by: &Affine) -> Option<Form> {
        let is_round = |bulge: f64| bulge == 0.0 || by.scale().is_some();
        Some(match self {
            Form::Line { corners, closed } => {
                if !corners.iter().all(|corner| is_round(corner.bulge)) {
                    return None;
                }
                let sign = by.determinant().signum();
                let moved = corners.iter().map(|corner| Corner {
                    place: by.at(corner.place),
                    bulge: sign * corner.bulge,
                });
                Form::Line {
                    corners: moved.collect(),
                    closed: *closed,
                }
            }
            Form::Circle { centre, radius } => Form::Circle {
                centre: by.at(*centre),
                radius: radius * by.scale()?,
            },
            Form::Point(at) => Form::Point(by.at(*at)),
            Form::Text { at, height, text } => Form::Text {
                at: by.at(*at),
                height: height * by.determinant().abs().sqrt(),
                text: text.clone(),
            },
        })
    }
}

/// Corners of a line with chords for its arcs.
pub fn chords(corners: &[Corner], closed: bool) -> Vec<[f64; 2]> {
    let count = corners.len();
    let mut places = Vec::with_capacity(count);
    for (k, corner) in corners.iter().enumerate() {
        places.push(corner.place);
        let follows = k + 1 < count || closed;
        if corner.bulge == 0.0 || !follows {
            continue;
        }
        let ([x, y], [u, v]) = (corner.place, corners[(k + 1) % count].place);
        let turn = 4.0 * corner.bulge.atan();
        // The centre lies (1 − b²)/4b chords to the left of the middle.
        let off = (1.0 - corner.bulge * corner.bulge) / (4.0 * corner.bulge);
        let centre = [(x + u) / 2.0 - off * (v - y), (y + v) / 2.0 + off * (u - x)];
        let [dx, dy] = [x - centre[0], y - centre[1]];
        let parts = (turn.abs() / CHORD).ceil().max(2.0);
        places.extend((1..parts as usize).map(|k| {
            let (sin, cos) = (turn * k as f64 / parts).sin_cos();
            [
                centre[0] + cos * dx - sin * dy,
                centre[1] + sin * dx + cos * dy,
            ]
        }));
    }
    places
}

/// x → a x + c y + e, y → b x + d y + f.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Affine(pub [f64; 6]);

/// Two scales that differ by less are one: files have so many digits.
const EQUAL: f64 = 1e-6;

impl Affine {
    /// What turns about the origin, and then moves there: x, y, angle \[rad\].
    pub fn turned([x, y, angle]: [f64; 3]) -> Affine {
        let (sin, cos) = angle.sin_cos();
        Affine([cos, sin, -sin, cos, x, y])
    }

    /// Of the place that `inner` puts it at.
    pub fn of(&self, inner: &Affine) -> Affine {
        let [a, b, c, d, ..] = self.0;
        let [p, q, r, s, t, u] = inner.0;
        let [e, f] = self.at([t, u]);
        Affine([
            a * p + c * q,
            b * p + d * q,
            a * r + c * s,
            b * r + d * s,
            e,
            f,
        ])
    }

    /// Where a place comes to.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d, e, f] = self.0;
        [a * x + c * y + e, b * x + d * y + f]
    }

    /// How areas grow; negative where it mirrors.
    pub fn determinant(&self) -> f64 {
        let [a, b, c, d, ..] = self.0;
        a * d - b * c
    }

    /// How all lengths grow, where circles stay circles.
    pub fn scale(&self) -> Option<f64> {
        let [a, b, c, d, ..] = self.0;
        let (first, second) = (a.hypot(b), c.hypot(d));
        let is_similar = (first - second).abs() <= EQUAL * first
            && (a * c + b * d).abs() <= EQUAL * first * second;
        is_similar.then_some(first)
    }
}

/// A number without the noise of its last digits: of a drawing of that size, thirteen digits behind its first.
pub fn tidy(value: f64, size: f64) -> f64 {
    let digits = 12.0 - size.log10().floor();
    let digits = digits.clamp(0.0, 30.0) as usize;
    format!("{value:.digits$}").parse().unwrap_or(value)
}

/// A number for a message: three digits.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let digits = 2.0 - value.abs().log10().floor();
    match digits {
        0.0..=6.0 => {
            let text = format!("{value:.*}", digits as usize);
            match text.contains('.') {
                true => text.trim_end_matches('0').trim_end_matches('.').into(),
                false => text,
            }
        }
        ..0.0 if digits > -4.0 => format!("{value:.0}"),
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a circle from (1, 0) to (−1, 0) over the left: its chords lie on the circle, above.
    #[test]
    fn chords_lie_on_the_arc() {
        let corners = [
            Corner {
                place: [1.0, 0.0],
                bulge: 1.0,
            },
            Corner::straight([-1.0, 0.0]),
        ];
        let places = chords(&corners, false);
        assert!(places.len() > 10, "{places:?}");
        for [x, y] in places {
            assert!((x.hypot(y) - 1.0).abs() < 1e-12 && y >= 0.0, "{x} {y}");
        }
    }

    #[test]
    fn what_is_moved_stays_what_it_is_or_is_nothing() {
        let circle = Form::Circle {
            centre: [1.0, 0.0],
            radius: 2.0,
        };
        // Turned by 90°, twice as large, shifted.
        let turned = Affine([0.0, 2.0, -2.0, 0.0, 5.0, 7.0]);
        let found = circle.moved(&turned);
        let wanted = Form::Circle {
            centre: [5.0, 9.0],
            radius: 4.0,
        };
        assert_eq!(found, Some(wanted));
        let squeezed = Affine([1.0, 0.0, 0.0, 0.5, 0.0, 0.0]);
        assert_eq!(circle.moved(&squeezed), None);
        let both = turned.of(&squeezed);
        assert_eq!(both.at([1.0, 2.0]), turned.at(squeezed.at([1.0, 2.0])));
    }

    #[test]
    fn numbers_are_tidy() {
        assert_eq!(tidy(0.1 + 0.2, 1.0), 0.3);
        assert_eq!(tidy(100.00000000000001, 300.0), 100.0);
        assert_eq!(short(0.00001234), "1.23e-5");
        assert_eq!(short(0.5), "0.5");
        assert_eq!(short(123456.0), "123456");
    }
}
