//! Studies in directories: chunks of rows as they come, tables and a page where all are there.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use linkdyn_ask::ENGINE;
use linkdyn_ask::study::{Chunks, Display, Head, Studied, Sums, Variants};
use linkdyn_engine::analysis::Control;
use linkdyn_output::Directory;
use linkdyn_study::chunks::{ChunkFault, Rows, Shard, Store};
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// What a directory holds.
const HEAD: &str = "study.json";
const CHUNKS: &str = "chunks";
const TABLE: &str = "variants.csv";
const COLUMNS: &str = "variants.parquet";
const PAGE: &str = "report.html";

/// A study in a directory.
pub(crate) struct Kept {
    directory: Directory,
    store: Store,
    about: About,
}

/// What `study.json` says before anything was computed.
#[derive(Serialize, Deserialize)]
struct About {
    #[serde(flatten)]
    head: Head,
    #[serde(default)]
    display: Display,
}

impl About {
    fn of(variants: &Variants) -> Self {
        About {
            head: variants.head.clone(),
            display: variants.display.clone(),
        }
    }
}

/// Which files are written besides `variants.csv` and `study.json`; older ones that are not wanted are removed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Files {
    pub page: bool,
    pub parquet: bool,
}

/// A share of the chunks of a store.
struct Share<'s> {
    store: &'s Store,
    shard: Shard,
}

impl Chunks for Share<'_> {
    fn to_do(&self) -> Result<Vec<u64>, ChunkFault> {
        self.store.to_do(self.shard)
    }

    fn begun(&self, chunk: u64) -> Rows {
        self.store.kept(chunk)
    }

    fn keep(&self, chunk: u64, rows: &Rows) -> Result<(), ChunkFault> {
        self.store.keep(chunk, rows)
    }

    fn finish(&self, chunk: u64, rows: &Rows) -> Result<(), ChunkFault> {
        self.store.write(chunk, rows)
    }
}

impl Kept {
    /// Says in a directory what the study is, or checks that it is this one.
    pub fn begin(path: &Path, variants: &Variants) -> Result<Self, Error> {
        let directory = Directory::open(path)?;
        let about = About::of(variants);
        if directory.path().join(HEAD).exists() {
            expect_same(directory.path(), &about.head)?;
        } else {
            directory.write(HEAD, text(&about).as_bytes())?;
        }
        Kept::new(directory, about)
    }

    /// The study that is in a directory.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let about = read(path)?;
        if about.head.engine != ENGINE {
            return Err(Error::Question(vec![format!(
                "{}: it is a study of linkdyn {}, this is {ENGINE}: join it with the version that made it",
                path.display(),
                about.head.engine
            )]));
        }
        Kept::new(Directory::open(path)?, about)
    }

    fn new(directory: Directory, about: About) -> Result<Self, Error> {
        let chunks = directory.path().join(CHUNKS);
        let store = Store::open(&chunks, about.head.identity(), about.head.plan());
        Ok(Kept {
            directory,
            store: store.map_err(Error::Rows)?,
            about,
        })
    }

    /// Computes what a share of the chunks lacks; false where it is interrupted.
    pub fn fill(
        &self,
        variants: &Variants,
        shard: Shard,
        control: &Control,
    ) -> Result<bool, Error> {
        let store = &self.store;
        let filled = variants.fill(&Share { store, shard }, control);
        filled.map_err(Error::Rows)
    }

    /// Sums up all chunks and writes what they come to. Variants that are at hand move in the page.
    pub fn join(
        &self,
        again: Option<(&Variants, &Control)>,
        files: Files,
    ) -> Result<(Studied, Vec<PathBuf>), Error> {
        let About { head, display } = &self.about;
        let mut sums = Sums::new(head);
        let joined = self.store.join(|rows| {
            sums.take(rows);
            Ok(())
        });
        joined.map_err(Error::Rows)?;
        let studied = sums.studied(head.clone(), display.clone());
        let mut written = vec![self.table(TABLE, |out| self.store.write_csv(out))?];
        match files.parquet {
            true => written.push(self.table(COLUMNS, |out| parquet(&self.store, out))?),
            false => self.directory.remove(COLUMNS)?,
        }
        written.push(self.directory.write(HEAD, text(&studied).as_bytes())?);
        match files.page {
            true => written.push(self.directory.write(PAGE, studied.html(again).as_bytes())?),
            false => self.directory.remove(PAGE)?,
        }
        Ok((studied, written))
    }

    /// A file of all rows.
    fn table(
        &self,
        name: &str,
        write: impl FnOnce(&mut File) -> Result<(), ChunkFault>,
    ) -> Result<PathBuf, Error> {
        let mut failed = None;
        let written = self.directory.write_with(name, |out| {
            write(out).map_err(|why| {
                let error = io::Error::other(why.to_string());
                failed = Some(why);
                error
            })
        });
        match failed {
            Some(why) => Err(Error::Rows(why)),
            None => Ok(written?),
        }
    }
}

/// What a study is, before anything was computed.
pub(crate) fn plan(variants: &Variants) -> String {
    text(&About::of(variants))
}

pub(crate) fn text(document: &impl Serialize) -> String {
    let text = serde_json::to_string_pretty(document).expect("keys are texts");
    text + "\n"
}

fn read(directory: &Path) -> Result<About, Error> {
    let path = directory.join(HEAD);
    let bad = |why: String| Error::Question(vec![format!("{}: {why}", path.display())]);
    let text = fs::read(&path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => bad("there is no study in this directory".into()),
        _ => bad(format!("can't be read: {error}")),
    })?;
    serde_json::from_slice(&text).map_err(|error| bad(format!("it is no study: {error}")))
}

/// The study in a directory is this one.
fn expect_same(directory: &Path, head: &Head) -> Result<(), Error> {
    let there = read(directory)?.head;
    let path = directory.join(HEAD);
    let bad = |why: String| Err(Error::Question(vec![format!("{}: {why}", path.display())]));
    if there.engine != head.engine {
        return bad(format!(
            "it is a study of linkdyn {}, this is {}: choose another directory",
            there.engine, head.engine
        ));
    }
    if there != *head {
        return bad(format!(
            "it is another study ({}): choose another directory, or remove this one",
            differences(&there, head)
        ));
    }
    Ok(())
}

/// In what two studies differ.
fn differences(there: &Head, here: &Head) -> String {
    let is_sampled_otherwise = there.method != here.method || there.variants != here.variants;
    let parts = [
        ("model", there.model != here.model),
        ("inputs", there.inputs != here.inputs),
        ("responses", there.responses != here.responses),
        ("seed", there.seed != here.seed),
        ("samples", is_sampled_otherwise),
    ];
    let parts = parts.iter().filter(|(_, differs)| *differs);
    let parts: Vec<&str> = parts.map(|(what, _)| *what).collect();
    match parts.is_empty() {
        true => "its settings differ".to_owned(),
        false => format!("other {}", parts.join(", ")),
    }
}

#[cfg(feature = "parquet")]
fn parquet(store: &Store, out: &mut File) -> Result<(), ChunkFault> {
    store.write_parquet(out)
}

#[cfg(not(feature = "parquet"))]
fn parquet(_: &Store, _: &mut File) -> Result<(), ChunkFault> {
    let why = "this linkdyn was built without the feature \"parquet\"";
    Err(io::Error::other(why).into())
}
