//! Draws the loads of one pose.

use super::moving::Mechanism;
use super::parts::on_page;
use super::values::Values;
use super::view::View;
use crate::palette::LOAD;
use crate::poses::Pose;
use crate::scene::{Ink, Place, Scene};
use crate::sign::{Corner, Edge, Seat, Sign};
use crate::symbols;
use crate::words;

/// Radius of the round arrow of a torque, in bars: that of a driver has room in it.
pub const TORQUE: f64 = 3.6;
/// Length of the arrow of the largest force, in bars.
const LARGEST: f64 = 11.0;
/// A force this small compared with the largest is not drawn.
const NONE: f64 = 1e-9;

/// Draws a sign from one place to another; a short arrow has a small head.
fn draw(scene: &mut Scene, view: &View, [from, to]: [Place; 2], sign: &Sign) {
    let [x, y] = [0, 1].map(|k| to[k] - from[k]);
    let length = x.hypot(y);
    let (along, bar) = match length > 0.0 {
        true => (
            [x / length, y / length],
            view.bar.min(length / symbols::HEAD[0]),
        ),
        false => ([1.0, 0.0], view.bar),
    };
    let seat = Seat {
        origin: from,
        along,
        length,
        scale: view.scale,
        bar: [bar, view.bar],
        body: 0,
        strength: 1.0,
    };
    for stroke in sign {
        seat.draw(scene, stroke, std::iter::empty::<Corner>(), |_| 0.0);
    }
}

impl Mechanism {
    /// Forces with their head at the point they push on, the largest one over time with a fixed length; torques around the body.
    /// Each has its value at its free end.
    pub(super) fn draw_loads(&self, scene: &mut Scene, view: &View, pose: &[Pose], time: f64) {
        let bar = view.bar;
        let edge = Edge::of(LOAD);
        let [arrow, _] = symbols::force_arrows("load", edge);
        let mut values = Values::new(view, Ink::new(LOAD.light));
        for load in &self.shape.loads {
            let Some([x, y]) = load.at_time(time) else {
                continue;
            };
            let Some(point) = load.at else {
                if x != 0.0 {
                    let centre = self.body_on_page(view, pose, load.body);
                    let sign = symbols::round_arrow("load", TORQUE, x > 0.0, edge);
                    draw(scene, view, [centre; 2], &sign);
                    let above = [centre[0], centre[1] - TORQUE * bar];
                    values.write(scene, above, [0.0, -1.0], &words::quantity(x, "N*m"));
                }
                continue;
            };
            let size = x.hypot(y);
            if size <= NONE * self.largest_load {
                continue;
            }
            let at = on_page(self, view, pose, point);
            let [dx, dy] = [x, -y].map(|force| LARGEST * bar * (force / self.largest_load));
            let tail = [at[0] - dx, at[1] - dy];
            // Where there is no room for the tail the arrow begins at the point.
            let (ends, free, side) = if view.shows(tail) {
                ([tail, at], tail, -1.0)
            } else {
                let head = [at[0] + dx, at[1] + dy];
                ([at, head], head, 1.0)
            };
            draw(scene, view, ends, &arrow);
            let away = [side * x / size, -side * y / size];
            values.write(scene, free, away, &words::quantity(size, "N"));
        }
    }

    /// The first point of a body on the page, or its origin.
    pub(super) fn body_on_page(&self, view: &View, pose: &[Pose], body: usize) -> Place {
        match self.shape.point((body, 0)) {
            Some(_) => on_page(self, view, pose, (body, 0)),
            None => view.place([pose[body][0], pose[body][1]]),
        }
    }
}
