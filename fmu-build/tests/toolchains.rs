//! Scripts that unpack tool chains: they refuse an old Rust before they download, and their errors state the remedy.
#![cfg(target_os = "linux")]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use anyhow::Result;
use fmu_build::tools::paths;

/// Writes programs like Debian's to `folder`. Their lists of packages contain the version `rust`; every download fails.
fn fake_debian(folder: &Path, rust: &str) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    fs::create_dir_all(folder)?;
    let lists = format!(
        "case $1-$2 in\ndepends-libstd-rust-web-dev) echo '  Depends: libstd-rust-web-{rust}' ;;\n\
         depends-*) echo '  Depends: libllvm22' ;;\npolicy-*) echo '  Candidate: {rust}+dfsg1-1~deb12u1' ;;\nesac\n"
    );
    let missing = "echo 'E: 404  Not Found' >&2\nexit 100\n".to_owned();
    for (name, what) in [("apt-cache", lists), ("apt-get", missing), ("dpkg-deb", String::new())] {
        let program = folder.join(name);
        fs::write(&program, format!("#!/bin/sh\n{what}"))?;
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755))?;
    }
    Ok(())
}

/// Errors of the script with these programs if Rust 1.89 is required. They start with "downloading; " if it tried to
/// download.
fn said(script: &str, rust: &str) -> Result<String> {
    let folder = paths::target().join("test-toolchains").join(format!("{script}-{rust}"));
    let programs = folder.join("programs");
    fake_debian(&programs, rust)?;
    let path = format!("{}:{}", programs.display(), std::env::var("PATH")?);
    let script = paths::workspace().join("fmu-build").join("cross").join(script);
    let output = Command::new("bash").arg(script).arg(folder.join("tools")).arg("1.89").env("PATH", path).output()?;
    assert!(!output.status.success());
    let downloads = String::from_utf8(output.stdout)?.contains("downloading");
    Ok(format!("{}{}", if downloads { "downloading; " } else { "" }, String::from_utf8(output.stderr)?))
}

#[test]
fn an_old_rust_is_refused_before_anything_is_downloaded() -> Result<()> {
    for script in ["rust.sh", "windows.sh"] {
        for old in ["1.85.0", "1.9.1"] {
            let said = said(script, old)?;
            assert!(said.starts_with(&format!("Debian's rustc-web is Rust {old} here, and 1.89")), "{script}: {said}");
            assert!(said.contains("apt-get update"), "{said}");
        }
    }
    Ok(())
}

#[test]
fn a_missing_package_is_reported_with_the_remedy() -> Result<()> {
    for script in ["rust.sh", "windows.sh", "aarch64.sh"] {
        for new in ["1.89.0", "1.96.1", "2.0.0"] {
            let said = said(script, new)?;
            assert!(said.starts_with("downloading; E: 404") && said.contains("apt-get update"), "{script}: {said}");
        }
    }
    Ok(())
}
