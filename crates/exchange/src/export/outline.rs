//! A drawing to scale, by layers.

use crate::form::{Corner, Form, tidy};

/// A drawing.
#[derive(Debug, Clone, Default)]
pub struct Sheet {
    /// What it shows.
    pub title: String,
    /// Its layers, from the back to the front.
    pub layers: Vec<Layer>,
}

/// A layer of a drawing.
#[derive(Debug, Clone, Default)]
pub struct Layer {
    /// Its name.
    pub name: String,
    /// Red, green, blue.
    pub colour: [u8; 3],
    /// What is on it, y upwards \[m\].
    pub forms: Vec<Form>,
}

/// Millimetres of a metre.
const MM: f64 = 1e3;

impl Sheet {
    /// Width and height \[m\].
    pub fn size(&self) -> [f64; 2] {
        let [left, bottom, right, top] = self.edges().unwrap_or_default();
        [(right - left) / MM, (top - bottom) / MM]
    }

    /// Left, bottom, right and top \[mm\]; nothing where it is empty, or where a place is no number.
    pub(super) fn edges(&self) -> Option<[f64; 4]> {
        let forms = self.layers.iter().flat_map(|layer| &layer.forms);
        let places = forms.flat_map(Form::places);
        let outermost = places.map(|[x, y]| [x, y, x, y]).reduce(|all, own| {
            [
                all[0].min(own[0]),
                all[1].min(own[1]),
                all[2].max(own[2]),
                all[3].max(own[3]),
            ]
        })?;
        let edges = outermost.map(|edge| MM * edge);
        edges.iter().all(|edge| edge.abs() < 1e15).then_some(edges)
    }

    /// A length in millimetres, as it is written: without the noise of its last digits.
    pub(super) fn millimetres(&self) -> impl Fn(f64) -> f64 + use<> {
        let [left, bottom, right, top] = self.edges().unwrap_or_default();
        let size = (right - left).max(top - bottom).max(1e-9);
        // −0 is 0.
        move |metres| tidy(MM * metres, size) + 0.0
    }
}

/// The outline at a distance from the convex polygon of these corners, which follow each other to the left: straights and arcs.
pub fn around(corners: &[[f64; 2]], radius: f64) -> Form {
    if let [centre] = *corners {
        return Form::Circle { centre, radius };
    }
    let count = corners.len();
    let outwards = |k: usize| {
        let ([x, y], [u, v]) = (corners[k], corners[(k + 1) % count]);
        let length = (u - x).hypot(v - y);
        [(v - y) / length, (x - u) / length]
    };
    let mut outline = Vec::with_capacity(2 * count);
    for (k, [x, y]) in corners.iter().enumerate() {
        let [before, after] = [outwards((k + count - 1) % count), outwards(k)];
        let turn = (before[0] * after[1] - before[1] * after[0])
            .atan2(before[0] * after[0] + before[1] * after[1]);
        // Around the end of a straight it is half a turn, whose sign is lost.
        let turn = if turn < 0.0 {
            turn + std::f64::consts::TAU
        } else {
            turn
        };
        outline.push(Corner {
            place: [x + radius * before[0], y + radius * before[1]],
            bulge: (turn / 4.0).tan(),
        });
        outline.push(Corner::straight([
            x + radius * after[0],
            y + radius * after[1],
        ]));
    }
    Form::Line {
        corners: outline,
        closed: true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form::chords;

    /// Every place of it is as far from the polygon, and goes around to the left.
    #[test]
    fn an_outline_keeps_its_distance() {
        let bar = [[0.0, 0.0], [3.0, 4.0]];
        let plate = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]];
        for (corners, perimeter) in [(&bar[..], 10.0), (&plate[..], 12.0)] {
            let Form::Line {
                corners: outline, ..
            } = around(corners, 0.5)
            else {
                panic!("a line")
            };
            let places = chords(&outline, true);
            let next = places.iter().cycle().skip(1);
            let pieces: Vec<_> = places.iter().zip(next).collect();
            let length: f64 = pieces
                .iter()
                .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
                .sum();
            assert!(
                (length - perimeter - std::f64::consts::PI).abs() < 0.01,
                "{length}"
            );
            let area: f64 = pieces.iter().map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
            assert!(area > 0.0, "{area}");
        }
    }
}
