//! The machine that measures.

use std::path::Path;
use std::{env, fs, thread};

/// Processor, cores and system, in a line.
pub fn machine() -> String {
    let info = fs::read_to_string(Path::new("/proc/cpuinfo")).unwrap_or_default();
    let field = |name: &str| {
        let line = info.lines().find(|line| line.starts_with(name))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let processor = field("model name").or_else(|| field("Model")).unwrap_or_else(|| "processor not named".into());
    let cores = thread::available_parallelism().map_or(1, |cores| cores.get());
    format!("{processor}, {cores} cores, {} {}", env::consts::OS, env::consts::ARCH)
}
