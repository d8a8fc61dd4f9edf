//! Compilation of crates for WebAssembly.

use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

use crate::fmu::libraries;
use crate::fmu::toolchains::{Compiler, WASM_TARGET};
use crate::tools::paths;
use crate::tools::python::finish;

/// A crate with its compiler settings.
pub struct WasmCrate<'a> {
    /// Name of the crate.
    pub package: &'a str,
    /// Number of codegen units. With one unit, the important functions are inlined.
    pub parts: &'a str,
    /// Level of optimisation.
    pub level: &'a str,
    /// Options of the compiler.
    pub options: &'a [&'a str],
    /// Name of the target folder, one for each set of options.
    pub folder: &'a str,
}

impl WasmCrate<'_> {
    /// Compiles the library with `tools`; `problem` is the start of the error.
    pub fn compiled(&self, tools: &Compiler, problem: &'static str) -> Result<PathBuf> {
        let folder = paths::target().join("cross").join(self.folder);
        let mut options = libraries::without_folders();
        options.extend(self.options.iter().map(|&option| option.to_owned()));
        let mut cargo = Command::new(libraries::cargo());
        cargo
            .current_dir(paths::workspace())
            .args(["build", "--release", "--quiet", "--package", self.package])
            .args(["--target", WASM_TARGET, "--target-dir"])
            .arg(&folder)
            // independent of the settings of this build
            .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", self.parts)
            .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", self.level)
            .env("CARGO_ENCODED_RUSTFLAGS", options.join("\u{1f}"));
        if let Compiler::Unpacked(tools) = tools {
            cargo
                .arg("-Zbuild-std=std,panic_abort")
                .env("RUSTC", tools.programs().join("rustc"))
                // Debian's Rust is stable, but building the standard library is an unstable feature
                .env("RUSTC_BOOTSTRAP", "1")
                .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", tools.programs().join("wasm-ld"));
        }
        finish(&mut cargo, problem)?;
        let file = format!("{}.wasm", self.package.replace('-', "_"));
        Ok(folder.join(WASM_TARGET).join("release").join(file))
    }
}
