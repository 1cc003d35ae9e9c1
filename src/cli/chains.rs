//! `linkdyn chains`: the kinematic chains of so many bodies.

use clap::Args;

use super::exit::{BadInput, Exit, Failure};
use super::streams::{tell, tell_json};
use linkdyn_ask::synthesise::{MOST_BODIES, all_chains};

#[derive(Debug, Args)]
pub struct Options {
    /// How many bodies, the fixed one among them: 4, 6, 8 or 10
    bodies: usize,
    /// Print them as JSON
    #[arg(long)]
    json: bool,
}

/// Lists them.
pub fn execute(options: &Options) -> Result<Exit, Failure> {
    let bodies = options.bodies;
    if !(4..=MOST_BODIES).contains(&bodies) || !bodies.is_multiple_of(2) {
        return Err(BadInput(vec![format!(
            "{bodies}: chains with one freedom and pins alone have 4, 6, 8 or 10 bodies"
        )]));
    }
    let all = all_chains(bodies);
    match options.json {
        true => tell_json(&all)?,
        false => tell(all.text(), &[])?,
    }
    Ok(Exit::Done)
}
