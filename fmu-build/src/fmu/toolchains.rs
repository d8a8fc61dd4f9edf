//! The tool chains for other machines, each in a separate folder of target/toolchains. None is required: packaging uses those
//! that are installed.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use bevel_differential::variables;
use clap::Args;

use crate::tools::paths;
use crate::tools::progress::Progress;
use crate::tools::python::Wanted;

/// The command that installs them, for hints.
pub const COMMAND: &str = "cargo run --release -- toolchains";

/// Oldest glibc that the library for Linux is linked for.
pub const GLIBC: &str = "2.17";

/// Rust's names of the targets for Windows and for browsers.
pub const WINDOWS_TARGET: &str = "x86_64-pc-windows-gnu";
/// The second one.
pub const WASM_TARGET: &str = "wasm32-unknown-unknown";

/// Oldest Rust that compiles the library.
const OLDEST_RUST: &str = env!("CARGO_PKG_RUST_VERSION");

/// Installs the tool chains for old Linux systems, for Windows, with wine, for browsers and for sources in C in target/toolchains
///
/// They need Debian on x86-64, 500 MB to download and 3 GB on disk. Packaging uses them from then on.
#[derive(Args, Clone, Debug)]
pub struct ToolchainsCommand {
    /// Install only this one
    #[arg(value_parser = ["linux64", "win64", "wasm", "sources"])]
    platform: Option<String>,
}

impl ToolchainsCommand {
    /// Installs what is missing and prints where it is.
    pub fn run(&self) -> Result<()> {
        if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
            bail!(
                "the tool chains are programs for Linux on x86-64; elsewhere the FMU holds this machine's library alone"
            );
        }
        let wanted = |name: &str| self.platform.as_deref().is_none_or(|only| only == name);
        let progress = Progress::start("looking for Python");
        let mut made = Vec::new();
        if wanted("linux64") {
            let linux = old_linux().made(|what| progress.stage(what))?;
            made.push(format!("linux64 for glibc {GLIBC}: {}", paths::shown(&linux.programs())));
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
            let place = match Wasm::found() {
                Some(Wasm::Rustup) => format!("rustup's target {WASM_TARGET}, nothing to install"),
                _ => paths::shown(&WASM.made(&progress)?.programs()),
            };
            made.push(format!("browsers:              {place}"));
        }
        progress.finish();
        println!("{}", made.join("\n"));
        Ok(())
    }
}

/// The linker for old Linux systems.
pub fn old_linux() -> Wanted {
    let requirements = paths::workspace().join("fmu-build").join("cross").join("requirements.txt");
    Wanted { folder: paths::toolchains().join("linux"), requirements, holds: "zig, cargo-zigbuild" }
}

/// What turns WebAssembly into C; the tool chain for WebAssembly goes with it.
pub fn sources() -> Wanted {
    let requirements = paths::workspace().join("fmu-build").join("cross").join("sources.txt");
    Wanted { folder: paths::toolchains().join("sources"), requirements, holds: "wasm2c" }
}

/// A tool chain that a script in fmu-build/cross unpacks from Debian's packages.
pub struct DebianToolchain {
    /// Name of its folder and of its script.
    name: &'static str,
    /// What is unpacked, in words.
    what: &'static str,
}

/// Rust for Windows, a linker, and wine.
pub const WINDOWS: DebianToolchain =
    DebianToolchain { name: "windows", what: "Rust, MinGW and wine for Windows (280 MB to download)" };
/// Rust for WebAssembly and a linker.
const WASM: DebianToolchain =
    DebianToolchain { name: "wasm", what: "Rust and a linker for WebAssembly (150 MB to download)" };

impl DebianToolchain {
    /// The tool chain, if the present scripts installed it.
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
        fs::write(unpacked.stamp(), self.wanted_stamp()?)?;
        Ok(unpacked)
    }

    fn folder(&self) -> UnpackedToolchain {
        UnpackedToolchain(paths::toolchains().join(self.name))
    }

    /// Changes with the scripts, and with the oldest Rust that will do.
    fn wanted_stamp(&self) -> Result<String> {
        let mut scripts = OLDEST_RUST.as_bytes().to_vec();
        for name in ["debian", self.name] {
            let script = script(name);
            scripts.extend(fs::read(&script).with_context(|| format!("{} cannot be read", paths::shown(&script)))?);
        }
        Ok(format!("{:016x}\n", variables::fnv1a(scripts.into_iter())))
    }
}

/// What compiles for browsers.
pub enum Wasm {
    /// rustup's own target, with its linker.
    Rustup,
    /// Debian's Rust.
    Unpacked(UnpackedToolchain),
}

impl Wasm {
    /// rustup's target if it is installed, otherwise what was unpacked.
    pub fn found() -> Option<Self> {
        if has_target(WASM_TARGET) { Some(Self::Rustup) } else { WASM.found().map(Self::Unpacked) }
    }
}

/// Whether the Rust of this machine has the standard library of a target, as rustup installs it.
pub fn has_target(target: &str) -> bool {
    let output = Command::new("rustc").args(["--print", "target-libdir", "--target", target]).output();
    output.is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir())
}

/// A folder with an unpacked tool chain.
pub struct UnpackedToolchain(PathBuf);

impl UnpackedToolchain {
    fn stamp(&self) -> PathBuf {
        self.0.join("stamp")
    }

    /// The folder with the programs to call: rustc, a linker, wine64.
    pub fn programs(&self) -> PathBuf {
        self.0.join("bin")
    }

    /// The folder that the packages are unpacked to.
    pub fn root(&self) -> PathBuf {
        self.0.join("root")
    }
}

/// The search path with `folder` before all others.
pub fn path_with(folder: &Path) -> Result<OsString> {
    let path = env::var_os("PATH").unwrap_or_default();
    let folders = std::iter::once(folder.to_path_buf()).chain(env::split_paths(&path));
    env::join_paths(folders).with_context(|| format!("{} cannot be put into PATH", folder.display()))
}

fn script(name: &str) -> PathBuf {
    paths::workspace().join("fmu-build").join("cross").join(format!("{name}.sh"))
}
