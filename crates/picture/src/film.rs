//! Pictures → GIF: one palette for all frames, of each frame only the rectangle that changed.

use std::collections::HashMap;

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, Frame, Repeat};

use super::fault::Fault;
use super::raster::Picture;

/// Colours of a palette.
const COLOURS: usize = 256;
/// Pixels that the palette is made from, at most.
const SAMPLE: usize = 400_000;

/// Writes frames one by one, so that only two are in memory.
pub struct Film {
    encoder: Encoder<Vec<u8>>,
    palette: Palette,
    before: Option<Picture>,
}

/// Colours, and where each is in the palette.
struct Palette {
    rgb: Vec<u8>,
    /// Where there are more colours than entries.
    nearest: Option<NeuQuant>,
    known: HashMap<[u8; 3], u8>,
}

impl Film {
    /// A film that runs on and on; `samples` are pictures with all of its colours.
    ///
    /// # Errors
    /// When the pictures are larger than the format can tell.
    pub fn new(samples: &[Picture]) -> Result<Self, Fault> {
        let first = samples
            .first()
            .ok_or_else(|| Fault::Nothing("a film without pictures".into()))?;
        let size =
            |pixels: u32| u16::try_from(pixels).map_err(|_| Fault::TooMuchFilm(u64::from(pixels)));
        let palette = Palette::new(samples);
        let mut encoder = Encoder::new(
            Vec::new(),
            size(first.width)?,
            size(first.height)?,
            &palette.rgb,
        )
        .map_err(encoding)?;
        encoder.set_repeat(Repeat::Infinite).map_err(encoding)?;
        Ok(Film {
            encoder,
            palette,
            before: None,
        })
    }

    /// Appends a picture, shown for that many hundredths of a second.
    ///
    /// # Errors
    /// When the encoder refuses.
    pub fn push(&mut self, picture: Picture, delay: u16) -> Result<(), Fault> {
        let [left, top, right, bottom] = self.before.as_ref().map_or_else(
            || [0, 0, picture.width as usize, picture.height as usize],
            |before| changed(before, &picture),
        );
        let (width, height) = (right - left, bottom - top);
        let row = |y: usize| &picture.rgb[3 * (y * picture.width as usize + left)..][..3 * width];
        let mut buffer = Vec::with_capacity(width * height);
        for y in top..bottom {
            buffer.extend(
                row(y)
                    .as_chunks::<3>()
                    .0
                    .iter()
                    .map(|pixel| self.palette.index(*pixel)),
            );
        }
        let frame = Frame {
            delay,
            dispose: DisposalMethod::Keep,
            left: left as u16,
            top: top as u16,
            width: width as u16,
            height: height as u16,
            buffer: buffer.into(),
            ..Frame::default()
        };
        self.before = Some(picture);
        self.encoder.write_frame(&frame).map_err(encoding)
    }

    /// The bytes of the file.
    ///
    /// # Errors
    /// When the encoder refuses.
    pub fn finish(self) -> Result<Vec<u8>, Fault> {
        self.encoder
            .into_inner()
            .map_err(|error| Fault::Encoding(error.to_string()))
    }
}

fn encoding(error: gif::EncodingError) -> Fault {
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
            return Palette {
                rgb: colours.into_iter().flat_map(|(colour, _)| colour).collect(),
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
        let known = HashMap::from([(page, (COLOURS - 1) as u8)]);
        Palette {
            rgb,
            nearest: Some(network),
            known,
        }
    }

    fn index(&mut self, colour: [u8; 3]) -> u8 {
        if let Some(index) = self.known.get(&colour) {
            return *index;
        }
        let [r, g, b] = colour;
        let index = match &self.nearest {
            Some(network) => network.index_of(&[r, g, b, 255]) as u8,
            None => closest(&self.rgb, colour),
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
