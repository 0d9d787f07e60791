//! Study files: from TOML and tables to a checked [`input::Study`].

pub mod input;
pub mod progress;
pub mod templates;

pub use input::{InputError, InputErrors, Study, load_study};
pub use progress::ProgressEvent;
