//! What a column of results is: a quantity of an owner.
//!
//! An owner is a number in the order of the model: body 0 is the first that moves, joint 0 the first joint. Whoever looks for a
//! column asks for its channel; names are for people and files (`names`).

mod names;

/// What a column of results stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Channel {
    /// The instant of the row.
    Time,
    /// Motion of the frame of a moving body.
    Body(usize, BodyQuantity),
    /// Motion of a point among the results.
    Point(usize, PointQuantity),
    /// What a joint carries, and where its journal is.
    Joint(usize, JointQuantity),
    /// A driver's value and effort.
    Driver(usize, DriverQuantity),
    /// Energy of the whole mechanism.
    Energy(EnergyQuantity),
    /// How a joint's second body stands and moves in the first, and the size of its force.
    Relative(usize, RelativeQuantity),
    /// What a force element is, and does.
    Load(usize, LoadQuantity),
    /// What the mechanism exerts on the ground.
    Shaking(ShakingQuantity),
    /// Transmission from a driver to an output body.
    Transmission(TransmissionQuantity),
    /// An output of the model: a ratio of velocities.
    Output(usize),
    /// An integrated state.
    State(usize, StateQuantity),
    /// A measure of the model.
    Measure(usize, StateQuantity),
    /// What a body with a cross-section carries inside.
    Section(usize, SectionQuantity),
}

/// An integrated state or a measure, in the SI unit of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StateQuantity {
    /// The state or measure.
    Value,
    /// Its rate.
    Rate,
}

/// Motion of a body's frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BodyQuantity {
    /// Place of the frame's origin \[m\].
    X,
    /// Place of the frame's origin \[m\].
    Y,
    /// \[rad\]
    Angle,
    /// Velocity of the frame's origin \[m/s\].
    Vx,
    /// Velocity of the frame's origin \[m/s\].
    Vy,
    /// Angular velocity \[rad/s\].
    Omega,
    /// Acceleration of the frame's origin \[m/s²\].
    Ax,
    /// Acceleration of the frame's origin \[m/s²\].
    Ay,
    /// Angular acceleration \[rad/s²\].
    Alpha,
}

/// Motion of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PointQuantity {
    /// Place \[m\].
    X,
    /// Place \[m\].
    Y,
    /// Velocity \[m/s\].
    Vx,
    /// Velocity \[m/s\].
    Vy,
    /// Acceleration \[m/s²\].
    Ax,
    /// Acceleration \[m/s²\].
    Ay,
}

/// What a joint carries, and where its journal is in the bearing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum JointQuantity {
    /// Force on the second body \[N\].
    Fx,
    /// Force on the second body \[N\].
    Fy,
    /// Torque on the second body [N·m].
    Torque,
    /// Friction force \[N\] of a slide, or torque [N·m] of a rotation.
    Friction,
    /// Eccentricity of the journal \[m\].
    Ex,
    /// Eccentricity of the journal \[m\].
    Ey,
    /// Size of the eccentricity \[m\].
    Eccentricity,
    /// \[m\]
    Penetration,
    /// \[N\]
    NormalForce,
    /// \[N\]
    TangentialForce,
    /// \[m/s\]
    SlidingSpeed,
    /// 0 flight, 1 contact, 2 contact that sticks.
    State,
    /// Torque [N·m] of the stops of a turning joint on the second body, or force \[N\] of those of a slide.
    Stop,
    /// Where a cam touches its follower \[m\].
    ContactX,
    /// Where a cam touches its follower \[m\].
    ContactY,
    /// Curvature of a cam's profile where it touches, positive where it is convex [1/m].
    Curvature,
    /// From the way of a cam's follower to the normal in the contact \[rad\].
    PressureAngle,
    /// Tension \[N\] of the strand of a belt that pulls more.
    Tight,
    /// Tension \[N\] of the other one, negative where it would have to push.
    Slack,
}

/// What a driver prescribes and what it takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DriverQuantity {
    /// Angle \[rad\] or slide \[m\].
    Value,
    /// Torque [N·m] or force \[N\].
    Effort,
}

/// Energy of the mechanism \[J\].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EnergyQuantity {
    /// Of motion.
    Kinetic,
    /// Of gravity and springs.
    Potential,
    /// Stored in contacts.
    Contact,
    /// Lost in contacts so far.
    Dissipated,
}

/// How a joint's second body stands and moves in the first, and the size of its force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RelativeQuantity {
    /// θ₂ − θ₁ \[rad\].
    Angle,
    /// ω₂ − ω₁ [rad/s].
    Omega,
    /// From the first point to the second along the axis \[m\].
    Slide,
    /// Its rate \[m/s\].
    Rate,
    /// Size of the force \[N\].
    F,
}

/// What a force element is, and what it does to the second or loaded body, in global axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LoadQuantity {
    /// \[N\]
    Fx,
    /// \[N\]
    Fy,
    /// [N·m]
    Torque,
    /// Distance of its points \[m\].
    Length,
    /// Rate of the distance \[m/s\].
    Rate,
    /// Force along the line of its points, positive where it pushes them apart \[N\].
    F,
    /// Angle of the second body in the first \[rad\].
    Angle,
    /// Its rate [rad/s].
    Omega,
    /// Work by time done on the mechanism \[W\].
    Power,
    /// Force \[N\] of the stops of a spring or an actuator on its second point, along the line, positive where it pushes them apart.
    Stop,
    /// Current of a motor \[A\].
    Current,
}

/// What a straight link carries inside: at its stations, counted from 0, and the largest along its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SectionQuantity {
    /// N at a station \[N\]: positive in tension.
    AxialForce(usize),
    /// V at a station \[N\].
    ShearForce(usize),
    /// M at a station [N·m].
    BendingMoment(usize),
    /// Largest N along the axis \[N\], zero where none is positive.
    Tension,
    /// Largest −N along the axis \[N\], zero where none is positive.
    Compression,
    /// Largest |V| along the axis \[N\].
    Shear,
    /// Largest |M| along the axis [N·m].
    Bending,
    /// Largest |σ| along the axis and of both extreme fibres \[Pa\].
    Stress,
    /// Where that is, from the beginning of the axis \[m\].
    StressAt,
    /// Compression by the buckling load \[–\].
    Buckling,
}

/// What reaches the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ShakingQuantity {
    /// \[N\]
    Fx,
    /// \[N\]
    Fy,
    /// About the ground's origin [N·m].
    Moment,
}

/// Transmission from a driver to an output body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TransmissionQuantity {
    /// Velocity of the output by that of the driver.
    Ratio,
    /// Load of the output by effort of the driver.
    Advantage,
    /// Transmission angle in a joint of the output body \[rad\].
    Angle(usize),
}

impl Channel {
    /// The channel that is this one's rate of change, where results have one.
    pub fn rate(self) -> Option<Channel> {
        match self {
            Channel::Body(body, quantity) => Some(Channel::Body(body, quantity.rate()?)),
            Channel::Point(point, quantity) => Some(Channel::Point(point, quantity.rate()?)),
            Channel::Relative(joint, quantity) => Some(Channel::Relative(joint, quantity.rate()?)),
            Channel::Load(force, quantity) => Some(Channel::Load(force, quantity.rate()?)),
            Channel::State(state, StateQuantity::Value) => {
                Some(Channel::State(state, StateQuantity::Rate))
            }
            Channel::Measure(measure, StateQuantity::Value) => {
                Some(Channel::Measure(measure, StateQuantity::Rate))
            }
            Channel::Time
            | Channel::State(..)
            | Channel::Measure(..)
            | Channel::Section(..)
            | Channel::Joint(..)
            | Channel::Driver(..)
            | Channel::Energy(_)
            | Channel::Shaking(_)
            | Channel::Transmission(_)
            | Channel::Output(_) => None,
        }
    }
}

impl BodyQuantity {
    /// The unit of the column.
    pub fn unit(self) -> &'static str {
        match self {
            BodyQuantity::X | BodyQuantity::Y => "m",
            BodyQuantity::Angle => "rad",
            BodyQuantity::Vx | BodyQuantity::Vy => "m/s",
            BodyQuantity::Omega => "rad/s",
            BodyQuantity::Ax | BodyQuantity::Ay => "m/s^2",
            BodyQuantity::Alpha => "rad/s^2",
        }
    }

    fn rate(self) -> Option<Self> {
        match self {
            BodyQuantity::X => Some(BodyQuantity::Vx),
            BodyQuantity::Y => Some(BodyQuantity::Vy),
            BodyQuantity::Angle => Some(BodyQuantity::Omega),
            BodyQuantity::Vx => Some(BodyQuantity::Ax),
            BodyQuantity::Vy => Some(BodyQuantity::Ay),
            BodyQuantity::Omega => Some(BodyQuantity::Alpha),
            BodyQuantity::Ax | BodyQuantity::Ay | BodyQuantity::Alpha => None,
        }
    }
}

impl PointQuantity {
    /// The unit of the column.
    pub fn unit(self) -> &'static str {
        self.of_body().unit()
    }

    /// The same quantity of a body's frame.
    pub fn of_body(self) -> BodyQuantity {
        match self {
            PointQuantity::X => BodyQuantity::X,
            PointQuantity::Y => BodyQuantity::Y,
            PointQuantity::Vx => BodyQuantity::Vx,
            PointQuantity::Vy => BodyQuantity::Vy,
            PointQuantity::Ax => BodyQuantity::Ax,
            PointQuantity::Ay => BodyQuantity::Ay,
        }
    }

    fn rate(self) -> Option<Self> {
        match self {
            PointQuantity::X => Some(PointQuantity::Vx),
            PointQuantity::Y => Some(PointQuantity::Vy),
            PointQuantity::Vx => Some(PointQuantity::Ax),
            PointQuantity::Vy => Some(PointQuantity::Ay),
            PointQuantity::Ax | PointQuantity::Ay => None,
        }
    }
}

impl LoadQuantity {
    /// The unit of the column.
    pub fn unit(self) -> &'static str {
        match self {
            LoadQuantity::Fx | LoadQuantity::Fy | LoadQuantity::F | LoadQuantity::Stop => "N",
            LoadQuantity::Torque => "N*m",
            LoadQuantity::Length => "m",
            LoadQuantity::Rate => "m/s",
            LoadQuantity::Angle => "rad",
            LoadQuantity::Omega => "rad/s",
            LoadQuantity::Power => "W",
            LoadQuantity::Current => "A",
        }
    }

    fn rate(self) -> Option<Self> {
        match self {
            LoadQuantity::Length => Some(LoadQuantity::Rate),
            LoadQuantity::Angle => Some(LoadQuantity::Omega),
            LoadQuantity::Fx
            | LoadQuantity::Fy
            | LoadQuantity::Torque
            | LoadQuantity::Rate
            | LoadQuantity::F
            | LoadQuantity::Omega
            | LoadQuantity::Power
            | LoadQuantity::Current
            | LoadQuantity::Stop => None,
        }
    }
}

impl SectionQuantity {
    /// The unit of the column.
    pub fn unit(self) -> &'static str {
        match self {
            SectionQuantity::AxialForce(_)
            | SectionQuantity::ShearForce(_)
            | SectionQuantity::Tension
            | SectionQuantity::Compression
            | SectionQuantity::Shear => "N",
            SectionQuantity::BendingMoment(_) | SectionQuantity::Bending => "N*m",
            SectionQuantity::Stress => "Pa",
            SectionQuantity::StressAt => "m",
            SectionQuantity::Buckling => "1",
        }
    }
}

impl RelativeQuantity {
    /// The unit of the column.
    pub fn unit(self) -> &'static str {
        match self {
            RelativeQuantity::Angle => "rad",
            RelativeQuantity::Omega => "rad/s",
            RelativeQuantity::Slide => "m",
            RelativeQuantity::Rate => "m/s",
            RelativeQuantity::F => "N",
        }
    }

    fn rate(self) -> Option<Self> {
        match self {
            RelativeQuantity::Angle => Some(RelativeQuantity::Omega),
            RelativeQuantity::Slide => Some(RelativeQuantity::Rate),
            RelativeQuantity::Omega | RelativeQuantity::Rate | RelativeQuantity::F => None,
        }
    }
}

impl ShakingQuantity {
    /// The unit of the column.
    pub fn unit(self) -> &'static str {
        match self {
            ShakingQuantity::Fx | ShakingQuantity::Fy => "N",
            ShakingQuantity::Moment => "N*m",
        }
    }
}
