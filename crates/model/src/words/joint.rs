//! Joints.

use super::clearance::{CLEARANCE, IMPACT_SENSE};
use super::friction::FRICTION;
use super::higher::{BELT, BUSHING, CAM, CONTACT, RACK};
use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Field, Measure, Named, Object, Shape, Tagged, default,
    optional, required,
};

/// At which of its ends a joint latches.
pub static LATCH: Choice = Choice {
    name: "Latch",
    about: "At which of its ends a joint latches.",
    words: &[
        ("lower", "Where the angle or the slide is least."),
        ("upper", "Where it is greatest."),
        ("both", "At either end."),
    ],
};

/// The way in which a joint turns alone.
pub static ONE_WAY: Choice = Choice {
    name: "OneWay",
    about: "The way in which a joint with a one-way clutch turns.",
    words: &[
        (
            "forward",
            "The angle of the second body in the first grows alone.",
        ),
        ("backward", "It becomes less alone."),
    ],
};

const FROM: Field = optional(
    "from",
    Shape::Event,
    "The event at which it closes, as in `door.angle >= 90 deg`; left out: it holds at the start.",
);
const UNTIL: Field = optional(
    "until",
    Shape::Event,
    "The event at which it opens; left out: no event does.",
);

/// When a joint, or the lock of a slide, holds.
pub static ACTIVE: Object = Object {
    name: "Active",
    about: "From when until when a joint, or the lock of a slide, holds.",
    fields: &[
        FROM,
        UNTIL,
        optional(
            "release",
            Shape::Quantity(Measure::Of(Dimension::Force), Bound::Above(0.0)),
            "Force \\[N\\] above which it opens; left out: it does not.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// When the lock of an angle holds.
pub static TURN_LOCK: Object = Object {
    name: "TurnLock",
    about: "From when until when the lock of an angle holds.",
    fields: &[
        FROM,
        UNTIL,
        optional(
            "release",
            Shape::Quantity(Measure::Of(Dimension::Torque), Bound::Above(0.0)),
            "Torque [N·m] above which it opens; left out: it does not.",
        ),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

const WHEN: Field = optional(
    "active",
    Shape::Object(&ACTIVE),
    "From when until when the joint holds; left out: always.",
);
const SLIDE_LOCK: Field = optional(
    "lock",
    Shape::Object(&ACTIVE),
    "From when until when it does not slide: it is held where it is then. Left out: it is free.",
);

static TURN: Shape = Shape::End(Measure::Of(Dimension::Angle));
static SLIDE: Shape = Shape::End(Measure::Of(Dimension::Length));

/// Stops of joints that slide, or of all.
const SLIDE_LIMITS: Field = optional(
    "limits",
    Shape::Pair(&SLIDE),
    "Where its way ends: least and greatest slide along the axis \\[m\\]; `null` where it does not.",
);
const RESTITUTION: Field = optional(
    "restitution",
    Shape::Number(Bound::Between(0.0, 1.0)),
    "Of rigid stops at its limits, 0 where left out [–].",
);
/// Of stops, at which nothing slides, and of contacts.
pub(super) const SENSE: Field = optional(
    "sense",
    Shape::Choice(&IMPACT_SENSE),
    "What the coefficient of restitution compares, default `kinematic`; with friction `energetic` alone never gains energy.",
);
const SLIDE_STIFFNESS: Field = optional(
    "stiffness",
    Shape::Quantity(Measure::Of(Dimension::Stiffness), Bound::Above(0.0)),
    "Of stops that yield [N/m]; left out: they are rigid.",
);
const SLIDE_DAMPING: Field = optional(
    "damping",
    Shape::Quantity(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
    "Of stops that yield [N·s/m].",
);
const LATCHED: Field = optional(
    "latch",
    Shape::Choice(&LATCH),
    "The end at which the joint latches: it stays there, whatever pulls.",
);
const SLIDE_RELEASE: Field = optional(
    "release",
    Shape::Quantity(Measure::Of(Dimension::Force), Bound::Above(0.0)),
    "Pull \\[N\\] above which the latch opens; left out: it does not.",
);

/// A joint from the first point to the second.
pub static JOINT: Tagged = Tagged {
    name: "Joint",
    about: "A joint from the first point to the second.",
    variants: &[
        Object {
            name: "revolute",
            about: "The points coincide; with `clearance` the first body holds the bearing, the second the journal.",
            fields: &[
                optional("clearance", Shape::Object(&CLEARANCE), ""),
                optional(
                    "friction",
                    Shape::Object(&FRICTION),
                    "Friction of the ideal joint, from its own reaction; that of a clearance stands in the clearance. Left out: none.",
                ),
                optional(
                    "pin_radius",
                    Shape::Quantity(Measure::Of(Dimension::Length), Bound::Above(0.0)),
                    "Radius of the pin \\[m\\] on which `friction` acts, and which it needs.",
                ),
                optional(
                    "limits",
                    Shape::Pair(&TURN),
                    "Where its way ends: least and greatest angle of the second body in the first \\[rad\\]; `null` where it does not.",
                ),
                RESTITUTION,
                SENSE,
                optional(
                    "stiffness",
                    Shape::Quantity(Measure::Of(Dimension::AngularStiffness), Bound::Above(0.0)),
                    "Of stops that yield [N·m/rad]; left out: they are rigid.",
                ),
                optional(
                    "damping",
                    Shape::Quantity(Measure::Of(Dimension::AngularDamping), Bound::AtLeast(0.0)),
                    "Of stops that yield [N·m·s/rad].",
                ),
                LATCHED,
                optional(
                    "release",
                    Shape::Quantity(Measure::Of(Dimension::Torque), Bound::Above(0.0)),
                    "Pull [N·m] above which the latch opens; left out: it does not.",
                ),
                WHEN,
                optional(
                    "lock",
                    Shape::Object(&TURN_LOCK),
                    "From when until when it does not turn: it is held where it is then. Left out: it is free.",
                ),
                optional(
                    "one_way",
                    Shape::Choice(&ONE_WAY),
                    "The way in which it turns alone, by a one-way clutch; left out: both.",
                ),
                required(
                    "between",
                    Shape::Pair(&Shape::Point),
                    "Two points `body.point`, first → second.",
                ),
            ],
            refused: &[],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "prismatic",
            about: "The second point stays on the line through the first along `axis` (first body's frame, any length but zero); relative angle fixed \\[rad\\].",
            fields: &[
                required(
                    "axis",
                    Shape::Direction,
                    "A direction fixed in the first body; its length does not matter.",
                ),
                default(
                    "angle",
                    Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any),
                    Default::Zero,
                    "Angle of the second body relative to the first \\[rad\\].",
                ),
                optional(
                    "friction",
                    Shape::Object(&FRICTION),
                    "Friction along the axis, from the joint's own reaction; left out: none.",
                ),
                optional(
                    "guide_length",
                    Shape::Quantity(Measure::Of(Dimension::Length), Bound::Above(0.0)),
                    "Length of the slider on its guide \\[m\\], centred at the second point: with it the joint's torque presses, too.",
                ),
                optional(
                    "play",
                    Shape::Range(Measure::Of(Dimension::Length), Bound::AtLeast(0.0)),
                    "How far the guided point may be off its line to either side \\[m\\], or `[least, most]` of it; for accuracy.",
                ),
                SLIDE_LIMITS,
                RESTITUTION,
                SENSE,
                SLIDE_STIFFNESS,
                SLIDE_DAMPING,
                LATCHED,
                SLIDE_RELEASE,
                WHEN,
                SLIDE_LOCK,
                required(
                    "between",
                    Shape::Pair(&Shape::Point),
                    "Two points `body.point`, first → second.",
                ),
            ],
            refused: &[("clearance", "only a revolute joint can have clearance")],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "slot",
            about: "The second point stays on the line through the first along `axis` (first body's frame, any length but zero); the bodies may turn against each other.",
            fields: &[
                required(
                    "axis",
                    Shape::Direction,
                    "A direction fixed in the first body; its length does not matter.",
                ),
                optional(
                    "play",
                    Shape::Range(Measure::Of(Dimension::Length), Bound::AtLeast(0.0)),
                    "How far the guided point may be off its line to either side \\[m\\], or `[least, most]` of it; for accuracy.",
                ),
                SLIDE_LIMITS,
                RESTITUTION,
                SENSE,
                SLIDE_STIFFNESS,
                SLIDE_DAMPING,
                LATCHED,
                SLIDE_RELEASE,
                WHEN,
                SLIDE_LOCK,
                required(
                    "between",
                    Shape::Pair(&Shape::Point),
                    "Two points `body.point`, first → second.",
                ),
            ],
            refused: &[
                ("clearance", "only a revolute joint can have clearance"),
                (
                    "friction",
                    "only revolute and prismatic joints can have friction",
                ),
                (
                    "angle",
                    "the angle in a slot is free; a prismatic joint fixes it",
                ),
            ],
            drives: Drives::Nothing,
            either: None,
        },
        Object {
            name: "gear",
            about: "Two wheels, each held at its point by a revolute joint to a common carrier, mesh: θ₂ − θ_c = ratio·(θ₁ − θ_c) + angle.",
            fields: &[
                required(
                    "ratio",
                    Shape::Number(Bound::NotZero),
                    "Turns of the second wheel per turn of the first, seen from the carrier: −z₁/z₂ for an external mesh, z₁/z₂ for an internal one.",
                ),
                optional(
                    "carrier",
                    Shape::Name(Named::Body),
                    "The body on which both wheels turn; left out: found from the joints.",
                ),
                optional(
                    "angle",
                    Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any),
                    "θ₂ − θ_c − ratio·(θ₁ − θ_c) \\[rad\\]; left out: as drawn, that of the angles in `pose`.",
                ),
                optional(
                    "backlash",
                    Shape::Quantity(Measure::Of(Dimension::Length), Bound::AtLeast(0.0)),
                    "Length of arc at the pitch circle \\[m\\] by which a wheel may turn while the other is held, from flank to flank (ISO 21771); for accuracy.",
                ),
                required(
                    "between",
                    Shape::Pair(&Shape::Point),
                    "Two points `body.point`, first → second.",
                ),
            ],
            refused: &[
                (
                    "limits",
                    "a gear turns without end: give limits to the revolute joints of its wheels",
                ),
                ("clearance", "only a revolute joint can have clearance"),
                (
                    "friction",
                    "only revolute and prismatic joints can have friction",
                ),
            ],
            drives: Drives::Nothing,
            either: None,
        },
        RACK,
        BELT,
        CAM,
        CONTACT,
        BUSHING,
        Object {
            name: "fixed",
            about: "The points coincide, relative angle fixed \\[rad\\].",
            fields: &[
                default(
                    "angle",
                    Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any),
                    Default::Zero,
                    "Angle of the second body relative to the first \\[rad\\].",
                ),
                WHEN,
                required(
                    "between",
                    Shape::Pair(&Shape::Point),
                    "Two points `body.point`, first → second.",
                ),
            ],
            refused: &[
                ("limits", "nothing moves in a fixed joint"),
                ("clearance", "only a revolute joint can have clearance"),
                (
                    "friction",
                    "only revolute and prismatic joints can have friction",
                ),
            ],
            drives: Drives::Nothing,
            either: None,
        },
    ],
};
