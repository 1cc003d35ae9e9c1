//! Pictures → GIF or APNG: one palette for all frames, of each frame only the rectangle that changed.
//!
//! A GIF counts time in hundredths of a second, and programs slow frames of less than two of them down: 50 frames per second at most.
//! An animated PNG (W3C PNG, third edition, 2025) has no such limit.

use std::collections::HashMap;

use color_quant::NeuQuant;
use gif::{DisposalMethod, Frame, Repeat};

use super::fault::Fault;
use super::raster::Picture;

/// Colours of a palette: one entry says that a pixel stays as it was.
const COLOURS: usize = 255;
/// Pixels that the palette is made from, at most.
const SAMPLE: usize = 400_000;

/// What a film is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// GIF.
    Gif,
    /// Animated PNG.
    Apng,
}

/// How long a film is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Length {
    /// Number of frames.
    pub frames: u32,
    /// Time from the first frame to the first frame again \[s\].
    pub duration: f64,
}

/// Writes frames one by one, so that only two are in memory.
pub struct Film<'f> {
    encoder: Encoder<'f>,
    palette: Palette,
    length: Length,
    written: u32,
    before: Option<Picture>,
}

enum Encoder<'f> {
    Gif(Box<gif::Encoder<&'f mut Vec<u8>>>),
    Apng(Box<png::Writer<&'f mut Vec<u8>>>),
}

/// The part of a picture that changed, as numbers of colours.
struct Patch {
    corner: [usize; 2],
    size: [usize; 2],
    indices: Vec<u8>,
    /// The number of pixels that stay as they were.
    unchanged: u8,
}

/// Colours, and where each is in the palette.
struct Palette {
    rgb: Vec<u8>,
    /// Where there are more colours than entries.
    nearest: Option<NeuQuant>,
    known: HashMap<[u8; 3], u8>,
}

impl<'f> Film<'f> {
    /// A film into `file`, which runs on and on; `samples` are pictures with all of its colours.
    ///
    /// # Errors
    /// When the pictures are larger than the format allows.
    pub fn new(
        file: &'f mut Vec<u8>,
        format: Format,
        length: Length,
        samples: &[Picture],
    ) -> Result<Self, Fault> {
        let first = samples
            .first()
            .ok_or_else(|| Fault::Nothing("a film without pictures".into()))?;
        let palette = Palette::new(samples);
        let encoder = match format {
            Format::Gif => Encoder::gif(file, first, &palette.rgb)?,
            Format::Apng => Encoder::apng(file, first, &palette.rgb, length)?,
        };
        Ok(Film {
            encoder,
            palette,
            length,
            written: 0,
            before: None,
        })
    }

    /// Appends a picture.
    ///
    /// # Errors
    /// When the encoder refuses.
    pub fn push(&mut self, picture: Picture) -> Result<(), Fault> {
        let [left, top, right, bottom] = self.before.as_ref().map_or_else(
            || [0, 0, picture.width as usize, picture.height as usize],
            |before| changed(before, &picture),
        );
        let (width, height) = (right - left, bottom - top);
        let mut indices = Vec::with_capacity(width * height);
        for y in top..bottom {
            let row = 3 * (y * picture.width as usize + left)..;
            let pixels = picture.rgb[row.clone()].as_chunks::<3>().0.iter();
            // Long runs of one number are what both formats write shortest.
            let before = self.before.as_ref();
            let before = before.map(|before| before.rgb[row].as_chunks::<3>().0);
            for (x, pixel) in pixels.take(width).enumerate() {
                let stays = before.is_some_and(|before| before[x] == *pixel);
                indices.push(match stays {
                    true => self.palette.unchanged(),
                    false => self.palette.index(*pixel),
                });
            }
        }
        let patch = Patch {
            corner: [left, top],
            size: [width, height],
            indices,
            unchanged: self.palette.unchanged(),
        };
        self.before = Some(picture);
        let delay = self.length.delay(self.written);
        self.written += 1;
        self.encoder.write(patch, delay, self.length.frames > 1)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// When the encoder refuses.
    pub fn finish(self) -> Result<(), Fault> {
        match self.encoder {
            Encoder::Gif(gif) => gif
                .into_inner()
                .map(|_| ())
                .map_err(|error| Fault::Encoding(error.to_string())),
            Encoder::Apng(apng) => apng.finish().map_err(apng_fault),
        }
    }
}

impl Length {
    /// How long a GIF shows a frame [1/100 s]. Rounding the ends of frames, not their lengths, keeps the film as long as it should be.
    fn delay(&self, frame: u32) -> u16 {
        let end = |frame: u32| {
            (100.0 * f64::from(frame) * self.duration / f64::from(self.frames)).round()
        };
        (end(frame + 1) - end(frame)).clamp(2.0, 65535.0) as u16
    }
}

impl<'f> Encoder<'f> {
    fn gif(file: &'f mut Vec<u8>, first: &Picture, palette: &[u8]) -> Result<Self, Fault> {
        let size =
            |pixels: u32| u16::try_from(pixels).map_err(|_| Fault::TooMuchFilm(u64::from(pixels)));
        let mut encoder = gif::Encoder::new(file, size(first.width)?, size(first.height)?, palette)
            .map_err(gif_fault)?;
        encoder.set_repeat(Repeat::Infinite).map_err(gif_fault)?;
        Ok(Encoder::Gif(Box::new(encoder)))
    }

    fn apng(
        file: &'f mut Vec<u8>,
        first: &Picture,
        palette: &[u8],
        length: Length,
    ) -> Result<Self, Fault> {
        let mut encoder = png::Encoder::new(file, first.width, first.height);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(palette.to_vec());
        // All colours cover but the last, which leaves a pixel as it was.
        let mut covers = vec![255; palette.len() / 3 - 1];
        covers.push(0);
        encoder.set_trns(covers);
        encoder.set_compression(png::Compression::High);
        if length.frames > 1 {
            encoder.set_animated(length.frames, 0).map_err(apng_fault)?;
            // Microseconds of a frame would not fit: the finest fraction of 16 bits that is as long.
            let per_second = f64::from(length.frames) / length.duration;
            let whole = (65535.0 / per_second.max(1.0)).floor().max(1.0);
            let delay = [whole, (whole * per_second).round().max(1.0)].map(|part| part as u16);
            encoder
                .set_frame_delay(delay[0], delay[1])
                .and_then(|()| encoder.set_blend_op(png::BlendOp::Over))
                .map_err(apng_fault)?;
        }
        let writer = encoder.write_header().map_err(apng_fault)?;
        Ok(Encoder::Apng(Box::new(writer)))
    }

    /// Writes a frame; `moves`: it is one of several.
    fn write(&mut self, patch: Patch, delay: u16, moves: bool) -> Result<(), Fault> {
        let [left, top] = patch.corner;
        let [width, height] = patch.size;
        match self {
            Encoder::Gif(gif) => {
                let frame = Frame {
                    delay,
                    transparent: Some(patch.unchanged),
                    dispose: DisposalMethod::Keep,
                    left: left as u16,
                    top: top as u16,
                    width: width as u16,
                    height: height as u16,
                    buffer: patch.indices.into(),
                    ..Frame::default()
                };
                gif.write_frame(&frame).map_err(gif_fault)
            }
            Encoder::Apng(apng) => {
                if moves {
                    apng.reset_frame_position()
                        .and_then(|()| apng.set_frame_dimension(width as u32, height as u32))
                        .and_then(|()| apng.set_frame_position(left as u32, top as u32))
                        .map_err(apng_fault)?;
                }
                apng.write_image_data(&patch.indices).map_err(apng_fault)
            }
        }
    }
}

fn gif_fault(error: gif::EncodingError) -> Fault {
    Fault::Encoding(error.to_string())
}

fn apng_fault(error: png::EncodingError) -> Fault {
    Fault::Encoding(error.to_string())
}

/// The rectangle in which two pictures differ; a single pixel where they do not.
fn changed(before: &Picture, now: &Picture) -> [usize; 4] {
    let width = now.width as usize;
    let [mut left, mut top, mut right, mut bottom] = [usize::MAX, usize::MAX, 0, 0];
    let rows = before
        .rgb
        .chunks_exact(3 * width)
        .zip(now.rgb.chunks_exact(3 * width));
    for (y, (a, b)) in rows.enumerate().filter(|(_, (a, b))| a != b) {
        let differs = |x: &usize| a[3 * x..3 * x + 3] != b[3 * x..3 * x + 3];
        top = top.min(y);
        bottom = y + 1;
        left = left.min((0..width).find(differs).unwrap_or(0));
        right = right.max((0..width).rfind(differs).unwrap_or(0) + 1);
    }
    if bottom == 0 {
        [0, 0, 1, 1]
    } else {
        [left, top, right, bottom]
    }
}

impl Palette {
    fn new(samples: &[Picture]) -> Self {
        let mut counts: HashMap<[u8; 3], u64> = HashMap::new();
        for pixel in samples
            .iter()
            .flat_map(|picture| picture.rgb.as_chunks::<3>().0)
        {
            *counts.entry(*pixel).or_default() += 1;
        }
        let mut colours: Vec<([u8; 3], u64)> = counts.into_iter().collect();
        // Most frequent first, and the same order in every run.
        colours.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        if colours.len() <= COLOURS {
            let known = colours
                .iter()
                .enumerate()
                .map(|(index, (colour, _))| (*colour, index as u8))
                .collect();
            let unchanged = ([0; 3], 0);
            let colours = colours.into_iter().chain([unchanged]);
            return Palette {
                rgb: colours.flat_map(|(colour, _)| colour).collect(),
                nearest: None,
                known,
            };
        }
        // A network trained by frequency alone would give all its colours to the white page.
        let weight = |count: u64| count.isqrt().clamp(1, 200) as usize;
        let pixels = colours
            .iter()
            .flat_map(|([r, g, b], count)| std::iter::repeat_n([*r, *g, *b, 255], weight(*count)));
        let pixels: Vec<u8> = pixels.take(SAMPLE).flatten().collect();
        let network = NeuQuant::new(3, COLOURS - 1, &pixels);
        let mut rgb = network.color_map_rgb();
        // The page stays exactly white.
        let page = colours[0].0;
        rgb.extend(page);
        // The entry for pixels that stay as they were.
        rgb.extend([0; 3]);
        let known = HashMap::from([(page, (COLOURS - 1) as u8)]);
        Palette {
            rgb,
            nearest: Some(network),
            known,
        }
    }

    /// The number of pixels that stay as they were: the last.
    fn unchanged(&self) -> u8 {
        (self.rgb.len() / 3 - 1) as u8
    }

    fn index(&mut self, colour: [u8; 3]) -> u8 {
        if let Some(index) = self.known.get(&colour) {
            return *index;
        }
        let [r, g, b] = colour;
        let index = match &self.nearest {
            Some(network) => network.index_of(&[r, g, b, 255]) as u8,
            None => closest(&self.rgb[..self.rgb.len() - 3], colour),
        };
        self.known.insert(colour, index);
        index
    }
}

/// The entry of a small palette that differs least.
fn closest(palette: &[u8], colour: [u8; 3]) -> u8 {
    let distance = |entry: &[u8; 3]| -> u32 {
        entry
            .iter()
            .zip(colour)
            .map(|(a, b)| u32::from(a.abs_diff(b)).pow(2))
            .sum()
    };
    let entries = palette.as_chunks::<3>().0.iter().enumerate();
    entries
        .min_by_key(|(_, entry)| distance(entry))
        .map_or(0, |(index, _)| index as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_changed_is_written() {
        let blank = Picture {
            width: 4,
            height: 3,
            rgb: vec![255; 36],
        };
        let mut dot = blank.clone();
        dot.rgb[3 * (4 + 2)] = 0;
        assert_eq!(changed(&blank, &dot), [2, 1, 3, 2]);
        assert_eq!(changed(&blank, &blank), [0, 0, 1, 1]);
    }

    #[test]
    fn few_colours_are_kept_exactly_and_white_always() {
        let few = Picture {
            width: 2,
            height: 1,
            rgb: vec![255, 255, 255, 1, 2, 3],
        };
        let mut palette = Palette::new(std::slice::from_ref(&few));
        let index = usize::from(palette.index([1, 2, 3]));
        assert_eq!(palette.rgb[3 * index..3 * index + 3], [1, 2, 3]);
        let many: Vec<u8> = (0..3000_u32)
            .flat_map(|i| [(i % 251) as u8, (i / 16) as u8, 128])
            .chain([255; 9000])
            .collect();
        let mut palette = Palette::new(&[Picture {
            width: 6000,
            height: 1,
            rgb: many,
        }]);
        let index = usize::from(palette.index([255; 3]));
        assert_eq!(palette.rgb[3 * index..3 * index + 3], [255; 3]);
        assert!(palette.rgb.len() <= 768);
    }
}
