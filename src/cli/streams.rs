//! What goes to which stream: standard output carries what was requested, standard error complaints.

use std::cell::RefCell;
use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;

use linkdyn_ask::text::{Page, plain};
use serde::Serialize;

/// What a command left that another program ran.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Said {
    /// The exit status.
    pub status: u8,
    /// What it printed.
    pub stdout: String,
    /// What it complained of.
    pub stderr: String,
}

thread_local! {
    /// Takes the place of both streams while [`keep`] runs.
    static SAID: RefCell<Option<Said>> = const { RefCell::new(None) };
}

/// Keeps what `run` writes to both streams instead; `run` returns the exit status.
pub fn keep(run: impl FnOnce() -> u8) -> Said {
    SAID.set(Some(Said::default()));
    let status = run();
    Said {
        status,
        ..SAID.take().unwrap_or_default()
    }
}

/// Lets `put` have the streams that are kept; whether they are.
pub fn kept(put: impl FnOnce(&mut Said)) -> bool {
    SAID.with_borrow_mut(|said| said.as_mut().map(put).is_some())
}

/// Writes a fault to standard error, as one line.
pub fn complain(line: &str) {
    remark(&format!("error: {line}"));
}

/// Writes one line to standard error; there is nobody to tell if that fails.
pub fn remark(line: &str) {
    let line = format!("{}\n", plain(line));
    if !kept(|said| said.stderr += &line) {
        let _ = io::stderr().write_all(line.as_bytes());
    }
}

/// Prints an answer in words, and the files that were written.
pub fn tell(mut page: Page, written: &[PathBuf]) -> io::Result<()> {
    let paths = written.iter().map(|path| path.display().to_string());
    page.rows("written", paths);
    print(page.text())
}

/// Prints an answer in words, in colours where a terminal has them and nobody has switched them off (no-color.org).
pub fn print_page(page: &Page) -> io::Result<()> {
    let is_set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    let plain = is_set("NO_COLOR").is_some() || is_set("TERM").is_some_and(|name| name == "dumb");
    match plain || SAID.with_borrow(Option::is_some) || !io::stdout().is_terminal() {
        true => print(page.text()),
        false => print(&page.coloured()),
    }
}

/// Prints an answer for programs.
pub fn tell_json(answer: &impl Serialize) -> io::Result<()> {
    print(&json(answer)?)
}

/// An answer as the text of a file for programs.
pub fn json(answer: &impl Serialize) -> io::Result<String> {
    Ok(serde_json::to_string_pretty(answer)? + "\n")
}

/// Writes to standard output; a reader that has gone away (`| head`) is no error.
pub fn print(text: &str) -> io::Result<()> {
    print_with(|out| out.write_all(text.as_bytes()))
}

/// The same for UTF-8 text that is written piece by piece.
pub fn print_with(mut content: impl FnMut(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    if SAID.with_borrow(Option::is_some) {
        let mut bytes = Vec::new();
        content(&mut bytes)?;
        kept(|said| said.stdout += &String::from_utf8_lossy(&bytes));
        return Ok(());
    }
    let mut stdout = io::BufWriter::new(io::stdout().lock());
    match content(&mut stdout).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}
