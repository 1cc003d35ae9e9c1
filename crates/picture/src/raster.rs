//! Scene → pixels, and pixels → PNG with its resolution.

use tiny_skia::{Color, FillRule, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};
use ttf_parser::OutlineBuilder;

use super::fault::{Fault, MOST_PIXELS};
use super::font;
use super::scene::{
    Anchor, Ink, Item, POINTS_PER_MM, Pen, Place, RAISED_BY, RAISED_SIZE, Run, Scene,
};

/// A picture, opaque.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue of every pixel, row by row.
    pub rgb: Vec<u8>,
}

/// Draws the scene with `scale` pixels per point.
///
/// # Errors
/// When there would be too many pixels.
pub fn draw(scene: &Scene, scale: f64) -> Result<Picture, Fault> {
    let pixels = |points: f64| (points * scale).round().max(1.0);
    let (width, height) = (pixels(scene.width), pixels(scene.height));
    let too_many = || Fault::TooManyPixels(width as u64, height as u64);
    if width * height > MOST_PIXELS as f64 {
        return Err(too_many());
    }
    let mut pixmap = Pixmap::new(width as u32, height as u32).ok_or_else(too_many)?;
    pixmap.fill(Color::WHITE);
    let view = Transform::from_scale(scale as f32, scale as f32);
    for item in &scene.items {
        match item {
            Item::Line { places, pen, .. } => {
                stroke(&mut pixmap, path(places, false), Some(*pen), view)
            }
            Item::Area {
                places,
                fill: ink,
                pen,
                ..
            } => {
                let path = path(places, true);
                fill(&mut pixmap, path.as_ref(), *ink, view);
                stroke(&mut pixmap, path, *pen, view);
            }
            Item::Circle {
                centre: [x, y],
                radius,
                fill: ink,
                pen,
                ..
            } => {
                let path = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32);
                fill(&mut pixmap, path.as_ref(), *ink, view);
                stroke(&mut pixmap, path, *pen, view);
            }
            Item::Label {
                at,
                runs,
                size,
                anchor,
                turned,
                ink,
                ..
            } => {
                let outlines = outlines(*at, runs, *size, *anchor, *turned);
                fill(&mut pixmap, outlines.as_ref(), Some(*ink), view);
            }
        }
    }
    // On white, premultiplied colours are the colours.
    let rgb = pixmap
        .data()
        .chunks_exact(4)
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
        .collect();
    Ok(Picture {
        width: pixmap.width(),
        height: pixmap.height(),
        rgb,
    })
}

fn path(places: &[Place], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    let (first, rest) = places.split_first()?;
    path.move_to(first[0] as f32, first[1] as f32);
    for [x, y] in rest {
        path.line_to(*x as f32, *y as f32);
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn paint(ink: Ink) -> Paint<'static> {
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    let [r, g, b] = ink.rgb;
    paint.set_color_rgba8(r, g, b, (ink.alpha.clamp(0.0, 1.0) * 255.0).round() as u8);
    paint
}

fn fill(pixmap: &mut Pixmap, path: Option<&Path>, ink: Option<Ink>, view: Transform) {
    if let (Some(path), Some(ink)) = (path, ink) {
        pixmap.fill_path(path, &paint(ink), FillRule::Winding, view, None);
    }
}

fn stroke(pixmap: &mut Pixmap, path: Option<Path>, pen: Option<Pen>, view: Transform) {
    if let (Some(path), Some(pen)) = (path, pen) {
        let dash = StrokeDash::new(
            pen.dash
                .iter()
                .map(|length| (*length * pen.width) as f32)
                .collect(),
            0.0,
        );
        let line_join = tiny_skia::LineJoin::Round;
        let stroke = Stroke {
            width: pen.width as f32,
            dash,
            line_join,
            ..Stroke::default()
        };
        pixmap.stroke_path(&path, &paint(pen.ink), &stroke, view, None);
    }
}

/// Collects outlines of glyphs, moved and scaled to their place.
struct Outlines {
    path: PathBuilder,
    /// Origin of the glyph, and page units per font unit along x and y.
    origin: Place,
    scale: f64,
    turned: bool,
}

impl Outlines {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        let [dx, dy] = [f64::from(x) * self.scale, f64::from(y) * self.scale];
        let [x, y] = self.origin;
        let [x, y] = if self.turned {
            [x - dy, y - dx]
        } else {
            [x + dx, y - dy]
        };
        (x as f32, y as f32)
    }
}

impl OutlineBuilder for Outlines {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) =
            (self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

fn outlines(at: Place, runs: &[Run], size: f64, anchor: Anchor, turned: bool) -> Option<Path> {
    let width = font::width_of_runs(runs, size);
    // Along the text.
    let mut along = match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -width / 2.0,
        Anchor::End => -width,
    };
    let mut outlines = Outlines {
        path: PathBuilder::new(),
        origin: at,
        scale: 1.0,
        turned,
    };
    for run in runs {
        let (own, rise) = if run.raised {
            (RAISED_SIZE * size, RAISED_BY * size)
        } else {
            (size, 0.0)
        };
        outlines.scale = own / font::units_per_em();
        let start = along;
        font::outline(&run.text, &mut outlines, |outlines, units| {
            let forward = start + units * outlines.scale;
            let [x, y] = at;
            outlines.origin = if turned {
                [x - rise, y - forward]
            } else {
                [x + forward, y - rise]
            };
        });
        along += font::width(&run.text, own);
    }
    outlines.path.finish()
}

/// The scene as PNG of that resolution.
///
/// # Errors
/// When there would be too many pixels.
pub fn png(scene: &Scene, dpi: f64) -> Result<Vec<u8>, Fault> {
    encode(&draw(scene, dpi / 72.0)?, dpi)
}

fn encode(picture: &Picture, dpi: f64) -> Result<Vec<u8>, Fault> {
    let fault = |error: png::EncodingError| Fault::Encoding(error.to_string());
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, picture.width, picture.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let per_metre = (dpi / 72.0 * POINTS_PER_MM * 1000.0).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(fault)?;
    writer.write_image_data(&picture.rgb).map_err(fault)?;
    writer.finish().map_err(fault)?;
    Ok(file)
}
