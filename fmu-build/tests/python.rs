//! Python tests of the packaged FMU in a host by other authors.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use anyhow::Result;
use fmu_build::fmu::package;
use fmu_build::tools::python::Environment;

#[test]
fn the_fmu_passes_its_python_tests() -> Result<()> {
    let environment = Environment::complete(|what| println!("{what}"))?;
    let fmu = package::package()?;
    // the error is pytest's report, which Debug prints line by line
    let program = Path::new(env!("CARGO_BIN_EXE_fmu-build"));
    let report = environment.test(&fmu, program, &["-q", "-rs", "-n", "auto", "--dist", "worksteal"])?;
    println!("{report}");
    // the test harness captures `print!` of a test that passes, but not this
    writeln!(std::io::stderr(), "{}", left_out(&report))?;
    Ok(())
}

/// Line about checks that did not run: the number of skipped tests for each reason, and checks that are separate
/// commands.
fn left_out(report: &str) -> String {
    let mut skipped: BTreeMap<&str, usize> = BTreeMap::new();
    for line in report.lines().filter_map(|line| line.strip_prefix("SKIPPED [")) {
        let Some((count, rest)) = line.split_once("] ") else { continue };
        // FILE:LINE: REASON
        let reason = rest.split_once(": ").map_or(rest, |(_, reason)| reason);
        *skipped.entry(reason).or_default() += count.parse::<usize>().unwrap_or(1);
    }
    let mut text = String::from("left out: ");
    skipped.iter().for_each(|(reason, count)| text.push_str(&format!("{count} Python tests ({reason}); ")));
    text + "checks with valgrind, node, Chromium and other hosts: python3 crates/lab/lab.py help"
}

#[test]
fn skipped_tests_are_counted_by_reason() {
    let report = "...s\nSKIPPED [2] tests/python/test_a.py:12: no library for Windows\n\
                  SKIPPED [1] tests/python/test_b.py:3: no library for Windows\n9 passed, 3 skipped\n";
    assert!(left_out(report).starts_with("left out: 3 Python tests (no library for Windows); checks with valgrind"));
    assert!(left_out("9 passed").starts_with("left out: checks with valgrind"));
}
