//! `modelDescription.xml` and the page of a unit.
//!
//! ```text
//!                FMI 2.0                                   FMI 3.0
//! variables      ScalarVariable with Real or Integer       Float64 or Int32
//! named by       index, from 1, without time               value reference, from 0: the same numbers
//! unit           that of the variable, in powers of m, kg, s and rad
//! ```

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::fmu::{Interface, Role, Variable};
use crate::mechanism::Mechanism;
use linkdyn_model::Unit;

/// What a unit says of itself.
pub struct Description<'a> {
    /// 2 or 3.
    pub version: u8,
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its variables.
    pub interface: &'a Interface,
    /// What tells it from other units.
    pub token: &'a str,
}

/// What an attribute of a variable says.
struct Attributes {
    causality: &'static str,
    variability: &'static str,
    initial: Option<&'static str>,
    description: String,
}

impl Description<'_> {
    /// The name of the library: that of the model, as an identifier of C.
    pub fn identifier(&self) -> String {
        let name = self.mechanism.name();
        let plain = |letter: char| match letter {
            letter if letter.is_ascii_alphanumeric() => letter.to_ascii_lowercase(),
            _ => '_',
        };
        let identifier: String = name.chars().map(plain).take(60).collect();
        format!("linkdyn_{identifier}")
    }

    /// `modelDescription.xml`.
    pub fn xml(&self) -> String {
        let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        let (version, token) = match self.version {
            2 => ("2.0", "guid"),
            _ => ("3.0", "instantiationToken"),
        };
        let about = self.mechanism.model().about.as_deref();
        let about = about.map_or(String::new(), |about| {
            format!(" description=\"{}\"", escaped(about))
        });
        // Writing to a String does not fail.
        let _ = writeln!(
            xml,
            "<fmiModelDescription fmiVersion=\"{version}\" modelName=\"{}\" {token}=\"{}\"{about} generationTool=\"linkdyn {}\" \
             variableNamingConvention=\"flat\">",
            escaped(self.mechanism.name()),
            self.token,
            linkdyn_ask::ENGINE,
        );
        let _ = writeln!(xml, "  {}", self.capabilities());
        self.units(&mut xml);
        xml += "  <LogCategories>\n    <Category name=\"logEvents\" description=\"Impacts, touches, changes between stick and slip\"/>\n    \
                <Category name=\"logStatusError\" description=\"Why a call is refused\"/>\n  </LogCategories>\n";
        self.experiment(&mut xml);
        xml += "  <ModelVariables>\n";
        for (reference, variable) in self.interface.variables.iter().enumerate() {
            // Some importers of FMI 2.0 ask for its start value, which it must not have; there it may be left out.
            if self.version == 2 && variable.role == Role::Time {
                continue;
            }
            self.variable(&mut xml, reference, variable);
        }
        xml += "  </ModelVariables>\n";
        self.structure(&mut xml);
        xml += "</fmiModelDescription>\n";
        xml
    }

    fn capabilities(&self) -> String {
        let identifier = self.identifier();
        match self.version {
            2 => format!(
                "<CoSimulation modelIdentifier=\"{identifier}\" canHandleVariableCommunicationStepSize=\"true\" \
                 canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" \
                 providesDirectionalDerivative=\"true\"/>"
            ),
            _ => format!(
                "<CoSimulation modelIdentifier=\"{identifier}\" canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\" \
                 providesDirectionalDerivatives=\"true\" canHandleVariableCommunicationStepSize=\"true\" \
                 mightReturnEarlyFromDoStep=\"true\" hasEventMode=\"true\"/>"
            ),
        }
    }

    /// The units of all variables.
    fn units(&self, xml: &mut String) {
        let units = self
            .interface
            .variables
            .iter()
            .map(|variable| &variable.unit);
        let units: BTreeSet<&String> = units.filter(|unit| !unit.is_empty()).collect();
        *xml += "  <UnitDefinitions>\n";
        for unit in units {
            let _ = write!(xml, "    <Unit name=\"{}\"", escaped(unit));
            *xml += &match Unit::parse(unit) {
                Ok(parsed) => {
                    let powers = parsed.powers;
                    let named = [
                        ("kg", powers.mass),
                        ("m", powers.length),
                        ("s", powers.time),
                        ("rad", powers.angle),
                    ];
                    let named = named.iter().filter(|(_, power)| *power != 0);
                    let named: String = named
                        .map(|(name, power)| format!(" {name}=\"{power}\""))
                        .collect();
                    format!("><BaseUnit{named}/></Unit>\n")
                }
                Err(_) => "/>\n".into(),
            };
        }
        *xml += "  </UnitDefinitions>\n";
    }

    /// What the model's own analysis would compute.
    fn experiment(&self, xml: &mut String) {
        let analysis = self.mechanism.model().analysis.as_ref();
        let Some(end) = analysis.and_then(|analysis| analysis.end) else {
            return;
        };
        let outputs = analysis
            .and_then(|analysis| analysis.outputs)
            .unwrap_or_default();
        let step = match outputs {
            0 | 1 => end / 100.0,
            outputs => end / (outputs - 1) as f64,
        };
        let _ = writeln!(
            xml,
            "  <DefaultExperiment startTime=\"0\" stopTime=\"{end}\" stepSize=\"{step}\"/>"
        );
    }

    fn variable(&self, xml: &mut String, reference: usize, variable: &Variable) {
        let Attributes {
            causality,
            variability,
            initial,
            description,
        } = attributes(variable);
        let name = escaped(&variable.name);
        let initial = initial.map_or(String::new(), |initial| format!(" initial=\"{initial}\""));
        let unit = match variable.unit.as_str() {
            "" => String::new(),
            unit => format!(" unit=\"{}\"", escaped(unit)),
        };
        let start = self.interface.start(reference);
        let start = start.map_or(String::new(), |start| format!(" start=\"{start:?}\""));
        let common = format!(
            "name=\"{name}\" valueReference=\"{reference}\" causality=\"{causality}\" variability=\"{variability}\"{initial} \
             description=\"{}\"",
            escaped(&description)
        );
        let is_count = variable.role == Role::Events;
        let _ = match (self.version, is_count) {
            (2, true) => writeln!(
                xml,
                "    <ScalarVariable {common}><Integer/></ScalarVariable>"
            ),
            (2, false) => writeln!(
                xml,
                "    <ScalarVariable {common}><Real{unit}{start}/></ScalarVariable>"
            ),
            (_, true) => writeln!(xml, "    <Int32 {common}/>"),
            (_, false) => writeln!(xml, "    <Float64 {common}{unit}{start}/>"),
        };
    }

    /// What depends on what.
    fn structure(&self, xml: &mut String) {
        let unknowns = || {
            let variables = self.interface.variables.iter().enumerate();
            variables.filter_map(|(reference, variable)| match variable.role {
                Role::Output { is_direct, .. } => Some((reference, is_direct)),
                Role::Events => Some((reference, false)),
                Role::Time | Role::Parameter(_) | Role::Input(_) | Role::Acceleration => None,
            })
        };
        // Without the attribute it is all.
        let none = |is_direct| if is_direct { "" } else { " dependencies=\"\"" };
        *xml += "  <ModelStructure>\n";
        if self.version == 2 {
            *xml += "    <Outputs>\n";
            for (reference, is_direct) in unknowns() {
                let _ = writeln!(
                    xml,
                    "      <Unknown index=\"{reference}\"{}/>",
                    none(is_direct)
                );
            }
            *xml += "    </Outputs>\n    <InitialUnknowns>\n";
            for (reference, _) in unknowns() {
                let _ = writeln!(xml, "      <Unknown index=\"{reference}\"/>");
            }
            *xml += "    </InitialUnknowns>\n";
        } else {
            for (reference, is_direct) in unknowns() {
                let _ = writeln!(
                    xml,
                    "    <Output valueReference=\"{reference}\"{}/>",
                    none(is_direct)
                );
            }
            for (reference, _) in unknowns() {
                let _ = writeln!(xml, "    <InitialUnknown valueReference=\"{reference}\"/>");
            }
        }
        *xml += "  </ModelStructure>\n";
    }

    /// `documentation/index.html`.
    pub fn page(&self) -> String {
        let name = escaped(self.mechanism.name());
        let about = self
            .mechanism
            .model()
            .about
            .as_deref()
            .map(escaped)
            .unwrap_or_default();
        let row = |variable: &Variable| {
            let [name, unit, description] = [
                &variable.name,
                &variable.unit,
                &attributes(variable).description,
            ]
            .map(|text| escaped(text));
            format!("<tr><td>{name}</td><td>{unit}</td><td>{description}</td></tr>\n")
        };
        let rows: String = self.interface.variables.iter().map(row).collect();
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{name}</title></head>\n<body>\n<h1>{name}</h1>\n\
             <p>{about}</p>\n<p>Co-simulation by linkdyn {}. The model is in resources/model.json. Parameters can be set before the motion \
             begins; numbers are in SI units.</p>\n<table>\n<tr><th>variable</th><th>unit</th><th></th></tr>\n{rows}</table>\n</body></html>\n",
            linkdyn_ask::ENGINE
        )
    }
}

fn attributes(variable: &Variable) -> Attributes {
    match variable.role {
        Role::Time => Attributes {
            causality: "independent",
            variability: "continuous",
            initial: None,
            description: "time since the model's t = 0".into(),
        },
        Role::Parameter(_) => Attributes {
            causality: "parameter",
            variability: "fixed",
            initial: Some("exact"),
            description: "parameter of the model".into(),
        },
        Role::Input(_) | Role::Acceleration => Attributes {
            causality: "input",
            variability: "continuous",
            initial: None,
            description: if variable.role == Role::Acceleration {
                "acceleration of the driver, which goes on from where it is"
            } else {
                "input of the model, constant in a step"
            }
            .into(),
        },
        Role::Output { .. } => Attributes {
            causality: "output",
            variability: "continuous",
            initial: Some("calculated"),
            description: "result column".into(),
        },
        Role::Events => Attributes {
            causality: "output",
            variability: "discrete",
            initial: Some("calculated"),
            description: "impacts, touches, changes between stick and slip so far".into(),
        },
    }
}

/// A text in XML and HTML; control characters, which XML does not have, are spaces.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\u{fffe}' | '\u{ffff}' => escaped.push(' '),
            letter if letter.is_control() => escaped.push(' '),
            letter => escaped.push(letter),
        }
    }
    escaped
}
