//! Random deviations, solved for without the engine, never leave what is certified: the short version of `benches/accuracy.rs`.

use super::samples::{Case, DEGREE, Sampler, case};
use super::told::Random;

const CASES: &[Case] = &[
    case("four-bar", 60.0 * DEGREE, 5e-5, 0.0, true),
    case("four-bar", 60.0 * DEGREE, 5e-4, 1e-4, true),
    case("slider-crank", 90.0 * DEGREE, 5e-5, 0.0, true),
    case("slider-crank", 75.0 * DEGREE, 2e-4, 0.0, true),
    case("whitworth", 10.0 * DEGREE, 1e-4, 0.0, true),
    case("quick-return", 10.0 * DEGREE, 1e-4, 0.0, true),
    case("scotch-yoke", 50.0 * DEGREE, 1e-4, 0.0, true),
    case("geared-five-bar", 70.0 * DEGREE, 1e-4, 0.0, true),
    case("watt-i-lock", 0.0, 1e-5, 0.0, true),
    case("watt-i-lock", 60.0 * DEGREE, 1e-5, 1e-6, true),
    case("watt-i-lock", 105.0 * DEGREE, 1e-5, 0.0, true),
    case("watt-i-lock", 114.0 * DEGREE, 1e-5, 0.0, true),
    case("watt-i-lock", 117.0 * DEGREE, 1e-5, 0.0, false),
];

#[test]
fn random_deviations_stay_within_what_is_certified() {
    let mut random = Random(3);
    let mut beyond = Vec::new();
    for case in CASES {
        let mut sampler = Sampler::new(case);
        sampler.run(100, &mut random);
        let tried = sampler.tried;
        println!(
            "{} at {:.4}, c {:e}, t {:e}: {tried:?}",
            case.name, case.at, case.c, case.t
        );
        beyond.extend(tried.beyond);
        if case.is_certain {
            let [solved, all] = tried.solved;
            assert_eq!(solved, all, "{} at {}", case.name, case.at);
            let [bounded, all] = tried.bounded;
            assert_eq!(bounded, all, "{} at {}", case.name, case.at);
            // Some of them come near, or nothing was tried.
            assert!(
                tried.certified.0 > 0.2,
                "{}: {:?}",
                case.name,
                tried.certified
            );
            // Of several stationary positions one was found; they differ by the square of the deviations.
            let square = 1e-9;
            assert!(
                tried.found.0 <= 1.0 + square,
                "{}: {:?}",
                case.name,
                tried.found
            );
        }
    }
    assert!(beyond.is_empty(), "{}", beyond.join("\n"));
}
