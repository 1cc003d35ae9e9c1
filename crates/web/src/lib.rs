//! The engine for a page in a browser: [`Desk`] holds a model and answers what is asked of it. Texts in and out are JSON or words; numbers
//! are typed arrays. What is wrong with a model is an answer, never an exception; after a trap [`last_panic`] says what happened, and the
//! page starts the engine anew.

mod desk;
mod hold;
mod picture;
mod read;
mod what;

pub use desk::Desk;
pub use picture::Picture;
pub use what::{last_panic, model_text, models, schema, version};
