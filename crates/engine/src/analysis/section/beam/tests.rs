use super::*;

const LENGTH: f64 = 0.7;

/// Loads and distributed loads that a part [0, x] carries, summed up in small pieces.
fn by_pieces(loads: &[Concentrated], spread: [[f64; 2]; 2], x: f64) -> CutForces {
    let mut cut = [0.0; 3];
    let mut add = |at: f64, along: f64, across: f64, moment: f64| {
        cut[0] -= along;
        cut[1] -= across;
        cut[2] -= moment - (x - at) * across;
    };
    for load in loads.iter().filter(|load| load.x < x) {
        add(load.x, load.along, load.across, load.moment);
    }
    // Gauss, two points: exact for the products, which are of second order
    let half = x / 2.0;
    for sign in [-1.0, 1.0] {
        let at = half + sign * half / f64::sqrt(3.0);
        let [p, q] = spread.map(|[constant, slope]| constant + slope * at);
        add(at, half * p, half * q, 0.0);
    }
    cut
}

fn beam(seed: u64) -> (Vec<Concentrated>, [[f64; 2]; 2]) {
    let mut state = seed;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as f64 / (1u64 << 30) as f64 - 1.0
    };
    let load = |x: f64, random: &mut dyn FnMut() -> f64| Concentrated {
        x,
        along: 100.0 * random(),
        across: 100.0 * random(),
        moment: 10.0 * random(),
    };
    let mut loads = vec![load(0.0, &mut random), load(LENGTH, &mut random)];
    for _ in 0..3 {
        let x = LENGTH * random().abs();
        loads.push(load(x, &mut random));
    }
    let spread = [0; 2].map(|_| [500.0 * random(), 3000.0 * random()]);
    (loads, spread)
}

#[test]
fn cuts_are_the_sums_of_what_acts_on_one_side() {
    for seed in 0..20 {
        let (loads, spread) = beam(seed);
        let beam = StraightLink::new(LENGTH, loads.clone(), spread);
        for k in 1..=50 {
            let x = LENGTH * k as f64 / 50.0;
            let (ours, known) = (beam.at(x), by_pieces(&loads, spread, x));
            let off = (0..3).map(|k| (ours[k] - known[k]).abs());
            assert!(off.fold(0.0, f64::max) < 1e-11, "{x}: {ours:?} {known:?}");
        }
    }
}

/// Peaks are no less than any of many cuts, and no more than the largest of them by what lies between.
#[test]
fn peaks_are_those_of_many_cuts() {
    let (area, modulus) = (1e-4, 1e-7);
    for seed in 0..20 {
        let (loads, spread) = beam(seed);
        let beam = StraightLink::new(LENGTH, loads, spread);
        let peaks = beam.peaks(area, modulus);
        let mut most = Peaks::default();
        let count = 20_000;
        for segment in &beam.segments {
            for k in 0..=count {
                let u = (segment.end - segment.start) * k as f64 / count as f64;
                let [axial, shear, moment] = beam.cut(segment, u);
                most.tension = most.tension.max(axial);
                most.compression = most.compression.max(-axial);
                most.shear = most.shear.max(shear.abs());
                most.moment = most.moment.max(moment.abs());
                let stress = axial.abs() / area + moment.abs() / modulus;
                if stress > most.stress {
                    (most.stress, most.at) = (stress, segment.start + u);
                }
            }
        }
        for (ours, sampled) in [
            (peaks.tension, most.tension),
            (peaks.compression, most.compression),
            (peaks.shear, most.shear),
            (peaks.moment, most.moment),
            (peaks.stress, most.stress),
        ] {
            // flat there: off by at most the square of half a step
            let off = (ours - sampled) / ours.max(1e-3);
            assert!((-1e-12..1e-7).contains(&off), "{ours} {sampled}");
        }
        assert!(
            (peaks.at - most.at).abs() < 1e-3 * LENGTH,
            "{peaks:?} {most:?}"
        );
    }
}
