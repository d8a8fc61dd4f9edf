//! The command `test-page` reports what is missing if it cannot test the page.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;
use fmu_build::tools::paths;

/// Empty folder for one test.
fn folder(name: &str) -> Result<PathBuf> {
    let folder = paths::target().join("test-page").join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// Output of the failing command about `page` if `path` is the whole search path.
fn error(page: &str, path: &str, chrome: &str) -> Result<String> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lab"));
    let output = command.args(["test-page", page]).env("PATH", path).env("CHROME", chrome).output()?;
    assert!(!output.status.success());
    Ok(String::from_utf8(output.stderr)?)
}

#[test]
fn a_missing_page_is_reported_with_the_command_that_builds_it() -> Result<()> {
    let said = error("target/no_such_page.html", "", "")?;
    assert_eq!(said, "error: target/no_such_page.html is not there; make it: cargo run --release -- page\n");
    Ok(())
}

#[cfg(unix)]
#[test]
fn a_missing_node_or_browser_is_reported_with_what_to_install() -> Result<()> {
    use std::os::unix::fs::PermissionsExt;

    let folder = folder("programs")?;
    let [page, path] = [folder.join("page.html"), folder.join("path")].map(|file| file.display().to_string());
    fs::write(&page, "")?;
    fs::create_dir(&path)?;
    let without_node = error(&page, &path, "")?;
    assert_eq!(without_node, "error: node is not installed: apt install nodejs (or see nodejs.org)\n");

    // a runnable program named node
    let node = folder.join("path").join("node");
    fs::write(&node, "#!/bin/sh\n")?;
    fs::set_permissions(&node, fs::Permissions::from_mode(0o755))?;
    let without_browser = error(&page, &path, "")?;
    assert_eq!(without_browser, "error: Chromium is not installed: apt install chromium, or name one by CHROME\n");

    let named = error(&page, &path, "/no/such/browser")?;
    assert_eq!(named, "error: CHROME = /no/such/browser: this program does not run; name a Chromium\n");
    Ok(())
}
