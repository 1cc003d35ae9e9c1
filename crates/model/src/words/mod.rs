//! The words of a model file: what each key means, and what may stand there.

mod accuracy;
mod analysis;
mod body;
mod cam;
mod clearance;
mod driver;
mod force;
mod friction;
mod higher;
mod joint;
mod motion;
mod optimise;
mod parameter;
mod response;
mod study;
mod table;

pub use body::{BODY, GROUND, LENGTH, PLACE};
pub use clearance::{MATERIAL, SEPARATE};
pub use motion::MOTION;
pub use parameter::PARAMETER;
pub use response::RESPONSE;
use study::{INDICES, METHOD, STUDY};
pub use table::{STATE, TABLE, TABLE_OF};

use crate::dimension::Dimension;
use crate::shape::{
    Bound, Choice, Default, Drives, Measure, Object, Shape, Tagged, default, optional, required,
    silent,
};
use accuracy::{ACCURACY, AT, LEVELS, OUTPUT, PINS};
use analysis::{ACCELERATIONS, ANALYSIS, ANALYSIS_KIND, OUTPUTS_AT, SAMPLE, SOLVER, TRANSMISSION};
use body::{INITIAL, POSE};
use cam::{CAM_SEGMENT, FOLLOWER, PROFILE, SWING_SEGMENT};
use clearance::{CLEARANCE, CLEARANCE_MODEL, IMPACT, IMPACT_SENSE, NORMAL, NORMAL_LAW, SURFACE};
use driver::DRIVER;
use force::{FORCE, FRAME};
use friction::{FRICTION, FRICTION_LAW};
use higher::STRANDS;
use joint::{ACTIVE, JOINT, LATCH, ONE_WAY, TURN_LOCK};
use motion::{INTERPOLATION, RISE_LAW, SEGMENT};
use optimise::{CURVE, OBJECTIVE, OPTIMISE};
use parameter::DISTRIBUTION;

/// The whole file.
pub static FILE: Object = Object {
    name: "linkdyn/1",
    about: "The whole file: what the loader consumes, and the model.",
    fields: &[
        required("format", Shape::Format, "The format of the file."),
        required(
            "units",
            Shape::Units,
            "`\"SI\"`, or another unit per dimension; SI for the rest. Each dimension stands alone.",
        ),
        silent(
            "parameters",
            Shape::Parameters,
            Default::Empty,
            "Numbers with a name, for use in expressions.",
        ),
        optional("name", Shape::Text, ""),
        optional("about", Shape::Text, "What this is, and for whom."),
        optional("source", Shape::Text, "Who measured or published it."),
        default(
            "gravity",
            Shape::Pair(&Shape::Quantity(
                Measure::Of(Dimension::Acceleration),
                Bound::Any,
            )),
            Default::Zeros,
            "Acceleration of gravity [m/s²], zero where left out.",
        ),
        required(
            "bodies",
            Shape::Bodies,
            "All bodies, `ground` among them where the file has it.",
        ),
        silent(
            "joints",
            Shape::Map(&Shape::Tagged(&JOINT)),
            Default::Empty,
            "",
        ),
        silent(
            "drivers",
            Shape::Map(&Shape::Tagged(&DRIVER)),
            Default::Empty,
            "",
        ),
        silent(
            "forces",
            Shape::Map(&Shape::Tagged(&FORCE)),
            Default::Empty,
            "",
        ),
        silent(
            "tables",
            Shape::Map(&Shape::Curve(&TABLE)),
            Default::Empty,
            "Functions by their points, for formulas.",
        ),
        silent(
            "states",
            Shape::Map(&Shape::State(&STATE)),
            Default::Empty,
            "Quantities of which the rates are known, integrated with the motion.",
        ),
        silent(
            "initial",
            Shape::Map(&Shape::Object(&INITIAL)),
            Default::Empty,
            "Exact values at t = 0, per body.",
        ),
        silent(
            "points",
            Shape::List(&Shape::Point, 0),
            Default::Empty,
            "Body points whose motion is wanted among the results.",
        ),
        optional("analysis", Shape::Object(&ANALYSIS), ""),
        optional("accuracy", Shape::Object(&ACCURACY), ""),
        silent(
            "outputs",
            Shape::Map(&Shape::Text),
            Default::Empty,
            "Ratios of two velocities, which become columns: `d(axle.y)/d(force.shock.length)`.",
        ),
        silent(
            "responses",
            Shape::Responses,
            Default::Empty,
            "Named numbers of a run: an expression of result columns and parameters, alone or with limits.",
        ),
        optional("study", Shape::Object(&STUDY), ""),
        optional("optimise", Shape::Object(&OPTIMISE), ""),
    ],
    refused: &[],
    drives: Drives::Nothing,
    either: None,
};

/// Formats that this version reads.
pub static FORMATS: Choice = Choice {
    name: "Format",
    about: "Formats that this version reads.",
    words: &[(crate::FORMAT, "")],
};

/// What the schema defines by a name.
pub enum Definition {
    /// The formats.
    Format(&'static Choice),
    /// A point, and what it is.
    Point(&'static str),
    /// Materials, and what they are.
    Materials(&'static str),
    /// Words.
    Choice(&'static Choice),
    /// An object.
    Object(&'static Object),
    /// Objects told apart by their `type`.
    Tagged(&'static Tagged),
}

impl Definition {
    /// The name.
    pub fn name(&self) -> &'static str {
        match self {
            Definition::Format(choice) | Definition::Choice(choice) => choice.name,
            Definition::Point(_) => "PointRef",
            Definition::Materials(_) => "Elastic",
            Definition::Object(object) => object.name,
            Definition::Tagged(tagged) => tagged.name,
        }
    }
}

/// All that the schema defines by a name, in its order.
pub static DEFINITIONS: [Definition; 59] = [
    Definition::Format(&FORMATS),
    Definition::Object(&GROUND),
    Definition::Object(&BODY),
    Definition::Object(&POSE),
    Definition::Tagged(&JOINT),
    Definition::Point("A point of a body: `body.point`."),
    Definition::Object(&CLEARANCE),
    Definition::Choice(&CLEARANCE_MODEL),
    Definition::Object(&NORMAL),
    Definition::Choice(&NORMAL_LAW),
    Definition::Materials("Materials of bearing and journal."),
    Definition::Object(&MATERIAL),
    Definition::Object(&FRICTION),
    Definition::Choice(&FRICTION_LAW),
    Definition::Object(&SURFACE),
    Definition::Object(&IMPACT),
    Definition::Choice(&IMPACT_SENSE),
    Definition::Tagged(&DRIVER),
    Definition::Tagged(&MOTION),
    Definition::Tagged(&FORCE),
    Definition::Choice(&FRAME),
    Definition::Choice(&LATCH),
    Definition::Choice(&STRANDS),
    Definition::Object(&ACTIVE),
    Definition::Object(&TURN_LOCK),
    Definition::Choice(&ONE_WAY),
    Definition::Object(&INITIAL),
    Definition::Object(&ANALYSIS),
    Definition::Choice(&ANALYSIS_KIND),
    Definition::Object(&SAMPLE),
    Definition::Choice(&OUTPUTS_AT),
    Definition::Choice(&ACCELERATIONS),
    Definition::Object(&SOLVER),
    Definition::Object(&TRANSMISSION),
    Definition::Object(&PARAMETER),
    Definition::Choice(&DISTRIBUTION),
    Definition::Object(&PLACE),
    Definition::Object(&ACCURACY),
    Definition::Object(&OUTPUT),
    Definition::Object(&AT),
    Definition::Choice(&PINS),
    Definition::Choice(&LEVELS),
    Definition::Object(&RESPONSE),
    Definition::Object(&STUDY),
    Definition::Choice(&METHOD),
    Definition::Choice(&INDICES),
    Definition::Object(&OPTIMISE),
    Definition::Object(&OBJECTIVE),
    Definition::Object(&CURVE),
    Definition::Object(&SEGMENT),
    Definition::Choice(&RISE_LAW),
    Definition::Choice(&INTERPOLATION),
    Definition::Choice(&FOLLOWER),
    Definition::Tagged(&PROFILE),
    Definition::Object(&CAM_SEGMENT),
    Definition::Object(&SWING_SEGMENT),
    Definition::Object(&TABLE),
    Definition::Object(&TABLE_OF),
    Definition::Object(&STATE),
];
