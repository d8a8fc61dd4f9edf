//! The page as it was made before, for the FMU and the wheel.

use std::fs;
use std::io::ErrorKind;

use anyhow::{Context, Result};
use bevel_differential::variables::guid;

use crate::tools::paths;

/// Name of the page's file.
pub const FILE: &str = "BevelDifferential.html";
/// What makes it.
const COMMAND: &str = "cargo run --release -- page";

/// The page in target/page.
pub enum Page {
    /// Its text, with the variables of today.
    Made(Vec<u8>),
    /// It was made with other variables.
    Old,
    /// It was never made.
    Missing,
}

impl Page {
    /// Looks for the page.
    pub fn found() -> Result<Self> {
        let file = paths::page().join(FILE);
        match fs::read(&file) {
            Ok(text) if has(&text, guid()) => Ok(Self::Made(text)),
            Ok(_) => Ok(Self::Old),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Self::Missing),
            Err(error) => Err(error).with_context(|| format!("{} cannot be read", paths::shown(&file))),
        }
    }

    /// Whether the page is packed, and how it will be.
    pub fn remark(&self) -> String {
        match self {
            Self::Made(_) => format!("with the page {FILE}"),
            Self::Old => format!("the page is left out, it has other variables; renew it: {COMMAND}"),
            Self::Missing => format!("the page is left out; make it: {COMMAND}"),
        }
    }

    /// Its text.
    pub fn text(&self) -> Option<&[u8]> {
        match self {
            Self::Made(text) => Some(text),
            Self::Old | Self::Missing => None,
        }
    }
}

/// Whether `text` has `part`, which stands near its beginning.
fn has(text: &[u8], part: &str) -> bool {
    text.windows(part.len()).any(|window| window == part.as_bytes())
}
