//! Drivers let go: what they did becomes an input, and their start stays.

use crate::error::Error;
use crate::mechanism::{Mechanism, unknown};
use linkdyn_model::{DriverKind, GROUND};

impl Mechanism {
    /// The mechanism in which drivers prescribe nothing: the input of a driver's name is its driving torque \[N·m\] or force \[N\], zero until
    /// it is set. Forces move it, by `dynamics`.
    ///
    /// It starts where, and as fast as, it did with its drivers. Where only angles of bodies were driven, `initial` has these and their
    /// rates, and the rest is assembled as before, also with other values of parameters. Else `pose` and `initial` have the positions and
    /// rates of all bodies; other parameters then start from the nearest position.
    ///
    /// # Errors
    /// [`Error::Unknown`] where there is no such driver, [`Error::Model`] where there is an input or a force of that name already, where
    /// something else of the model names the driver, or where the mechanism can't start.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::prelude::*;
    ///
    /// let free = Mechanism::bundled("four-bar")?.release(&["motor"])?;
    /// let mut simulation = free.simulation()?;
    /// simulation.set_input("motor", 2.0)?;
    /// simulation.step_to(0.01)?;
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn release(&self, drivers: &[&str]) -> Result<Self, Error> {
        let mut after = self.model().clone();
        for name in drivers {
            let known = || self.model().drivers.keys().map(String::as_str);
            if !known().any(|known| known == *name) {
                return Err(unknown("driver", name, known()));
            }
            after = after
                .release(name)
                .map_err(|complaints| self.place(complaints))?;
        }
        let json = after.to_json();
        let before = self.model();
        let inputs = after.inputs.keys();
        let inputs = inputs.filter(|name| !before.inputs.contains_key(*name));
        let inputs = inputs.map(|name| format!("inputs.{name}={}", json["inputs"][name]));
        let forces = after.forces.keys();
        let forces = forces.filter(|name| !before.forces.contains_key(*name));
        let forces = forces.map(|name| format!("forces.{name}={}", json["forces"][name]));
        let gone = drivers.iter().map(|name| format!("drivers.{name}=null"));
        let moves = std::iter::once("analysis.type=dynamics".to_owned());
        let start = self.start_of(drivers)?;
        self.set_all(gone.chain(inputs).chain(forces).chain(moves).chain(start))
    }

    /// Words of the model that say where it starts, and how fast, in the place of its drivers.
    fn start_of(&self, drivers: &[&str]) -> Result<Vec<String>, Error> {
        let (begun, row) = self.first_row()?;
        let value = |body: &str, word: &str| -> Result<f64, Error> {
            let column = begun.column(&format!("{body}.{word}"))?;
            Ok(row[column.id.index()])
        };
        let turned = |name: &&str| match &self.model().drivers[*name].kind {
            DriverKind::Rotation { body, relative_to } => {
                let ground = relative_to.as_ref().is_none_or(|other| other == GROUND);
                ground.then_some(body)
            }
            DriverKind::Translation { .. }
            | DriverKind::Length { .. }
            | DriverKind::Point { .. } => None,
        };
        let mut words = Vec::new();
        if let Some(bodies) = drivers.iter().map(turned).collect::<Option<Vec<_>>>() {
            for body in bodies {
                let [angle, rate] = [value(body, "angle")?, value(body, "omega")?];
                words.push(format!("initial.{body}.angle={angle:?} rad"));
                words.push(format!("initial.{body}.angular_velocity={rate:?} rad/s"));
            }
            return Ok(words);
        }
        for body in self.model().bodies.keys().filter(|body| *body != GROUND) {
            let [x, y, angle] = [value(body, "x")?, value(body, "y")?, value(body, "angle")?];
            let place = format!(r#"["{x:?} m", "{y:?} m"]"#);
            words.push(format!("bodies.{body}.pose.position={place}"));
            words.push(format!("bodies.{body}.pose.angle={angle:?} rad"));
            for (key, word, unit) in [
                ("vx", "vx", "m/s"),
                ("vy", "vy", "m/s"),
                ("angular_velocity", "omega", "rad/s"),
            ] {
                let rate = value(body, word)?;
                words.push(format!("initial.{body}.{key}={rate:?} {unit}"));
            }
        }
        Ok(words)
    }

    /// The mechanism with all its columns, and their values at t = 0.
    fn first_row(&self) -> Result<(Self, Vec<f64>), Error> {
        let of = |kind: &str| {
            let words = [
                format!("analysis.type={kind}"),
                r#"analysis.columns=["*"]"#.into(),
            ];
            self.set_all(words)
        };
        let free = of("dynamics")?;
        if let Ok(simulation) = free.simulation() {
            let row = simulation.row().to_vec();
            return Ok((free, row));
        }
        // Drivers prescribe all, so that there is nothing to simulate.
        let driven = of("kinematics")?;
        let run = driven.run()?;
        let run = match run.time().is_empty() {
            true => run.complete()?,
            false => run,
        };
        let row = driven
            .columns()
            .map(|(_, column)| run.column(column).get(0));
        let row = row.map(|value| value.unwrap_or(f64::NAN)).collect();
        Ok((driven, row))
    }
}
