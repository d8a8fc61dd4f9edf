//! Compilation of crates for WebAssembly.

use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

use crate::fmu::libraries;
use crate::fmu::toolchains::{Compiler, WASM_TARGET};
use crate::tools::paths;
use crate::tools::python::finish;

/// Number of codegen units and level of optimisation of a build in less time. They are the same for all libraries, so that
/// the standard library and the crates of other authors are compiled once.
pub const QUICK: [&str; 2] = ["16", "2"];

/// Crate of the model.
const MODEL: &str = libraries::CRATES[0];

/// A crate with its compiler settings.
pub struct WasmCrate<'a> {
    /// Name of the crate.
    pub package: &'a str,
    /// Number of codegen units, and level of optimisation. With one unit, the important functions are inlined.
    pub settings: [&'a str; 2],
    /// Level of optimisation of the model's own crate, if it differs.
    pub model_level: Option<&'a str>,
    /// Options of the linker. The crates on which this one stands are compiled without them.
    pub link: &'a [&'a str],
}

impl WasmCrate<'_> {
    /// Compiles the library with `tools`; `problem` is the start of the error.
    pub fn compiled(&self, tools: &Compiler, problem: &'static str) -> Result<PathBuf> {
        let folder = paths::target().join("cross").join("wasm");
        let [parts, level] = self.settings;
        let mut cargo = Command::new(libraries::cargo());
        cargo
            .current_dir(paths::workspace())
            .args(["rustc", "--release", "--quiet", "--lib", "--package", self.package])
            .args(["--target", WASM_TARGET, "--target-dir"])
            .arg(&folder)
            // independent of the settings of this build
            .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", parts)
            .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", level)
            .env("CARGO_ENCODED_RUSTFLAGS", libraries::without_folders().join("\u{1f}"));
        if let Compiler::Unpacked(tools) = tools {
            cargo
                .arg("-Zbuild-std=std,panic_abort")
                .env("RUSTC", tools.programs().join("rustc"))
                // Debian's Rust is stable, but building the standard library is an unstable feature
                .env("RUSTC_BOOTSTRAP", "1")
                .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", tools.programs().join("wasm-ld"));
        }
        cargo.args(self.model_level.map(|level| format!("--config=profile.release.package.{MODEL}.opt-level={level}")));
        cargo.arg("--").args(self.link.iter().map(|option| format!("-Clink-arg={option}")));
        finish(&mut cargo, problem)?;
        let file = format!("{}.wasm", self.package.replace('-', "_"));
        Ok(folder.join(WASM_TARGET).join("release").join(file))
    }
}
