//! Change points: located by a test function through regular points, bridged by an osculating polynomial.

use super::parameter::{Parameter, SingularKind, SingularPosition};
use super::path::{Path, Window};
use super::walk::Walker;
use linkdyn_linear::hermite::{Node, Osculating, interpolate};

/// Half width of the window around a change point, in steps of the path there.
const WINDOW: f64 = 2.0;
/// Regular points of a window on each side, in half widths; within the first one the polynomial is used.
const WINDOW_NODES: [f64; 3] = [0.4, 0.7, 1.0];
/// Regular points for locating, on each side, in half widths.
const TEST_NODES: [f64; 4] = [0.4, 0.6, 0.8, 1.0];
/// Largest accepted difference of a window's polynomial from the constraints' solution [rad or sizes].
const WINDOW_ERROR: f64 = 1e-12;
/// Change points nearer than this are one [half widths].
const SAME: f64 = 1e-9;
/// Smallest singular value (of the scaled Jacobian) at a located position, by that at the window's edge, to count.
const VANISHES: f64 = 1e-6;
/// Distance from a change point, in half widths, at which its self-stress is read off.
const BESIDE: f64 = 1e-5;

impl Path {
    /// Locates the change point in the gap after node `gap` and builds its window; a sign that proves to be no loss of
    /// rank (a pole of the test function) is passed over.
    pub(super) fn bridge(&mut self, walker: &mut Walker, gap: usize) {
        let (a, b) = (self.nodes[gap].s, self.nodes[gap + 1].s);
        let around = |k: usize| self.nodes[k.min(self.nodes.len() - 1)].s;
        let step = (b - a)
            .max(around(gap + 2) - b)
            .max(a - around(gap.saturating_sub(1)));
        let width = WINDOW * step;
        // One choice of rows for the whole window, so that the test function is one function.
        walker.set(b);
        if walker
            .driven
            .prepare(&self.nodes[gap + 1].q, &walker.inputs)
            .is_err()
        {
            return;
        }
        // Vectors of the test function: the null vectors seen from one side.
        let Some(vectors) = self.null_vectors(walker, b) else {
            return;
        };
        let Some((centre, edge)) = self.locate(walker, (a, b), width, &vectors) else {
            return;
        };
        let at_root = self.test_at_guess(walker, centre, &vectors);
        if at_root.is_some_and(|test| test.abs() > VANISHES.sqrt() * edge) {
            return;
        }
        if self
            .singular
            .iter()
            .any(|p| (p.s - centre).abs() < SAME * width)
        {
            return;
        }
        // Placed first: the window keeps its distance from the others.
        let here = self.singular.len();
        self.singular.push(SingularPosition {
            kind: SingularKind::ChangePoint,
            s: centre,
            self_stress: Vec::new(),
        });
        let window = self.window(walker, centre, width);
        // Nobody asks for that of an independent coordinate's path.
        if self.parameter != Parameter::Coordinate {
            let own = window.as_ref().and_then(|own| own.self_stress(walker));
            let any = || vec![1.0; walker.driven.system.m()];
            self.singular[here].self_stress = own.unwrap_or_else(any);
        }
        self.windows.extend(window);
    }

    /// The root of the test function in the gap from `a` to `b`, and the function's size at the window's edge; `None` if its
    /// sign changes through a pole.
    fn locate(
        &self,
        walker: &mut Walker,
        (a, b): (f64, f64),
        width: f64,
        vectors: &NullVectors,
    ) -> Option<(f64, f64)> {
        let (low, high) = self.covered();
        let (mut centre, mut edge) = (0.5 * (a + b), 0.0_f64);
        for (pass, width) in [width, 0.25 * width, 0.0625 * width]
            .into_iter()
            .enumerate()
        {
            let (mut x, mut f) = (Vec::new(), Vec::new());
            let nodes = TEST_NODES;
            let sides = nodes.map(|node| -node).into_iter().chain(nodes);
            for s in sides.map(|node| centre + node * width) {
                if s < low || s > high {
                    continue;
                }
                if let Some(value) = self.test_at(walker, s, vectors) {
                    x.push(s);
                    f.push(value);
                }
            }
            if x.len() < 4 {
                break;
            }
            if pass == 0 {
                edge = linkdyn_linear::math::max_abs(&f);
            }
            let root = root_of(&x, &f, centre, width)?;
            let margin = 0.01 * (b - a);
            if !(a - margin..=b + margin).contains(&root) {
                return None;
            }
            centre = root;
        }
        Some((centre, edge))
    }

    fn solve_at(&self, walker: &mut Walker, s: f64) -> Option<Node> {
        let q = self.regular_at(s)?;
        walker.node(s, q).ok().map(|(node, _)| node)
    }

    /// Factors at the position at `s`.
    fn factor_at(&self, walker: &mut Walker, s: f64) -> Option<()> {
        let mut q = self.regular_at(s)?;
        walker.corrected(s, &mut q).ok().map(|_| ())
    }

    /// An uncorrected position.
    fn regular_at(&self, s: f64) -> Option<Vec<f64>> {
        let [mut q, mut d, mut dd] = std::array::from_fn(|_| self.nodes[0].q.clone());
        self.regular(s, [&mut q, &mut d, &mut dd])?;
        Some(q)
    }

    fn null_vectors(&self, walker: &mut Walker, s: f64) -> Option<NullVectors> {
        self.factor_at(walker, s)?;
        let condition = walker.condition(None);
        Some(NullVectors {
            right: condition.right,
            left: condition.left,
        })
    }

    fn test_at(&self, walker: &mut Walker, s: f64, vectors: &NullVectors) -> Option<f64> {
        self.factor_at(walker, s)?;
        let value = walker.driven.test_function(&vectors.right, &vectors.left);
        value.is_finite().then_some(value)
    }

    /// The test function at an uncorrected position (at the singular position itself nothing can be corrected).
    fn test_at_guess(&self, walker: &mut Walker, s: f64, vectors: &NullVectors) -> Option<f64> {
        let q = self.regular_at(s)?;
        walker.set(s);
        walker.driven.evaluation.set_position(&q);
        walker.driven.factor(&walker.inputs).ok()?;
        Some(walker.driven.test_function(&vectors.right, &vectors.left))
    }

    /// The smooth branch around a change point; the width shrinks until the polynomial meets the constraints.
    fn window(&self, walker: &mut Walker, centre: f64, mut width: f64) -> Option<Window> {
        let (low, high) = self.covered();
        for other in self.singular.iter().filter(|p| p.s != centre) {
            width = width.min(0.45 * (other.s - centre).abs());
        }
        let mut best: Option<(f64, Window)> = None;
        for _ in 0..6 {
            let mut nodes = Vec::new();
            for side in [-1.0, 1.0] {
                for node in WINDOW_NODES {
                    let s = centre + side * node * width;
                    if s >= low && s <= high {
                        nodes.extend(self.solve_at(walker, s));
                    }
                }
            }
            if nodes.len() >= 4 {
                let branch = Osculating::new(&nodes, centre);
                let mut error = 0.0_f64;
                let n = nodes[0].q.len();
                let (mut q, mut d, mut dd) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
                for check in [-0.55, -0.3, 0.3, 0.55] {
                    let s = centre + check * width;
                    if let Some(node) = self.solve_at(walker, s) {
                        branch.eval(s, &mut q, &mut d, &mut dd);
                        let off: Vec<f64> = q.iter().zip(&node.q).map(|(a, b)| a - b).collect();
                        error = error.max(walker.driven.system.scaled_norm(&off));
                    }
                }
                let window = Window {
                    s: centre,
                    radius: WINDOW_NODES[0] * width,
                    width,
                    branch: Some(branch),
                };
                // What is left when a smaller width does not help any more is round-off.
                let better = best.as_ref().is_none_or(|(least, _)| error < 0.5 * least);
                if better {
                    best = Some((error, window));
                }
                if error <= WINDOW_ERROR || !better {
                    break;
                }
            }
            width *= 0.7;
        }
        best.map(|(_, window)| window)
    }
}

struct NullVectors {
    right: Vec<f64>,
    left: Vec<f64>,
}

impl Window {
    /// The self-stress of the change point: the left null vector a hair beside it, where the Jacobian has factors still.
    fn self_stress(&self, walker: &mut Walker) -> Option<Vec<f64>> {
        let system = walker.driven.system;
        let n = system.n();
        let (mut q, mut d, mut dd) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let s = self.s + BESIDE * self.width;
        self.branch.as_ref()?.eval(s, &mut q, &mut d, &mut dd);
        walker.set(s);
        walker.driven.evaluation.set_position(&q);
        walker.driven.factor(&walker.inputs).ok()?;
        let condition = walker.condition(None);
        let mut self_stress = vec![0.0; system.m()];
        for (value, &row) in condition.left.iter().zip(walker.driven.active_rows()) {
            if let Some(stress) = self_stress.get_mut(row) {
                *stress = value / system.row_scale(row);
            }
        }
        Some(self_stress)
    }
}

/// Root of the polynomial through (x, f) nearest to `centre`, by the secant method within `width`.
fn root_of(x: &[f64], f: &[f64], centre: f64, width: f64) -> Option<f64> {
    let value = |s: f64| interpolate(x, f, s);
    let (mut s0, mut s1) = (centre - 0.1 * width, centre + 0.1 * width);
    let (mut f0, mut f1) = (value(s0), value(s1));
    for _ in 0..60 {
        let s2 = s1 - f1 * (s1 - s0) / (f1 - f0);
        if !s2.is_finite() || (s2 - centre).abs() > 2.0 * width {
            return None;
        }
        let done = (s2 - s1).abs() <= 4.0 * f64::EPSILON * s2.abs().max(width);
        (s0, f0) = (s1, f1);
        (s1, f1) = (s2, value(s2));
        if done || f1 == 0.0 {
            return Some(s1);
        }
        if f1 == f0 {
            return (f1.abs() < 1e-12 * linkdyn_linear::math::max_abs(f)).then_some(s1);
        }
    }
    Some(s1)
}
