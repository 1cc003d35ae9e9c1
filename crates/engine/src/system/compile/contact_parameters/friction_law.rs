//! Laws of friction from their words.

use super::need;
use crate::contact::friction::{self, Decay};
use linkdyn_model::error::Complaint;
use linkdyn_model::{Friction, FrictionLaw};

/// Law of a friction, with the path of what has it: `joints.b.clearance`, or `joints.b` where the joint is ideal.
///
/// # Errors
/// Where a parameter is missing or out of the law's range.
pub fn friction_law(words: &Friction, path: &str) -> Result<friction::Law, Complaint> {
    let not_negative = |value: f64| value >= 0.0;
    let coefficient = || {
        need(
            path,
            "friction.coefficient",
            words.coefficient,
            not_negative,
        )
    };
    let threshold = || {
        need(
            path,
            "friction.threshold_velocity",
            words.threshold_velocity,
            |v| v > 0.0,
        )
    };
    let viscous = || {
        need(
            path,
            "friction.viscous",
            Some(words.viscous.unwrap_or(0.0)),
            not_negative,
        )
    };
    Ok(match words.law {
        FrictionLaw::None => friction::Law::None,
        FrictionLaw::Coulomb => friction::Law::Coulomb {
            coefficient: coefficient()?,
            threshold: threshold()?,
        },
        FrictionLaw::Threlfall => friction::Law::Threlfall {
            coefficient: coefficient()?,
            threshold: threshold()?,
        },
        FrictionLaw::Ambrosio => ambrosio(words, path)?,
        FrictionLaw::Stribeck => {
            let (decay, viscous) = (decay(words, path)?, viscous()?);
            friction::Law::Stribeck {
                decay,
                threshold: threshold()?,
                viscous,
            }
        }
        FrictionLaw::Lugre => {
            let decay = decay(words, path)?;
            let stiffness = need(
                path,
                "friction.bristle_stiffness",
                words.bristle_stiffness,
                |s| s > 0.0,
            )?;
            let damping = words.bristle_damping.unwrap_or(0.0);
            let damping = need(
                path,
                "friction.bristle_damping",
                Some(damping),
                not_negative,
            )?;
            friction::Law::Lugre {
                decay,
                stiffness,
                damping,
                viscous: viscous()?,
            }
        }
    })
}

/// No friction below one velocity, all of it from another.
fn ambrosio(words: &Friction, path: &str) -> Result<friction::Law, Complaint> {
    let lower = need(
        path,
        "friction.lower_velocity",
        words.lower_velocity,
        |lower| lower >= 0.0,
    )?;
    let upper = need(
        path,
        "friction.upper_velocity",
        words.upper_velocity,
        |upper| upper > lower,
    )?;
    let coefficient = need(path, "friction.coefficient", words.coefficient, |mu| {
        mu >= 0.0
    })?;
    Ok(friction::Law::Ambrosio {
        coefficient,
        lower,
        upper,
    })
}

fn decay(words: &Friction, path: &str) -> Result<Decay, Complaint> {
    let not_negative = |value: f64| value >= 0.0;
    let exponent = words.stribeck_exponent.unwrap_or(2.0);
    Ok(Decay {
        kinetic: need(
            path,
            "friction.coefficient",
            words.coefficient,
            not_negative,
        )?,
        r#static: need(
            path,
            "friction.static_coefficient",
            words.static_coefficient,
            not_negative,
        )?,
        velocity: need(
            path,
            "friction.stribeck_velocity",
            words.stribeck_velocity,
            |v| v > 0.0,
        )?,
        exponent: need(
            path,
            "friction.stribeck_exponent",
            Some(exponent),
            |exponent| exponent > 0.0,
        )?,
    })
}
