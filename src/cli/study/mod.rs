//! `linkdyn study`: many variants of a model, what comes out of each, and what that comes to.

mod asked;
mod display;
mod head;
mod motions;
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

use clap::{Args, Subcommand};
use serde_json::json;

use super::exit::{BadInput, Exit};
use super::interrupt;
use super::open::{ModelOptions, Opened};
use super::progress::Line;
use super::responses;
use super::streams::{complain, print};
use asked::Asked;
use display::Display;
use head::Head;
use linkdyn_output::Directory;
use linkdyn_study::chunks::{ChunkFault, Shard, Store};
use motions::Again;
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

#[derive(Debug, Args)]
#[command(after_help = HELP, args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Options {
    #[command(subcommand)]
    merge: Option<Merge>,
    #[command(flatten)]
    model: Option<ModelOptions>,
    /// Vary a parameter over a grid, as in "parameters.r=40 mm:60 mm:21" (from, to, count) or "parameters.r=40 mm, 50 mm"; several
    /// multiply
    #[arg(long, value_name = "PATH=VALUES")]
    vary: Vec<String>,
    /// Draw so many samples of all parameters that have a tolerance
    #[arg(long, value_name = "N")]
    samples: Option<u64>,
    /// Take scrambled Sobol points instead of random ones
    #[arg(long, requires = "samples", conflicts_with = "latin")]
    sobol: bool,
    /// Take a Latin hypercube instead of random points
    #[arg(long, requires = "samples")]
    latin: bool,
    /// Take the rows that Sobol indices need, inputs + 2 for each sample
    #[arg(long, requires = "samples")]
    indices: bool,
    /// Seed of the samples [default: 1]
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// A number that comes out of each variant, as in "stroke = max(piston.x) - min(piston.x)", besides those of the model
    #[arg(long = "response", value_name = "NAME = EXPRESSION")]
    responses: Vec<String>,
    /// Compute share I of N only, as in 2/7, or what Slurm's array task is to do: slurm
    #[arg(long, value_name = "I/N", requires = "directory")]
    shard: Option<String>,
    /// Threads; by default one for each processor
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Print study.json instead of the summary for people
    #[arg(long)]
    json: bool,
    /// Keep chunks of rows in this directory (made where missing), go on from those that are there, and write variants.csv,
    /// study.json and report.html
    #[arg(short = 'o', long = "output", value_name = "DIR")]
    directory: Option<PathBuf>,
    /// Write no report.html, and remove an older one from DIR
    #[arg(long, requires = "directory")]
    no_report: bool,
    /// Write variants.parquet, too
    #[arg(long, requires = "directory")]
    parquet: bool,
}

#[derive(Debug, Subcommand)]
enum Merge {
    /// Join the chunks that shards have written into a directory
    Merge {
        /// The directory of the study
        #[arg(value_name = "DIR")]
        directory: PathBuf,
        /// Print study.json instead of the summary for people
        #[arg(long)]
        json: bool,
        /// Write no report.html, and remove an older one from DIR
        #[arg(long)]
        no_report: bool,
        /// Write variants.parquet, too
        #[arg(long)]
        parquet: bool,
    },
}

const HELP: &str = "  linkdyn study mine.json --vary \"parameters.r=40 mm:60 mm:21\" --response \"peak = max(abs(driver.motor.effort))\" -o out
  linkdyn study mine.json --samples 100000 --sobol -o out
  linkdyn study mine.json --samples 100000 -o out --shard 2/7
  linkdyn study merge out

What responses may say: linkdyn docs format. What the files hold: linkdyn docs studies.";

/// Runs all variants, sums up, tells.
pub fn execute(options: &Options) -> Result<Exit, BadInput> {
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
    let pool = rayon::ThreadPoolBuilder::new();
    let pool = pool.num_threads(options.threads.unwrap_or(0)).build();
    let pool = pool.map_err(|error| BadInput(vec![format!("no threads: {error}")]))?;
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
            Some(_) => "interrupted; the same command goes on from the chunks that are done",
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
) -> Result<Option<Totals<'h>>, BadInput> {
    let plan = head.plan();
    let mut totals = Totals::new(head);
    for chunk in 0..plan.chunks() {
        let Some(rows) = variants.rows(plan.range(chunk)) else {
            return Ok(None);
        };
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
) -> Result<Summed<'h>, BadInput> {
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
        let Some(rows) = variants.rows(plan.range(chunk)) else {
            return Ok(None);
        };
        store.write(chunk, &rows).map_err(fault)?;
        done.fetch_add(rows.len() as u64, Ordering::Relaxed);
    }
    if shard != Shard::WHOLE {
        return Ok(None);
    }
    join(&directory, head, &store, wish).map(Some)
}

fn open_store(directory: &Directory, head: &Head) -> Result<Store, BadInput> {
    let chunks = directory.path().join(CHUNKS);
    Store::open(&chunks, head.identity(), head.plan()).map_err(fault)
}

/// Says in the directory what the study is, or checks that it is this one.
fn begin(directory: &Directory, head: &Head, display: &Display) -> Result<(), BadInput> {
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

fn read_head(directory: &Path) -> Result<Head, BadInput> {
    let path = directory.join(HEAD);
    let bad = |why: String| BadInput(vec![format!("{}: {why}", path.display())]);
    let text = fs::read(&path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => bad("there is no study in this directory".into()),
        _ => bad(format!("can't be read: {error}")),
    })?;
    serde_json::from_slice(&text).map_err(|error| bad(format!("it is no study: {error}")))
}

fn fault(fault: ChunkFault) -> BadInput {
    BadInput(vec![fault.to_string()])
}

/// Sums up all chunks and writes what they come to.
fn join<'h>(
    directory: &Directory,
    head: &'h Head,
    store: &Store,
    wish: Wish,
) -> Result<(Totals<'h>, Vec<PathBuf>), BadInput> {
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
fn merge(path: &Path, json: bool, [is_wanted, parquet]: [bool; 2]) -> Result<Exit, BadInput> {
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
) -> Result<Exit, BadInput> {
    print(&if json {
        document(head, totals, display)
    } else {
        text::page(head, &totals.told(), display, written)
    })?;
    Ok(Exit::Done)
}
