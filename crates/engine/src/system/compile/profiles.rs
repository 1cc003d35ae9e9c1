//! The profiles of a model's cams, for whoever makes or draws them.

use super::compile_geometry;
use linkdyn_model::Checked;
use std::f64::consts::TAU;

/// Corners of a profile: one for each half degree.
const CORNERS: usize = 720;

/// The profile of a cam.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Its joint in the model.
    pub joint: usize,
    /// The name of that.
    pub name: String,
    /// By rows: the parameter of the curve \[rad\], x and y of the profile, x and y of the pitch curve, in the cam's frame from its
    /// point \[m\], and the curvature of the profile [1/m]. The parameter is the angle of the cam where the motion is given, else
    /// the direction of the place or, under a flat face, of the normal.
    pub rows: Vec<[f64; 6]>,
    /// How far a flat face is touched to either side of the follower's guide, at most \[m\].
    pub reach: f64,
}

/// The profiles of a model's cams, in the order of the joints; `None` if a joint can't be had.
pub fn profiles(model: &Checked) -> Vec<Profile> {
    let Ok(system) = compile_geometry(model) else {
        return Vec::new();
    };
    let joints = system.joints.iter().enumerate();
    let profile = |(joint, data): (usize, &crate::system::JointData)| {
        let cam = data.extras().cam.as_ref()?;
        let mut reach: f64 = 0.0;
        let row = |k: usize| {
            let u = TAU * k as f64 / CORNERS as f64;
            let corner = cam.corner(u);
            reach = reach.max(corner.along.abs());
            let [profile, pitch] = corner.places;
            [u, profile.x, profile.y, pitch.x, pitch.y, corner.curvature]
        };
        let rows = (0..=CORNERS).map(row).collect();
        let name = data.name.clone();
        Some(Profile {
            joint,
            name,
            rows,
            reach,
        })
    };
    joints.filter_map(profile).collect()
}
