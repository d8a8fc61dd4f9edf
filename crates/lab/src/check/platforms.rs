//! FMUs that the command `platforms` compares, one for each library, and the programs that run them.

use std::ffi::OsString;

use anyhow::{Result, bail};
use clap::ArgMatches;

use fmu_build::fmu::archive::{self, Packing};
use fmu_build::fmu::libraries::{self, Libraries, Library};
use fmu_build::fmu::toolchains::{self, ARM, WINDOWS};
use fmu_build::tools::progress::{self, Progress};
use fmu_build::tools::{paths, python::Environment};

/// Builds the FMUs and returns the arguments of the script.
pub fn arguments(options: &ArgMatches, progress: &Progress) -> Result<Vec<OsString>> {
    progress.stage("building the library for each platform");
    let Some(zig) = toolchains::old_linux().found() else {
        bail!("the tool chains for other machines are not installed; to get them: {}", toolchains::COMMAND);
    };
    let own = libraries::for_this_machine()?;
    let mut named: Vec<(String, Library)> =
        vec![("linux64, plain".into(), own.clone()), ("linux64, narrow".into(), own)];
    let Libraries { built, left_out, .. } = libraries::build()?;
    if !left_out.is_empty() {
        let left_out = left_out.join("; ");
        if options.get_flag("write") {
            bail!("the documents name all platforms, but {left_out}");
        }
        progress::note(&left_out);
    }
    for library in built {
        let version =
            if library.platform == "linux64" { format!(", glibc {}", toolchains::GLIBC) } else { String::new() };
        // the library for ARM can run here only under qemu
        if library.platform != "aarch64-linux" || ARM.found().is_some() {
            named.push((format!("{}{version}", library.platform), library));
        }
    }
    let folder = paths::target().join("platforms");
    paths::create_folder(&folder)?;
    let mut arguments: Vec<OsString> = vec![paths::scenes().into(), folder.clone().into()];
    arguments.extend(tools(&zig));
    for (index, (name, library)) in named.into_iter().enumerate() {
        let fmu = folder.join(format!("{index}.fmu"));
        archive::write_archive(archive::Version::Two, &[library], None, Packing::Quick, &fmu)?;
        arguments.push(pair(&name, fmu));
    }
    Ok(arguments)
}

/// Programs that run libraries of other systems and processors, and the Python of zig.
fn tools(zig: &Environment) -> Vec<OsString> {
    let wine = WINDOWS.found().map(|tools| pair("wine", tools.programs().join("wine64")));
    let qemu = ARM.found().map(|tools| pair("qemu", tools.programs().join("qemu-aarch64")));
    let python = pair("zig", zig.programs().join("python"));
    [wine, qemu, Some(python)].into_iter().flatten().collect()
}

fn pair(name: &str, value: impl Into<OsString>) -> OsString {
    let mut pair = OsString::from(format!("{name}="));
    pair.push(value.into());
    pair
}
