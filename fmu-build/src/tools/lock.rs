//! Locks for work that only one process may do at a time.

use std::fs::{File, TryLockError};
use std::path::Path;

use anyhow::{Context, Result};

use crate::tools::{paths, progress};

/// Lock of a folder or file. It is released when this value is dropped or the process ends.
pub struct Lock {
    _file: File,
}

impl Lock {
    /// Waits until no other process has the lock of `place`, and reports the waiting.
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
