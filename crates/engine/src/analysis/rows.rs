//! Rows of results read back: poses, velocities and joint forces by channel, for what follows from them.

use std::collections::HashMap;

use crate::element::{BodyId, Kinematics, Marker};
use crate::system::{BodyPart, Evaluation, Inputs, System};
use linkdyn_linear::math::Vec2;
use linkdyn_output::{BodyQuantity, Channel, Column, DriverQuantity, StateQuantity};

/// Where the columns of a table stand.
pub struct Columns(HashMap<Channel, usize>);

impl Columns {
    /// Those of a table with these headings.
    pub fn of(headings: &[Column]) -> Self {
        let columns = headings.iter().enumerate();
        Columns(
            columns
                .filter_map(|(index, column)| Some((column.channel?, index)))
                .collect(),
        )
    }

    /// The column of a channel.
    pub fn find(&self, channel: Channel) -> Option<usize> {
        self.0.get(&channel).copied()
    }

    /// Columns of these quantities of a body, or `None` if one is missing.
    pub fn of_body(&self, body: usize, quantities: [BodyQuantity; 3]) -> Option<[usize; 3]> {
        let [x, y, angle] = quantities.map(|quantity| self.find(Channel::Body(body, quantity)));
        Some([x?, y?, angle?])
    }
}

/// A body's frame in a row; ground where there are no columns.
#[derive(Debug, Clone, Copy)]
pub struct Frame(Option<[usize; 3]>);

impl Frame {
    /// The ground's.
    pub const GROUND: Frame = Frame(None);

    /// The frame of a body, or `None` if its pose is not in the table.
    pub fn of(columns: &Columns, body: BodyId) -> Option<Self> {
        const POSE: [BodyQuantity; 3] = [BodyQuantity::X, BodyQuantity::Y, BodyQuantity::Angle];
        if body == BodyId::GROUND {
            Some(Frame::GROUND)
        } else {
            Some(Frame(Some(columns.of_body(body.0 - 1, POSE)?)))
        }
    }

    /// Origin \[m\] and angle \[rad\].
    pub fn pose(self, row: &[f64]) -> (Vec2, f64) {
        self.0.map_or((Vec2::zeros(), 0.0), |[x, y, angle]| {
            (Vec2::new(row[x], row[y]), row[angle])
        })
    }

    /// A vector of the body in the ground's axes.
    pub fn turn(self, row: &[f64], vector: Vec2) -> Vec2 {
        let (sin, cos) = self.pose(row).1.sin_cos();
        Vec2::new(
            cos * vector.x - sin * vector.y,
            sin * vector.x + cos * vector.y,
        )
    }
}

/// Motion of all bodies in a row.
pub struct States {
    frames: Vec<Frame>,
    /// Columns of the rates, where the table has them.
    rates: Vec<Option<[usize; 3]>>,
    /// Bodies of two amplitudes, with the columns of each and of its rate.
    amplitudes: Vec<(usize, [[Option<usize>; 2]; 2])>,
}

/// The frame of a body; that of no column where it follows from others.
fn frame(system: &System, columns: &Columns, body: usize) -> Option<Frame> {
    let column = |quantity| columns.find(Channel::Body(body, quantity));
    match system.bodies[body].part() {
        BodyPart::Own | BodyPart::Node(_) | BodyPart::Section => {
            Frame::of(columns, BodyId(body + 1))
        }
        BodyPart::Amplitudes { .. } => column(BodyQuantity::X).map(|_| Frame::GROUND),
        BodyPart::MassPoint => Some(Frame::GROUND),
    }
}

/// Bodies of two amplitudes, with the columns of each and of its rate.
fn amplitudes(system: &System, columns: &Columns) -> Vec<(usize, [[Option<usize>; 2]; 2])> {
    const BOTH: [[BodyQuantity; 2]; 2] = [
        [BodyQuantity::X, BodyQuantity::Vx],
        [BodyQuantity::Y, BodyQuantity::Vy],
    ];
    let bodies = system.bodies.iter().enumerate();
    let of = bodies.filter(|(_, data)| matches!(data.part(), BodyPart::Amplitudes { .. }));
    let find = |body: usize| {
        BOTH.map(|orders| orders.map(|quantity| columns.find(Channel::Body(body, quantity))))
    };
    of.map(|(body, _)| (body, find(body))).collect()
}

impl States {
    /// Of a table, or `None` if a pose is not in it.
    pub fn of(system: &System, columns: &Columns) -> Option<Self> {
        const TWIST: [BodyQuantity; 3] = [BodyQuantity::Vx, BodyQuantity::Vy, BodyQuantity::Omega];
        let bodies = 0..system.bodies.len();
        Some(States {
            rates: bodies
                .clone()
                .map(|body| columns.of_body(body, TWIST))
                .collect(),
            frames: bodies
                .map(|body| frame(system, columns, body))
                .collect::<Option<_>>()?,
            amplitudes: amplitudes(system, columns),
        })
    }

    /// The frame of a moving body.
    pub fn frame(&self, body: usize) -> Frame {
        self.frames[body]
    }

    /// Coordinates (n).
    pub fn position(&self, system: &System, row: &[f64], q: &mut [f64]) {
        for (k, (frame, body)) in self.frames.iter().zip(&system.bodies).enumerate() {
            let (origin, angle) = frame.pose(row);
            let centre = origin - frame.turn(row, body.origin);
            let columns = system.layout.moving(k);
            columns.write(q, [centre.x, centre.y, angle]);
        }
        self.amplitudes(system, row, q, 0);
        system.carry(q, None);
    }

    /// Writes amplitudes, or their rates.
    fn amplitudes(&self, system: &System, row: &[f64], to: &mut [f64], order: usize) {
        for (body, columns) in &self.amplitudes {
            let own = columns.map(|orders| orders[order].map_or(0.0, |column| row[column]));
            let [first, second] = own;
            let place = system.layout.moving(*body);
            place.write(to, [first, second, 0.0]);
        }
    }

    /// Velocities (n); zero where the table has none.
    pub fn velocity(&self, system: &System, row: &[f64], v: &mut [f64]) {
        let bodies = self.frames.iter().zip(&self.rates).zip(&system.bodies);
        for (k, ((frame, rates), body)) in bodies.enumerate() {
            let rho = frame.turn(row, body.origin);
            let [vx, vy, omega] = rates.map_or([0.0; 3], |rates| rates.map(|column| row[column]));
            let columns = system.layout.moving(k);
            columns.write(v, [vx + omega * rho.y, vy - omega * rho.x, omega]);
        }
        self.amplitudes(system, row, v, 1);
    }
}

/// A mechanism at the state of a row.
pub struct Replay<'s> {
    pub system: &'s System,
    states: States,
    /// Columns of integrated states, where the table has them.
    integrated: Vec<Option<usize>>,
    /// Columns of the drivers' values, likewise.
    driven: Vec<Option<usize>>,
    evaluation: Evaluation,
    inputs: Inputs,
    /// Coordinates (n).
    pub q: Vec<f64>,
    /// Velocities (n); zero where the table has none.
    pub v: Vec<f64>,
}

impl<'s> Replay<'s> {
    /// Of a table, or `None` if a pose is not in it.
    pub fn new(system: &'s System, columns: &Columns) -> Option<Self> {
        let zero = vec![0.0; system.n()];
        Some(Replay {
            system,
            states: States::of(system, columns)?,
            integrated: (0..system.states.len())
                .map(|state| columns.find(Channel::State(state, StateQuantity::Value)))
                .collect(),
            driven: (0..system.drivers.len())
                .map(|driver| columns.find(Channel::Driver(driver, DriverQuantity::Value)))
                .collect(),
            evaluation: Evaluation::new(system),
            inputs: Inputs::still(system),
            q: zero.clone(),
            v: zero,
        })
    }

    /// Numbers from outside have these values from now on.
    pub fn give(&mut self, numbers: &[f64]) {
        self.inputs.states[..numbers.len()].copy_from_slice(numbers);
    }

    /// Takes the state of a row.
    pub fn take(&mut self, row: &[f64]) {
        self.inputs.set_time(self.system, row[0]);
        let drive = self.inputs.drive.iter_mut().zip(&self.driven);
        for (jet, column) in drive {
            column.iter().for_each(|column| jet[0] = row[*column]);
        }
        let own = &mut self.inputs.states[self.system.inputs.len()..];
        let states = own.iter_mut().zip(&self.integrated);
        for (state, column) in states {
            column.iter().for_each(|column| *state = row[*column]);
        }
        self.states.position(self.system, row, &mut self.q);
        self.states.velocity(self.system, row, &mut self.v);
        self.system.carry(&mut self.q, Some(&mut self.v));
        self.evaluation.set_position(&self.q);
        self.evaluation.set_velocity(&self.v);
    }

    /// Whether the row has a position.
    pub fn is_there(&self) -> bool {
        self.q.iter().all(|q| q.is_finite())
    }

    /// J there.
    pub fn jacobian(&mut self) -> &[f64] {
        self.evaluation.eval_jacobian(self.system, &self.inputs);
        &self.evaluation.jacobian
    }

    /// What elements look at there.
    pub fn kinematics(&self) -> Kinematics<'_> {
        self.evaluation.kinematics(&self.inputs)
    }
}

/// A body's point in a row.
#[derive(Debug, Clone, Copy)]
pub struct PlaceInRow {
    /// Of its body.
    pub frame: Frame,
    /// In the body's frame \[m\].
    pub point: Vec2,
}

impl PlaceInRow {
    /// The position of a marker, or `None` if its body's pose is not in the table.
    pub fn of(system: &System, columns: &Columns, marker: &Marker) -> Option<Self> {
        // Markers are measured from the centre of mass.
        let origin = match marker.body {
            BodyId::GROUND => Vec2::zeros(),
            BodyId(body) => system.bodies[body - 1].origin,
        };
        Some(PlaceInRow {
            frame: Frame::of(columns, marker.body)?,
            point: marker.s - origin,
        })
    }

    /// Global coordinates \[m\].
    pub fn at(&self, row: &[f64]) -> Vec2 {
        self.frame.pose(row).0 + self.frame.turn(row, self.point)
    }
}
