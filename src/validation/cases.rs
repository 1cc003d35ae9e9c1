//! The list of cases.

use super::reference::ReferenceCase;
use super::{
    Case, CaseKind, flores_slider_crank, four_bar_spring, journal_billiard, lock, restitution,
    slider_crank_clearance, tolerance_ladder,
};

/// All bundled cases, in the order in which they are run; a test holds this against the folder `validation/`.
pub const CASES: &[Case] = &[
    Case {
        name: "lock",
        kind: CaseKind::Coded {
            about: lock::ABOUT,
            run: lock::run,
        },
    },
    Case {
        name: "lock-contact",
        kind: CaseKind::Coded {
            about: lock::contact::ABOUT,
            run: lock::contact::run,
        },
    },
    Case {
        name: "four-bar-spring",
        kind: CaseKind::Coded {
            about: four_bar_spring::ABOUT,
            run: four_bar_spring::run,
        },
    },
    Case {
        name: "restitution",
        kind: CaseKind::Coded {
            about: restitution::ABOUT,
            run: restitution::run,
        },
    },
    Case {
        name: "tolerance-ladder",
        kind: CaseKind::Coded {
            about: tolerance_ladder::ABOUT,
            run: tolerance_ladder::run,
        },
    },
    Case {
        name: "slider-crank-clearance",
        kind: CaseKind::Coded {
            about: slider_crank_clearance::ABOUT,
            run: slider_crank_clearance::run,
        },
    },
    Case {
        name: "flores-slider-crank",
        kind: CaseKind::Coded {
            about: flores_slider_crank::ABOUT,
            run: flores_slider_crank::run,
        },
    },
    Case {
        name: "journal-billiard",
        kind: CaseKind::Coded {
            about: journal_billiard::ABOUT,
            run: journal_billiard::run,
        },
    },
    reference(
        "lock-ideal",
        include_str!("../../validation/lock-ideal/case.json"),
        include_str!("../../validation/lock-ideal/reference.csv"),
    ),
    reference(
        "lock-near-change-point",
        include_str!("../../validation/lock-near-change-point/case.json"),
        include_str!("../../validation/lock-near-change-point/reference.csv"),
    ),
    reference(
        "four-bar",
        include_str!("../../validation/four-bar/case.json"),
        include_str!("../../validation/four-bar/reference.csv"),
    ),
    reference(
        "rubbing-four-bar",
        include_str!("../../validation/rubbing-four-bar/case.json"),
        include_str!("../../validation/rubbing-four-bar/reference.csv"),
    ),
    reference(
        "stephenson-iii",
        include_str!("../../validation/stephenson-iii/case.json"),
        include_str!("../../validation/stephenson-iii/reference.csv"),
    ),
    reference(
        "assur-class-iii",
        include_str!("../../validation/assur-class-iii/case.json"),
        include_str!("../../validation/assur-class-iii/reference.csv"),
    ),
    reference(
        "inclined-slider-crank",
        include_str!("../../validation/inclined-slider-crank/case.json"),
        include_str!("../../validation/inclined-slider-crank/reference.csv"),
    ),
    reference(
        "inverted-slider-crank",
        include_str!("../../validation/inverted-slider-crank/case.json"),
        include_str!("../../validation/inverted-slider-crank/reference.csv"),
    ),
    reference(
        "translation-driver",
        include_str!("../../validation/translation-driver/case.json"),
        include_str!("../../validation/translation-driver/reference.csv"),
    ),
    reference(
        "floating-driver",
        include_str!("../../validation/floating-driver/case.json"),
        include_str!("../../validation/floating-driver/reference.csv"),
    ),
    reference(
        "parallel-crank",
        include_str!("../../validation/parallel-crank/case.json"),
        include_str!("../../validation/parallel-crank/reference.csv"),
    ),
    reference(
        "doubled-joint",
        include_str!("../../validation/doubled-joint/case.json"),
        include_str!("../../validation/doubled-joint/reference.csv"),
    ),
    reference(
        "slotted-lever",
        include_str!("../../validation/slotted-lever/case.json"),
        include_str!("../../validation/slotted-lever/reference.csv"),
    ),
    reference(
        "driven-slot",
        include_str!("../../validation/driven-slot/case.json"),
        include_str!("../../validation/driven-slot/reference.csv"),
    ),
    reference(
        "geared-five-bar",
        include_str!("../../validation/geared-five-bar/case.json"),
        include_str!("../../validation/geared-five-bar/reference.csv"),
    ),
    reference(
        "planetary-crank",
        include_str!("../../validation/planetary-crank/case.json"),
        include_str!("../../validation/planetary-crank/reference.csv"),
    ),
    reference(
        "a01-pendulum",
        include_str!("../../validation/a01-pendulum/case.json"),
        include_str!("../../validation/a01-pendulum/reference.csv"),
    ),
    reference(
        "a01-pendulum-exact",
        include_str!("../../validation/a01-pendulum-exact/case.json"),
        include_str!("../../validation/a01-pendulum-exact/reference.csv"),
    ),
    reference(
        "a02-four-bars-2",
        include_str!("../../validation/a02-four-bars-2/case.json"),
        include_str!("../../validation/a02-four-bars-2/reference.csv"),
    ),
    reference(
        "a02-four-bars-40",
        include_str!("../../validation/a02-four-bars-40/case.json"),
        include_str!("../../validation/a02-four-bars-40/reference.csv"),
    ),
    reference(
        "andrews",
        include_str!("../../validation/andrews/case.json"),
        include_str!("../../validation/andrews/reference.csv"),
    ),
    reference(
        "cart-pole",
        include_str!("../../validation/cart-pole/case.json"),
        include_str!("../../validation/cart-pole/reference.csv"),
    ),
    reference(
        "car-axis",
        include_str!("../../validation/car-axis/case.json"),
        include_str!("../../validation/car-axis/reference.csv"),
    ),
    reference(
        "slider-crank-torque",
        include_str!("../../validation/slider-crank-torque/case.json"),
        include_str!("../../validation/slider-crank-torque/reference.csv"),
    ),
    reference(
        "double-pendulum-springs",
        include_str!("../../validation/double-pendulum-springs/case.json"),
        include_str!("../../validation/double-pendulum-springs/reference.csv"),
    ),
    reference(
        "assur-class-iii-free",
        include_str!("../../validation/assur-class-iii-free/case.json"),
        include_str!("../../validation/assur-class-iii-free/reference.csv"),
    ),
    reference(
        "free-six-bar",
        include_str!("../../validation/free-six-bar/case.json"),
        include_str!("../../validation/free-six-bar/reference.csv"),
    ),
    reference(
        "random-1",
        include_str!("../../validation/random-1/case.json"),
        include_str!("../../validation/random-1/reference.csv"),
    ),
    reference(
        "random-2",
        include_str!("../../validation/random-2/case.json"),
        include_str!("../../validation/random-2/reference.csv"),
    ),
    reference(
        "random-3",
        include_str!("../../validation/random-3/case.json"),
        include_str!("../../validation/random-3/reference.csv"),
    ),
    reference(
        "random-4",
        include_str!("../../validation/random-4/case.json"),
        include_str!("../../validation/random-4/reference.csv"),
    ),
    reference(
        "random-5",
        include_str!("../../validation/random-5/case.json"),
        include_str!("../../validation/random-5/reference.csv"),
    ),
    reference(
        "random-6",
        include_str!("../../validation/random-6/case.json"),
        include_str!("../../validation/random-6/reference.csv"),
    ),
];

/// The case of a folder: its name, `case.json` and `reference.csv`.
const fn reference(name: &'static str, case: &'static str, reference: &'static str) -> Case {
    Case {
        name,
        kind: CaseKind::Reference(ReferenceCase { case, reference }),
    }
}
