//! Messages about cams for their designer: pressure angles that jam, profiles that can't be made, contacts that would open.
//!
//! A follower that slides jams in its guide from a pressure angle of about 30° on, one that swings from about 45° (Norton, Cam
//! Design and Manufacturing Handbook, 2009, ch. 7; VDI 2142).

use crate::element::Kinematics;
use crate::element::cam::{Cam, Way};
use crate::system::System;
use linkdyn_model::display::number;

/// Pressure angles that are usual at most \[rad\].
const SLIDES: f64 = 30.0 * std::f64::consts::PI / 180.0;
const SWINGS: f64 = 45.0 * std::f64::consts::PI / 180.0;
/// Part of the largest force below which a pull is round-off, and of the largest angle by which it is no other [–].
const ROUND_OFF: f64 = 1e-9;
/// Digits of what is reported.
const DIGITS: usize = 4;

/// What was seen of the cams of a mechanism.
#[derive(Debug, Clone, Default)]
pub struct Watch {
    cams: Vec<CamRecord>,
}

/// What was seen of a cam: sizes with the cam's angle \[rad\] and the time \[s\].
#[derive(Debug, Clone, Copy, Default)]
struct CamRecord {
    /// The largest pressure angle \[rad\].
    pressure: [f64; 3],
    /// The largest pull \[N\].
    pull: f64,
    /// Where the contact first pulls.
    opens: Option<[f64; 2]>,
    /// The largest force \[N\].
    force: f64,
}

/// Angle of the cam against what guides its follower, within a turn \[rad\].
fn angle(cam: &Cam, at: &Kinematics) -> f64 {
    let guide = match cam.way {
        Some(Way::Swing(_, guide)) => guide,
        Some(Way::Slide(..)) | None => cam.follower.body,
    };
    let turned = at.poses[cam.cam.body.0].theta - at.poses[guide.0].theta;
    turned.rem_euclid(std::f64::consts::TAU)
}

impl Watch {
    /// Looks at a row, with its multipliers where there are forces.
    pub fn note(&mut self, system: &System, at: &Kinematics, lambda: Option<&[f64]>) {
        let cams = system.joints.iter().enumerate();
        let cams = cams.filter_map(|(joint, data)| Some((joint, data.extras().cam.as_ref()?)));
        for (k, (joint, cam)) in cams.enumerate() {
            if self.cams.len() <= k {
                self.cams.push(CamRecord::default());
            }
            let seen = &mut self.cams[k];
            let here = angle(cam, at);
            let pressure = cam.meeting(at).pressure.unwrap_or_default();
            // Of angles that are equal but for round-off the first is named.
            if pressure.abs() > (1.0 + ROUND_OFF) * seen.pressure[0].abs() {
                seen.pressure = [pressure, here, at.time];
            }
            let Some(lambda) = lambda else { continue };
            let force = lambda[system.blocks[joint].row()];
            if !force.is_finite() {
                continue;
            }
            seen.force = seen.force.max(force.abs());
            if force < -ROUND_OFF * seen.force {
                seen.opens.get_or_insert([here, at.time]);
                seen.pull = seen.pull.max(-force);
            }
        }
    }

    /// What is said of it.
    pub fn warnings(&self, system: &System) -> Vec<String> {
        let display = &system.display;
        let text = |angle: f64| display.angle_to(angle, DIGITS);
        let cams = system.joints.iter();
        let cams = cams.filter_map(|data| Some((&data.name, data.extras().cam.as_ref()?)));
        let mut said = Vec::new();
        for ((name, cam), seen) in cams.zip(&self.cams) {
            let (limit, kind) = match cam.way {
                Some(Way::Swing(..)) => (SWINGS, "swings"),
                Some(Way::Slide(..)) | None => (SLIDES, "slides"),
            };
            let [pressure, here, _] = seen.pressure;
            if pressure.abs() > limit {
                said.push(format!(
                    "the pressure angle of cam \"{name}\" reaches {}, at a cam angle of {}, where {} is usual at most for a follower \
                     that {kind}: a larger base radius or a slower rise makes it smaller",
                    text(pressure.abs()),
                    text(here),
                    text(limit)
                ));
            }
            if let Some((here, room)) = cam.undercut() {
                said.push(format!(
                    "the profile of cam \"{name}\" is undercut near {} of its turn: the radius of curvature there leaves {} for what \
                     touches it: a larger base radius, a slower rise or a smaller roller mends it",
                    text(here),
                    display.length_to(room, DIGITS)
                ));
            }
            if let Some([here, time]) = seen.opens {
                said.push(format!(
                    "the follower of cam \"{name}\" would lift off at a cam angle of {}, t = {}: the contact, which holds it from both \
                     sides, pulls there, and with {} N at most: a stiffer or more strongly preloaded spring or a slower cam keeps it \
                     pressed, a groove holds it as computed",
                    text(here),
                    display.time(time),
                    number(seen.pull, DIGITS)
                ));
            }
        }
        said
    }
}
