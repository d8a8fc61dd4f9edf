//! Library for one platform, and the machines on which it can be built.

use std::path::PathBuf;

/// Crate of the FMU, and crate that answers questions for the Python package.
pub const CRATES: [&str; 2] = ["bevel-differential", "answers"];

/// True if the tool chains for other machines run here.
pub(super) const CROSS: bool = cfg!(all(target_os = "linux", target_arch = "x86_64"));

/// FMI's name of this machine's platform, and the extension of its libraries.
pub(super) const HOST: (&str, &str) = if cfg!(target_os = "windows") {
    ("win64", "dll")
} else if cfg!(target_os = "macos") {
    ("darwin64", "dylib")
} else {
    ("linux64", "so")
};

/// Library for one platform.
#[derive(Clone, Debug)]
pub struct Library {
    /// Name of the platform in FMI 2.0.
    pub platform: &'static str,
    /// Names in FMI 3.0, each with its file. There are two for macOS, because FMI 3.0 has one platform per processor;
    /// `file` is then the universal file joined from both.
    pub in_fmi3: Vec<(&'static str, PathBuf)>,
    /// Platform tags for pip, joined by dots; "this-machine" if pip determines the tag itself.
    pub in_wheels: &'static str,
    /// File extension, without the dot.
    pub ending: &'static str,
    /// Built file.
    pub file: PathBuf,
    /// Library of answers, built in the same run.
    pub answers: PathBuf,
    /// Requirements that a machine must meet, as text.
    pub needs: String,
    /// Parts that the linker adds to the crates and Rust's standard library.
    pub added: Vec<AddedPart>,
}

/// A part of a compiler's runtime that is linked in.
#[derive(Clone, Debug)]
pub struct AddedPart {
    /// Name of the part.
    pub name: &'static str,
    /// SPDX name of its licence.
    pub licence: &'static str,
    /// File with the text of the licence.
    pub text: PathBuf,
}
