//! One host on one scene, in a separate process.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use serde::Deserialize;

use super::list::{Host, HostStart};
use crate::tools::{environments, places};
use fmu_build::tools::paths;
use fmu_build::tools::python::Environment;

/// Status of a script whose host cannot be loaded; common.py has the same.
const CANNOT_LOAD: i32 = 3;
/// The crate fmi-sim, which is a separate program.
const FMI_SIM: [&str; 2] = ["fmi-sim", "0.7.0"];

/// A scene of tests/hosts/scenes.
pub struct HostScene {
    /// Name of its file.
    pub name: String,
    /// Path of its file.
    pub path: PathBuf,
    /// What the file says.
    pub file: HostSceneFile,
}

/// Parts of a scene's file.
#[derive(Deserialize)]
pub struct HostSceneFile {
    /// What is simulated.
    pub description: String,
    /// Communication step [s].
    pub step: f64,
    /// Natural scale of each output.
    pub outputs: BTreeMap<String, f64>,
}

/// What a script reports of a run.
#[derive(Clone, Debug, Deserialize)]
pub struct HostRun {
    /// The host's version.
    pub version: String,
    /// From loading the FMU to freeing it [s].
    pub seconds: f64,
}

/// How a run ended.
pub enum HostOutcome {
    /// With a table.
    Ran(HostRun),
    /// Not at all: the host cannot be loaded here, and why.
    Absent(String),
}

/// What hosts need before they run.
pub struct HostBench {
    environment: Environment,
    /// Where results go.
    pub folder: PathBuf,
    /// The program with the hosts in Rust, and fmi-sim; or why they are not there.
    rust: Result<PathBuf, String>,
    fmi_sim: Result<PathBuf, String>,
}

/// All scenes, by name.
pub fn scenes() -> Result<Vec<HostScene>> {
    let folder = places::hosts().join("scenes");
    let mut files: Vec<PathBuf> = fs::read_dir(&folder)
        .with_context(|| format!("{} cannot be read", folder.display()))?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "json"))
        .collect();
    files.sort();
    let scene = |path: PathBuf| {
        let file = serde_json::from_str(&fs::read_to_string(&path)?)
            .with_context(|| format!("{} is not a scene", paths::shown(&path)))?;
        Ok(HostScene { name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(), path, file })
    };
    files.into_iter().map(scene).collect()
}

impl HostBench {
    /// With the Python environment and, if `with_rust`, the hosts in Rust; `report` receives the current stage.
    pub fn ready(with_rust: bool, report: impl Fn(&str)) -> Result<Self> {
        let folder = paths::target().join("hosts");
        paths::create_folder(&folder)?;
        let environment = environments::hosts(&report)?;
        let left_out = || Err("left out without --with-fmi-sim, as its build takes minutes".to_owned());
        let (mut rust, mut fmi_sim) = (left_out(), left_out());
        if with_rust {
            report("building fmu-runner and fmi-rs");
            rust = build_rust(&folder);
            report("building fmi-sim (many minutes)");
            fmi_sim = install_fmi_sim(&folder);
        }
        Ok(Self { environment, folder, rust, fmi_sim })
    }

    /// Whether `host` was left out on demand.
    pub fn leaves_out(&self, host: &Host, with_rust: bool) -> bool {
        !with_rust && (matches!(host.start, HostStart::Rust(_)) || host.name == FMI_SIM[0])
    }

    /// Runs `host` on `scene` with `fmu`; its table goes to `out`.
    pub fn run(&self, host: &Host, scene: &HostScene, fmu: &Path, out: &Path) -> Result<HostOutcome> {
        let mut command = match host.start {
            HostStart::Script(script, _) => {
                let mut command = self.environment.command();
                command.arg(places::hosts().join(script));
                command
            }
            HostStart::Rust(name) => match &self.rust {
                Ok(program) => {
                    let mut command = Command::new(program);
                    command.arg(name);
                    command
                }
                Err(why) => return Ok(HostOutcome::Absent(why.clone())),
            },
        };
        if host.name == FMI_SIM[0] {
            match &self.fmi_sim {
                Ok(program) => command.env("FMI_SIM", program),
                Err(why) => return Ok(HostOutcome::Absent(why.clone())),
            };
        }
        command.arg(fmu).arg(&scene.path).arg(out);
        if let HostStart::Script(_, arguments) = host.start {
            command.args(arguments);
        }
        // some write logs into the current folder
        command.current_dir(out.parent().unwrap_or(out));
        let ended = command.output().with_context(|| format!("{} cannot be run", host.name))?;
        let (printed, remarks) = (String::from_utf8_lossy(&ended.stdout), String::from_utf8_lossy(&ended.stderr));
        if ended.status.code() == Some(CANNOT_LOAD) {
            return Ok(HostOutcome::Absent(format!("{} ({})", last_line(&remarks), host.hint)));
        }
        if !ended.status.success() {
            bail!("{} fails on {} ({}):\n{}", host.name, scene.name, ended.status, remarks.trim_end());
        }
        let run = serde_json::from_str(last_line(&printed));
        Ok(HostOutcome::Ran(run.with_context(|| format!("{} reports nothing of its run", host.name))?))
    }
}

fn last_line(text: &str) -> &str {
    text.trim_end().lines().next_back().unwrap_or_default()
}

fn build_rust(folder: &Path) -> Result<PathBuf, String> {
    let manifest = places::hosts().join("rust").join("Cargo.toml");
    let target = folder.join("rust");
    cargo(|command| {
        command.args(["build", "--release", "--locked", "--quiet", "--manifest-path"]).arg(manifest);
        command.arg("--target-dir").arg(&target);
    })?;
    Ok(target.join("release").join(format!("rust-hosts{}", env::consts::EXE_SUFFIX)))
}

fn install_fmi_sim(folder: &Path) -> Result<PathBuf, String> {
    let [name, version] = FMI_SIM;
    let root = folder.join(name);
    cargo(|command| {
        command.args(["install", name, "--version", version, "--locked", "--quiet", "--root"]).arg(&root);
    })?;
    Ok(root.join("bin").join(format!("{name}{}", env::consts::EXE_SUFFIX)))
}

/// Runs cargo; the last line it says is the reason if it fails.
fn cargo(arguments: impl FnOnce(&mut Command)) -> Result<(), String> {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    arguments(&mut command);
    let output = command.output().map_err(|error| format!("cargo cannot be run: {error}"))?;
    let remarks = String::from_utf8_lossy(&output.stderr);
    if output.status.success() { Ok(()) } else { Err(format!("it does not build: {}", last_line(&remarks))) }
}
