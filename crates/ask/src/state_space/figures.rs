//! Bode's and Nyquist's figures of a linear system.
//!
//! ```text
//! Bode       |G| and arg G over the frequency; the phase goes on smoothly from place to place
//! Nyquist    Im G over Re G
//! ```

use linkdyn_engine::analysis::{LinearSystem, Variable};
use linkdyn_picture::{Axis, Chart, Curve, Fault, MOST_CURVES, Panel, svg};

use super::Linearisation;

const BODE: &str = "bode.svg";
/// One for each output that is shown.
const NYQUIST: [&str; 4] = [
    "nyquist.svg",
    "nyquist-2.svg",
    "nyquist-3.svg",
    "nyquist-4.svg",
];

/// Figures with the names of their files, and what they leave out.
pub type Figures = (Vec<(&'static str, String)>, Vec<String>);

impl Linearisation {
    /// Files that figures may have.
    pub fn figure_files() -> impl Iterator<Item = &'static str> {
        std::iter::once(BODE).chain(NYQUIST)
    }

    /// Figures of the frequency responses, with the names of their files; none where there are no inputs. What they leave out is told.
    ///
    /// # Errors
    /// Why one can't be drawn.
    pub fn figures(&self) -> Result<Figures, Fault> {
        let Some(first) = self
            .systems
            .first()
            .filter(|system| !system.inputs.is_empty())
        else {
            return Ok((Vec::new(), Vec::new()));
        };
        let mut bode = Vec::new();
        let mut written = Vec::new();
        let frequency = Axis {
            log: true,
            ..Axis::new("frequency", "Hz")
        };
        let shown = first.outputs.iter().zip(NYQUIST).enumerate();
        for (row, (output, file)) in shown {
            let curves = self.curves(row);
            let (name, unit) = (&output.name, self.unit(output));
            let of = |part: fn(&ResponseCurve) -> Curve| {
                let shown = curves.iter().take(MOST_CURVES);
                shown.map(part).collect::<Vec<_>>()
            };
            bode.push(panel(
                &format!("|{name}|"),
                &unit,
                true,
                of(ResponseCurve::size),
            ));
            bode.push(panel(
                &format!("phase of {name}"),
                "deg",
                false,
                of(ResponseCurve::phase),
            ));
            let path = panel(&format!("Im {name}"), &unit, false, of(ResponseCurve::path));
            written.push((
                file,
                self.drawn(Axis::new(format!("Re {name}"), unit), vec![path])?,
            ));
        }
        written.insert(0, (BODE, self.drawn(frequency, bode)?));
        let curves = first.inputs.len() * self.systems.len();
        let more = [
            (first.outputs.len() > NYQUIST.len())
                .then(|| format!("the figures show the first {} outputs", NYQUIST.len())),
            (curves > MOST_CURVES)
                .then(|| format!("the figures show the first {MOST_CURVES} curves of an output")),
        ];
        Ok((written, more.into_iter().flatten().collect()))
    }

    fn drawn(&self, x: Axis, panels: Vec<Panel>) -> Result<String, Fault> {
        let chart = Chart {
            title: self.file.name().to_owned(),
            x,
            panels,
            grid: true,
            whole: true,
            ..Chart::default()
        };
        Ok(svg::write(&chart.draw()?))
    }

    /// The unit of a response: that of an output by that of the inputs, where these have one.
    fn unit(&self, output: &Variable) -> String {
        let inputs = self.systems.iter().flat_map(|system| &system.inputs);
        let mut units: Vec<&str> = inputs.map(|input| input.unit.as_str()).collect();
        units.dedup();
        match units[..] {
            [unit] => format!("{}/({unit})", output.unit),
            _ => format!("{} per input", output.unit),
        }
    }

    /// Responses of an output to all inputs, at all instants.
    fn curves(&self, row: usize) -> Vec<ResponseCurve> {
        let mut curves = Vec::new();
        for system in &self.systems {
            let response = self.frequency_response(system);
            for (column, input) in system.inputs.iter().enumerate() {
                let place = row * system.inputs.len() + column;
                let value = |all: &Vec<[f64; 2]>| all.get(place).copied().unwrap_or([f64::NAN; 2]);
                curves.push(ResponseCurve {
                    label: label(system, input),
                    frequencies: response.frequencies.clone(),
                    values: response.values.iter().map(value).collect(),
                });
            }
        }
        curves
    }
}

fn label(system: &LinearSystem, input: &Variable) -> String {
    match system.time {
        Some(time) => format!("{}, {time} s", input.name),
        None => input.name.clone(),
    }
}

fn panel(name: &str, unit: &str, log: bool, curves: Vec<Curve>) -> Panel {
    Panel {
        axis: Axis {
            log,
            ..Axis::new(name, unit)
        },
        curves,
    }
}

/// The response of one output to one input.
struct ResponseCurve {
    label: String,
    frequencies: Vec<f64>,
    values: Vec<[f64; 2]>,
}

impl ResponseCurve {
    fn size(&self) -> Curve {
        let sizes = self.values.iter().map(|[re, im]| re.hypot(*im));
        // A logarithmic axis has no place for nothing.
        let sizes = sizes.map(|size| if size > 0.0 { size } else { f64::NAN });
        Curve::new(&self.label, self.frequencies.clone(), sizes.collect())
    }

    fn phase(&self) -> Curve {
        let mut turns = 0.0;
        let mut before = f64::NAN;
        let phases = self.values.iter().map(|[re, im]| {
            let own = match *re == 0.0 && *im == 0.0 {
                true => f64::NAN,
                false => im.atan2(*re).to_degrees(),
            };
            if (own + turns - before).abs() > 180.0 {
                turns += 360.0 * ((before - own - turns) / 360.0).round();
            }
            if own.is_finite() {
                before = own + turns;
            }
            own + turns
        });
        Curve::new(&self.label, self.frequencies.clone(), phases.collect())
    }

    fn path(&self) -> Curve {
        let part = |k: usize| self.values.iter().map(|value| value[k]).collect();
        Curve::new(&self.label, part(0), part(1))
    }
}
