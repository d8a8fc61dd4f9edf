//! Sources of the unit in C, generated for the command `sources`.

use std::ffi::OsString;

use anyhow::{Result, anyhow};
use clap::ArgMatches;

use fmu_build::fmu::archive::Packing;
use fmu_build::fmu::package;
use fmu_build::fmu::sources::{self, Tools};
use fmu_build::fmu::toolchains;
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;

/// Builds the sources and returns the arguments of the script: scenes, FMU, sources, zig (empty if not installed).
pub fn arguments(options: &ArgMatches, progress: &Progress) -> Result<Vec<OsString>> {
    let tools = Tools::found().map_err(|remark| anyhow!("{remark}"))?;
    progress.stage("packing the FMU");
    let fmu = package::package()?;
    progress.stage("building the library for sources in C");
    let packing = if options.get_flag("quick") { Packing::Quick } else { Packing::Small };
    let unit = sources::package(&tools, packing, &fmu)?;
    let zig = match toolchains::old_linux().found() {
        Some(tools) => tools.packages()?.join("ziglang").join("zig").into(),
        None => OsString::new(),
    };
    Ok(vec![paths::scenes().into(), fmu.into(), unit.into(), zig])
}
