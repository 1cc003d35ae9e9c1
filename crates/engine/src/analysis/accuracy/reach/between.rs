//! Between two displaced positions: cubics that meet q and c, and their derivatives by y, at both.

use super::Displaced;

/// A way from one displaced position to another.
pub(in super::super) struct Between<'d> {
    from: &'d Displaced,
    to: &'d Displaced,
}

/// A way shorter than this part of the deviation is narrow.
const NARROW: f64 = 0.02;
/// Positions on the way are known to less than this part of it.
const BEYOND: f64 = 0.01;
/// Halvings until a place on the way is known.
const HALVINGS: usize = 40;

impl<'d> Between<'d> {
    pub fn new(from: &'d Displaced, to: &'d Displaced) -> Self {
        Between { from, to }
    }

    /// Both positions.
    pub fn ends(&self) -> [&'d Displaced; 2] {
        [self.from, self.to]
    }

    /// Whether the way is a small part of the deviation.
    pub fn is_narrow(&self) -> bool {
        (self.to.y - self.from.y).abs() < NARROW * self.to.y.abs()
    }

    /// Whether a deviation lies between, or hardly beyond.
    pub fn holds(&self, y: f64) -> bool {
        let part = (y - self.from.y) / (self.to.y - self.from.y);
        (-BEYOND..=1.0 + BEYOND).contains(&part)
    }

    /// Values and tangents of q (n) and c.
    fn values(&self, k: usize) -> [f64; 4] {
        let way = self.to.y - self.from.y;
        let sign = match k < self.from.q.len() || self.from.is_turned == self.to.is_turned {
            true => 1.0,
            false => -1.0,
        };
        let of = |at: &Displaced| *at.q.get(k).unwrap_or(&at.c);
        let (from, to) = (of(self.from), sign * of(self.to));
        if !(self.from.is_smooth && self.to.is_smooth) {
            return [from, to - from, to, to - from];
        }
        [
            from,
            way * self.from.ahead[k],
            to,
            sign * way * self.to.ahead[k],
        ]
    }

    /// c at a part of the way.
    fn share(&self, part: f64) -> f64 {
        cubic(self.values(self.from.q.len()), part)
    }

    /// The greatest share on the way, and at which part of it.
    fn top(&self) -> [f64; 2] {
        let ends = self.values(self.from.q.len());
        let [a, b, c, d] = ends;
        if b <= 0.0 || d >= 0.0 {
            return if a > c { [0.0, a] } else { [1.0, c] };
        }
        // Where the derivative of the cubic changes its sign.
        let (bend, twist) = coefficients(ends);
        let part = half(
            |part| b + part * (2.0 * bend + 3.0 * part * twist) > 0.0,
            [0.0, 1.0],
        );
        [part, self.share(part)]
    }

    /// The greatest share on the way.
    pub fn most(&self) -> f64 {
        self.top()[1]
    }

    /// A guess of the position where c rises to a share; none where it does not on the way.
    pub fn up(&self, share: f64) -> Option<Displaced> {
        let [top, most] = self.top();
        let rises = self.from.c <= share && share <= most;
        rises.then(|| {
            let part = half(|part| self.share(part) < share, [0.0, top]);
            self.guess(part, share)
        })
    }

    /// A guess of the position where c rises to a share again, past where none is needed.
    pub fn again(&self, share: f64) -> Option<Displaced> {
        let [top, _] = self.top();
        (-self.share(1.0) >= share).then(|| {
            let part = half(|part| -self.share(part) < share, [top, 1.0]);
            self.guess(part, share)
        })
    }

    fn guess(&self, part: f64, share: f64) -> Displaced {
        let near = if part < 0.5 { self.from } else { self.to };
        let mut found = near.clone();
        for (k, q) in found.q.iter_mut().enumerate() {
            *q = cubic(self.values(k), part);
        }
        found.c = share;
        found.y = self.from.y + part * (self.to.y - self.from.y);
        found
    }
}

/// Where what holds at the first end holds no more, by halving the way to the other.
fn half(holds: impl Fn(f64) -> bool, [mut low, mut high]: [f64; 2]) -> f64 {
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
