//! What a body, a point, a joint or the mechanism shows at an instant: every quantity a result column may ask for.

use super::sample::{ContactSample, Sample};
use crate::element::Kinematics;
use crate::element::cam::Meeting;
use crate::system::{Evaluation, Inputs, JointData, System};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_output::{
    BodyQuantity, Channel, Column, EnergyQuantity, JointQuantity, LoadQuantity, PointQuantity,
};

/// Motion of the frame of a moving body.
pub struct BodyReading {
    place: Vec2,
    angle: f64,
    velocity: Vec2,
    omega: f64,
    acceleration: Vec2,
    alpha: f64,
}

impl BodyReading {
    /// Of body `body`, whose centre of mass the sample is about.
    pub fn new(system: &System, at: &Kinematics, body: usize, sample: &Sample) -> Self {
        let (pose, twist) = (&at.poses[body + 1], &at.twists[body + 1]);
        // From the centre of mass to the frame's origin.
        let rho = pose.turn(system.bodies[body].origin);
        let omega = twist.omega;
        let square = omega * omega;
        let [x, y, theta] = system.layout.moving(body).read(&sample.a);
        BodyReading {
            place: Vec2::new(pose.r.x + rho.x, pose.r.y + rho.y),
            angle: pose.theta,
            velocity: Vec2::new(twist.v.x - omega * rho.y, twist.v.y + omega * rho.x),
            omega,
            acceleration: Vec2::new(
                x - theta * rho.y - square * rho.x,
                y + theta * rho.x - square * rho.y,
            ),
            alpha: theta,
        }
    }

    /// One of the quantities.
    pub fn value(&self, quantity: BodyQuantity) -> f64 {
        match quantity {
            BodyQuantity::X => self.place.x,
            BodyQuantity::Y => self.place.y,
            BodyQuantity::Angle => self.angle,
            BodyQuantity::Vx => self.velocity.x,
            BodyQuantity::Vy => self.velocity.y,
            BodyQuantity::Omega => self.omega,
            BodyQuantity::Ax => self.acceleration.x,
            BodyQuantity::Ay => self.acceleration.y,
            BodyQuantity::Alpha => self.alpha,
        }
    }
}

/// Motion of a point among the results.
pub struct PointReading {
    place: Vec2,
    velocity: Vec2,
    acceleration: Vec2,
}

impl PointReading {
    /// Of point `point` of the system.
    pub fn new(system: &System, at: &Kinematics, point: usize, sample: &Sample) -> Self {
        let marker = &system.points[point].marker;
        let mut acceleration = marker.centripetal(at);
        if let Some(columns) = system.layout.columns(marker.body) {
            let ([x, y, theta], rho) = (columns.read(&sample.a), marker.rho(at));
            acceleration.x += x - theta * rho.y;
            acceleration.y += y + theta * rho.x;
        }
        PointReading {
            place: marker.place(at),
            velocity: marker.velocity(at),
            acceleration,
        }
    }

    /// One of the quantities.
    pub fn value(&self, quantity: PointQuantity) -> f64 {
        match quantity {
            PointQuantity::X => self.place.x,
            PointQuantity::Y => self.place.y,
            PointQuantity::Vx => self.velocity.x,
            PointQuantity::Vy => self.velocity.y,
            PointQuantity::Ax => self.acceleration.x,
            PointQuantity::Ay => self.acceleration.y,
        }
    }
}

/// What a joint carries, and where its journal is.
pub struct JointReading {
    /// Force and torque on the second body.
    force: Vec2,
    torque: f64,
    friction: f64,
    /// Of a joint with clearance, whatever its model.
    journal: ContactSample,
    /// Torque or force of the joint's stops on the second body.
    stop: f64,
    /// Of a cam.
    meeting: Option<Meeting>,
    /// Of the strands of a belt \[N\].
    tensions: [f64; 2],
}

impl JointReading {
    /// Of joint `joint`; what it does not have is zero.
    pub fn new(
        system: &System,
        at: &Kinematics,
        inputs: &Inputs,
        joint: usize,
        sample: &Sample,
    ) -> Self {
        // Blocks of joints stand first, in their order.
        let (data, block) = (&system.joints[joint], &system.blocks[joint]);
        let lambda = &sample.lambda[block.rows()];
        let (mut force, mut torque) = block.constraint.reaction(at, lambda);
        let mut tensions = [0.0; 2];
        if let Some(belt) = &data.extras().belt {
            tensions = belt.tensions(at, lambda.first().copied());
            (force, torque) = belt.wrench(at, tensions);
        }
        if let Some(bushing) = &data.extras().bushing {
            (force, torque) = bushing.wrench(at);
        }
        if let Some(beam) = &data.extras().beam {
            (force, torque) = beam.wrench(at);
        }
        let touching = data.is_contact().then(|| touching(sample, data));
        let contact = data
            .extras()
            .contact
            .map(|id| sample.contacts[id.0])
            .or(touching);
        if let Some(contact) = contact {
            force += contact.reading.force;
        }
        let mut friction = 0.0;
        if let Some(at_joint) = data.extras().friction {
            friction = sample.dependent_forces[at_joint.force];
            let dependent = &system.dependent_forces[at_joint.force].force;
            force += dependent.reaction(at, friction).0;
        }
        let stops = data
            .extras()
            .stops
            .iter()
            .flat_map(|ends| ends.iter().flatten());
        let stop = stops.filter_map(|id| {
            let stop = system.contacts[id.0].stop()?;
            Some(stop.pushed(sample.contacts[id.0].reading.normal))
        });
        let stop = stop.sum();
        if let (true, Some(axis)) = (stop != 0.0, data.role().axis()) {
            force += at.poses[data.bodies()[0].0].turn(axis) * stop;
        }
        // A journal that does not move freely is where its model holds it.
        let held = || {
            let bearing = data.extras().bearing.as_ref()?;
            let offset = data
                .extras()
                .clearance
                .map(|link| &inputs.offset[link.offset]);
            Some(ContactSample {
                reading: bearing.held(at, &data.points(), offset, force),
                state: 1.0,
            })
        };
        let meeting = data.extras().cam.as_ref().map(|cam| cam.meeting(at));
        let mut journal = contact.or_else(held).unwrap_or_default();
        if data.extras().clasp.is_some() {
            journal.state = if block.rows().is_empty() { 0.0 } else { 1.0 };
        }
        if meeting.is_some() {
            journal.reading.normal = sample.lambda[block.row()];
        }
        JointReading {
            stop,
            meeting,
            tensions,
            force,
            torque,
            friction,
            journal,
        }
    }

    /// A number of a cam's contact.
    fn touch(&self, of: impl Fn(&Meeting) -> f64) -> f64 {
        self.meeting.as_ref().map_or(0.0, of)
    }

    /// One of the quantities.
    pub fn value(&self, quantity: JointQuantity) -> f64 {
        let reading = &self.journal.reading;
        match quantity {
            JointQuantity::Fx => self.force.x,
            JointQuantity::Fy => self.force.y,
            JointQuantity::Torque => self.torque,
            JointQuantity::Friction => self.friction,
            JointQuantity::Ex => reading.eccentricity.x,
            JointQuantity::Ey => reading.eccentricity.y,
            JointQuantity::Eccentricity => reading.eccentricity.norm(),
            JointQuantity::Penetration => reading.penetration.max(0.0),
            JointQuantity::NormalForce => reading.normal,
            JointQuantity::TangentialForce => reading.tangential,
            JointQuantity::SlidingSpeed => reading.sliding,
            JointQuantity::State => self.journal.state,
            JointQuantity::Stop => self.stop,
            JointQuantity::ContactX => self.touch(|meeting| meeting.point.x),
            JointQuantity::ContactY => self.touch(|meeting| meeting.point.y),
            JointQuantity::Curvature => self.touch(|meeting| meeting.curvature),
            JointQuantity::PressureAngle => {
                self.touch(|meeting| meeting.pressure.unwrap_or_default())
            }
            JointQuantity::Tight => self.tensions[0].max(self.tensions[1]),
            JointQuantity::Slack => self.tensions[0].min(self.tensions[1]),
        }
    }
}

/// Headings of the columns of these.
pub fn strokes(system: &System) -> impl Iterator<Item = Column> {
    let forces = system.force_data.iter().enumerate();
    let ending = forces.filter(|(force, _)| system.stops_of_force(*force).next().is_some());
    ending.map(|(force, data)| {
        let quantity = LoadQuantity::Stop;
        Column::of(Channel::Load(force, quantity), &data.name, quantity.unit())
    })
}

/// Force of the stops of a spring or an actuator on its second point, along the line \[N\].
pub fn stroke(system: &System, force: usize, sample: &Sample) -> f64 {
    let stops = system.stops_of_force(force);
    let pushes = stops.filter_map(|id| {
        let stop = system.contacts[id.0].stop()?;
        Some(stop.pushed(sample.contacts[id.0].reading.normal))
    });
    pushes.sum()
}

/// A tip on its outline: the sum of what its pieces do, seen where most presses.
fn touching(sample: &Sample, joint: &JointData) -> ContactSample {
    let mut all = ContactSample::default();
    let mut most = 0.0;
    for contact in &sample.contacts[joint.extras().edges.clone()] {
        if contact.state == 0.0 {
            continue;
        }
        let reading = &contact.reading;
        let n = reading.towards;
        all.reading.force += perp(n) * reading.tangential - n * reading.normal;
        all.reading.normal += reading.normal;
        all.reading.tangential += reading.tangential;
        all.reading.penetration = all.reading.penetration.max(reading.penetration);
        all.state = all.state.max(contact.state);
        if reading.normal >= most {
            most = reading.normal;
            all.reading.sliding = reading.sliding;
        }
    }
    all
}

/// Energy of the mechanism \[J\].
pub fn energy(
    system: &System,
    evaluation: &Evaluation,
    inputs: &Inputs,
    sample: &Sample,
    quantity: EnergyQuantity,
) -> f64 {
    match quantity {
        EnergyQuantity::Kinetic => evaluation.kinetic_energy(system, &sample.v),
        EnergyQuantity::Potential => evaluation.potential_energy(system, inputs),
        EnergyQuantity::Contact => sample.contact_energy[0],
        EnergyQuantity::Dissipated => sample.contact_energy[1],
    }
}
