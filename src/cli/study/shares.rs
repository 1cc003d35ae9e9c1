//! Which share of a study is asked for.

use super::Options;
use super::head::Head;
use crate::cli::exit::{BadInput, Exit, Failure};
use crate::cli::streams::print;
use linkdyn_study::chunks::Shard;

/// `I/N`, or what Slurm says.
pub fn shard(text: &str) -> Result<Shard, Failure> {
    let bad = |why: String| BadInput(vec![format!("--shard {text}: {why}")]);
    if text != "slurm" {
        return text.parse().map_err(|fault| bad(format!("{fault}")));
    }
    let number = |name: &str| -> Result<u64, Failure> {
        let value = std::env::var(name).map_err(|_| {
            bad(format!(
                "{name} is not set: this is no task of a Slurm array"
            ))
        })?;
        value
            .parse()
            .map_err(|_| bad(format!("{name} is {value:?}, no number")))
    };
    let (task, first) = (
        number("SLURM_ARRAY_TASK_ID")?,
        number("SLURM_ARRAY_TASK_MIN")?,
    );
    let count = number("SLURM_ARRAY_TASK_COUNT")?;
    let index = task.saturating_sub(first) + 1;
    Shard::new(index, count).map_err(|fault| bad(format!("{fault}")))
}

/// What is said of a shard that is done.
pub fn told_shard(options: &Options, head: &Head) -> Result<Exit, Failure> {
    let (shard, directory) = (&options.shard, &options.directory);
    if let (Some(shard), Some(directory)) = (shard, directory) {
        print(&format!(
            "shard {shard} of {} variants is done; when all are: linkdyn study merge {}\n",
            head.variants,
            directory.display()
        ))?;
    }
    Ok(Exit::Done)
}
