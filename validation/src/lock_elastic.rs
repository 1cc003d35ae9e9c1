//! The lock with links that bend: what the change point of its rigid skeleton does to its hinges then.
//!
//! The model and where its numbers come from stand in `validation/lock-elastic/SOURCE.md`.

use std::fmt::Write as _;

use linkdyn_engine::analysis::{self, Outcome};
use serde_json::{Value, json};

use super::beams::read;
use super::{CaseError, CaseReport, Setting, at_most, broken, finished};

/// A line about the case.
pub const ABOUT: &str = "the Watt-I lock with elastic links: past its change point with finite forces, with ideal hinges and with clearance";

const MODEL: &str = include_str!("../../models/watt-i-lock.json");
/// Of steel [kg/m³].
const DENSITY: f64 = 7850.0;
/// The whole stroke: (175°)² at 2 rad/s² \[s\], and outputs.
const END: f64 = 1.747_660_573_8;
const OUTPUTS: usize = 1751;
/// Where the rigid skeleton has its change point \[deg\], and the window in which forces are compared.
const WINDOW: [f64; 2] = [116.5, 118.2];
/// Links: the ends of the bar, and a pin beside it.
const LINKS: [(&str, [&str; 2], Option<&str>); 5] = [
    ("link2", ["a", "b"], None),
    ("link3", ["b", "f"], Some("c")),
    ("link4", ["g", "d"], Some("c")),
    ("link5", ["e", "d"], None),
    ("link6", ["f", "e"], None),
];

/// Runs the case.
///
/// # Errors
/// When it can't be run.
pub fn run(setting: &Setting) -> Result<CaseReport, CaseError> {
    let mut report = CaseReport::default();
    let rigid = ElasticStroke::of(&rigid()?, setting)?;
    let one = ElasticStroke::of(&elastic(1, None)?, setting)?;
    let two = ElasticStroke::of(&elastic(2, None)?, setting)?;
    let loose = ElasticStroke::of(&elastic(1, Some("100 um"))?, setting)?;
    let _ = writeln!(
        report.text,
        "largest force in the hinges from {} to {} deg of link 6 [N]\nhinge      rigid    1 mode   2 modes  1 mode, contact 100 um",
        WINDOW[0], WINDOW[1]
    );
    for hinge in ["a", "b", "c", "d", "e", "f", "g"] {
        let forces = [&rigid, &one, &two, &loose].map(|stroke| stroke.largest(hinge));
        let [rigid, one, two, loose] = forces;
        let _ = writeln!(
            report.text,
            "{hinge}     {:10.4e} {:9.1} {:9.1} {:9.1}",
            rigid?, one?, two?, loose?
        );
    }
    let _ = writeln!(
        report.text,
        "steps: {} with 1 mode, {} with 2, {} with contact, which takes {:.0} s of the processor: {} contacts, each with steps of its own",
        one.steps(),
        two.steps(),
        loose.steps(),
        loose.0.report.solve.cpu,
        loose.0.report.events.len()
    );
    let claims = &mut report.claims;
    let most = rigid.largest("a")?;
    claims.push(at_most(
        "force in hinge a of the lock with rigid links near 117.5 deg, inverse [1/N]".into(),
        1.0 / most,
        1e-4,
    ));
    for (name, stroke, most, off) in [
        ("1 mode", &one, 500.0, 0.5),
        ("2 modes", &two, 500.0, 0.5),
        ("1 mode, contact 100 um", &loose, 5e3, 1.0),
    ] {
        let what = format!("{name}: largest force in hinge a near 117.5 deg [N]");
        claims.push(at_most(what, stroke.largest("a")?, most));
        let what = format!("{name}: θ2 from that of the rigid lock on its smooth branch [deg]");
        claims.push(at_most(what, stroke.apart(&rigid)?, off));
    }
    let ledger = loose.0.report.quality.energy_imbalance;
    let ledger = ledger.ok_or_else(|| broken("no energy ledger"))?;
    claims.push(at_most(
        "contact: energy that is missing [–]".into(),
        ledger,
        1e-6,
    ));
    Ok(report)
}

/// The bundled lock, at the instants of the others.
fn rigid() -> Result<Value, CaseError> {
    let mut model: Value = serde_json::from_str(MODEL).map_err(|said| broken(said.to_string()))?;
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": END, "outputs": OUTPUTS });
    Ok(model)
}

/// The lock whose links are square bars of steel of their masses between two of their pins; a third pin is on a rigid arm without mass.
fn elastic(modes: usize, clearance: Option<&str>) -> Result<Value, CaseError> {
    let mut model = rigid()?;
    model["analysis"] =
        json!({ "type": "dynamics", "end": END, "outputs": OUTPUTS, "solver": { "rtol": 1e-6 } });
    for (link, ends, third) in LINKS {
        let point = |name: &str| -> [f64; 2] {
            [0, 1].map(|k: usize| {
                model["bodies"][link]["points"][name][k]
                    .as_f64()
                    .unwrap_or(0.0)
            })
        };
        let [from, to] = ends.map(point);
        let beside = third.map(point);
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        let body = &mut model["bodies"][link];
        let mass = body["mass"].as_f64().unwrap_or(0.0);
        // In mm, as the file has it.
        let width = 1e3 * (mass / (DENSITY * length * 1e-3)).sqrt();
        let pose = body["pose"].clone();
        if let Some(body) = body.as_object_mut() {
            body.retain(|key, _| !["mass", "inertia", "com"].contains(&key.as_str()));
        }
        body["elastic"] = json!({ "from": ends[0], "to": ends[1], "material": "steel", "modes": modes,
            "damping": 0.01, "section": { "type": "rectangle", "width": width, "height": width } });
        if let (Some(name), Some(place)) = (third, beside) {
            let off = [place[0] - from[0], place[1] - from[1]];
            let part = (off[0] * along[0] + off[1] * along[1]) / (length * length);
            let foot = [from[0] + part * along[0], from[1] + part * along[1]];
            if let Some(points) = body["points"].as_object_mut() {
                points.remove(name);
            }
            body["points"]["foot"] = json!(foot);
            let number = |value: &Value| value.as_f64().unwrap_or(0.0);
            let (sin, cos) = number(&pose["angle"]).to_radians().sin_cos();
            let (x, y) = (number(&pose["position"][0]), number(&pose["position"][1]));
            let arm = format!("{link}-arm");
            model["bodies"][&arm] = json!({ "mass": 0, "inertia": 0,
                "points": { "foot": [0, 0], name: [place[0] - foot[0], place[1] - foot[1]] },
                "pose": { "angle": pose["angle"],
                    "position": [x + cos * foot[0] - sin * foot[1], y + sin * foot[0] + cos * foot[1]] } });
            for joint in model["joints"].as_object_mut().into_iter().flatten() {
                for end in joint.1["between"].as_array_mut().into_iter().flatten() {
                    if *end == json!(format!("{link}.{name}")) {
                        *end = json!(format!("{arm}.{name}"));
                    }
                }
            }
            model["joints"][format!("{link}-weld")] = json!({ "type": "fixed",
                "between": [format!("{link}.foot"), format!("{arm}.foot")] });
        }
    }
    if let Some(radius) = clearance {
        for joint in model["joints"].as_object_mut().into_iter().flatten() {
            if joint.1["type"] == "revolute" {
                joint.1["clearance"]["model"] = json!("contact");
                joint.1["clearance"]["radius"] = json!(radius);
            }
        }
    }
    Ok(model)
}

/// A run over the whole stroke.
struct ElasticStroke(Outcome);

impl ElasticStroke {
    fn of(model: &Value, setting: &Setting) -> Result<Self, CaseError> {
        let mut model = model.clone();
        if let Some(model) = model.as_object_mut() {
            model.remove("accuracy");
        }
        Ok(ElasticStroke(finished(analysis::run(
            &read(&model)?,
            &setting.control,
        ))?))
    }

    fn steps(&self) -> u64 {
        self.0.report.statistics.steps
    }

    fn values(&self, name: &str) -> Result<Vec<f64>, CaseError> {
        let values = self.0.trajectory.values(name);
        values.ok_or_else(|| broken(format!("no {name}")))
    }

    /// Largest force of a hinge in the window \[N\].
    fn largest(&self, hinge: &str) -> Result<f64, CaseError> {
        let [fx, fy] = ["fx", "fy"].map(|axis| self.values(&format!("joint.{hinge}.{axis}")));
        let (fx, fy, angle) = (fx?, fy?, self.values("driver.motor.value")?);
        let all = fx.iter().zip(&fy).zip(&angle);
        let inside = all.filter(|(_, angle)| (WINDOW[0]..=WINDOW[1]).contains(&angle.to_degrees()));
        Ok(inside.fold(0.0, |most: f64, ((fx, fy), _)| most.max(fx.hypot(*fy))))
    }

    /// Largest difference of θ2 over the stroke \[deg\].
    fn apart(&self, other: &ElasticStroke) -> Result<f64, CaseError> {
        let (own, other) = (self.values("link2.angle")?, other.values("link2.angle")?);
        let off = own
            .iter()
            .zip(&other)
            .map(|(own, other)| (own - other).abs());
        Ok(off
            .filter(|off| off.is_finite())
            .fold(0.0, f64::max)
            .to_degrees())
    }
}
