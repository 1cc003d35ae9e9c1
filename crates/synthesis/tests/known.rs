//! Known linkages are found again from positions that they pass.

use linkdyn_linear::bilinear::{Number, Random};
use linkdyn_synthesis::dyad::{Dyad, Position, guide, links, links_on_line};
use linkdyn_synthesis::fit::{Candidate, Limits, Wanted, fit};
use linkdyn_synthesis::keep::{Kept, Residual};
use linkdyn_synthesis::linkage::{Joint, Kind, Linkage, Places};
use linkdyn_synthesis::path::{CURVES, stored, through_nine};

/// A closed form: the pin of a coupler of length c and a rocker of length l, on the left of the line from crank to rocker pivot.
struct Known {
    pivots: [Number; 2],
    crank: f64,
    coupler: f64,
    rocker: f64,
    /// The point, in parts of the coupler.
    part: Number,
}

const KNOWN: Known = Known {
    pivots: [Number::new(0.2, -0.1), Number::new(3.2, 0.4)],
    crank: 1.0,
    coupler: 3.2,
    rocker: 2.2,
    part: Number::new(0.5, 0.6),
};

impl Known {
    /// Crank pin, rocker pin, point.
    fn pins(&self, angle: f64) -> [Number; 3] {
        let a = self.pivots[0] + Number::from_polar(self.crank, angle);
        let way = self.pivots[1] - a;
        let d = way.norm();
        let cosine =
            (d * d + self.coupler.powi(2) - self.rocker.powi(2)) / (2.0 * d * self.coupler);
        let b = a + way / d * Number::from_polar(self.coupler, cosine.acos());
        [a, b, a + (b - a) * self.part]
    }

    fn linkage(&self, angle: f64) -> Linkage {
        let [a, b, point] = self.pins(angle);
        let pin = |bodies, place| Joint {
            bodies,
            kind: Kind::Pin(place),
        };
        Linkage {
            bodies: 4,
            joints: vec![
                pin([0, 1], self.pivots[0]),
                pin([1, 2], a),
                pin([2, 3], b),
                pin([3, 0], self.pivots[1]),
            ],
            crank: 1,
            output: 2,
            point,
        }
    }

    fn positions(&self, angles: &[f64]) -> Vec<Position> {
        let poses = angles.iter().map(|angle| {
            let [a, b, point] = self.pins(*angle);
            (point, (b - a) / (b - a).norm())
        });
        Position::counted(&poses.collect::<Vec<_>>())
    }
}

fn has(all: &[Dyad], fixed: Number, moving: Number, within: f64) -> bool {
    let near = |d: &Dyad| (d.fixed - fixed).norm().max((d.moving - moving).norm());
    all.iter().map(near).fold(f64::INFINITY, f64::min) < within
}

#[test]
fn a_four_bar_is_found_from_five_positions() {
    let angles = [0.3, 0.9, 1.7, 2.4, 3.3];
    let positions = KNOWN.positions(&angles);
    let [a, b, point] = KNOWN.pins(angles[0]);
    let (all, complex) = links(&positions.try_into().expect("five"), point);
    assert_eq!(complex, 4);
    assert!(has(&all, KNOWN.pivots[0], a, 1e-10), "{all:?}");
    assert!(has(&all, KNOWN.pivots[1], b, 1e-10), "{all:?}");
    assert!(all.len() == 2 || all.len() == 4);
}

#[test]
fn every_link_of_random_positions_keeps_its_length() {
    let mut random = Random::new(11);
    let mut counts = [0; 5];
    for _ in 0..300 {
        let poses: Vec<(Number, Number)> = (0..5)
            .map(|_| {
                (
                    random.turn() * 40.0 + random.turn() * 25.0 + 300.0,
                    random.turn(),
                )
            })
            .collect();
        let positions: [Position; 5] = Position::counted(&poses).try_into().expect("five");
        let (all, complex) = links(&positions, poses[0].0);
        assert_eq!(complex, 4);
        counts[all.len()] += 1;
        for d in all {
            let length = (d.moving - d.fixed).norm();
            for p in &positions {
                let off = (p.of(d.moving) - d.fixed).norm() - length;
                assert!(off.abs() < 1e-9 * (40.0 + length), "{off:e} of {length}");
            }
        }
    }
    // Roots come in pairs (McCarthy and Soh 2011, 5.3).
    assert_eq!([counts[1], counts[3]], [0, 0]);
    assert!(
        counts[0] > 20 && counts[2] > 20 && counts[4] > 20,
        "{counts:?}"
    );
}

#[test]
fn four_positions_leave_a_curve_and_one_guide() {
    let angles = [0.3, 0.9, 1.7, 2.4];
    let positions: [Position; 4] = KNOWN.positions(&angles).try_into().expect("four");
    let [a, _, point] = KNOWN.pins(angles[0]);
    let normal = Number::from_polar(1.0, 0.7);
    let offset = (normal.conj() * KNOWN.pivots[0]).re;
    let all = links_on_line(&positions, point, normal, offset);
    assert!(has(&all, KNOWN.pivots[0], a, 1e-9), "{all:?}");
    assert!(
        all.iter()
            .all(|d| ((normal.conj() * d.fixed).re - offset).abs() < 1e-9)
    );
    let guide = guide(&positions, point).expect("a guide");
    let first = positions[0].of(guide.point);
    for p in &positions[1..] {
        let way = p.of(guide.point) - first;
        assert!((guide.along.conj() * way).im.abs() < 1e-10);
    }
}

#[test]
fn stored_curves_are_as_many_as_published() {
    assert_eq!(stored().len(), CURVES);
}

#[test]
fn a_four_bar_and_its_cognates_are_found_from_nine_points() {
    let points: Vec<Number> = (0..9)
        .map(|k| KNOWN.pins(0.3 + 0.65 * f64::from(k))[2])
        .collect();
    let points: [Number; 9] = points.try_into().expect("nine");
    let paths = through_nine(&points, &|| false).expect("not stopped");
    let [a, b, _] = KNOWN.pins(0.3);
    let is_it = |one: &&[Dyad; 2]| {
        has(*one, KNOWN.pivots[0], a, 1e-9) && has(*one, KNOWN.pivots[1], b, 1e-9)
    };
    assert_eq!(paths.found.iter().filter(is_it).count(), 1);
    assert!(paths.found.len().is_multiple_of(3) && paths.complex >= CURVES - 10);
    assert_eq!(paths.missing, 0);
    // Each passes all nine: its dyads' circles have the coupler's turn in common.
    for one in &paths.found {
        let shape = one[1].moving - one[0].moving;
        for p in &points[1..] {
            let [x, y] = one.map(|d| d.moving - points[0]);
            let off = turn_there(one, *p - points[0], points[0])
                .map(|turn| {
                    [x, y]
                        .iter()
                        .zip(one)
                        .map(|(x, d)| {
                            ((*p + turn * x - d.fixed).norm() - (d.moving - d.fixed).norm()).abs()
                        })
                        .fold(0.0, f64::max)
                })
                .fold(f64::INFINITY, f64::min);
            let size = shape.norm() + (one[0].fixed - one[1].fixed).norm() + 1.0;
            assert!(off < 1e-6 * size, "{off:e} of {size}");
        }
    }
}

/// Turns of the coupler with which the first dyad keeps its length.
fn turn_there(one: &[Dyad; 2], by: Number, first: Number) -> impl Iterator<Item = Number> {
    let d = one[0];
    let (x, a) = (d.moving - first, d.fixed - first);
    // |δ − a + Θ x| = |x − a|
    let (way, length) = (by - a, (x - a).norm());
    let cosine = (length.powi(2) - way.norm_sqr() - x.norm_sqr()) / (2.0 * way.norm() * x.norm());
    let angle = cosine.clamp(-1.0, 1.0).acos();
    [angle, -angle]
        .into_iter()
        .map(move |angle| Number::from_polar(1.0, angle + way.arg() - x.arg()))
}

fn limits(linkage: &Linkage, room: f64) -> Limits {
    Limits {
        dimensions: linkage
            .dimensions()
            .iter()
            .map(|d| [d - room, d + room])
            .collect(),
        directions: Vec::new(),
        length: 3.0,
        kept: None,
    }
}

#[test]
fn a_fit_comes_back_to_a_linkage_from_one_near_it() {
    let angles: Vec<f64> = (0..14).map(|k| 0.3 + f64::from(k) * 0.42).collect();
    let wanted: Vec<Wanted> = angles
        .iter()
        .map(|angle| Wanted {
            point: Some(KNOWN.pins(*angle)[2]),
            ..Wanted::default()
        })
        .collect();
    let linkage = KNOWN.linkage(angles[0]);
    let mut random = Random::new(5);
    let off: Vec<f64> = linkage
        .dimensions()
        .iter()
        .map(|d| d + 0.15 * random.turn().re)
        .collect();
    let from = Candidate {
        linkage: linkage.with(&off),
        turns: angles.iter().map(|angle| angle - angles[0]).collect(),
    };
    let found = fit(&from, &wanted, &limits(&linkage, 3.0), &|| false).expect("a fit");
    assert!(found.rms < 1e-12, "{:e}", found.rms);
    let apart = found
        .candidate
        .linkage
        .dimensions()
        .iter()
        .zip(linkage.dimensions())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    assert!(apart < 1e-8, "{apart:e}");
}

/// Values of residuals of the same number.
fn values(of: &[Residual]) -> Vec<f64> {
    of.iter().map(|own| own.value).collect()
}

#[test]
fn what_is_kept_changes_with_pins_and_bodies_as_differences_say() {
    let linkage = KNOWN.linkage(0.3);
    let places = linkage.led(linkage.first(), 0.0, 0.8).expect("closed");
    let of = |linkage: &Linkage, places: &Places| -> Vec<Residual> {
        let mut all = vec![Residual::of_direction(linkage, linkage.crank, 1.1)];
        all.extend(Residual::of_lengths(linkage, [0.9, 1.7]));
        all.extend(Residual::of_transmission(linkage, places, 1.5));
        all
    };
    let all = of(&linkage, &places);
    assert!(
        values(&all).iter().filter(|v| v.abs() > 1e-3).count() >= 4,
        "{all:?}"
    );
    let step = 1e-6;
    let check = |slope: &dyn Fn(&Residual) -> f64, moved: &dyn Fn(f64) -> Vec<f64>| {
        for ((own, there), back) in all.iter().zip(moved(step)).zip(moved(-step)) {
            let by = (there - back) / (2.0 * step);
            assert!(
                (slope(own) - by).abs() < 1e-7 * (1.0 + by.abs()),
                "{own:?}: {by}"
            );
        }
    };
    for pin in 0..4 {
        for (axis, direction) in [Number::new(1.0, 0.0), Number::i()].into_iter().enumerate() {
            let slope = |own: &Residual| -> f64 {
                let here = own.by_pins.iter().filter(|(k, _)| *k == pin);
                here.map(|(_, by)| [by.re, by.im][axis]).sum()
            };
            check(&slope, &|by| {
                let mut other = linkage.clone();
                let at = other.joints[pin].pin().expect("a pin");
                other.joints[pin].kind = Kind::Pin(at + direction * by);
                values(&of(&other, &places))
            });
        }
    }
    for body in 1..4 {
        let slope = |own: &Residual| -> f64 {
            let here = own.by_bodies.iter().filter(|(k, _)| *k == body);
            here.map(|(_, by)| by).sum()
        };
        check(&slope, &|by| {
            let mut other = places.clone();
            other[3 * body - 1] += by;
            values(&of(&linkage, &other))
        });
    }
}

#[test]
fn limits_next_to_each_other_are_aimed_at_in_their_middle() {
    // The crank is 1 long.
    let over = |limits: [f64; 2]| Residual::of_lengths(&KNOWN.linkage(0.3), limits)[0].value;
    assert!(
        over([0.995, 1.005]).abs() < 0.01,
        "{}",
        over([0.995, 1.005])
    );
    assert!(over([1.002, 1.01]) < 0.0 && over([0.99, 0.998]) > 0.0);
}

#[test]
fn a_fit_keeps_lengths_and_the_angle_of_transmission() {
    // Four points leave dimensions free, so that some linkage passes them and keeps the limits as well.
    let wanted: Vec<Wanted> = (0..4)
        .map(|k| Wanted {
            point: Some(KNOWN.pins(0.3 + 0.4 * f64::from(k))[2]),
            ..Wanted::default()
        })
        .collect();
    let turns = (0..4).map(|k| 0.4 * f64::from(k)).collect();
    let linkage = KNOWN.linkage(0.3);
    let from = Candidate { linkage, turns };
    let least = |of: &Candidate| -> f64 {
        let linkage = &of.linkage;
        let (mut places, mut at, mut least) = (linkage.first(), 0.0, f64::INFINITY);
        for turn in &of.turns {
            places = linkage.led(places, at, *turn).expect("closed");
            at = *turn;
            let place = |body: usize, pin: usize| {
                let at = linkage.joints[pin].pin().expect("a pin");
                linkage.position(&places, body).of(at)
            };
            let (a, b, pivot) = (place(1, 1), place(2, 2), place(0, 3));
            let angle = ((a - b) / (pivot - b)).arg().abs();
            least = least.min(angle.min(std::f64::consts::PI - angle));
        }
        least
    };
    let longest = |of: &Candidate| {
        let pin = |k: usize| of.linkage.joints[k].pin().expect("a pin");
        (0..3)
            .map(|k| (pin(k) - pin(k + 1)).norm())
            .fold(0.0, f64::max)
    };
    let (far, near) = (longest(&from), least(&from));
    for (part, more) in [(0.9, None), (1.02, Some(0.2))] {
        let kept = Limits {
            kept: Some(Kept {
                lengths: [0.01, part * far],
                transmission: more.map(|more| near + more),
            }),
            ..limits(&from.linkage, 3.0)
        };
        let mut random = Random::new(2);
        let exact = (0..12).filter_map(|_| {
            let dimensions = from.linkage.dimensions();
            let off: Vec<f64> = dimensions
                .iter()
                .map(|d| d + 0.3 * random.turn().re)
                .collect();
            let start = Candidate {
                linkage: from.linkage.with(&off),
                ..from.clone()
            };
            fit(&start, &wanted, &kept, &|| false).filter(|found| found.rms < 1e-12)
        });
        let exact: Vec<Candidate> = exact.map(|found| found.candidate).collect();
        assert!(exact.len() >= 3, "{} of 12", exact.len());
        for own in &exact {
            assert!(longest(own) <= part * far);
            assert!(more.is_none_or(|more| least(own) >= near + more));
        }
    }
}

#[test]
fn the_spread_is_that_of_moved_holes() {
    let linkage = KNOWN.linkage(0.3);
    let step = 1e-6;
    for turn in [0.0, 0.7, 2.9] {
        let places = linkage.led(linkage.first(), 0.0, turn).expect("closed");
        let [point, angle] = linkage.spread(&places, turn).expect("regular");
        // By the closed form: crank pivot, crank, coupler, rocker, rocker pivot and the point, each end of a body by itself.
        let (mut p2, mut a2) = (2.0, 0.0);
        let [a, b, p] = KNOWN.pins(0.3 + turn);
        let crank = Number::from_polar(1.0, 0.3 + turn);
        for (hole, direction) in
            (0..8).flat_map(|hole| [(hole, Number::new(1.0, 0.0)), (hole, Number::i())])
        {
            let moved = |by: f64| {
                let off = direction * by;
                let mut pivots = KNOWN.pivots;
                let mut pin = a;
                let (mut coupler, mut rocker) = (
                    (b - a) / ((b - a) / (b - a).norm()),
                    Number::from(KNOWN.rocker),
                );
                let mut start = Number::new(0.0, 0.0);
                match hole {
                    0 | 1 => pin += off,
                    2 => pin += crank * off,
                    3 => start = off,
                    4 => coupler += off,
                    5 => rocker += off,
                    6 => rocker -= off,
                    _ => pivots[1] += off,
                }
                // The coupler's frame begins where its first hole should be; holes at `start` and `coupler`.
                let (c, l) = ((coupler - start).norm(), rocker.norm());
                let way = pivots[1] - pin;
                let d = way.norm();
                let cosine = (d * d + c * c - l * l) / (2.0 * d * c);
                let end = pin + way / d * Number::from_polar(c, cosine.acos());
                let turned = (end - pin) / (coupler - start);
                let turned = turned / turned.norm();
                (
                    pin + turned * ((p - a) / ((b - a) / (b - a).norm()) - start),
                    turned.arg(),
                )
            };
            let (more, less) = (moved(step), moved(-step));
            p2 += ((more.0 - less.0) / (2.0 * step)).norm_sqr();
            a2 += ((more.1 - less.1) / (2.0 * step)).powi(2);
        }
        assert!(
            (point - p2.sqrt()).abs() < 1e-6 * point,
            "{point} {}",
            p2.sqrt()
        );
        assert!(
            (angle - a2.sqrt()).abs() < 1e-6 * angle,
            "{angle} {}",
            a2.sqrt()
        );
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    let linkage = KNOWN.linkage(0.3);
    let dimensions = linkage.dimensions();
    let (turn, step) = (1.7, 1e-6);
    let end = |column: usize, by: f64| {
        let mut own = dimensions.clone();
        own[column] += by;
        let linkage = linkage.with(&own);
        linkage.led(linkage.first(), 0.0, turn).expect("closed")
    };
    let places = end(0, 0.0);
    let by = linkage.slopes(&places, turn).expect("regular");
    for column in 0..dimensions.len() {
        let difference = (end(column, step) - end(column, -step)) / (2.0 * step);
        assert!(
            (difference - by.column(column)).amax() < 1e-7,
            "column {column}"
        );
    }
}

/// Newton's iteration on (z, g) real, from random places, with equations of its own: |tⱼ + Θⱼ z − g|² = |z − g|².
fn newton(positions: &[Position; 5], random: &mut Random, near: Number, size: f64) -> Option<Dyad> {
    let mut place = || near + random.turn() * size * 2.0 + random.turn() * size * 1.3;
    let (mut z, mut g) = (place(), place());
    for _ in 0..60 {
        let rows = positions[1..].iter().map(|p| {
            let (there, arm) = (p.of(z) - g, z - g);
            let value = there.norm_sqr() - arm.norm_sqr();
            // ∂/∂z and ∂/∂g as vectors of the plane.
            let (by_z, by_g) = ((there * p.turn.conj() - arm) * 2.0, (arm - there) * 2.0);
            (value, [by_z.re, by_z.im, by_g.re, by_g.im])
        });
        let rows: Vec<(f64, [f64; 4])> = rows.collect();
        let matrix = nalgebra::Matrix4::from_fn(|i, j| rows[i].1[j]);
        let right = nalgebra::Vector4::from_fn(|i, _| rows[i].0);
        let step = matrix.lu().solve(&right)?;
        z -= Number::new(step[0], step[1]);
        g -= Number::new(step[2], step[3]);
        if step.norm() < 1e-12 * size {
            let length = (z - g).norm();
            return (length > 1e-3 * size && length < 1e3 * size).then_some(Dyad {
                fixed: g,
                moving: z,
            });
        }
    }
    None
}

#[test]
fn no_link_that_newtons_iteration_finds_is_missing() {
    let mut random = Random::new(23);
    let mut found = 0;
    for _ in 0..60 {
        let poses: Vec<(Number, Number)> = (0..5)
            .map(|_| (random.turn() * 3.0 + random.turn() * 2.0, random.turn()))
            .collect();
        let positions: [Position; 5] = Position::counted(&poses).try_into().expect("five");
        let (all, _) = links(&positions, poses[0].0);
        for _ in 0..1000 {
            if let Some(one) = newton(&positions, &mut random, poses[0].0, 5.0) {
                let scale = (one.fixed - one.moving).norm() + 5.0;
                assert!(
                    has(&all, one.fixed, one.moving, 1e-6 * scale),
                    "{one:?} of {all:?}"
                );
                found += 1;
            }
        }
    }
    assert!(found > 5000, "{found}");
}
