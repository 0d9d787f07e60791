//! How a run tells its caller how far it is.

/// One sign of life of a run. The callback that takes it answers whether to go on.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgressEvent {
    /// What is being done, such as `load cycle 2`.
    pub label: String,
    /// Share of the run that is done, 0 to 1.
    pub done: f64,
    /// Something worth a line of its own, such as a step that did not converge.
    pub message: Option<String>,
}

impl ProgressEvent {
    /// An event without a message.
    #[must_use]
    pub fn new(label: impl Into<String>, done: f64) -> Self {
        Self {
            label: label.into(),
            done,
            message: None,
        }
    }
}
