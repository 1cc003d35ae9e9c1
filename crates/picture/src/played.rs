//! Scenes of one structure → an SVG in which they follow each other, again and again, without a script (SMIL, W3C SVG 1.1, 19).

use std::fmt::Write as _;

use super::scene::{Item, Scene};
use super::svg;

/// The first scene as SVG, whose lines, areas and circles go through the places that they have in all scenes; `behind` stands still.
///
/// Scenes are of one structure where they show one mechanism in poses near each other. An item that has no likeness in the others
/// stands still.
pub fn write(behind: &Scene, scenes: &[Scene], seconds: f64) -> String {
    let Some(first) = scenes.first() else {
        return svg::write(behind);
    };
    let mut text = svg::head(first);
    for item in &behind.items {
        text += &svg::item(item);
    }
    for (index, item) in first.items.iter().enumerate() {
        let likes: Option<Vec<&Item>> = scenes.iter().map(|scene| scene.items.get(index)).collect();
        let moves = likes.map_or(String::new(), |likes| moves(&likes, seconds));
        let still = svg::item(item);
        match (still.strip_suffix("/>\n"), moves.is_empty()) {
            (Some(open), false) => {
                let name = open[1..].split(' ').next().unwrap_or_default();
                let _ = writeln!(text, "{open}>{moves}</{name}>");
            }
            (_, _) => text += &still,
        }
    }
    text + "</svg>\n"
}

/// How an item moves; nothing where it stands still.
fn moves(likes: &[&Item], seconds: f64) -> String {
    match likes[0] {
        Item::Line { places, .. } | Item::Area { places, .. } => {
            let corners = places.len();
            let same = likes.iter().map(|item| match item {
                Item::Line { places, .. } | Item::Area { places, .. }
                    if places.len() == corners =>
                {
                    Some(svg::points(places))
                }
                Item::Line { .. }
                | Item::Area { .. }
                | Item::Circle { .. }
                | Item::Label { .. } => None,
            });
            animate("points", same.collect(), seconds)
        }
        Item::Circle { .. } => [0, 1]
            .map(|axis| {
                let at = likes.iter().map(|item| match item {
                    Item::Circle { centre, .. } => Some(svg::number(centre[axis])),
                    Item::Line { .. } | Item::Area { .. } | Item::Label { .. } => None,
                });
                animate(["cx", "cy"][axis], at.collect(), seconds)
            })
            .concat(),
        Item::Label { .. } => String::new(),
    }
}

/// One attribute over time.
fn animate(attribute: &str, values: Option<Vec<String>>, seconds: f64) -> String {
    let values = values.unwrap_or_default();
    if values.windows(2).all(|pair| pair[0] == pair[1]) {
        return String::new();
    }
    let values = values.join(";");
    format!(
        "<animate attributeName=\"{attribute}\" dur=\"{seconds}s\" repeatCount=\"indefinite\" values=\"{values}\"/>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Ink, Pen};

    #[test]
    fn only_what_moves_is_animated() {
        let scene = |x: f64| {
            let mut scene = Scene::new(10.0, 10.0);
            let pen = Pen::new(Ink::grey(0), 1.0);
            scene.line("still", [[0.0, 0.0], [1.0, 1.0]], pen);
            scene.line("bar", [[0.0, 0.0], [x, 1.0]], pen);
            scene.circle("pin", [x, 2.0], 1.0, None, Some(pen));
            scene
        };
        let text = write(
            &Scene::new(10.0, 10.0),
            &[scene(1.0), scene(2.0), scene(1.0)],
            2.0,
        );
        let document = roxmltree::Document::parse(&text).expect("XML");
        let found: Vec<(Option<&str>, Option<&str>)> = document
            .descendants()
            .filter(|node| node.has_tag_name("animate"))
            .map(|node| (node.attribute("attributeName"), node.attribute("values")))
            .collect();
        assert_eq!(
            found,
            [
                (Some("points"), Some("0,0 1,1;0,0 2,1;0,0 1,1")),
                (Some("cx"), Some("1;2;1"))
            ]
        );
        // What is no likeness stands still.
        let mut other = scene(3.0);
        other.items.remove(1);
        let text = write(&Scene::new(10.0, 10.0), &[scene(1.0), other], 2.0);
        assert!(!text.contains("<animate"), "{text}");
    }
}
