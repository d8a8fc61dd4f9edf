//! Files that are either complete or missing, even if several processes write them at the same time.

use std::fs::{self, File, OpenOptions};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process;

use anyhow::{Context, Result};

use super::shown;

/// Number of characters of a name that a temporary name repeats: names have at most 255 bytes.
const KEPT: usize = 50;

/// Calls `make` to write a temporary file in the folder of `path`, and renames it to `path` if `make` succeeds.
///
/// The file keeps its permissions and may be a symbolic link. A device or a pipe is written directly. The temporary
/// file is `.NAME.xxxx.part`; it remains only if the process is killed.
pub fn write<T>(path: &Path, make: impl FnOnce(&Path) -> Result<T>) -> Result<T> {
    let failed = || format!("{} cannot be written", shown(path));
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let there = fs::metadata(&target).ok();
    if there.as_ref().is_some_and(|found| !found.is_file() && !found.is_dir()) {
        return make(&target);
    }
    let part = created(&target).with_context(failed)?;
    let made = match there {
        Some(found) => fs::set_permissions(&part, found.permissions()).with_context(failed),
        None => Ok(()),
    };
    let done = made.and_then(|()| make(&part)).and_then(|done| {
        fs::rename(&part, &target).with_context(failed)?;
        Ok(done)
    });
    if done.is_err() {
        let _ = fs::remove_file(&part);
    }
    done
}

/// Creates a new file in the folder of `target` that no other process or thread uses.
fn created(target: &Path) -> std::io::Result<PathBuf> {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    let kept: String = name.chars().take(KEPT).collect();
    let mut number = 0;
    loop {
        let part = target.with_file_name(format!(".{kept}.{:x}-{number:x}.part", process::id()));
        match OpenOptions::new().write(true).create_new(true).open(&part) {
            Ok(File { .. }) => return Ok(part),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::thread;

    use anyhow::bail;

    use super::*;

    /// An empty folder for one test.
    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("whole-file-{name}-{}", process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder");
        folder
    }

    fn content(file: &Path) -> String {
        fs::read_to_string(file).expect("a file")
    }

    #[test]
    fn an_error_leaves_the_old_file_and_nothing_else() {
        let folder = folder("error");
        let file = folder.join("table.csv");
        fs::write(&file, "old").expect("a file");
        let failed = write(&file, |part| {
            fs::write(part, "half")?;
            bail!("stopped") as Result<()>
        });
        assert_eq!(failed.expect_err("stopped").to_string(), "stopped");
        assert_eq!(content(&file), "old");
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
        fs::remove_dir_all(folder).expect("removed");
    }

    #[test]
    fn writers_at_the_same_time_each_have_their_own_temporary_file() {
        let folder = folder("threads");
        let file = folder.join("table.csv");
        thread::scope(|scope| {
            for letter in ["a", "b", "c", "d"] {
                let file = &file;
                scope.spawn(move || {
                    for _ in 0..50 {
                        write(file, |part| Ok(fs::write(part, letter.repeat(100_000))?)).expect("written");
                        let found = content(file);
                        assert_eq!((found.len(), found.replace(&found[..1], "")), (100_000, String::new()));
                    }
                });
            }
        });
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
        fs::remove_dir_all(folder).expect("removed");
    }

    #[cfg(unix)]
    #[test]
    fn permissions_and_links_are_kept_and_devices_are_written_directly() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};

        let folder = folder("links");
        let (file, link) = (folder.join("table.csv"), folder.join("link"));
        fs::write(&file, "old").expect("a file");
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).expect("permissions");
        symlink("table.csv", &link).expect("a link");
        write(&link, |part| Ok(fs::write(part, "new")?)).expect("written");
        assert_eq!(content(&file), "new");
        assert!(fs::symlink_metadata(&link).expect("a link").is_symlink());
        assert_eq!(fs::metadata(&file).expect("a file").permissions().mode() & 0o777, 0o640);
        write(Path::new("/dev/null"), |part| {
            assert_eq!(part, Path::new("/dev/null"));
            Ok(())
        })
        .expect("written");
        fs::remove_dir_all(folder).expect("removed");
    }
}
