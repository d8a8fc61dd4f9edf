//! Folders of the repository that only the laboratory reads.

use std::path::PathBuf;

use fmu_build::tools::paths::workspace;

/// A script of the laboratory's own.
pub fn script(name: &str) -> PathBuf {
    workspace().join("crates").join("lab").join("python").join(name)
}

/// The comparison with other simulators.
pub fn simulators_benchmark() -> PathBuf {
    workspace().join("benches").join("peers")
}

/// The comparison with solvers written by others.
pub fn solvers_benchmark() -> PathBuf {
    workspace().join("benches").join("foreign")
}

/// The scripts and scenes of other hosts.
pub fn hosts() -> PathBuf {
    workspace().join("tests").join("hosts")
}

/// The tests of the page in a browser.
pub fn browser_tests() -> PathBuf {
    workspace().join("tests").join("browser")
}

/// The drivetrain coupled from FMUs.
pub fn drivetrain() -> PathBuf {
    workspace().join("examples").join("drivetrain")
}

/// Hosts written in C.
pub fn c_hosts() -> PathBuf {
    workspace().join("tests").join("c")
}
