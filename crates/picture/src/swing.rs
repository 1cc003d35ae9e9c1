//! Shapes of small motions → a page in which each of them moves: pose = rest + a·Re((re + i·im)·e^{iφ}).
//!
//! Angles and displacements are those of the linearised mechanism, so that bars keep their length and pins open by what is small of
//! second order. The amplitude a is fitted to the mechanism: it says nothing about how far a motion goes.

use std::f64::consts::TAU;

use super::fault::Fault;
use super::mechanism::Mechanism;
use super::poses::{Pose, Poses, global};
use super::shape::{Body, Shape};
use super::{played, sheet};

/// Largest rotation \[rad\], and largest displacement of a point as a part of the mechanism's size.
const TURN: f64 = 0.15;
const WAY: f64 = 0.07;
/// Places of a motion between which all goes straight.
const PLACES: usize = 16;
/// How often a motion that only fades has become smaller by e when it begins again.
const FADES: f64 = 3.5;
/// A period on the page \[s\].
pub const SECONDS: f64 = 2.0;
/// Width of a drawing \[pt\], and how much of the colours the position at rest has.
const WIDTH: f64 = 420.0;
const REST: f64 = 0.22;
/// Size of all drawings \[bytes\], and their number, at most.
const LARGEST: usize = 4_000_000;
const MOST: usize = 24;

/// How a mode goes on in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
    /// To and fro.
    Swings,
    /// Back to where it rests.
    Fades,
    /// Away from where it rests.
    Leaves,
}

/// A mode.
#[derive(Debug, Clone)]
pub struct Swing {
    /// How it goes on.
    pub course: Course,
    /// Per moving body x, y \[m\] and angle \[rad\], each with real and imaginary part.
    pub shape: Vec<[[f64; 2]; 3]>,
    /// What is said of it, a title first.
    pub texts: Vec<String>,
}

/// The page of modes about a position of all bodies, the ground first; how many of the modes it shows.
///
/// # Errors
/// When the mechanism can't be drawn.
pub fn page(
    title: &str,
    facts: &[String],
    (shape, rest): (&Shape, &[Pose]),
    swings: &[Swing],
) -> Result<(String, usize), Fault> {
    let mut main = String::from("<div class=\"many\">\n");
    let mut shown = 0;
    for swing in swings.iter().take(MOST) {
        let figure = figure(shape, rest, swing)?;
        if shown > 0 && main.len() + figure.len() > LARGEST {
            break;
        }
        main += &figure;
        shown += 1;
    }
    main += "</div>\n";
    if shown < swings.len() {
        main += &format!(
            "<p class=\"muted\">{} more modes are not drawn.</p>\n",
            swings.len() - shown
        );
    }
    Ok((sheet::page(title, facts, &main), shown))
}

/// One mode.
fn figure(shape: &Shape, rest: &[Pose], swing: &Swing) -> Result<String, Fault> {
    let far = amplitude(shape, rest, swing);
    let poses = (0..=PLACES).map(|place| {
        let part = place as f64 / PLACES as f64;
        let [re, im] = match swing.course {
            Course::Swings => [(TAU * part).cos(), -(TAU * part).sin()],
            Course::Fades => [(-FADES * part).exp(), 0.0],
            Course::Leaves => [(FADES * (part - 1.0)).exp(), 0.0],
        };
        moved(rest, swing, [far * re, far * im])
    });
    let rows: Vec<Vec<Pose>> = std::iter::once(rest.to_vec()).chain(poses).collect();
    let mechanism = Mechanism::of_small_motion(shape.clone(), Poses::of(&rows))?;
    let mut scenes: Vec<_> = (0..rows.len())
        .map(|row| mechanism.plain(row as f64, WIDTH, (row == 0).then_some(REST)))
        .collect();
    let behind = scenes.remove(0);
    let drawing = played::write(&behind, &scenes, SECONDS);
    Ok(sheet::figure(&drawing, &swing.texts))
}

/// All bodies in a motion.
fn moved(rest: &[Pose], swing: &Swing, [re, im]: [f64; 2]) -> Vec<Pose> {
    let mut poses = rest.to_vec();
    for (pose, shape) in poses.iter_mut().skip(1).zip(&swing.shape) {
        for (value, [real, imaginary]) in pose.iter_mut().zip(shape) {
            *value += re * real + im * imaginary;
        }
    }
    poses
}

/// How far a place of a link that bends moves in its body.
fn deflection(body: &Body, moves: &[[f64; 2]], swing: &Swing) -> f64 {
    let amplitudes = body.bending.iter().flat_map(|own| &own.amplitudes);
    let mut far = 0.0_f64;
    for ([of, k], [x, y]) in amplitudes.zip(moves) {
        let of = of.checked_sub(1).and_then(|number| swing.shape.get(number));
        let [re, im] = of.map_or([0.0; 2], |shape| shape[*k]);
        far += re.hypot(im) * x.hypot(*y);
    }
    far
}

/// The factor with which a shape is drawn.
fn amplitude(shape: &Shape, rest: &[Pose], swing: &Swing) -> f64 {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    let (mut turn, mut way) = (0.0_f64, 0.0_f64);
    for (body, (drawn, pose)) in shape.bodies.iter().zip(rest).enumerate() {
        let motion = body
            .checked_sub(1)
            .and_then(|number| swing.shape.get(number));
        for moves in drawn.bending.iter().flat_map(|bending| &bending.moves) {
            way = way.max(deflection(drawn, moves, swing));
        }
        let [x, y, angle] = motion.copied().unwrap_or_default();
        turn = turn.max(angle[0].hypot(angle[1]));
        let origin = [pose[0], pose[1]];
        let points = drawn.points.iter().map(|(_, u, v)| global(*pose, [*u, *v]));
        for place in points.chain((body > 0).then_some(origin)) {
            for axis in 0..2 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
            let [rx, ry] = [place[0] - origin[0], place[1] - origin[1]];
            let parts =
                [0, 1].map(|part| (x[part] - ry * angle[part]).hypot(y[part] + rx * angle[part]));
            way = way.max(parts[0].hypot(parts[1]));
        }
    }
    let size = (high[0] - low[0]).hypot(high[1] - low[1]);
    let by_turn = TURN / turn.max(f64::MIN_POSITIVE);
    let by_way = WAY * size / way.max(f64::MIN_POSITIVE);
    // A shape without size is drawn by its rotation alone.
    if size > 0.0 {
        by_turn.min(by_way)
    } else {
        by_turn
    }
}
