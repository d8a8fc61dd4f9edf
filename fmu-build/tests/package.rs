//! The model description in the repository and the archive.

use std::fs;

use anyhow::Result;
use fmu_build::fmu::{describe, libraries, package};
use fmu_build::tools::paths;

#[test]
fn the_model_description_and_the_lists_of_effects_in_the_repository_are_the_table_s() -> Result<()> {
    let stale = describe::stale_document(&paths::model_description())?;
    assert!(stale.is_none(), "{stale:?} is out of date; renew it: cargo run --release -- describe");
    Ok(())
}

#[test]
fn packing_twice_gives_the_same_bytes() -> Result<()> {
    let libraries = libraries::build()?.built;
    let folder = paths::target().join("same-bytes");
    let archives = ["first.fmu", "second.fmu"].map(|name| folder.join(name));
    for archive in &archives {
        package::write_archive(&libraries, archive)?;
    }
    assert!(fs::read(&archives[0])? == fs::read(&archives[1])?);
    Ok(())
}
