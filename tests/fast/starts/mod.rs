//! Starts away from the drawing: the assembly must be the one that is reached by moving there, against closed forms of each
//! linkage whose side is kept on the way (`linkage`), or the choice is said.
//!
//! `LINKDYN_STARTS=10000 cargo test --release --test fast starts::` tries more.

mod cases;
mod drawn;
mod linkage;
mod rest;

use crate::linkage::Random;
use crate::mechanisms::{column, outcome};
use linkage::{Kind, Linkage, Verdict};
use linkdyn_output::Status;
use serde_json::json;
use std::f64::consts::PI;

const KINDS: [Kind; 8] = [
    Kind::FourBar,
    Kind::Parallelogram,
    Kind::Kite,
    Kind::SliderCrank,
    Kind::EqualSliderCrank,
    Kind::QuickReturn,
    Kind::Watt,
    Kind::Stephenson,
];

/// How a start is told.
#[derive(Debug, Clone, Copy)]
enum By {
    Driver,
    Initial,
}

/// What came of a start, by numbers.
#[derive(Debug, Default, PartialEq)]
struct Count {
    same: usize,
    told: usize,
    refused: usize,
    flipped: usize,
    alarmed: usize,
}

/// One start; whether it is as it must be.
fn tries(random: &mut Random, kind: Kind, count: &mut Count) {
    let linkage = Linkage::random(random, kind);
    let drawn = PI * random.signed();
    let start = drawn + 2.5 * PI * random.signed();
    if linkage.places(drawn).is_none() {
        return;
    }
    let by = [By::Driver, By::Initial][random.below(2)];
    // Places with all digits, or as somebody types them.
    let digits = [1e15, 1e4, 1e3][random.below(3)];
    let mut model = linkage.model(drawn, digits);
    match by {
        By::Driver => {
            model["drivers"] = json!({ "motor": { "type": "rotation", "body": "crank",
                "motion": { "type": "constant_velocity", "start": start, "velocity": 1.0 } } });
        }
        By::Initial => model["initial"] = json!({ "crank": { "angle": start } }),
    }
    let verdict = linkage.on_the_way(drawn, start);
    let run = outcome(&model);
    let said = run.report.warnings.iter().any(|w| w.contains("drawing"));
    if run.report.status != Status::Completed {
        assert!(
            matches!(verdict, Verdict::Ends | Verdict::Near),
            "{kind:?} {by:?} from {drawn} to {start}: {:?}\n{model}",
            run.report.message
        );
        count.refused += 1;
        return;
    }
    let wanted = linkage.places(start);
    let off = wanted.map_or(f64::INFINITY, |places| {
        linkage.off(&places, |name| column(&run, name)[0])
    });
    let is_same = off < 1e-6;
    let fails = match verdict {
        Verdict::Regular => said || !is_same,
        Verdict::Near => !said && !is_same,
        Verdict::Passes | Verdict::Ends => !said,
    };
    match (verdict, said, is_same) {
        (Verdict::Regular, true, _) => count.alarmed += 1,
        (_, true, _) => count.told += 1,
        (_, false, true) if !fails => count.same += 1,
        (_, false, _) => count.flipped += 1,
    }
    if fails {
        println!(
            "{kind:?} {by:?} from {drawn} to {start}, {verdict:?}, off by {off:e}: {:?}\n{model}",
            run.report.warnings
        );
    }
}

#[test]
fn random_linkages_start_in_the_assembly_that_the_drawing_moves_to() {
    let count = std::env::var("LINKDYN_STARTS").ok();
    let count: usize = count.map_or(300, |count| count.parse().expect("a number"));
    let mut random = Random(42);
    let mut found = Count::default();
    for k in 0..count {
        tries(&mut random, KINDS[k % KINDS.len()], &mut found);
    }
    println!("{found:?}");
    assert_eq!((found.flipped, found.alarmed), (0, 0), "{found:?}");
    assert!(
        found.same > count / 4 && found.told > count / 20,
        "{found:?}"
    );
}
