//! How much torque a four-bar's motor needs at most, for three lengths of its coupler:
//! `cargo run --example peak_torque`.

use linkdyn::prelude::*;

fn main() -> Result<(), Error> {
    let mechanism = Mechanism::open(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/four-bar.json"
    ))?;
    let rod = mechanism.parameter("l_rod")?;
    let torque = mechanism.column("driver.motor.effort")?;
    println!(
        "l_rod nominal {}, torque in {}",
        rod.nominal(),
        torque.unit()
    );
    for length in [119.7, 120.0, 120.3] {
        let run = mechanism.with([(rod, mm(length))])?.run()?;
        println!("{length} mm: {}", run.column(torque).max_abs());
    }
    Ok(())
}
