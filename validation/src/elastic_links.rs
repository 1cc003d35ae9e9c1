//! Elastic links by few amplitudes: Simeon's slider-crank, bars that turn, statics, and stiffer and stiffer ones.
//!
//! Sources and formulas stand in `validation/elastic-links/SOURCE.md`.

use std::f64::consts::PI as TRUE_PI;
use std::fmt::Write as _;

use linkdyn_engine::analysis::{self, Outcome};
use serde_json::{Value, json};

use super::beams::{TURNING, read};
use super::{CaseError, CaseReport, Claim, Setting, at_most, broken, finished};

/// A line about the case.
pub const ABOUT: &str = "Elastic links: Simeon's slider-crank, spin-up, turning cantilevers, statics, and the way back to rigid links";

/// As in the published problem.
const PI: f64 = 31_415_927.0 / 1e7;
const CRANK: f64 = 0.15;
const ROD: f64 = 0.3;
/// Width and height of the rod \[m\], Young's modulus \[Pa\], density [kg/m³].
const SIDE: f64 = 0.008;
const YOUNG: f64 = 2e11;
const DENSITY: f64 = 7870.0;

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let mut report = CaseReport::default();
    simeon(setting, &mut report)?;
    let claims = &mut report.claims;
    consistent(setting, claims)?;
    stretch(setting, claims)?;
    spin_up(setting, claims)?;
    turning(setting, claims)?;
    statics(setting, claims)?;
    stiffer(setting, claims)?;
    ledger(setting, claims)?;
    Ok(report)
}

/// The slider-crank with what describes its rod.
fn slider_crank(elastic: Value, of_rod: Value, solver: [f64; 2], method: &str) -> Value {
    let mut rod = json!({ "points": { "A": [0.0, 0.0], "B": [ROD, 0.0] },
        "pose": { "position": [CRANK, 0.0] }, "elastic": elastic });
    for (key, value) in of_rod.as_object().into_iter().flatten() {
        rod[key] = value.clone();
    }
    let [rtol, atol] = solver;
    json!({ "format": "linkdyn/1", "units": "SI", "bodies": {
            "ground": { "points": { "O": [0.0, 0.0] } },
            "crank": { "mass": 0.36, "inertia": 0.002_727 - 0.36 * CRANK * CRANK / 4.0, "com": [CRANK / 2.0, 0.0],
                "points": { "O": [0.0, 0.0], "A": [CRANK, 0.0] } },
            "rod": rod,
            "slider": { "mass": 0.075_552, "inertia": 0.0, "com": [0.0, 0.0], "points": { "B": [0.0, 0.0] },
                "pose": { "position": [CRANK + ROD, 0.0] } } },
        "joints": {
            "main": { "type": "revolute", "between": ["ground.O", "crank.O"] },
            "pin": { "type": "revolute", "between": ["crank.A", "rod.A"] },
            "wrist": { "type": "revolute", "between": ["rod.B", "slider.B"] },
            "guide": { "type": "prismatic", "between": ["ground.O", "slider.B"], "axis": [1.0, 0.0] } },
        "drivers": { "motor": { "type": "rotation", "body": "crank",
            "motion": { "type": "constant_velocity", "velocity": 150.0 } } },
        "analysis": { "type": "dynamics", "end": 0.1, "outputs": 2,
            "solver": { "rtol": rtol, "atol": atol, "method": method } } })
}

/// The problem as published, by its matrices.
fn published(solver: [f64; 2], method: &str) -> Value {
    let (volume, stiffness) = (SIDE * SIDE * ROD, YOUNG * SIDE * SIDE / ROD);
    let (mass, bending) = (DENSITY * volume, stiffness * (SIDE / ROD).powi(2));
    let rotation = [-16.0 / PI.powi(3), 8.0 / PI.powi(3) - 1.0 / PI, 0.5 / PI];
    let [b13, b14, b24] = rotation.map(|by| DENSITY * volume * by);
    let moment = DENSITY * volume * ROD;
    let modal = json!({
        "mass": [[mass / 2.0, 0, 0, 0], [0, mass / 2.0, 0, 0], [0, 0, 8.0 * mass, mass], [0, 0, mass, 2.0 * mass]],
        "stiffness": [[bending * PI.powi(4) / 24.0, 0, 0, 0], [0, bending * 2.0 * PI.powi(4) / 3.0, 0, 0],
            [0, 0, stiffness * 16.0 / 3.0, -stiffness * 8.0 / 3.0], [0, 0, -stiffness * 8.0 / 3.0, stiffness * 7.0 / 3.0]],
        "momentum": [[0, mass * 2.0 / PI], [0, 0], [mass * 2.0 / 3.0, 0], [mass / 6.0, 0]],
        "radial": [0, 0, moment / 3.0, moment / 6.0],
        "angular_momentum": [moment / PI, -moment / (2.0 * PI), 0, 0],
        "gyroscopic": [[0, 0, b13, b14], [0, 0, 0, b24], [-b13, 0, 0, 0], [-b14, -b24, 0, 0]],
        "points": { "B": { "displacement": [[0, 0], [0, 0], [0, 0], [1, 0]], "rotation": [-PI / ROD, 2.0 * PI / ROD, 0, 0] } } });
    let elastic = json!({ "from": "A", "to": "B", "modal": modal,
        "amplitudes": [0, 0, 1.033_398_63e-5, 1.693_279_69e-5],
        "rates": [0.444_896_105, 4.634_343_11e-3, -1.785_910_76e-6, -2.689_386_72e-6] });
    let mass = 0.151_104;
    let of_rod = json!({ "mass": mass, "inertia": 0.004_533_925_9 - mass * ROD * ROD / 4.0, "com": [ROD / 2.0, 0.0] });
    slider_crank(elastic, of_rod, solver, method)
}

/// All unknowns at 0.1 s by groups: coordinates, velocities, accelerations, multipliers (Test Set for IVP Solvers, computed anew).
const KNOWN: [(&str, &[(&str, f64)]); 4] = [
    (
        "coordinates",
        &[
            ("crank.angle", 15.0),
            ("rod.angle", -3.311_734_988_256_446e-1),
            ("slider.x", 1.697_373_263_995_852e-1),
            ("rod.q1", 1.893_192_843_020_2e-4),
            ("rod.q2", 2.375_751_320_488_3e-5),
            ("rod.q3", -5.323_896_778_176_3e-6),
            ("rod.q4", -8.363_313_291_698_6e-6),
        ],
    ),
    (
        "velocities",
        &[
            ("crank.omega", 150.0),
            ("rod.omega", 60.253_467_551_295),
            ("slider.vx", -8.753_116_326_727_7),
            ("rod.q1_rate", -3.005_541_170_941_4e-2),
            ("rod.q2_rate", -5.500_430_645_986_6e-3),
            ("rod.q3_rate", 4.974_111_666_2e-4),
            ("rod.q4_rate", 1.105_559_971_10e-3),
        ],
    ),
    (
        "accelerations",
        &[
            ("crank.alpha", 0.0),
            ("rod.alpha", 6_488.737_541_45),
            ("slider.ax", 2_167.938_629_63),
            ("rod.q1_acceleration", 33.911_379_78),
            ("rod.q2_acceleration", 0.171_495_080_6),
            ("rod.q3_acceleration", -1.422_449_159_82),
            ("rod.q4_acceleration", 1.003_946_536_47),
        ],
    ),
    (
        "multipliers",
        &[
            ("joint.wrist.fy", -62.329_359_278_796),
            ("joint.wrist.fx", 163.792_099_345_47),
            ("driver.motor.effort", -25.298_579_487_925),
        ],
    ),
];

/// Published digits, the order over the tolerance, and steps.
fn simeon(setting: &Setting, report: &mut CaseReport) -> Result<(), CaseError> {
    let tight = last(&published([1e-12, 1e-13], "radau5"), setting)?;
    for (group, known) in KNOWN {
        let largest = known
            .iter()
            .fold(0.0, |most: f64, (_, value)| most.max(value.abs()));
        for (name, value) in known {
            let what = format!("Simeon's slider-crank, {group}: {name}");
            report.claims.push(Claim::near(
                &what,
                *value,
                tight.value(name)?,
                5e-8 * largest,
            ));
        }
    }
    let _ = writeln!(
        report.text,
        "Simeon's slider-crank, error of the amplitude q1 at 0.1 s by 2e-4 m:\nmethod    rtol     error     steps"
    );
    for method in ["radau5", "dop853"] {
        let mut errors = Vec::new();
        for rtol in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10] {
            let run = last(&published([rtol, rtol / 10.0], method), setting)?;
            let error = (run.value("rod.q1")? - KNOWN[0].1[3].1).abs() / 2e-4;
            let steps = run.0.report.statistics.steps;
            let _ = writeln!(report.text, "{method}  {rtol:7.0e} {error:9.1e} {steps:9}");
            errors.push((rtol.ln(), error.ln()));
            if rtol == 1e-5 && method == "radau5" {
                let what = "its steps with radau5 at rtol 1e-5";
                report.claims.push(at_most(what.into(), steps as f64, 3e2));
            }
        }
        // Steps of the other method do not resolve what the fastest mode does.
        if method == "radau5" {
            let what = "slope of log error over log rtol, radau5 [–]";
            report
                .claims
                .push(Claim::near(what, 1.0, slope(&errors), 0.25));
        }
    }
    Ok(())
}

/// The same rod from its modulus, density, width and height, without foreshortening: the digits of another program.
fn consistent(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    let (middle, end) = (1.033_398_63e-5, 1.693_279_69e-5);
    let (middle_rate, end_rate) = (-1.785_910_76e-6, -2.689_386_72e-6);
    // The axial shapes are x/L and 4 x/L (1 − x/L); those of the source are by the places of the middle and the end.
    let elastic = json!({ "from": "A", "to": "B", "section": { "type": "rectangle", "width": SIDE, "height": SIDE },
        "young_modulus": YOUNG, "density": DENSITY, "modes": 2, "axial": true, "foreshortening": false,
        "amplitudes": [0.0, 0.0, end, middle - end / 2.0],
        "rates": [0.444_896_105, 4.634_343_11e-3, end_rate, middle_rate - end_rate / 2.0] });
    let run = last(
        &slider_crank(elastic, json!({}), [1e-10, 1e-11], "dop853"),
        setting,
    )?;
    let of = |name: &str| run.value(name);
    let found = [
        [
            of("rod.angle")?,
            of("slider.x")?,
            of("rod.q1")?,
            of("rod.q2")?,
            of("rod.q4")? + of("rod.q3")? / 2.0,
            of("rod.q3")?,
        ],
        [
            of("rod.omega")?,
            of("slider.vx")?,
            of("rod.q1_rate")?,
            of("rod.q2_rate")?,
            of("rod.q4_rate")? + of("rod.q3_rate")? / 2.0,
            of("rod.q3_rate")?,
        ],
    ];
    let known = [
        [
            -3.311_734_303_328e-1,
            1.697_373_958_326e-1,
            1.893_081_693_188e-4,
            2.376_201_084_976e-5,
            -5.281_024_759_769e-6,
            -8.303_554_444_898e-6,
        ],
        [
            60.253_117_960_02,
            -8.753_427_791_642,
            -2.997_896_120_715e-2,
            -5.611_856_407_421e-3,
            -8.683_483_438_768e-5,
            8.122_576_526_607e-4,
        ],
    ];
    for (order, (found, known)) in found.iter().zip(known).enumerate() {
        let largest = known
            .iter()
            .fold(0.0, |most: f64, value: &f64| most.max(value.abs()));
        let names = ["φ2", "x3", "q1", "q2", "q3", "q4"];
        for ((name, found), known) in names.into_iter().zip(found).zip(known) {
            let what = format!("the same rod by its cross-section: derivative {order} of {name}");
            claims.push(Claim::near(&what, known, *found, 1e-8 * largest));
        }
    }
    Ok(())
}

/// A bar on a hub that turns at a constant rate, with amplitudes at the start.
fn hub(bar: &Value, rate: f64, length: f64, amplitudes: &[f64]) -> Value {
    let mut elastic = bar.clone();
    elastic["from"] = json!("O");
    elastic["to"] = json!("T");
    elastic["frame"] = json!("tangent");
    elastic["amplitudes"] = json!(amplitudes);
    json!({ "format": "linkdyn/1", "units": "SI", "bodies": {
            "ground": { "points": { "O": [0.0, 0.0] } },
            "bar": { "points": { "O": [0.0, 0.0], "T": [length, 0.0] }, "elastic": elastic } },
        "joints": { "hub": { "type": "revolute", "between": ["ground.O", "bar.O"] } },
        "drivers": { "motor": { "type": "rotation", "body": "bar",
            "motion": { "type": "constant_velocity", "velocity": rate } } },
        "analysis": { "type": "dynamics", "end": 1e-9, "outputs": 2 } })
}

/// Accelerations of n amplitudes on a hub.
fn accelerations(model: &Value, n: usize, setting: &Setting) -> Result<Vec<f64>, CaseError> {
    let run = outcome(model, setting)?;
    let first = |k: usize| {
        let name = format!("bar.q{k}_acceleration");
        let values = run.trajectory.values(&name);
        let first = values.and_then(|values| values.first().copied());
        first.ok_or_else(|| broken(format!("no {name}")))
    };
    (1..=n).map(first).collect()
}

/// q̈ = b − A q of small amplitudes on a hub: A (by rows) and b.
fn linear(
    bar: &Value,
    rate: f64,
    (length, n): (f64, usize),
    setting: &Setting,
) -> Result<(Vec<f64>, Vec<f64>), CaseError> {
    let small = 1e-7 * length;
    let of = |amplitudes: &[f64]| accelerations(&hub(bar, rate, length, amplitudes), n, setting);
    let rest = of(&vec![0.0; n])?;
    let mut matrix = vec![0.0; n * n];
    for column in 0..n {
        let side = |sign: f64| {
            let mut amplitudes = vec![0.0; n];
            amplitudes[column] = sign * small;
            of(&amplitudes)
        };
        let (more, less) = (side(1.0)?, side(-1.0)?);
        for row in 0..n {
            matrix[row * n + column] = (less[row] - more[row]) / (2.0 * small);
        }
    }
    Ok((matrix, rest))
}

/// The stretch of a bar that turns: tan(kL)/k − L, and at low rates ρAω²L³/3EA.
fn stretch(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    let length = 10.0;
    let bar = json!({ "bending_stiffness": 1.4e4, "axial_stiffness": 2.8e7, "mass_per_length": 1.2,
        "modes": 1, "axial": true });
    let of = |rate: f64| -> Result<f64, CaseError> {
        let (matrix, rest) = linear(&bar, rate, (length, 3), setting)?;
        // Both axial amplitudes, which nothing couples with bending here.
        let [a, b, c, d] = [4, 5, 7, 8].map(|k: usize| matrix[k]);
        Ok((rest[1] * d - rest[2] * b) / (a * d - b * c))
    };
    let k = 6.0 * (1.2_f64 / 2.8e7).sqrt();
    let known = (length * k).tan() / k - length;
    claims.push(Claim::near(
        "stretch of a bar that turns at 6 rad/s [m]",
        known,
        of(6.0)?,
        1e-6 * known,
    ));
    let first = 1.2 * 0.06_f64.powi(2) * length.powi(3) / (3.0 * 2.8e7);
    claims.push(Claim::near(
        "stretch at 0.06 rad/s: first order [m]",
        first,
        of(0.06)?,
        1e-6 * first,
    ));
    Ok(())
}

/// The spin-up of Kane and of Simo and Vu-Quoc: the tip lags behind and comes back; as few modes and as a chain of elements.
fn spin_up(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    let swing = (15.0 / (2.0 * TRUE_PI)).powi(2) * 6.0 / 15.0;
    let of = |how: Value| -> Result<[f64; 3], CaseError> {
        let mut elastic = json!({ "from": "O", "to": "T", "bending_stiffness": 1.4e4, "mass_per_length": 1.2,
            "axial_stiffness": 2.8e7 });
        for (key, value) in how.as_object().into_iter().flatten() {
            elastic[key] = value.clone();
        }
        // Two hubs, one on the other: ψ = (6/15)(t²/2 + (15/2π)² (cos(2πt/15) − 1)).
        let light = json!({ "mass": 0.0, "inertia": 0.0, "points": { "O": [0.0, 0.0] } });
        let model = json!({ "format": "linkdyn/1", "units": "SI", "bodies": {
                "ground": { "points": { "O": [0.0, 0.0] } }, "first": light, "second": light,
                "bar": { "points": { "O": [0.0, 0.0], "T": [10.0, 0.0] }, "elastic": elastic } },
            "joints": { "a": { "type": "revolute", "between": ["ground.O", "first.O"] },
                "b": { "type": "revolute", "between": ["first.O", "second.O"] },
                "c": { "type": "fixed", "between": ["second.O", "bar.O"] } },
            "drivers": {
                "steady": { "type": "rotation", "body": "first", "motion": { "type": "polynomial", "coefficients": [0.0, 0.0, 0.2] } },
                "swing": { "type": "rotation", "body": "second", "relative_to": "first", "motion": { "type": "harmonic",
                    "offset": -swing, "amplitude": swing, "frequency": 1.0 / 15.0, "phase": TRUE_PI / 2.0 } } },
            "points": ["bar.T"],
            "analysis": { "type": "dynamics", "end": 15.0, "outputs": 301, "solver": { "rtol": 1e-7 } } });
        let run = outcome(&model, setting)?;
        let values = |name: &str| {
            let values = run.trajectory.values(name);
            values.ok_or_else(|| broken(format!("no {name}")))
        };
        let (x, y, angle) = (values("bar.T.x")?, values("bar.T.y")?, values("bar.angle")?);
        let across = |k: usize| y[k] * angle[k].cos() - x[k] * angle[k].sin();
        let most = (0..x.len()).map(across).fold(0.0, f64::min);
        Ok([most, across(120), across(x.len() - 1)])
    };
    let modal = of(json!({ "modes": 3, "frame": "tangent" }))?;
    let chain = of(json!({ "elements": 16 }))?;
    let names = ["largest lag of the tip", "lag at 6 s", "lag at 15 s"];
    for ((name, modal), chain) in names.into_iter().zip(modal).zip(chain) {
        let what = format!("spin-up, {name}: three modes beside 16 elements [m]");
        claims.push(Claim::near(&what, chain, modal, 6e-3));
    }
    claims.push(at_most(
        "spin-up: what is left of the lag at 15 s [m]".into(),
        modal[2].abs(),
        2e-2,
    ));
    Ok(())
}

/// Frequencies of a turning cantilever in the plane of its turning, by √(EI/ρA L⁴).
fn turning(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    for (rate, known) in TURNING {
        // Shapes at rest are what a bar that turns fast bends in only where there are many.
        let n = if rate <= 2.0 { 4 } else { 12 };
        let bar = json!({ "bending_stiffness": 1.0, "mass_per_length": 1.0, "modes": n });
        let (matrix, _) = linear(&bar, rate, (1.0, n), setting)?;
        let matrix = nalgebra::DMatrix::from_row_slice(n, n, &matrix);
        let squares = matrix.complex_eigenvalues();
        let mut found: Vec<f64> = squares.iter().map(|square| square.re.sqrt()).collect();
        found.sort_by(f64::total_cmp);
        for (k, known) in known.into_iter().enumerate() {
            let what = format!(
                "turning cantilever of {n} modes, Ω* = {rate}: frequency {}",
                k + 1
            );
            claims.push(Claim::near(&what, known, found[k], 1e-4 * known));
        }
    }
    Ok(())
}

/// Small loads against textbook formulas, by modes and by elements.
fn statics(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    let (length, load, bending) = (1.0, 1e-9, 3.0);
    let bar = json!({ "from": "O", "to": "T", "bending_stiffness": bending, "axial_stiffness": 1e3, "mass_per_length": 1.0 });
    for how in ["modes", "elements"] {
        for (is_pinned, at, known) in [
            (
                true,
                "M",
                load * length * length * length / (48.0 * bending),
            ),
            (
                false,
                "T",
                load * length * length * length / (3.0 * bending),
            ),
        ] {
            let mut elastic = bar.clone();
            elastic[how] = json!(2);
            if how == "modes" && !is_pinned {
                elastic["frame"] = json!("tangent");
            }
            let mut joints = json!({});
            if is_pinned {
                joints["a"] = json!({ "type": "revolute", "between": ["ground.O", "bar.O"] });
                joints["b"] =
                    json!({ "type": "slot", "between": ["ground.T", "bar.T"], "axis": [1.0, 0.0] });
            } else {
                joints["a"] = json!({ "type": "fixed", "between": ["ground.O", "bar.O"] });
            }
            let model = json!({ "format": "linkdyn/1", "units": "SI", "bodies": {
                    "ground": { "points": { "O": [0.0, 0.0], "T": [length, 0.0] } },
                    "bar": { "points": { "O": [0.0, 0.0], "M": [length / 2.0, 0.0], "T": [length, 0.0] }, "elastic": elastic } },
                "joints": joints, "points": ["bar.M", "bar.T"],
                "forces": { "load": { "type": "force", "at": format!("bar.{at}"), "vector": [0.0, load] } },
                "analysis": { "type": "statics" } });
            let run = last(&model, setting)?;
            let what = format!(
                "small load on a bar, {}, by {how} [m]",
                if is_pinned { "pinned" } else { "clamped" }
            );
            let own = run.value(&format!("bar.{at}.y"))?;
            claims.push(Claim::near(&what, known, own, 1e-12 * known));
        }
    }
    Ok(())
}

/// A rod that gets stiffer goes to the rigid one as 1/EI: the force in its pin in the second half of a run, when it vibrates no more.
fn stiffer(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    let of = |elastic: Value, of_rod: Value| -> Result<Vec<f64>, CaseError> {
        let mut model = slider_crank(elastic, of_rod, [1e-11, 1e-13], "radau5");
        if let Some(rod) = model["bodies"]["rod"].as_object_mut() {
            rod.retain(|_, value| !value.is_null());
        }
        model["analysis"]["end"] = json!(0.05);
        model["analysis"]["outputs"] = json!(101);
        let run = outcome(&model, setting)?;
        let values = run.trajectory.values("joint.wrist.fy");
        let values = values.ok_or_else(|| broken("no joint.wrist.fy"))?;
        Ok(values[values.len() / 2..].to_vec())
    };
    let mass = 0.5 * ROD;
    let rigid = of(
        Value::Null,
        json!({ "mass": mass, "inertia": mass * ROD * ROD / 12.0, "com": [ROD / 2.0, 0.0] }),
    )?;
    let mut errors = Vec::new();
    for stiffness in [3e2, 3e3, 3e4] {
        let elastic = json!({ "from": "A", "to": "B", "bending_stiffness": stiffness,
            "mass_per_length": 0.5, "damping": 1.0 });
        let own = of(elastic, json!({}))?;
        let off = own
            .iter()
            .zip(&rigid)
            .map(|(own, rigid)| (own - rigid).abs());
        errors.push(off.fold(0.0, f64::max));
    }
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log10();
        let what = "order in 1/EI of what an elastic rod adds to the force in its pin [–]";
        claims.push(Claim::near(what, 1.0, order, 0.05));
    }
    Ok(())
}

/// An elastic pendulum keeps its energy, strain energy included.
fn ledger(setting: &Setting, claims: &mut Vec<Claim>) -> Result<(), CaseError> {
    for how in ["modes", "elements"] {
        let mut elastic = json!({ "from": "O", "to": "T", "bending_stiffness": 20.0, "axial_stiffness": 2e4, "mass_per_length": 1.0 });
        elastic[how] = json!(3);
        let model = json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, -9.81], "bodies": {
                "ground": { "points": { "O": [0.0, 0.0] } },
                "bar": { "points": { "O": [0.0, 0.0], "T": [1.0, 0.0] }, "elastic": elastic } },
            "joints": { "pin": { "type": "revolute", "between": ["ground.O", "bar.O"] } },
            "analysis": { "type": "dynamics", "end": 2.0, "outputs": 21, "solver": { "rtol": 1e-12, "atol": 1e-14 } } });
        let run = outcome(&model, setting)?;
        let drift = run.report.quality.energy_drift;
        let drift = drift.ok_or_else(|| broken("no energy drift"))?;
        let what = format!("elastic pendulum of 3 {how}: drift of the energy [–]");
        claims.push(at_most(what, drift.abs(), 1e-9));
    }
    Ok(())
}

/// Least squares of the slope of pairs.
fn slope(pairs: &[(f64, f64)]) -> f64 {
    let n = pairs.len() as f64;
    let mean = pairs
        .iter()
        .fold((0.0, 0.0), |(x, y), (a, b)| (x + a / n, y + b / n));
    let of = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        pairs.iter().map(|(x, y)| f(x - mean.0, y - mean.1)).sum()
    };
    of(&|x, y| x * y) / of(&|x, _| x * x)
}

fn outcome(model: &Value, setting: &Setting) -> Result<Outcome, CaseError> {
    finished(analysis::run(&read(model)?, &setting.control))
}

/// A run, read at its end.
struct AtEnd(Outcome);

impl AtEnd {
    fn value(&self, name: &str) -> Result<f64, CaseError> {
        let values = self.0.trajectory.values(name);
        let last = values.and_then(|values| values.last().copied());
        last.ok_or_else(|| broken(format!("no {name}")))
    }
}

fn last(model: &Value, setting: &Setting) -> Result<AtEnd, CaseError> {
    Ok(AtEnd(outcome(model, setting)?))
}
