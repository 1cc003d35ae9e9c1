//! The bytes of a chunk.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::rows::Rows;

/// What a chunk begins with.
const MAGIC: &[u8] = b"linkdyn chunk/1\n";
/// Length of the length of the header, and of the checksum \[bytes\].
const LENGTH: usize = 8;
const CHECKSUM: usize = 32;

/// What a chunk says about itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Header {
    pub study: String,
    pub engine: String,
    pub from: u64,
    pub to: u64,
    pub inputs: Vec<String>,
    pub responses: Vec<String>,
    pub reasons: Vec<String>,
}

/// Why bytes are no chunk.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Broken {
    Foreign,
    Length(u64),
    Damaged,
}

/// The bytes of a header and its rows.
pub(super) fn encode(header: &Header, rows: &Rows) -> Vec<u8> {
    // Texts and whole numbers: JSON takes them all.
    let json = serde_json::to_vec(header).unwrap_or_default();
    let mut bytes = MAGIC.to_vec();
    bytes.extend((json.len() as u64).to_le_bytes());
    bytes.extend(json);
    bytes.extend(rows.bytes());
    let sum = Sha256::digest(&bytes);
    bytes.extend(sum);
    bytes
}

/// Header and rows of bytes that are whole.
pub(super) fn decode(bytes: &[u8]) -> Result<(Header, Rows), Broken> {
    let shared = bytes.len().min(MAGIC.len());
    if bytes[..shared] != MAGIC[..shared] {
        return Err(Broken::Foreign);
    }
    let least = MAGIC.len() + LENGTH + CHECKSUM;
    if bytes.len() < least {
        return Err(Broken::Length(least as u64));
    }
    let rest = &bytes[MAGIC.len()..];
    let length = rest[..LENGTH]
        .iter()
        .rev()
        .fold(0, |sum, &byte| sum << 8 | u64::from(byte));
    let room = (bytes.len() - least) as u64;
    if length > room {
        return Err(Broken::Length((least as u64).saturating_add(length)));
    }
    let (json, rest) = rest[LENGTH..].split_at(length as usize);
    let header: Header = serde_json::from_slice(json).map_err(|_| Broken::Damaged)?;
    let mut rows = Rows::new(header.from, header.inputs.len(), header.responses.len());
    let count = header.to.saturating_sub(header.from);
    let expected = count.saturating_mul(rows.row_bytes() as u64);
    let found = (rest.len() - CHECKSUM) as u64;
    if found != expected {
        let whole = (least as u64 + length).saturating_add(expected);
        return Err(Broken::Length(whole));
    }
    let (all, sum) = bytes.split_at(bytes.len() - CHECKSUM);
    if Sha256::digest(all)[..] != *sum {
        return Err(Broken::Damaged);
    }
    let is_whole = rows.fill(header.reasons.clone(), &rest[..found as usize]);
    is_whole.then_some((header, rows)).ok_or(Broken::Damaged)
}
