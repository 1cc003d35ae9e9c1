//! A controller opens a door to 90 degrees, a hundred times a second, and overshoots: the door meets its stop.
//! `cargo run --example controller`

use linkdyn::prelude::*;

const DOOR: &str = r#"{
    "format": "linkdyn/1", "units": { "length": "m", "angle": "deg" }, "gravity": [0, 0],
    "bodies": {
        "ground": { "points": { "O": [0, 0] } },
        "door": { "mass": "20 kg", "inertia": "1.7 kg*m^2", "com": [0.5, 0], "points": { "O": [0, 0] } }
    },
    "joints": {
        "hinge": { "type": "revolute", "between": ["ground.O", "door.O"], "limits": [-5, 95], "restitution": 0.3 }
    },
    "initial": { "door": { "angle": 0, "angular_velocity": 0 } },
    "analysis": { "type": "dynamics", "end": 8, "outputs": 2 }
}"#;

fn main() -> Result<(), Error> {
    let mechanism: Mechanism = DOOR.parse()?;
    let mut door = mechanism.simulation()?;
    let angle = door.coordinate("door.angle")?;
    let goal = deg(90.0).si();
    for tick in 1..=800 {
        let (off, rate) = (goal - door.position()[angle], door.velocity()[angle]);
        door.set_force(angle, 60.0 * off - 12.0 * rate);
        for event in door.step_to(0.01 * f64::from(tick))? {
            let Some(impact) = event.episode else {
                continue;
            };
            println!(
                "{:.4} s: {} stop, approach {:.3} rad/s, impulse {:.3} N*m*s",
                event.time,
                event.stop.unwrap_or_default(),
                impact.approach_speed,
                impact.impulse
            );
        }
    }
    println!(
        "at {} s the door stands at {:.2} degrees",
        door.time(),
        door.position()[angle].to_degrees()
    );
    Ok(())
}
