//! A model as it stands, with its names, its loops and what is wrong at its place → a page.

use super::font;
use super::mechanism::{Marks, Mechanism};
use super::palette;
use super::poses::{Pose, Poses};
use super::scene::{Anchor, Ink, Item, Pen, Place, Run, Scene};
use super::shape::{PointId, Shape};
use super::symbols::rounded_hull;
use super::{sheet, svg, words};

/// Width of the drawing, size of its letters and radius of a number \[pt\].
const WIDTH: f64 = 640.0;
const LETTERS: f64 = 9.0;
const NUMBER: f64 = 7.0;
/// Loops that are drawn at once, those that are drawn on choice, and bodies up to which names are.
const MOST_LOOPS: usize = 6;
const MOST_CHOSEN: usize = 100;
const MOST_NAMES: usize = 60;
/// How far the line of a loop lies inside of it, as a part of the way to its middle.
const INSIDE: f64 = 0.22;
/// Directions around a place in which a label is tried \[pt\].
const AROUND: [[f64; 2]; 8] = [
    [1.0, -0.9],
    [-1.0, -0.9],
    [1.0, 0.9],
    [-1.0, 0.9],
    [1.5, 0.0],
    [-1.5, 0.0],
    [0.0, -1.7],
    [0.0, 1.7],
];

/// How lines of a text stand in the page.
const TEXT_RULE: &str =
    "pre { margin: 8px 0 0; white-space: pre-wrap; overflow-wrap: anywhere; }
.finding pre { margin: 4px 0 0; padding: 4px 8px; background: var(--card); border: 1px solid var(--line); border-radius: 6px; font-size: 12px; }
.line { margin-right: 12px; color: var(--muted); user-select: none; }
mark { background: none; color: var(--bad); font-weight: bold; text-decoration: underline wavy; text-underline-offset: 3px; }
.map { max-width: 34rem; margin: 16px 0 0; }
";

/// How bad something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Severity {
    /// It keeps the model from running.
    Wrong,
    /// It is allowed, and probably a slip.
    Doubt,
    /// It is good to know.
    Note,
}

/// What is said of a model.
#[derive(Debug, Clone)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// Its text.
    pub text: String,
    /// Numbers of the bodies it is about.
    pub bodies: Vec<usize>,
    /// Numbers of the joints it is about.
    pub joints: Vec<usize>,
    /// Numbers of the loops it is about.
    pub loops: Vec<usize>,
    /// Points it is about.
    pub points: Vec<PointId>,
    /// Where it stands in the file.
    pub quote: Option<Quote>,
}

/// A line of a file, in three parts, the middle one marked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Quote {
    /// Its number.
    pub line: usize,
    /// What stands before, at, and after the place.
    pub parts: [String; 3],
}

/// A loop.
#[derive(Debug, Clone)]
pub struct Loop {
    /// Its joints in order.
    pub joints: Vec<usize>,
    /// Its joints, and the bodies that it goes through.
    pub text: String,
}

/// All that is said of a model.
#[derive(Debug, Clone, Default)]
pub struct Diagnosis {
    /// Name of the model.
    pub title: String,
    /// The verdict, mobility.
    pub facts: Vec<String>,
    /// Its loops.
    pub loops: Vec<Loop>,
    /// What is wrong, the worst first.
    pub findings: Vec<Finding>,
    /// Figures below all of it, each with a text.
    pub figures: Vec<(String, Scene)>,
}

/// The page of a model in a position of all bodies, the ground first. If it can't be drawn the page has no drawing.
pub fn page(shape: Shape, pose: &[Pose], diagnosis: &Diagnosis) -> String {
    let drawing = match Mechanism::new(shape, Poses::of(&[pose.to_vec()])) {
        Ok(mechanism) => {
            let (scene, loops) = draw(&mechanism, diagnosis);
            numbered(&svg::write(&scene), &loops)
        }
        Err(fault) => format!(
            "<p>There is no drawing: {}.</p>\n",
            sheet::text(&fault.to_string())
        ),
    };
    whole_page(diagnosis, &drawing)
}

/// The page of what can't be drawn: lines of the text with their numbers, one of them marked, and the findings.
pub fn page_of_text(
    diagnosis: &Diagnosis,
    lines: &[(usize, String)],
    marked: Option<usize>,
) -> String {
    let mut text =
        String::from("<p>There is no drawing: this can't be read as a model.</p>\n<pre>");
    for (number, line) in lines {
        let sign = if marked == Some(*number) { '▸' } else { ' ' };
        text += &format!("{sign}{number:4}  {}\n", long_text(line));
    }
    whole_page(diagnosis, &(text + "</pre>\n"))
}

/// A drawing with the findings.
fn whole_page(diagnosis: &Diagnosis, drawing: &str) -> String {
    // What is wrong comes first where there is no room beside the drawing.
    let is_wrong = |finding: &Finding| matches!(finding.severity, Severity::Wrong);
    let first = match diagnosis.findings.iter().any(is_wrong) {
        true => " class=\"first\"",
        false => "",
    };
    let mut main =
        format!("<div class=\"beside\">\n<div class=\"card\">\n{drawing}</div>\n<div{first}>\n");
    main += "<h2>What was found</h2>\n";
    if diagnosis.findings.is_empty() {
        main += "<p>Nothing is wrong, and nothing looks like a slip.</p>\n";
    }
    for (index, finding) in diagnosis.findings.iter().enumerate() {
        let class = match finding.severity {
            Severity::Wrong => "wrong",
            Severity::Doubt => "doubt",
            Severity::Note => "note",
        };
        main += &format!(
            "<div class=\"finding {class}\"><span class=\"number\">{}</span><div>{}{}</div></div>\n",
            index + 1,
            long_text(&finding.text),
            finding.quote.as_ref().map_or(String::new(), quoted)
        );
    }
    if !diagnosis.loops.is_empty() {
        main += "<h2>Loops</h2>\n";
    }
    for (index, one) in diagnosis.loops.iter().enumerate() {
        main += &match index < MOST_CHOSEN {
            true => choice(index, &one.text),
            false => format!("<p>{}</p>\n", long_text(&one.text)),
        };
    }
    main += "</div>\n</div>\n";
    for (words, scene) in &diagnosis.figures {
        let drawing = svg::write(scene);
        let words = sheet::text(words);
        main += &format!(
            "<figure class=\"card map\">\n{drawing}<figcaption>{words}</figcaption>\n</figure>\n"
        );
    }
    let loops = 0..diagnosis.loops.len().min(MOST_CHOSEN);
    let rules = TEXT_RULE.to_string() + &loops.map(shown_on_choice).collect::<String>();
    sheet::styled_page(&diagnosis.title, &diagnosis.facts, &main, &rules)
}

/// A line of the file with its number, and a mark at the place.
fn quoted(quote: &Quote) -> String {
    let [before, at, after] = quote.parts.each_ref().map(|part| long_text(part));
    format!(
        "<pre><span class=\"line\">{}</span>{before}<mark>{at}</mark>{after}</pre>",
        quote.line
    )
}

/// A loop in words, with a box that shows it in the drawing; pointing at the words shows it too.
fn choice(index: usize, text: &str) -> String {
    let [r, g, b] = colour(index);
    let checked = if index < MOST_LOOPS { " checked" } else { "" };
    format!(
        "<p class=\"of-{index}\"><label><input type=\"checkbox\" id=\"show-{index}\"{checked}> \
         <svg class=\"key\" viewBox=\"0 0 22 4\"><rect width=\"22\" height=\"4\" rx=\"2\" fill=\"rgb({r},{g},{b})\"/></svg>{}</label></p>\n",
        long_text(text)
    )
}

/// The rule that hides a loop until its box or its words ask for it.
fn shown_on_choice(index: usize) -> String {
    format!(
        "main:not(:has(#show-{index}:checked,.of-{index}:hover)) #loop-{index}{{display:none}}\n"
    )
}

/// The drawing with a name for each loop.
fn numbered(svg: &str, loops: &[usize]) -> String {
    let mut parts = svg.split("class=\"loop\"");
    let mut text = parts.next().unwrap_or_default().to_string();
    for (part, index) in parts.zip(loops) {
        text += &format!("class=\"loop\" id=\"loop-{index}\"{part}");
    }
    text
}

/// Text of any length as it may stand in a page: only figures cut theirs.
fn long_text(text: &str) -> String {
    let pieces: Vec<char> = text.chars().collect();
    let pieces = pieces
        .chunks(200)
        .map(|piece| piece.iter().collect::<String>());
    pieces.map(|piece| sheet::text(&piece)).collect()
}

/// Colour of a loop.
fn colour(index: usize) -> palette::Rgb {
    palette::curve(index + 1).light
}

/// The model with all that is said of it, and the numbers of the loops that are drawn.
fn draw(mechanism: &Mechanism, diagnosis: &Diagnosis) -> (Scene, Vec<usize>) {
    let mut scene = mechanism.plain(0.0, WIDTH, None);
    let marks = mechanism.marks(0.0, WIDTH);
    scene.title = words::printable(&diagnosis.title);
    let mut drawn = Vec::new();
    for (index, one) in diagnosis.loops.iter().take(MOST_CHOSEN).enumerate() {
        drawn.extend(draw_loop(&mut scene, &marks, &one.joints, index).then_some(index));
    }
    // Pins whose halves lie apart: what does not close.
    let gap = Pen {
        dash: &[2.5, 2.0],
        ..Pen::new(Ink::new(palette::FORCE.light), 1.6)
    };
    for ([first, second], holds) in marks.joints.iter().zip(&marks.holds) {
        if *holds && (first[0] - second[0]).hypot(first[1] - second[1]) > NUMBER {
            scene.line("gap", [*first, *second], gap);
        }
    }
    let mut labels = Labels::new(&scene, &marks);
    for (index, finding) in diagnosis.findings.iter().enumerate() {
        for place in places(finding, diagnosis, &marks) {
            labels.number(&mut scene, place, index + 1, finding.severity);
        }
    }
    if marks.body_names.len() <= MOST_NAMES {
        for (name, at) in &marks.body_names {
            labels.name(&mut scene, ("body-name", name), *at, palette::INK);
        }
        for (name, [_, at]) in marks.joint_names.iter().zip(&marks.joints) {
            labels.name(&mut scene, ("joint-name", name), *at, palette::STEEL);
        }
    }
    (scene, drawn)
}

fn middle(places: &[Place]) -> Place {
    let count = places.len().max(1) as f64;
    [0, 1].map(|axis| places.iter().map(|place| place[axis]).sum::<f64>() / count)
}

/// A dashed line inside of the loop, where it has an inside.
fn draw_loop(scene: &mut Scene, marks: &Marks, joints: &[usize], index: usize) -> bool {
    let places: Vec<Place> = joints
        .iter()
        .filter_map(|joint| marks.joints.get(*joint))
        .map(|[at, _]| *at)
        .collect();
    if places.len() < 3 {
        return false;
    }
    let centre = middle(&places);
    let inside = |place: &Place| [0, 1].map(|k| place[k] + INSIDE * (centre[k] - place[k]));
    let line: Vec<Place> = places.iter().map(inside).collect();
    let pen = Pen {
        dash: &[4.0, 2.0],
        ..Pen::new(Ink::new(colour(index)), 1.6)
    };
    scene.area("loop", line, None, Some(pen));
    true
}

/// Where a finding is marked.
fn places(finding: &Finding, diagnosis: &Diagnosis, marks: &Marks) -> Vec<Place> {
    let bodies = finding.bodies.iter().filter_map(|body| {
        let (_, at) = marks.body_names.get(body.checked_sub(1)?)?;
        Some(*at)
    });
    let joints = finding
        .joints
        .iter()
        .filter_map(|joint| marks.joints.get(*joint));
    let loops = finding.loops.iter().filter_map(|number| {
        let joints = &diagnosis.loops.get(*number)?.joints;
        let places = joints.iter().filter_map(|joint| marks.joints.get(*joint));
        Some(middle(&places.map(|[at, _]| *at).collect::<Vec<_>>()))
    });
    let points = finding.points.iter().filter_map(|(body, point)| {
        let points = marks.points.get(*body)?;
        points.get(*point).copied()
    });
    bodies
        .chain(joints.map(|[_, at]| *at))
        .chain(points)
        .chain(loops)
        .collect()
}

/// A text around a place.
fn write(scene: &mut Scene, class: &'static str, [x, y]: Place, text: String, ink: Ink) {
    scene.items.push(Item::Label {
        class,
        at: [x, y + 0.35 * LETTERS],
        runs: vec![Run::plain(text)],
        size: LETTERS,
        anchor: Anchor::Middle,
        turned: false,
        ink,
    });
}

/// Half the room of a load's arrow, and how far its places are apart \[pt\].
const LOAD: f64 = 3.0;
const STEP: f64 = 5.0;

/// Places along the arrow of a load, and in its value.
fn along_load(item: &Item) -> Vec<Place> {
    let between = |[from, to]: [Place; 2]| {
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP)
            .ceil()
            .max(1.0);
        (0..=steps as usize).map(move |k| {
            let part = k as f64 / steps;
            [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]))
        })
    };
    match item {
        Item::Line { class, places, .. } | Item::Area { class, places, .. } if *class == "load" => {
            let pairs = places.iter().zip(places.iter().skip(1));
            pairs.flat_map(|(from, to)| between([*from, *to])).collect()
        }
        Item::Label {
            class,
            at: [x, y],
            runs,
            size,
            anchor,
            ..
        } if *class == "load-value" => {
            let wide: f64 = runs.iter().map(|run| font::width(&run.text, *size)).sum();
            let left = match anchor {
                Anchor::Start => *x,
                Anchor::Middle => x - wide / 2.0,
                Anchor::End => x - wide,
            };
            let y = y - 0.35 * size;
            between([[left, y], [left + wide, y]]).collect()
        }
        Item::Line { .. } | Item::Area { .. } | Item::Circle { .. } | Item::Label { .. } => {
            Vec::new()
        }
    }
}

/// Labels that do not cover each other, nor pins and loads.
struct Labels {
    /// Left, top, right, bottom.
    taken: Vec<[f64; 4]>,
    page: [f64; 2],
}

impl Labels {
    fn new(scene: &Scene, marks: &Marks) -> Self {
        let pin = 5.0;
        let pins = marks.joints.iter().flatten();
        let around = |[x, y]: Place, by: f64| [x - by, y - by, x + by, y + by];
        let pins = pins.map(|at| around(*at, pin));
        let loads = scene.items.iter().flat_map(along_load);
        Labels {
            taken: pins.chain(loads.map(|at| around(at, LOAD))).collect(),
            page: [scene.width, scene.height],
        }
    }

    /// The place near another one where a box of that size covers least; it is taken then.
    fn near(&mut self, [x, y]: Place, [wide, high]: [f64; 2]) -> Place {
        let mut best = ([x, y], f64::INFINITY);
        for (k, far) in [0.0, 1.0, 1.9, 3.0].into_iter().enumerate() {
            for [u, v] in AROUND {
                let at = [
                    x + far * u * (wide / 2.0 + 4.0),
                    y + far * v * (high / 2.0 + 4.0),
                ];
                let bounds = [
                    at[0] - wide / 2.0,
                    at[1] - high / 2.0,
                    at[0] + wide / 2.0,
                    at[1] + high / 2.0,
                ];
                let cost = self.covered(bounds) + 0.5 * k as f64;
                if cost < best.1 {
                    best = (at, cost);
                }
            }
        }
        let [x, y] = best.0;
        self.taken.push([
            x - wide / 2.0,
            y - high / 2.0,
            x + wide / 2.0,
            y + high / 2.0,
        ]);
        best.0
    }

    /// How much of other labels a box covers, and of what lies outside of the page.
    fn covered(&self, [left, top, right, bottom]: [f64; 4]) -> f64 {
        let over = self.taken.iter().map(|[l, t, r, b]| {
            (right.min(*r) - left.max(*l)).max(0.0) * (bottom.min(*b) - top.max(*t)).max(0.0)
        });
        let outside = (-left).max(0.0)
            + (-top).max(0.0)
            + (right - self.page[0]).max(0.0)
            + (bottom - self.page[1]).max(0.0);
        over.sum::<f64>() + 100.0 * outside
    }

    fn name(
        &mut self,
        scene: &mut Scene,
        (class, name): (&'static str, &str),
        at: Place,
        tone: palette::Tone,
    ) {
        let text = font::fit(&words::printable(name), LETTERS, 140.0);
        let size = [font::width(&text, LETTERS) + 3.0, LETTERS + 2.0];
        let [x, y] = self.near(at, size);
        // White behind the letters keeps them apart from lines.
        let half = [size[0] / 2.0, size[1] / 2.0];
        let corners = [
            [x - half[0], y - half[1]],
            [x + half[0], y - half[1]],
            [x + half[0], y + half[1]],
            [x - half[0], y + half[1]],
        ];
        scene.area("halo", corners, Some(Ink::grey(255).faded(0.7)), None);
        write(scene, class, [x, y], text, Ink::new(tone.light));
    }

    fn number(&mut self, scene: &mut Scene, at: Place, number: usize, severity: Severity) {
        let tone = match severity {
            Severity::Wrong => palette::BAD,
            Severity::Doubt => palette::WARN,
            Severity::Note => palette::MUTED,
        };
        let [x, y] = self.near(at, [2.0 * NUMBER, 2.0 * NUMBER]);
        let ink = Ink::new(tone.light);
        scene.line("leader", [at, [x, y]], Pen::new(ink, 0.8));
        let disc = rounded_hull(&[[x, y]], NUMBER);
        scene.area("finding", disc, Some(ink), None);
        write(
            scene,
            "finding-number",
            [x, y],
            number.to_string(),
            Ink::grey(255),
        );
    }
}
