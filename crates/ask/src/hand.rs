//! Dimensions that a hand changes: points go to a place, and the numbers of the file follow.

use linkdyn_linear::dense::{Dense, least_norm_solve};
use linkdyn_model::{Dependence, DriverKind, GROUND, Knob, Literal, PointRef, knobs};

use crate::{ModelFile, Unanswered};

/// What a file says when some points, which lie together, go to a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// The whole text; all bytes but those of the numbers stay.
    pub text: String,
    /// Paths of the numbers that changed.
    pub changed: Vec<String>,
    /// Where the points stand then \[m\].
    pub place: [f64; 2],
    /// x, y \[m\] and angle \[rad\] of the frames of the moving bodies then, as far as this knows.
    pub poses: Vec<[f64; 3]>,
}

/// A body whose points follow from parameters turns about the pins that stay; one whose points are numbers stays where it is.
struct Body {
    name: String,
    pose: [f64; 3],
    /// The first of its three unknowns, where it may move.
    moves: Option<usize>,
}

/// A point of a body: where it is in its frame, and what of it can change.
struct Point {
    body: usize,
    local: [f64; 2],
    paths: [String; 2],
    /// The unknown that a coordinate is.
    free: [Option<usize>; 2],
}

/// Numbers that may change, poses that may.
#[derive(Default)]
struct Unknowns {
    count: usize,
    /// Parameters by index, and the unknown of each.
    parameters: Vec<(usize, usize)>,
    literals: Vec<(usize, String, Literal)>,
}

const ITERATIONS: usize = 12;
/// Pins that stay, and points that lie together, against the place that is wanted.
const HOLD: f64 = 30.0;
/// What holds numbers and poses where nothing asks for a change, by part of their size.
const EASY: f64 = 1e-7;
const HARD: f64 = 1e-4;

/// Moves points to a place, in the bodies where these are \[m, rad\]; numbers are written to a grain \[m\].
///
/// Unknown are the numbers behind the coordinates: plain ones, of bodies without expressions, and parameters with numbers of their own.
/// Of a body with expressions the pose is unknown, too: its other pins stay, unless a driver holds its angle. Least squares, by
/// Gauss and Newton with the expressions' own derivatives, put the points together, and near the place.
///
/// # Errors
/// Points that the model does not have, and files whose numbers `--set` gives.
pub fn moved(
    file: &ModelFile,
    poses: &[[f64; 3]],
    ends: &[PointRef],
    target: [f64; 2],
    grain: f64,
) -> Result<Moved, Unanswered> {
    let dragging = Dragging::new(file, poses, ends)?;
    let mut x = vec![0.0; dragging.unknowns.count];
    let size = dragging.size;
    let rounds = if x.is_empty() { 0 } else { ITERATIONS };
    for _ in 0..rounds {
        let (rows, misfit) = dragging.linear(&x, target);
        let matrix = Dense::new(misfit.len(), x.len(), rows);
        let Ok(step) = least_norm_solve(&matrix, &misfit, 1e-13) else {
            break;
        };
        // A step of half the mechanism's size is as far as a tangent means anything.
        let longest = step.x.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        let share = (0.5 / longest).min(1.0);
        x.iter_mut().zip(&step.x).for_each(|(x, d)| *x += share * d);
        if longest < 1e-9 {
            break;
        }
    }
    dragging.write(&x, grain.max(1e-9 * size))
}

struct Dragging<'f> {
    file: &'f ModelFile,
    knobs: Vec<(usize, Knob, Literal)>,
    bodies: Vec<Body>,
    /// Those that are led, then those that stay.
    led: usize,
    points: Vec<Point>,
    /// Where the points stand that stay \[m\].
    stays: Vec<[f64; 2]>,
    unknowns: Unknowns,
    size: f64,
    poses: Vec<[f64; 3]>,
    dependence: Dependence,
}

impl<'f> Dragging<'f> {
    fn new(file: &'f ModelFile, poses: &[[f64; 3]], ends: &[PointRef]) -> Result<Self, Unanswered> {
        let model = file.model();
        let moving = model.bodies.keys().filter(|name| *name != GROUND);
        let pose_of = |name: &str| {
            let found = moving.clone().position(|own| own == name);
            found.map_or(Some([0.0; 3]), |index| poses.get(index).copied())
        };
        let source = &file.loaded.source;
        let dependence = source.dependence();
        let derivatives = dependence.at(&[]);
        let plain = model.display.length.size;
        let mut dragging = Dragging {
            file,
            knobs: own_numbers(file),
            bodies: Vec::new(),
            led: ends.len(),
            points: Vec::new(),
            stays: Vec::new(),
            unknowns: Unknowns::default(),
            size: 0.0,
            poses: poses.to_vec(),
            dependence,
        };
        for end in ends {
            let missing = || Unanswered::question(format!("there is no point {end}"));
            let body = model.bodies.get(&end.body).ok_or_else(missing)?;
            let pose = pose_of(&end.body).ok_or_else(missing)?;
            if !body.points.contains_key(&end.point) {
                return Err(missing());
            }
            if dragging.bodies.iter().any(|own| own.name == end.body) {
                return Err(Unanswered::question(format!("two points of {}", end.body)));
            }
            let index = dragging.bodies.len();
            let path = |point: &str, axis: usize| {
                let path = format!("bodies.{}.points.{point}", end.body);
                let keyed = source.literal(&format!("{path}.position[{axis}]"), plain);
                let leaf = |at: &str| derivatives.leaves.iter().any(|leaf| leaf.path == at);
                let inner = format!("{path}.position[{axis}]");
                if keyed.is_some() || leaf(&inner) {
                    inner
                } else {
                    format!("{path}[{axis}]")
                }
            };
            let names: Vec<&String> = body.points.keys().collect();
            let follows = |name: &str| {
                let is = |axis| {
                    derivatives
                        .leaves
                        .iter()
                        .any(|leaf| leaf.path == path(name, axis))
                };
                is(0) || is(1)
            };
            let by_expressions = names.iter().any(|name| follows(name));
            let jointed: Vec<&String> = names
                .iter()
                .copied()
                .filter(|name| **name != end.point && is_jointed(file, &end.body, name))
                .collect();
            // A body that only this point holds, such as a block, goes with it.
            let is_alone = end.body != GROUND && jointed.is_empty() && names.len() == 1;
            let may_move =
                end.body != GROUND && (is_alone || (by_expressions && !is_driven(file, &end.body)));
            let moves = may_move.then(|| dragging.unknowns.take(3));
            dragging.bodies.push(Body {
                name: end.body.clone(),
                pose,
                moves,
            });
            let point = |name: &str, unknowns: &mut Unknowns, is_led: bool| {
                let paths = [path(name, 0), path(name, 1)];
                let free = [0, 1].map(|axis| {
                    let literal = source.literal(&paths[axis], plain);
                    let literal = literal.filter(|_| is_led && !by_expressions && !is_alone)?;
                    let unknown = unknowns.take(1);
                    unknowns
                        .literals
                        .push((unknown, paths[axis].clone(), literal));
                    Some(unknown)
                });
                Point {
                    body: index,
                    local: body.points[name],
                    paths,
                    free,
                }
            };
            let led = point(&end.point, &mut dragging.unknowns, true);
            dragging.points.insert(index, led);
            for name in jointed {
                let stays = point(name, &mut dragging.unknowns, false);
                if may_move {
                    dragging.stays.push(carried(pose, stays.local));
                    dragging.points.push(stays);
                }
            }
        }
        // Parameters behind any of these coordinates.
        for leaf in &derivatives.leaves {
            let is_own = dragging
                .points
                .iter()
                .any(|point| point.paths.contains(&leaf.path));
            for (parameter, _) in leaf.gradient.iter().filter(|_| is_own) {
                let known = dragging.unknowns.parameters.iter();
                let has_number = dragging.knobs.iter().any(|(index, ..)| index == parameter);
                if has_number && known.clone().all(|(index, _)| index != parameter) {
                    let unknown = dragging.unknowns.take(1);
                    dragging.unknowns.parameters.push((*parameter, unknown));
                }
            }
        }
        let all = model.bodies.values().flat_map(|body| body.points.values());
        let most = all
            .flatten()
            .fold(0.0, |most: f64, own| most.max(own.abs()));
        dragging.size = if most > 0.0 { most } else { 1.0 };
        Ok(dragging)
    }

    /// A parameter's size: what its unknown is measured by.
    fn scale(&self, parameter: usize) -> f64 {
        let value = self.file.loaded.parameters[parameter].value.abs();
        if value > 0.0 { value } else { self.size }
    }

    /// Deviations of the parameters.
    fn deviations(&self, x: &[f64]) -> Vec<f64> {
        let mut deviations = vec![0.0; self.file.loaded.parameters.len()];
        for &(parameter, unknown) in &self.unknowns.parameters {
            deviations[parameter] = x[unknown] * self.scale(parameter);
        }
        deviations
    }

    fn pose(&self, body: &Body, x: &[f64]) -> [f64; 3] {
        let [px, py, angle] = body.pose;
        match body.moves {
            Some(k) => [
                px + self.size * x[k],
                py + self.size * x[k + 1],
                angle + x[k + 2],
            ],
            None => body.pose,
        }
    }

    /// The points at values of the unknowns: place, and derivatives by all unknowns of x and of y.
    fn places(&self, x: &[f64]) -> Vec<([f64; 2], [Vec<f64>; 2])> {
        let deviations = self.deviations(x);
        let derivatives = self.dependence.at(&deviations);
        let place = |point: &Point| {
            let mut local = point.local;
            let mut slopes = [vec![0.0; x.len()], vec![0.0; x.len()]];
            for axis in [0, 1] {
                if let Some(unknown) = point.free[axis] {
                    local[axis] += self.size * x[unknown];
                    slopes[axis][unknown] = self.size;
                }
                let mut leaves = derivatives.leaves.iter();
                let Some(leaf) = leaves.find(|leaf| leaf.path == point.paths[axis]) else {
                    continue;
                };
                local[axis] = leaf.value.unwrap_or(local[axis]);
                for (parameter, slope) in &leaf.gradient {
                    let mut known = self.unknowns.parameters.iter();
                    if let Some((_, unknown)) = known.find(|(index, _)| index == parameter) {
                        slopes[axis][*unknown] += slope * self.scale(*parameter);
                    }
                }
            }
            let body = &self.bodies[point.body];
            let pose = self.pose(body, x);
            let (sin, cos) = pose[2].sin_cos();
            let [a, b] = &slopes;
            let mut turned = [
                a.iter()
                    .zip(b)
                    .map(|(a, b)| cos * a - sin * b)
                    .collect::<Vec<_>>(),
                a.iter().zip(b).map(|(a, b)| sin * a + cos * b).collect(),
            ];
            if let Some(k) = body.moves {
                turned[0][k] += self.size;
                turned[1][k + 1] += self.size;
                turned[0][k + 2] -= sin * local[0] + cos * local[1];
                turned[1][k + 2] += cos * local[0] - sin * local[1];
            }
            (carried(pose, local), turned)
        };
        self.points.iter().map(place).collect()
    }

    /// The linear least-squares problem of a step: rows of its matrix, and its right-hand side, by the mechanism's size.
    fn linear(&self, x: &[f64], target: [f64; 2]) -> (Vec<f64>, Vec<f64>) {
        let places = self.places(x);
        let (mut rows, mut misfit) = (Vec::new(), Vec::new());
        let mut row = |slopes: &dyn Fn(usize) -> f64, off: f64, weight: f64| {
            rows.extend((0..x.len()).map(|k| weight * slopes(k)));
            misfit.push(weight * off);
        };
        let size = self.size;
        let (first, others) = places.split_at(self.led);
        for axis in [0, 1] {
            let (place, slopes) = &first[0];
            row(
                &|k| slopes[axis][k] / size,
                (target[axis] - place[axis]) / size,
                1.0,
            );
            for (other, own) in &first[1..] {
                let apart = |k: usize| (own[axis][k] - slopes[axis][k]) / size;
                row(&apart, (place[axis] - other[axis]) / size, HOLD);
            }
            for ((place, slopes), stays) in others.iter().zip(&self.stays) {
                row(
                    &|k| slopes[axis][k] / size,
                    (stays[axis] - place[axis]) / size,
                    HOLD,
                );
            }
        }
        let hard = self.bodies.iter().filter_map(|body| body.moves);
        let hard: Vec<usize> = hard.flat_map(|k| k..k + 3).collect();
        for k in 0..x.len() {
            let weight = if hard.contains(&k) { HARD } else { EASY };
            row(&|other| f64::from(other == k), 0.0, weight);
        }
        (rows, misfit)
    }

    fn write(mut self, x: &[f64], grain: f64) -> Result<Moved, Unanswered> {
        let (mut edits, mut changed) = (Vec::new(), Vec::new());
        let mut edit = |path: String, literal: &Literal, value: f64, grain: f64, before: f64| {
            let text = literal.written(value, grain);
            if (value - before).abs() > 0.5 * grain {
                edits.push((literal.clone(), text));
                changed.push(path);
            }
        };
        let locals = self.points.iter().flat_map(|point| {
            let coordinates = point.free.iter().zip(point.local);
            coordinates.filter_map(|(free, local)| Some((free.as_ref().copied()?, local)))
        });
        let locals: Vec<(usize, f64)> = locals.collect();
        for (unknown, path, literal) in &self.unknowns.literals {
            let own = locals.iter().find(|(free, _)| free == unknown);
            let before = own.map_or(0.0, |(_, local)| *local);
            edit(
                path.clone(),
                literal,
                before + self.size * x[*unknown],
                grain,
                before,
            );
        }
        for &(parameter, unknown) in &self.unknowns.parameters {
            let known = &self.file.loaded.parameters[parameter];
            let literal = self.knobs.iter().find(|(index, ..)| *index == parameter);
            let Some((_, knob, literal)) = literal else {
                continue;
            };
            let fine = if known.unit == "m" {
                grain
            } else {
                1e-4 * self.scale(parameter)
            };
            let value = known.value + x[unknown] * self.scale(parameter);
            edit(
                format!("parameters.{}", knob.name),
                literal,
                value,
                fine,
                known.value,
            );
        }
        let places = self.places(x);
        let moving = self
            .file
            .model()
            .bodies
            .keys()
            .filter(|name| *name != GROUND);
        for (index, name) in moving.enumerate() {
            if let Some(body) = self.bodies.iter().find(|body| body.name == *name) {
                self.poses[index] = self.pose(body, x);
            }
        }
        Ok(Moved {
            text: self.file.loaded.source.replaced(edits),
            changed,
            place: places[0].0,
            poses: self.poses,
        })
    }
}

impl Unknowns {
    /// So many more; the first of them.
    fn take(&mut self, count: usize) -> usize {
        self.count += count;
        self.count - count
    }
}

/// Parameters that have numbers of their own in the file: index, knob, and the number.
fn own_numbers(file: &ModelFile) -> Vec<(usize, Knob, Literal)> {
    let loaded = &file.loaded;
    let found = knobs(loaded).into_iter().filter_map(|knob| {
        let mut names = loaded.parameters.iter();
        let index = names.position(|parameter| parameter.name == knob.name)?;
        let path = format!("parameters.{}", knob.name);
        let keyed = loaded.source.literal(&format!("{path}.value"), 1.0);
        let literal = keyed.or_else(|| loaded.source.literal(&path, 1.0))?;
        Some((index, knob, literal))
    });
    found.collect()
}

/// A point of a body's frame in the plane.
fn carried([x, y, angle]: [f64; 3], [px, py]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x + cos * px - sin * py, y + sin * px + cos * py]
}

fn is_jointed(file: &ModelFile, body: &str, point: &str) -> bool {
    let is = |end: &PointRef| end.body == body && end.point == point;
    let mut joints = file.model().joints.values();
    joints.any(|joint| joint.between.iter().any(is))
}

/// Whether a driver holds the body's angle in the ground's.
fn is_driven(file: &ModelFile, name: &str) -> bool {
    let mut drivers = file.model().drivers.values();
    drivers.any(|driver| match &driver.kind {
        DriverKind::Rotation { body, relative_to } => {
            body == name && relative_to.as_deref().is_none_or(|other| other == GROUND)
        }
        _ => false,
    })
}

#[cfg(test)]
mod tests;
