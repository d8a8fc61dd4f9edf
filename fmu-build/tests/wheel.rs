//! Tests of the wheel: it contains everything that the package needs, and two builds have the same bytes.

use std::fs::{self, File};
use std::io::{Cursor, Read};
use std::path::Path;

use answers::scene;
use anyhow::{Context, Result};
use fmu_build::fmu::{libraries, wheel};
use fmu_build::tools::paths;
use fmu_build::tools::python::Environment;
use zip::ZipArchive;

/// Paths and sizes of all files below `folder`.
fn listed(folder: &Path) -> Result<Vec<(String, u64)>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            files.extend(listed(&path)?);
        } else {
            files.push((path.display().to_string(), path.metadata()?.len()));
        }
    }
    files.sort();
    Ok(files)
}

#[test]
fn a_wheel_has_all_it_needs_and_the_same_bytes_every_time() -> Result<()> {
    let environment = Environment::complete(|what| println!("{what}"))?;
    let libraries = libraries::build()?.built;
    let sources = paths::workspace().join("python");
    let before = listed(&sources)?;
    let folder = paths::target().join("same-bytes");
    let mut wheels = Vec::new();
    for name in ["first", "second"] {
        wheels.push(wheel::write(&libraries, &environment, &folder.join(name))?);
    }
    assert!(fs::read(&wheels[0])? == fs::read(&wheels[1])?);
    assert_eq!(listed(&sources)?, before, "the build of the wheel has changed the folder python");
    let version = env!("CARGO_PKG_VERSION");
    let name = wheels[0].file_name().context("a file")?;
    let (package, platforms) =
        name.to_str().and_then(|name| name.split_once("-py3-none-")).context("a wheel for all")?;
    assert_eq!(package, format!("bevel_differential-{version}"));
    assert_eq!(
        platforms.split('.').any(|platform| platform == "win_amd64"),
        libraries.iter().any(|l| l.ending == "dll")
    );
    assert_eq!(platforms.contains("manylinux_2_17_aarch64"), libraries.iter().any(|l| l.platform == "aarch64-linux"));
    assert_eq!(platforms.contains("macosx_11_0_arm64"), libraries.iter().any(|l| l.ending == "dylib"));

    let mut archive = ZipArchive::new(File::open(&wheels[0])?)?;
    let mut text = |path: &str| -> Result<String> {
        let mut text = String::new();
        archive.by_name(path).with_context(|| path.to_owned())?.read_to_string(&mut text)?;
        Ok(text)
    };
    let about = format!("bevel_differential-{version}.dist-info");
    let metadata = text(&format!("{about}/METADATA"))?;
    for line in [format!("Version: {version}"), "License-Expression: MIT OR Apache-2.0".into()] {
        assert!(metadata.lines().any(|found| found == line), "{line} is not in\n{metadata}");
    }
    for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
        let own = fs::read_to_string(paths::workspace().join(licence))?;
        assert_eq!(text(&format!("{about}/licenses/{licence}"))?, own);
    }
    assert!(scene::files(&paths::scenes())?.len() >= 10);
    // scenes and their input files
    for file in fs::read_dir(paths::scenes())? {
        let file = file?;
        let name = file.file_name().to_string_lossy().into_owned();
        assert_eq!(text(&format!("bevel_differential/scenes/{name}"))?, fs::read_to_string(file.path())?);
    }
    assert_eq!(text("bevel_differential/py.typed")?, "");
    let mut bytes = Vec::new();
    archive.by_name("bevel_differential/BevelDifferential.fmu")?.read_to_end(&mut bytes)?;
    let mut fmu = ZipArchive::new(Cursor::new(bytes))?;
    for library in &libraries {
        let path = format!("binaries/{}/BevelDifferential.{}", library.platform, library.ending);
        let mut bytes = Vec::new();
        fmu.by_name(&path).with_context(|| path.clone())?.read_to_end(&mut bytes)?;
        assert!(bytes == fs::read(&library.file)?, "{path}");
    }
    Ok(())
}
