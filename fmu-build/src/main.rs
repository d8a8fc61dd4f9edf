//! `cargo run --release` simulates the study and compares the results with it (docs/study.md). Other commands follow
//! `--`.

use std::process::ExitCode;

use fmu_build::command_line;
use fmu_build::tools::program;

fn main() -> ExitCode {
    match command_line::parse(std::env::args_os()) {
        Ok(command) => program::end(command.run()),
        Err(stop) => stop.report(),
    }
}
