//! The room `explore` without its page.

#[path = "../explore/answer.rs"]
mod answer;
#[path = "../explore/body.rs"]
mod body;
#[path = "../explore/curves.rs"]
mod curves;

pub use answer::answer;
