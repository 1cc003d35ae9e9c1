//! Joints that roll, press and touch: racks, belts, cams, contacts.

use super::cam::{FOLLOWER, PROFILE};
use super::friction::FRICTION;
use super::joint::SENSE;
use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Measure, Named, Object, Shape, default, optional, required,
    silent,
};

/// How the strands of a belt run.
pub static STRANDS: Choice = Choice {
    name: "Strands",
    about: "How the strands of a belt run.",
    words: &[
        ("open", "Beside each other: both pulleys turn the same way."),
        ("crossed", "Across: the pulleys turn against each other."),
    ],
};

static RADIUS: Shape = Shape::Quantity(Measure::Of(Dimension::Length), Bound::Above(0.0));
static OUTLINE_POINT: Shape = Shape::List(
    &Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any),
    2,
);

/// A wheel on a rack.
pub const RACK: Object = Object {
    name: "rack",
    about: "A wheel, the first body, rolls about its point on a line through the point of the second body, the rack.",
    fields: &[
        required(
            "axis",
            Shape::Direction,
            "Direction of the line, fixed in the second body; its length does not matter.",
        ),
        required(
            "radius",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::NotZero),
            "Radius of the wheel's pitch circle \\[m\\]; negative where the line lies to the left of the centre, looking along the axis.",
        ),
        optional(
            "offset",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any),
            "Place of the centre along the axis from the rack's point, and radius·(θ₁ − θ₂) \\[m\\]; left out: as drawn, that of the poses.",
        ),
        required(
            "between",
            Shape::Pair(&Shape::Point),
            "Centre of the wheel and a point of the rack's pitch line, `body.point`.",
        ),
    ],
    refused: &[
        (
            "limits",
            "the teeth have no end: give limits to the joint that guides the rack",
        ),
        ("clearance", "only a revolute joint can have clearance"),
        (
            "friction",
            "only revolute and prismatic joints can have friction",
        ),
        ("backlash", "a rack has none: its teeth touch on both sides"),
    ],
    drives: Drives::Nothing,
    either: None,
};

/// A belt around two pulleys.
pub const BELT: Object = Object {
    name: "belt",
    about: "Two pulleys with a belt around them, each held at its point by other joints.",
    fields: &[
        required(
            "radii",
            Shape::Pair(&RADIUS),
            "Radii of the first and the second pulley, to the middle of the belt \\[m\\].",
        ),
        silent(
            "strands",
            Shape::Choice(&STRANDS),
            Default::Text("open"),
            "How the strands run.",
        ),
        optional(
            "pretension",
            Shape::Quantity(Measure::Of(Dimension::Force), Bound::AtLeast(0.0)),
            "Tension of each strand while nothing is driven \\[N\\]; it loads the bearings. Left out: 0, and no strand is said to be slack.",
        ),
        optional(
            "stiffness",
            Shape::Quantity(Measure::Of(Dimension::Stiffness), Bound::Above(0.0)),
            "Of each strand, its tension by the length it is stretched by [N/m]; left out: the belt does not stretch.",
        ),
        optional(
            "damping",
            Shape::Quantity(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
            "Of each strand that stretches [N·s/m].",
        ),
        optional(
            "carrier",
            Shape::Name(Named::Body),
            "The body in which the line of centres turns by less than half a turn; left out: the one that holds both pulleys, found from the joints.",
        ),
        required(
            "between",
            Shape::Pair(&Shape::Point),
            "Centres of the two pulleys, `body.point`.",
        ),
    ],
    refused: &[
        (
            "limits",
            "a belt turns without end: give limits to the revolute joints of its pulleys",
        ),
        ("ratio", "it follows from the radii"),
        ("clearance", "only a revolute joint can have clearance"),
        (
            "friction",
            "only revolute and prismatic joints can have friction",
        ),
    ],
    drives: Drives::Nothing,
    either: None,
};

/// A pin that yields.
pub const BUSHING: Object = Object {
    name: "bushing",
    about: "The points stay near each other: a pin in rubber, which yields in all directions and is no constraint.",
    fields: &[
        required(
            "radial_stiffness",
            Shape::PerAxis(Measure::Of(Dimension::Stiffness), Bound::Above(0.0)),
            "Force by how far the second point is from the first [N/m]; one number, or `[along x, along y]` of the first body's frame.",
        ),
        default(
            "radial_damping",
            Shape::PerAxis(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
            Default::Zero,
            "The same by the rate of that [N·s/m].",
        ),
        default(
            "torsional_stiffness",
            Shape::Quantity(
                Measure::Of(Dimension::AngularStiffness),
                Bound::AtLeast(0.0),
            ),
            Default::Zero,
            "Torque by the angle of the second body in the first, from `free_angle` [N·m/rad].",
        ),
        default(
            "torsional_damping",
            Shape::Quantity(Measure::Of(Dimension::AngularDamping), Bound::AtLeast(0.0)),
            Default::Zero,
            "The same by the rate of that [N·m·s/rad].",
        ),
        default(
            "free_angle",
            Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any),
            Default::Zero,
            "Angle of the second body in the first at which there is no torque \\[rad\\].",
        ),
        required(
            "between",
            Shape::Pair(&Shape::Point),
            "Two points `body.point`, first → second.",
        ),
    ],
    refused: &[
        (
            "stiffness",
            "a bushing has two: \"radial_stiffness\" and \"torsional_stiffness\"",
        ),
        (
            "damping",
            "a bushing has two: \"radial_damping\" and \"torsional_damping\"",
        ),
        (
            "limits",
            "a bushing yields without end; a \"revolute\" joint has limits",
        ),
        ("clearance", "only a revolute joint can have clearance"),
        (
            "friction",
            "only revolute and prismatic joints can have friction",
        ),
    ],
    drives: Drives::Nothing,
    either: None,
};

/// A cam and its follower.
pub const CAM: Object = Object {
    name: "cam",
    about: "The profile of the first body, about its point, moves the follower of the second and holds it from both sides.",
    fields: &[
        required(
            "follower",
            Shape::Choice(&FOLLOWER),
            "What touches the profile.",
        ),
        optional(
            "face",
            Shape::Direction,
            "Direction of a flat face through the second point, in the follower's frame; the cam lies to its right.",
        ),
        optional(
            "roller_radius",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::Above(0.0)),
            "Radius of a roller about the second point \\[m\\].",
        ),
        required(
            "profile",
            Shape::Tagged(&PROFILE),
            "The shape of the cam, or the motion that it gives.",
        ),
        required(
            "between",
            Shape::Pair(&Shape::Point),
            "Two points `body.point`: of the cam, about which its profile lies, and of the follower.",
        ),
    ],
    refused: &[
        (
            "limits",
            "a cam turns without end: give limits to the joints that hold cam and follower",
        ),
        ("clearance", "only a revolute joint can have clearance"),
        (
            "friction",
            "only revolute and prismatic joints can have friction",
        ),
    ],
    drives: Drives::Nothing,
    either: None,
};

/// A tip that may touch an outline.
pub const CONTACT: Object = Object {
    name: "contact",
    about: "A round tip about the second point may touch an outline of the first body: one-sided.",
    fields: &[
        required(
            "outline",
            Shape::List(&OUTLINE_POINT, 2),
            "Points `[x, y]` in the first body's frame \\[m\\], or `[x, y, r]` where an arc of radius r leads to them, which turns left where r > 0; the material is on the left of the way along it. It is closed where it ends where it began.",
        ),
        optional(
            "repeat",
            Shape::Count(1, 360),
            "How often the outline is repeated around the first point, evenly in a turn; a copy that ends where the next begins goes on there.",
        ),
        default(
            "radius",
            Shape::Quantity(Measure::Of(Dimension::Length), Bound::AtLeast(0.0)),
            Default::Zero,
            "Radius of the tip \\[m\\]; 0: a point.",
        ),
        optional(
            "arc",
            Shape::Pair(&Shape::Quantity(Measure::Of(Dimension::Angle), Bound::Any)),
            "Directions in the second body between which the tip is round, turning left \\[rad\\]; left out: a full circle.",
        ),
        optional(
            "friction",
            Shape::Object(&FRICTION),
            "Between tip and outline; rigid ones stick and slide by Coulomb's law. Left out: none.",
        ),
        optional(
            "restitution",
            Shape::Number(Bound::Between(0.0, 1.0)),
            "Where they are rigid, 0 where left out [–].",
        ),
        SENSE,
        optional(
            "stiffness",
            Shape::Quantity(Measure::Of(Dimension::Stiffness), Bound::Above(0.0)),
            "Where they yield [N/m]; left out: they are rigid.",
        ),
        optional(
            "damping",
            Shape::Quantity(Measure::Of(Dimension::Damping), Bound::AtLeast(0.0)),
            "Where they yield [N·s/m].",
        ),
        required(
            "between",
            Shape::Pair(&Shape::Point),
            "Two points `body.point`: one of the outline's body, and the centre of the tip.",
        ),
    ],
    refused: &[
        ("limits", "a contact ends where its outline does"),
        ("clearance", "only a revolute joint can have clearance"),
    ],
    drives: Drives::Nothing,
    either: None,
};
