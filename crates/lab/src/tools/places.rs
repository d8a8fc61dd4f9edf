//! Folders of the repository that only the laboratory reads, and the Python environments of what is there, each beside its results.

use std::path::PathBuf;

use anyhow::Result;
use fmu_build::tools::paths::{target, workspace};
use fmu_build::tools::python::{Environment, Wanted};

/// A folder with scripts and the list of packages that they need.
pub struct Bench {
    folder: [&'static str; 2],
    /// Where its environment is, below the folder of results.
    environment: &'static str,
    /// The packages in a few words.
    holds: &'static str,
}

/// The comparison with other simulators.
pub const SIMULATORS: Bench =
    Bench { folder: ["benches", "peers"], environment: "peers/venv", holds: "MuJoCo, Drake, fmpy" };
/// The comparison with solvers written by others.
pub const SOLVERS: Bench =
    Bench { folder: ["benches", "foreign"], environment: "foreign", holds: "scipy, scikit-SUNDAE" };
/// The scripts and scenes of other hosts.
pub const HOSTS: Bench = Bench {
    folder: ["tests", "hosts"],
    environment: "hosts/venv",
    holds: "fmpy, libcosimpy, ecospy, fmuloader, FMU Manipulation Toolbox",
};
/// What reads the source.
pub const MUTANTS: Bench =
    Bench { folder: ["crates/lab/python", "mutants"], environment: "mutants/venv", holds: "tree-sitter" };
/// The tests of the page in a browser.
pub const BROWSER: Bench =
    Bench { folder: ["tests", "browser"], environment: "browser", holds: "playwright, pytest, fmpy, numpy" };
/// The drivetrain coupled from FMUs.
pub const DRIVETRAIN: Bench =
    Bench { folder: ["examples", "drivetrain"], environment: "drivetrain/venv", holds: "pythonfmu, fmpy, libcosim" };

impl Bench {
    /// Its folder.
    pub fn folder(&self) -> PathBuf {
        workspace().join(self.folder[0]).join(self.folder[1])
    }

    /// Its environment, made if it is not there; `report` receives the current stage.
    pub fn environment(&self, report: impl Fn(&str)) -> Result<Environment> {
        let requirements = self.folder().join("requirements.txt");
        Wanted { folder: target().join(self.environment), requirements, holds: self.holds }.made(report)
    }
}

/// A script of the laboratory's own.
pub fn script(name: &str) -> PathBuf {
    workspace().join("crates").join("lab").join("python").join(name)
}

/// Hosts written in C.
pub fn c_hosts() -> PathBuf {
    workspace().join("tests").join("c")
}
