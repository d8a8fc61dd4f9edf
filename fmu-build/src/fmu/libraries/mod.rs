//! The FMU's library, built for this machine, and for other machines with the installed tool chains.

mod compile;
mod darwin;
mod library;
mod linux;
pub mod own;
pub mod platforms;
mod windows;

use anyhow::Result;

pub use compile::cargo;
pub(super) use compile::without_folders;
pub use library::{AddedPart, CRATES, Library};

use crate::fmu::toolchains::{self, GLIBC};
use library::{CROSS, HOST};

/// Libraries that were built, and remarks about the others.
#[derive(Clone, Debug)]
pub struct Libraries {
    /// Libraries in the order of the archive.
    pub built: Vec<Library>,
    /// Sentences about platforms that were left out and how to get them.
    pub left_out: Vec<String>,
    /// True if at least one library is for other machines.
    pub ships: bool,
}

/// Builds the FMU's library with every installed tool chain.
pub fn build() -> Result<Libraries> {
    let (mut built, mut left_out) = (Vec::new(), Vec::new());
    let old_linux = linux::x86_64()?;
    let mut ships = old_linux.is_some();
    if CROSS && !ships {
        left_out.push(format!("linux64 is for systems as new as this one, not for glibc {GLIBC}"));
    }
    built.push(old_linux.map_or_else(own::for_this_machine, Ok)?);
    if !CROSS {
        left_out.push(format!("the FMU contains only {}", HOST.0));
        return Ok(Libraries { built, left_out, ships });
    }
    let others = [("win64", windows::x86_64()?), ("aarch64-linux", linux::arm()?), ("darwin64", darwin::universal()?)];
    ships |= others.iter().any(|(_, library)| library.is_some());
    let missing: Vec<&str> = others.iter().filter(|(_, library)| library.is_none()).map(|(name, _)| *name).collect();
    built.extend(others.into_iter().filter_map(|(_, library)| library));
    if !missing.is_empty() {
        left_out.push(format!("left out: {}", missing.join(", ")));
    }
    if let Some(last) = left_out.last_mut() {
        last.push_str(&format!("; to get it: {}", toolchains::COMMAND));
    }
    Ok(Libraries { built, left_out, ships })
}
