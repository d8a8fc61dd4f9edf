//! Tests of the archive, and of the model description in the repository.

use std::fs::{self, File};
use std::io::Read;

use anyhow::Result;
use fmu_build::fmu::archive::{self, Packing};
use fmu_build::fmu::{describe, libraries};
use fmu_build::tools::paths;
use zip::ZipArchive;

#[test]
fn the_model_description_and_the_lists_of_effects_in_the_repository_match_the_table() -> Result<()> {
    let stale = describe::stale_document(&paths::model_description())?;
    assert!(stale.is_none(), "{stale:?} is out of date; renew it: cargo run --release -- describe");
    Ok(())
}

#[test]
fn packing_twice_gives_the_same_bytes_with_and_without_the_page() -> Result<()> {
    let libraries = libraries::build()?.built;
    let folder = paths::target().join("same-bytes");
    let archives = ["first.fmu", "second.fmu"].map(|name| folder.join(name));
    for (page, packing) in [(None, Packing::Quick), (Some(&b"<!DOCTYPE html>"[..]), Packing::Small)] {
        for archive in &archives {
            archive::write_archive(archive::Version::Two, &libraries, page, packing, archive)?;
        }
        assert!(fs::read(&archives[0])? == fs::read(&archives[1])?);
        let mut packed = ZipArchive::new(File::open(&archives[0])?)?;
        assert_eq!(packed.by_name("documentation/BevelDifferential.html").is_ok(), page.is_some());
        let mut index = String::new();
        packed.by_name("documentation/index.html")?.read_to_string(&mut index)?;
        assert_eq!(index.contains("BevelDifferential.html"), page.is_some());
    }
    Ok(())
}
