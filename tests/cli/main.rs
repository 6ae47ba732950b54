//! The program from outside: what each verb writes, what it refuses, and that interrupted runs go on.

mod adhesion;
mod atlas;
mod bed_resume;
mod bed_shipped;
#[path = "../support/browser.rs"]
mod browser;
mod cost;
mod discover;
mod discover_study;
mod explore;
mod film;
#[path = "../support/four_cases.rs"]
mod four_cases;
mod guide;
mod help;
mod impact;
mod init;
mod inverse;
mod killed;
mod kinds;
mod owner;
mod pair;
mod preset;
#[path = "../support/program.rs"]
mod program;
mod reference;
mod report_page;
mod resume;
mod schema;
mod slips;
mod study;
mod study_report;
mod tester;
mod validate;
mod verbs;
