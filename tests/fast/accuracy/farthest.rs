//! The worst found against brute force: corners of all that has two ends, times directions of all that has any, in closed form.

use super::linkages::{Linkage, Source, linkage};
use super::told::{Random, Told};

/// Linkages that are tried, and the largest deviation of their sources [m].
const LINKAGES: usize = 64;
const LARGEST: f64 = 0.005;
/// Corners with directions that are tried of each output's side, and of how many of the best is climbed on.
const CORNERS: usize = 200;
const CLIMBS: usize = 3;
/// The farthest by brute force may be so much of it less than the farthest there is …
const SHORT: f64 = 1e-6;
/// … and no more than this beyond what is found.
const BEYOND: f64 = 1e-9;
/// All sources lack no more than this part of it.
const STATIONARY: f64 = 1e-6;

/// Deviations of all sources, each at its end, in any direction.
fn corner(linkage: &Linkage, random: &mut Random) -> Vec<f64> {
    let mut by = vec![0.0; linkage.count];
    for source in &linkage.sources {
        match *source {
            Source::Line { at, ends } => by[at] = ends[usize::from(random.next() < 0.5)],
            Source::Disc { at, radius } => {
                let (sin, cos) = (std::f64::consts::PI * random.both()).sin_cos();
                [by[at], by[at + 1]] = [radius * cos, radius * sin];
            }
        }
    }
    by
}

/// Where one source may go from where it is, by a part of all that it may.
fn moves(source: &Source, by: &[f64], part: f64) -> Vec<(usize, Vec<f64>)> {
    match *source {
        Source::Line {
            at,
            ends: [low, high],
        } => {
            let step = part * (high - low);
            let ways = [by[at] - step, by[at] + step];
            ways.map(|to| (at, vec![to.clamp(low, high)])).into()
        }
        Source::Disc { at, radius } => {
            let [x, y] = [by[at], by[at + 1]];
            let (size, angle) = (x.hypot(y), y.atan2(x));
            let to = |size: f64, angle: f64| {
                let size = size.clamp(0.0, radius);
                (at, vec![size * angle.cos(), size * angle.sin()])
            };
            let turned = std::f64::consts::PI * part;
            vec![
                to(size, angle + turned),
                to(size, angle - turned),
                to(size + part * radius, angle),
                to(size - part * radius, angle),
            ]
        }
    }
}

/// Climbs by moves of one source after the other, shorter and shorter.
fn climb(linkage: &Linkage, by: &mut [f64], value: &dyn Fn(&[f64]) -> f64) -> f64 {
    let mut best = value(by);
    let mut part = 1.0;
    while part > 1e-5 {
        let before = best;
        for source in &linkage.sources {
            for (at, to) in moves(source, by, part) {
                let from = by[at..at + to.len()].to_vec();
                by[at..at + to.len()].copy_from_slice(&to);
                let there = value(by);
                if there.is_nan() {
                    return there;
                }
                if there > best {
                    best = there;
                } else {
                    by[at..at + from.len()].copy_from_slice(&from);
                }
            }
        }
        if best - before <= 1e-12 * best.abs() {
            part *= 0.5;
        }
    }
    best
}

/// The farthest deviation of an output to a side; none where some positions do not exist.
fn brute(linkage: &Linkage, output: usize, side: f64, random: &mut Random) -> Option<f64> {
    let value = |by: &[f64]| side * linkage.deviation(output, by);
    let mut corners: Vec<(f64, Vec<f64>)> = (0..CORNERS)
        .map(|_| {
            let by = corner(linkage, random);
            (value(&by), by)
        })
        .collect();
    if corners.iter().any(|(far, _)| far.is_nan()) {
        return None;
    }
    corners.sort_by(|a, b| b.0.total_cmp(&a.0));
    let climbed = corners.iter_mut().take(CLIMBS);
    let mut climbed = climbed.map(|(_, by)| climb(linkage, by, &value));
    climbed.try_fold(0.0, |best, far| (!far.is_nan()).then(|| far.max(best)))
}

#[test]
fn nothing_goes_farther_than_the_worst_found() {
    let mut random = Random(11);
    let mut wrong = Vec::new();
    let (mut tried, mut sides) = (0, 0);
    for number in 0.. {
        if tried == LINKAGES {
            break;
        }
        let size = LARGEST * random.next();
        let linkage = linkage(&mut random, size);
        let outputs: Vec<usize> = (0..linkage.outputs()).rev().take(3).collect();
        let far: Vec<[Option<f64>; 2]> = outputs
            .iter()
            .map(|&output| [-1.0, 1.0].map(|side| brute(&linkage, output, side, &mut random)))
            .collect();
        if far.iter().flatten().any(Option::is_none) {
            continue;
        }
        tried += 1;
        let told = Told::read(&linkage.model).unwrap_or_else(|said| panic!("{said}"));
        let answer = told.answer();
        for (&output, far) in outputs.iter().zip(far) {
            let of = &answer.outputs[output];
            let pose = &of.poses[0];
            for (side, far) in far.into_iter().flatten().enumerate() {
                sides += 1;
                let found = pose.found[side].map_or(0.0, f64::abs);
                let lacks = pose.lacks[side].expect("a residual");
                assert!(lacks <= STATIONARY * found, "{number} {}: {lacks:e}", of.of);
                if far > found * (1.0 + BEYOND) || far < found * (1.0 - SHORT) {
                    wrong.push(format!(
                        "{number} {} {side}: {far:e} is reached, {found:e} found, {:.1e}",
                        of.of,
                        far / found - 1.0
                    ));
                }
            }
        }
    }
    println!("{tried} linkages, {sides} sides");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
