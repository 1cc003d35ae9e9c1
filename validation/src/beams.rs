//! Cantilevers of beams: the elastica, thick ones that stretch and shear, and ones that turn.
//!
//! Sources and formulas stand in `validation/beams/SOURCE.md`.

use linkdyn_engine::analysis;
use linkdyn_model::Checked;
use serde_json::{Value, json};
use std::f64::consts::PI;

use super::{CaseError, CaseReport, Claim, Setting, broken, finished};

/// A line about the case.
pub const ABOUT: &str = "Chains of beams: elastica, thick cantilevers with and without shear, a turning bar and its frequencies, Euler's load";

/// Part of the length by which the end of 32 parts may be off; and what is extrapolated.
const OF_32: f64 = 1e-6;
const EXTRAPOLATED: f64 = 1e-9;
/// Relative, of frequencies, which are known to 6 digits behind the point.
const OF_FREQUENCIES: f64 = 1e-6;

/// A cantilever along x from the ground, in equal parts with lumped masses.
#[derive(Clone, Copy)]
struct Cantilever {
    /// L \[m\], EA \[N\], EI [N·m²], GA \[N\] where it shears.
    length: f64,
    axial: f64,
    bending: f64,
    shear: Option<f64>,
    /// Mass and rotary inertia by length [kg/m, kg·m].
    heavy: [f64; 2],
}

/// Lowest two frequencies of a cantilever in the plane of its turning by Ω*, by √(EI/ρA L⁴).
pub(super) const TURNING: [(f64, [f64; 2]); 7] = [
    (0.0, [3.516_015, 22.034_492]),
    (1.0, [3.543_236, 22.158_458]),
    (2.0, [3.621_797, 22.526_311]),
    (4.0, [3.897_723, 23.941_501]),
    (6.0, [4.263_225, 26.129_042]),
    (10.0, [5.048_975, 32.119_686]),
    (12.0, [5.427_049, 35.636_976]),
];

const SLENDER: Cantilever = Cantilever {
    length: 1.0,
    axial: 1e6,
    bending: 1.0,
    shear: None,
    heavy: [0.0; 2],
};

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let mut claims = Vec::new();
    small(setting, &mut claims)?;
    elastica(setting, &mut claims)?;
    thick(setting, &mut claims)?;
    turning(setting, &mut claims)?;
    buckling(setting, &mut claims)?;
    Ok(CaseReport {
        text: String::new(),
        claims,
    })
}

/// Small loads: P L³/3 EI + P L/GA across, N L/EA along, for any number of parts.
fn small(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    for (n, shear) in [(1, None), (5, None), (1, Some(30.0)), (5, Some(30.0))] {
        let bar = Cantilever {
            axial: 1e3,
            shear,
            ..SLENDER
        };
        let name = |what: &str| format!("small load, {n} parts, GA {shear:?}: {what}");
        let load = 1e-7;
        let known = load / 3.0 + shear.map_or(0.0, |shear| load / shear);
        let [across, along] = [
            bar.tip(n, [0.0, load], setting)?[1],
            bar.tip(n, [1.0, 0.0], setting)?[0],
        ];
        claims.push(Claim::near(&name("across [m]"), known, across, 1e-12));
        claims.push(Claim::near(&name("along [m]"), 1e-3, along, 1e-14));
    }
    Ok(())
}

/// Under a dead load at its end, P L²/EI; the stretch is extrapolated to none.
fn elastica(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    for (load, down, short) in [
        (1.0, 0.301_720_773_801, 0.056_433_236_283_4),
        (2.0, 0.493_457_480_397, 0.160_641_720_825),
        (5.0, 0.713_791_523_612, 0.387_628_360_724),
        (10.0, 0.810_609_024_88, 0.554_995_597_754),
    ] {
        let tip = |n: usize| -> Result<[f64; 2], CaseError> {
            let of = |axial: f64| Cantilever { axial, ..SLENDER }.tip(n, [0.0, -load], setting);
            let [soft, hard] = [of(2e5)?, of(4e5)?];
            Ok([0, 1].map(|k: usize| 2.0 * hard[k] - soft[k]))
        };
        let ([x, y], [_, coarse]) = (tip(32)?, tip(16)?);
        let name = |what: &str| format!("elastica, P L²/EI = {load}, 32 parts: {what}");
        claims.push(Claim::near(&name("w/L"), down, -y, OF_32));
        claims.push(Claim::near(&name("u/L"), short, -x, OF_32));
        let order = ((coarse + down) / (y + down)).abs().log2();
        claims.push(Claim::near(
            &name("order of the error of w"),
            4.0,
            order,
            0.1,
        ));
    }
    Ok(())
}

/// Bars of 0.1 m width under a load at their ends.
fn thick(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    let young = 2.07e11;
    let of = |height: f64, shears: bool| {
        let (area, nu) = (0.1 * height, 0.3);
        let share = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
        Cantilever {
            length: 2.0,
            axial: young * area,
            bending: young * area * height * height / 12.0,
            shear: shears.then_some(7.9615e10 * share * area),
            heavy: [0.0; 2],
        }
    };
    let quarter = of(0.1, false);
    for (name, bar, load, known) in [
        (
            "0.1 m, 3 EI/L²",
            quarter,
            0.75 * quarter.bending,
            [-0.508_537_304_326, -1.207_239_854_550],
        ),
        (
            "0.5 m with shear",
            of(0.5, true),
            6.25e7,
            [-0.150_971_190_544, -0.710_568_733_448],
        ),
        (
            "0.1 m with shear",
            of(0.1, true),
            5e5,
            [-0.144_760_105_730, -0.680_864_492_154],
        ),
        (
            "0.5 m",
            of(0.5, false),
            6.25e7,
            [-0.141_346_611_606, -0.682_571_794_942],
        ),
        (
            "0.1 m",
            of(0.1, false),
            5e5,
            [-0.144_374_596_034, -0.679_745_559_638],
        ),
    ] {
        let load = [0.0, -load];
        let tip = |n: usize| bar.tip(n, load, setting);
        let tips = [tip(8)?, tip(16)?, tip(32)?];
        for (k, axis) in ["x", "y"].into_iter().enumerate() {
            let name = |what: &str| format!("height {name}, {what}: displacement along {axis} [m]");
            claims.push(Claim::near(
                &name("32 parts"),
                known[k],
                tips[2][k],
                OF_32 * bar.length,
            ));
            let best = extrapolated(tips.map(|tip| tip[k]));
            claims.push(Claim::near(
                &name("extrapolated"),
                known[k],
                best,
                EXTRAPOLATED,
            ));
        }
    }
    Ok(())
}

/// The stretch of a bar that turns, tan(kL)/k − L; in the plane of its turning the frequencies of a cantilever, by √(EI/ρA L⁴).
fn turning(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    let bar = Cantilever {
        length: 10.0,
        axial: 2.8e7,
        bending: 1.4e4,
        shear: None,
        heavy: [1.2, 0.0],
    };
    let stretch = |n: usize| -> Result<f64, CaseError> {
        let mut chain = bar.chain(n);
        chain["forces"] = bar.centrifugal(n, 6.0, false);
        Ok(place(&chain, n, setting)?[0] - bar.length)
    };
    let k = 6.0 * (1.2_f64 / 2.8e7).sqrt();
    let known = (bar.length * k).tan() / k - bar.length;
    let best = extrapolated([stretch(8)?, stretch(16)?, stretch(32)?]);
    claims.push(Claim::near(
        "stretch of a bar that turns [m]",
        known,
        best,
        1e-12,
    ));
    for (rate, known) in TURNING {
        let of = |n: usize| SLENDER.frequencies(n, rate, setting);
        let found = [of(8)?, of(16)?, of(32)?];
        for (k, known) in known.into_iter().enumerate() {
            let best = extrapolated(found.map(|each| each[k]));
            let name = format!("turning cantilever, Ω* = {rate}: frequency {}", k + 1);
            claims.push(Claim::near(&name, known, best, OF_FREQUENCIES * known));
        }
    }
    Ok(())
}

/// The push at which the lowest frequency vanishes, by π² EI/4L².
fn buckling(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    let bar = Cantilever {
        axial: 1e7,
        heavy: [1.0, 1e-4],
        ..SLENDER
    };
    let lowest = |share: f64| -> Result<f64, CaseError> {
        let mut chain = bar.chain(8);
        let push = -share * PI * PI / 4.0;
        chain["forces"] =
            json!({ "push": { "type": "force", "at": "n8.A", "vector": [push, 0.0] } });
        let found = modes(&chain, setting)?;
        // λ² = −ω², which is negative beyond it.
        let squares = found
            .modes
            .iter()
            .map(|mode| mode.eigenvalue[1].powi(2) - mode.eigenvalue[0].powi(2));
        Ok(squares.fold(f64::INFINITY, f64::min))
    };
    let (below, above) = (lowest(0.999)?, lowest(1.001)?);
    let share = 0.999 + 0.002 * below / (below - above);
    claims.push(Claim::near(
        "push at which a column buckles, by Euler's, 8 parts",
        1.0,
        share,
        1e-5,
    ));
    Ok(())
}

impl Cantilever {
    fn section(&self) -> Value {
        let mut section = json!({ "type": "general", "young_modulus": 1.0, "area": self.axial, "second_moment": self.bending });
        if let Some(shear) = self.shear {
            // G = E/2.
            section["poisson_ratio"] = json!(0.0);
            section["shear_area"] = json!(2.0 * shear);
        }
        section
    }

    /// Nodes 1 … n, without loads.
    fn chain(&self, n: usize) -> Value {
        let step = self.length / n as f64;
        let mut bodies = json!({ "ground": { "points": { "A": [0.0, 0.0] } } });
        let mut joints = json!({});
        for k in 1..=n {
            let [mass, inertia] = self.heavy.map(|by| by * self.part(k, n));
            let before = if k == 1 {
                "ground.A".into()
            } else {
                format!("n{}.A", k - 1)
            };
            bodies[format!("n{k}")] = json!({ "mass": mass, "inertia": inertia, "com": [0.0, 0.0],
                "points": { "A": [0.0, 0.0] }, "pose": { "position": [step * k as f64, 0.0] } });
            joints[format!("b{k}")] = json!({ "type": "beam", "between": [before, format!("n{k}.A")], "section": self.section() });
        }
        json!({ "format": "linkdyn/1", "units": "SI", "bodies": bodies, "joints": joints, "analysis": { "type": "statics" } })
    }

    /// The length that belongs to a node \[m\].
    fn part(&self, k: usize, n: usize) -> f64 {
        let part = if k == n { 0.5 } else { 1.0 };
        part * self.length / n as f64
    }

    /// Ω² m r of each node, along the bar, and across it where asked.
    fn centrifugal(&self, n: usize, rate: f64, across: bool) -> Value {
        let mut forces = json!({});
        for k in 1..=n {
            let by = self.heavy[0] * self.part(k, n) * rate * rate;
            let along = |axis: &str| json!(format!("={by:?}*1 kg/s^2*n{k}.{axis}"));
            let vector = [along("x"), if across { along("y") } else { json!(0.0) }];
            forces[format!("c{k}")] =
                json!({ "type": "force", "at": format!("n{k}.A"), "vector": vector });
        }
        forces
    }

    /// Displacement of the end under a load there \[m\].
    fn tip(&self, n: usize, load: [f64; 2], setting: &Setting) -> Result<[f64; 2], CaseError> {
        let mut chain = self.chain(n);
        chain["forces"] =
            json!({ "tip": { "type": "force", "at": format!("n{n}.A"), "vector": load } });
        let [x, y] = place(&chain, n, setting)?;
        Ok([x - self.length, y])
    }

    /// The lowest two in the frame that turns; what stretch and rotary inertia do to them, extrapolated to none.
    fn frequencies(&self, n: usize, rate: f64, setting: &Setting) -> Result<[f64; 2], CaseError> {
        let of = |axial: f64, inertia: f64| -> Result<[f64; 2], CaseError> {
            let own = Cantilever {
                axial,
                heavy: [1.0, inertia],
                ..*self
            };
            let mut chain = own.chain(n);
            if rate > 0.0 {
                chain["forces"] = own.centrifugal(n, rate, true);
            }
            let found = modes(&chain, setting)?;
            let mut all: Vec<f64> = found.modes.iter().map(analysis::Mode::frequency).collect();
            all.sort_by(f64::total_cmp);
            match all[..] {
                [first, second, ..] => Ok([first, second]),
                _ => Err(broken("a chain has fewer than two frequencies")),
            }
        };
        let (here, stiffer, rounder) = (of(2e5, 1e-5)?, of(4e5, 1e-5)?, of(2e5, 2e-5)?);
        Ok([0, 1].map(|k: usize| here[k] + 2.0 * (stiffer[k] - here[k]) - (rounder[k] - here[k])))
    }
}

pub(super) fn read(model: &Value) -> Result<Checked, CaseError> {
    let loaded = linkdyn_model::load(model.to_string().as_bytes(), &[]);
    Ok(loaded.map_err(|said| broken(format!("{said:?}")))?.model)
}

fn modes(model: &Value, setting: &Setting) -> Result<analysis::Linearised, CaseError> {
    analysis::modes(&read(model)?, false, &setting.control)
        .map_err(|said| broken(format!("{said:?}")))
}

/// Where the last node is in equilibrium \[m\].
fn place(model: &Value, n: usize, setting: &Setting) -> Result<[f64; 2], CaseError> {
    let run = finished(analysis::run(&read(model)?, &setting.control))?;
    let at = |axis: &str| {
        let values = run.trajectory.values(&format!("n{n}.{axis}"));
        let first = values.and_then(|values| values.first().copied());
        first.ok_or_else(|| broken("a node has no place"))
    };
    Ok([at("x")?, at("y")?])
}

/// What finer and finer parts go to, each twice as many as before, with errors of order 2 and 4.
fn extrapolated([coarse, fine, finest]: [f64; 3]) -> f64 {
    let [first, second] = [(4.0 * fine - coarse) / 3.0, (4.0 * finest - fine) / 3.0];
    (16.0 * second - first) / 15.0
}
