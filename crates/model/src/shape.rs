//! What may stand where in a model file: one typed description, from which the schema is printed, a file is read, the
//! numbers of a model are checked, and a model is printed back.

use std::fmt;
use std::ops::Deref;
use std::sync::LazyLock;

use crate::dimension::Dimension;

/// What the table describes under a name, read when it is first needed.
pub struct Described<T> {
    /// The name in the schema; of a kind its `type`.
    pub name: &'static str,
    read: LazyLock<T, Box<dyn FnOnce() -> T + Send>>,
}

impl<T> Described<T> {
    /// What `read` gives.
    pub fn new(name: &'static str, read: impl FnOnce() -> T + Send + 'static) -> Self {
        let read = LazyLock::new(Box::new(read) as Box<dyn FnOnce() -> T + Send>);
        Described { name, read }
    }
}

impl<T> Deref for Described<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.read
    }
}

/// A description may lead back to itself.
impl<T> fmt::Debug for Described<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// Which numbers are legal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// All that are finite.
    Any,
    /// This one and greater ones.
    AtLeast(f64),
    /// Greater ones.
    Above(f64),
    /// From the first to the second, both included.
    Between(f64, f64),
    /// Greater ones than the first, up to the second.
    Within(f64, f64),
    /// All but zero.
    NotZero,
}

impl Bound {
    /// What is wrong with a number, where something is.
    pub fn fault(self, number: f64) -> Option<String> {
        let least = |least: f64| match least {
            0.0 => "must not be negative".to_owned(),
            least => format!("must not be less than {least}"),
        };
        match self {
            _ if !number.is_finite() => Some("a finite number is expected".to_owned()),
            Bound::AtLeast(bound) if number < bound => Some(least(bound)),
            Bound::Between(bound, _) if number < bound => Some(least(bound)),
            Bound::Between(_, most) | Bound::Within(_, most) if number > most => {
                Some(format!("must not be greater than {most}"))
            }
            Bound::Above(bound) | Bound::Within(bound, _) if number <= bound => {
                Some(format!("must be greater than {bound}"))
            }
            Bound::NotZero if number == 0.0 => Some("must not be zero".to_owned()),
            Bound::Any
            | Bound::AtLeast(_)
            | Bound::Above(_)
            | Bound::Between(..)
            | Bound::Within(..)
            | Bound::NotZero => None,
        }
    }
}

/// What a quantity is a measure of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// A dimension.
    Of(Dimension),
    /// The stiffness of a linear contact, whose plain numbers are in SI whatever `units` names for springs.
    LinearStiffness,
    /// What the motion around it drives, or its derivative of this order by time.
    Driven(usize),
    /// Its derivative of the order of the place in the list.
    DrivenCoefficient,
}

/// Kinds of things that have names in a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Named {
    /// A body, `ground` among them.
    Body,
    /// A joint.
    Joint,
    /// A driver.
    Driver,
}

/// What a motion or a sample inside of an object speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drives {
    /// What is around the object says it.
    Nothing,
    /// A dimension.
    Always(Dimension),
    /// That of the driver that the object names.
    Sampled,
    /// The same; the only driver, where the object names none.
    Posed,
    /// That of the result column that the object names.
    Measured,
}

/// What is asked of an optimisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// Parameters that may change, each with its bounds.
    Design,
    /// An expression whose value is sought.
    Value,
    /// An equation or an inequality.
    Constraint,
}

/// What stands at one place.
#[derive(Debug, Clone, Copy)]
pub enum Shape {
    /// The name of the format.
    Format,
    /// `"SI"`, or a unit per dimension.
    Units,
    /// Numbers with names.
    Parameters,
    /// Any text.
    Text,
    /// One of some words.
    Choice(&'static Described<Choice>),
    /// The name of something.
    Name(Named),
    /// A point of a body, `body.point`.
    Point,
    /// A number with a dimension.
    Quantity(Measure, Bound),
    /// A number with a dimension, or its least and greatest value.
    Range(Measure, Bound),
    /// A number with a dimension, or one for each of two axes.
    PerAxis(Measure, Bound),
    /// A number with a dimension, or nothing.
    End(Measure),
    /// Two lengths, or these with a tolerance of their place.
    Place,
    /// The value of a parameter, which is read before everything else.
    Nominal,
    /// Deviations from the value of the parameter around it.
    Deviations,
    /// A number with the dimension of the parameter around it.
    Alike(Bound),
    /// A number without dimension.
    Number(Bound),
    /// The same; the schema does not say that it is a double.
    Coefficient(Bound),
    /// A whole number from the first to the second.
    Count(usize, usize),
    /// True or false.
    Flag,
    /// A number above zero, which has a dimension where the `law` beside it is linear.
    ContactStiffness,
    /// Two numbers, not both zero.
    Direction,
    /// A list of two.
    Pair(&'static Shape),
    /// A list of at least so many.
    List(&'static Shape, usize),
    /// Points (t, value), at least two.
    Table,
    /// A table of formulas: an object whose entries bring their units.
    Curve(&'static Described<Object>),
    /// A number from outside, whose unit gives it its dimension.
    Input,
    /// An integrated state: an object whose dimension is that of its rate by time.
    State(&'static Described<Object>),
    /// The points of a table.
    Entries,
    /// A number of one, with its unit.
    Entry,
    /// A quantity, or a motion of it.
    Varying(Dimension),
    /// The same, or an expression of what moves.
    Formula(Dimension),
    /// An event of the motion, `door.angle >= 90 deg`.
    Event,
    /// One elastic material, or one of the bearing and one of the journal.
    Materials,
    /// Things of one kind by their names.
    Map(&'static Shape),
    /// Named numbers of a run.
    Responses,
    /// One of them: text, or an object with limits.
    Response,
    /// A limit of the response around it.
    Limit,
    /// Of what is asked of an optimisation.
    Asked(Asked),
    /// The bodies by their names, `ground` of its own kind.
    Bodies,
    /// An object with keys.
    Object(&'static Described<Object>),
    /// An object whose keys depend on its `type`.
    Tagged(&'static Tagged),
}

/// What a key is where a file leaves it out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Default {
    /// 0.
    Zero,
    /// [0, 0].
    Zeros,
    /// An empty list or map.
    Empty,
    /// A number.
    Number(f64),
    /// A text.
    Text(&'static str),
    /// An object whose keys are what they are where they are left out.
    Same,
}

/// Whether a key may be left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Need {
    /// It may not.
    Required,
    /// It may; then there is nothing.
    Optional,
    /// It may; the schema says what it is then.
    Default(Default),
    /// It may; the schema does not say what it is then.
    Silent(Default),
}

/// A key of an object.
#[derive(Debug, Clone, Copy)]
pub struct Field {
    /// The key.
    pub key: &'static str,
    /// What it means.
    pub about: &'static str,
    /// Whether it may be left out.
    pub need: Need,
    /// What stands there.
    pub shape: Shape,
}

/// An object with keys.
#[derive(Debug)]
pub struct Object {
    /// What it is.
    pub about: &'static str,
    /// Its keys.
    pub fields: Vec<Field>,
    /// Keys that it does not have, each with the reason.
    pub refused: Vec<(&'static str, &'static str)>,
    /// What motions inside of it drive.
    pub drives: Drives,
    /// Two keys that belong together or exclude each other.
    pub either: Option<Either>,
}

impl Object {
    /// The field of a key.
    pub fn field(&self, key: &str) -> Option<&Field> {
        self.fields.iter().find(|field| field.key == key)
    }
}

/// Keys of an object of which one may be needed, or two may be too many.
#[derive(Debug)]
pub struct Either {
    /// The keys.
    pub keys: Vec<&'static str>,
    /// What to say where none is there; nothing: all may be left out.
    pub needed: Option<&'static str>,
    /// Whether they exclude each other.
    pub exclusive: bool,
}

/// Objects told apart by their `type`.
#[derive(Debug)]
pub struct Tagged {
    /// Their name in the schema.
    pub name: &'static str,
    /// What they are.
    pub about: &'static str,
    /// Each kind, its name the `type`.
    pub variants: Vec<Described<Object>>,
}

impl Tagged {
    /// The kind of a `type`.
    pub fn variant(&self, name: &str) -> Option<&Described<Object>> {
        self.variants.iter().find(|variant| variant.name == name)
    }
}

/// Some words.
#[derive(Debug)]
pub struct Choice {
    /// What they are for.
    pub about: &'static str,
    /// Each word.
    pub words: Vec<Word>,
}

/// One of some words.
#[derive(Debug)]
pub struct Word {
    /// The word.
    pub word: &'static str,
    /// What it means.
    pub about: &'static str,
    /// The keys beside it that it needs.
    pub needs: Vec<&'static str>,
}
