//! What no schema can say of a clearance: what its model and the laws it uses need, and the ranges they hold in.
//!
//! Only the active model is looked at; what it does not use may be anything the schema allows.

use serde_json::Value;

use super::check::Checked;
use crate::error::Complaint;

/// Laws of cylinders, which take materials and length instead of a stiffness.
const CYLINDRICAL: [&str; 4] = ["johnson", "radzimovsky", "dubowsky_freudenstein", "pereira"];
/// Laws whose hysteresis factor is infinite without any rebound.
const REBOUND: [&str; 3] = ["flores", "gonthier", "hu_guo"];
/// Clearances that Pereira, Ramalho and Ambrósio fitted their law to \[m\].
const PEREIRA: [f64; 2] = [5e-6, 10e-3];

/// What the model of a clearance needs.
pub(super) fn clearance<'m>(checked: &mut Checked<'m>, clearance: &'m Value, path: &str) {
    let Some(model) = clearance["model"]
        .as_str()
        .filter(|model| *model != "ideal")
    else {
        return;
    };
    let mut words = Words {
        checked,
        clearance,
        path,
    };
    match clearance.get("radius") {
        None => {
            let message =
                format!("\"radius\" is missing, the model {model:?} needs the radial clearance");
            words.complain(
                "",
                message,
                "bearing radius − journal radius, as in \"0.1 mm\"",
            );
        }
        Some(radius) if radius.as_f64() == Some(0.0) && model != "massless_link" => {
            words.checked.complain(
                format!("{path}.radius"),
                format!("must be greater than 0 for the model {model:?}"),
            );
        }
        Some(_) => {}
    }
    match model {
        "two_state" => {
            words.need(
                "surface",
                "the model \"two_state\" needs its stiffness and damping",
            );
            words.journal();
            words.friction();
        }
        "three_state" => {
            if words.lacks_restitution() {
                let hint = "the model \"three_state\" needs it, or \"normal.restitution\"";
                words.complain("", "\"impact.restitution\" is missing", hint);
            }
            words.journal();
        }
        "contact" => {
            words.need(
                "normal",
                "the model \"contact\" needs a law of the normal force",
            );
            words.journal();
            words.normal();
            words.friction();
        }
        _ => {}
    }
}

/// What the friction of an ideal joint needs.
pub(super) fn joint_friction<'m>(checked: &mut Checked<'m>, joint: &'m Value, path: &str) {
    if joint.get("friction").is_none_or(Value::is_null) {
        return;
    }
    let mut words = Words {
        checked,
        clearance: joint,
        path,
    };
    if let Some(model) = joint["clearance"]["model"]
        .as_str()
        .filter(|model| *model != "ideal")
    {
        let message =
            format!("is that of an ideal joint, but the joint's clearance has the model {model:?}");
        let hint = match model {
            "massless_link" => {
                "a massless clearance link has no friction: leave it out, or use another model"
            }
            _ => "write it as \"clearance.friction\", or use the model \"ideal\"",
        };
        words.complain(".friction", message, hint);
    }
    words.friction();
    if joint["type"] == "revolute" && joint["friction"]["law"] != "none" {
        words.need(
            "pin_radius",
            "the torque of the friction is that of its force on the pin's surface",
        );
    }
}

/// The words of a clearance that is in use, or of a joint with friction.
struct Words<'c, 'm> {
    checked: &'c mut Checked<'m>,
    clearance: &'m Value,
    path: &'c str,
}

impl Words<'_, '_> {
    fn complain(&mut self, key: &str, message: impl Into<String>, hint: impl Into<String>) {
        self.checked
            .complain(format!("{}{key}", self.path), message)
            .hint = Some(hint.into());
    }

    fn warn(&mut self, key: &str, message: impl Into<String>, hint: impl Into<String>) {
        let warning = Complaint::new(format!("{}{key}", self.path), message).hint(hint);
        self.checked.warnings.push(warning);
    }

    /// Whether a value stands there, `normal.law`; a faulty one counts as there.
    fn has(&self, key: &str) -> bool {
        match key.split_once('.') {
            None => self.clearance.get(key).is_some(),
            Some((outer, inner)) => self
                .clearance
                .get(outer)
                .is_some_and(|outer| !outer.is_object() || outer.get(inner).is_some()),
        }
    }

    /// A number, none where it is missing or faulty.
    fn number(&self, key: &str) -> Option<f64> {
        key.split('.')
            .fold(self.clearance, |value, key| &value[key])
            .as_f64()
    }

    /// Complains where a value is missing.
    fn need(&mut self, key: &str, hint: &str) -> bool {
        let has = self.has(key);
        if !has {
            self.complain("", format!("{key:?} is missing"), hint);
        }
        has
    }

    /// Whether neither the impact nor the contact has a restitution.
    fn lacks_restitution(&self) -> bool {
        !self.has("impact.restitution") && !self.has("normal.restitution")
    }

    /// The journal has a radius above zero.
    fn journal(&mut self) {
        let (Some(clearance), Some(bearing)) =
            (self.number("radius"), self.number("bearing_radius"))
        else {
            return;
        };
        if clearance >= bearing {
            let hint = "\"radius\" is the clearance: bearing radius − journal radius";
            self.complain(
                ".bearing_radius",
                "must be greater than \"radius\", or the journal has none",
                hint,
            );
        }
    }

    fn normal(&mut self) {
        let Some(law) = self.clearance["normal"]["law"].as_str() else {
            return;
        };
        let needs_it = format!("the law {law:?} needs it");
        if CYLINDRICAL.contains(&law) {
            self.need("normal.elastic", &needs_it);
            self.need("bearing_radius", &needs_it);
            self.need("axial_length", &needs_it);
            let radius = self
                .number("radius")
                .filter(|radius| *radius > 0.0 && law == "pereira");
            if radius.is_some_and(|radius| !(PEREIRA[0]..PEREIRA[1]).contains(&radius)) {
                let hint = "\"johnson\" has no such bound";
                self.complain(
                    ".radius",
                    "the law \"pereira\" holds from 5 µm to 10 mm",
                    hint,
                );
            }
            return;
        }
        self.stiffness(law);
        match law {
            "hertz" => {}
            "kelvin_voigt" => {
                self.need("normal.damping", &needs_it);
            }
            _ => {
                self.need("normal.restitution", &needs_it);
                if self.number("normal.restitution") == Some(0.0) && REBOUND.contains(&law) {
                    let hint = "\"hunt_crossley\" or \"zhiying_qishao\" allow 0";
                    self.complain(
                        ".normal.restitution",
                        format!("must be greater than 0 for the law {law:?}"),
                        hint,
                    );
                }
            }
        }
    }

    /// K is given or follows from the materials, then with the exponent that belongs to it.
    fn stiffness(&mut self, law: &str) {
        if self.has("normal.stiffness") {
            return;
        }
        if !self.has("normal.elastic") {
            let hint = "give it, or \"elastic\" and \"bearing_radius\"";
            self.complain("", "\"normal.stiffness\" is missing", hint);
            return;
        }
        self.need(
            "bearing_radius",
            "the stiffness follows from \"elastic\" and the radii",
        );
        let exponent = if law == "kelvin_voigt" {
            Some(1.0)
        } else {
            self.number("normal.exponent")
        };
        if let Some(exponent) = exponent.filter(|exponent| *exponent != 1.5) {
            let message = format!(
                "gives a stiffness in N/m^1.5, whose number is taken with the exponent {exponent}"
            );
            self.warn(
                ".normal.elastic",
                message,
                "give \"stiffness\" in the unit that belongs to the exponent",
            );
        }
    }

    fn friction(&mut self) {
        let Some(law) = self.clearance["friction"]["law"].as_str() else {
            return;
        };
        let needed: &[&str] = match law {
            "coulomb" | "threlfall" => &["coefficient", "threshold_velocity"],
            "ambrosio" => &["coefficient", "lower_velocity", "upper_velocity"],
            "stribeck" => &[
                "coefficient",
                "static_coefficient",
                "stribeck_velocity",
                "threshold_velocity",
            ],
            "lugre" => &[
                "coefficient",
                "static_coefficient",
                "stribeck_velocity",
                "bristle_stiffness",
            ],
            _ => &[],
        };
        for key in needed {
            self.need(
                &format!("friction.{key}"),
                &format!("the law {law:?} needs it"),
            );
        }
        let velocities =
            ["friction.lower_velocity", "friction.upper_velocity"].map(|key| self.number(key));
        if let ("ambrosio", [Some(lower), Some(upper)]) = (law, velocities)
            && upper <= lower
        {
            let hint = "the force grows from nothing to μF_n between the two";
            self.complain(
                ".friction.upper_velocity",
                "must be greater than \"lower_velocity\"",
                hint,
            );
        }
        let coefficients =
            ["friction.coefficient", "friction.static_coefficient"].map(|key| self.number(key));
        if let ("stribeck" | "lugre", [Some(kinetic), Some(resting)]) = (law, coefficients)
            && resting < kinetic
        {
            let hint = "\"coefficient\" is the kinetic one";
            self.warn(
                ".friction.static_coefficient",
                "is less than the kinetic \"coefficient\"",
                hint,
            );
        }
    }
}
