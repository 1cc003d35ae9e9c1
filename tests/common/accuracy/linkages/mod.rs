//! Random linkages whose positions have closed forms, with all that may be off: a crank, perhaps a wheel in mesh with it, and dyads
//! and slotted rockers on what is there. Nothing of the engine.

mod maker;

pub use maker::linkage;
use serde_json::Value;

type Vector = [f64; 2];
/// Place \[m\] and angle \[rad\].
type Frame = [f64; 3];

/// What may be off: one or two of the numbers of a deviation.
#[derive(Debug, Clone, Copy)]
pub enum Source {
    /// From one end to the other.
    Line { at: usize, ends: [f64; 2] },
    /// Any direction, up to a radius.
    Disc { at: usize, radius: f64 },
}

/// A length, and the deviation that it has.
#[derive(Debug, Clone, Copy)]
struct Number(f64, Option<usize>);

/// A point of a body, and its zone.
#[derive(Debug, Clone, Copy)]
struct Point([Number; 2], Option<usize>);

/// How a body is led; the bodies before it are numbered, the ground first.
#[derive(Debug, Clone, Copy)]
enum Led {
    /// In mesh with the crank: ratio, and angle at angle 0 of the crank.
    Wheel {
        ratio: f64,
        angle: f64,
        centre: Point,
        gap: Option<usize>,
    },
    /// Two links that meet: where each hangs (body, point, gap), how long each is, the zone of the second one's end, the gap where
    /// they meet, and the side to which they are bent.
    Dyad {
        hang: [(usize, Point, Option<usize>); 2],
        long: [Number; 2],
        zone: Option<usize>,
        gap: Option<usize>,
        side: f64,
    },
    /// A rocker whose slot goes through a point of a body: its pivot and gap, the slot's zone and play.
    Rocker {
        pivot: (Point, Option<usize>),
        through: (usize, Point),
        zone: Option<usize>,
        play: Option<usize>,
    },
}

/// What is asked: the angle of a body, or the place of its point along an axis.
#[derive(Debug, Clone, Copy)]
enum Asked {
    Angle(usize),
    Place(usize, Point, usize),
}

/// A linkage, and the model that says the same.
pub struct Linkage {
    pub sources: Vec<Source>,
    /// How many numbers a deviation has.
    pub count: usize,
    pub model: Value,
    angle: f64,
    driver: Option<usize>,
    pivot: Option<usize>,
    led: Vec<Led>,
    asked: Vec<Asked>,
}

fn turn([x, y]: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

fn less(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

fn pair(by: &[f64], at: Option<usize>) -> Vector {
    at.map_or([0.0; 2], |at| [by[at], by[at + 1]])
}

impl Number {
    fn off(self, by: &[f64]) -> f64 {
        self.0 + self.1.map_or(0.0, |at| by[at])
    }
}

impl Point {
    fn at(self, [x, y, angle]: Frame, by: &[f64]) -> Vector {
        let own = turn(self.0.map(|number| number.off(by)), angle);
        add(add([x, y], own), pair(by, self.1))
    }
}

impl Linkage {
    /// Places of the bodies, ground and crank first; NaN where they do not meet.
    fn frames(&self, by: &[f64]) -> Vec<Frame> {
        let [x, y] = pair(by, self.pivot);
        let angle = self.angle + self.driver.map_or(0.0, |at| by[at]);
        let mut frames = vec![[0.0; 3], [x, y, angle]];
        for led in &self.led {
            match *led {
                Led::Wheel {
                    ratio,
                    angle,
                    centre,
                    gap,
                } => {
                    let [x, y] = add(centre.at(frames[0], by), pair(by, gap));
                    let [u, v] = centre.0.map(|number| number.0);
                    let [dx, dy] = less([x, y], [frames[1][0], frames[1][1]]);
                    let leaned = (u * dy - v * dx) / (u * u + v * v);
                    let turned = angle + ratio * frames[1][2] + (1.0 - ratio) * leaned;
                    frames.push([x, y, turned]);
                }
                Led::Dyad {
                    hang,
                    long,
                    zone,
                    gap,
                    side,
                } => {
                    let [a, c] = hang
                        .map(|(body, point, gap)| add(point.at(frames[body], by), pair(by, gap)));
                    let [l, m] = long.map(|long| long.off(by));
                    let shifted = less(add(c, pair(by, zone)), pair(by, gap));
                    let [x, y] = less(shifted, a);
                    let d = x.hypot(y);
                    let bent = ((l * l + d * d - m * m) / (2.0 * l * d)).acos();
                    let first = y.atan2(x) + side * bent;
                    let [u, v] = less(add(a, turn([l, 0.0], first)), shifted);
                    frames.push([a[0], a[1], first]);
                    frames.push([c[0], c[1], v.atan2(u)]);
                }
                Led::Rocker {
                    pivot: (point, gap),
                    through: (body, through),
                    zone,
                    play,
                } => {
                    let c = add(point.at(frames[0], by), pair(by, gap));
                    let [x, y] = less(through.at(frames[body], by), add(c, pair(by, zone)));
                    let lean = play.map_or(0.0, |at| by[at]) / x.hypot(y);
                    frames.push([c[0], c[1], y.atan2(x) + lean.asin()]);
                }
            }
        }
        frames
    }

    /// An output with these deviations, by number.
    pub fn value(&self, output: usize, by: &[f64]) -> f64 {
        let frames = self.frames(by);
        match self.asked[output] {
            Asked::Angle(body) => frames[body][2],
            Asked::Place(body, point, axis) => point.at(frames[body], by)[axis],
        }
    }

    /// The deviation of an output from its nominal value; angles by less than half a turn.
    pub fn deviation(&self, output: usize, by: &[f64]) -> f64 {
        let off = self.value(output, by) - self.value(output, &vec![0.0; self.count]);
        match self.asked[output] {
            Asked::Angle(_) => off.sin().atan2(off.cos()),
            Asked::Place(..) => off,
        }
    }

    pub fn outputs(&self) -> usize {
        self.asked.len()
    }
}
