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
mod path;
mod turn;
mod walk;

use path::LastGap;
pub use path::{Branch, Path, Source, Window};
pub use turn::HALF_TURN;

use super::driven::{Driven, Failure};
use crate::system::{Inputs, System};
use linkdyn_linear::hermite::Node;
use walk::{Mark, Walker};

/// What the path's parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// The value of the only driver [rad or m].
    DriverValue,
    /// Time \[s\].
    Time,
    /// The value of the only independent coordinate [rad or m], drivers standing still.
    Coordinate,
}

impl Parameter {
    /// One driver: its value; several or none: time.
    pub fn of(system: &System) -> Self {
        if system.drivers.len() == 1 {
            Parameter::DriverValue
        } else {
            Parameter::Time
        }
    }

    /// Inputs at `s`, derivatives with respect to s.
    fn set(self, driven: &mut Driven, s: f64, inputs: &mut Inputs) {
        match self {
            Parameter::DriverValue => inputs.drive[0] = [s, 1.0, 0.0],
            Parameter::Time => inputs.set_time(driven.system, s),
            Parameter::Coordinate => driven.independent[0].jet = [s, 1.0, 0.0],
        }
    }

    /// Prediction error accepted, in rad or mechanism sizes: far below any distance of branches but at their crossings.
    /// Where an integrator asks for values at its own points, nodes must be so near that the polynomial through four of them is the
    /// curve to round-off.
    fn prediction(self) -> f64 {
        match self {
            Parameter::DriverValue | Parameter::Time => 1e-6,
            Parameter::Coordinate => 1e-7,
        }
    }

    /// Newton step after which the same factors serve once more, scaled \[–\]: they are made anew at the node in any case.
    fn chord(self) -> f64 {
        match self {
            Parameter::DriverValue | Parameter::Time => 0.0,
            Parameter::Coordinate => 1e-6,
        }
    }

    /// Nodes that predict the next one, where there are so many.
    fn predictors(self) -> usize {
        match self {
            Parameter::DriverValue | Parameter::Time => 2,
            Parameter::Coordinate => 3,
        }
    }
}

/// Kinds of singular positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SingularKind {
    /// Constraints lose rank, motion goes on.
    ChangePoint,
    /// The driver turns back.
    DeadCentre,
}

/// A located singular position.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularPosition {
    /// What happens there.
    pub kind: SingularKind,
    /// Its parameter.
    pub s: f64,
    /// Left null vector over all rows (m): the self-stress whose multipliers have no bound there. Empty on the path of
    /// an independent coordinate, or where it is not known.
    pub self_stress: Vec<f64>,
}

/// How a path ended on one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// The range is covered.
    Reached,
    /// A dead centre at s.
    DeadCentre {
        /// Value of the path's parameter [rad, m or s].
        s: f64,
    },
    /// No step is small enough at s, and it is no dead centre.
    Stuck {
        /// Value of the path's parameter [rad, m or s].
        s: f64,
    },
    /// Somebody asked to stop.
    Interrupted,
}

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
