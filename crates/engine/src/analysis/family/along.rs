//! Derivatives of columns along a motion whose rows are known, as of the path of a point.

use super::Member;
use super::around::Around;
use super::needs::Depth;
use super::needs::Needs;
use super::perturbed::place;
use super::slopes::{Along, Slopes, WantedColumns};
use crate::analysis::question::Kind;
use crate::analysis::sample::Sample;
use crate::mechanism::driven::Driven;
use crate::system::{Inputs, System};
use linkdyn_linear::hermite::Node;
use linkdyn_output::{BodyQuantity, Channel, Trajectory};

/// The coordinates at the rows of a motion; `None` if a row or a column is missing.
fn nodes(system: &System, motion: &Trajectory) -> Option<Vec<Node>> {
    let time = motion.find(Channel::Time)?.index();
    let column = |body: usize, quantity: BodyQuantity| {
        let id = motion.find(Channel::Body(body, quantity))?;
        Some(id.index())
    };
    let all = [
        BodyQuantity::X,
        BodyQuantity::Y,
        BodyQuantity::Angle,
        BodyQuantity::Vx,
        BodyQuantity::Vy,
        BodyQuantity::Omega,
        BodyQuantity::Ax,
        BodyQuantity::Ay,
        BodyQuantity::Alpha,
    ];
    let mut places = Vec::with_capacity(system.bodies.len());
    for body in 0..system.bodies.len() {
        let mut own = [0; 9];
        for (own, quantity) in own.iter_mut().zip(all) {
            *own = column(body, quantity)?;
        }
        places.push(own);
    }
    let node = |row: &[f64]| {
        let zero = || vec![0.0; system.n()];
        let (s, mut q, mut d, mut dd) = (row[time], zero(), zero(), zero());
        for (body, places) in places.iter().enumerate() {
            let [x, y, angle, vx, vy, omega, ax, ay, alpha] = places.map(|place| row[place]);
            // Columns are of the frame, coordinates of the centre of mass.
            let (sin, cos) = angle.sin_cos();
            let origin = system.bodies[body].origin;
            let (a, b) = (origin.x, origin.y);
            let rho = [cos * a - sin * b, sin * a + cos * b];
            let square = omega * omega;
            let columns = system.layout.moving(body);
            columns.write(&mut q, [x - rho[0], y - rho[1], angle]);
            columns.write(&mut d, [vx + omega * rho[1], vy - omega * rho[0], omega]);
            let turned = [
                ax + alpha * rho[1] + square * rho[0],
                ay - alpha * rho[0] + square * rho[1],
            ];
            columns.write(&mut dd, [turned[0], turned[1], alpha]);
        }
        q.iter()
            .chain(&dd)
            .all(|own| own.is_finite())
            .then_some(Node { s, q, d, dd })
    };
    let nodes: Option<Vec<Node>> = motion.rows().map(node).collect();
    nodes.filter(|nodes| nodes.len() > 1)
}

impl Member<'_> {
    /// Derivatives of the columns that responses need by the parameters, at times within a motion with these values, whose rows
    /// have all columns: for each time and each column in the order of [`Responses::columns`], one for each parameter, NaN where
    /// it is not known. `None` if the motion is not one that drivers prescribe.
    ///
    /// [`Responses::columns`]: crate::analysis::responses::Responses::columns
    pub fn slopes_along(
        &mut self,
        values: &[f64],
        lengths: &[f64],
        motion: &Trajectory,
        times: &[f64],
    ) -> Option<Vec<f64>> {
        let prepared = &self.family.prepared;
        let (nominal, question) = prepared.parts();
        let needs = Needs::new(prepared)?;
        let depth = needs.depth(question.contents.reactions);
        if question.kind != Kind::Prescribed || nominal.links > 0 || depth == Depth::Forces {
            return None;
        }
        let mechanisms = self.mechanisms.as_mut()?;
        let arounds = Around::all(mechanisms, prepared.responses(), values, lengths);
        let system = mechanisms.at(values, 1.0)?;
        let nodes = nodes(&system, motion)?;
        let mut inputs = Inputs::at_time(&system, nodes[0].s);
        let mut driven = Driven::new(&system, &nodes[0].q, &inputs).ok()?;
        let wanted = WantedColumns {
            needs: &needs,
            depth,
        };
        let mut slopes = Slopes::new(&system, wanted);
        let mut derived = Around::derived(&arounds, &needs);
        let mut sample = Sample::new(&system);
        let mut all = Vec::with_capacity(times.len() * needs.count() * values.len());
        for &time in times {
            if !place(&mut driven, &nodes, time, &mut inputs, &mut sample.q) {
                return None;
            }
            driven.evaluation.set_position(&sample.q);
            driven.factor(&inputs).ok()?;
            driven.velocity(&inputs, &mut sample.v);
            driven.acceleration(&inputs, &mut sample.a);
            let instant = (&inputs, &sample);
            let readers = arounds.iter().zip(&mut derived);
            let found = readers.map(|(around, derived)| {
                let along = Along::Parameter(around.as_ref()?);
                slopes.along(&mut driven, instant, &along, derived)
            });
            let found: Vec<Option<Vec<f64>>> = found.collect();
            for column in 0..needs.count() {
                let of = |own: &Option<Vec<f64>>| own.as_ref().map_or(f64::NAN, |own| own[column]);
                all.extend(found.iter().map(of));
            }
        }
        Some(all)
    }
}
