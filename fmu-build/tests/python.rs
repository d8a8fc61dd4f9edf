//! Python tests of the packaged FMU in a host by other authors.

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
    println!("{}", environment.test(&fmu, program, &["-q", "-n", "auto", "--dist", "worksteal"])?);
    Ok(())
}
