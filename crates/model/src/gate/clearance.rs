//! What a clearance and a friction need: what their model and the laws in use want, and the ranges these hold in.
//!
//! Only the model in use is looked at; what it does not use may be anything that its range allows.

use super::Rules;
use crate::error::Complaint;
use crate::fit::Fit;
use crate::tree::{Tree, word};
use crate::words;
use crate::{
    Clearance, ClearanceModel, Friction, FrictionLaw, Joint, JointKind, Normal, NormalLaw,
};

/// Clearances that Pereira, Ramalho and Ambrósio fitted their law to \[m\].
const PEREIRA: [f64; 2] = [5e-6, 10e-3];

/// What the clearance and the friction of a joint need.
pub(super) fn joint(rules: &mut Rules<'_>, joint: &Joint, path: &str) {
    let (clearance, friction) = (joint.kind.clearance(), joint.kind.friction());
    if let Some(clearance) = clearance {
        of_clearance(rules, clearance, &format!("{path}.clearance"));
    }
    let Some(friction) = friction else { return };
    let mut words = Words { rules, path };
    if words.is_hole("friction") {
        return;
    }
    let model = clearance.map(|clearance| clearance.model);
    if let Some(model) = model.filter(|_| !words.is_hole("clearance.model")) {
        words.beside_clearance(model);
    }
    words.friction(Some(friction));
    let rubs = friction.law != FrictionLaw::None || words.is_hole("friction.law");
    if let JointKind::Revolute { pin_radius, .. } = &joint.kind
        && rubs
        && !words.is_hole("type")
    {
        let hint = "the torque of the friction is that of its force on the pin's surface";
        words.need("pin_radius", pin_radius.is_some(), hint);
    }
}

/// What the model of a clearance needs.
fn of_clearance(rules: &mut Rules<'_>, clearance: &Clearance, path: &str) {
    let mut words = Words { rules, path };
    words.fit(clearance);
    if words.is_hole("model") || clearance.model == ClearanceModel::Ideal {
        return;
    }
    let model = word(&clearance.model);
    match words.number("radius", clearance.radius) {
        // of a fit that is refused there is no radius
        None if clearance.fit.is_some() => {}
        None if clearance.radius.is_none() => words.complain(
            "",
            format!("\"radius\" is missing, the model {model:?} needs the radial clearance"),
            "bearing radius − journal radius, as in \"0.1 mm\"",
        ),
        Some(0.0) if clearance.model != ClearanceModel::MasslessLink => {
            let message = format!("must be greater than 0 for the model {model:?}");
            let complaint = Complaint::new(format!("{path}.radius"), message);
            words.rules.complaints.push(complaint);
        }
        Some(_) | None => {}
    }
    match clearance.model {
        ClearanceModel::Ideal | ClearanceModel::MasslessLink => {}
        ClearanceModel::TwoState => {
            let hint = "the model \"two_state\" needs its stiffness and damping";
            words.need("surface", clearance.surface.is_some(), hint);
            words.journal(clearance);
            words.friction(clearance.friction.as_ref());
        }
        ClearanceModel::ThreeState => {
            if words.lacks_restitution(clearance) {
                let hint = "the model \"three_state\" needs it, or \"normal.restitution\"";
                words.complain("", "\"impact.restitution\" is missing", hint);
            }
            words.journal(clearance);
        }
        ClearanceModel::Contact => {
            let hint = "the model \"contact\" needs a law of the normal force";
            words.need("normal", clearance.normal.is_some(), hint);
            words.journal(clearance);
            words.normal(clearance);
            words.friction(clearance.friction.as_ref());
        }
    }
}

/// The words of a clearance that is in use, or of a joint with friction.
struct Words<'c, 'm> {
    rules: &'c mut Rules<'m>,
    path: &'c str,
}

impl Words<'_, '_> {
    fn complain(&mut self, key: &str, message: impl Into<String>, hint: impl Into<String>) {
        self.rules
            .complain(format!("{}{key}", self.path), message, hint);
    }

    fn warn(&mut self, key: &str, message: impl Into<String>, hint: impl Into<String>) {
        let warning = Complaint::new(format!("{}{key}", self.path), message).hint(hint);
        self.rules.warnings.push(warning);
    }

    /// Whether a value is faulty.
    fn is_hole(&self, key: &str) -> bool {
        !self.rules.holes.is_empty() && self.rules.holes.has(&format!("{}.{key}", self.path))
    }

    /// A number, `None` if it is missing or faulty.
    fn number(&self, key: &str, number: Option<f64>) -> Option<f64> {
        number.filter(|_| !self.is_hole(key))
    }

    /// A fit is known, and has clearance.
    fn fit(&mut self, clearance: &Clearance) {
        let Some(fit) = clearance.fit.as_deref().filter(|_| !self.is_hole("fit")) else {
            return;
        };
        if let Err(fault) = Fit::parse(fit).and_then(|fit| fit.radial()) {
            let path = format!("{}.fit", self.path);
            self.rules.complaints.push(Complaint { path, ..fault });
        }
    }

    /// Complains where a value is missing; a faulty one counts as there.
    fn need(&mut self, key: &str, is_there: bool, hint: &str) {
        if !is_there && !self.is_hole(key) {
            self.complain("", format!("{key:?} is missing"), hint);
        }
    }

    /// The friction of an ideal joint stands beside a clearance.
    fn beside_clearance(&mut self, model: ClearanceModel) {
        let hint = match model {
            ClearanceModel::Ideal => return,
            ClearanceModel::MasslessLink => {
                "a massless clearance link has no friction: leave it out, or use another model"
            }
            ClearanceModel::TwoState | ClearanceModel::ThreeState | ClearanceModel::Contact => {
                "write it as \"clearance.friction\", or use the model \"ideal\""
            }
        };
        let message = format!(
            "is that of an ideal joint, but the joint's clearance has the model {:?}",
            word(&model)
        );
        self.complain(".friction", message, hint);
    }

    /// Whether neither the impact nor the contact has a restitution.
    fn lacks_restitution(&self, clearance: &Clearance) -> bool {
        let impact = clearance.impact.and_then(|impact| impact.restitution);
        let normal = clearance.normal.as_ref();
        let normal = normal.and_then(|normal| normal.restitution);
        impact.or(normal).is_none()
            && !self.is_hole("impact.restitution")
            && !self.is_hole("normal.restitution")
    }

    /// The journal has a radius above zero.
    fn journal(&mut self, clearance: &Clearance) {
        let radius = self.number("radius", clearance.radius);
        let bearing = self.number("bearing_radius", clearance.bearing_radius);
        if let (Some(radius), Some(bearing)) = (radius, bearing)
            && radius >= bearing
        {
            let hint = "\"radius\" is the clearance: bearing radius − journal radius";
            let message = "must be greater than \"radius\", or the journal has none";
            self.complain(".bearing_radius", message, hint);
        }
    }

    fn normal(&mut self, clearance: &Clearance) {
        let Some(normal) = clearance.normal.as_ref() else {
            return;
        };
        if self.is_hole("normal.law") {
            return;
        }
        let law = word(&normal.law);
        let is_cylindrical = matches!(
            normal.law,
            NormalLaw::Johnson
                | NormalLaw::Radzimovsky
                | NormalLaw::DubowskyFreudenstein
                | NormalLaw::Pereira
        );
        if !is_cylindrical {
            self.stiffness(clearance, normal);
        }
        self.needed("normal", "NormalLaw", &law, &Tree::of(normal));
        if is_cylindrical {
            self.cylindrical(clearance, normal, &format!("the law {law:?} needs it"));
        }
        // Their hysteresis factor is infinite without any rebound.
        let wants_rebound = matches!(
            normal.law,
            NormalLaw::Flores | NormalLaw::Gonthier | NormalLaw::HuGuo
        );
        if wants_rebound && self.number("normal.restitution", normal.restitution) == Some(0.0) {
            self.complain(
                ".normal.restitution",
                format!("must be greater than 0 for the law {law:?}"),
                "\"hunt_crossley\" or \"zhiying_qishao\" allow 0",
            );
        }
    }

    /// The keys that the table says a law needs.
    fn needed(&mut self, part: &str, choice: &str, law: &str, given: &Tree) {
        let hint = format!("the law {law:?} needs it");
        for key in words::needs(choice, law) {
            self.need(&format!("{part}.{key}"), given.get(key).is_some(), &hint);
        }
    }

    /// Laws of cylinders take materials and length instead of a stiffness.
    fn cylindrical(&mut self, clearance: &Clearance, normal: &Normal, needs_it: &str) {
        let bearing = clearance.bearing_radius.is_some();
        self.need("bearing_radius", bearing, needs_it);
        self.need("axial_length", clearance.axial_length.is_some(), needs_it);
        let radius = self
            .number("radius", clearance.radius)
            .filter(|radius| *radius > 0.0 && normal.law == NormalLaw::Pereira);
        if radius.is_some_and(|radius| !(PEREIRA[0]..PEREIRA[1]).contains(&radius)) {
            let message = "the law \"pereira\" holds from 5 µm to 10 mm";
            self.complain(".radius", message, "\"johnson\" has no such bound");
        }
    }

    /// K is given or follows from the materials, then with the exponent that belongs to it.
    fn stiffness(&mut self, clearance: &Clearance, normal: &Normal) {
        if normal.stiffness.is_some() || self.is_hole("normal.stiffness") {
            return;
        }
        if normal.elastic.is_none() && !self.is_hole("normal.elastic") {
            let hint = "give it, or \"elastic\" and \"bearing_radius\"";
            self.complain("", "\"normal.stiffness\" is missing", hint);
            return;
        }
        let hint = "the stiffness follows from \"elastic\" and the radii";
        self.need("bearing_radius", clearance.bearing_radius.is_some(), hint);
        let exponent = match normal.law {
            NormalLaw::KelvinVoigt => Some(1.0),
            _ => self.number("normal.exponent", normal.exponent),
        };
        if let Some(exponent) = exponent.filter(|exponent| *exponent != 1.5) {
            let message = format!(
                "gives a stiffness in N/m^1.5, whose number is taken with the exponent {exponent}"
            );
            let hint = "give \"stiffness\" in the unit that belongs to the exponent";
            self.warn(".normal.elastic", message, hint);
        }
    }

    fn friction(&mut self, friction: Option<&Friction>) {
        let Some(friction) = friction.filter(|_| !self.is_hole("friction.law")) else {
            return;
        };
        let law = word(&friction.law);
        self.needed("friction", "FrictionLaw", &law, &Tree::of(friction));
        match friction.law {
            FrictionLaw::None | FrictionLaw::Coulomb | FrictionLaw::Threlfall => {}
            FrictionLaw::Ambrosio => {
                self.increasing(friction.lower_velocity, friction.upper_velocity);
            }
            FrictionLaw::Stribeck | FrictionLaw::Lugre => {
                self.kinetic_is_less(friction.coefficient, friction.static_coefficient);
            }
        }
    }

    fn increasing(&mut self, lower: Option<f64>, upper: Option<f64>) {
        let lower = self.number("friction.lower_velocity", lower);
        let upper = self.number("friction.upper_velocity", upper);
        if let (Some(lower), Some(upper)) = (lower, upper)
            && upper <= lower
        {
            let message = "must be greater than \"lower_velocity\"";
            let hint = "the force grows from nothing to μF_n between the two";
            self.complain(".friction.upper_velocity", message, hint);
        }
    }

    fn kinetic_is_less(&mut self, kinetic: Option<f64>, resting: Option<f64>) {
        let kinetic = self.number("friction.coefficient", kinetic);
        let resting = self.number("friction.static_coefficient", resting);
        if let (Some(kinetic), Some(resting)) = (kinetic, resting)
            && resting < kinetic
        {
            let message = "is less than the kinetic \"coefficient\"";
            let hint = "\"coefficient\" is the kinetic one";
            self.warn(".friction.static_coefficient", message, hint);
        }
    }
}
