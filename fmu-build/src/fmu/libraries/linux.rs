//! Library for Linux on x86-64 and on ARM, linked by zig so that it runs on systems as old as glibc 2.17.

use std::process::Command;

use anyhow::Result;

use super::compile::{cargo, distributable};
use super::library::{AddedPart, CROSS, Library};
use crate::fmu::toolchains::{self, ARM_TARGET, Compiler, GLIBC};
use crate::tools::paths;
use crate::tools::python::Environment;

/// A kind of machine.
struct Machine {
    /// Names of the platform in FMI 2.0, in FMI 3.0 and for pip.
    platform: [&'static str; 3],
    /// Rust's name of the target.
    target: &'static str,
    /// Description of the processor.
    processor: &'static str,
}

const X86_64: Machine = Machine {
    platform: ["linux64", "x86_64-linux", "manylinux_2_17_x86_64"],
    target: "x86_64-unknown-linux-gnu",
    processor: "x86-64",
};
/// FMI 2.0.4 (2.3) uses the names of FMI 3.0 for all platforms that it does not name itself.
const ARM: Machine = Machine {
    platform: ["aarch64-linux", "aarch64-linux", "manylinux_2_17_aarch64"],
    target: ARM_TARGET,
    processor: "64-bit ARM",
};

/// Returns the linker if it is installed and can run here.
fn zig() -> Option<Environment> {
    toolchains::old_linux().found().filter(|_| CROSS)
}

/// True if the tool chain for x86-64 is installed.
pub(super) fn has_x86_64() -> bool {
    zig().is_some()
}

/// True if the tool chain for ARM is installed.
pub(super) fn has_arm() -> bool {
    zig().is_some() && toolchains::for_arm().is_some()
}

/// Builds the library for x86-64 if its tool chain is installed.
pub(super) fn x86_64() -> Result<Option<Library>> {
    zig().map(|zig| built(&zig, &Compiler::Installed, &X86_64)).transpose()
}

/// Builds the library for ARM if its tool chain is installed.
pub(super) fn arm() -> Result<Option<Library>> {
    zig().zip(toolchains::for_arm()).map(|(zig, compiler)| built(&zig, &compiler, &ARM)).transpose()
}

fn built(zig: &Environment, compiler: &Compiler, machine: &Machine) -> Result<Library> {
    let programs = zig.programs();
    let [platform, in_fmi3, in_wheels] = machine.platform;
    let mut command = Command::new(programs.join("cargo-zigbuild"));
    command
        .args(["zigbuild", "--target", &format!("{}.{GLIBC}", machine.target)])
        .env("CARGO", cargo())
        .env("PATH", toolchains::path_with(&programs)?)
        .env("ZIG_GLOBAL_CACHE_DIR", paths::toolchains().join("zig-cache"));
    compiler.compile(&mut command);
    let [file, answers] = distributable(command, platform, "so", &[])?;
    let unwinder = AddedPart {
        name: "LLVM libunwind",
        licence: "Apache-2.0 WITH LLVM-exception",
        text: zig.packages()?.join("ziglang").join("lib").join("libunwind").join("LICENSE.TXT"),
    };
    Ok(Library {
        platform,
        in_fmi3: vec![(in_fmi3, file.clone())],
        in_wheels,
        ending: "so",
        file,
        answers,
        needs: format!("Linux on {} with glibc {GLIBC} or newer", machine.processor),
        added: vec![unwinder],
    })
}
