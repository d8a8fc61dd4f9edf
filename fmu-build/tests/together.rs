//! Simultaneous runs in one checkout: all of them work, or one waits and reports it.

use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use fmu_build::fmu::package;
use fmu_build::tools::lock::Lock;
use fmu_build::tools::paths;
use zip::ZipArchive;

fn program(words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fmu-build"));
    command.args(words).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// Fails unless all files of the archive can be unpacked.
fn unpacked(file: &Path) -> Result<()> {
    let mut archive = ZipArchive::new(File::open(file)?)?;
    for index in 0..archive.len() {
        std::io::copy(&mut archive.by_index(index)?, &mut std::io::sink())?;
    }
    Ok(())
}

#[test]
fn simultaneous_packing_leaves_a_complete_archive_at_every_moment() -> Result<()> {
    let fmu = package::package()?;
    let mut runs = (0..3).map(|_| program(&["package"]).spawn()).collect::<std::io::Result<Vec<_>>>()?;
    let mut read = 0;
    while runs.iter_mut().any(|run| matches!(run.try_wait(), Ok(None))) {
        for file in [&fmu, &package::of_fmi3(&fmu)] {
            unpacked(file).with_context(|| format!("{}, read {read} times", file.display()))?;
        }
        read += 1;
    }
    ensure!(read > 0, "nothing was read while the runs packed");
    for run in runs {
        let output = run.wait_with_output()?;
        ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let left = fs::read_dir(fmu.parent().context("a folder")?)?.filter_map(Result::ok).map(|entry| entry.file_name());
    let left: Vec<_> = left.filter(|name| name.to_string_lossy().ends_with(".part")).collect();
    ensure!(left.is_empty(), "{left:?}");
    Ok(())
}

#[test]
fn a_run_waits_for_another_one_in_the_same_folder_and_reports_it() -> Result<()> {
    let folder = paths::target().join("test-together");
    let shown = folder.to_string_lossy();
    let lock = Lock::of(&paths::wheel())?;
    let mut run = program(&["wheel", "--platforms", "this-machine", "--parts", &*shown]).spawn()?;
    let mut lines = BufReader::new(run.stderr.take().context("a pipe")?).lines();
    let said = lines.find(|line| line.as_ref().is_ok_and(|line| line.starts_with("waiting for another run")));
    ensure!(said.is_some(), "the run does not wait");
    ensure!(!folder.exists(), "the run works while it should wait");
    drop(lock);
    lines.for_each(drop);
    ensure!(run.wait()?.success(), "the run fails after it has waited");
    ensure!(folder.join("BevelDifferential.fmu").is_file(), "the run has left no unit");
    Ok(fs::remove_dir_all(folder)?)
}
