//! The class of a four-bar by its lengths, and bodies that turn fully on a circuit.

use linkdyn_engine::analysis::FoundCircuit;
use linkdyn_model::{Checked, GROUND, Joint, JointKind};
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// Differences below this part of the longest length are none.
const SAME: f64 = 1e-9;

/// What can turn fully, by Grashof's rule: the shortest and the longest length together are shorter than both others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum GrashofClass {
    /// The shortest body is pinned to the ground, and turns fully.
    CrankRocker,
    /// The ground is the shortest: both its neighbours turn fully.
    DoubleCrank,
    /// The coupler is the shortest, and turns fully; its neighbours swing.
    DoubleRocker,
    /// Nothing turns fully.
    TripleRocker,
    /// Both sums are equal: it can be folded, and branches cross there.
    ChangePoint,
}

/// A four-bar.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FourBarClass {
    /// Its class.
    pub class: GrashofClass,
    /// Shortest and longest length less both others \[m\].
    pub excess: f64,
}

impl GrashofClass {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            GrashofClass::CrankRocker => "crank and rocker",
            GrashofClass::DoubleCrank => "double crank",
            GrashofClass::DoubleRocker => "double rocker, whose coupler turns fully",
            GrashofClass::TripleRocker => "triple rocker: nothing turns fully",
            GrashofClass::ChangePoint => "change-point linkage: it can be folded",
        }
    }
}

impl FourBarClass {
    /// The class of a model of three moving bodies and four pins in a ring; `None` of others.
    pub fn of(model: &Checked) -> Option<FourBarClass> {
        let is_pin = |joint: &&Joint| matches!(joint.kind, JointKind::Revolute { .. });
        let joints: Vec<&Joint> = model.joints.values().filter(is_pin).collect();
        let moving = model.bodies.keys().filter(|name| *name != GROUND);
        let bodies: Vec<&str> = [GROUND]
            .into_iter()
            .chain(moving.map(String::as_str))
            .collect();
        if bodies.len() != 4 || joints.len() != 4 || model.joints.len() != 4 {
            return None;
        }
        let length = |body: &&str| -> Option<f64> {
            let ends = joints.iter().flat_map(|joint| &joint.between);
            let own: Vec<[f64; 2]> = ends
                .filter(|end| end.body == **body)
                .map(|end| model.bodies.get(*body)?.points.get(&end.point).copied())
                .collect::<Option<_>>()?;
            let [[a, b], [c, d]] = own.as_slice().try_into().ok()?;
            Some((c - a).hypot(d - b))
        };
        let lengths: Vec<f64> = bodies.iter().map(length).collect::<Option<_>>()?;
        let by = |order: &dyn Fn(&f64, &f64) -> bool| {
            (1..4).fold(0, |best, k| {
                if order(&lengths[k], &lengths[best]) {
                    k
                } else {
                    best
                }
            })
        };
        let (shortest, longest) = (by(&|a, b| a < b), by(&|a, b| a > b));
        let all: f64 = lengths.iter().sum();
        let excess = 2.0 * (lengths[shortest] + lengths[longest]) - all;
        let is_on_ground = joints.iter().any(|joint| {
            let ends = joint.between.each_ref().map(|end| end.body.as_str());
            ends.contains(&GROUND) && ends.contains(&bodies[shortest])
        });
        let class = match () {
            () if excess.abs() <= SAME * lengths[longest] => GrashofClass::ChangePoint,
            () if excess > 0.0 => GrashofClass::TripleRocker,
            () if shortest == 0 => GrashofClass::DoubleCrank,
            () if is_on_ground => GrashofClass::CrankRocker,
            () => GrashofClass::DoubleRocker,
        };
        Some(FourBarClass { class, excess })
    }
}

/// Bodies that turn fully while a circuit is gone round once, by their numbers.
pub fn turning(circuit: &FoundCircuit) -> Vec<usize> {
    let Some((_, first)) = circuit.course.first().filter(|_| circuit.is_closed) else {
        return Vec::new();
    };
    let turned = |body: &usize| {
        let angles = circuit.course.iter().map(|(_, poses)| poses[*body][2]);
        let mut last = first[*body][2];
        let mut sum = 0.0;
        for angle in angles {
            let by = angle - last;
            sum += by - TAU * (by / TAU).round();
            last = angle;
        }
        sum.abs() > PI
    };
    (0..first.len()).filter(turned).collect()
}
