//! FMU with sources in C instead of libraries. wasm2c translates the library, compiled to WebAssembly, to C. The C files
//! in `fmu-build/sources/c` connect the result to the functions of FMI 2.0.

mod archive;
mod translate;

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result};

pub use archive::package;
pub use translate::File;

use crate::fmu::archive::Packing;
use crate::fmu::toolchains::{self, Compiler, WASM_TARGET};
use crate::fmu::wasm::{QUICK, WasmCrate};
use crate::tools::lock::Lock;
use crate::tools::paths;
use crate::tools::python::{Environment, finish};

/// Crate of the library.
const CRATE: &str = "bevel-differential-sources";
/// Number of codegen units, and level of optimisation, for users.
const FOR_USERS: [&str; 2] = ["1", "2"];
/// Size of the stack in the library's memory, twice the maximum in the scenes of the tests [bytes].
const STACK: &str = "-zstack-size=262144";
/// Files around the library, in `fmu-build/sources/c`.
const OWN: [&str; 5] = ["bd_runtime.h", "bd_runtime.c", "bd_unit.h", "bd_unit.c", "fmi2Functions.c"];

/// Tools that create the sources.
pub struct Tools {
    wasm: Compiler,
    to_c: Environment,
}

impl Tools {
    /// Finds the tools. The error states how to get them.
    pub fn found() -> Result<Self, String> {
        match (Compiler::found(&[WASM_TARGET]), toolchains::sources().found()) {
            (Some(wasm), Some(to_c)) => Ok(Self { wasm, to_c }),
            _ => Err(format!("the sources in C are left out; to get them: {} sources", toolchains::COMMAND)),
        }
    }

    /// Creates all files of the sources. With quick packing, the compiler uses more codegen units: it finishes sooner,
    /// and the sources give the same results with more instructions.
    pub fn files(&self, packing: Packing) -> Result<Vec<File>> {
        let _alone = Lock::of(&paths::target().join("cross").join("sources"))?;
        let settings = if packing == Packing::Quick { QUICK } else { FOR_USERS };
        let library = WasmCrate { package: CRATE, settings, model_level: None, link: &[STACK] };
        let library = library.compiled(&self.wasm, "the library for sources in C cannot be built")?;
        let mut files = translate::files(&self.in_c(&library)?)?;
        let own = paths::workspace().join("fmu-build").join("sources").join("c");
        for name in OWN {
            let text = fs::read_to_string(own.join(name)).with_context(|| format!("{name} cannot be read"))?;
            files.push((name.to_owned(), text));
        }
        Ok(files)
    }

    /// Translates `library` to C with wasm2c.
    fn in_c(&self, library: &Path) -> Result<String> {
        let file = library.with_extension("c");
        let mut program = Command::new(self.to_c.programs().join("wasm2c"));
        program.args(["--no-debug-names", "--module-name", "bd", "--output"]).args([&file, library]);
        finish(&mut program, "wasm2c cannot turn the library into C")?;
        fs::read_to_string(&file).with_context(|| format!("{} cannot be read", paths::shown(&file)))
    }
}
