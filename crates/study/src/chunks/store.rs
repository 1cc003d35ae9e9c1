//! The chunks of a study in a directory.

use std::fs::{self, File, OpenOptions};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, ErrorKind, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::csv::{write_header, write_rows};
use super::fault::ChunkFault;
use super::format::{Broken, Header, decode, encode};
use super::plan::{Plan, Shard};
use super::rows::Rows;

/// What the chunks of a study have in common.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Identity {
    /// Hash of all that the variants and their results depend on.
    pub study: String,
    /// What computes them, with its version.
    pub engine: String,
    /// Names of what is varied.
    pub inputs: Vec<String>,
    /// Names of what comes out.
    pub responses: Vec<String>,
}

/// The chunks of a study in a directory.
#[derive(Debug, Clone)]
pub struct Store {
    directory: PathBuf,
    identity: Identity,
    plan: Plan,
}

impl Store {
    /// The chunks of this study in a directory, which is made where it is missing.
    ///
    /// # Errors
    /// When the directory can't be made.
    pub fn open(directory: &Path, identity: Identity, plan: Plan) -> Result<Self, ChunkFault> {
        fs::create_dir_all(directory).map_err(|source| ChunkFault::Write {
            path: directory.to_owned(),
            source,
        })?;
        Ok(Store {
            directory: directory.to_owned(),
            identity,
            plan,
        })
    }

    /// Its plan.
    pub fn plan(&self) -> Plan {
        self.plan
    }

    /// The file of a chunk.
    pub fn path(&self, chunk: u64) -> PathBuf {
        self.directory.join(format!("chunk-{chunk:08}.bin"))
    }

    /// Empty rows for a chunk.
    pub fn rows(&self, chunk: u64) -> Rows {
        let Identity {
            inputs, responses, ..
        } = &self.identity;
        Rows::new(self.plan.range(chunk).start, inputs.len(), responses.len())
    }

    /// Writes a chunk as a whole, replacing one that is there.
    ///
    /// # Errors
    /// When the system refuses, or the rows are not those of the chunk.
    pub fn write(&self, chunk: u64, rows: &Rows) -> Result<(), ChunkFault> {
        let path = self.path(chunk);
        let (own, found) = (self.plan.range(chunk), rows.from()..rows.end());
        if found != own {
            return Err(ChunkFault::Rows {
                path,
                found,
                expected: own,
            });
        }
        self.replace(chunk, path, rows)?;
        // What can't be removed harms nobody.
        let _ = fs::remove_file(self.begun(chunk));
        Ok(())
    }

    /// Keeps the first rows of a chunk that is still computed.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn keep(&self, chunk: u64, rows: &Rows) -> Result<(), ChunkFault> {
        self.replace(chunk, self.begun(chunk), rows)
    }

    /// The first rows of a chunk that were kept; `None` if there are no sound ones of this study.
    pub fn kept(&self, chunk: u64) -> Rows {
        let none = || self.rows(chunk);
        let Ok(bytes) = fs::read(self.begun(chunk)) else {
            return none();
        };
        let own = self.plan.range(chunk);
        match decode(&bytes) {
            Ok((header, rows)) if rows.from() == own.start && rows.end() <= own.end => {
                let of_this = self.accept(chunk, header, rows.from()..rows.end());
                of_this.map_or_else(|_| none(), |()| rows)
            }
            Ok(_) | Err(_) => none(),
        }
    }

    /// The file of the first rows of a chunk that is still computed.
    fn begun(&self, chunk: u64) -> PathBuf {
        self.directory.join(format!("chunk-{chunk:08}.begun"))
    }

    /// Writes rows as a part, syncs it and gives it its name.
    fn replace(&self, chunk: u64, path: PathBuf, rows: &Rows) -> Result<(), ChunkFault> {
        let Identity {
            study,
            engine,
            inputs,
            responses,
        } = self.identity.clone();
        let header = Header {
            study,
            engine,
            from: rows.from(),
            to: rows.end(),
            inputs,
            responses,
            reasons: rows.reasons(),
        };
        self.rename(chunk, &path, &encode(&header, rows))
            .map_err(|source| ChunkFault::Write { path, source })
    }

    fn rename(&self, chunk: u64, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let own = format!(
            "{}{:016x}.part",
            part(chunk),
            RandomState::new().hash_one(chunk)
        );
        let temporary = self.directory.join(&own);
        let mut file = OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&temporary)?;
        let written = file.write_all(bytes).and_then(|()| file.sync_all());
        drop(file);
        match written.and_then(|()| fs::rename(&temporary, path)) {
            // Another writer of this chunk was faster, and has taken our part for one that was left.
            Err(error) if error.kind() == ErrorKind::NotFound && path.exists() => {}
            Err(error) => {
                let _ = fs::remove_file(&temporary);
                return Err(error);
            }
            Ok(()) => {}
        }
        // A rename lasts when its directory is synced; some systems sync none, and lose the chunk at worst, never half of it.
        let _ = File::open(&self.directory).and_then(|directory| directory.sync_all());
        self.remove_parts(chunk);
        Ok(())
    }

    /// Removes what killed writers of a chunk have left. What can't be removed harms nobody.
    fn remove_parts(&self, chunk: u64) {
        let begin = part(chunk);
        for entry in fs::read_dir(&self.directory)
            .into_iter()
            .flatten()
            .flatten()
        {
            if entry.file_name().to_string_lossy().starts_with(&begin) {
                let _ = fs::remove_file(entry.path());
            }
        }
    }

    /// The rows of a chunk; `None` if it is not there.
    ///
    /// # Errors
    /// When it is damaged, or of another study, version or plan.
    pub fn read(&self, chunk: u64) -> Result<Option<Rows>, ChunkFault> {
        let path = self.path(chunk);
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(ChunkFault::Read { path, source }),
        };
        match decode(&bytes) {
            Ok((header, rows)) => {
                let own = self.plan.range(chunk);
                self.accept(chunk, header, own).map(|()| Some(rows))
            }
            Err(Broken::Foreign) => Err(ChunkFault::Foreign(path)),
            Err(Broken::Damaged) => Err(ChunkFault::Damaged(path)),
            Err(Broken::Length(expected)) => Err(ChunkFault::Length {
                path,
                found: bytes.len() as u64,
                expected,
            }),
        }
    }

    /// Whether a chunk is one of this study, with these variants.
    fn accept(&self, chunk: u64, header: Header, expected: Range<u64>) -> Result<(), ChunkFault> {
        let path = self.path(chunk);
        let Identity {
            study,
            engine,
            inputs,
            responses,
        } = &self.identity;
        if header.study != *study {
            return Err(ChunkFault::Study {
                path,
                found: header.study,
                expected: study.clone(),
            });
        }
        if header.engine != *engine {
            return Err(ChunkFault::Engine {
                path,
                found: header.engine,
                expected: engine.clone(),
            });
        }
        let found = header.from..header.to;
        if found != expected {
            return Err(ChunkFault::Rows {
                path,
                found,
                expected,
            });
        }
        if header.inputs != *inputs || header.responses != *responses {
            let text =
                |inputs: &[String], responses: &[String]| [inputs, responses].concat().join(", ");
            return Err(ChunkFault::Columns {
                path,
                found: text(&header.inputs, &header.responses),
                expected: text(inputs, responses),
            });
        }
        Ok(())
    }

    /// The chunks of a shard that are still to be computed: those that are not there, cut short or damaged.
    ///
    /// # Errors
    /// When a chunk can't be read, or is one of another study, version or plan: it is not replaced.
    pub fn to_do(&self, shard: Shard) -> Result<Vec<u64>, ChunkFault> {
        let mut chunks = Vec::new();
        for chunk in (0..self.plan.chunks()).filter(|&chunk| shard.has(chunk)) {
            match self.read(chunk) {
                Ok(Some(_)) => {}
                Ok(None) | Err(ChunkFault::Length { .. } | ChunkFault::Damaged(_)) => {
                    chunks.push(chunk)
                }
                Err(fault) => return Err(fault),
            }
        }
        Ok(chunks)
    }

    /// Hands on all rows in the order of their variants, chunk by chunk.
    ///
    /// # Errors
    /// When chunks are missing, before any is handed on; when one can't be read; what `take` returns.
    pub fn join(&self, mut take: impl FnMut(&Rows) -> io::Result<()>) -> Result<(), ChunkFault> {
        self.expect_complete()?;
        for chunk in 0..self.plan.chunks() {
            match self.read(chunk)? {
                Some(rows) => take(&rows)?,
                // It was there a moment ago.
                None => return Err(self.incomplete(&[chunk])),
            }
        }
        Ok(())
    }

    /// Writes all rows as `variants.csv`, the same bytes for any way in which the chunks were computed.
    ///
    /// # Errors
    /// As [`Store::join`].
    pub fn write_csv(&self, out: &mut impl Write) -> Result<(), ChunkFault> {
        self.expect_complete()?;
        write_header(&self.identity.inputs, &self.identity.responses, out)?;
        self.join(|rows| write_rows(rows, out))
    }

    /// Writes all rows as `variants.parquet`, the same bytes for any way in which the chunks were computed.
    ///
    /// # Errors
    /// As [`Store::join`].
    #[cfg(feature = "parquet")]
    pub fn write_parquet(&self, out: &mut (impl Write + Send)) -> Result<(), ChunkFault> {
        self.expect_complete()?;
        let begun = super::columns::Columns::begin(&self.identity, out);
        let mut columns = begun.map_err(io::Error::other)?;
        self.join(|rows| columns.take(rows).map_err(io::Error::other))?;
        Ok(columns.finish().map_err(io::Error::other)?)
    }

    fn expect_complete(&self) -> Result<(), ChunkFault> {
        let chunks = 0..self.plan.chunks();
        let missing: Vec<u64> = chunks.filter(|&chunk| !self.path(chunk).exists()).collect();
        if missing.is_empty() {
            Ok(())
        } else {
            Err(self.incomplete(&missing))
        }
    }

    fn incomplete(&self, missing: &[u64]) -> ChunkFault {
        let mut ranges: Vec<Range<u64>> = Vec::new();
        for range in missing.iter().map(|&chunk| self.plan.range(chunk)) {
            match ranges.last_mut() {
                Some(last) if last.end == range.start => last.end = range.end,
                Some(_) | None => ranges.push(range),
            }
        }
        ChunkFault::Incomplete {
            chunks: missing.len() as u64,
            of: self.plan.chunks(),
            ranges,
        }
    }
}

/// How the names of the parts of a chunk begin.
fn part(chunk: u64) -> String {
    format!(".chunk-{chunk:08}.")
}
