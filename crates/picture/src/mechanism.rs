//! Shape and poses → scene: one pose, poses over each other, a strip of poses.
//!
//! A body is the convex hull of its points with rounded corners; the ground is drawn where something is held by it.

use super::drawing::{BodyPoint, Drawing, Joint, Kind};
use super::poses::{Pose, Poses, global};
use super::scene::{Anchor, Ink, Pen, Place, Run, Scene};
use super::{Fault, POINTS_PER_MM, font, style, symbols, words};

/// Outputs that traces and the extent are taken from, at most.
const MOST_ROWS: usize = 2000;
/// Poses of one picture, at most.
pub const MOST_POSES: usize = 64;
/// Height of a picture as a part of its width, at least and at most.
const PROPORTIONS: [f64; 2] = [0.3, 1.4];
/// Half the width of a bar, as a part of the width of the picture.
const BAR: f64 = 0.012;
/// Room around the mechanism, in bars.
const MARGIN: f64 = 6.5;
/// How much of the first of several poses is left.
const FADED: f64 = 0.3;
/// Letters below the poses of a strip \[pt\].
const CAPTION: f64 = 8.0;

/// How poses share a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Over each other, earlier ones fainter.
    Overlaid,
    /// Side by side, in rows.
    Strip,
}

/// A mechanism that can be drawn at any time.
#[derive(Debug)]
pub struct Mechanism {
    drawing: Drawing,
    poses: Poses,
    /// x, y \[m\]: least and greatest.
    extent: [[f64; 2]; 2],
    /// Paths of the traced points; interrupted at gaps.
    traces: Vec<Vec<[f64; 2]>>,
    /// Least and greatest slide of each joint that has a guide \[m\].
    slides: Vec<[f64; 2]>,
}

/// Part of a page that shows the mechanism: where the lower left of the extent lies, points per metre, bar \[pt\].
#[derive(Debug, Clone, Copy)]
struct View {
    corner: Place,
    origin: [f64; 2],
    scale: f64,
    bar: f64,
}

impl View {
    fn place(&self, [x, y]: [f64; 2]) -> Place {
        [
            self.corner[0] + (x - self.origin[0]) * self.scale,
            self.corner[1] - (y - self.origin[1]) * self.scale,
        ]
    }
}

impl Mechanism {
    /// A mechanism and its motion.
    ///
    /// # Errors
    /// When the extent is no number that a picture can have.
    pub fn new(drawing: Drawing, poses: Poses) -> Result<Self, Fault> {
        drawing.check()?;
        let count = poses.time.len();
        let stride = count.div_ceil(MOST_ROWS).max(1);
        let rows: Vec<Option<Vec<Pose>>> = (0..count)
            .step_by(stride)
            .chain([count - 1])
            .map(|row| poses.row(row))
            .collect();
        let mut mechanism = Mechanism {
            traces: Vec::new(),
            slides: drawing.joints.iter().map(first_slide).collect(),
            extent: [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]],
            drawing,
            poses,
        };
        for row in rows.iter().flatten() {
            mechanism.include(row);
        }
        mechanism.traces = mechanism
            .drawing
            .traces
            .iter()
            .flat_map(|trace| path(*trace, &rows))
            .collect();
        let [low, high] = mechanism.extent;
        if low[0] > high[0] {
            let of_what = if mechanism.drawing.bodies.len() < 2 {
                "no body but the ground"
            } else {
                "no point that moves"
            };
            return Err(Fault::Nothing(format!("the model has {of_what}")));
        }
        let sizes = [high[0] - low[0], high[1] - low[1]];
        let is_drawable = sizes.iter().all(|size| (0.0..1e12).contains(size))
            && low.iter().all(|x| x.abs() < 1e12);
        if is_drawable {
            Ok(mechanism)
        } else {
            Err(Fault::Drawing(
                "the mechanism is too large for a picture".into(),
            ))
        }
    }

    /// First and last time with a pose \[s\].
    pub fn span(&self) -> [f64; 2] {
        self.poses.span()
    }

    /// Widens extent and slides.
    fn include(&mut self, pose: &[Pose]) {
        let at = |(body, point): BodyPoint| global(pose[body], point);
        let corners = self.drawing.bodies.iter().zip(pose).skip(1);
        let mut places: Vec<[f64; 2]> = corners
            .flat_map(|(body, pose)| body.points.iter().map(|point| global(*pose, *point)))
            .collect();
        places.extend(
            self.drawing
                .springs
                .iter()
                .flatten()
                .map(|point| at(*point)),
        );
        for (joint, slide) in self.drawing.joints.iter().zip(&mut self.slides) {
            let [first, second] = joint.between.map(at);
            places.extend([first, second]);
            match joint.kind {
                Kind::Guide { .. } => {
                    let along = direction(joint, pose);
                    let s = along[0] * (second[0] - first[0]) + along[1] * (second[1] - first[1]);
                    *slide = [slide[0].min(s), slide[1].max(s)];
                }
                Kind::Gear { ratio } => {
                    let radii = pitch_radii(ratio, [first, second]);
                    for ([x, y], r) in [first, second].into_iter().zip(radii.unwrap_or_default()) {
                        places.extend([[x - r, y - r], [x + r, y + r]]);
                    }
                }
                Kind::Revolute | Kind::Fixed => {}
            }
        }
        let [low, high] = &mut self.extent;
        for place in places {
            for axis in 0..2 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
        }
    }

    /// Height of a picture of that width, in which the mechanism fills its room.
    fn height(&self, width: f64) -> f64 {
        let [low, high] = self.extent;
        let room = width * (1.0 - 2.0 * MARGIN * BAR);
        let proportion = (high[1] - low[1]) / (high[0] - low[0]).max(1e-12);
        (room * proportion + 2.0 * MARGIN * BAR * width)
            .clamp(PROPORTIONS[0] * width, PROPORTIONS[1] * width)
    }

    /// The view into a part of a page.
    fn view(&self, [left, top]: Place, [width, height]: [f64; 2]) -> View {
        let [low, high] = self.extent;
        let bar = BAR * width;
        let room = [width - 2.0 * MARGIN * bar, height - 2.0 * MARGIN * bar];
        let sizes = [high[0] - low[0], high[1] - low[1]];
        let scale = (room[0] / sizes[0].max(1e-12)).min(room[1] / sizes[1].max(1e-12));
        // In the middle.
        let corner = [
            left + (width - sizes[0] * scale) / 2.0,
            top + (height + sizes[1] * scale) / 2.0,
        ];
        View {
            corner,
            origin: low,
            scale,
            bar,
        }
    }

    /// One pose with its time below, on a page of that width \[pt\].
    pub fn frame(&self, time: f64, width: f64) -> Scene {
        let size = font_size(width);
        let height = self.height(width);
        let mut scene = Scene::new(width, height + 2.0 * size);
        let view = self.view([0.0, 0.0], [width, height]);
        self.draw_backdrop(&mut scene, &view);
        self.draw_pose(&mut scene, &view, time, 1.0);
        let text = if self.poses.at(time).is_some() {
            time_words(time, self.span())
        } else {
            format!("{}: no solution", time_words(time, self.span()))
        };
        scene.label(
            "time",
            [size, height + 1.2 * size],
            vec![Run::plain(text)],
            size,
            Anchor::Start,
        );
        scene
    }

    /// Several poses, equally spaced in time, on a page of that width \[mm\].
    ///
    /// # Errors
    /// When there are none, or too many.
    pub fn picture(&self, count: usize, layout: Layout, width_mm: f64) -> Result<Scene, Fault> {
        if !(1..=MOST_POSES).contains(&count) {
            return Err(Fault::Drawing(format!(
                "{count} poses: from 1 to {MOST_POSES} can be drawn"
            )));
        }
        let width = width_mm * POINTS_PER_MM;
        let [first, last] = self.span();
        let time = |index: usize| first + (last - first) * index as f64 / (count.max(2) - 1) as f64;
        Ok(match layout {
            Layout::Overlaid => {
                let mut scene = Scene::new(width, self.height(width));
                let view = self.view([0.0, 0.0], [width, scene.height]);
                self.draw_backdrop(&mut scene, &view);
                for index in 0..count {
                    let strength = FADED + (1.0 - FADED) * (index + 1) as f64 / count as f64;
                    self.draw_pose(
                        &mut scene,
                        &view,
                        time(index),
                        if index + 1 == count {
                            1.0
                        } else {
                            0.75 * strength
                        },
                    );
                }
                scene
            }
            Layout::Strip => {
                let columns = count.min(if count <= 4 {
                    count
                } else {
                    count.div_ceil(count.div_ceil(4))
                });
                let rows = count.div_ceil(columns);
                let each = width / columns as f64;
                let (size, height) = (CAPTION, self.height(each));
                let step = height + 2.0 * size;
                let mut scene = Scene::new(width, rows as f64 * step);
                for index in 0..count {
                    let corner = [
                        (index % columns) as f64 * each,
                        (index / columns) as f64 * step,
                    ];
                    let view = self.view(corner, [each, height]);
                    self.draw_backdrop(&mut scene, &view);
                    self.draw_pose(&mut scene, &view, time(index), 1.0);
                    let at = [corner[0] + each / 2.0, corner[1] + height + 1.1 * size];
                    let text = font::fit(&time_words(time(index), self.span()), size, each);
                    scene.label("time", at, vec![Run::plain(text)], size, Anchor::Middle);
                }
                scene
            }
        })
    }

    /// What does not move: guides of the ground, traces.
    fn draw_backdrop(&self, scene: &mut Scene, view: &View) {
        for (index, trace) in self.traces.iter().enumerate() {
            let pen = Pen {
                dash: &[],
                ..style::style(index + 1, 0.35 * view.bar).pen
            };
            scene.line(
                "trace",
                trace
                    .iter()
                    .map(|place| view.place(*place))
                    .collect::<Vec<_>>(),
                pen,
            );
        }
        for (joint, slide) in self.drawing.joints.iter().zip(&self.slides) {
            if let (Kind::Guide { axis }, 0) = (joint.kind, joint.between[0].0) {
                let ends = guide_ends(joint.between[0].1, axis, *slide).map(|end| view.place(end));
                symbols::ground_guide(scene, ends, view.bar);
            }
        }
    }

    /// Bodies, springs and joints at a time; nothing in a gap.
    fn draw_pose(&self, scene: &mut Scene, view: &View, time: f64, strength: f64) {
        let Some(pose) = self.poses.at(time) else {
            return;
        };
        let at = |(body, point): BodyPoint| view.place(global(pose[body], point));
        let black = Pen::new(Ink::grey(20).faded(strength), 0.22 * view.bar);
        for (joint, slide) in self.drawing.joints.iter().zip(&self.slides) {
            match joint.kind {
                Kind::Guide { axis } if joint.between[0].0 != 0 => {
                    let (body, point) = joint.between[0];
                    let ends = guide_ends(point, axis, *slide).map(|end| at((body, end)));
                    scene.line(
                        "guide",
                        ends,
                        Pen {
                            dash: &[],
                            width: 0.7 * view.bar,
                            ink: Ink::grey(150).faded(strength),
                        },
                    );
                }
                Kind::Gear { ratio } => {
                    let ends = joint.between.map(|(body, point)| global(pose[body], point));
                    for ((place, radius), (body, _)) in ends
                        .into_iter()
                        .zip(pitch_radii(ratio, ends).unwrap_or_default())
                        .zip(joint.between)
                    {
                        symbols::wheel(
                            scene,
                            view.place(place),
                            radius * view.scale,
                            -pose[body][2],
                            black,
                        );
                    }
                }
                Kind::Guide { .. } | Kind::Revolute | Kind::Fixed => {}
            }
        }
        for (index, (body, pose)) in self.drawing.bodies.iter().zip(&pose).enumerate().skip(1) {
            let corners: Vec<Place> = body
                .points
                .iter()
                .map(|point| view.place(global(*pose, *point)))
                .collect();
            let fill = style::style(index, 1.0).pen.ink.faded(0.45 * strength);
            scene.area(
                "body",
                symbols::rounded_hull(&corners, view.bar),
                Some(fill),
                Some(black),
            );
        }
        for spring in &self.drawing.springs {
            let [from, to] = spring.map(at);
            symbols::spring(
                scene,
                [from, to],
                view.bar,
                Pen {
                    width: 0.3 * view.bar,
                    ..black
                },
            );
            for ((body, _), place) in spring.iter().zip([from, to]) {
                if *body == 0 {
                    symbols::support(scene, place, view.bar, black);
                }
                scene.circle("pin", place, 0.4 * view.bar, Some(black.ink), None);
            }
        }
        for joint in &self.drawing.joints {
            draw_joint(scene, joint, joint.between.map(at), view, &pose, black);
        }
        for (index, trace) in self.drawing.traces.iter().enumerate() {
            scene.circle(
                "traced",
                at(*trace),
                0.5 * view.bar,
                Some(style::style(index + 1, 1.0).pen.ink.faded(strength)),
                None,
            );
        }
    }
}

/// The sign of a joint.
fn draw_joint(
    scene: &mut Scene,
    joint: &Joint,
    [first, second]: [Place; 2],
    view: &View,
    pose: &[Pose],
    pen: Pen,
) {
    let white = Some(Ink::grey(255));
    let on_ground = joint.between.iter().any(|(body, _)| *body == 0);
    match joint.kind {
        Kind::Revolute => {
            if on_ground {
                symbols::support(scene, first, view.bar, pen);
            }
            scene.circle("pin", first, 0.62 * view.bar, white, Some(pen));
            // A clearance that can be seen is seen.
            if (first[0] - second[0]).hypot(first[1] - second[1]) > 0.3 * view.bar {
                scene.circle("pin", second, 0.62 * view.bar, white, Some(pen));
            }
        }
        Kind::Guide { .. } => {
            let [x, y] = direction(joint, pose);
            symbols::block(scene, second, [x, -y], view.bar, pen);
            scene.circle("pin", second, 0.45 * view.bar, Some(pen.ink), None);
        }
        Kind::Fixed => {
            if on_ground {
                symbols::support(scene, first, view.bar, pen);
            }
            let h = 0.7 * view.bar;
            let [x, y] = first;
            let corners = [
                [x - h, y - h],
                [x + h, y - h],
                [x + h, y + h],
                [x - h, y + h],
            ];
            scene.area("weld", corners, Some(pen.ink), None);
        }
        Kind::Gear { .. } => {}
    }
}

/// Unit vector of a guide, global.
fn direction(joint: &Joint, pose: &[Pose]) -> [f64; 2] {
    let Kind::Guide { axis: [u, v] } = joint.kind else {
        return [1.0, 0.0];
    };
    let length = u.hypot(v).max(f64::MIN_POSITIVE);
    global(
        [0.0, 0.0, pose[joint.between[0].0][2]],
        [u / length, v / length],
    )
}

/// The slide before any is known. A guide on a moving body reaches to the body's point: else it would float beside the body.
fn first_slide(joint: &Joint) -> [f64; 2] {
    if joint.between[0].0 == 0 {
        [f64::INFINITY, f64::NEG_INFINITY]
    } else {
        [0.0, 0.0]
    }
}

/// Both ends of a guide in the frame of its body: as far as the other point comes.
fn guide_ends(point: [f64; 2], [u, v]: [f64; 2], [low, high]: [f64; 2]) -> [[f64; 2]; 2] {
    let length = u.hypot(v).max(f64::MIN_POSITIVE);
    let end = |s: f64| [point[0] + s * u / length, point[1] + s * v / length];
    if low > high {
        [point, point]
    } else {
        [end(low), end(high)]
    }
}

/// Radii of the pitch circles of two wheels with these centres: |ω₁| r₁ = |ω₂| r₂, and r₁ + r₂ or |r₁ − r₂| is the distance.
fn pitch_radii(ratio: f64, [a, b]: [[f64; 2]; 2]) -> Option<[f64; 2]> {
    let distance = (a[0] - b[0]).hypot(a[1] - b[1]);
    let second = distance / (1.0 - ratio).abs();
    let radii = [ratio.abs() * second, second];
    radii
        .iter()
        .all(|radius| radius.is_finite() && *radius < 1e3 * distance)
        .then_some(radii)
}

/// The path of a point; interrupted at gaps.
fn path((body, point): BodyPoint, rows: &[Option<Vec<Pose>>]) -> Vec<Vec<[f64; 2]>> {
    let parts = rows.split(Option::is_none);
    let path = |rows: &[Option<Vec<Pose>>]| {
        rows.iter()
            .flatten()
            .map(|pose| global(pose[body], point))
            .collect()
    };
    parts
        .map(path)
        .filter(|path: &Vec<[f64; 2]>| path.len() > 1)
        .collect()
}

/// Letters that can be read beside a picture of that width \[pt\].
fn font_size(width: f64) -> f64 {
    (0.032 * width).clamp(7.0, 14.0)
}

/// `t = 0.52 s`, as many digits as the span asks for.
fn time_words(time: f64, [first, last]: [f64; 2]) -> String {
    let decimals = if last > first {
        (2.0 - (last - first).log10().floor()).clamp(0.0, 12.0) as usize
    } else {
        2
    };
    format!("t = {} s", words::minus(&format!("{time:.decimals$}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wheels_touch_and_roll() {
        for (ratio, radii) in [
            (-2.0, [2.0, 1.0]),
            (-0.5, [1.0, 2.0]),
            (3.0, [4.5, 1.5]),
            (0.25, [1.0, 4.0]),
        ] {
            let found = pitch_radii(ratio, [[1.0, 1.0], [4.0, 1.0]]).expect("wheels");
            assert!(
                (0..2).all(|i| (found[i] - radii[i]).abs() < 1e-12),
                "{ratio}: {found:?}"
            );
        }
        assert_eq!(pitch_radii(1.0, [[0.0, 0.0], [1.0, 0.0]]), None);
    }

    #[test]
    fn times_have_digits_for_their_span() {
        assert_eq!(time_words(0.5, [0.0, 2.0]), "t = 0.50 s");
        assert_eq!(time_words(0.0123, [0.0, 0.05]), "t = 0.0123 s");
        assert_eq!(time_words(0.0, [0.0, 0.0]), "t = 0.00 s");
    }
}
