//! The Python environments, each made once from pinned versions: one for fmpy, matplotlib and pytest, and one for each
//! comparison with other programs.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use bevel_differential::variables;

use crate::tools::paths;

/// Oldest Python that the pinned numpy and matplotlib support.
const OLDEST: (u32, u32) = (3, 11);
/// Newest one worth asking for by its number.
const NEWEST: u32 = 15;

/// A Python environment with all requirements.
pub struct Environment {
    folder: PathBuf,
    requirements: PathBuf,
    /// The packages in a few words.
    holds: &'static str,
}

impl Environment {
    /// The environment of all commands but one, made if it does not exist; `report` receives the current stage.
    pub fn ready(report: impl Fn(&str)) -> Result<Self> {
        let requirements = paths::workspace().join("fmu-build").join("python").join("requirements.txt");
        Self {
            folder: paths::target().join("python"),
            requirements,
            holds: "fmpy, numpy, scipy, matplotlib, dask, pymoo, pytest",
        }
        .made(report)
    }

    /// The environment with the programs to compare with; it lies next to the results of the comparison.
    pub fn for_simulators(report: impl Fn(&str)) -> Result<Self> {
        let requirements = paths::simulators_benchmark().join("requirements.txt");
        let folder = paths::target().join("peers").join("venv");
        Self { folder, requirements, holds: "MuJoCo, Drake, fmpy" }.made(report)
    }

    /// The environment with other solvers.
    pub fn for_solvers(report: impl Fn(&str)) -> Result<Self> {
        let requirements = paths::solvers_benchmark().join("requirements.txt");
        Self { folder: paths::target().join("foreign"), requirements, holds: "scipy, scikit-SUNDAE" }.made(report)
    }

    /// The environment with FMI hosts; it lies next to their results.
    pub fn for_hosts(report: impl Fn(&str)) -> Result<Self> {
        let requirements = paths::hosts().join("requirements.txt");
        let folder = paths::target().join("hosts").join("venv");
        Self { folder, requirements, holds: "fmpy, libcosimpy, ecospy, fmuloader, FMU Manipulation Toolbox" }
            .made(report)
    }

    /// The environment with what drives a browser.
    pub fn for_browser(report: impl Fn(&str)) -> Result<Self> {
        let requirements = paths::browser_tests().join("requirements.txt");
        Self { folder: paths::target().join("browser"), requirements, holds: "playwright, pytest, fmpy, numpy" }
            .made(report)
    }

    /// The environment with the linker for old Linux systems.
    pub fn for_old_linux(report: impl Fn(&str)) -> Result<Self> {
        Self::of_old_linux().made(report)
    }

    /// The same if it has been made, for these requirements.
    pub fn old_linux() -> Option<Self> {
        let environment = Self::of_old_linux();
        let stamp = environment.wanted_stamp().ok()?;
        environment.is_stamped(&stamp).then_some(environment)
    }

    fn of_old_linux() -> Self {
        let requirements = paths::workspace().join("fmu-build").join("cross").join("requirements.txt");
        Self { folder: paths::toolchains().join("linux"), requirements, holds: "zig, cargo-zigbuild" }
    }

    /// The folder with its programs.
    pub fn programs(&self) -> PathBuf {
        self.folder.join(if cfg!(windows) { "Scripts" } else { "bin" })
    }

    /// The folder with its packages.
    pub fn packages(&self) -> Result<PathBuf> {
        let mut command = self.command();
        let output = command.args(["-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]).output()?;
        Ok(PathBuf::from(String::from_utf8_lossy(&output.stdout).trim()))
    }

    /// The environment that builds the other parts of a drivetrain and couples them.
    pub fn for_drivetrain(report: impl Fn(&str)) -> Result<Self> {
        let requirements = paths::drivetrain().join("requirements.txt");
        let folder = paths::target().join("drivetrain").join("venv");
        Self { folder, requirements, holds: "pythonfmu, fmpy, libcosim" }.made(report)
    }

    /// This environment, made if it does not exist or has other requirements.
    fn made(self, report: impl Fn(&str)) -> Result<Self> {
        let stamp = self.wanted_stamp()?;
        fs::create_dir_all(self.folder.parent().unwrap_or(&self.folder))?;
        // released when the file is closed, be it by a crash
        let lock = File::create(self.folder.with_extension("lock")).context("the environment cannot be locked")?;
        lock.lock().context("the environment cannot be locked")?;
        if !self.is_stamped(&stamp) {
            self.make(report)?;
            fs::write(self.stamp(), stamp)?;
        }
        Ok(self)
    }

    /// What the stamp of an environment with these requirements says.
    fn wanted_stamp(&self) -> Result<String> {
        let wanted = fs::read_to_string(&self.requirements)
            .with_context(|| format!("{} cannot be read", self.requirements.display()))?;
        Ok(format!("{:016x}\n", variables::fnv1a(wanted.bytes())))
    }

    fn stamp(&self) -> PathBuf {
        self.folder.join("requirements.stamp")
    }

    /// Complete, for these requirements, and its interpreter still runs.
    fn is_stamped(&self, stamp: &str) -> bool {
        fs::read_to_string(self.stamp()).is_ok_and(|found| found == stamp) && version_of(&self.interpreter()).is_some()
    }

    fn make(&self, report: impl Fn(&str)) -> Result<()> {
        let python = find_python()?;
        report("making the Python environment");
        finish(
            python.command().args(["-m", "venv", "--clear"]).arg(&self.folder),
            "the Python environment cannot be created",
        )?;
        report(&format!("installing {}", self.holds));
        finish(
            self.command()
                .args(["-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check", "-r"])
                .arg(&self.requirements),
            "the Python packages cannot be installed (check the network)",
        )
    }

    fn interpreter(&self) -> Python {
        let inside = if cfg!(windows) { ["Scripts", "python.exe"] } else { ["bin", "python"] };
        Python { program: inside.iter().fold(self.folder.clone(), |path, part| path.join(part)).into(), arguments: &[] }
    }

    /// A command that runs the environment's Python, isolated from the user's settings and files. It finds the package
    /// `bevel_differential` and the modules that scripts share.
    pub fn command(&self) -> Command {
        let folders = [["python", "src"], ["fmu-build", "python"]]
            .map(|[top, folder]| paths::workspace().join(top).join(folder).into_os_string());
        let separator = OsStr::new(if cfg!(windows) { ";" } else { ":" });
        let mut command = self.interpreter().command();
        command
            .env("PYTHONPATH", folders.join(separator))
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .env("PYTHONUTF8", "1")
            .env("MPLBACKEND", "Agg")
            .env("MPLCONFIGDIR", self.folder.join("matplotlib"));
        command
    }

    /// Runs pytest on tests/python with the packaged `fmu` and this `program`; its report is the error if a test fails.
    pub fn test(&self, fmu: &Path, program: &Path, arguments: &[impl AsRef<OsStr>]) -> Result<String> {
        let output = self
            .command()
            .current_dir(paths::workspace())
            .args(["-m", "pytest", "-p", "no:cacheprovider", "--color=no", "tests/python"])
            .args(arguments)
            .env("FMU", fmu)
            .env("FMU_BUILD", program)
            .output()
            .context("pytest cannot be run")?;
        let report = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        if !output.status.success() {
            bail!("the FMU fails its Python tests:\n{report}");
        }
        Ok(report)
    }
}

/// A way to call Python.
struct Python {
    program: std::ffi::OsString,
    arguments: &'static [&'static str],
}

impl Python {
    fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.args(self.arguments).env_remove("PYTHONHOME").env_remove("PYTHONPATH").stdin(Stdio::null());
        command
    }
}

/// Version of an interpreter that runs.
fn version_of(python: &Python) -> Option<(u32, u32)> {
    let output = python.command().args(["-c", "import sys; print(*sys.version_info[:2])"]).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let (major, minor) = text.trim().split_once(' ')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

/// A command that runs the Python that makes environments.
pub fn system() -> Result<Command> {
    Ok(find_python()?.command())
}

/// A Python that is new enough and can make environments.
fn find_python() -> Result<Python> {
    let numbered = (OLDEST.1..=NEWEST).rev().map(|minor| format!("python3.{minor}"));
    let named = ["python3".to_owned(), "python".to_owned()].into_iter().chain(numbered);
    let mut candidates: Vec<Python> = named.map(|name| Python { program: name.into(), arguments: &[] }).collect();
    if cfg!(windows) {
        candidates.insert(0, Python { program: "py".into(), arguments: &["-3"] });
    }
    let mut found = None;
    for python in candidates {
        let Some(version) = version_of(&python) else { continue };
        let complete =
            || python.command().args(["-c", "import venv, ensurepip"]).output().is_ok_and(|o| o.status.success());
        if version >= OLDEST && complete() {
            return Ok(python);
        }
        found = found.max(Some(version));
    }
    let (major, minor) = OLDEST;
    let found = match found {
        None => "no Python was found".to_owned(),
        Some(version) if version < OLDEST => format!("the newest found is {}.{}", version.0, version.1),
        Some(_) => "the one found lacks venv or ensurepip".to_owned(),
    };
    bail!(
        "Python {major}.{minor} or newer with venv and pip is needed, {found}: \
         apt install python3 python3-venv (or see python.org)"
    )
}

/// Runs a command to its end; `problem` and the end of its messages are the error.
pub fn finish(command: &mut Command, problem: &'static str) -> Result<()> {
    let output = command.output().context(problem)?;
    if output.status.success() {
        return Ok(());
    }
    let messages = String::from_utf8_lossy(&output.stderr);
    let last: Vec<&str> = messages.lines().rev().filter(|line| !line.trim().is_empty()).take(3).collect();
    bail!("{problem}: {}", last.into_iter().rev().collect::<Vec<_>>().join(" | "))
}
