//! The page that shows each run of `--watch`, with a slider for each parameter: served to this computer while the command watches.
//!
//! A page from a disk may neither read files nor talk to a program, so `live.html` only leads to the page that is served.

mod routes;
mod state;

use std::path::Path;
use std::sync::Arc;

use linkdyn_ask::ModelFile;
use linkdyn_ask::text::plain;
use linkdyn_engine::analysis::Outcome;
use linkdyn_output::{Directory, WriteError};
use linkdyn_picture::watch_page;

use super::serve::Server;
use super::streams::remark;
use state::State;

const NAME: &str = "live.html";
/// Longest body of a request: values of parameters \[bytes\].
const LONGEST_BODY: usize = 64 * 1024;

/// The page, as long as this lives.
#[derive(Debug)]
pub struct Live {
    directory: Directory,
    state: Arc<State>,
    /// None where the system lets nothing be served.
    server: Option<Server>,
}

impl Live {
    /// Begins with no run of a model's file.
    ///
    /// # Errors
    /// When the page can't be written.
    pub fn new(directory: Directory, model: &Path) -> Result<Self, WriteError> {
        let report = directory.path().join("report.html");
        let state = Arc::new(State::new(model.to_owned(), report));
        let asked = Arc::clone(&state);
        let answers = move |request: &_, path: &str| routes::answer(&asked, request, path);
        let server = match Server::start(LONGEST_BODY, Box::new(answers)) {
            Ok(server) => {
                let entry = watch_page::entry(server.address());
                directory.write(NAME, entry.as_bytes())?;
                Some(server)
            }
            Err(why) => {
                remark(&format!("warning: no page shows the runs: {why}"));
                None
            }
        };
        Ok(Live {
            directory,
            state,
            server,
        })
    }

    /// Lets the page show a run whose report was written just now; a word about where it is.
    pub fn show(&mut self, file: ModelFile, outcome: &Outcome) -> String {
        let Some(server) = &self.server else {
            return String::new();
        };
        self.state.show(file, outcome);
        let page = self.directory.path().join(NAME);
        format!(
            "; {} shows the report of each run ({})",
            page.display(),
            server.address()
        )
    }

    /// Lets the page say what is wrong, above the report of the run before.
    pub fn tell(&self, faults: &[String]) {
        self.state
            .tell(faults.iter().map(|line| plain(line).into_owned()).collect());
    }
}

impl Drop for Live {
    /// Leaves nothing that does not work any more.
    fn drop(&mut self) {
        // What can't be removed is a small file that says so itself.
        let _ = self.directory.remove(NAME);
    }
}
