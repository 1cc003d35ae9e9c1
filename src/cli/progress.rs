//! A line on the terminal that tells how far a long command has come: drawn by a thread of its own, from half a second on,
//! only where something changes, and cleared at the end. Where standard error is no terminal there is none.

use std::io::{self, IsTerminal, Write};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use linkdyn_ask::text::{number, plain};
use linkdyn_engine::analysis::Control;

/// Commands that take less are not worth a line.
const PATIENCE: Duration = Duration::from_millis(500);
/// Between two looks.
const INTERVAL: Duration = Duration::from_millis(100);
/// Characters of the bar, and most of the label.
const WIDTH: usize = 24;
const LABEL: usize = 28;

/// The line, as long as this lives.
#[derive(Debug)]
pub struct Line(Option<(Sender<()>, JoinHandle<()>)>);

impl Line {
    /// Begins to look at the progress of a question that is asked now.
    pub fn watch(label: &str, control: &Control) -> Self {
        let progress = control.progress.clone();
        Line::start(Instant::now(), label, move || progress.share())
    }

    /// Begins to look at `share` (from 0 to 1, `None` if unknown) of a command that began at `since`.
    pub fn start(
        since: Instant,
        label: &str,
        share: impl Fn() -> Option<f64> + Send + 'static,
    ) -> Self {
        let dumb = std::env::var_os("TERM").is_some_and(|name| name == "dumb");
        if dumb || !io::stderr().is_terminal() {
            return Line(None);
        }
        let label: String = plain(label).chars().take(LABEL).collect();
        let (sender, receiver) = mpsc::channel();
        let draw = move || {
            let mut shown = String::new();
            // a late part of a long command does not flicker either
            let mut wait = PATIENCE.saturating_sub(since.elapsed()).max(INTERVAL);
            while receiver.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                wait = INTERVAL;
                let text = render(&label, share(), since.elapsed());
                if text != shown {
                    put(&text, shown.chars().count());
                    shown = text;
                }
            }
            if !shown.is_empty() {
                put("", shown.chars().count());
            }
        };
        // without a thread there is no line, which is no reason to fail
        let thread = thread::Builder::new().name("progress".into()).spawn(draw);
        Line(thread.ok().map(|thread| (sender, thread)))
    }
}

impl Drop for Line {
    /// Clears the line.
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.0.take() {
            drop(sender);
            let _ = thread.join();
        }
    }
}

/// Puts a text over one of `length` characters; there is nobody to tell if that fails.
fn put(text: &str, length: usize) {
    let mut stderr = io::stderr().lock();
    let rest = length.saturating_sub(text.chars().count());
    let back = if text.is_empty() { "\r" } else { "" };
    let _ = write!(stderr, "\r{text}{:rest$}{back}", "").and_then(|()| stderr.flush());
}

/// `four-bar [=========>              ]  40 %  3.2 s`.
fn render(label: &str, share: Option<f64>, elapsed: Duration) -> String {
    let seconds = elapsed.as_secs();
    let time = match seconds {
        0..10 => format!("{} s", number(elapsed.as_secs_f64(), 2)),
        10..120 => format!("{seconds} s"),
        _ => format!("{} min {} s", seconds / 60, seconds % 60),
    };
    let Some(share) = share else {
        return format!("{label}  {time}");
    };
    // whole characters and percents are those behind us
    let done = ((share * WIDTH as f64) as usize).min(WIDTH);
    let bar = format!(
        "{}{}",
        "=".repeat(done),
        if done < WIDTH { ">" } else { "" }
    );
    format!(
        "{label} [{bar:WIDTH$}] {:3} %  {time}",
        (share * 100.0) as u32
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_tells_share_and_time() {
        let at =
            |share, milliseconds| render("four-bar", share, Duration::from_millis(milliseconds));
        assert_eq!(
            at(Some(0.0), 500),
            "four-bar [>                       ]   0 %  0.5 s"
        );
        assert_eq!(
            at(Some(0.5), 3210),
            "four-bar [============>           ]  50 %  3.2 s"
        );
        assert_eq!(
            at(Some(0.999), 59_900),
            "four-bar [=======================>]  99 %  59 s"
        );
        assert_eq!(
            at(Some(1.0), 200_000),
            "four-bar [========================] 100 %  3 min 20 s"
        );
        assert_eq!(at(None, 12_000), "four-bar  12 s");
    }

    #[test]
    fn no_line_is_longer_than_a_narrow_terminal() {
        let label: String = "x".repeat(LABEL);
        assert!(
            render(&label, Some(1.0), Duration::from_secs(86_400))
                .chars()
                .count()
                < 80
        );
    }
}
