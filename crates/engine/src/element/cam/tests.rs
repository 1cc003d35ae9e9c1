//! Cams for the shared check of elements, and the foot of a point.

use super::*;
use crate::element::tests::marker;
use crate::motion::rise::{self, Segment, Shape};
use crate::motion::{Law, Pieces};
use std::f64::consts::TAU;

/// A turn with a rise, a dwell and a return.
fn law(height: f64) -> Pieces {
    let segment = |shape, height, part: f64| Segment {
        shape,
        height,
        duration: part * TAU,
    };
    rise::turn(
        0.4,
        &[
            segment(Some(Shape::Cycloidal), height, 0.35),
            segment(None, 0.0, 0.15),
            segment(Some(Shape::Polynomial345), -height, 0.4),
        ],
    )
}

fn egg() -> Curve {
    let radius = |k: u32| 0.8 + 0.1 * (TAU * f64::from(k) / 12.0).cos();
    let points: Vec<[f64; 2]> = (0..=12)
        .map(|k| [TAU * f64::from(k) / 12.0, radius(k % 12)])
        .collect();
    Curve::new(curve::Form::Polar(Pieces::periodic(&points))).expect("a curve")
}

/// One of each, none of which is closed in the poses of the check.
pub(crate) fn all() -> Vec<(&'static str, Box<dyn Constraint>)> {
    let (cam, follower) = (marker(1, 0.3, -0.2), marker(2, -0.4, 0.1));
    let normal = Vec2::new(0.6, 0.8);
    let cam_of = |touch| -> Box<dyn Constraint> {
        Box::new(Cam {
            cam,
            follower,
            touch,
            way: None,
            kink: None,
        })
    };
    let face = |support| {
        cam_of(Touch::Face {
            normal,
            support: Arc::new(support),
        })
    };
    let round = |radius, form| {
        cam_of(Touch::Round {
            radius,
            curve: Arc::new(Curve::new(form).expect("a curve")),
        })
    };
    let centre = Vec2::new(0.1, -0.05);
    vec![
        (
            "face on a circle",
            face(Support::circle(centre, 0.6, normal)),
        ),
        ("face with a law", face(Support::law(0.6, law(0.2), normal))),
        (
            "face on a curve",
            face(Support::curve(egg(), normal).expect("a convex curve")),
        ),
        (
            "roller on a circle",
            round(
                0.2,
                curve::Form::Circle {
                    centre,
                    radius: 0.6,
                },
            ),
        ),
        (
            "roller on a curve",
            cam_of(Touch::Round {
                radius: 0.2,
                curve: Arc::new(egg()),
            }),
        ),
        (
            "roller with a law",
            round(
                0.2,
                curve::Form::Slide {
                    law: law(0.2),
                    axis: Vec2::new(0.6, 0.8),
                    height: 0.9,
                    offset: 0.15,
                },
            ),
        ),
        (
            "roller on an arm",
            round(
                0.2,
                curve::Form::Swing {
                    law: law(0.2),
                    axis: Vec2::new(-0.6, 0.8),
                    distance: 1.6,
                    arm: 1.2,
                    angle: -0.7,
                },
            ),
        ),
    ]
}

#[test]
fn the_foot_of_a_place_on_the_curve_is_that_place() {
    let forms = [
        curve::Form::Slide {
            law: law(0.3),
            axis: Vec2::new(0.0, 1.0),
            height: 0.5,
            offset: -0.2,
        },
        curve::Form::Swing {
            law: law(0.3),
            axis: Vec2::new(1.0, 0.0),
            distance: 1.0,
            arm: 0.8,
            angle: 0.6,
        },
    ];
    let curves = forms.map(|form| Curve::new(form).expect("a curve"));
    for curve in curves.iter().chain([&egg()]) {
        for k in 0..500 {
            let [place, rate, change] = curve.place(TAU * f64::from(k) / 500.0);
            let foot = curve.foot(place, None);
            assert!(foot.distance.abs() < 1e-15, "{k}: {foot:?}");
            assert!(foot.normal.dot(&rate).abs() < 1e-13, "{k}: {foot:?}");
            assert!(foot.normal.dot(&place) > 0.0);
            let cross = rate.x * change.y - rate.y * change.x;
            let curvature = cross.abs() / rate.norm().powi(3);
            assert!((foot.curvature.abs() - curvature).abs() < 1e-9 * curvature.max(1.0));
        }
    }
}

#[test]
fn a_point_off_the_curve_has_its_distance() {
    let curve = egg();
    for k in 0..200 {
        let [place, rate, _] = curve.place(TAU * f64::from(k) / 200.0);
        let normal = -perp(rate) / rate.norm();
        for far in [-0.3, 0.4, 2.0] {
            let foot = curve.foot(place + normal * far, None);
            assert!((foot.distance - far).abs() < 1e-12, "{k} {far}: {foot:?}");
        }
    }
}

#[test]
fn a_turn_has_its_law_over_and_over() {
    let (once, law) = (law(0.2), law(0.2));
    for k in 0..60 {
        let u = 0.4 + TAU * f64::from(k) / 60.0;
        for turns in [-3.0, 1.0, 1000.0] {
            let [a, b] = [once.jet(u), law.jet(u + turns * TAU)];
            // angles of many turns are as exact as doubles are
            assert!(
                (0..2).all(|i| (a[i] - b[i]).abs() < 1e-11),
                "{k}: {a:?} {b:?}"
            );
        }
    }
    assert!(Law::Pieces(law).has_breaks());
}
