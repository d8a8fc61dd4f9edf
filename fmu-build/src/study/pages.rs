//! The command `report`: a page about a scene, by the command of the same name in the Python package.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::Args;

use crate::fmu::package;
use answers::scene::find_with;
use crate::tools::progress::Progress;
use crate::tools::python::Environment;
use crate::tools::{paths, script, usage};

/// Settings of a scene that are no variables of the FMU; the Python package has them in the scene file alone.
const OF_THE_FILE: [&str; 2] = ["stop_time", "step"];

/// Writes a report of a scene: one HTML file with figures, tables and what they say
#[derive(Args, Clone, Debug)]
pub struct ReportCommand {
    /// A scene file, or the name of a scene
    #[arg(long, value_name = "FILE|NAME")]
    scene: String,
    /// Change the scene, such as left.load_torque="400 N.m" (may be repeated)
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// The page to write [default: target/report/NAME.html]
    #[arg(long, value_name = "OUT.html")]
    out: Option<PathBuf>,
    /// Leave out what needs other runs: the run-up, and effects that are off
    #[arg(long)]
    quick: bool,
}

impl ReportCommand {
    /// Packages the FMU, writes the report and says where it is.
    pub fn run(&self) -> Result<()> {
        // what is wrong with the scene should not come out after minutes of building
        let scene = find_with(&self.scene, &self.set).map_err(|problem| usage::error(format!("{problem:#}")))?;
        if let Some(set) = self.set.iter().find(|set| OF_THE_FILE.iter().any(|key| set.trim().starts_with(key))) {
            return Err(usage::error(format!("--set {set}: a report takes it from the scene file; change it there")));
        }
        let file = match &self.out {
            Some(file) => {
                paths::ensure_parent(file)?;
                file.clone()
            }
            None => {
                paths::create_folder(&paths::report())?;
                paths::report().join(format!("{}.html", scene.name))
            }
        };
        let progress = Progress::start("looking for Python");
        let environment = Environment::ready(|what| progress.stage(what))?;
        progress.stage("packaging the FMU");
        let fmu = package::package()?;
        let order = Order { scene: self.scene.clone(), file: file.clone(), settings: self.set.clone() };
        progress.begin_bar("writing the report");
        write(&environment, &fmu, &[order], self.quick, &progress)?;
        progress.finish();
        println!("{}", paths::shown(&file));
        Ok(())
    }
}

/// A report to write.
pub struct Order {
    /// Scene by name or file.
    pub scene: String,
    /// Where the report goes.
    pub file: PathBuf,
    /// NAME=VALUE of what differs from the scene.
    pub settings: Vec<String>,
}

/// Writes reports with the packaged `fmu`; `quick` leaves out what needs other runs.
pub fn write(environment: &Environment, fmu: &Path, orders: &[Order], quick: bool, progress: &Progress) -> Result<()> {
    let mut arguments: Vec<OsString> = vec![fmu.into(), if quick { "quick" } else { "full" }.into()];
    for (place, order) in orders.iter().enumerate() {
        if place > 0 {
            arguments.push("--".into());
        }
        arguments.extend([OsString::from(&order.scene), order.file.clone().into()]);
        arguments.extend(order.settings.iter().map(OsString::from));
    }
    let script = paths::workspace().join("fmu-build").join("python").join("scene_report.py");
    script::run(environment, &script, &arguments, progress).map(drop)
}
