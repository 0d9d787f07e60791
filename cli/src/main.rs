//! The `sommerfeld` command.
fn main() {}
