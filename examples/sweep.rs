//! The greatest torque of a four-bar's motor over the length of its crank, as a figure:
//! `cargo run --example sweep` writes `sweep.svg`.

use linkdyn::figure::{Axis, Chart, Curve, Panel, svg};
use linkdyn::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mechanism = Mechanism::bundled("four-bar")?;
    let crank = mechanism.parameter("crank")?;
    let torque = mechanism.column("driver.motor.effort")?;
    let (mut lengths, mut peaks) = (Vec::new(), Vec::new());
    for length in (60..=110).step_by(5).map(f64::from) {
        let run = mechanism.with([(crank, mm(length))])?.run()?.complete()?;
        lengths.push(length);
        peaks.push(run.column(torque).max_abs());
    }
    let panel = Panel {
        axis: Axis::new("greatest torque", torque.unit()),
        curves: vec![Curve::new("motor", lengths, peaks)],
    };
    let chart = Chart {
        x: Axis::new("crank", "mm"),
        panels: vec![panel],
        ..Chart::default()
    };
    let path = std::env::args().nth(1).unwrap_or("sweep.svg".into());
    std::fs::write(&path, svg::write(&chart.draw()?))?;
    println!("written: {path}");
    Ok(())
}
