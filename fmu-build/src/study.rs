//! The main job: package the FMU, simulate the study's two cases through fmpy, compare with the study and with theory.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::Stdio;
use std::thread;

use anyhow::{Context, Result, bail};
use bevel_differential::model::Parameters;

use crate::evaluation::{Order, Results};
use crate::progress::Progress;
use crate::python::Environment;
use crate::theory::Theory;
use crate::{comparison, package, places};

/// Between these lines of the README stands the table.
const MARKS: [&str; 2] = ["<!-- study table begin -->", "<!-- study table end -->"];

/// Does the study; with `readme` the README's table and pictures are renewed.
pub fn run(readme: bool) -> Result<()> {
    // Python first: what the user has to install should not come out after minutes of building
    let progress = Progress::start("looking for Python");
    let environment = Environment::ready(|what| progress.tell(what))?;
    progress.tell("packaging the FMU");
    let fmu = package::package()?;
    let folder = places::study();
    fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    let theory = Theory::new(&Parameters::default());
    let results = simulate(&environment, &fmu, &folder, &Order::new(&theory), &progress)?;
    progress.finish();
    let report = comparison::report(&theory, &results);
    let markdown = report.markdown();
    fs::write(folder.join("table.md"), &markdown).context("the table cannot be written")?;
    print!("{}", report.terminal());
    println!("\nFMU:     {}\nresults: {}", places::shown(&fmu), places::shown(&folder));
    if readme {
        renew_readme(&markdown)?;
        copy_pictures(&folder)?;
        println!("renewed: README.md, docs/images");
    }
    Ok(())
}

/// Runs study.py in `folder` and reads what it found.
fn simulate(
    environment: &Environment,
    fmu: &Path,
    folder: &Path,
    order: &Order,
    progress: &Progress,
) -> Result<Results> {
    fs::write(folder.join("order.json"), order.json()?).context("the order for study.py cannot be written")?;
    let script = places::workspace().join("fmu-build").join("python").join("study.py");
    let mut child = environment
        .command()
        .arg(script)
        .arg(fmu)
        .arg(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .context("study.py cannot be run")?;
    progress.begin_bar("simulating");
    // both pipes are read at the same time, so that neither fills up
    let complaints = child.stderr.take().map(|mut pipe| {
        thread::spawn(move || {
            let mut text = String::new();
            // what cannot be read is lost: the exit status still tells
            let _ = pipe.read_to_string(&mut text);
            text
        })
    });
    if let Some(pipe) = child.stdout.take() {
        for line in BufReader::new(pipe).lines() {
            let line = line.context("study.py does not speak UTF-8")?;
            if let Some((fraction, what)) = progress_in(&line) {
                progress.advance(fraction, what);
            }
        }
    }
    let status = child.wait().context("study.py got lost")?;
    let complaints = complaints.and_then(|thread| thread.join().ok()).unwrap_or_default();
    if !status.success() {
        bail!("study.py failed: {}", complaints.trim_end());
    }
    let results = fs::read_to_string(folder.join("results.json")).context("study.py left no results")?;
    serde_json::from_str(&results).context("the results of study.py cannot be read")
}

/// A line `progress <fraction> <what>`.
fn progress_in(line: &str) -> Option<(f64, &str)> {
    let (fraction, what) = line.strip_prefix("progress ")?.split_once(' ')?;
    Some((fraction.parse().ok()?, what))
}

fn renew_readme(table: &str) -> Result<()> {
    let file = places::workspace().join("README.md");
    let text = fs::read_to_string(&file).context("README.md cannot be read")?;
    let renewed = replaced(&text, table).with_context(|| {
        format!("README.md has no place for the table: no lines \"{}\" and \"{}\"", MARKS[0], MARKS[1])
    })?;
    fs::write(&file, renewed).context("README.md cannot be written")
}

/// `text` with `table` between the marks.
fn replaced(text: &str, table: &str) -> Option<String> {
    let (before, rest) = text.split_once(MARKS[0])?;
    let (_, after) = rest.split_once(MARKS[1])?;
    Some(format!("{before}{}\n{table}{}{after}", MARKS[0], MARKS[1]))
}

fn copy_pictures(folder: &Path) -> Result<()> {
    let images = places::workspace().join("docs").join("images");
    fs::create_dir_all(&images).context("docs/images cannot be made")?;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if let (Some("png"), Some(name)) = (path.extension().and_then(|e| e.to_str()), path.file_name()) {
            fs::copy(&path, images.join(name)).with_context(|| format!("{} cannot be copied", path.display()))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{MARKS, progress_in, replaced};

    #[test]
    fn the_table_replaces_what_is_between_the_marks() {
        let text = format!("a\n{}\nold\n{}\nb\n", MARKS[0], MARKS[1]);
        let wanted = format!("a\n{}\nnew\n{}\nb\n", MARKS[0], MARKS[1]);
        assert_eq!(replaced(&text, "new\n"), Some(wanted));
        assert_eq!(replaced("no marks", "new\n"), None);
    }

    #[test]
    fn a_progress_line_has_a_fraction_and_a_text() {
        assert_eq!(progress_in("progress 0.25 turning, 0.5 s"), Some((0.25, "turning, 0.5 s")));
        assert_eq!(progress_in("something else"), None);
    }
}
