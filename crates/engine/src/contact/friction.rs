//! Friction force of a contact: T(v, F), against the sliding velocity v.
//!
//! ```text
//! law         T = −F μ(v) sgn v,   s = |v|                                                      at rest
//! None        0
//! Coulomb     μ min(s/v_t, 1)                                                                   no force
//! Ambrosio    μ clamp((s − v₀)/(v₁ − v₀), 0, 1)                                                 no force
//! Threlfall   μ (1 − exp(−3 min(s/v_t, 1)))                                                     no force
//! Stribeck    (μ_k + (μ_s − μ_k) exp(−(s/v_s)^p) + σ₂ s) min(s/v_t, 1)                          no force
//! Lugre       T = −F (σ₀ z + σ₁ ż + σ₂ v),   ż = v − σ₀ s z/g(s)                                a force: it sticks
//!             g(s) = μ_k + (μ_s − μ_k) exp(−(s/v_s)^p)
//!
//! μ, μ_k, μ_s   coefficients (of sliding, kinetic, static)     [–]
//! v_t, v₁       where the regularised force is complete        [m/s]
//! v_s, p        Stribeck's velocity and exponent               [m/s, –]
//! σ₂            viscous part                                   [s/m]
//! σ₀, σ₁        stiffness and damping of the bristles          [1/m, s/m]
//! z             deflection of the bristles                     [m]
//! ```
//!
//! * All but `Lugre` have no force at rest: under a load they creep, slower the smaller v_t, and the equations get as stiff
//!   as F μ/v_t. `Ambrosio`'s dead band creeps freely below v₀; it keeps T from flickering where v changes sign in each step.
//! * `Threlfall` stays at (1 − e⁻³) μ = 0.950 μ, as printed (beyond v_t the sources write 0.95 μ, a jump of 0.0002 μ).
//! * `Lugre` is written per normal force, so that z means the same at all loads; with σ₁ constant it dissipates only up to
//!   a bound of σ₁ (N. Barahanov, R. Ortega 2000), and for F = 0 the bristles relax all the same. At steady sliding z = g sgn v/σ₀
//!   and T is Stribeck's. The bristles' time constant is g/(σ₀ s).
//!
//! Sources: C. A. Coulomb 1785; J. Ambrósio, *Impact of rigid and flexible multibody systems*, in Virtual Nonlinear
//! Multibody Systems, NATO ASI 2003; D. C. Threlfall, *The inclusion of Coulomb friction in mechanisms programs with
//! particular reference to DRAM*, Mech. Mach. Theory 13, 1978; R. Stribeck 1902, in the form of L. C. Bo, D. Pavelescu,
//! Wear 82, 1982; C. Canudas de Wit, H. Olsson, K. J. Åström, P. Lischinsky, *A new model for control of systems with
//! friction*, IEEE Trans. Autom. Control 40, 1995. Compared in E. Pennestrì, V. Rossi, P. Salvini, P. P. Valentini,
//! Nonlinear Dyn. 83, 2016.

mod slopes;

/// The friction force with its derivatives, and the rate of the bristles.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Value {
    /// T \[N\].
    pub force: f64,
    /// ∂T/∂v [N·s/m].
    pub d_sliding: f64,
    /// ∂T/∂F [–].
    pub d_normal: f64,
    /// ∂T/∂z [N/m].
    pub d_bristle: f64,
    /// ż [m/s].
    pub bristle_rate: f64,
}

/// From static to kinetic friction as sliding quickens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decay {
    /// μ_k, at least 0.
    pub kinetic: f64,
    /// μ_s, at least 0.
    pub r#static: f64,
    /// v_s, above 0.
    pub velocity: f64,
    /// p, above 0.
    pub exponent: f64,
}

/// A law T(v, F; z), its parameters as numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// Smooth surfaces.
    None,
    /// μ and v_t.
    Coulomb {
        /// μ [–].
        coefficient: f64,
        /// v_t [m/s].
        threshold: f64,
    },
    /// μ, v₀ and v₁ > v₀ ≥ 0.
    Ambrosio {
        /// μ [–].
        coefficient: f64,
        /// v₀ [m/s].
        lower: f64,
        /// v₁ [m/s].
        upper: f64,
    },
    /// μ and v_t.
    Threlfall {
        /// μ [–].
        coefficient: f64,
        /// v_t [m/s].
        threshold: f64,
    },
    /// μ(s), v_t and σ₂.
    Stribeck {
        /// μ(s).
        decay: Decay,
        /// v_t [m/s].
        threshold: f64,
        /// σ₂ [N·s/m].
        viscous: f64,
    },
    /// g(s), σ₀, σ₁ and σ₂.
    Lugre {
        /// g(s).
        decay: Decay,
        /// σ₀ [N/m].
        stiffness: f64,
        /// σ₁ [N·s/m].
        damping: f64,
        /// σ₂ [N·s/m].
        viscous: f64,
    },
}

impl Decay {
    /// μ(s), and s·μ′(s), which is finite at 0 for every exponent.
    fn at(&self, speed: f64) -> (f64, f64) {
        let power = (speed / self.velocity).powf(self.exponent);
        let part = (self.r#static - self.kinetic) * (-power).exp();
        // power·exp(−power) is zero where the power is infinite
        let slope = if part == 0.0 {
            0.0
        } else {
            -part * self.exponent * power
        };
        (self.kinetic + part, slope)
    }
}

impl Law {
    /// T at the sliding velocity v, the normal force F ≥ 0 and, where it has them, the bristles' deflection z.
    pub fn force(&self, sliding: f64, normal: f64, bristle: f64) -> Value {
        let speed = sliding.abs();
        // μ(s), where the force grows with it, and μ′(s)
        let (coefficient, slope) = match *self {
            Law::None => return Value::default(),
            Law::Coulomb {
                coefficient,
                threshold,
            } => ramp(coefficient, speed, 0.0, threshold),
            Law::Ambrosio {
                coefficient,
                lower,
                upper,
            } => ramp(coefficient, speed, lower, upper),
            Law::Threlfall { threshold, .. } | Law::Stribeck { threshold, .. } => {
                self.regularised(speed, speed < threshold)
            }
            Law::Lugre {
                decay,
                stiffness,
                damping,
                viscous,
            } => {
                return bristles(
                    decay,
                    [stiffness, damping, viscous],
                    (sliding, speed),
                    normal,
                    bristle,
                );
            }
        };
        let against = -direction(sliding);
        Value {
            force: against * coefficient * normal,
            d_sliding: -slope * normal,
            d_normal: against * coefficient,
            ..Value::default()
        }
    }

    /// The law of a motion whose speed is nothing beside all that the law compares it with, and has a direction: the force
    /// that has to be overcome, static where the law tells it from that of sliding, from a speed of `threshold` on.
    #[must_use]
    pub fn slow(self, threshold: f64) -> Law {
        let coefficient = match self {
            Law::None => return self,
            Law::Coulomb { coefficient, .. }
            | Law::Ambrosio { coefficient, .. }
            | Law::Threlfall { coefficient, .. } => coefficient,
            Law::Stribeck { decay, .. } | Law::Lugre { decay, .. } => {
                decay.r#static.max(decay.kinetic)
            }
        };
        Law::Coulomb {
            coefficient,
            threshold,
        }
    }

    /// Whether the law has bristles, whose deflection is a state.
    pub fn has_bristle(&self) -> bool {
        match self {
            Law::Lugre { .. } => true,
            Law::None
            | Law::Coulomb { .. }
            | Law::Ambrosio { .. }
            | Law::Threlfall { .. }
            | Law::Stribeck { .. } => false,
        }
    }

    /// Deflection of the bristles that breaks away, μ_s/σ₀ \[m\], of a law that has them.
    pub fn deflection(&self) -> Option<f64> {
        match *self {
            Law::Lugre {
                decay, stiffness, ..
            } => Some(decay.r#static.max(decay.kinetic) / stiffness),
            Law::None
            | Law::Coulomb { .. }
            | Law::Ambrosio { .. }
            | Law::Threlfall { .. }
            | Law::Stribeck { .. } => None,
        }
    }

    /// Speeds |v| at which a slope jumps, ∂T/∂v or ∂ż/∂v [m/s].
    pub fn kinks(&self) -> impl Iterator<Item = f64> + use<> {
        let [first, second] = match *self {
            Law::None => [None, None],
            Law::Coulomb { threshold, .. }
            | Law::Threlfall { threshold, .. }
            | Law::Stribeck { threshold, .. } => [Some(threshold), None],
            Law::Ambrosio { lower, upper, .. } => {
                [Some(lower).filter(|lower| *lower > 0.0), Some(upper)]
            }
            Law::Lugre { .. } => [Some(0.0), None],
        };
        first.into_iter().chain(second)
    }
}

impl Law {
    /// Number of the piece between two kinks in which the sliding velocity lies, with its sign; 0 is around rest.
    pub fn piece(&self, sliding: f64) -> i8 {
        let passed = self.kinks().filter(|kink| *kink <= sliding.abs()).count() as i8;
        if sliding < 0.0 { -passed } else { passed }
    }

    /// Sliding velocities between which a piece lies.
    pub fn bounds(&self, piece: i8) -> (f64, f64) {
        let kink = |k: i8| {
            self.kinks()
                .nth(usize::from(k.unsigned_abs()))
                .unwrap_or(f64::INFINITY)
        };
        match piece {
            0 => (-kink(0), kink(0)),
            1.. => (kink(piece - 1), kink(piece)),
            ..0 => (-kink(piece), -kink(piece + 1)),
        }
    }

    /// Whether a piece is that of a regularised law around rest.
    pub fn sticks(&self, piece: i8) -> bool {
        piece == 0 && self.kinks().next().is_some()
    }

    /// T and ż by the formula of one piece, also beyond its ends, where it goes on smoothly.
    pub fn on_piece(&self, piece: i8, sliding: f64, normal: f64, bristle: f64) -> Value {
        let sign = if piece < 0 { -1.0 } else { 1.0 };
        let along = sign * sliding;
        let force = |coefficient: f64| Value {
            force: -sign * coefficient * normal,
            ..Value::default()
        };
        match *self {
            Law::None => Value::default(),
            Law::Coulomb {
                coefficient,
                threshold,
            } => force(if piece == 0 {
                coefficient * sliding / threshold
            } else {
                coefficient
            }),
            Law::Ambrosio {
                coefficient,
                lower,
                upper,
            } => {
                // Without a dead band the ramp is the piece around rest.
                let ramp = if lower > 0.0 {
                    piece.abs() - 1
                } else {
                    piece.abs()
                };
                force(match ramp {
                    ..0 => 0.0,
                    0 => coefficient * (along - lower) / (upper - lower),
                    1.. => coefficient,
                })
            }
            Law::Threlfall { .. } | Law::Stribeck { .. } if piece == 0 => {
                let speed = sliding.abs();
                let (coefficient, _) = self.regularised(speed, true);
                Value {
                    force: -direction(sliding) * coefficient * normal,
                    ..Value::default()
                }
            }
            Law::Threlfall { .. } | Law::Stribeck { .. } => force(self.regularised(along, false).0),
            Law::Lugre {
                decay,
                stiffness,
                damping,
                viscous,
            } => bristles(
                decay,
                [stiffness, damping, viscous],
                (sliding, along),
                normal,
                bristle,
            ),
        }
    }

    /// μ(s) and μ′(s) of Threlfall's and Stribeck's laws at a speed below their threshold or beyond it.
    fn regularised(&self, speed: f64, below: bool) -> (f64, f64) {
        match *self {
            Law::Threlfall {
                coefficient,
                threshold,
            } => {
                let rest = if below {
                    (-3.0 * speed / threshold).exp()
                } else {
                    (-3.0_f64).exp()
                };
                let slope = if below {
                    3.0 * coefficient * rest / threshold
                } else {
                    0.0
                };
                (coefficient * (1.0 - rest), slope)
            }
            Law::Stribeck {
                decay,
                threshold,
                viscous,
            } => {
                let (mu, s_slope) = decay.at(speed.max(0.0));
                let (mu, s_slope) = (mu + viscous * speed, s_slope + viscous * speed);
                if below {
                    (mu * speed / threshold, (mu + s_slope) / threshold)
                } else {
                    (mu, s_slope / speed)
                }
            }
            Law::None | Law::Coulomb { .. } | Law::Ambrosio { .. } | Law::Lugre { .. } => {
                (0.0, 0.0)
            }
        }
    }
}

/// μ and its slope where it grows from nothing at `lower` to all at `upper`.
fn ramp(coefficient: f64, speed: f64, lower: f64, upper: f64) -> (f64, f64) {
    if speed < lower {
        (0.0, 0.0)
    } else if speed < upper {
        let slope = coefficient / (upper - lower);
        (slope * (speed - lower), slope)
    } else {
        (coefficient, 0.0)
    }
}

/// LuGre's law with its constants σ₀, σ₁, σ₂.
///
/// The speed is |v|, or what continues it beyond v = 0.
fn bristles(
    decay: Decay,
    [stiffness, damping, viscous]: [f64; 3],
    (sliding, speed): (f64, f64),
    normal: f64,
    bristle: f64,
) -> Value {
    let (most, s_slope) = decay.at(speed.max(0.0));
    // σ₀ s/g, how fast the bristles give way; without friction they never bend
    let give = if most > 0.0 {
        stiffness * speed / most
    } else {
        0.0
    };
    let rate = if most > 0.0 {
        sliding - give * bristle
    } else {
        0.0
    };
    // ∂ż/∂v = 1 − σ₀ z sgn v · (g − s g′)/g²
    let d_rate = if most > 0.0 {
        1.0 - stiffness * bristle * direction(sliding) * (most - s_slope) / (most * most)
    } else {
        0.0
    };
    let per_force = -(stiffness * bristle + damping * rate + viscous * sliding);
    Value {
        force: per_force * normal,
        d_sliding: -(damping * d_rate + viscous) * normal,
        d_normal: per_force,
        d_bristle: -(stiffness - damping * give) * normal,
        bristle_rate: rate,
    }
}

/// sgn v, 0 at 0.
fn direction(sliding: f64) -> f64 {
    if sliding == 0.0 {
        0.0
    } else {
        sliding.signum()
    }
}

#[cfg(test)]
mod tests;
