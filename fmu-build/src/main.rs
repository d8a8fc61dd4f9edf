//! `cargo run --release` runs the study; other commands follow `--`.

use std::process::ExitCode;

use fmu_build::command_line::{self, USAGE};
use fmu_build::tools::usage::UsageError;

fn main() -> ExitCode {
    let command = match command_line::parse(std::env::args_os()) {
        Ok(command) => command,
        Err(stop) => return stop.report(),
    };
    match command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            if error.is::<UsageError>() { ExitCode::from(USAGE) } else { ExitCode::FAILURE }
        }
    }
}
