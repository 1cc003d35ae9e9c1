//! The list of cases.

use super::reference::ReferenceCase;
use super::{
    Case, CaseKind, beams, elastic_clearance, elastic_links, flores_slider_crank, four_bar_spring,
    journal_billiard, lock, lock_elastic, path_synthesis, restitution, slider_crank_clearance,
    tolerance_ladder,
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
        name: "path-synthesis",
        kind: CaseKind::Coded {
            about: path_synthesis::ABOUT,
            run: path_synthesis::run,
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
    Case {
        name: "beams",
        kind: CaseKind::Coded {
            about: beams::ABOUT,
            run: beams::run,
        },
    },
    Case {
        name: "elastic-links",
        kind: CaseKind::Coded {
            about: elastic_links::ABOUT,
            run: elastic_links::run,
        },
    },
    Case {
        name: "elastic-clearance",
        kind: CaseKind::Coded {
            about: elastic_clearance::ABOUT,
            run: elastic_clearance::run,
        },
    },
    Case {
        name: "lock-elastic",
        kind: CaseKind::Coded {
            about: lock_elastic::ABOUT,
            run: lock_elastic::run,
        },
    },
    reference(
        "lock-ideal",
        include_str!("../lock-ideal/case.json"),
        include_str!("../lock-ideal/reference.csv"),
    ),
    reference(
        "lock-near-change-point",
        include_str!("../lock-near-change-point/case.json"),
        include_str!("../lock-near-change-point/reference.csv"),
    ),
    reference(
        "four-bar",
        include_str!("../four-bar/case.json"),
        include_str!("../four-bar/reference.csv"),
    ),
    reference(
        "rubbing-four-bar",
        include_str!("../rubbing-four-bar/case.json"),
        include_str!("../rubbing-four-bar/reference.csv"),
    ),
    reference(
        "stephenson-iii",
        include_str!("../stephenson-iii/case.json"),
        include_str!("../stephenson-iii/reference.csv"),
    ),
    reference(
        "assur-class-iii",
        include_str!("../assur-class-iii/case.json"),
        include_str!("../assur-class-iii/reference.csv"),
    ),
    reference(
        "inclined-slider-crank",
        include_str!("../inclined-slider-crank/case.json"),
        include_str!("../inclined-slider-crank/reference.csv"),
    ),
    reference(
        "inverted-slider-crank",
        include_str!("../inverted-slider-crank/case.json"),
        include_str!("../inverted-slider-crank/reference.csv"),
    ),
    reference(
        "translation-driver",
        include_str!("../translation-driver/case.json"),
        include_str!("../translation-driver/reference.csv"),
    ),
    reference(
        "floating-driver",
        include_str!("../floating-driver/case.json"),
        include_str!("../floating-driver/reference.csv"),
    ),
    reference(
        "parallel-crank",
        include_str!("../parallel-crank/case.json"),
        include_str!("../parallel-crank/reference.csv"),
    ),
    reference(
        "doubled-joint",
        include_str!("../doubled-joint/case.json"),
        include_str!("../doubled-joint/reference.csv"),
    ),
    reference(
        "slotted-lever",
        include_str!("../slotted-lever/case.json"),
        include_str!("../slotted-lever/reference.csv"),
    ),
    reference(
        "driven-slot",
        include_str!("../driven-slot/case.json"),
        include_str!("../driven-slot/reference.csv"),
    ),
    reference(
        "geared-five-bar",
        include_str!("../geared-five-bar/case.json"),
        include_str!("../geared-five-bar/reference.csv"),
    ),
    reference(
        "planetary-crank",
        include_str!("../planetary-crank/case.json"),
        include_str!("../planetary-crank/reference.csv"),
    ),
    reference(
        "a01-pendulum",
        include_str!("../a01-pendulum/case.json"),
        include_str!("../a01-pendulum/reference.csv"),
    ),
    reference(
        "a01-pendulum-exact",
        include_str!("../a01-pendulum-exact/case.json"),
        include_str!("../a01-pendulum-exact/reference.csv"),
    ),
    reference(
        "a02-four-bars-2",
        include_str!("../a02-four-bars-2/case.json"),
        include_str!("../a02-four-bars-2/reference.csv"),
    ),
    reference(
        "a02-four-bars-40",
        include_str!("../a02-four-bars-40/case.json"),
        include_str!("../a02-four-bars-40/reference.csv"),
    ),
    reference(
        "andrews",
        include_str!("../andrews/case.json"),
        include_str!("../andrews/reference.csv"),
    ),
    reference(
        "cart-pole",
        include_str!("../cart-pole/case.json"),
        include_str!("../cart-pole/reference.csv"),
    ),
    reference(
        "car-axis",
        include_str!("../car-axis/case.json"),
        include_str!("../car-axis/reference.csv"),
    ),
    reference(
        "slider-crank-torque",
        include_str!("../slider-crank-torque/case.json"),
        include_str!("../slider-crank-torque/reference.csv"),
    ),
    reference(
        "double-pendulum-springs",
        include_str!("../double-pendulum-springs/case.json"),
        include_str!("../double-pendulum-springs/reference.csv"),
    ),
    reference(
        "assur-class-iii-free",
        include_str!("../assur-class-iii-free/case.json"),
        include_str!("../assur-class-iii-free/reference.csv"),
    ),
    reference(
        "free-six-bar",
        include_str!("../free-six-bar/case.json"),
        include_str!("../free-six-bar/reference.csv"),
    ),
    reference(
        "random-1",
        include_str!("../random-1/case.json"),
        include_str!("../random-1/reference.csv"),
    ),
    reference(
        "random-2",
        include_str!("../random-2/case.json"),
        include_str!("../random-2/reference.csv"),
    ),
    reference(
        "random-3",
        include_str!("../random-3/case.json"),
        include_str!("../random-3/reference.csv"),
    ),
    reference(
        "random-4",
        include_str!("../random-4/case.json"),
        include_str!("../random-4/reference.csv"),
    ),
    reference(
        "random-5",
        include_str!("../random-5/case.json"),
        include_str!("../random-5/reference.csv"),
    ),
    reference(
        "random-6",
        include_str!("../random-6/case.json"),
        include_str!("../random-6/reference.csv"),
    ),
];

/// The case of a folder: its name, `case.json` and `reference.csv`.
const fn reference(name: &'static str, case: &'static str, reference: &'static str) -> Case {
    Case {
        name,
        kind: CaseKind::Reference(ReferenceCase { case, reference }),
    }
}
