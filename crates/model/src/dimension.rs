//! Dimensions of a model's numbers. The angle counts as one of its own, so that Hz is not rad/s.

/// What a number of the model is a measure of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// A length \[m\].
    Length,
    /// An angle \[rad\].
    Angle,
    /// A mass \[kg\].
    Mass,
    /// A moment of inertia \[kg·m²\].
    Inertia,
    /// A force \[N\].
    Force,
    /// A torque \[N·m\].
    Torque,
    /// A stiffness \[N/m\].
    Stiffness,
    /// A damping \[N·s/m\].
    Damping,
    /// A stiffness against turning \[N·m/rad\].
    AngularStiffness,
    /// A damping of turning \[N·m·s/rad\].
    AngularDamping,
    /// A velocity \[m/s\].
    Velocity,
    /// An angular velocity \[rad/s\].
    AngularVelocity,
    /// An acceleration \[m/s²\].
    Acceleration,
    /// An angular acceleration \[rad/s²\].
    AngularAcceleration,
    /// A time \[s\].
    Time,
    /// A stress, or a modulus of elasticity \[Pa\].
    Stress,
    /// A frequency \[Hz\].
    Frequency,
    /// A voltage \[V\]. The ampere counts as a pure number, so that this is a power.
    Voltage,
    /// An electrical resistance \[Ω\].
    Resistance,
    /// An inductance \[H\].
    Inductance,
    /// Torque by current [N·m/A].
    TorqueConstant,
    /// An area \[m²\].
    Area,
    /// A section modulus \[m³\].
    SectionModulus,
    /// A second moment of area \[m⁴\].
    SecondMoment,
    /// A density [kg/m³].
    Density,
    /// A stiffness against bending \[N·m²\].
    BendingStiffness,
    /// A mass by length [kg/m].
    LineDensity,
}

/// Exponents of length, mass, time and angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Powers {
    /// Of length.
    pub length: i32,
    /// Of mass.
    pub mass: i32,
    /// Of time.
    pub time: i32,
    /// Of angle.
    pub angle: i32,
}

/// Exponents in the order length, mass, time, angle.
pub(super) const fn powers(length: i32, mass: i32, time: i32, angle: i32) -> Powers {
    Powers {
        length,
        mass,
        time,
        angle,
    }
}

impl Dimension {
    /// All that `units` may name, in the order of the format's description; `frequency` is always Hz.
    pub const NAMED: [Dimension; 16] = [
        Dimension::Length,
        Dimension::Angle,
        Dimension::Mass,
        Dimension::Inertia,
        Dimension::Force,
        Dimension::Torque,
        Dimension::Stiffness,
        Dimension::Damping,
        Dimension::AngularStiffness,
        Dimension::AngularDamping,
        Dimension::Velocity,
        Dimension::AngularVelocity,
        Dimension::Acceleration,
        Dimension::AngularAcceleration,
        Dimension::Time,
        Dimension::Stress,
    ];

    /// All others: plain numbers of these are always in SI.
    const ALWAYS_SI: [Dimension; 11] = [
        Dimension::Frequency,
        Dimension::Voltage,
        Dimension::Resistance,
        Dimension::Inductance,
        Dimension::TorqueConstant,
        Dimension::Area,
        Dimension::SectionModulus,
        Dimension::SecondMoment,
        Dimension::Density,
        Dimension::BendingStiffness,
        Dimension::LineDensity,
    ];

    /// Name in `units`, SI unit, and exponents.
    const fn row(self) -> (&'static str, &'static str, Powers) {
        match self {
            Dimension::Length => ("length", "m", powers(1, 0, 0, 0)),
            Dimension::Angle => ("angle", "rad", powers(0, 0, 0, 1)),
            Dimension::Mass => ("mass", "kg", powers(0, 1, 0, 0)),
            Dimension::Inertia => ("inertia", "kg*m^2", powers(2, 1, 0, 0)),
            Dimension::Force => ("force", "N", powers(1, 1, -2, 0)),
            Dimension::Torque => ("torque", "N*m", powers(2, 1, -2, 0)),
            Dimension::Stiffness => ("stiffness", "N/m", powers(0, 1, -2, 0)),
            Dimension::Damping => ("damping", "N*s/m", powers(0, 1, -1, 0)),
            Dimension::AngularStiffness => ("angular_stiffness", "N*m/rad", powers(2, 1, -2, -1)),
            Dimension::AngularDamping => ("angular_damping", "N*m*s/rad", powers(2, 1, -1, -1)),
            Dimension::Velocity => ("velocity", "m/s", powers(1, 0, -1, 0)),
            Dimension::AngularVelocity => ("angular_velocity", "rad/s", powers(0, 0, -1, 1)),
            Dimension::Acceleration => ("acceleration", "m/s^2", powers(1, 0, -2, 0)),
            Dimension::AngularAcceleration => {
                ("angular_acceleration", "rad/s^2", powers(0, 0, -2, 1))
            }
            Dimension::Time => ("time", "s", powers(0, 0, 1, 0)),
            Dimension::Stress => ("stress", "Pa", powers(-1, 1, -2, 0)),
            Dimension::Frequency => ("frequency", "Hz", powers(0, 0, -1, 0)),
            Dimension::Voltage => ("voltage", "V", powers(2, 1, -3, 0)),
            Dimension::Resistance => ("resistance", "ohm", powers(2, 1, -3, 0)),
            Dimension::Inductance => ("inductance", "H", powers(2, 1, -2, 0)),
            Dimension::TorqueConstant => ("torque_constant", "N*m/A", powers(2, 1, -2, 0)),
            Dimension::Area => ("area", "m^2", powers(2, 0, 0, 0)),
            Dimension::SectionModulus => ("section_modulus", "m^3", powers(3, 0, 0, 0)),
            Dimension::SecondMoment => ("second_moment", "m^4", powers(4, 0, 0, 0)),
            Dimension::Density => ("density", "kg/m^3", powers(-3, 1, 0, 0)),
            Dimension::BendingStiffness => ("bending_stiffness", "N*m^2", powers(3, 1, -2, 0)),
            Dimension::LineDensity => ("line_density", "kg/m", powers(-1, 1, 0, 0)),
        }
    }

    /// Its name, as in `units`.
    pub const fn name(self) -> &'static str {
        self.row().0
    }

    /// Its SI unit as text.
    pub const fn si(self) -> &'static str {
        self.row().1
    }

    /// Its exponents.
    pub const fn powers(self) -> Powers {
        self.row().2
    }

    /// The dimension of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Dimension::NAMED
            .into_iter()
            .chain(Dimension::ALWAYS_SI)
            .find(|dimension| dimension.name() == name)
    }

    /// Where it stands in `NAMED`.
    pub fn index(self) -> Option<usize> {
        Dimension::NAMED
            .iter()
            .position(|&dimension| dimension == self)
    }

    /// The named dimension of its `order`-th derivative by time, where there is one.
    pub const fn rate(self, order: usize) -> Option<Dimension> {
        match (self, order) {
            (dimension, 0) => Some(dimension),
            (Dimension::Length, 1) => Some(Dimension::Velocity),
            (Dimension::Length, 2) => Some(Dimension::Acceleration),
            (Dimension::Angle, 1) => Some(Dimension::AngularVelocity),
            (Dimension::Angle, 2) => Some(Dimension::AngularAcceleration),
            (_, _) => None,
        }
    }
}

impl Powers {
    /// The same, per second^order.
    pub fn per_second(self, order: i32) -> Powers {
        Powers {
            time: self.time - order,
            ..self
        }
    }

    /// Whether a unit of the `given` exponents will do: exactly these, or with the radian of "per radian" left out.
    pub fn accepts(self, given: Powers) -> bool {
        given == self || (self.angle < 0 && given == Powers { angle: 0, ..self })
    }
}
