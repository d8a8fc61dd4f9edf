//! The Python package as a wheel with the FMU, the scenes and the licences. The same sources give the same bytes.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use bevel_differential::variables::MODEL_NAME;
use clap::Args;

use crate::fmu::archive::{self, Packing};
use crate::fmu::libraries::platforms::{self, Platform};
use crate::fmu::libraries::{CRATES, Library};
use crate::fmu::licences;
use crate::fmu::page;
use crate::tools::files::{copy_file, copy_folder, remove_folder, write_whole};
use crate::tools::lock::Lock;
use crate::tools::paths;
use crate::tools::progress::Progress;
use crate::tools::python::{self, Environment};

/// Modification time of all files in the wheel, in Unix seconds: 1980-01-01, the earliest time of the archive format.
const TIME: &str = "315532800";
/// Extensions of scenes and of their input files.
const SCENE_FILES: &[&str] = &["toml", "csv"];
/// Folders of examples in the package, with the extensions of their files.
const EXAMPLES: [(&str, &[&str]); 3] =
    [("design", &["toml", "csv"]), ("four_wheel_drive", &["py", "toml"]), ("vehicle", &["py"])];
/// Licences of the project. Those of linked parts are in the FMU.
const LICENCES: [&str; 2] = ["LICENSE-APACHE", "LICENSE-MIT"];

/// Builds target/wheel/bevel_differential-VERSION-py3-none-PLATFORMS.whl, the Python package with the FMU in it
///
/// The FMU contains the libraries of the selected platforms, or of all platforms whose tool chains are installed. The
/// command `toolchains` installs tool chains.
#[derive(Args, Clone, Debug)]
pub struct WheelCommand {
    /// Platforms of the FMU in the wheel
    #[arg(long, value_enum, value_delimiter = ',')]
    platforms: Vec<Platform>,
    /// Instead of a wheel, write its contents other than Python's files to this folder (used by `pip install ./python`)
    #[arg(long, value_name = "FOLDER")]
    parts: Option<PathBuf>,
}

impl WheelCommand {
    /// Builds the wheel and prints its path and platforms.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("building the library");
        let _alone = Lock::of(&paths::wheel())?;
        let libraries = platforms::build(&self.platforms)?;
        if let Some(folder) = &self.parts {
            remove_folder(folder)?;
            paths::create_folder(folder)?;
            write_parts(&libraries, Packing::Quick, folder)?;
            progress.finish();
            println!("{}", paths::shown(folder));
            return Ok(());
        }
        progress.stage("building the wheel");
        let environment = Environment::complete(|what| progress.stage(what))?;
        let wheel = write(&libraries, &environment, &paths::wheel())?;
        progress.finish();
        println!("{}", paths::shown(&wheel));
        println!("{}", page::made()?.1);
        for Library { platform, needs, .. } in &libraries {
            println!("{platform}: {needs}");
        }
        for platform in platforms::SHIPPED.map(Platform::fmi_name) {
            if libraries.iter().all(|library| library.platform != platform) {
                println!("{platform} is left out");
            }
        }
        Ok(())
    }
}

/// Builds the wheel around `libraries` in `folder` and returns its path.
pub fn write(libraries: &[Library], environment: &Environment, folder: &Path) -> Result<PathBuf> {
    let (source, built) = (folder.join("source"), folder.join("built"));
    remove_folder(&source)?;
    remove_folder(&built)?;
    stage(libraries, &source)?;
    let platforms: Vec<&str> = libraries.iter().map(|library| library.in_wheels).collect();
    let mut pip = environment.command();
    pip.args(["-m", "pip", "wheel", "--quiet", "--no-input", "--disable-pip-version-check"])
        // the build backend is a package of the environment, with its pinned version
        .args(["--no-build-isolation", "--no-deps", "--no-index", "--wheel-dir"])
        .arg(&built)
        .arg(source.join("python"))
        .env("BEVEL_DIFFERENTIAL_WHEEL_PLATFORMS", platforms.join("."))
        .env("SOURCE_DATE_EPOCH", TIME);
    python::finish(&mut pip, "the wheel cannot be built")?;
    let wheel = fs::read_dir(&built)?.next().context("pip built no wheel")??.path();
    let target = folder.join(wheel.file_name().unwrap_or_default());
    fs::rename(&wheel, &target).with_context(|| format!("{} cannot be written", paths::shown(&target)))?;
    Ok(target)
}

/// Copies the sources of the wheel to `source`, so that nothing is written to their folder.
fn stage(libraries: &[Library], source: &Path) -> Result<()> {
    let (from, to) = (paths::workspace(), source.join("python"));
    let package = to.join("src").join("bevel_differential");
    copy_folder(&from.join("python").join("src").join("bevel_differential"), &package, "__pycache__")?;
    for file in ["pyproject.toml", "hatch_build.py"] {
        copy_file(&from.join("python").join(file), &to)?;
    }
    // Cargo.toml contains the version
    copy_file(&from.join("Cargo.toml"), source)?;
    for licence in LICENCES {
        copy_file(&from.join(licence), &to)?;
    }
    write_parts(libraries, Packing::Small, &package)
}

/// Copies the files of the folder `from` whose names have one of the `endings` into the folder `to`.
fn copy_with_endings(from: &Path, endings: &[&str], to: &Path) -> Result<()> {
    for file in fs::read_dir(from).with_context(|| format!("{} cannot be read", paths::shown(from)))? {
        let file = file?.path();
        if file.extension().is_some_and(|of| endings.iter().any(|ending| of == *ending)) {
            copy_file(&file, to)?;
        }
    }
    Ok(())
}

/// Writes the contents of the package other than Python's files.
fn write_parts(libraries: &[Library], packing: Packing, package: &Path) -> Result<()> {
    let from = paths::workspace();
    copy_with_endings(&paths::scenes(), SCENE_FILES, &package.join("scenes"))?;
    for (folder, endings) in EXAMPLES {
        copy_with_endings(&from.join("examples").join(folder), endings, &package.join("examples").join(folder))?;
    }
    // next to the FMU, not in it, so that its address and links to set-ups stay valid
    if let (Some(page), _) = page::made()? {
        write_whole(&package.join("page").join(page::FILE), &page)?;
    }
    for Library { platform, answers, .. } in libraries {
        copy_file(answers, &package.join("answers").join(platform))?;
    }
    let header = from.join("crates").join("answers").join("include").join("bd_answers.h");
    copy_file(&header, &package.join("answers"))?;
    // licence texts of parts that the FMU's library also links are in the FMU
    let known = licences::collected(CRATES[0], &[])?.files;
    for (path, text) in licences::collected(CRATES[1], &[])?.files {
        if known.iter().all(|(known, _)| *known != path) {
            write_whole(&package.join("answers").join("licenses").join(path), &text)?;
        }
    }
    archive::write_archive(archive::Version::Two, libraries, None, packing, &package.join(format!("{MODEL_NAME}.fmu")))
}
