//! The page: the library for browsers, the gears, traces and controls in one HTML file that needs no server.

pub mod data;

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use bevel_differential::variables::guid;
use clap::Args;

use crate::fmu::toolchains::{self, Compiler, WASM_TARGET};
use crate::fmu::wasm::{QUICK, WasmCrate};
use crate::tools::files::{copy_folder, make_whole, remove_folder, write_whole};
use crate::tools::lock::Lock;
use crate::tools::paths;
use crate::tools::progress::Progress;
use crate::tools::python::{Environment, finish};

/// Name of the page's file.
pub const FILE: &str = "BevelDifferential.html";
/// Command that builds the page.
const COMMAND: &str = "cargo run --release -- page";
/// The crate of the library for browsers.
const CRATE: &str = "bevel-differential-page";
/// Number of codegen units, and level of optimisation, for users. These settings do not affect results.
const FOR_USERS: [&str; 2] = ["1", "3"];
/// Compresses a file with Python's own library, with the checksum that unpackers of browsers support.
const PACK: &str = "import lzma, sys; from pathlib import Path; \
                    Path(sys.argv[2]).write_bytes(lzma.compress(Path(sys.argv[1]).read_bytes(), \
                    check=lzma.CHECK_CRC32, preset=9 | lzma.PRESET_EXTREME))";

/// Builds target/page/BevelDifferential.html, the differential live in a browser
///
/// The page is one file that needs no server. It needs the tool chain `toolchains wasm`, and node with npm, which
/// downloads three.js, uPlot and esbuild.
#[derive(Args, Clone, Debug)]
pub struct PageCommand {
    /// Compile the library in less time: slower in the browser, the same results
    #[arg(long)]
    quick: bool,
}

impl PageCommand {
    /// Builds the page and prints its path.
    pub fn run(&self) -> Result<()> {
        let Some(tools) = Compiler::found(&[WASM_TARGET]) else {
            bail!(
                "the tool chain for browsers is not installed: rustup target add {WASM_TARGET}, or {} wasm",
                toolchains::COMMAND
            );
        };
        if Command::new("npm").arg("--version").output().is_err() {
            bail!(
                "npm, which downloads three.js and uPlot, is not installed: apt install nodejs npm (or see nodejs.org)"
            );
        }
        let progress = Progress::start("building the library for browsers");
        let _alone = Lock::of(&paths::page())?;
        let library = library(&tools, self.quick)?;
        progress.stage("bundling the page");
        let page = bundle(&library)?;
        progress.finish();
        let size = fs::metadata(&page)?.len() as f64;
        println!("{}: {:.2} MB", paths::shown(&page), size / 1e6);
        Ok(())
    }
}

/// Compiles the library for browsers, for users or in less time.
fn library(tools: &Compiler, quick: bool) -> Result<PathBuf> {
    let (settings, model_level) = if quick { (QUICK, Some("1")) } else { (FOR_USERS, None) };
    let library = WasmCrate { package: CRATE, settings, model_level, link: &[] };
    library.compiled(tools, "the library for browsers cannot be built")
}

/// Bundles the page with `library`. The sources are copied, so that nothing is written to their folder. An earlier copy is
/// removed first, because its tests may need files that no longer exist.
fn bundle(library: &Path) -> Result<PathBuf> {
    let folder = paths::page();
    let web = folder.join("web");
    remove_folder(&web)?;
    copy_folder(&paths::workspace().join("fmu-build").join("page").join("web"), &web, "node_modules")?;
    let packed = packed(library, &folder)?;
    let data = folder.join("data.json");
    write_whole(&data, &serde_json::to_vec(&data::data()?)?)?;
    let mut npm = Command::new("npm");
    npm.current_dir(&web).args(["ci", "--silent", "--no-audit", "--no-fund"]);
    finish(&mut npm, "three.js and uPlot cannot be downloaded (check the network)")?;
    let page = folder.join(FILE);
    make_whole(&page, |part| {
        let mut node = Command::new("node");
        node.current_dir(&web).arg("build.mjs").args([&packed, &data, part]);
        finish(&mut node, "the page cannot be bundled")
    })?;
    Ok(page)
}

/// Compresses the library with xz, which needs half as much space as gzip.
fn packed(library: &Path, folder: &Path) -> Result<PathBuf> {
    let file = folder.join("library.xz");
    let mut python = Environment::ready(|_| {})?.command();
    python.arg("-c").arg(PACK).args([library, &file]);
    finish(&mut python, "the library for browsers cannot be packed")?;
    Ok(file)
}

/// Returns the existing page if its variables are up to date, and a remark that says if the page is included or how to
/// build it.
pub fn made() -> Result<(Option<Vec<u8>>, String)> {
    let file = paths::page().join(FILE);
    let is_of_today = |text: &[u8]| text.windows(guid().len()).any(|window| window == guid().as_bytes());
    match fs::read(&file) {
        Ok(text) if is_of_today(&text) => Ok((Some(text), format!("with the page {FILE}"))),
        Ok(_) => {
            Ok((None, format!("the page is left out, because its variables are out of date; renew it: {COMMAND}")))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => {
            Ok((None, format!("the page is left out; make it: {COMMAND}")))
        }
        Err(error) => Err(error).with_context(|| format!("{} cannot be read", paths::shown(&file))),
    }
}
