//! Scene → SVG 1.1: no script, no style sheet, no reference to anything outside.

use std::fmt::Write;

use super::font::FAMILIES;
use super::scene::{
    Anchor, Ink, Item, POINTS_PER_MM, Pen, Place, RAISED_BY, RAISED_SIZE, Run, Scene,
};

/// The scene as the text of a file.
pub fn write(scene: &Scene) -> String {
    let mut text = head(scene);
    for item in &scene.items {
        push(&mut text, item);
    }
    text.push_str("</svg>\n");
    text
}

/// One item.
pub(crate) fn item(item: &Item) -> String {
    let mut text = String::new();
    push(&mut text, item);
    text
}

/// All that stands before the items: the opening tag, what the scene shows in words, white paper.
pub(crate) fn head(scene: &Scene) -> String {
    let mut text = String::new();
    let (width, height) = (scene.width, scene.height);
    let mm = |points: f64| number(points / POINTS_PER_MM);
    let _ = writeln!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\" \
         font-family=\"{FAMILIES}\" fill=\"none\" stroke-linejoin=\"round\">",
        mm(width),
        mm(height),
        number(width),
        number(height),
    );
    for (name, content) in [("title", &scene.title), ("desc", &scene.about)] {
        if !content.is_empty() {
            let _ = writeln!(text, "<{name}>{}</{name}>", escape(content));
        }
    }
    let _ = writeln!(
        text,
        "<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>",
        number(width),
        number(height)
    );
    text
}

fn push(text: &mut String, item: &Item) {
    // Writing to a String can't fail.
    let _ = match item {
        Item::Line { class, places, pen } => {
            writeln!(
                text,
                "<polyline class=\"{class}\" points=\"{}\"{}/>",
                points(places),
                stroke(Some(*pen))
            )
        }
        Item::Area {
            class,
            places,
            fill,
            pen,
        } => {
            let paint = paint(*fill) + &stroke(*pen);
            writeln!(
                text,
                "<polygon class=\"{class}\" points=\"{}\"{paint}/>",
                points(places)
            )
        }
        Item::Circle {
            class,
            centre: [x, y],
            radius,
            fill,
            pen,
        } => {
            let paint = paint(*fill) + &stroke(*pen);
            let (x, y, r) = (number(*x), number(*y), number(*radius));
            writeln!(
                text,
                "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\"{paint}/>"
            )
        }
        Item::Label {
            class,
            at: [x, y],
            runs,
            size,
            anchor,
            turned,
            ink,
        } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let (x, y) = (number(*x), number(*y));
            let turn = if *turned {
                format!(" transform=\"rotate(-90 {x} {y})\"")
            } else {
                String::new()
            };
            writeln!(
                text,
                "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{anchor}\"{turn}{}>{}</text>",
                number(*size),
                paint(Some(*ink)),
                spans(runs, *size)
            )
        }
    };
}

fn spans(runs: &[Run], size: f64) -> String {
    let mut text = String::new();
    let mut is_raised = false;
    for run in runs {
        let content = escape(&run.text);
        let rise = number(RAISED_BY * size);
        let _ = match (run.raised, is_raised) {
            (true, _) => {
                let small = number(RAISED_SIZE * size);
                write!(
                    text,
                    "<tspan dy=\"-{rise}\" font-size=\"{small}\">{content}</tspan>"
                )
            }
            (false, true) => write!(text, "<tspan dy=\"{rise}\">{content}</tspan>"),
            (false, false) => write!(text, "{content}"),
        };
        is_raised = run.raised;
    }
    text
}

pub(crate) fn points(places: &[Place]) -> String {
    let places: Vec<String> = places
        .iter()
        .map(|[x, y]| format!("{},{}", number(*x), number(*y)))
        .collect();
    places.join(" ")
}

fn colour(ink: Ink) -> String {
    let [r, g, b] = ink.rgb;
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn opacity(what: &str, ink: Ink) -> String {
    if ink.alpha < 1.0 {
        format!(" {what}-opacity=\"{}\"", number(ink.alpha))
    } else {
        String::new()
    }
}

fn paint(fill: Option<Ink>) -> String {
    fill.map(|ink| format!(" fill=\"{}\"{}", colour(ink), opacity("fill", ink)))
        .unwrap_or_default()
}

fn stroke(pen: Option<Pen>) -> String {
    let Some(Pen { ink, width, dash }) = pen else {
        return String::new();
    };
    let mut text = format!(
        " stroke=\"{}\" stroke-width=\"{}\"{}",
        colour(ink),
        number(width),
        opacity("stroke", ink)
    );
    if !dash.is_empty() {
        let dash: Vec<String> = dash.iter().map(|length| number(*length * width)).collect();
        let _ = write!(text, " stroke-dasharray=\"{}\"", dash.join(" "));
    }
    text
}

/// Thousandths of a point, without needless zeros.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

/// Text that can stand between tags and in attributes, of SVG and of HTML.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&#39;")
}
