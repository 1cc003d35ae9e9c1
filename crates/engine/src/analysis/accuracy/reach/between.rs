//! Between two displaced positions: cubics that meet q and c, and their derivatives by y, at both.

use super::Displaced;

/// A way from one displaced position to another.
pub(in super::super) struct Between<'d> {
    from: &'d Displaced,
    to: &'d Displaced,
}

/// Halvings until a place on the way is known.
const HALVINGS: usize = 40;

impl<'d> Between<'d> {
    pub fn new(from: &'d Displaced, to: &'d Displaced) -> Self {
        Between { from, to }
    }

    /// Whether a deviation lies between.
    pub fn holds(&self, y: f64) -> bool {
        let (low, high) = (self.from.y.min(self.to.y), self.from.y.max(self.to.y));
        (low..=high).contains(&y)
    }

    /// Values and tangents of q (n) and c.
    fn ends(&self, k: usize) -> [f64; 4] {
        let of = |at: &Displaced| *at.q.get(k).unwrap_or(&at.c);
        let way = self.to.y - self.from.y;
        [
            of(self.from),
            way * self.from.ahead[k],
            of(self.to),
            way * self.to.ahead[k],
        ]
    }

    /// c at a part of the way.
    fn share(&self, part: f64) -> f64 {
        cubic(self.ends(self.from.q.len()), part)
    }

    /// The greatest share on the way, and at which part of it.
    fn top(&self) -> [f64; 2] {
        let ends = self.ends(self.from.q.len());
        let [a, b, c, d] = ends;
        if b <= 0.0 || d >= 0.0 {
            return if a > c { [0.0, a] } else { [1.0, c] };
        }
        // Where the derivative of the cubic changes its sign.
        let (bend, twist) = coefficients(ends);
        let part = half(
            |part| b + part * (2.0 * bend + 3.0 * part * twist) > 0.0,
            1.0,
        );
        [part, self.share(part)]
    }

    /// The greatest share on the way.
    pub fn most(&self) -> f64 {
        self.top()[1]
    }

    /// A guess of the position where a share is first reached; none where it is not on the way.
    pub fn at_share(&self, share: f64) -> Option<Displaced> {
        let [top, most] = self.top();
        if self.from.c > share || most < share {
            return None;
        }
        let part = half(|part| self.share(part) < share, top);
        let near = if part < 0.5 { self.from } else { self.to };
        let mut found = near.clone();
        for (k, q) in found.q.iter_mut().enumerate() {
            *q = cubic(self.ends(k), part);
        }
        found.c = share;
        found.y = self.from.y + part * (self.to.y - self.from.y);
        Some(found)
    }
}

/// Where what holds at 0 holds no more, by halving the way to `end`.
fn half(holds: impl Fn(f64) -> bool, end: f64) -> f64 {
    let (mut low, mut high) = (0.0, end);
    for _ in 0..HALVINGS {
        let part = 0.5 * (low + high);
        if holds(part) {
            low = part;
        } else {
            high = part;
        }
    }
    high
}

/// At a part of the way, from values and tangents at both ends.
fn cubic(ends: [f64; 4], part: f64) -> f64 {
    let [a, b, _, _] = ends;
    let (bend, twist) = coefficients(ends);
    a + part * (b + part * (bend + part * twist))
}

/// Of the square and of the third power.
fn coefficients([a, b, c, d]: [f64; 4]) -> (f64, f64) {
    (3.0 * (c - a) - 2.0 * b - d, 2.0 * (a - c) + b + d)
}
