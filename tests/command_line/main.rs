//! Tests of the command: what it says, writes and answers, in a browser where there is one.

#[path = "../common/browser.rs"]
mod browser;
#[path = "../common/long.rs"]
mod long;
#[cfg(unix)]
#[path = "../common/tab.rs"]
mod tab;

mod accuracy;
mod assemblies;
mod book;
mod boxes;
mod check;
mod cli;
mod compare;
#[cfg(target_os = "linux")]
mod edit;
mod exchange;
mod export;
mod figures;
mod full_disk;
mod fuzz_finds;
#[cfg(unix)]
mod live;
mod mistakes;
mod optimise;
mod path_time;
mod peaks;
mod report;
mod study;
mod study_page;
#[cfg(unix)]
mod synthesise;
mod terminal;
mod validate;
