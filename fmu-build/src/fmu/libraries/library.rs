//! A library for one platform, and where it can be built.

use std::path::PathBuf;

/// The crate that is the FMU, and the one that answers questions for the Python package.
pub const CRATES: [&str; 2] = ["bevel-differential", "answers"];

/// Whether the tool chains for other machines run here.
pub(super) const CROSS: bool = cfg!(all(target_os = "linux", target_arch = "x86_64"));

/// FMI's name of this machine's platform and the ending of its libraries.
pub(super) const HOST: (&str, &str) = if cfg!(target_os = "windows") {
    ("win64", "dll")
} else if cfg!(target_os = "macos") {
    ("darwin64", "dylib")
} else {
    ("linux64", "so")
};

/// The library for one platform.
#[derive(Clone, Debug)]
pub struct Library {
    /// FMI's name of the platform, in version 2.0.
    pub platform: &'static str,
    /// The names in FMI 3.0, each with its file: where one platform of 2.0 is two of 3.0, parts of the whole.
    pub in_fmi3: Vec<(&'static str, PathBuf)>,
    /// What pip calls the platforms, joined by dots; "this-machine" where it finds out itself.
    pub in_wheels: &'static str,
    /// Ending of the file, without the dot.
    pub ending: &'static str,
    /// What was built.
    pub file: PathBuf,
    /// The library of answers, which was built along with it.
    pub answers: PathBuf,
    /// What a machine needs, in words.
    pub needs: String,
    /// What the linker adds to the crates and Rust's standard library.
    pub added: Vec<AddedPart>,
}

/// A part of a compiler's runtime that is linked in.
#[derive(Clone, Debug)]
pub struct AddedPart {
    /// Its name.
    pub name: &'static str,
    /// Its licence by its SPDX name.
    pub licence: &'static str,
    /// The file with the text.
    pub text: PathBuf,
}
