//! The map of a mechanism with two drivers: where they can stand, where its assemblies meet, and what a point reaches.
//!
//! All assemblies are found on a grid of values of both drivers. Along an edge of the grid at whose ends their numbers differ, two of them
//! meet in between; the place is halved to round-off. In each cell these places are joined (marching squares), which gives the singular
//! curves: there the drivers no longer determine the motion (Gosselin and Angeles, IEEE Transactions on Robotics and Automation 6, 1990,
//! singularities of the second kind). The edge of what the point reaches is made of their images and of the ends of the drivers' ranges.

use super::assemblies::{DrawnSystem, passed};
use super::control::Control;
use crate::element::Measure;
use crate::mechanism::assemblies::{Assemblies, Assembly};
use crate::system::Inputs;
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{Checked, PointRef};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::f64::consts::TAU;

/// Steps that halve an edge.
const HALVINGS: usize = 40;
/// Values of a driver, at most.
const MOST_GRID: usize = 400;

/// What is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkspaceQuestion {
    /// The point.
    pub point: PointRef,
    /// Both drivers; the first two where none are named.
    pub drivers: Option<[String; 2]>,
    /// Values of each.
    pub count: usize,
    /// The most assemblies at each pair.
    pub most: usize,
}

/// A place of a singular curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingularPlace {
    /// Values of both drivers \[rad or m\].
    pub values: [f64; 2],
    /// Where the point is \[m\].
    pub place: [f64; 2],
}

/// The map.
#[derive(Debug, Clone, PartialEq)]
pub struct Workspace {
    /// Both drivers.
    pub drivers: [(String, Measure); 2],
    /// Their values.
    pub values: [Vec<f64>; 2],
    /// How many assemblies there are: rows by the second driver's values, columns by the first's.
    pub counts: Vec<Vec<usize>>,
    /// Where the point is in all of them \[m\].
    pub places: Vec<[f64; 2]>,
    /// Curves on which assemblies meet.
    pub singular: Vec<Vec<SingularPlace>>,
    /// Why there may be more assemblies.
    pub doubts: Vec<String>,
}

/// An edge of the grid: its first node, and whether it leads along the second driver.
type GridEdge = ([usize; 2], bool);

struct Grid<'a> {
    drawn: &'a DrawnSystem,
    inputs: Inputs,
    drivers: [usize; 2],
    values: [Vec<f64>; 2],
    most: usize,
    control: &'a Control,
    body: usize,
    local: [f64; 2],
}

impl Grid<'_> {
    fn at(&mut self, values: [f64; 2]) -> Assemblies {
        for (driver, value) in self.drivers.iter().zip(values) {
            self.inputs.drive[*driver][0] = value;
        }
        self.drawn.assemblies(&self.inputs, self.most, self.control)
    }

    fn place(&self, one: &Assembly) -> [f64; 2] {
        let [x, y, angle] = self.drawn.system.frames(&one.q)[self.body];
        let (sin, cos) = angle.sin_cos();
        let [u, v] = self.local;
        [x + cos * u - sin * v, y + sin * u + cos * v]
    }

    fn node(&self, [i, j]: [usize; 2]) -> [f64; 2] {
        [self.values[0][i], self.values[1][j]]
    }

    /// Where assemblies meet on an edge; `None` where there are none on either side of it.
    fn meeting(
        &mut self,
        (node, is_second): GridEdge,
        counts: [usize; 2],
    ) -> Option<SingularPlace> {
        let other = [
            node[0] + usize::from(!is_second),
            node[1] + usize::from(is_second),
        ];
        let (mut low, mut high) = (self.node(node), self.node(other));
        for _ in 0..HALVINGS {
            let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
            match self.at(middle).found.len() == counts[0] {
                true => low = middle,
                false => high = middle,
            }
        }
        // On the side where there are more, the two that are nearest to each other.
        let values = if counts[0] > counts[1] { low } else { high };
        let found = self.at(values).found;
        let pairs = found
            .iter()
            .enumerate()
            .flat_map(|(k, a)| found[..k].iter().map(move |b| (a, b)));
        let apart = |(a, b): &(&Assembly, &Assembly)| -> f64 {
            a.q.iter().zip(&b.q).map(|(a, b)| (a - b).powi(2)).sum()
        };
        let nearest = pairs.min_by(|a, b| apart(a).total_cmp(&apart(b)));
        // Where both are one to round-off, they are found as one.
        let own = nearest.map(|(a, _)| a).or(found.first())?;
        Some(SingularPlace {
            values,
            place: self.place(own),
        })
    }
}

/// The map of two drivers; all others stand. `None` where it was stopped.
///
/// # Errors
/// Faults of the input.
pub fn workspace(
    model: &Checked,
    question: &WorkspaceQuestion,
    control: &Control,
) -> Result<Option<Workspace>, Complaints> {
    let drawn = DrawnSystem::new(model, 0.0)?.without_initial();
    let drivers = drawn.two_drivers(question.drivers.as_ref())?;
    let system = &drawn.system;
    let count = question.count.clamp(2, MOST_GRID);
    let mut values: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    for (own, driver) in values.iter_mut().zip(drivers) {
        let data = &system.drivers[driver];
        let start = drawn.inputs.drive[driver][0];
        let [low, high] = match data.measure {
            Measure::Angle => [start, start + TAU],
            Measure::Length => passed(model, data).ok_or_else(|| {
                let message = format!("the motion of driver {:?} stands still", data.name);
                vec![Complaint::new("drivers", message).hint("give it a motion over its stroke")]
            })?,
        };
        *own = (0..count)
            .map(|k| low + (high - low) * k as f64 / (count - 1) as f64)
            .collect();
    }
    let point = &question.point;
    let body = system.bodies.iter().position(|own| own.name == point.body);
    let local = model
        .bodies
        .get(&point.body)
        .and_then(|own| own.points.get(&point.point));
    let Some((body, local)) = body.zip(local) else {
        let complaint = Complaint::new("bodies", format!("there is no moving point \"{point}\""));
        return Err(vec![complaint.hint("as in coupler.P")].into());
    };
    let mut grid = Grid {
        inputs: drawn.inputs.clone(),
        drawn: &drawn,
        drivers,
        values,
        most: question.most,
        control,
        body,
        local: *local,
    };
    let (mut counts, mut places, mut doubts) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..count {
        let mut row = Vec::new();
        for i in 0..count {
            if control.stop().is_some() {
                return Ok(None);
            }
            let all = grid.at(grid.node([i, j]));
            row.push(all.found.len());
            places.extend(all.found.iter().map(|one| grid.place(one)));
            if doubts.is_empty() && !all.is_complete {
                doubts = super::assemblies::doubts(system, &all);
            }
        }
        counts.push(row);
    }
    let singular = curves(&mut grid, &counts);
    let names = drivers.map(|driver| {
        let data = &system.drivers[driver];
        (data.name.clone(), data.measure)
    });
    Ok(singular.map(|singular| Workspace {
        drivers: names,
        values: grid.values,
        counts,
        places,
        singular,
        doubts,
    }))
}

/// Places where assemblies meet, joined within the cells, and these to curves.
fn curves(grid: &mut Grid<'_>, counts: &[Vec<usize>]) -> Option<Vec<Vec<SingularPlace>>> {
    let size = counts.len();
    let mut met: HashMap<GridEdge, SingularPlace> = HashMap::new();
    let mut joined: HashMap<GridEdge, Vec<GridEdge>> = HashMap::new();
    for (i, j) in (0..size - 1).flat_map(|i| (0..size - 1).map(move |j| (i, j))) {
        if grid.control.stop().is_some() {
            return None;
        }
        // Around the cell.
        let edges: [GridEdge; 4] = [
            ([i, j], false),
            ([i + 1, j], true),
            ([i, j + 1], false),
            ([i, j], true),
        ];
        let mut own = Vec::new();
        for edge @ ([i, j], is_second) in edges {
            let ends = [
                counts[j][i],
                counts[j + usize::from(is_second)][i + usize::from(!is_second)],
            ];
            if ends[0] != ends[1] {
                if let Entry::Vacant(free) = met.entry(edge) {
                    match grid.meeting(edge, ends) {
                        Some(place) => free.insert(place),
                        None => continue,
                    };
                }
                own.push(edge);
            }
        }
        for pair in own.chunks_exact(2) {
            joined.entry(pair[0]).or_default().push(pair[1]);
            joined.entry(pair[1]).or_default().push(pair[0]);
        }
    }
    let mut starts: Vec<GridEdge> = joined.keys().copied().collect();
    // Ends of open curves first.
    starts.sort_by_key(|edge| (joined[edge].len(), *edge));
    let mut all = Vec::new();
    for start in starts {
        let mut curve = vec![met[&start]];
        let mut at = start;
        while let Some(next) = joined.get_mut(&at).and_then(Vec::pop) {
            if let Some(back) = joined.get_mut(&next) {
                let from = back.iter().position(|own| *own == at);
                from.map(|from| back.remove(from));
            }
            curve.push(met[&next]);
            at = next;
        }
        if curve.len() > 1 {
            all.push(curve);
        }
    }
    Some(all)
}
