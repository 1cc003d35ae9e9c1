//! Impact of two bodies at a point, in no time: Coulomb's friction and restitution, by way of the normal impulse.
//!
//! ```text
//! d(v_n, v_t) = W d(p_n, p_t),   W = [[m_nn, m_nt], [m_nt, m_tt]]          v, relative velocity at the point [m/s]
//! dp_t = −μ sgn(v_t) dp_n                      sliding                    p, impulse on the second body      [N·s]
//! dp_t = −(m_nt/m_tt) dp_n                     sticking, v_t = 0          W, inverse effective mass          [1/kg]
//! ```
//!
//! v_n < 0 comes nearer. W is symmetric without negative eigenvalues. The positions, and so W, stay while p_n grows from 0; v is
//! piecewise linear in it. Sliding goes on until v_t = 0. From there the point sticks if |m_nt| ≤ μ m_tt, and
//! if not it slides towards sgn m_nt and never stops again. Compression ends at p_n = p_c, where v_n = 0. The end is at
//!
//! ```text
//! energetic   ∫_{p_c} v_n dp_n = −e² ∫^{p_c} v_n dp_n        Stronge 1990: e² is the part of the work that comes back
//! kinetic     p_n = (1 + e) p_c                             Poisson 1817
//! kinematic   v_n = −e v_n(0)                               Newton 1687
//! ```
//!
//! The three agree where sliding keeps its direction or there is no friction. Where it stops or turns in the impact, the
//! kinematic and the kinetic sense can *gain* energy, the energetic one cannot for e ≤ 1: it loses (1 − e²) of the normal work
//! besides what friction takes.
//!
//! While sliding with μ sgn(v_t) m_nt > m_nn the tangential impulse presses the bodies together (a jam): v_n falls at first, until
//! sliding stops, which it must. Where then, or at all, no normal impulse can part the bodies (m_nn = 0, or det W = 0 while
//! it sticks), they are wedged: no finite impulse ends the approach, and the result says so.
//!
//! Sources: E. J. Routh, *Dynamics of a system of rigid bodies*, 1905, §§ 179–194 (the walk along p_n); W. J. Stronge,
//! *Rigid body collisions with friction*, Proc. R. Soc. A 431, 1990, and *Impact mechanics*, Cambridge 2000, chapters 3 and 4.

/// What the coefficient of restitution compares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sense {
    /// Works of the normal force, the root of them.
    #[default]
    Energetic,
    /// Normal impulses.
    Kinetic,
    /// Normal velocities.
    Kinematic,
}

/// What the sliding did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slip {
    /// It kept its direction to the end.
    Continues,
    /// It stopped, and the point stuck.
    Stops,
    /// It stopped and went on the other way (in a special case, the same one again).
    Reverses,
    /// There was none at the start and none came.
    Sticks,
    /// There was none at the start.
    Starts,
}

/// The result of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impulse {
    /// p_n and p_t [N·s].
    pub impulse: [f64; 2],
    /// v_n and v_t after it [m/s].
    pub velocity: [f64; 2],
    /// Work lost, −∫v·dp \[J\].
    pub loss: f64,
    /// Sliding under load, ∫|v_t| dp_n [N·m].
    pub sliding: f64,
    /// What sliding did.
    pub slip: Slip,
    /// No finite impulse ends the approach; the other values are those where that shows.
    pub wedged: bool,
}

/// Part of m_nn below which a rate of v_n is round-off [–].
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;

/// Velocities and works along p_n.
struct ImpactPath {
    velocity: [f64; 2],
    impulse: [f64; 2],
    /// ∫v_n dp_n of the phase, ∫v_t dp_t of all \[J\].
    normal_work: f64,
    tangential_work: f64,
    /// ∫|v_t| dp_n [N·m].
    sliding: f64,
}

impl ImpactPath {
    /// Goes on by p_n, with dp_t/dp_n and dv/dp_n constant.
    fn advance(&mut self, by: f64, ratio: f64, rates: [f64; 2]) {
        self.normal_work += by * (self.velocity[0] + 0.5 * rates[0] * by);
        let sliding = self.velocity[1] + 0.5 * rates[1] * by;
        self.tangential_work += ratio * by * sliding;
        // Its sign stays on the way.
        self.sliding += by * sliding.abs();
        self.impulse[0] += by;
        self.impulse[1] += ratio * by;
        self.velocity[0] += rates[0] * by;
        self.velocity[1] += rates[1] * by;
    }
}

/// W in its parts, and μ.
struct ImpactMobility {
    normal: f64,
    coupling: f64,
    tangent: f64,
    friction: f64,
}

/// The way of sliding, ±1; none while sticking.
type Direction = Option<f64>;

impl ImpactMobility {
    fn new([[normal, coupling], [_, tangent]]: [[f64; 2]; 2], friction: f64) -> Self {
        let (normal, tangent) = (normal.max(0.0), tangent.max(0.0));
        // Round-off must not make an eigenvalue negative.
        let bound = (normal * tangent).sqrt();
        ImpactMobility {
            normal,
            coupling: coupling.max(-bound).min(bound),
            tangent,
            friction,
        }
    }

    /// How it goes on from v_t = 0.
    fn slip_direction_from_stick(&self) -> Direction {
        let sticks = self.coupling.abs() <= self.friction * self.tangent;
        (!sticks).then(|| self.coupling.signum())
    }

    /// det W, to its last digits where the products cancel (Kahan's way).
    fn determinant(&self) -> f64 {
        let square = self.coupling * self.coupling;
        let lost = self.coupling.mul_add(-self.coupling, square);
        (self.normal.mul_add(self.tangent, -square) + lost).max(0.0)
    }

    /// dp_t/dp_n and dv/dp_n.
    fn rates(&self, direction: Direction) -> (f64, [f64; 2]) {
        let ImpactMobility {
            normal,
            coupling,
            tangent,
            friction,
        } = *self;
        match direction {
            Some(direction) => {
                let ratio = -friction * direction;
                (
                    ratio,
                    [normal + coupling * ratio, coupling + tangent * ratio],
                )
            }
            None if tangent > 0.0 => (-coupling / tangent, [self.determinant() / tangent, 0.0]),
            None => (0.0, [normal, 0.0]),
        }
    }
}

/// What compression leaves for the rebound.
struct Rebound {
    restitution: f64,
    sense: Sense,
    /// v_n(0).
    approach: f64,
    /// p_c, and the work that went in.
    impulse: f64,
    work: f64,
}

impl Rebound {
    /// Normal impulse to the end, at a rate of v_n.
    fn missing(&self, walk: &ImpactPath, rate: f64) -> f64 {
        let v_n = walk.velocity[0];
        let missing = match self.sense {
            Sense::Energetic => {
                let work = self.restitution * self.restitution * self.work - walk.normal_work;
                if work > 0.0 {
                    2.0 * work / (v_n + (v_n * v_n + 2.0 * rate * work).sqrt())
                } else {
                    0.0
                }
            }
            Sense::Kinetic => (1.0 + self.restitution) * self.impulse - walk.impulse[0],
            Sense::Kinematic => {
                let velocity = -self.restitution * self.approach - v_n;
                if velocity > 0.0 { velocity / rate } else { 0.0 }
            }
        };
        missing.max(0.0)
    }
}

/// Velocities and impulses of an impact with v_n < 0, or v_n = 0 where sliding jams (the tangential impact: Lecornu 1905,
/// Génot and Brogliato 1999); otherwise nothing happens.
///
/// `inverse_mass` is W [1/kg], `velocity` (v_n, v_t) [m/s], `restitution` e from 0 to 1, `friction` μ at least 0, all finite.
pub fn resolve(
    inverse_mass: [[f64; 2]; 2],
    velocity: [f64; 2],
    restitution: f64,
    friction: f64,
    sense: Sense,
) -> Impulse {
    let mut course = ImpactCourse::new(
        ImpactMobility::new(inverse_mass, friction),
        velocity,
        (restitution, sense),
    );
    let begins = course.point.rates(course.direction).1[0] < 0.0;
    let hits = velocity[0] < 0.0 || (velocity[0] == 0.0 && begins);
    let mut next = if hits { Next::Goes } else { Next::Ended };
    while next == Next::Goes {
        next = course.advance();
    }
    let ImpactCourse {
        walk,
        rebound,
        slip,
        ..
    } = course;
    let compression = rebound.map_or(0.0, |rebound| rebound.work);
    let loss = compression - walk.normal_work - walk.tangential_work;
    Impulse {
        impulse: walk.impulse,
        velocity: walk.velocity,
        loss,
        sliding: walk.sliding,
        slip,
        wedged: next == Next::Wedged,
    }
}

/// An impact on its way, from one change of its rates to the next.
struct ImpactCourse {
    point: ImpactMobility,
    /// v_n(0), e and what it compares.
    approach: f64,
    restitution: f64,
    sense: Sense,
    direction: Direction,
    slip: Slip,
    walk: ImpactPath,
    /// None while it is compressed.
    rebound: Option<Rebound>,
}

/// How an impact goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    Goes,
    Ended,
    /// No normal impulse separates the bodies.
    Wedged,
}

impl ImpactCourse {
    fn new(point: ImpactMobility, velocity: [f64; 2], (restitution, sense): (f64, Sense)) -> Self {
        let slides = velocity[1] != 0.0;
        let direction = if slides {
            Some(velocity[1].signum())
        } else {
            point.slip_direction_from_stick()
        };
        let slip = match (slides, direction) {
            (true, _) => Slip::Continues,
            (false, Some(_)) => Slip::Starts,
            (false, None) => Slip::Sticks,
        };
        let walk = ImpactPath {
            velocity,
            impulse: [0.0; 2],
            normal_work: 0.0,
            tangential_work: 0.0,
            sliding: 0.0,
        };
        ImpactCourse {
            point,
            approach: velocity[0],
            restitution,
            sense,
            direction,
            slip,
            walk,
            rebound: None,
        }
    }

    /// Goes on to where sliding stops, compression ends or the rebound does.
    fn advance(&mut self) -> Next {
        let (ratio, rates) = self.point.rates(self.direction);
        let to_end = match &self.rebound {
            None if rates[0] > ROUND_OFF * self.point.normal => -self.walk.velocity[0] / rates[0],
            None => f64::INFINITY,
            Some(rebound) => rebound.missing(&self.walk, rates[0]),
        };
        let sliding = self.walk.velocity[1];
        let slows = self
            .direction
            .is_some_and(|sign| sign * rates[1] < 0.0 && sign * sliding > 0.0);
        let to_stop = if slows {
            -sliding / rates[1]
        } else {
            f64::INFINITY
        };
        let by = to_end.min(to_stop);
        if !by.is_finite() {
            return Next::Wedged;
        }
        self.walk.advance(by, ratio, rates);
        if to_stop < to_end {
            self.stop();
        } else if self.rebound.is_none() {
            self.turn();
        } else {
            return Next::Ended;
        }
        Next::Goes
    }

    /// Sliding stops, and may start the other way.
    fn stop(&mut self) {
        self.walk.velocity[1] = 0.0;
        self.direction = self.point.slip_direction_from_stick();
        self.slip = match self.direction {
            Some(_) => Slip::Reverses,
            None => Slip::Stops,
        };
    }

    /// Compression ends.
    fn turn(&mut self) {
        self.walk.velocity[0] = 0.0;
        self.rebound = Some(Rebound {
            restitution: self.restitution,
            sense: self.sense,
            approach: self.approach,
            impulse: self.walk.impulse[0],
            work: -self.walk.normal_work,
        });
        self.walk.normal_work = 0.0;
    }
}

#[cfg(test)]
mod tests;
