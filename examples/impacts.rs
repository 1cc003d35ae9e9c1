//! Each impact of a worn piston pin in two turns of its crank, with approach speed and impulse:
//! `cargo run --release --example impacts`

use linkdyn::prelude::*;

fn main() -> Result<(), Error> {
    let mechanism = Mechanism::bundled("slider-crank-clearance")?;
    let mut motion = mechanism.simulation()?;
    println!("    time [s]  joint     approach [m/s]  impulse [N*s]");
    loop {
        let events = motion.step_to_event(0.024)?;
        if events.is_empty() {
            return Ok(());
        }
        for event in events {
            if let (Some(joint), Some(impact)) = (event.joint, event.episode) {
                println!(
                    "{:12.6}  {joint:<8} {:15.4} {:14.5}",
                    event.time, impact.approach_speed, impact.impulse
                );
            }
        }
    }
}
