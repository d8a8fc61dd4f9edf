//! Tool chains for other machines, each in a separate folder of target/toolchains. None is required: packaging uses the
//! installed ones.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use bevel_differential::variables;
use clap::Args;

use crate::tools::files::write_whole;
use crate::tools::lock::Lock;
use crate::tools::paths;
use crate::tools::progress::Progress;
use crate::tools::python::Wanted;

/// Command that installs the tool chains, for hints.
pub const COMMAND: &str = "cargo run --release -- toolchains";

/// Oldest glibc that the library for Linux supports.
pub const GLIBC: &str = "2.17";

/// Rust's name of the target for Windows.
pub const WINDOWS_TARGET: &str = "x86_64-pc-windows-gnu";
/// Rust's name of the target for browsers.
pub const WASM_TARGET: &str = "wasm32-unknown-unknown";
/// Rust's name of the target for Linux on ARM.
pub const ARM_TARGET: &str = "aarch64-unknown-linux-gnu";
/// Rust's names of the targets for macOS on x86-64 and on ARM.
pub const DARWIN_TARGETS: [&str; 2] = ["x86_64-apple-darwin", "aarch64-apple-darwin"];

/// Oldest Rust that compiles the library.
const OLDEST_RUST: &str = env!("CARGO_PKG_RUST_VERSION");

/// Installs the tool chains for old Linux systems, ARM, macOS, Windows, browsers and sources in C, with qemu and wine, in
/// target/toolchains
///
/// They need Debian on x86-64, 600 MB to download and 3 GB on disk. Packaging uses them from then on.
#[derive(Args, Clone, Debug)]
pub struct ToolchainsCommand {
    /// Install only this one
    #[arg(value_parser = ["linux64", "aarch64-linux", "darwin64", "win64", "wasm", "sources"])]
    platform: Option<String>,
}

impl ToolchainsCommand {
    /// Installs missing tool chains and prints their paths.
    pub fn run(&self) -> Result<()> {
        if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
            bail!(
                "the tool chains are programs for Linux on x86-64; elsewhere the FMU contains only this machine's library"
            );
        }
        let wanted = |name: &str| self.platform.as_deref().is_none_or(|only| only == name);
        let progress = Progress::start("looking for Python");
        let mut made = Vec::new();
        // zig also links for ARM, and its package contains the stub of macOS' system library (libSystem.tbd)
        if ["linux64", "aarch64-linux", "darwin64"].into_iter().any(wanted) {
            let linux = old_linux().made(|what| progress.stage(what))?;
            made.push(format!("linux64 for glibc {GLIBC}: {}", paths::shown(&linux.programs())));
        }
        if wanted("aarch64-linux") {
            Compiler::made(&[ARM_TARGET], &progress)?;
            let arm = ARM.made(&progress)?;
            made.push(format!("aarch64-linux, qemu:   {}", paths::shown(&arm.programs())));
        }
        if wanted("darwin64") {
            Compiler::made(&DARWIN_TARGETS, &progress)?;
            let darwin = DARWIN.made(&progress)?;
            made.push(format!("darwin64:              {}", paths::shown(&darwin.programs())));
        }
        if wanted("win64") {
            let windows = WINDOWS.made(&progress)?;
            made.push(format!("win64, and wine:       {}", paths::shown(&windows.programs())));
        }
        if wanted("sources") {
            let sources = sources().made(|what| progress.stage(what))?;
            made.push(format!("C from WebAssembly:    {}", paths::shown(&sources.programs())));
        }
        if wanted("wasm") || wanted("sources") {
            let place = match Compiler::made(&[WASM_TARGET], &progress)? {
                Compiler::Installed => format!("rustup's target {WASM_TARGET}, nothing to install"),
                Compiler::Unpacked(tools) => paths::shown(&tools.programs()),
            };
            made.push(format!("browsers:              {place}"));
        }
        progress.finish();
        println!("{}", made.join("\n"));
        Ok(())
    }
}

/// Linker for old Linux systems, on x86-64 and on ARM.
pub fn old_linux() -> Wanted<'static> {
    let requirements = paths::workspace().join("fmu-build").join("cross").join("requirements.txt");
    Wanted { folder: paths::toolchains().join("linux"), requirements, holds: "zig, cargo-zigbuild" }
}

/// Translator from WebAssembly to C. It needs the tool chain for WebAssembly.
pub fn sources() -> Wanted<'static> {
    let requirements = paths::workspace().join("fmu-build").join("cross").join("sources.txt");
    Wanted { folder: paths::toolchains().join("sources"), requirements, holds: "wasm2c" }
}

/// A tool chain that a script in fmu-build/cross unpacks from Debian's packages.
pub struct DebianToolchain {
    /// Name of the folder and of the script.
    name: &'static str,
    /// Description of the unpacked programs.
    what: &'static str,
}

/// Rust for Windows, a linker, and wine.
pub const WINDOWS: DebianToolchain =
    DebianToolchain { name: "windows", what: "Rust, MinGW and wine for Windows (280 MB to download)" };
/// Rust for browsers, ARM and macOS, and linkers.
const RUST: DebianToolchain =
    DebianToolchain { name: "rust", what: "Rust for browsers, ARM and macOS (150 MB to download)" };
/// Programs that run the library for ARM: qemu and glibc.
pub const ARM: DebianToolchain =
    DebianToolchain { name: "aarch64", what: "qemu and glibc for ARM (64 MB to download)" };
/// Linker for macOS.
pub const DARWIN: DebianToolchain = DebianToolchain { name: "darwin", what: "the linker for macOS" };

impl DebianToolchain {
    /// Returns the tool chain if the present scripts installed it.
    pub fn found(&self) -> Option<UnpackedToolchain> {
        let unpacked = self.folder();
        let wanted = self.wanted_stamp().ok()?;
        fs::read_to_string(unpacked.stamp()).is_ok_and(|found| found == wanted).then_some(unpacked)
    }

    fn made(&self, progress: &Progress) -> Result<UnpackedToolchain> {
        if let Some(unpacked) = self.found() {
            return Ok(unpacked);
        }
        let unpacked = self.folder();
        let _alone = Lock::of(&unpacked.0)?;
        // another run may have installed it while this one waited
        if let Some(unpacked) = self.found() {
            return Ok(unpacked);
        }
        progress.stage(&format!("unpacking {}", self.what));
        let output = Command::new("bash")
            .arg(script(self.name))
            .arg(&unpacked.0)
            .arg(OLDEST_RUST)
            .stdin(Stdio::null())
            .output()
            .context("bash, which unpacks tool chains, cannot be run")?;
        if !output.status.success() {
            let messages = String::from_utf8_lossy(&output.stderr);
            bail!("the tool chain {} cannot be installed: {}", self.name, messages.trim_end());
        }
        write_whole(&unpacked.stamp(), self.wanted_stamp()?.as_bytes())?;
        Ok(unpacked)
    }

    fn folder(&self) -> UnpackedToolchain {
        UnpackedToolchain(paths::toolchains().join(self.name))
    }

    /// Content of the stamp file of an up-to-date tool chain: a hash of the scripts and of the oldest supported Rust.
    fn wanted_stamp(&self) -> Result<String> {
        let mut scripts = OLDEST_RUST.as_bytes().to_vec();
        for name in ["debian", self.name] {
            let script = script(name);
            scripts.extend(fs::read(&script).with_context(|| format!("{} cannot be read", paths::shown(&script)))?);
        }
        Ok(format!("{:016x}\n", variables::fnv1a(scripts.into_iter())))
    }
}

/// Compiler for targets whose standard library this machine may lack.
pub enum Compiler {
    /// The Rust of this machine, with rustup's own targets.
    Installed,
    /// Debian's Rust.
    Unpacked(UnpackedToolchain),
}

impl Compiler {
    /// Finds rustup's targets if all of them are installed, otherwise the unpacked compiler.
    pub fn found(targets: &[&str]) -> Option<Self> {
        let installed = targets.iter().all(|target| has_target(target));
        if installed { Some(Self::Installed) } else { RUST.found().map(Self::Unpacked) }
    }

    fn made(targets: &[&str], progress: &Progress) -> Result<Self> {
        Self::found(targets).map_or_else(|| RUST.made(progress).map(Self::Unpacked), Ok)
    }

    /// Sets up `cargo` to use this compiler. With Debian's Rust, cargo also compiles the standard library, because
    /// the unpacked packages contain only its source for these targets.
    pub fn compile(&self, cargo: &mut Command) {
        if let Self::Unpacked(tools) = self {
            cargo
                .arg("-Zbuild-std=std,panic_unwind")
                .env("RUSTC", tools.programs().join("rustc"))
                // Debian's Rust is stable, but building the standard library is an unstable feature
                .env("RUSTC_BOOTSTRAP", "1");
        }
    }
}

/// Finds the compiler for Linux on ARM. A compiler that was unpacked for browsers counts only after `toolchains
/// aarch64-linux`, because the FMU should contain only the platforms that were requested.
pub fn for_arm() -> Option<Compiler> {
    if has_target(ARM_TARGET) {
        Some(Compiler::Installed)
    } else {
        ARM.found().and_then(|_| Compiler::found(&[ARM_TARGET]))
    }
}

/// Finds the compiler and the linker for macOS.
pub fn for_darwin() -> Option<(Compiler, UnpackedToolchain)> {
    Compiler::found(&DARWIN_TARGETS).zip(DARWIN.found())
}

/// True if the Rust of this machine has the standard library of a target, as installed by rustup.
pub fn has_target(target: &str) -> bool {
    let output = Command::new("rustc").args(["--print", "target-libdir", "--target", target]).output();
    output.is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir())
}

/// Folder with an unpacked tool chain.
pub struct UnpackedToolchain(PathBuf);

impl UnpackedToolchain {
    fn stamp(&self) -> PathBuf {
        self.0.join("stamp")
    }

    /// Path of the folder.
    pub fn folder(&self) -> &Path {
        &self.0
    }

    /// Folder with the programs to call: rustc, a linker, wine64.
    pub fn programs(&self) -> PathBuf {
        self.0.join("bin")
    }

    /// Folder to which the packages are unpacked.
    pub fn root(&self) -> PathBuf {
        self.0.join("root")
    }
}

/// Search path with `folder` before all others.
pub fn path_with(folder: &Path) -> Result<OsString> {
    let path = env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(folder.to_path_buf()).chain(env::split_paths(&path));
    env::join_paths(folders).with_context(|| format!("{} cannot be put into PATH", folder.display()))
}

fn script(name: &str) -> PathBuf {
    paths::workspace().join("fmu-build").join("cross").join(format!("{name}.sh"))
}
