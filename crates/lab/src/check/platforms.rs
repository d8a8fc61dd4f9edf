//! An FMU for each library: what the command `platforms` compares.

use std::ffi::OsString;

use anyhow::{Result, bail};
use clap::ArgMatches;

use fmu_build::fmu::libraries::{self, Library};
use fmu_build::fmu::package::{self, Packing};
use fmu_build::fmu::toolchains::{self, WINDOWS};
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;

/// The arguments of its script.
pub fn built(_: &ArgMatches, progress: &Progress) -> Result<Vec<OsString>> {
    progress.stage("building the library for each platform");
    let (Some(_), Some(windows)) = (toolchains::old_linux().found(), WINDOWS.found()) else {
        bail!("the tool chains for other machines are not installed; to get them: {}", toolchains::COMMAND);
    };
    let own = libraries::for_this_machine()?;
    let mut named: Vec<(String, Library)> =
        vec![("linux64, plain".into(), own.clone()), ("linux64, narrow".into(), own)];
    let crossed = libraries::build()?.built;
    named.extend(crossed.into_iter().map(|library| {
        let what = if library.platform == "win64" { "wine".into() } else { format!("glibc {}", toolchains::GLIBC) };
        (format!("{}, {what}", library.platform), library)
    }));
    let mut arguments: Vec<OsString> = vec![paths::scenes().into(), windows.programs().join("wine64").into()];
    for (index, (name, library)) in named.into_iter().enumerate() {
        let fmu = paths::target().join("platforms").join(format!("{index}.fmu"));
        package::write_archive(package::Version::Two, &[library], None, Packing::Quick, &fmu)?;
        let mut pair = OsString::from(format!("{name}="));
        pair.push(fmu);
        arguments.push(pair);
    }
    Ok(arguments)
}
