//! Wall and process CPU time of the stages of a run.

use std::time::Duration;

#[cfg(not(target_family = "wasm"))]
use cpu_time::ProcessTime;
use web_time::Instant;

use super::Stage;

/// A running clock.
#[derive(Debug, Clone, Copy)]
pub struct Stopwatch {
    wall: Instant,
    /// None on a system that does not tell.
    #[cfg(not(target_family = "wasm"))]
    cpu: Option<ProcessTime>,
}

impl Stopwatch {
    /// Starts now.
    pub fn start() -> Self {
        Stopwatch {
            wall: Instant::now(),
            #[cfg(not(target_family = "wasm"))]
            cpu: ProcessTime::try_now().ok(),
        }
    }

    /// Time since the start.
    pub fn read(&self) -> Stage {
        #[cfg(not(target_family = "wasm"))]
        let cpu = self.cpu.and_then(|cpu| cpu.try_elapsed().ok());
        // A page has no clock of its processor.
        #[cfg(target_family = "wasm")]
        let cpu = None;
        let cpu: Duration = cpu.unwrap_or_default();
        Stage {
            wall: self.wall.elapsed().as_secs_f64(),
            cpu: cpu.as_secs_f64(),
        }
    }

    /// Time since the start or the last lap; the next one starts.
    pub fn lap(&mut self) -> Stage {
        let stage = self.read();
        *self = Stopwatch::start();
        stage
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laps_do_not_overlap() {
        let mut watch = Stopwatch::start();
        std::thread::sleep(Duration::from_millis(20));
        let first = watch.lap();
        let second = watch.lap();
        assert!(
            first.wall >= 0.02 && second.wall < first.wall,
            "{first:?} {second:?}"
        );
    }
}
