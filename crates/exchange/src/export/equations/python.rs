//! The equations as a module of Python that needs NumPy alone.

use std::collections::BTreeSet;

use super::law::TimeLaw;
use super::linkage::{Acting, Action, Coordinate, CoordinateKind, Drive, Linkage, MovingBody};
use super::place::{Place, Plane, turned};
use super::program::{SignedSum, list, number, numbers, plain, quoted, words};
use super::start::Equations;

/// Strides of drivers and independent coordinates between positions \[rad, or parts of the mechanism's length\]: short enough for
/// Newton's iteration to stay on its branch where loops are not near a dead centre.
const STRIDE: f64 = 0.1;
/// After such a step of Newton's iteration, which converges quadratically, the next one is round-off \[rad, or the same\].
const CLOSED: f64 = 1e-9;

/// A name in a function for a coordinate, its rate, or its direction exp(iφ).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Local {
    Value(usize),
    Direction(usize),
    Rate(usize),
}

/// A function in the making.
struct Function<'l> {
    linkage: &'l Linkage,
    used: BTreeSet<Local>,
    body: String,
}

impl Equations {
    /// The module.
    pub fn python(&self) -> String {
        let linkage = &self.linkage;
        let mut taken = linkage.taken.clone();
        let mut constants = String::new();
        let bodies = self.bodies(&mut constants, &mut |words| taken.constant(words));
        let forces = linkage.forces(&mut constants, &mut |words| taken.constant(words));
        let is_open = linkage.closures.is_empty() && linkage.drives.is_empty();
        let mut functions = vec![include_str!("shared.py").to_owned()];
        functions.extend(linkage.places());
        if linkage.forces.iter().any(Acting::has_line) {
            functions.push(STRETCH.into());
        }
        functions.push(forces);
        if is_open {
            functions.push(include_str!("open.py").into());
        } else {
            functions.extend(linkage.loops());
            functions.push(linkage.drive());
            functions.push(include_str!("closed.py").into());
        }
        functions.push(include_str!("asked.py").into());
        let head = self.preamble(is_open);
        let state = self.state(&bodies, is_open);
        format!(
            "{head}{}{constants}{state}\n\n{}",
            linkage.vector_lines(),
            functions.join("\n\n")
        )
    }

    fn preamble(&self, is_open: bool) -> String {
        let linkage = &self.linkage;
        let gravity = format!(
            "complex({}, {})",
            number(linkage.gravity[0]),
            number(linkage.gravity[1])
        );
        let equations = if is_open { OPEN } else { CLOSED_LOOPS };
        let coordinates = linkage.coordinates.iter().enumerate().map(|(k, own)| {
            let is_free = self.independent.contains(&k);
            let free = if is_free { ", independent" } else { "" };
            format!(
                "    {:<16}{}{free}\n",
                own.identifier,
                plain(&own.about(&format!("{:?}", own.of)))
            )
        });
        let coordinates: String = coordinates.collect();
        format!(
            "\"\"\"Equations of motion of {} in minimal coordinates, written by linkdyn.\n\n\
             SI units, angles in radians. Vectors of the plane are complex numbers x + iy. Coordinates p:\n\n\
             {coordinates}{equations}\"\"\"\n\nimport numpy as np\n\n\
             # Acceleration of gravity [m/s^2].\nGRAVITY = {gravity}\n",
            plain(&format!("{:?}", linkage.name))
        )
    }

    /// Constants of the bodies; the names of their masses and moments of inertia.
    fn bodies(
        &self,
        text: &mut String,
        name: &mut dyn FnMut(&[&str]) -> String,
    ) -> [Vec<String>; 2] {
        let mut names = [Vec::new(), Vec::new()];
        *text += "\n# Masses [kg] and moments of inertia about the centres of mass [kg m^2].\n";
        for body in &self.linkage.bodies {
            for (k, (word, value)) in [("mass", body.mass), ("inertia", body.inertia)]
                .into_iter()
                .enumerate()
            {
                let name = name(&[&body.name, word]);
                *text += &format!("{name} = {}  # {}\n", number(value), plain(&body.name));
                names[k].push(name);
            }
        }
        names
    }

    /// Tables: bodies, coordinates, drivers, and the start.
    fn state(&self, [masses, inertias]: &[Vec<String>; 2], is_open: bool) -> String {
        let linkage = &self.linkage;
        let count = linkage.coordinates.len();
        let mut text = String::new();
        let mut add = |line: String| text.push_str(&line);
        let array =
            |items: &[SignedSum], name: &str| list(items, 0, &format!("{name} = np.array("), ")");
        let unit = |row: &[(usize, f64)]| {
            let mut all = vec![0.0; count];
            row.iter().for_each(|&(k, factor)| all[k] = factor);
            numbers(all)
        };
        let matrix = |rows: &[Vec<SignedSum>], name: &str| {
            let rows = rows.iter().map(|row| list(row, 4, "", ","));
            format!("{name} = np.array([\n{}])\n", rows.collect::<String>())
        };
        add("\n# Bodies in this order; their angles are TURNS @ p + OFFSETS.\n".into());
        let named = |names: &mut dyn Iterator<Item = &String>, name: &str| {
            list(
                &words(names.map(|name| quoted(name))),
                0,
                &format!("{name} = "),
                "",
            )
        };
        add(named(
            &mut linkage.bodies.iter().map(|body| &body.name),
            "BODIES",
        ));
        add(array(&words(masses.iter().cloned()), "MASSES"));
        add(array(&words(inertias.iter().cloned()), "INERTIAS"));
        let turns = linkage.bodies.iter().map(|body| {
            let row = body.turn.angle.map(|angle| (angle, 1.0));
            unit(row.as_slice())
        });
        add(matrix(&turns.collect::<Vec<_>>(), "TURNS"));
        let offsets = linkage.bodies.iter().map(|body| body.turn.offset);
        add(array(&numbers(offsets), "OFFSETS"));
        add(
            "\n# Coordinates p, the numbers of the independent ones u among them, and drivers.\n"
                .into(),
        );
        let identifiers = linkage.coordinates.iter().map(|own| &own.identifier);
        add(named(&mut identifiers.into_iter(), "COORDINATES"));
        let independent = self.independent.iter().map(usize::to_string);
        let independent = words(independent);
        add(list(
            &independent,
            0,
            "INDEPENDENT = np.array(",
            ", dtype=int)",
        ));
        add(named(
            &mut linkage.drives.iter().map(|drive| &drive.name),
            "DRIVERS",
        ));
        if !is_open {
            let drives = linkage.drives.iter().map(|drive| unit(&drive.row));
            let free = self.independent.iter().map(|&k| unit(&[(k, 1.0)]));
            add("# Rows of drivers and independent coordinates.\n".into());
            add(matrix(&drives.chain(free).collect::<Vec<_>>(), "GIVEN"));
            add("# What is large: a radian, or the length of the mechanism [m].\n".into());
            add(array(&numbers(self.scales.iter().copied()), "SCALES"));
            add(
                "# Strides of drivers and independent coordinates; where Newton's steps end.\n"
                    .into(),
            );
            add(format!(
                "STRIDE, MOST_STRIDES = {}, 100_000\n",
                number(STRIDE)
            ));
            add(format!("CLOSED, MOST_STEPS = {}, 20\n", number(CLOSED)));
        }
        add("\n# Assembled at t = 0: coordinates and rates; what linkdyn computed there.\n".into());
        add(array(&numbers(self.start.iter().copied()), "START"));
        add(array(&numbers(self.rates.iter().copied()), "START_RATES"));
        let complex = |[x, y]: Plane| format!("complex({}, {})", number(x), number(y));
        let accelerations = self.accelerations.iter().map(|(a, _)| complex(*a));
        add(array(&words(accelerations), "START_ACCELERATIONS"));
        let alphas = self.accelerations.iter().map(|(_, alpha)| *alpha);
        add(array(&numbers(alphas), "START_TURNS"));
        add(array(
            &numbers(self.efforts.iter().copied()),
            "START_EFFORTS",
        ));
        text
    }
}

const OPEN: &str = "
All are independent, p = u, and the equations are

    M(p) ddp + h(p, dp) = Q(p, dp, t)
";

const CLOSED_LOOPS: &str = "
With independent coordinates u and drivers f the equations are

    g(p) = 0,  G p = (f(t), u)                      loops, drivers and independent coordinates
    K dp = (0, df, du),  K ddp = (gamma, ddf, ddu)  K = [dg/dp; G]
    M ddp + h = Q + K^T (lambda, e, 0)              e: what the drivers exert
    R^T M R ddu = R^T (Q - h - M c)                 ddp = R ddu + c,  R = K^-1 (0, 0, 1)

(J. Garcia de Jalon and E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994).
";

const STRETCH: &str = r#"def stretch(line, slope):
    """Length of a line, and its derivatives by the coordinates; a line without length has none."""
    length = abs(line)
    if length == 0.0:
        return length, np.zeros(len(slope))
    return length, dot(line / length, slope)
"#;

impl Coordinate {
    /// What it is, in words with its name.
    pub fn about(&self, name: &str) -> String {
        match self.kind {
            CoordinateKind::Angle => format!("angle of {name} [rad]"),
            CoordinateKind::Slide => format!("slide of joint {name} [m]"),
            CoordinateKind::Free(0) => format!("x of the centre of mass of {name} [m]"),
            CoordinateKind::Free(_) => format!("y of the centre of mass of {name} [m]"),
        }
    }
}

impl Acting {
    /// Whether it acts along a line.
    fn has_line(&self) -> bool {
        match self.kind {
            Action::Spring(..) | Action::Push(..) => true,
            Action::Torsion(..) | Action::Force(..) | Action::Torque(..) => false,
        }
    }
}

impl Linkage {
    /// Constant vectors.
    fn vector_lines(&self) -> String {
        let mut text =
            "\n# Vectors in the frames that turn with the coordinates [m]; directions [1].\n"
                .to_owned();
        for own in self.vectors.iter().filter(|own| !own.identifier.is_empty()) {
            let [x, y] = own.value.map(number);
            text += &format!(
                "{} = complex({x}, {y})  # {}\n",
                own.identifier,
                plain(&own.about)
            );
        }
        text
    }

    fn function(&self) -> Function<'_> {
        Function {
            linkage: self,
            used: BTreeSet::new(),
            body: String::new(),
        }
    }

    /// Functions of points and centres of mass.
    fn places(&self) -> Vec<String> {
        let centres: Vec<&Place> = self.bodies.iter().map(|body| &body.centre).collect();
        let mut function = self.function();
        let points = self.bodies.iter().flat_map(|body: &MovingBody| {
            let named = body.points.iter();
            named.map(|(point, place)| (format!("{}.{point}", body.name), place))
        });
        let points: Vec<_> = points.collect();
        function.body += "    return {\n";
        for (name, place) in points {
            let sum = function.value(place);
            function.body += &sum.lines(8, &format!("{}: ", quoted(&name)), ",");
        }
        function.body += "    }\n";
        vec![
            function.text("points(p)", "Points of the bodies [m]."),
            self.function().values(
                "centres(p)",
                "Centres of mass [m].",
                &centres,
                ["np.array(", ")"],
            ),
            self.function().slopes(
                "slopes(p)",
                "Derivatives of centres by the coordinates, a row for each body [m/rad, 1].",
                &centres,
                ["np.array([", "])"],
            ),
            self.function().bends(
                "bends(p, dp)",
                "Accelerations of the centres of mass at constant rates [m/s^2].",
                &centres,
                ["np.array(", ")"],
            ),
        ]
    }

    /// Functions of the loops.
    fn loops(&self) -> Vec<String> {
        let gaps: Vec<&Place> = self.closures.iter().map(|own| &own.gap).collect();
        if gaps.is_empty() {
            let count = self.coordinates.len();
            return vec![
                "def closures(p):\n    \"\"\"There is no loop.\"\"\"\n    return np.zeros(0)\n"
                    .into(),
                format!(
                    "def jacobian(p):\n    \"\"\"There is no loop.\"\"\"\n    return np.zeros((0, {count}))\n"
                ),
                "def gamma(p, dp):\n    \"\"\"There is no loop.\"\"\"\n    return np.zeros(0)\n"
                    .into(),
            ];
        }
        let joints: Vec<String> = self.closures.iter().map(|own| plain(&own.joint)).collect();
        let closures = format!(
            "What closes the loops where it is zero, at {} [m].",
            joints.join(", ")
        );
        vec![
            PARTS.into(),
            self.function()
                .values("closures(p)", &closures, &gaps, ["parts(np.array(", "))"]),
            self.function().slopes(
                "jacobian(p)",
                "Derivatives of closures by the coordinates [m/rad, 1].",
                &gaps,
                ["parts(np.array([", "]))"],
            ),
            self.function().bends(
                "gamma(p, dp)",
                "jacobian @ ddp, from the second derivative of closures [m/s^2].",
                &gaps,
                ["-parts(np.array(", "))"],
            ),
        ]
    }

    /// The function of the drivers.
    fn drive(&self) -> String {
        let laws: Vec<&TimeLaw> = self.drives.iter().map(|drive: &Drive| &drive.law).collect();
        let mut function = self.function();
        if laws.is_empty() {
            function.body += "    return np.zeros((3, 0))\n";
            return function.text(
                "drive(t)",
                "There is no driver: motions, rates and accelerations.",
            );
        }
        let mut rows = laws.into_iter().cloned().collect::<Vec<_>>();
        function.body += "    return np.array([\n";
        for _ in 0..3 {
            let sums: Vec<SignedSum> = rows.iter().map(of_time).collect();
            function.body += &list(&sums, 8, "", ",");
            rows = rows.iter().map(TimeLaw::derivative).collect();
        }
        function.body += "    ])\n";
        function.text(
            "drive(t)",
            "Motions of the drivers [rad, m], rates and accelerations.",
        )
    }

    /// Constants of the forces, and their function.
    fn forces(&self, constants: &mut String, name: &mut dyn FnMut(&[&str]) -> String) -> String {
        let mut function = self.function();
        function.body += match self.gravity {
            [0.0, 0.0] => "    q = np.zeros(len(p))\n",
            _ => "    q = (np.conj(slopes(p)).T @ (MASSES * GRAVITY)).real\n",
        };
        if !self.forces.is_empty() {
            *constants += "\n# Springs and loads.\n";
        }
        for acting in &self.forces {
            let own = plain(&acting.name);
            function.body += &format!("    # {own}\n");
            let mut constant = |word: &str, unit: &str, value: String| {
                let name = name(&[&acting.name, word]);
                *constants += &format!("{name} = {value}  # {own} [{unit}]\n");
                name
            };
            // A law as a factor: by its name where it is constant.
            let mut law = |law: &TimeLaw, word: &str, unit: &str| match law.constant() {
                Some(value) => constant(word, unit, number(value)),
                None => of_time(law).enclosed(),
            };
            match &acting.kind {
                Action::Spring(line, [stiffness, damping], free) => {
                    function.line(line);
                    let mut pull = SignedSum::default();
                    if *stiffness != 0.0 {
                        let free = law(free, "free_length", "m");
                        let stiffness = constant("stiffness", "N/m", number(*stiffness));
                        pull.add(1.0, &[&stiffness, &format!("(length - {free})")]);
                    }
                    if *damping != 0.0 {
                        let damping = constant("damping", "N s/m", number(*damping));
                        pull.add(1.0, &[&damping, "(along @ dp)"]);
                    }
                    function.body += &pull.lines(4, "pull = ", "");
                    function.body += "    q -= pull * along\n";
                }
                Action::Push(line, push) => {
                    let push = law(push, "force", "N");
                    function.line(line);
                    function.body += &format!("    q += {push} * along\n");
                }
                Action::Torsion(twist, ..) if twist.row.is_empty() => {
                    function.body += "    # acts on bodies that do not turn against each other.\n";
                }
                Action::Torsion(twist, [stiffness, damping], free) => {
                    let mut torque = SignedSum::default();
                    let sum = |function: &mut Function, local: fn(usize) -> Local| {
                        let mut sum = SignedSum::default();
                        for &(k, sign) in &twist.row {
                            sum.add(sign, &[&function.local(local(k))]);
                        }
                        sum
                    };
                    if *stiffness != 0.0 {
                        let free = law(free, "free_angle", "rad");
                        let mut angle = sum(&mut function, Local::Value);
                        angle.add_number(twist.constant, &[]);
                        let stiffness = constant("stiffness", "N m/rad", number(*stiffness));
                        torque.add(1.0, &[&stiffness, &format!("({} - {free})", angle.text())]);
                    }
                    if *damping != 0.0 {
                        let rate = sum(&mut function, Local::Rate).enclosed();
                        let damping = constant("damping", "N m s/rad", number(*damping));
                        torque.add(1.0, &[&damping, &rate]);
                    }
                    function.body += &torque.lines(4, "torque = ", "");
                    function.torque(&twist.row, -1.0, "torque");
                }
                Action::Force(place, [x, y], turn) => {
                    let vector = match (x.constant(), y.constant()) {
                        (Some(x), Some(y)) => {
                            let [x, y] = turned([x, y], turn.offset).map(number);
                            constant("force", "N", format!("complex({x}, {y})"))
                        }
                        _ => {
                            for (name, law) in [("push_x", x), ("push_y", y)] {
                                let line = of_time(law).lines(4, &format!("{name} = "), "");
                                function.body += &line;
                            }
                            let offset = number(turn.offset);
                            match turn.offset {
                                0.0 => "complex(push_x, push_y)".to_owned(),
                                _ => format!("complex(push_x, push_y) * np.exp(1j * {offset})"),
                            }
                        }
                    };
                    let vector = match turn.angle {
                        None => vector,
                        Some(k) => format!("{vector} * {}", function.local(Local::Direction(k))),
                    };
                    let slopes = function.slopes_of(place);
                    function.body += &list(&slopes, 4, "slope = np.array(", ")");
                    function.body += &format!("    q += dot(slope, {vector})\n");
                }
                Action::Torque(row, value) => {
                    let value = law(value, "torque", "N m");
                    function.torque(row, 1.0, &value);
                }
            }
        }
        function.body += "    return q\n";
        function.text(
            "forces(p, dp, t)",
            "Q: what gravity, springs and loads exert on the coordinates [N m, N].",
        )
    }
}

const PARTS: &str = r#"def parts(z):
    """Real parts of complex rows, then imaginary ones."""
    return np.concatenate([z.real, z.imag])
"#;

/// A law of time as a sum.
fn of_time(law: &TimeLaw) -> SignedSum {
    let mut sum = SignedSum::default();
    match law {
        TimeLaw::Polynomial(coefficients) => {
            for (power, c) in coefficients.iter().enumerate() {
                match power {
                    0 => sum.add_number(*c, &[]),
                    1 => sum.add_number(*c, &["t"]),
                    _ => sum.add_number(*c, &[&format!("t**{power}")]),
                }
            }
        }
        TimeLaw::Harmonic([offset, amplitude, rate, phase]) => {
            sum.add_number(*offset, &[]);
            let mut angle = SignedSum::default();
            angle.add_number(*rate, &["t"]);
            angle.add_number(*phase, &[]);
            sum.add_number(*amplitude, &[&format!("np.sin({})", angle.text())]);
        }
    }
    sum
}

impl Function<'_> {
    /// The name of something, which then stands in the function.
    fn local(&mut self, local: Local) -> String {
        self.used.insert(local);
        let name = |k: usize| self.linkage.coordinates[k].identifier.as_str();
        match local {
            Local::Value(k) => name(k).to_owned(),
            Local::Rate(k) => format!("d{}", name(k)),
            Local::Direction(k) => format!("e{}", name(k).trim_start_matches("phi")),
        }
    }

    /// With its head and the names that it uses.
    fn text(mut self, head: &str, about: &str) -> String {
        let mut names = String::new();
        for local in std::mem::take(&mut self.used) {
            let name = self.local(local);
            names += &match local {
                Local::Value(k) => format!("    {name} = p[{k}]\n"),
                Local::Rate(k) => format!("    {name} = dp[{k}]\n"),
                Local::Direction(k) => format!("    {name} = np.exp(1j * p[{k}])\n"),
            };
        }
        format!("def {head}:\n    \"\"\"{about}\"\"\"\n{names}{}", self.body)
    }

    fn values(mut self, head: &str, about: &str, places: &[&Place], around: [&str; 2]) -> String {
        let sums: Vec<SignedSum> = places.iter().map(|place| self.value(place)).collect();
        self.body += &list(&sums, 4, &format!("return {}", around[0]), around[1]);
        self.text(head, about)
    }

    fn slopes(mut self, head: &str, about: &str, places: &[&Place], around: [&str; 2]) -> String {
        let rows = places
            .iter()
            .map(|place| list(&self.slopes_of(place), 8, "", ","));
        let rows: String = rows.collect();
        self.body += &format!("    return {}\n{rows}    {}\n", around[0], around[1]);
        self.text(head, about)
    }

    fn bends(mut self, head: &str, about: &str, places: &[&Place], around: [&str; 2]) -> String {
        let sums: Vec<SignedSum> = places.iter().map(|place| self.bend(place)).collect();
        self.body += &list(&sums, 4, &format!("return {}", around[0]), around[1]);
        self.text(head, about)
    }

    /// The vector of a summand, turned.
    fn vector(&mut self, vector: usize, angle: Option<usize>) -> String {
        let name = self.linkage.vectors[vector].identifier.clone();
        match angle {
            None => name,
            Some(k) => format!("{name} * {}", self.local(Local::Direction(k))),
        }
    }

    fn value(&mut self, place: &Place) -> SignedSum {
        let mut sum = SignedSum::default();
        for one in &place.0 {
            let vector = self.vector(one.vector, one.angle);
            match one.slide {
                None => sum.add(one.sign, &[&vector]),
                Some(k) => sum.add(one.sign, &[&vector, &self.local(Local::Value(k))]),
            }
        }
        sum
    }

    fn slopes_of(&mut self, place: &Place) -> Vec<SignedSum> {
        let mut sums = vec![SignedSum::default(); self.linkage.coordinates.len()];
        for one in &place.0 {
            let vector = self.vector(one.vector, one.angle);
            if let Some(angle) = one.angle {
                let mut factors = vec!["1j".to_owned(), vector.clone()];
                factors.extend(one.slide.map(|slide| self.local(Local::Value(slide))));
                sums[angle].add(one.sign, &[&factors.join(" * ")]);
            }
            if let Some(slide) = one.slide {
                sums[slide].add(one.sign, &[&vector]);
            }
        }
        sums
    }

    fn bend(&mut self, place: &Place) -> SignedSum {
        let mut sum = SignedSum::default();
        for one in &place.0 {
            let Some(angle) = one.angle else { continue };
            let vector = self.vector(one.vector, one.angle);
            let rate = self.local(Local::Rate(angle));
            let square = format!("{rate}**2");
            match one.slide {
                None => sum.add(-one.sign, &[&vector, &square]),
                Some(slide) => {
                    let [value, speed] =
                        [Local::Value(slide), Local::Rate(slide)].map(|local| self.local(local));
                    sum.add(-one.sign, &[&vector, &value, &square]);
                    sum.add(one.sign, &["2j", &vector, &speed, &rate]);
                }
            }
        }
        sum
    }

    /// The line of a spring, and its derivatives.
    fn line(&mut self, line: &Place) {
        let value = self.value(line);
        let slopes = self.slopes_of(line);
        self.body += &value.lines(4, "line = ", "");
        self.body += &list(&slopes, 4, "slope = np.array(", ")");
        self.body += "    length, along = stretch(line, slope)\n";
    }

    /// A torque on a difference of angles.
    fn torque(&mut self, row: &[(usize, f64)], sign: f64, torque: &str) {
        for &(k, factor) in row {
            let operator = if factor * sign < 0.0 { "-=" } else { "+=" };
            self.body += &format!("    q[{k}] {operator} {torque}\n");
        }
    }
}
