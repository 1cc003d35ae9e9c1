//! Cams that are not driven: dynamics, rest, small motions.

use super::*;
use crate::mechanisms::loaded;
use linkdyn_engine::analysis::Control;

const STIFFNESS: f64 = 900.0;
const FREE: f64 = 0.32;
const INERTIA: f64 = 0.01;

/// A flywheel of a cam that turns by itself.
fn free(cam: Value, omega: f64) -> Value {
    let mut model = sliding(cam, 0.0, 0.0);
    model["drivers"] = json!({});
    model["initial"] = json!({ "cam": { "angle": 0.0, "angular_velocity": omega } });
    press(&mut model, STIFFNESS, FREE);
    model["analysis"] = json!({ "type": "dynamics", "end": 1.0, "outputs": 101,
        "solver": { "rtol": 1e-12, "atol": 1e-14 } });
    model
}

/// ½ (J + m s′²) ω² + m g s + ½ k (L₀ − L)² stays what it is, to a thousand times the tolerance of a step; laws are held between
/// their breaks, so that these cost nothing.
#[test]
fn a_free_cam_keeps_its_energy() {
    let rise = json!([{ "law": "cycloidal", "rise": 0.012, "angle": "130 deg" }, { "dwell": "40 deg" },
        { "law": "polynomial_3_4_5", "rise": -0.012, "angle": "150 deg" }]);
    for cam in [
        json!({ "follower": "flat", "face": [1.0, 0.0], "profile": eccentric() }),
        json!({ "follower": "roller", "roller_radius": ROLLER, "profile": eccentric() }),
        json!({ "follower": "flat", "face": [1.0, 0.0],
                "profile": { "type": "law", "base_radius": 0.04, "segments": rise } }),
        json!({ "follower": "roller", "roller_radius": ROLLER,
                "profile": { "type": "law", "base_radius": 0.04, "axis": [0, 1], "segments": rise } }),
    ] {
        let run = completed(&free(cam.clone(), 40.0));
        let [omega, y, vy] =
            ["cam.omega", "follower.y", "follower.vy"].map(|name| column(&run, name));
        let energy = |k: usize| {
            let squeezed = FREE - (0.3 - y[k]);
            0.5 * INERTIA * omega[k] * omega[k]
                + 0.5 * MASS * vy[k] * vy[k]
                + MASS * GRAVITY * y[k]
                + 0.5 * STIFFNESS * squeezed * squeezed
        };
        for k in 0..y.len() {
            let off = (energy(k) / energy(0) - 1.0).abs();
            assert!(off < 1e-9, "{cam}: row {k}: {off:e}");
        }
        let drift = run.report.quality.energy_drift.expect("conservative");
        assert!(drift < 1e-9, "{drift:e}");
    }
}

/// The acceleration of an eccentric's flat follower at each row is that of the reduced equation.
#[test]
fn a_free_eccentric_has_the_acceleration_of_its_equation() {
    let cam = json!({ "follower": "flat", "face": [1.0, 0.0], "profile": eccentric() });
    let run = completed(&free(cam, 25.0));
    let omega = column(&run, "cam.omega");
    let e = ECCENTRICITY;
    follows(&run, "cam.alpha", 1e-10, |angle, k| {
        let (sin, cos) = angle.sin_cos();
        let push = STIFFNESS * (FREE - 0.3 + RADIUS + e * sin) + MASS * GRAVITY;
        let inertia = INERTIA + MASS * e * e * cos * cos;
        (MASS * e * e * sin * cos * omega[k] * omega[k] - push * e * cos) / inertia
    });
}

/// k (θ − θ₀) = −(m g + spring) e cos θ at rest, and the frequency of small motions about it.
#[test]
fn an_eccentric_rests_and_swings_about_its_rest() {
    let coil = 3.0;
    for follower in ["flat", "roller"] {
        let mut cam = json!({ "follower": follower, "profile": eccentric() });
        match follower {
            "flat" => cam["face"] = json!([1.0, 0.0]),
            _ => cam["roller_radius"] = json!(ROLLER),
        }
        let mut model = free(cam, 0.0);
        model["initial"] = json!({});
        model["forces"]["coil"] = json!({ "type": "torsion_spring", "between": ["ground", "cam"], "stiffness": coil,
            "free_angle": 0.5 });
        model["analysis"] = json!({ "type": "statics" });
        let run = completed(&model);
        let theta = column(&run, "cam.angle")[0];
        let e = ECCENTRICITY;
        // height and two derivatives
        let (sin, cos) = theta.sin_cos();
        let [y, y1, y2] = match follower {
            "flat" => [RADIUS + e * sin, e * cos, -e * sin],
            _ => {
                let rod = ((RADIUS + ROLLER).powi(2) - (e * cos).powi(2)).sqrt();
                let slope = e * e * sin * cos / rod;
                let bend = (e * e * (cos * cos - sin * sin) - slope * slope) / rod;
                [e * sin + rod, e * cos + slope, -e * sin + bend]
            }
        };
        let push = STIFFNESS * (FREE - 0.3 + y) + MASS * GRAVITY;
        let off = coil * (theta - 0.5) + push * y1;
        assert!(off.abs() < 1e-9 * coil, "{off:e} at {theta}");
        let stiff = coil + STIFFNESS * y1 * y1 + push * y2;
        let frequency = (stiff / (INERTIA + MASS * y1 * y1)).sqrt();
        let modes =
            linkdyn_engine::analysis::modes(&loaded(&model).model, false, &Control::default());
        let found = modes.expect("modes").modes[0].frequency();
        assert!(
            (found / frequency - 1.0).abs() < 1e-9,
            "{found} for {frequency}"
        );
    }
}

/// What a designer is told once, with the cam's angle and the mend.
#[test]
fn jamming_undercut_and_lifting_are_told() {
    let rise = |height: f64, degrees: f64| {
        json!([{ "law": "cycloidal", "rise": height, "angle": degrees.to_radians() },
            { "law": "cycloidal", "rise": -height, "angle": degrees.to_radians() }])
    };
    let roller = |base: f64, segments: Value| {
        json!({ "follower": "roller", "roller_radius": 0.01,
            "profile": { "type": "law", "base_radius": base, "axis": [0, 1], "segments": segments } })
    };
    let flat = |base: f64, segments: Value| {
        json!({ "follower": "flat", "face": [1, 0],
            "profile": { "type": "law", "base_radius": base, "segments": segments } })
    };
    for (cam, stiffness, expected) in [
        (roller(0.04, rise(0.012, 130.0)), 900.0, ""),
        (
            roller(0.04, rise(0.03, 60.0)),
            9000.0,
            "the pressure angle of cam \"c\" reaches 0.7269 rad (41.65°), at a cam angle of 0.4363 rad (25°)",
        ),
        (
            roller(0.01, rise(0.006, 30.0)),
            9000.0,
            "the profile of cam \"c\" is undercut near",
        ),
        (
            flat(0.012, rise(0.012, 90.0)),
            900.0,
            "the profile of cam \"c\" is undercut near",
        ),
        (
            roller(0.04, rise(0.012, 130.0)),
            0.0,
            "the follower of cam \"c\" would lift off at a cam angle of",
        ),
    ] {
        let mut model = sliding(cam.clone(), 0.0, 0.0);
        press(&mut model, stiffness, FREE);
        if stiffness == 0.0 {
            // from ω² h/β² 2π = g on
            model["drivers"]["motor"]["motion"]["velocity"] = json!(30.0);
            model["analysis"]["end"] = json!(TAU / 30.0);
        }
        let run = completed(&model);
        let warnings = run.report.warnings.join("\n");
        assert_eq!(
            warnings.is_empty(),
            expected.is_empty(),
            "{cam}: {warnings}"
        );
        assert!(warnings.contains(expected), "{cam}: {warnings}");
    }
}
