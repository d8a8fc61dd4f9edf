//! `cargo run -p lab --release -- NAME` runs a command of the laboratory.

use std::process::ExitCode;

use fmu_build::tools::program;
use lab::command_line;

fn main() -> ExitCode {
    match command_line::parse(std::env::args_os()) {
        Ok(command) => program::end(command.run()),
        Err(stop) => stop.report(),
    }
}
