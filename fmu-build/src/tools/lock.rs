//! Work that one process at a time does.

use std::fs::{File, TryLockError};
use std::path::Path;

use anyhow::{Context, Result};

use crate::tools::{paths, progress};

/// The right to work in a folder, or on a file. It ends with this value, or with the process.
pub struct Lock {
    _file: File,
}

impl Lock {
    /// Waits, and says so, until no other process has the lock of `place`.
    pub fn of(place: &Path) -> Result<Self> {
        let failed = || format!("{} cannot be locked", paths::shown(place));
        paths::create_folder(place.parent().unwrap_or(place))?;
        let file = File::create(place.with_extension("lock")).with_context(failed)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                progress::note(&format!("waiting for another run that works in {}", paths::shown(place)));
                file.lock().with_context(failed)?;
            }
            Err(TryLockError::Error(error)) => return Err(error).with_context(failed),
        }
        Ok(Self { _file: file })
    }
}
