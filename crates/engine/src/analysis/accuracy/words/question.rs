//! A model and its parameters as a question in numbers: what may be off, and what is asked about.

use super::super::dimensions::Dimensions;
use super::super::poses::{Halt, Unreached};
use super::super::source::Play;
use super::super::statistics::{Pins, Scatter};
use super::super::{Accuracy, Named, Question, Wanted, run};
use super::gears::gear_curvature;
use super::names::{Names, dimension_values, dimensions};
use super::parameters::{idle, kinks, slack, times, with_influence};
use crate::analysis::control::{Control, Stop};
use crate::analysis::question::instants;
use crate::system::{System, compile::compile_geometry};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{
    AccuracyOutput, Checked, Derivatives, Distribution, DriverKind, Interval, JointKind, Measured,
    Model, Parameter, nearest,
};

/// The model with parameters that deviate (index, SI); none where that is no legal model.
pub type Deviating<'p> = dyn Fn(&[(usize, f64)]) -> Option<Checked> + 'p;

/// The parameters of a model: what follows from them, and the model with other values of theirs.
pub struct Parameters<'p> {
    /// As resolved, in the order of the file.
    pub all: &'p [Parameter],
    /// What every quantity of the file takes from them.
    pub derivatives: &'p Derivatives,
    /// The same, enclosed for all parameters within their tolerances.
    pub enclosed: &'p Derivatives<Interval>,
    /// The model with deviations of theirs.
    pub with: &'p Deviating<'p>,
}

/// Why there is no answer.
#[derive(Debug)]
pub enum Refusal {
    /// Faults of the input.
    Input(Complaints),
    /// The mechanism can't be had: no assembly, a singular start.
    Failed(String),
}

impl From<Stop> for Refusal {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Input(complaints) => Refusal::Input(complaints.into()),
            Stop::Failed { message, .. } => Refusal::Failed(message),
        }
    }
}

impl From<Complaint> for Refusal {
    fn from(complaint: Complaint) -> Self {
        Refusal::Input(complaint.into())
    }
}

impl From<Complaints> for Refusal {
    fn from(complaints: Complaints) -> Self {
        Refusal::Input(complaints)
    }
}

/// What tolerances and clearances do to the outputs of a model, all of them or those in `only`.
///
/// # Errors
/// [`Refusal`]: nothing asked, outputs that do not exist, poses that the motion does not have, nothing that is off, joints that
/// hold the same freedom.
pub fn accuracy(
    model: &Checked,
    parameters: &Parameters,
    only: &[String],
    control: &Control,
) -> Result<Accuracy, Refusal> {
    let ideal = model.with_clearances(|_| false);
    let system = compile_geometry(&ideal)?;
    let names = Names::new(&ideal);
    let outputs = wanted(&ideal, &system, &names, only)?;
    let Some(analysis) = &ideal.analysis else {
        let hint = "add \"analysis\": { \"type\": \"kinematics\", \"end\": 1, \"outputs\": 101 }";
        return Err(Complaint::new(
            "analysis",
            "accuracy is asked along a motion, and the model says none",
        )
        .hint(hint)
        .into());
    };
    let all = dimensions(&ideal, &names, &system);
    let sources = sources(model, &system, &names, &all, parameters)?;
    let nominal = dimension_values(&ideal, &system);
    let tolerated: Vec<usize> = with_influence(&all, parameters)
        .map(|(index, _)| index)
        .collect();
    let corners = |deviations: &[f64]| -> Option<Vec<f64>> {
        let given = tolerated
            .iter()
            .zip(deviations)
            .filter(|(_, by)| **by != 0.0);
        let given: Vec<(usize, f64)> = given.map(|(&index, by)| (index, *by)).collect();
        let steps = |values: Vec<f64>| values.iter().zip(&nominal).map(|(v, n)| v - n).collect();
        if given.is_empty() {
            return Some(vec![0.0; nominal.len()]);
        }
        let varied = (parameters.with)(&given)?.with_clearances(|_| false);
        Some(steps(dimension_values(&varied, &system)))
    };
    let instants = instants(&system, analysis)?.list(&system)?;
    let zone_bears_wheel = sources.iter().any(
        |named| matches!(named.play, Play::Zone { point, .. } if all.points[point.0].bears_wheel),
    );
    let question = Question {
        slack: slack(&all, parameters).filter(|_| !zone_bears_wheel),
        outputs,
        sources,
        dimensions: all,
        pins: pins(model),
        instants,
        corners: &corners,
    };
    run(&system, &question, control).map_err(|halt| match halt {
        Halt::Stop(stop) => stop.into(),
        Halt::Unreached(all) => {
            let faults = all.iter();
            let faults = faults.map(|(output, by)| outside(&ideal, &question.outputs[*output], by));
            Refusal::Input(Complaints(faults.collect()))
        }
    })
}

/// What is said of a pose that the motion does not have.
fn outside(model: &Model, wanted: &Wanted, by: &Unreached) -> Complaint {
    let (name, driver) = model.drivers.get_index(by.driver).expect("a driver");
    let text = |value: f64| match driver.kind {
        DriverKind::Rotation { .. } => model.display.angle_to(value, 6),
        DriverKind::Translation { .. } => model.display.length_to(value, 6),
    };
    let [low, high] = by.range.map(text);
    let message = if by.is_stopped {
        format!("the mechanism locks before {name:?} has this value")
    } else {
        format!("{name:?} does not have this value in its motion")
    };
    let value = wanted.at.map_or(f64::NAN, |(_, value)| value);
    Complaint::new(
        format!("accuracy.outputs.{}.at.value", wanted.name),
        message,
    )
    .found(text(value))
    .hint(format!("it goes from {low} to {high}"))
}

/// How the pins are taken.
fn pins(model: &Model) -> Pins {
    let said = model
        .accuracy
        .as_ref()
        .map_or_else(Default::default, |accuracy| accuracy.pins);
    match said {
        linkdyn_model::Pins::Worst | linkdyn_model::Pins::Rim => Pins::Rim,
        linkdyn_model::Pins::Disc => Pins::Disc,
        linkdyn_model::Pins::Load => Pins::Load,
        linkdyn_model::Pins::None => Pins::None,
    }
}

/// The outputs that are asked for.
fn wanted(
    model: &Model,
    system: &System,
    names: &Names,
    only: &[String],
) -> Result<Vec<Wanted>, Complaint> {
    let outputs = model.accuracy.as_ref().map(|accuracy| &accuracy.outputs);
    let Some(outputs) = outputs.filter(|outputs| !outputs.is_empty()) else {
        let hint =
            "add \"accuracy\": { \"outputs\": { \"NAME\": { \"column\": \"rocker.angle\" } } }";
        return Err(Complaint::new(
            "accuracy.outputs",
            "the model says no output whose accuracy is asked",
        )
        .hint(hint));
    };
    if let Some(unknown) = only
        .iter()
        .find(|name| !outputs.contains_key(name.as_str()))
    {
        let near = nearest(unknown, outputs.keys().map(String::as_str));
        let complaint = Complaint::new(
            "accuracy.outputs",
            format!("there is no output {unknown:?}"),
        );
        let listed: Vec<&str> = outputs.keys().map(String::as_str).collect();
        return Err(complaint.hint(match near {
            Some(near) => format!("did you mean {near:?}?"),
            None => format!("the outputs: {}", listed.join(", ")),
        }));
    }
    let asked = outputs
        .iter()
        .filter(|(name, _)| only.is_empty() || only.contains(name));
    asked
        .map(|(name, output)| one(system, names, name, output))
        .collect()
}

fn one(
    system: &System,
    names: &Names,
    name: &str,
    asked: &AccuracyOutput,
) -> Result<Wanted, Complaint> {
    let path = format!("accuracy.outputs.{name}");
    let output = match &asked.of {
        Measured::Column(column) => names.column(system, column).ok_or_else(|| {
            Complaint::new(format!("{path}.column"), "accuracy is that of positions: angles of bodies, x and y of bodies and of points, distances")
                .found(format!("{column:?}"))
                .hint("forces and efforts are not differentiated yet")
        })?,
        Measured::Distance([from, to]) => {
            let points = [(from.body.as_str(), from.point.as_str()), (to.body.as_str(), to.point.as_str())];
            names.distance(points).ok_or_else(|| Complaint::new(format!("{path}.distance"), "there are no such points"))?
        }
    };
    let at = match &asked.at {
        None => None,
        Some(at) => {
            let driver = match &at.driver {
                Some(driver) => system.drivers.iter().position(|own| own.name == *driver),
                None => (system.drivers.len() == 1).then_some(0),
            };
            let driver = driver.ok_or_else(|| {
                Complaint::new(format!("{path}.at.driver"), "which driver has the value?")
                    .hint("name it, as in \"driver\": \"motor\"")
            })?;
            Some((driver, at.value))
        }
    };
    let of = match &asked.of {
        Measured::Column(column) => column.clone(),
        Measured::Distance([from, to]) => format!("distance of {from} and {to}"),
    };
    Ok(Wanted {
        name: name.to_owned(),
        of,
        output,
        at,
        limits: asked.limits,
    })
}

/// All that may be off.
fn sources(
    model: &Model,
    system: &System,
    names: &Names,
    all: &Dimensions,
    parameters: &Parameters,
) -> Result<Vec<Named>, Complaints> {
    let mut sources = Vec::new();
    for (index, (name, joint)) in model.joints.iter().enumerate() {
        let row = system.blocks[index].row;
        let play = joint_play(&joint.kind, row, system, index);
        sources.extend(
            play.filter(|_| {
                pins(model) != Pins::None || !matches!(joint.kind, JointKind::Revolute { .. })
            })
            .map(|play| Named {
                name: format!("joints.{name}"),
                play,
            }),
        );
    }
    sources.extend(zones(model, names));
    for (index, (name, driver)) in model.drivers.iter().enumerate() {
        sources.extend(
            driver
                .tolerance
                .filter(|half| *half > 0.0)
                .map(|half| Named {
                    name: format!("drivers.{name}"),
                    play: Play::Driver {
                        row: system.driver_row(crate::system::DriverId(index)),
                        half,
                    },
                }),
        );
    }
    for (index, steps) in with_influence(all, parameters) {
        let parameter = &parameters.all[index];
        let (lower, upper, scatter) = match &parameter.tolerance {
            None => (0.0, 0.0, Scatter::Uniform),
            Some(tolerance) => {
                let scatter = match tolerance.distribution {
                    Distribution::Normal { sigma } => Scatter::Normal(sigma),
                    Distribution::Uniform => Scatter::Uniform,
                    Distribution::Triangular => Scatter::Triangular,
                };
                (tolerance.lower, tolerance.upper, scatter)
            }
        };
        sources.push(Named {
            name: format!("parameters.{}", parameter.name),
            play: Play::Parameter {
                lower,
                upper,
                scatter,
                steps,
            },
        });
    }
    let faults = faults(&sources, all, parameters);
    if faults.is_empty() {
        Ok(sources)
    } else {
        Err(Complaints(faults))
    }
}

/// What is wrong with the parameters as sources.
fn faults(sources: &[Named], all: &Dimensions, parameters: &Parameters) -> Vec<Complaint> {
    let mut faults = Vec::new();
    faults.extend(kinks(all, parameters));
    faults.extend(times(parameters));
    if faults.is_empty() {
        // Behind a kink nothing is known to follow.
        faults.extend(idle(all, parameters));
    }
    let off = |named: &Named| named.play.is_off();
    // A tolerance of zero is one that is still to be chosen.
    let is_said = parameters
        .all
        .iter()
        .any(|parameter| parameter.tolerance.is_some());
    if faults.is_empty() && !is_said && !sources.iter().any(off) {
        let message = "nothing may be off: no parameter has a tolerance, and no joint a clearance";
        let hint = "as in \"parameters\": { \"rod\": { \"value\": \"200 mm\", \"tolerance\": \"0.05 mm\" } }, or \"clearance\": { \"model\": \"ideal\", \"radius\": \"10 um\" } of a joint";
        faults.push(Complaint::new("parameters", message).hint(hint));
    }
    faults
}

/// Zones of points.
fn zones(model: &Model, names: &Names) -> Vec<Named> {
    let mut zones = Vec::new();
    for (body, data) in &model.bodies {
        for (point, diameter) in &data.point_tolerances {
            zones.extend(names.point(body, point).map(|id| Named {
                name: format!("bodies.{body}.points.{point}"),
                play: Play::Zone {
                    point: id,
                    radius: 0.5 * diameter,
                },
            }));
        }
    }
    zones
}

/// What a joint may be off.
fn joint_play(kind: &JointKind, row: usize, system: &System, index: usize) -> Option<Play> {
    match kind {
        JointKind::Revolute { clearance, .. } => {
            let clearance = clearance.as_ref()?.limits()?;
            (clearance[1] > 0.0).then_some(Play::Pin { row, clearance })
        }
        JointKind::Prismatic {
            play, guide_length, ..
        } => {
            let play = play.as_ref().filter(|play| play.most > 0.0)?;
            let half = [play.least, play.most];
            Some(match guide_length {
                Some(length) => Play::Guided {
                    row,
                    half,
                    length: *length,
                },
                None => Play::Sides { row, half },
            })
        }
        JointKind::Slot { play, .. } => {
            let play = play.as_ref().filter(|play| play.most > 0.0)?;
            Some(Play::Sides {
                row,
                half: [play.least, play.most],
            })
        }
        JointKind::Gear { backlash, .. } => {
            let backlash = backlash.filter(|backlash| *backlash > 0.0)?;
            // An arc at the pitch circle as an angle of the second wheel, half of it to either side.
            let half = 0.5 * backlash * gear_curvature(system, index);
            Some(Play::Sides {
                row,
                half: [half, half],
            })
        }
        JointKind::Fixed { .. } => None,
    }
}
