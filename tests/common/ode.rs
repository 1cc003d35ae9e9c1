//! Test problems for the integrators, with their solutions.

use linkdyn_engine::integrate::{Limits, Ode, Refused, Stepper, Tolerance};

/// y′ = f(t, y) as a function, refused where `allowed` says no.
pub struct Problem {
    pub n: usize,
    pub f: fn(f64, &[f64], &mut [f64]),
    pub allowed: fn(f64, &[f64]) -> bool,
    pub evaluations: u64,
    pub accepted: u64,
}

impl Problem {
    pub fn new(n: usize, f: fn(f64, &[f64], &mut [f64])) -> Self {
        Problem {
            n,
            f,
            allowed: |_, _| true,
            evaluations: 0,
            accepted: 0,
        }
    }
}

impl Ode for Problem {
    fn dimension(&self) -> usize {
        self.n
    }

    fn eval(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        self.evaluations += 1;
        if !(self.allowed)(t, y) {
            return Err(Refused);
        }
        (self.f)(t, y, dy);
        Ok(())
    }

    fn accept(&mut self, _: f64, _: &[f64]) {
        self.accepted += 1;
    }
}

/// θ″ = −θ.
pub fn harmonic(_: f64, y: &[f64], dy: &mut [f64]) {
    (dy[0], dy[1]) = (y[1], -y[0]);
}

/// θ″ = −sin θ.
pub fn pendulum(_: f64, y: &[f64], dy: &mut [f64]) {
    (dy[0], dy[1]) = (y[1], -y[0].sin());
}

/// r″ = −r / |r|³.
pub fn kepler(_: f64, y: &[f64], dy: &mut [f64]) {
    let cube = (y[0] * y[0] + y[1] * y[1]).powf(-1.5);
    (dy[0], dy[1], dy[2], dy[3]) = (y[2], y[3], -y[0] * cube, -y[1] * cube);
}

/// Van der Pol's oscillator, μ = 1000.
pub fn van_der_pol(_: f64, y: &[f64], dy: &mut [f64]) {
    (dy[0], dy[1]) = (y[1], 1000.0 * (1.0 - y[0] * y[0]) * y[1] - y[0]);
}

/// Robertson's reactions.
pub fn robertson(_: f64, y: &[f64], dy: &mut [f64]) {
    let (slow, fast, faster) = (0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] * y[1]);
    (dy[0], dy[1], dy[2]) = (fast - slow, slow - fast - faster, faster);
}

/// The same relative and absolute tolerance.
pub fn tolerance(n: usize, tolerance: f64) -> Tolerance {
    Tolerance {
        rtol: tolerance,
        atol: vec![tolerance; n],
        cap: Vec::new(),
    }
}

/// Steps of one length, whatever their error.
pub fn fixed(n: usize, h: f64) -> (Tolerance, Limits) {
    (
        tolerance(n, 1e3),
        Limits {
            initial_step: Some(h),
            max_step: Some(h),
            ..Limits::default()
        },
    )
}

/// Steps to the end.
pub fn run(
    stepper: &mut dyn Stepper,
    problem: &mut dyn Ode,
    start: f64,
    y: &[f64],
    end: f64,
) -> Vec<f64> {
    stepper.start(problem, start, y, end).expect("starts");
    while stepper.t() != end {
        stepper.step(problem, end).expect("goes on");
    }
    stepper.y().to_vec()
}

/// y at 1, 2, … up to `end`, by dense output.
pub fn sample(
    stepper: &mut dyn Stepper,
    problem: &mut dyn Ode,
    y: &[f64],
    end: f64,
) -> Vec<Vec<f64>> {
    let mut samples: Vec<Vec<f64>> = Vec::new();
    stepper.start(problem, 0.0, y, end).expect("starts");
    while stepper.t() != end {
        stepper.step(problem, end).expect("goes on");
        while samples.len() as f64 + 1.0 <= stepper.t() {
            let mut at = vec![0.0; y.len()];
            stepper
                .interpolate(problem, samples.len() as f64 + 1.0, &mut at)
                .expect("no refusal");
            samples.push(at);
        }
    }
    samples
}

/// Largest difference.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
}

/// A harmonic motion from (1, 0).
pub fn harmonic_at(t: f64) -> Vec<f64> {
    vec![t.cos(), -t.sin()]
}

/// The pendulum released at 1 rad: sin(θ/2) = k sn(K − t), by the arithmetic-geometric mean.
pub fn pendulum_at(t: f64) -> Vec<f64> {
    let k = 0.5_f64.sin();
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    let mut ratios = Vec::new();
    while ratios.len() < 6 {
        ratios.push(0.5 * (a - b) / (0.5 * (a + b)));
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let quarter = std::f64::consts::FRAC_PI_2 / a;
    let mut phase = f64::from(1 << ratios.len()) * a * (quarter - t);
    for ratio in ratios.iter().rev() {
        phase = 0.5 * (phase + (ratio * phase.sin()).asin());
    }
    vec![2.0 * (k * phase.sin()).asin(), -2.0 * k * phase.cos()]
}

/// Kepler's motion of eccentricity 0.5 from its pericentre, with period 2π.
pub fn kepler_at(t: f64) -> Vec<f64> {
    let mut anomaly: f64 = t;
    for _ in 0..50 {
        anomaly -= (anomaly - 0.5 * anomaly.sin() - t) / (1.0 - 0.5 * anomaly.cos());
    }
    let (r, minor) = (1.0 - 0.5 * anomaly.cos(), 0.75_f64.sqrt());
    vec![
        anomaly.cos() - 0.5,
        minor * anomaly.sin(),
        -anomaly.sin() / r,
        minor * anomaly.cos() / r,
    ]
}

/// A problem with its start and solution.
pub struct Solved {
    pub name: &'static str,
    pub f: fn(f64, &[f64], &mut [f64]),
    pub at: fn(f64) -> Vec<f64>,
}

pub const SOLVED: [Solved; 3] = [
    Solved {
        name: "harmonic",
        f: harmonic,
        at: harmonic_at,
    },
    Solved {
        name: "pendulum",
        f: pendulum,
        at: pendulum_at,
    },
    Solved {
        name: "kepler",
        f: kepler,
        at: kepler_at,
    },
];

impl Solved {
    pub fn problem(&self) -> Problem {
        Problem::new(self.start().len(), self.f)
    }

    pub fn start(&self) -> Vec<f64> {
        (self.at)(0.0)
    }

    /// Largest error of samples at 1, 2, ….
    pub fn error(&self, samples: &[Vec<f64>]) -> f64 {
        (1..)
            .zip(samples)
            .map(|(t, y)| distance(y, &(self.at)(f64::from(t))))
            .fold(0.0, f64::max)
    }
}
