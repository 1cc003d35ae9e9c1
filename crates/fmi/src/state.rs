//! The state of an instance, in memory and as bytes.
//!
//! ```text
//! "LDS1", token, phase, values, start, end, events, acts     little-endian; doubles by their bits
//! SHA-256 of all that
//! ```

use sha2::{Digest, Sha256};

use crate::motion::{Act, Point};
use crate::phase::Phase;
use crate::refusal::Refusal;

const MAGIC: &[u8; 4] = b"LDS1";
const DIGEST: usize = 32;

/// The state of an instance, from which it, or another one of the same unit, can go on.
#[derive(Debug, Clone)]
pub struct State {
    pub(crate) phase: Phase,
    pub(crate) values: Vec<f64>,
    pub(crate) start: f64,
    pub(crate) end: Option<f64>,
    pub(crate) events: u32,
    pub(crate) point: Option<Point>,
}

impl State {
    /// As bytes; `token` is that of the unit.
    ///
    /// # Errors
    /// Where there were too many steps.
    pub fn bytes(&self, token: &str) -> Result<Vec<u8>, Refusal> {
        let mut bytes = MAGIC.to_vec();
        let mut put = |part: &[u8]| bytes.extend_from_slice(part);
        put(&Sha256::digest(token));
        put(&[self.phase as u8]);
        put(&(self.values.len() as u64).to_le_bytes());
        self.values
            .iter()
            .for_each(|value| put(&value.to_le_bytes()));
        put(&self.start.to_le_bytes());
        put(&self.end.unwrap_or(f64::NAN).to_le_bytes());
        put(&self.events.to_le_bytes());
        match &self.point {
            None => put(&[0]),
            Some(point) => {
                put(&[1]);
                for act in point.history.acts()? {
                    let (kind, reference, number) = match act {
                        Act::Step(time) => (0, 0, time),
                        Act::StepToEvent(time) => (1, 0, time),
                        Act::Set(reference, value) => (2, reference, value),
                    };
                    put(&[kind]);
                    put(&reference.to_le_bytes());
                    put(&number.to_le_bytes());
                }
            }
        }
        let digest = Sha256::digest(&bytes);
        bytes.extend_from_slice(&digest);
        Ok(bytes)
    }

    /// From bytes.
    ///
    /// # Errors
    /// Where they are none that [`State::bytes`] gave for this token.
    pub fn read(bytes: &[u8], token: &str) -> Result<Self, Refusal> {
        let parts = bytes.split_last_chunk::<DIGEST>();
        let whole = parts.filter(|(content, digest)| Sha256::digest(content)[..] == digest[..]);
        let (content, _) = whole
            .ok_or_else(|| Refusal::new("the bytes are no state of a linkdyn unit, or damaged"))?;
        let read = read(&mut Bytes(content), token);
        read.ok_or_else(|| {
            Refusal::new(
                "the bytes are the state of another unit, or of another version of linkdyn",
            )
        })
    }
}

/// What is left of bytes.
struct Bytes<'b>(&'b [u8]);

impl<'b> Bytes<'b> {
    fn take<const N: usize>(&mut self) -> Option<&'b [u8; N]> {
        let (taken, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(taken)
    }

    fn double(&mut self) -> Option<f64> {
        self.take().map(|bytes| f64::from_le_bytes(*bytes))
    }
}

fn read(rest: &mut Bytes, token: &str) -> Option<State> {
    let is_own = rest.take()? == MAGIC && rest.take::<DIGEST>()?[..] == Sha256::digest(token)[..];
    let [phase] = is_own.then(|| rest.take())??;
    let count = u64::from_le_bytes(*rest.take()?);
    let mut state = State {
        phase: Phase::ALL.into_iter().find(|one| *one as u8 == *phase)?,
        values: (0..count).map_while(|_| rest.double()).collect(),
        start: rest.double()?,
        end: rest.double().map(|end| (!end.is_nan()).then_some(end))?,
        events: u32::from_le_bytes(*rest.take()?),
        point: None,
    };
    if *rest.take()? == [1] {
        let mut acts = Vec::new();
        while let Some([kind]) = rest.take() {
            let reference = u32::from_le_bytes(*rest.take()?);
            let number = rest.double()?;
            acts.push(match kind {
                0 => Act::Step(number),
                1 => Act::StepToEvent(number),
                2 => Act::Set(reference, number),
                _ => return None,
            });
        }
        state.point = Some(Point::of_acts(acts));
    }
    Some(state)
}
