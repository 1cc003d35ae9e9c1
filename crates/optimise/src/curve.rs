//! How far given points are from a curve that is known at nodes.
//!
//! ```text
//! between nodes   the quintic through place, velocity and acceleration at both: error h⁶ f⁗″/46080
//! foot of a point the nearest place of the curve: (P − T)·P′ = 0, or an end
//! residual        ±|P − T|, positive where T is on the right of the curve
//! ```
//!
//! With its sign the residual passes zero smoothly, and its derivative by a design is N·∂P/∂p at the foot held fast: the foot itself
//! drops out, for P − T is normal to the curve. So feet are no unknowns of the search (variable projection; Golub and Pereyra 1973).

/// A place of the curve with its derivatives by the parameter s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Parameter, which rises from node to node.
    pub s: f64,
    /// Place.
    pub p: [f64; 2],
    /// First derivative.
    pub d: [f64; 2],
    /// Second derivative.
    pub dd: [f64; 2],
}

/// Steps of Newton's method to a foot, at most.
const MOST_STEPS: usize = 30;
/// Cosine between distance and curve above which the place is an end.
const ASKEW: f64 = 1e-4;
/// Distances below this part of a piece have no direction.
const ROUND_OFF: f64 = 1e-9;
/// So many of the nearest pieces are looked at.
const PIECES: usize = 3;

/// The residual of each point; `None` if there are fewer than two nodes.
pub fn residuals(nodes: &[Node], points: &[[f64; 2]]) -> Option<Vec<f64>> {
    if nodes.len() < 2 {
        return None;
    }
    Some(
        points
            .iter()
            .map(|point| foot(nodes, *point).residual)
            .collect(),
    )
}

/// The place of the curve at a parameter between its ends; `None` if there are fewer than two nodes.
pub fn place(nodes: &[Node], s: f64) -> Option<[f64; 2]> {
    let after = nodes.partition_point(|node| node.s <= s);
    let k = after.clamp(1, nodes.len().checked_sub(1)?.max(1));
    let (a, b) = (nodes.get(k - 1)?, nodes.get(k)?);
    Some(Piece::new(a, b).at((s - a.s) / (b.s - a.s))[0])
}

/// The nearest place of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// Its parameter.
    pub s: f64,
    /// Distance with its sign.
    pub residual: f64,
    /// How the distance changes as the place moves: the normal of the curve, to its left, or at an end the direction to the place.
    pub normal: [f64; 2],
}

/// The foot of a point on a curve with at least two nodes.
pub fn foot(nodes: &[Node], point: [f64; 2]) -> Foot {
    // The nearest pieces by the distance of their nodes' chord.
    let mut near: Vec<(f64, usize)> = nodes
        .windows(2)
        .enumerate()
        .map(|(k, pair)| (to_chord(pair[0].p, pair[1].p, point), k))
        .collect();
    let count = PIECES.min(near.len());
    near.select_nth_unstable_by(count - 1, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    near.truncate(count);
    near.sort_by_key(|one| one.1);
    let feet = near
        .iter()
        .map(|(_, k)| in_piece(&nodes[*k], &nodes[k + 1], point));
    let nearest = feet.min_by(|a, b| a.residual.abs().total_cmp(&b.residual.abs()));
    nearest.unwrap_or(Foot {
        s: nodes[0].s,
        residual: f64::INFINITY,
        normal: [0.0; 2],
    })
}

/// Square of the distance from a chord.
fn to_chord(a: [f64; 2], b: [f64; 2], t: [f64; 2]) -> f64 {
    let (ab, at) = (minus(b, a), minus(t, a));
    let length = dot(ab, ab);
    let part = match length > 0.0 {
        true => (dot(at, ab) / length).clamp(0.0, 1.0),
        false => 0.0,
    };
    let off = [at[0] - part * ab[0], at[1] - part * ab[1]];
    dot(off, off)
}

/// A quintic of both coordinates, in u from 0 to 1.
struct Piece([[f64; 6]; 2]);

impl Piece {
    fn new(a: &Node, b: &Node) -> Self {
        let h = b.s - a.s;
        Piece([0, 1].map(|k| {
            let (v0, c0) = (h * a.d[k], 0.5 * h * h * a.dd[k]);
            let gap = b.p[k] - (a.p[k] + v0 + c0);
            let slope = h * b.d[k] - (v0 + 2.0 * c0);
            let bend = h * h * b.dd[k] - 2.0 * c0;
            let c3 = 10.0 * gap - 4.0 * slope + 0.5 * bend;
            let c4 = -15.0 * gap + 7.0 * slope - bend;
            let c5 = 6.0 * gap - 3.0 * slope + 0.5 * bend;
            [a.p[k], v0, c0, c3, c4, c5]
        }))
    }

    /// Place, first and second derivative by u.
    fn at(&self, u: f64) -> [[f64; 2]; 3] {
        let each = [0, 1].map(|k| {
            let c = &self.0[k];
            let (mut p, mut d, mut dd) = (0.0, 0.0, 0.0);
            for own in c.iter().rev() {
                dd = dd * u + d;
                d = d * u + p;
                p = p * u + own;
            }
            [p, d, 2.0 * dd]
        });
        [0, 1, 2].map(|k| [each[0][k], each[1][k]])
    }
}

/// The nearest place of a piece.
fn in_piece(a: &Node, b: &Node, t: [f64; 2]) -> Foot {
    let piece = Piece::new(a, b);
    let off = |u: f64| {
        let [p, d, dd] = piece.at(u);
        let gap = minus(p, t);
        (gap, d, dot(gap, d), dot(d, d) + dot(gap, dd))
    };
    let square = |u: f64| {
        let gap = off(u).0;
        dot(gap, gap)
    };
    // From the best of some places, Newton's method where that leads down, else bisection of the slope.
    let start = (0..=4).map(|k| 0.25 * f64::from(k));
    let mut u = start
        .min_by(|a, b| square(*a).total_cmp(&square(*b)))
        .unwrap_or(0.0);
    let (mut low, mut high) = ((u - 0.25).max(0.0), (u + 0.25).min(1.0));
    for _ in 0..MOST_STEPS {
        let (_, _, slope, bend) = off(u);
        if slope > 0.0 {
            high = u;
        } else {
            low = u;
        }
        let newton = u - slope / bend;
        let next = match bend > 0.0 && newton.is_finite() {
            true => newton.clamp(low, high),
            false => 0.5 * (low + high),
        };
        let moved = (next - u).abs();
        u = next;
        if moved <= 1e-15 {
            break;
        }
    }
    let (gap, d, ..) = off(u);
    let side = d[0] * gap[1] - d[1] * gap[0];
    let (distance, speed) = (gap[0].hypot(gap[1]), d[0].hypot(d[1]));
    let residual = distance.copysign(side);
    let normal = match dot(gap, d).abs() > (ASKEW * distance + ROUND_OFF * speed) * speed {
        true => [gap[0] / residual, gap[1] / residual],
        false => [-d[1] / speed, d[0] / speed],
    };
    Foot {
        s: a.s + u * (b.s - a.s),
        residual,
        normal,
    }
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn ellipse(count: usize) -> Vec<Node> {
        let node = |k: usize| {
            let s = TAU * k as f64 / (count - 1) as f64;
            let (sin, cos) = s.sin_cos();
            Node {
                s,
                p: [3.0 * cos, sin],
                d: [-3.0 * sin, cos],
                dd: [-3.0 * cos, -sin],
            }
        };
        (0..count).map(node).collect()
    }

    /// h⁶·3/46080 of the pieces with h = 2π/72.
    const BETWEEN: f64 = 3e-11;

    #[test]
    fn feet_on_an_ellipse_are_those_of_its_normals() {
        let nodes = ellipse(73);
        for k in 0..40 {
            let s = 0.03 + 0.15 * f64::from(k);
            let (sin, cos) = s.sin_cos();
            let length = cos.hypot(3.0 * sin);
            // Outside the curve runs counterclockwise, and the point is on its right.
            for distance in [-0.1, 0.0, 1e-6, 0.7] {
                let t = [
                    3.0 * cos + distance * cos / length,
                    sin + distance * 3.0 * sin / length,
                ];
                let found = foot(&nodes, t);
                assert!(
                    (found.residual - distance).abs() <= BETWEEN,
                    "{s}, {distance}: {found:?}"
                );
                let normal = [-cos / length, -3.0 * sin / length];
                let off = minus(found.normal, normal);
                assert!(dot(off, off).sqrt() < 1e-5, "{s}, {distance}: {found:?}");
                if distance == 0.7 {
                    let off = (found.s - s).abs();
                    assert!(off < 1e-6 || (off - TAU).abs() < 1e-6, "{s}: {found:?}");
                }
            }
        }
    }

    #[test]
    fn places_between_nodes_are_those_of_the_curve() {
        let nodes = ellipse(73);
        for s in [0.0, 0.01, 1.0, 4.0, TAU] {
            let found = place(&nodes, s).expect("nodes");
            let off = (found[0] - 3.0 * s.cos()).hypot(found[1] - s.sin());
            assert!(off <= BETWEEN, "{s}: {off}");
        }
        assert_eq!(place(&nodes[..1], 0.0), None);
        assert_eq!(place(&[], 0.0), None);
    }

    #[test]
    fn beyond_an_end_the_end_is_nearest() {
        let nodes = &ellipse(73)[..19];
        let found = foot(nodes, [-1.0, 1.0]);
        assert!((found.residual.abs() - 1.0).abs() < 1e-14, "{found:?}");
        assert_eq!(found.s, nodes[18].s);
        // The distance grows as the end goes away from the point.
        let off = minus(found.normal, [found.residual.signum(), 0.0]);
        assert!(dot(off, off).sqrt() < 1e-14, "{found:?}");
        assert_eq!(residuals(&nodes[..1], &[[0.0, 0.0]]), None);
    }
}
