//! The equations as a document in LaTeX.

use std::f64::consts::FRAC_PI_2;

use linkdyn_model::error::{Complaint, Complaints};

use super::law::TimeLaw;
use super::linkage::{Action, Coordinate, CoordinateKind};
use super::place::{Plane, turned};
use super::start::Equations;
use super::waves::{Factor, TurnedVector, Wave, Waves, bend, constant, slope, value};

/// Bodies that move, at most: the text of more is too long to be read.
const MOST_BODIES: usize = 6;
/// Characters of a line, about, without those that are not seen.
const WIDTH: usize = 75;
/// Phases nearer to a right angle than this are right angles \[rad\].
const RIGHT: f64 = 1e-12;

/// A symbol and what it is: terms with their signs.
struct Definition {
    left: String,
    terms: Vec<(f64, String)>,
}

impl Equations {
    /// The document.
    ///
    /// # Errors
    /// Of a mechanism with too many bodies.
    pub fn latex(&self) -> Result<String, Complaints> {
        let count = self.linkage.bodies.len();
        if count > MOST_BODIES {
            let message = format!("{count} moving bodies are too many for equations in LaTeX");
            let hint = format!("{MOST_BODIES} at most; `--equations python` writes more");
            return Err(Complaint::new("bodies", message).hint(hint).into());
        }
        let is_open = self.linkage.closures.is_empty() && self.linkage.drives.is_empty();
        let constraints = if is_open {
            String::new()
        } else {
            self.constraints()
        };
        let parts = [
            self.head(),
            self.numbers(),
            self.masses(),
            self.forces(),
            constraints,
            self.motion(is_open),
            self.check(),
            "\\end{document}\n".into(),
        ];
        Ok(parts.concat())
    }

    fn head(&self) -> String {
        format!(
            "\\documentclass{{article}}\n\\usepackage[utf8]{{inputenc}}\n\\usepackage{{amsmath}}\n\\usepackage[margin=25mm]{{geometry}}\n\\allowdisplaybreaks\n\
             \\title{{Equations of motion of {}}}\n\\author{{Written by linkdyn}}\n\\date{{}}\n\\begin{{document}}\n\\maketitle\n\n\
             SI units, angles in radians. A dot is a derivative by time.\n\n",
            escaped(&self.linkage.name)
        )
    }

    fn numbers(&self) -> String {
        let linkage = &self.linkage;
        let coordinates = linkage.coordinates.iter().enumerate().map(|(k, own)| {
            let free = if self.independent.contains(&k) {
                "yes"
            } else {
                "no"
            };
            let at = [self.start[k], self.rates[k]].map(number);
            let symbol = own.symbol();
            let about = own.about(&escaped(&own.of));
            format!(
                "$p_{{{}}} = {symbol}$ & {about} & {free} & ${}$ & ${}$ \\\\\n",
                k + 1,
                at[0],
                at[1]
            )
        });
        let coordinates = table(
            "lllrr",
            "symbol & meaning & independent & at $t=0$ & its rate",
            coordinates.collect(),
        );
        let bodies = linkage.bodies.iter().map(|body| {
            let [mass, inertia] = [body.mass, body.inertia].map(number);
            format!("{} & ${mass}$ & ${inertia}$ \\\\\n", escaped(&body.name))
        });
        let bodies = table(
            "lrr",
            "body & $m$ [kg] & $I$ about its centre of mass [kg\\,m$^2$]",
            bodies.collect(),
        );
        let [x, y] = linkage.gravity.map(number);
        format!(
            "\\section*{{Coordinates and numbers}}\n{coordinates}\n{bodies}\n\
             Gravity is $({x},\\ {y})$\\,m/s$^2$. All other numbers stand in the equations.\n\n"
        )
    }

    /// M and h.
    fn masses(&self) -> String {
        let bodies = &self.linkage.bodies;
        let count = self.linkage.coordinates.len();
        let (mut mass, mut terms) = (Vec::new(), Vec::new());
        for i in 0..count {
            for j in i..count {
                let mut waves = Waves::default();
                for body in bodies {
                    let slopes = [i, j].map(|k| slope(&body.centre, k));
                    waves.add_product(body.mass, &slopes[0], &slopes[1]);
                    let turns = [i, j].map(|k| body.turn.angle == Some(k));
                    if turns == [true, true] {
                        waves.add_constant(body.inertia);
                    }
                }
                mass.extend(self.entry(format!("M_{{{},{}}}", i + 1, j + 1), &waves));
            }
            let mut waves = Waves::default();
            for body in bodies {
                waves.add_product(body.mass, &slope(&body.centre, i), &bend(&body.centre));
            }
            terms.extend(self.entry(format!("h_{{{}}}", i + 1), &waves));
        }
        format!(
            "\\section*{{Masses}}\nThe mass matrix is symmetric; entries that are not listed are zero.\n{}\
             Velocity terms:\n{}",
            aligned(&mass),
            aligned(&terms)
        )
    }

    /// Q, and what it is made of.
    fn forces(&self) -> String {
        let linkage = &self.linkage;
        let count = linkage.coordinates.len();
        let mut symbols = Vec::new();
        let mut applied: Vec<Vec<(f64, String)>> = vec![Vec::new(); count];
        for (i, own) in applied.iter_mut().enumerate() {
            let mut waves = Waves::default();
            for body in &linkage.bodies {
                let weight = constant(linkage.gravity);
                waves.add_product(body.mass, &slope(&body.centre, i), &weight);
            }
            *own = self.terms(&waves);
        }
        for acting in &linkage.forces {
            let index = format!("\\text{{{}}}", escaped(&acting.name));
            let mut define = |left: &str, terms: Vec<(f64, String)>| {
                let left = left.to_owned();
                symbols.push(Definition { left, terms });
            };
            match &acting.kind {
                Action::Spring(line, ..) | Action::Push(line, _) => {
                    let length = format!("l_{{{index}}}");
                    let force = format!("F_{{{index}}}");
                    let mut square = Waves::default();
                    square.add_product(1.0, &value(line), &value(line));
                    define(&format!("{length}^{{2}}"), self.terms(&square));
                    let mut rate = Vec::new();
                    let sign = if matches!(acting.kind, Action::Push(..)) {
                        1.0
                    } else {
                        -1.0
                    };
                    for (i, own) in applied.iter_mut().enumerate() {
                        let mut waves = Waves::default();
                        waves.add_product(1.0, &value(line), &slope(line, i));
                        let arm = format!("w_{{{index},{}}}", i + 1);
                        let Some(entry) = self.entry(arm.clone(), &waves) else {
                            continue;
                        };
                        define(&arm, entry.terms);
                        rate.push((1.0, format!("{arm}\\,{}", linkage.coordinates[i].rate())));
                        own.push((sign, format!("\\frac{{{force}}}{{{length}}}\\,{arm}")));
                    }
                    match &acting.kind {
                        Action::Spring(_, [stiffness, damping], free) => {
                            let free = minus(&of_time(free));
                            let speed = format!("w_{{{index}}}");
                            if *damping != 0.0 {
                                define(&speed, rate);
                            }
                            let damped = format!("\\frac{{{speed}}}{{{length}}}");
                            let stretch = format!("({length}{free})");
                            let terms = [(*stiffness, stretch), (*damping, damped)];
                            define(&force, products(&terms));
                        }
                        Action::Push(_, push) => define(&force, of_time(push)),
                        Action::Torsion(..) | Action::Force(..) | Action::Torque(..) => {}
                    }
                }
                Action::Torsion(twist, [stiffness, damping], free) => {
                    let torque = format!("T_{{{index}}}");
                    let part = |symbol: fn(&Coordinate) -> String| {
                        let row = twist.row.iter();
                        row.map(|&(k, sign)| (sign, symbol(&linkage.coordinates[k])))
                            .collect::<Vec<_>>()
                    };
                    let mut angle = part(Coordinate::symbol);
                    if twist.constant != 0.0 {
                        angle.push((twist.constant.signum(), number(twist.constant.abs())));
                    }
                    let stretch = format!("({}{})", joined(&angle), minus(&of_time(free)));
                    let rate = format!("({})", joined(&part(Coordinate::rate)));
                    define(
                        &torque,
                        products(&[(*stiffness, stretch), (*damping, rate)]),
                    );
                    for &(k, sign) in &twist.row {
                        applied[k].push((-sign, torque.clone()));
                    }
                }
                Action::Force(place, laws, turn) => {
                    for (axis, (word, law)) in ["X", "Y"].into_iter().zip(laws).enumerate() {
                        if law.constant() == Some(0.0) {
                            continue;
                        }
                        let force = format!("{word}_{{{index}}}");
                        define(&force, of_time(law));
                        let unit: Plane = [[1.0, 0.0], [0.0, 1.0]][axis];
                        let direction = [TurnedVector {
                            amplitude: turned(unit, turn.offset),
                            angle: turn.angle,
                            factors: Vec::new(),
                        }];
                        for (i, own) in applied.iter_mut().enumerate() {
                            let mut waves = Waves::default();
                            waves.add_product(1.0, &direction, &slope(place, i));
                            let terms = self.terms(&waves).into_iter();
                            own.extend(terms.map(|(sign, term)| {
                                let all = match term.as_str() {
                                    "1" => force.clone(),
                                    term => format!("{force}\\,{term}"),
                                };
                                (sign, all)
                            }));
                        }
                    }
                }
                Action::Torque(row, law) => {
                    let torque = format!("T_{{{index}}}");
                    define(&torque, of_time(law));
                    for &(k, sign) in row {
                        applied[k].push((sign, torque.clone()));
                    }
                }
            }
        }
        let applied = applied
            .into_iter()
            .enumerate()
            .map(|(i, terms)| Definition {
                left: format!("Q_{{{}}}", i + 1),
                terms,
            });
        let applied: Vec<Definition> = applied.collect();
        format!(
            "\\section*{{Applied forces}}\n{}Generalised forces:\n{}",
            aligned(&symbols),
            aligned(&applied)
        )
    }

    /// Loops and drivers.
    fn constraints(&self) -> String {
        let linkage = &self.linkage;
        let (mut gaps, mut slopes, mut gammas) = (Vec::new(), Vec::new(), Vec::new());
        for (k, closure) in linkage.closures.iter().enumerate() {
            for (axis, unit) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                let row = 2 * k + axis + 1;
                let along = |by: f64, vectors: &[TurnedVector]| {
                    let mut waves = Waves::default();
                    waves.add_product(by, &constant(unit), vectors);
                    waves
                };
                let gap = self.terms(&along(1.0, &value(&closure.gap)));
                gaps.push(Definition {
                    left: format!("g_{{{row}}}"),
                    terms: [gap, vec![(0.0, String::new())]].concat(),
                });
                for i in 0..linkage.coordinates.len() {
                    let waves = along(1.0, &slope(&closure.gap, i));
                    slopes.extend(self.entry(format!("J_{{{row},{}}}", i + 1), &waves));
                }
                let waves = along(-1.0, &bend(&closure.gap));
                gammas.extend(self.entry(format!("\\gamma_{{{row}}}"), &waves));
            }
        }
        let drives = linkage.drives.iter().map(|drive| {
            let row = drive.row.iter();
            let row = row.map(|&(k, sign)| (sign, linkage.coordinates[k].symbol()));
            Definition {
                left: joined(&row.collect::<Vec<_>>()),
                terms: of_time(&drive.law),
            }
        });
        let drives: Vec<Definition> = drives.collect();
        let mut text = "\\section*{Loops and drivers}\n".to_owned();
        if !gaps.is_empty() {
            let names = linkage.closures.iter().map(|own| escaped(&own.joint));
            let names: Vec<String> = names.collect();
            text += &format!(
                "Loops close at {}, two equations each:\n{}",
                names.join(", "),
                aligned(&gaps)
            );
            text += &format!(
                "Their derivatives $J = \\partial g/\\partial p$, as far as these are not zero:\n{}",
                aligned(&slopes)
            );
            text += &format!("and $\\gamma = J\\,\\ddot p$:\n{}", aligned(&gammas));
        }
        if !drives.is_empty() {
            text += &format!("Drivers prescribe\n{}", aligned(&drives));
        }
        text
    }

    fn motion(&self, is_open: bool) -> String {
        if is_open {
            return "\\section*{Motion}\n\\begin{align*}\nM\\,\\ddot p + h &= Q\n\\end{align*}\n"
                .into();
        }
        let free = self
            .independent
            .iter()
            .map(|&k| self.linkage.coordinates[k].symbol());
        let free: Vec<String> = free.collect();
        let independent = match free.as_slice() {
            [] => {
                "There is no independent coordinate: the drivers determine the motion.".to_owned()
            }
            _ => format!("Independent coordinates are $u = ({})$.", free.join(",\\ ")),
        };
        format!(
            "\\section*{{Motion}}\n{independent} With the rows $G$ of drivers $f$ and of $u$, and $K = \\begin{{bmatrix}} J \\\\ G \\end{{bmatrix}}$,\n\
             \\begin{{align*}}\nK\\,\\dot p &= (0,\\ \\dot f,\\ \\dot u), & K\\,\\ddot p &= (\\gamma,\\ \\ddot f,\\ \\ddot u),\\\\\n\
             \\ddot p &= R\\,\\ddot u + c, & R &= K^{{-1}}(0,\\ 0,\\ 1), \\quad c = K^{{-1}}(\\gamma,\\ \\ddot f,\\ 0),\\\\\n\
             R^T M R\\,\\ddot u &= R^T(Q - h - M c), & M\\,\\ddot p + h &= Q + K^T(\\lambda,\\ e,\\ 0),\n\\end{{align*}}\n\
             where $e$ is what the drivers exert (J.~Garc\\'ia de Jal\\'on and E.~Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994).\n"
        )
    }

    /// What was computed otherwise at the start.
    fn check(&self) -> String {
        let bodies = self.linkage.bodies.iter().zip(&self.accelerations);
        let rows = bodies.map(|(body, ([x, y], alpha))| {
            let [x, y, alpha] = [*x, *y, *alpha].map(number);
            format!("{} & ${x}$ & ${y}$ & ${alpha}$ \\\\\n", escaped(&body.name))
        });
        let bodies = table(
            "lrrr",
            "body & $a_x$ [m/s$^2$] & $a_y$ [m/s$^2$] & $\\alpha$ [rad/s$^2$]",
            rows.collect(),
        );
        let efforts = self.linkage.drives.iter().zip(&self.efforts);
        let efforts = efforts.map(|(drive, effort)| {
            format!(
                "The driver {} exerts ${}$ (N\\,m or N).\n",
                escaped(&drive.name),
                number(*effort)
            )
        });
        let efforts: String = efforts.collect();
        format!(
            "\\section*{{Check}}\nAt $t=0$ linkdyn computed these accelerations of the centres of mass, and angular ones:\n{bodies}{efforts}\n"
        )
    }

    /// A symbol and its waves; none of zero.
    fn entry(&self, left: String, waves: &Waves) -> Option<Definition> {
        let terms = self.terms(waves);
        (!terms.is_empty()).then_some(Definition { left, terms })
    }

    fn terms(&self, waves: &Waves) -> Vec<(f64, String)> {
        waves.terms().map(|wave| self.term(wave)).collect()
    }

    /// A wave: its sign, and its text.
    fn term(&self, wave: &Wave) -> (f64, String) {
        let coordinates = &self.linkage.coordinates;
        let symbol = |k: usize| coordinates[k].symbol();
        let mut factors = Vec::new();
        let mut rest = wave.factors.as_slice();
        while let Some(&factor) = rest.first() {
            let power = rest.iter().take_while(|other| **other == factor).count();
            let name = match factor {
                Factor::Value(k) => symbol(k),
                Factor::Rate(k) => coordinates[k].rate(),
            };
            factors.push(match power {
                1 => name,
                power => format!("{name}^{{{power}}}"),
            });
            rest = &rest[power..];
        }
        let [x, y] = wave.amplitude;
        let angle = match (wave.plus, wave.minus) {
            (Some(plus), Some(minus)) => Some(format!("{}-{}", symbol(plus), symbol(minus))),
            (Some(plus), None) => Some(symbol(plus)),
            (None, _) => None,
        };
        let phase = y.atan2(x);
        let quarter = (phase / FRAC_PI_2).round();
        let is_right = (phase - quarter * FRAC_PI_2).abs() < RIGHT;
        let (sign, size, wave) = match angle {
            None => (x.signum(), x.abs(), None),
            Some(angle) if is_right => {
                let (sign, word) = match quarter as i32 {
                    0 => (1.0, "cos"),
                    1 => (-1.0, "sin"),
                    -1 => (1.0, "sin"),
                    _ => (-1.0, "cos"),
                };
                (sign, x.hypot(y), Some(format!("\\{word}({angle})")))
            }
            Some(angle) => {
                let operator = if phase < 0.0 { "-" } else { "+" };
                let phase = number(phase.abs());
                (
                    1.0,
                    x.hypot(y),
                    Some(format!("\\cos({angle}{operator}{phase})")),
                )
            }
        };
        factors.extend(wave);
        (sign, scaled(size, &factors))
    }
}

impl Coordinate {
    /// Its symbol.
    fn symbol(&self) -> String {
        self.with("\\varphi", "s", "x", "y")
    }

    /// That of its rate.
    fn rate(&self) -> String {
        self.with("\\dot{\\varphi}", "\\dot{s}", "\\dot{x}", "\\dot{y}")
    }

    fn with(&self, angle: &str, slide: &str, x: &str, y: &str) -> String {
        let letter = match self.kind {
            CoordinateKind::Angle => angle,
            CoordinateKind::Slide => slide,
            CoordinateKind::Free(0) => x,
            CoordinateKind::Free(_) => y,
        };
        format!("{letter}_{{\\text{{{}}}}}", escaped(&self.of))
    }
}

/// A positive number times factors; 1 is not written where there are some.
fn scaled(size: f64, factors: &[String]) -> String {
    let size = match size {
        1.0 if !factors.is_empty() => None,
        size => Some(number(size)),
    };
    let all: Vec<String> = size.into_iter().chain(factors.iter().cloned()).collect();
    all.join("\\,")
}

/// Numbers times texts; zeros are left out.
fn products(terms: &[(f64, String)]) -> Vec<(f64, String)> {
    let terms = terms.iter().filter(|(factor, _)| *factor != 0.0);
    terms
        .map(|(factor, text)| {
            (
                factor.signum(),
                scaled(factor.abs(), std::slice::from_ref(text)),
            )
        })
        .collect()
}

/// A law of time.
fn of_time(law: &TimeLaw) -> Vec<(f64, String)> {
    let power = |power: usize| match power {
        0 => Vec::new(),
        1 => vec!["t".to_owned()],
        power => vec![format!("t^{{{power}}}")],
    };
    let terms = match law {
        TimeLaw::Polynomial(coefficients) => {
            let terms = coefficients.iter().enumerate();
            terms.map(|(k, c)| (*c, power(k))).collect()
        }
        TimeLaw::Harmonic([offset, amplitude, rate, phase]) => {
            let angle = products(&[(*rate, "t".into()), (phase.signum(), number(phase.abs()))]);
            let wave = format!("\\sin({})", joined(&angle));
            vec![(*offset, Vec::new()), (*amplitude, vec![wave])]
        }
    };
    let terms = terms.into_iter().filter(|(factor, _)| *factor != 0.0);
    terms
        .map(|(factor, rest)| (factor.signum(), scaled(factor.abs(), &rest)))
        .collect()
}

/// Terms in a row.
fn joined(terms: &[(f64, String)]) -> String {
    let mut text = String::new();
    for (index, (sign, term)) in terms.iter().enumerate() {
        text += match (index, *sign < 0.0) {
            (0, false) => "",
            (_, true) => "-",
            (_, false) => "+",
        };
        text += term;
    }
    if text.is_empty() {
        text = "0".into();
    }
    text
}

/// Terms that are subtracted from something; nothing where there are none.
fn minus(terms: &[(f64, String)]) -> String {
    let negative: Vec<_> = terms
        .iter()
        .map(|(sign, term)| (-sign, term.clone()))
        .collect();
    match negative.first() {
        None => String::new(),
        Some((sign, _)) if *sign < 0.0 => joined(&negative),
        Some(_) => format!("+{}", joined(&negative)),
    }
}

/// Equations below each other; a sign of zero ends one with "= 0".
fn aligned(definitions: &[Definition]) -> String {
    if definitions.is_empty() {
        return "none.\n\n".into();
    }
    let lines = definitions.iter().map(|own| {
        let (zero, terms): (Vec<_>, Vec<_>) = own
            .terms
            .iter()
            .cloned()
            .partition(|(sign, _)| *sign == 0.0);
        let mut text = format!("{} &= ", own.left);
        let mut line = seen(&text);
        for (index, (sign, term)) in terms.iter().enumerate() {
            let width = seen(term);
            line += width;
            if index > 0 && line > WIDTH {
                text += "\\\\\n&\\quad ";
                line = width;
            }
            text += match (index, *sign < 0.0) {
                (0, false) => "",
                (_, true) => "-",
                (_, false) => "+",
            };
            text += term;
        }
        if terms.is_empty() {
            text += "0";
        }
        if !zero.is_empty() {
            text += " = 0";
        }
        text
    });
    let lines: Vec<String> = lines.collect();
    format!(
        "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        lines.join("\\\\\n")
    )
}

/// About how many characters of a formula are seen: a command is one, and braces are none.
fn seen(formula: &str) -> usize {
    let mut count = 0;
    let mut is_command = false;
    for c in formula.chars() {
        is_command = c == '\\' || (is_command && c.is_ascii_alphabetic());
        count += usize::from(c == '\\' || !(is_command || "{}_^".contains(c)));
    }
    count
}

fn table(columns: &str, head: &str, rows: Vec<String>) -> String {
    format!(
        "\\begin{{center}}\n\\begin{{tabular}}{{{columns}}}\n{head} \\\\\n\\hline\n{}\\end{{tabular}}\n\\end{{center}}\n",
        rows.concat()
    )
}

/// A number with ten digits.
fn number(value: f64) -> String {
    let scientific = format!("{value:.9e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or_default();
    if (-4..6).contains(&exponent) {
        let rounded: f64 = scientific.parse().unwrap_or(value);
        // −0 becomes 0.
        return format!("{}", rounded + 0.0);
    }
    if value == 0.0 {
        return "0".into();
    }
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    format!("{digits}\\cdot 10^{{{exponent}}}")
}

/// A text as LaTeX sets it; letters that its fonts lack stand by their numbers.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '\\' => escaped += "\\textbackslash{}",
            '^' => escaped += "\\textasciicircum{}",
            '~' => escaped += "\\textasciitilde{}",
            '<' => escaped += "\\textless{}",
            '>' => escaped += "\\textgreater{}",
            '|' => escaped += "\\textbar{}",
            '"' => escaped += "''",
            '{' | '}' | '$' | '&' | '#' | '_' | '%' => {
                escaped.push('\\');
                escaped.push(c);
            }
            ' '..='~' => escaped.push(c),
            'Ð' | 'Þ' | 'ð' | 'þ' | '×' | '÷' => escaped += &format!("U+{:04X}", c as u32),
            'À'..='ÿ' => escaped.push(c),
            c if c.is_control() => escaped.push(' '),
            c => escaped += &format!("U+{:04X}", c as u32),
        }
    }
    escaped
}
