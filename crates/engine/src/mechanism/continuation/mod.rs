//! The path of a driven mechanism: q(s), followed branch-safely over a range of its parameter s.
//!
//! s is the driver's value where there is one driver (then the path does not depend on the motion in time at all), else
//! time. From node to node the step is a prediction by the quintic through the last two nodes (error h⁶ q⁽⁶⁾/90), for a
//! coordinate by the polynomial of degree 8 through the last three (6·10⁻⁴ h⁹ q⁽⁹⁾), and a Newton correction; it is accepted only if the prediction was good, Newton contracted fast and the tangent is the
//! predicted one, so that by the Newton–Kantorovich theorem the solution found is the one the prediction belongs to. The
//! nodes are the path's own: nobody who asks for values can move them, so the branch does not depend on the outputs.
//! (Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, ch. 6.)
//!
//! A **change point** (J loses rank, motion goes on) is stepped over by the same prediction, found by the sign of det J or
//! of the test function 1/(rᵀ J⁻¹ l) on both sides, located by interpolating that function through regular points, and
//! bridged: near it q, q′, q″ come from an osculating polynomial through regular points on both sides, for there round-off
//! grows as 1/δ, 1/δ², 1/δ³. A **dead centre** (s turns back) is where steps shrink to nothing; it is located as the
//! root of ds/dp with the arc direction p as parameter, where the bordered matrix is regular.

mod bridge;
mod dead_centre;
mod few;
mod known;
mod parameter;
mod path;
mod six;
mod turn;
mod walk;

pub use parameter::{End, Parameter, SingularKind, SingularPosition};
use path::LastGap;
pub use path::{Branch, Path, Source, Window};
pub use turn::HALF_TURN;

use super::driven::{Driven, Failure};
use crate::system::Inputs;
use linkdyn_linear::hermite::Node;
use walk::{Mark, Walker};

/// Follows the path from (s, q) over [low, high]; what the parameter does not set is as in `inputs`.
///
/// `stop` is asked at each step, with s, whether to give up.
///
/// # Errors
/// When the start itself is singular or does not satisfy the constraints.
pub fn follow(
    driven: &mut Driven,
    (parameter, inputs): (Parameter, Inputs),
    start: (f64, &[f64]),
    range: (f64, f64),
    stop: &dyn Fn(f64) -> bool,
) -> Result<Path, Failure> {
    let mut walker = Walker {
        inputs,
        parameter,
        driven,
        stop,
        steps: 0,
        rejected: 0,
    };
    let mut first = walker.first_node(start.0, start.1.to_vec())?;
    first.s = start.0;
    // A mechanism without moving inputs has a path of one point.
    let still = walker
        .driven
        .system
        .drivers
        .iter()
        .all(|d| d.law.is_constant())
        && range.0 == range.1;
    let (up, high) = if still {
        (Vec::new(), End::Reached)
    } else {
        walker.march(&first, range.1.max(start.0), 1.0)
    };
    let (down, low) = if range.0 < start.0 {
        walker.march(&first, range.0, -1.0)
    } else {
        (Vec::new(), End::Reached)
    };
    let (nodes, crossings) = joined(down, first, up);
    let mut path = Path {
        parameter,
        nodes,
        errors: Vec::new(),
        last: LastGap::default(),
        tolerance: 0.0,
        is_wide: false,
        windows: Vec::new(),
        singular: Vec::new(),
        turn: None,
        low,
        high,
        steps: walker.steps,
        rejected: walker.rejected,
    };
    for (end, node) in [(low, 0), (high, path.nodes.len() - 1)] {
        if let End::DeadCentre { s: dead } = end {
            let self_stress = walker.self_stress_beside(&path.nodes[node]);
            path.singular.push(SingularPosition {
                kind: SingularKind::DeadCentre,
                s: dead,
                self_stress,
            });
        }
    }
    for gap in crossings {
        path.bridge(&mut walker, gap);
    }
    path.singular.sort_by(|a, b| a.s.total_cmp(&b.s));
    path.windows.sort_by(|a, b| a.s.total_cmp(&b.s));
    if parameter == Parameter::Coordinate {
        let unit = walker.unit();
        path.find_errors(walker.driven.system, unit);
    }
    Ok(path)
}

/// Ascending: the nodes below, the start, the nodes above; and the nodes before singular positions. A crossing mark belongs to
/// the gap before its node.
fn joined(down: Vec<Mark>, first: Node, up: Vec<Mark>) -> (Vec<Node>, Vec<usize>) {
    let mut nodes = Vec::with_capacity(up.len() + down.len() + 1);
    let mut crossings = Vec::new();
    let below = down.len();
    for (k, mark) in down.into_iter().rev().enumerate() {
        if mark.crossing {
            crossings.push(k);
        }
        nodes.push(mark.node);
    }
    nodes.push(first);
    for (k, mark) in up.into_iter().enumerate() {
        if mark.crossing {
            crossings.push(below + k);
        }
        nodes.push(mark.node);
    }
    (nodes, crossings)
}
