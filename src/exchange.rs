//! Mechanisms in the files of other programs.

pub use linkdyn_exchange::{Format, LeftOut, Options, Refused};

use crate::{Error, Mechanism};

impl Mechanism {
    /// Reads a mechanism of another program, and lists what of it a model lacks. `name` is that of the file, which says the format
    /// together with the first characters where `format` does not.
    ///
    /// # Errors
    /// [`Error::Foreign`] where it can't be read, [`Error::Model`] where it makes no model.
    ///
    /// # Examples
    /// ```
    /// use linkdyn::exchange::Options;
    /// use linkdyn::prelude::*;
    ///
    /// let table = "joint,x [mm],y [mm],bodies\nA,0,0,ground crank\nB,30,40,crank\n";
    /// let (mechanism, left_out) = Mechanism::import("crank.csv", table.as_bytes(), None, &Options::default())?;
    /// assert_eq!(mechanism.name(), "crank");
    /// assert!(left_out.is_empty());
    /// # Ok::<(), linkdyn::Error>(())
    /// ```
    pub fn import(
        name: &str,
        bytes: &[u8],
        format: Option<Format>,
        options: &Options,
    ) -> Result<(Mechanism, Vec<LeftOut>), Error> {
        let imported = linkdyn_exchange::import(name, bytes, format, options)?;
        let text = imported.draft.text().into_bytes();
        Ok((Mechanism::read("model", text)?, imported.left_out))
    }
}
