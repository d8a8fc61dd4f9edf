//! Commands that run the checking scripts of crates/lab/python.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use bevel_differential::model::EFFECTS;
use clap::{Arg, ArgMatches, value_parser};
use fmu_build::command_line::LABORATORY;
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;

use super::{platforms, sources};
use crate::tools::script::{DEFAULTS, Given, Needs, Script, flag, number};

/// Test of the wheel on a machine without Rust.
pub const WHEEL: Script = Script {
    name: "test-wheel",
    about: "Installs the wheel in a fresh environment without Rust, and checks it there: examples, bits against fmpy, a sweep",
    options: || {
        let help = "The wheel [default: the one that the command `wheel` built]";
        vec![Arg::new("wheel").value_name("WHEEL").help(help).value_parser(value_parser!(PathBuf))]
    },
    file: "crates/lab/python/wheel.py",
    doing: "creating a new Python environment",
    given: &[Given::Made(wheel), Given::Target("wheel")],
    ..DEFAULTS
};

fn wheel(options: &ArgMatches, _: &Progress) -> Result<Vec<OsString>> {
    let wheel = match options.get_one::<PathBuf>("wheel") {
        Some(file) => file.clone(),
        None => {
            let begin = format!("bevel_differential-{}-py3-none-", env!("CARGO_PKG_VERSION"));
            newest(&paths::wheel(), &begin).with_context(|| {
                format!("no wheel is in {}; build it: cargo run --release -- wheel", paths::shown(&paths::wheel()))
            })?
        }
    };
    let found = wheel.canonicalize().with_context(|| format!("{} cannot be read", paths::shown(&wheel)))?;
    Ok(vec![found.into()])
}

/// Newest wheel in the folder, because names differ between platforms.
fn newest(folder: &Path, begin: &str) -> Option<PathBuf> {
    let files = fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
    let wheels = files.filter(|file| {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(begin) && name.ends_with(".whl")
    });
    wheels.max_by_key(|file| fs::metadata(file).and_then(|metadata| metadata.modified()).ok())
}

/// Cost of inactive effects: bits, and instructions counted by valgrind.
pub const ZERO_COST: Script = Script {
    name: "zero-cost",
    about: "Checks that inactive effects cost nothing, compared with a build without effects in bits and instructions (needs valgrind)",
    options: || {
        vec![
            flag("quick", "Leave out what each effect costs when it is on").conflicts_with("write"),
            flag("write", "Also renew the table in docs/inside/cost.md"),
        ]
    },
    file: "crates/lab/python/zero_cost.py",
    doing: "counting",
    given: &[Given::Target(BUILD), Given::Made(effects_on)],
    sections: &[("docs/inside/cost.md", "off", "")],
    ..DEFAULTS
};
/// Folder in which both commands build the stepping program.
const BUILD: &str = "off";

fn effects_on(options: &ArgMatches, _: &Progress) -> Result<Vec<OsString>> {
    Ok(EFFECTS.iter().filter(|_| !options.get_flag("quick")).map(|effect| effect.name.into()).collect())
}

/// Cost of the steps of the fixed-step method, in instructions.
pub const REAL_TIME: Script = Script {
    name: "real-time",
    about: "Checks that no step of the fixed-step method costs more than twice the median, in instructions (needs valgrind)",
    options: || {
        vec![
            flag("quick", "Leave out steps of 10 µs and the levels").conflicts_with("write"),
            flag("write", "Also renew the tables in docs/inside/cost.md and docs/accuracy.md"),
        ]
    },
    file: "crates/lab/python/real_time.py",
    doing: "counting",
    given: &[Given::Target("real-time"), Given::Target(BUILD), Given::Named("quick")],
    sections: &[("docs/inside/cost.md", "real-time", ""), ("docs/accuracy.md", "levels", "levels.md")],
    ..DEFAULTS
};

/// Check of the unit as sources in C: bits, warnings, calls of the C library, time to compile, traps.
pub const SOURCES: Script = Script {
    name: "sources",
    about: "Checks that the unit as sources in C gives the same bits with several compilers, on x86-64 and on ARM under qemu",
    more: Some(
        "It needs the tool chains `sources` and, for clang and ARMv7, `linux64`; for ARM apt install gcc-aarch64-linux-gnu \
         libc6-dev-arm64-cross qemu-user. Missing compilers are left out.",
    ),
    options: || {
        vec![
            flag("quick", "Only gcc -O1, and six scenes"),
            flag("write", "Also renew docs/inside/hosts.md").conflicts_with("quick"),
        ]
    },
    needs: Needs::Tests,
    file: "crates/lab/python/sources.py",
    doing: "comparing",
    folder: Some("sources"),
    given: &[Given::Named("quick"), Given::Folder, Given::Made(sources::arguments)],
    sections: &[("docs/inside/hosts.md", "sources", "")],
    ..DEFAULTS
};

/// Search for source changes that no test notices. The changes are drawn by a seed from the modules with the physics,
/// compiled together, and tested one by one.
pub const MUTANTS: Script = Script {
    name: "mutants",
    about: "Changes the source in one place at a time and lists the changes that no test notices (continues where it was stopped)",
    options: || {
        vec![
            number("count", "COUNT", "120", "Number of changes"),
            number("seed", "SEED", "1", "Seed of the draw"),
            flag("write", "Also renew the report in docs/inside/architecture.md"),
        ]
    },
    needs: Needs::Own(["crates/lab/python/mutants", "mutants/venv", "tree-sitter, fmpy"]),
    file: "crates/lab/python/mutants/campaign.py",
    doing: "trying changes",
    folder: Some("mutants/{seed}-{count}"),
    given: &[Given::Workspace, Given::Folder, Given::Value("count"), Given::Value("seed")],
    sections: &[("docs/inside/architecture.md", "mutants", "")],
    ..DEFAULTS
};

/// Test of units with a wrong coefficient against their evidence.
pub const COEFFICIENTS: Script = Script {
    name: "coefficients",
    about: "Makes coefficients of the physics 2 % larger, one at a time, and lists what `verify` notices",
    options: || {
        vec![
            number("count", "COUNT", "20", "Number of coefficients"),
            number("seed", "SEED", "1", "Seed of the draw"),
            flag("write", "Also renew docs/coefficients.csv"),
        ]
    },
    needs: MUTANTS.needs,
    file: MUTANTS.file,
    doing: "verifying",
    folder: Some("coefficients/{seed}-{count}"),
    given: &[Given::Workspace, Given::Folder, Given::Value("count"), Given::Value("seed"), Given::Fmu],
    sections: &[("docs/coefficients.csv", "", "coefficients.csv")],
    ..DEFAULTS
};

/// Random ordinary drives, checked against the requirements of daily life: they finish in balance, held wheels stand
/// still, and steps are few.
pub const DRIVES: Script = Script {
    name: "drives",
    about: "Checks random ordinary drives: launches, stops, holds, turns and parking of vehicles from a pedal car to a truck",
    more: Some("Drives alternate between three seeds. A drive that violates a requirement is written as JSON."),
    options: || {
        let index = Arg::new("index").long("index").value_name("INDEX").value_parser(value_parser!(u64));
        vec![
            number("count", "COUNT", "1000", "Number of drives"),
            number("seed", "SEED", "1", "The first of the three seeds"),
            index.help("Only this drive of the first seed, in detail"),
        ]
    },
    file: "crates/lab/python/drives.py",
    doing: "driving",
    folder: Some("drives"),
    given: &[Given::Fmu, Given::Folder, Given::Value("seed"), Given::Value("count"), Given::Made(one_drive)],
    ..DEFAULTS
};

/// Command line of the users, and the index of a single drive.
fn one_drive(options: &ArgMatches, _: &Progress) -> Result<Vec<OsString>> {
    let index = options.get_one::<u64>("index").map(|index| index.to_string().into());
    Ok(std::iter::once(format!("{LABORATORY} drives").into()).chain(index).collect())
}

/// The packaged FMU in other hosts: each host runs each scene, and all are compared with fmpy.
pub const HOSTS: Script = Script {
    name: "hosts",
    about: "Runs the FMU in other FMI hosts on the same scenes and compares their results with fmpy's",
    options: || {
        vec![
            flag("require", "Fail if a host cannot be loaded"),
            flag("write", "Also renew docs/inside/hosts.md"),
            flag("with-fmi-sim", "Also run fmi-sim (builds for many minutes)"),
        ]
    },
    needs: Needs::Own(["tests/hosts", "hosts/venv", "fmpy, libcosimpy, ecospy, FMU Manipulation Toolbox, CasADi"]),
    file: "crates/lab/python/hosts.py",
    doing: "running hosts",
    folder: Some("hosts"),
    given: &[Given::Fmu, Given::PlainFmu, Given::Folder, Given::Named("require"), Given::Named("with-fmi-sim")],
    sections: &[("docs/inside/hosts.md", "hosts", "")],
    ..DEFAULTS
};

/// Comparison of the libraries that can run here, if necessary under wine or qemu: bits of all outputs, and times.
pub const PLATFORMS: Script = Script {
    name: "platforms",
    about: "Checks that the libraries of all platforms give the same bits, Windows under wine, ARM under qemu; inspects the one for macOS",
    options: || vec![flag("write", "Also renew docs/inside/hosts.md")],
    needs: Needs::Tests,
    file: "crates/lab/python/platforms.py",
    doing: "comparing",
    given: &[Given::Made(platforms::arguments)],
    sections: &[("docs/inside/hosts.md", "platforms", "")],
    ..DEFAULTS
};
