//! Wall and process CPU time of the stages of a run.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;

use super::Stage;

/// A running clock.
#[derive(Debug, Clone, Copy)]
pub struct Stopwatch {
    wall: Instant,
    /// None on a system that does not tell.
    cpu: Option<ProcessTime>,
}

impl Stopwatch {
    /// Starts now.
    pub fn start() -> Self {
        Stopwatch {
            wall: Instant::now(),
            cpu: ProcessTime::try_now().ok(),
        }
    }

    /// Time since the start.
    pub fn read(&self) -> Stage {
        let cpu = self
            .cpu
            .and_then(|cpu| cpu.try_elapsed().ok())
            .unwrap_or(Duration::ZERO);
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
