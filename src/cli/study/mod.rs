//! `linkdyn study`: many variants of a model, what comes out of each, and what that comes to.

mod asked;
mod display;
mod head;
mod motions;
mod options;
mod report;
mod respond;
mod sample;
mod shares;
mod tables;
mod text;
mod totals;
mod variants;
mod wanted;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use serde_json::json;

use super::exit::{BadInput, Exit, Failure};
use super::interrupt;
use super::open::Opened;
use super::progress::Line;
use super::responses;
use super::streams::{complain, print};
use super::threads;
use asked::Asked;
use display::Display;
use head::Head;
use linkdyn_output::Directory;
use linkdyn_study::chunks::{ChunkFault, Rows, Shard, Store};
use motions::Again;
use options::Merge;
pub use options::Options;
use report::Wish;
use respond::family;
use sample::Sample;
use shares::{shard, told_shard};
use totals::Totals;
use variants::Variants;
use wanted::Wanted;
pub use wanted::rows;

const VERSION: &str = env!("CARGO_PKG_VERSION");
/// What a directory holds.
const HEAD: &str = "study.json";
const CHUNKS: &str = "chunks";

/// Runs all variants, sums up, tells.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    if let Some(Merge::Merge {
        directory,
        json,
        no_report,
        parquet,
    }) = &options.merge
    {
        return merge(directory, *json, [!no_report, *parquet]);
    }
    let Some(model) = &options.model else {
        return Err(BadInput(vec![
            "which model? as in: linkdyn study mine.json --samples 1000".into(),
        ]));
    };
    let shard = options.shard.as_deref().map(shard).transpose()?;
    let opened = responses::open(model, &options.responses)?;
    respond::wanted(&opened)?;
    let wanted = Wanted::new(options, &opened)?;
    let asked = Asked::new(&wanted, &opened)?;
    let family = family(&opened, &asked)?;
    let head = Head::new(
        &wanted,
        model.sets(),
        &opened,
        &asked,
        respond::asked(&family),
    );
    let variants = Variants {
        family: &family,
        asked: &asked,
        interrupted: interrupt::watch(),
    };
    let pool = threads::pool(options.threads)?;
    let wish = Wish {
        is_wanted: !options.no_report,
        parquet: options.parquet,
        display: &Display::of(&opened, &family),
        again: Some(Again {
            opened: &opened,
            variants: &variants,
        }),
    };
    let done = Arc::new(AtomicU64::new(0));
    let line = progress(&opened, &head, &done);
    let exit = pool.install(|| match &options.directory {
        None => {
            loose(&head, &variants, &done).map(|totals| totals.map(|totals| (totals, Vec::new())))
        }
        Some(path) => {
            let shard = shard.unwrap_or(Shard::WHOLE);
            kept(path, &head, (&variants, wish), shard, &done)
        }
    });
    drop(line);
    let Some((totals, written)) = exit? else {
        if !interrupt::is_set() {
            return told_shard(options, &head);
        }
        complain(match options.directory {
            Some(_) => "interrupted; the same command goes on from the variants that are done",
            None => "interrupted; with -o DIR a study goes on from what is done",
        });
        return Ok(Exit::Interrupted);
    };
    tell(&head, (&totals, wish.display), &written, options.json)
}

/// How far it has come.
fn progress(opened: &Opened, head: &Head, done: &Arc<AtomicU64>) -> Line {
    let (all, done) = (head.variants as f64, Arc::clone(done));
    Line::start(Instant::now(), &opened.name, move || {
        Some(done.load(Ordering::Relaxed) as f64 / all)
    })
}

/// A study that is not kept; none where it was interrupted.
fn loose<'h>(
    head: &'h Head,
    variants: &Variants,
    done: &AtomicU64,
) -> Result<Option<Totals<'h>>, Failure> {
    let plan = head.plan();
    let mut totals = Totals::new(head);
    for chunk in 0..plan.chunks() {
        let range = plan.range(chunk);
        let mut rows = Rows::new(range.start, head.inputs.len(), head.responses.len());
        if !variants.append(&mut rows, range.end, |_| Ok(()))? {
            return Ok(None);
        }
        totals.take(&rows);
        done.fetch_add(rows.len() as u64, Ordering::Relaxed);
    }
    Ok(Some(totals))
}

type Summed<'h> = Option<(Totals<'h>, Vec<PathBuf>)>;

/// A study in a directory; none where it was interrupted, or is a shard.
fn kept<'h>(
    path: &Path,
    head: &'h Head,
    (variants, wish): (&Variants, Wish),
    shard: Shard,
    done: &AtomicU64,
) -> Result<Summed<'h>, Failure> {
    let directory = Directory::open(path)?;
    begin(&directory, head, wish.display)?;
    let store = open_store(&directory, head)?;
    let plan = store.plan();
    let to_do = store.to_do(shard).map_err(fault)?;
    let own = (0..plan.chunks()).filter(|chunk| shard.has(*chunk));
    let size = |chunk: u64| plan.range(chunk).end - plan.range(chunk).start;
    let ready: u64 = own.filter(|chunk| !to_do.contains(chunk)).map(size).sum();
    done.fetch_add(ready, Ordering::Relaxed);
    for chunk in to_do {
        let mut rows = store.kept(chunk);
        let keep = |rows: &Rows| store.keep(chunk, rows).map_err(fault);
        if !variants.append(&mut rows, plan.range(chunk).end, keep)? {
            return Ok(None);
        }
        store.write(chunk, &rows).map_err(fault)?;
        done.fetch_add(rows.len() as u64, Ordering::Relaxed);
    }
    if shard != Shard::WHOLE {
        return Ok(None);
    }
    join(&directory, head, &store, wish).map(Some)
}

fn open_store(directory: &Directory, head: &Head) -> Result<Store, Failure> {
    let chunks = directory.path().join(CHUNKS);
    Store::open(&chunks, head.identity(), head.plan()).map_err(fault)
}

/// Says in the directory what the study is, or checks that it is this one.
fn begin(directory: &Directory, head: &Head, display: &Display) -> Result<(), Failure> {
    let path = directory.path().join(HEAD);
    if path.exists() {
        let there = read_head(directory.path())?;
        if there.engine != head.engine {
            return Err(BadInput(vec![format!(
                "{}: it is a study of linkdyn {}, this is {}: choose another directory",
                path.display(),
                there.engine,
                head.engine
            )]));
        }
        if there != *head {
            return Err(BadInput(vec![format!(
                "{}: it is another study ({}): choose another directory, or remove this one",
                path.display(),
                differences(&there, head)
            )]));
        }
        return Ok(());
    }
    let mut all = json!(head);
    all["display"] = json!(display);
    directory.write(HEAD, format!("{all:#}\n").as_bytes())?;
    Ok(())
}

/// In what two studies differ.
fn differences(there: &Head, here: &Head) -> String {
    let mut parts = Vec::new();
    for (what, differs) in [
        ("model", there.model != here.model),
        ("inputs", there.inputs != here.inputs),
        ("responses", there.responses != here.responses),
        ("seed", there.seed != here.seed),
        (
            "samples",
            there.method != here.method || there.variants != here.variants,
        ),
    ] {
        if differs {
            parts.push(what);
        }
    }
    match parts.is_empty() {
        true => "its settings differ".to_owned(),
        false => format!("other {}", parts.join(", ")),
    }
}

fn read_head(directory: &Path) -> Result<Head, Failure> {
    let path = directory.join(HEAD);
    let bad = |why: String| BadInput(vec![format!("{}: {why}", path.display())]);
    let text = fs::read(&path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => bad("there is no study in this directory".into()),
        _ => bad(format!("can't be read: {error}")),
    })?;
    serde_json::from_slice(&text).map_err(|error| bad(format!("it is no study: {error}")))
}

fn fault(fault: ChunkFault) -> Failure {
    match fault {
        ChunkFault::Write { .. } | ChunkFault::Join(_) => Failure::Unwritten(fault.to_string()),
        ChunkFault::Read { .. }
        | ChunkFault::Foreign(_)
        | ChunkFault::Length { .. }
        | ChunkFault::Damaged(_)
        | ChunkFault::Study { .. }
        | ChunkFault::Engine { .. }
        | ChunkFault::Rows { .. }
        | ChunkFault::Columns { .. }
        | ChunkFault::Incomplete { .. } => BadInput(vec![fault.to_string()]),
    }
}

/// Sums up all chunks and writes what they come to.
fn join<'h>(
    directory: &Directory,
    head: &'h Head,
    store: &Store,
    wish: Wish,
) -> Result<(Totals<'h>, Vec<PathBuf>), Failure> {
    let (mut totals, mut sample) = (Totals::new(head), Sample::new(head));
    store
        .join(|rows| {
            totals.take(rows);
            sample.take(rows);
            Ok(())
        })
        .map_err(fault)?;
    let mut written = tables::write(directory, store, wish.parquet)?;
    let text = document(head, &totals, wish.display);
    let summary = directory.write(HEAD, text.as_bytes())?;
    let page = report::write(directory, head, &totals, sample, wish)?;
    written.push(summary);
    written.extend(page);
    Ok((totals, written))
}

/// `study.json` of a study that is done.
fn document(head: &Head, totals: &Totals, display: &Display) -> String {
    let mut all = json!(head);
    all["display"] = json!(display);
    all["summary"] = json!(totals.told());
    format!("{all:#}\n")
}

/// Joins what shards have left.
fn merge(path: &Path, json: bool, [is_wanted, parquet]: [bool; 2]) -> Result<Exit, Failure> {
    let head = read_head(path)?;
    if head.engine != VERSION {
        return Err(BadInput(vec![format!(
            "{}: it is a study of linkdyn {}, this is {VERSION}: join it with the version that made it",
            path.display(),
            head.engine
        )]));
    }
    let directory = Directory::open(path)?;
    let store = open_store(&directory, &head)?;
    let display = &display::kept(path);
    let wish = Wish {
        is_wanted,
        parquet,
        display,
        again: None,
    };
    let (totals, written) = join(&directory, &head, &store, wish)?;
    tell(&head, (&totals, display), &written, json)
}

fn tell(
    head: &Head,
    (totals, display): (&Totals, &Display),
    written: &[PathBuf],
    json: bool,
) -> Result<Exit, Failure> {
    print(&if json {
        document(head, totals, display)
    } else {
        text::page(head, &totals.told(), display, written)
    })?;
    Ok(Exit::Done)
}
