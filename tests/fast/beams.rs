//! Beams against the elastica, beams with shear, a bar that turns, frequencies of a turning cantilever, and Euler's load. The known numbers are
//! elliptic integrals, boundary value problems and closed forms computed by other programs.

use crate::mechanisms::*;
use linkdyn_engine::analysis::{Control, modes};
use serde_json::{Value, json};

/// A cantilever along x from the ground, in equal parts with lumped masses; EA, EI, and GA where it shears.
struct Cantilever {
    length: f64,
    axial: f64,
    bending: f64,
    shear: Option<f64>,
    /// Mass and rotary inertia by length [kg/m, kg·m].
    heavy: [f64; 2],
}

const SLENDER: Cantilever = Cantilever {
    length: 1.0,
    axial: 1e6,
    bending: 1.0,
    shear: None,
    heavy: [0.0; 2],
};

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
            let part = if k == n { 0.5 * step } else { step };
            let [mass, inertia] = self.heavy.map(|by| by * part);
            let before = if k == 1 {
                "ground.A".into()
            } else {
                format!("n{}.A", k - 1)
            };
            bodies[format!("n{k}")] = json!({ "mass": mass, "inertia": inertia, "com": [0.0, 0.0],
                "points": { "A": [0.0, 0.0] }, "pose": { "position": [step * k as f64, 0.0] } });
            joints[format!("b{k}")] = json!({ "type": "beam", "between": [before, format!("n{k}.A")], "section": self.section() });
        }
        let mut chain = model(bodies, joints, json!({}));
        chain["gravity"] = json!([0.0, 0.0]);
        chain["analysis"] = json!({ "type": "statics" });
        chain
    }

    /// Displacement of the end under a load there.
    fn tip(&self, n: usize, load: [f64; 2]) -> [f64; 2] {
        let mut chain = self.chain(n);
        chain["forces"] =
            json!({ "tip": { "type": "force", "at": format!("n{n}.A"), "vector": load } });
        let run = completed(&chain);
        let at = |axis: &str| column(&run, &format!("n{n}.{axis}"))[0];
        [at("x") - self.length, at("y")]
    }

    /// The lowest two angular frequencies of a cantilever that turns at a rate, in the frame that turns with it; what its extension does
    /// to it, and its rotary inertia, extrapolated to none.
    fn frequencies(&self, n: usize, rate: f64) -> [f64; 2] {
        let of = |axial: f64, inertia: f64| {
            let own = Cantilever {
                axial,
                heavy: [1.0, inertia],
                ..*self
            };
            let mut chain = own.chain(n);
            chain["forces"] = own.centrifugal(n, rate, true);
            let found = modes(&loaded(&chain).model, false, &Control::default()).expect("modes");
            let mut all: Vec<f64> = found.modes.iter().map(|mode| mode.frequency()).collect();
            all.sort_by(f64::total_cmp);
            [all[0], all[1]]
        };
        let (here, stiffer, rounder) = (of(2e5, 1e-5), of(4e5, 1e-5), of(2e5, 2e-5));
        [0, 1].map(|k: usize| here[k] + 2.0 * (stiffer[k] - here[k]) - (rounder[k] - here[k]))
    }

    /// Ω² m r of each node, along the bar, and across it where asked.
    fn centrifugal(&self, n: usize, rate: f64, across: bool) -> Value {
        let mut forces = json!({});
        for k in 1..=n {
            let part = if k == n { 0.5 } else { 1.0 } * self.length / n as f64;
            let by = self.heavy[0] * part * rate * rate;
            let along = |axis: &str| json!(format!("={by:?}*1 kg/s^2*n{k}.{axis}"));
            let vector = [along("x"), if across { along("y") } else { json!(0.0) }];
            forces[format!("c{k}")] =
                json!({ "type": "force", "at": format!("n{k}.A"), "vector": vector });
        }
        forces
    }
}

/// What finer and finer parts go to, with errors of order 2 and then 4; each list has twice the parts of the one before.
fn extrapolated(values: &[f64]) -> f64 {
    let next = |values: &[f64], by: f64| -> Vec<f64> {
        let pairs = values.windows(2);
        pairs
            .map(|pair| (by * pair[1] - pair[0]) / (by - 1.0))
            .collect()
    };
    next(&next(values, 4.0), 16.0)[0]
}

/// The elastica under a dead load at its end, P L²/EI = 1, 2, 5, 10; elliptic integrals. The stretch is extrapolated to none.
#[test]
fn a_slender_cantilever_is_the_elastica() {
    let stiff = |axial: f64| Cantilever { axial, ..SLENDER };
    for (load, down, short) in [
        (1.0, 0.301_720_773_801, 0.056_433_236_283_4),
        (2.0, 0.493_457_480_397, 0.160_641_720_825),
        (5.0, 0.713_791_523_612, 0.387_628_360_724),
        (10.0, 0.810_609_024_88, 0.554_995_597_754),
    ] {
        let off = [8, 16, 32].map(|n: usize| {
            let [soft, hard] = [2e5, 4e5].map(|axial: f64| stiff(axial).tip(n, [0.0, -load]));
            let tip = [0, 1].map(|k: usize| 2.0 * hard[k] - soft[k]);
            [(tip[1] + down).abs(), (tip[0] + short).abs()]
        });
        assert!(off[2].iter().all(|off| *off < 1.3e-7), "{load}: {off:?}");
        let order = |k: usize| (off[0][k] / off[1][k]).log2();
        assert!(order(0) > 3.9 && order(1) > 3.9, "{load}: {off:?}");
    }
}

/// A thick cantilever that stretches (converged values of another program, and of a boundary value problem), and two that shear, of 0.1 m width
/// and this height, under 5e8 h³ N; without and with shear.
#[test]
fn thick_cantilevers_stretch_and_shear() {
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
    let bent = of(0.1, false);
    let cases = [
        (
            of(0.1, false),
            0.75 * bent.bending,
            [-0.508_537_304_326, -1.207_239_854_550],
        ),
        (
            of(0.5, true),
            6.25e7,
            [-0.150_971_190_544, -0.710_568_733_448],
        ),
        (of(0.1, true), 5e5, [-0.144_760_105_730, -0.680_864_492_154]),
        (
            of(0.5, false),
            6.25e7,
            [-0.141_346_611_606, -0.682_571_794_942],
        ),
        (
            of(0.1, false),
            5e5,
            [-0.144_374_596_034, -0.679_745_559_638],
        ),
    ];
    for (bar, load, known) in cases {
        let tips = [8, 16, 32, 64].map(|n: usize| bar.tip(n, [0.0, -load]));
        for k in 0..2 {
            close(tips[2][k], known[k], 1e-6 * bar.length);
            let values = tips.map(|tip| tip[k]);
            let order = ((values[2] - known[k]) / (values[3] - known[k])).log2();
            // Errors of order 2 and 4 may be opposed.
            assert!(order > 1.85, "{known:?}: order {order}");
            close(extrapolated(&values[1..]), known[k], 1e-9);
        }
    }
}

/// Of small loads: w = P L³/3 EI and P L³/3 EI + P L/GA, the angle P L²/2 EI, for any number of parts; u = N L/EA.
#[test]
fn small_deflections_are_those_of_the_textbook() {
    for (n, shear) in [(1, None), (5, None), (1, Some(30.0)), (5, Some(30.0))] {
        let bar = Cantilever {
            axial: 1e3,
            shear,
            ..SLENDER
        };
        let load = 1e-7;
        let known = load / 3.0 + shear.map_or(0.0, |shear| load / shear);
        close(bar.tip(n, [0.0, load])[1], known, 1e-12 * known.max(1.0));
        close(bar.tip(n, [1.0, 0.0])[0], 1e-3, 1e-14);
    }
}

/// A bar that turns stretches to tan(kL)/k, k = Ω √(ρA/EA) (the bar of the spin-up by Simo and Vu-Quoc 1986).
#[test]
fn a_turning_bar_stretches() {
    let bar = Cantilever {
        length: 10.0,
        axial: 2.8e7,
        bending: 1.4e4,
        shear: None,
        heavy: [1.2, 0.0],
    };
    let tips = [8, 16, 32].map(|n: usize| {
        let mut chain = bar.chain(n);
        chain["forces"] = bar.centrifugal(n, 6.0, false);
        column(&completed(&chain), &format!("n{n}.x"))[0] - 10.0
    });
    let k = 6.0 * (1.2_f64 / 2.8e7).sqrt();
    close(extrapolated(&tips), (10.0 * k).tan() / k - 10.0, 1e-13);
    close(extrapolated(&tips), 5.143_174_550_426e-4, 1e-13);
}

/// In the plane of its turning, by √(EI/ρA L⁴) (values of another program; they meet Wright et al. 1982 out of the plane).
#[test]
fn a_turning_cantilever_has_the_known_frequencies() {
    for (rate, known) in [
        (0.0, [3.516_015, 22.034_492]),
        (2.0, [3.621_797, 22.526_311]),
        (12.0, [5.427_049, 35.636_976]),
    ] {
        let found = [8, 16, 32].map(|n: usize| SLENDER.frequencies(n, rate));
        for k in 0..2 {
            let own = extrapolated(&found.map(|each| each[k]));
            close(own, known[k], 1e-6 * known[k]);
        }
    }
}

/// The lowest frequency vanishes under Euler's load π² EI/4L²: its square falls nearly in a line, and the straight bar is unstable above.
#[test]
fn a_column_buckles_under_the_load_of_euler() {
    let euler = std::f64::consts::PI.powi(2) / 4.0;
    let bar = Cantilever {
        heavy: [1.0, 1e-4],
        ..SLENDER
    };
    let lowest = |share: f64| {
        let mut chain = bar.chain(8);
        chain["forces"] =
            json!({ "push": { "type": "force", "at": "n8.A", "vector": [-share * euler, 0.0] } });
        let found = modes(&loaded(&chain).model, false, &Control::default()).expect("modes");
        let squares = found.modes.iter().map(|mode| {
            let [re, im] = mode.eigenvalue;
            // λ² = −ω²
            im * im - re * re
        });
        squares.fold(f64::INFINITY, f64::min)
    };
    let [free, half] = [lowest(0.0), lowest(0.5)];
    assert!((half / free - 0.5).abs() < 0.02, "{free} {half}");
    let (below, above) = (lowest(0.999), lowest(1.001));
    assert!(below > 0.0 && above < 0.0, "{below} {above}");
    // Where the line between both meets zero.
    let share = 0.999 + 0.002 * below / (below - above);
    close(share, 1.0, 1e-5);
}

/// A bar that swings wide, alone: its energy stays, and its momenta; with damping the energy falls by what is dissipated.
#[test]
fn a_free_bar_keeps_its_energy() {
    for damping in [0.0, 2e-3] {
        let bar = Cantilever {
            axial: 400.0,
            shear: Some(120.0),
            heavy: [1.0, 1e-3],
            ..SLENDER
        };
        let mut chain = bar.chain(3);
        for joint in chain["joints"]
            .as_object_mut()
            .expect("joints")
            .values_mut()
        {
            joint["damping_time"] = json!(damping);
        }
        chain["bodies"]["n0"] = json!({ "mass": 0.2, "inertia": 0.01, "com": [0.05, 0.02], "points": { "A": [0.0, 0.0] } });
        chain["joints"]["b1"]["between"][0] = json!("n0.A");
        chain["initial"] =
            json!({ "n3": { "vy": 1.5, "angular_velocity": 2.0 }, "n1": { "vx": -0.4 } });
        chain["analysis"] = json!({ "type": "dynamics", "end": 0.5, "outputs": 51,
            "solver": { "method": "dop853", "rtol": 1e-11, "atol": 1e-13 } });
        let run = completed(&chain);
        let total: Vec<f64> = column(&run, "energy.kinetic")
            .iter()
            .zip(column(&run, "energy.potential"))
            .map(|(kinetic, potential)| kinetic + potential)
            .collect();
        if damping == 0.0 {
            for energy in &total {
                close(*energy, total[0], 1e-9 * total[0]);
            }
        } else {
            assert!(
                total.windows(2).all(|pair| pair[1] < pair[0] + 1e-12),
                "{total:?}"
            );
        }
        let imbalance = run.report.quality.power_imbalance.expect("known");
        assert!(imbalance < 1e-9, "{imbalance}");
        let bodies = [("n0", 0.2, 0.01, [0.05, 0.02])]
            .into_iter()
            .chain((1..=3).map(|k: usize| {
                let part = if k == 3 { 0.5 } else { 1.0 } / 3.0;
                (["n1", "n2", "n3"][k - 1], part, 1e-3 * part, [0.0; 2])
            }));
        let bodies: Vec<_> = bodies.collect();
        let (first, last) = (momenta(&run, 0, &bodies), momenta(&run, 50, &bodies));
        for (first, last) in first.iter().zip(last) {
            close(last, *first, 1e-9);
        }
    }
}

/// A bar made bent, by the angles of its ends, rests as it was made; its reaction is none.
#[test]
fn a_bar_may_be_made_bent_and_short() {
    let mut chain = SLENDER.chain(1);
    chain["joints"]["b1"]["length"] = json!(0.9);
    chain["joints"]["b1"]["angles"] = json!([0.2, -0.1]);
    let run = completed(&chain);
    let at = |name: &str| column(&run, name)[0];
    // Straight in the direction of its first end, and turned against its last one.
    close(at("n1.x"), 0.9 * 0.2_f64.cos(), 1e-9);
    close(at("n1.y"), 0.9 * 0.2_f64.sin(), 1e-9);
    close(at("n1.angle"), 0.3, 1e-9);
    for quantity in ["fx", "fy", "torque"] {
        close(at(&format!("joint.b1.{quantity}")), 0.0, 1e-9);
    }
}
