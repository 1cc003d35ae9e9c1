//! Markers of curves.

use crate::scene::{Ink, Pen, Place, Scene};
use crate::style::Marker;

/// Half the size of a marker \[pt\].
const HALF: f64 = 1.9;

/// A marker, white inside.
pub fn marker(scene: &mut Scene, marker: Marker, [x, y]: Place, pen: Pen) {
    let pen = Pen {
        dash: &[],
        width: 0.8 * pen.width,
        ..pen
    };
    let white = Some(Ink::grey(255));
    let corners = |corners: &[[f64; 2]]| -> Vec<Place> {
        corners
            .iter()
            .map(|[dx, dy]| [x + HALF * dx, y + HALF * dy])
            .collect()
    };
    match marker {
        Marker::None => {}
        Marker::Circle => scene.circle("marker", [x, y], HALF, white, Some(pen)),
        Marker::Square => {
            let places = corners(&[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]);
            scene.area("marker", places, white, Some(pen));
        }
        Marker::Triangle => {
            scene.area(
                "marker",
                corners(&[[0.0, -1.2], [1.1, 0.8], [-1.1, 0.8]]),
                white,
                Some(pen),
            );
        }
        Marker::Diamond => {
            scene.area(
                "marker",
                corners(&[[0.0, -1.3], [1.1, 0.0], [0.0, 1.3], [-1.1, 0.0]]),
                white,
                Some(pen),
            );
        }
    }
}
