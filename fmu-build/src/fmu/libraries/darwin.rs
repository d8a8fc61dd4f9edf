//! Library for macOS: one universal file with the code for both kinds of processors, each signed by the linker.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use super::compile::{cargo, distributable};
use super::library::{CROSS, Library};
use crate::fmu::toolchains::{self, Compiler, DARWIN_TARGETS, UnpackedToolchain};
use crate::tools::files::write_whole;
use crate::tools::paths;

/// FMI 2.0's name of the platform.
const PLATFORM: &str = "darwin64";
/// FMI 3.0's names of the platform with each of the two kinds of processors.
const IN_FMI3: [&str; 2] = ["x86_64-darwin", "aarch64-darwin"];
/// Oldest macOS that Rust supports, on x86-64 and on ARM.
const OLDEST: [&str; 2] = ["10.12", "11.0"];

/// First word of a universal file, whose numbers are big-endian.
const UNIVERSAL: u32 = 0xCAFE_BABE;
/// First word of a file for one 64-bit processor, whose numbers are in the byte order of that processor.
const SINGLE: u32 = 0xFEED_FACF;
/// Exponent of 2 of the alignment of each file [bytes]: a page of ARM, which has the larger pages.
const ALIGNMENT: u32 = 14;

/// True if the tool chain is installed.
pub(super) fn has_universal() -> bool {
    CROSS && toolchains::for_darwin().is_some()
}

/// Builds the library if its tool chain is installed.
pub(super) fn universal() -> Result<Option<Library>> {
    toolchains::for_darwin().filter(|_| CROSS).map(|(compiler, linker)| built(&compiler, &linker)).transpose()
}

fn built(compiler: &Compiler, linker: &UnpackedToolchain) -> Result<Library> {
    let [x86_64, arm] = [0, 1].map(|which| single(compiler, linker, which));
    let singles = [x86_64?, arm?];
    let folder = paths::target().join("cross").join(PLATFORM);
    let [file, answers] = [0, 1].map(|which| joined(&singles.each_ref().map(|built| &*built[which]), &folder));
    Ok(Library {
        platform: PLATFORM,
        in_fmi3: IN_FMI3.into_iter().zip(singles.map(|[file, _]| file)).collect(),
        in_wheels: "macosx_10_12_x86_64.macosx_11_0_arm64",
        ending: "dylib",
        file: file?,
        answers: answers?,
        needs: format!("macOS {} or newer on x86-64, {} on 64-bit ARM", OLDEST[0], OLDEST[1]),
        added: Vec::new(),
    })
}

/// Builds the libraries for one kind of processor.
fn single(compiler: &Compiler, linker: &UnpackedToolchain, which: usize) -> Result<[PathBuf; 2]> {
    let target = DARWIN_TARGETS[which];
    let variable = format!("CARGO_TARGET_{}_LINKER", target.to_uppercase().replace('-', "_"));
    let mut command = Command::new(cargo());
    command
        .args(["build", "--target", target])
        .env(variable, linker.programs().join("ld64.lld"))
        .env("SDKROOT", linker.folder().join("sdk"))
        .env("MACOSX_DEPLOYMENT_TARGET", OLDEST[which])
        // the linker strips symbols, because later stripping would invalidate its signature
        .env("CARGO_PROFILE_RELEASE_STRIP", "none");
    compiler.compile(&mut command);
    distributable(command, IN_FMI3[which], "dylib", &["-Clinker-flavor=ld64.lld"])
}

/// Joins the files for single processors into a universal file in `folder`.
fn joined(singles: &[&Path; 2], folder: &Path) -> Result<PathBuf> {
    let contents = singles.map(|file| fs::read(file).with_context(|| format!("{} cannot be read", paths::shown(file))));
    let [x86_64, arm] = contents;
    let target = folder.join(singles[0].file_name().unwrap_or_default());
    write_whole(&target, &universal_of(&[x86_64?, arm?])?)?;
    Ok(target)
}

/// Content of a universal file: a table of processors, positions and sizes with big-endian numbers, followed by the
/// unchanged files.
fn universal_of(singles: &[Vec<u8>]) -> Result<Vec<u8>> {
    let mut table: Vec<u32> = vec![UNIVERSAL, singles.len() as u32];
    let mut place = 1 << ALIGNMENT;
    let mut places = Vec::new();
    for single in singles {
        let word = |at: usize| single.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        ensure!(word(0) == Some(SINGLE), "the linker has written no library for macOS");
        let (processor, kind) = word(4).zip(word(8)).context("the library for macOS is cut off")?;
        let size = u32::try_from(single.len())?;
        table.extend([processor, kind, place, size, ALIGNMENT]);
        places.push(place as usize);
        place = (place + size).next_multiple_of(1 << ALIGNMENT);
    }
    let mut universal: Vec<u8> = table.into_iter().flat_map(u32::to_be_bytes).collect();
    for (single, place) in singles.iter().zip(places) {
        universal.resize(place, 0);
        universal.extend(single);
    }
    Ok(universal)
}

#[cfg(test)]
mod tests {
    use super::{SINGLE, universal_of};

    #[test]
    fn files_begin_on_pages_and_are_found_through_the_table() {
        let single = |processor: u32, size: usize| {
            let mut file: Vec<u8> = [SINGLE, processor, 3].into_iter().flat_map(u32::to_le_bytes).collect();
            file.resize(size, processor as u8);
            file
        };
        let files = [single(0x0100_0007, 0x4001), single(0x0100_000C, 40)];
        let universal = universal_of(&files).unwrap();
        let word = |at: usize| u32::from_be_bytes(universal[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!([word(0), word(4)], [0xCAFE_BABE, 2]);
        for (number, file) in files.iter().enumerate() {
            let at = 8 + 20 * number;
            let [place, size] = [word(at + 8), word(at + 12)];
            assert_eq!([word(at), word(at + 4)], [0x0100_0007 + 5 * number, 3]);
            assert_eq!([place % 0x4000, word(at + 16)], [0, 14]);
            assert!(universal[place..place + size] == file[..]);
        }
        assert!(universal_of(&[vec![0; 64]]).is_err());
    }
}
