//! Python environments, each created once from pinned versions: the environment of users' commands, to which the tests
//! add packages, and separate ones for other commands.

use std::env;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use bevel_differential::variables;

use crate::tools::files::{make_whole, write_whole};
use crate::tools::lock::Lock;
use crate::tools::paths;
use crate::tools::program::Finding;

/// Oldest Python that the pinned numpy and matplotlib support.
const OLDEST: (u32, u32) = (3, 11);
/// Newest Python that is searched for by its number.
const NEWEST: u32 = 15;

/// A Python environment.
pub struct Environment {
    folder: PathBuf,
}

/// Specification of an environment.
pub struct Wanted<'a> {
    /// Folder of the environment.
    pub folder: PathBuf,
    /// File with the list of packages.
    pub requirements: PathBuf,
    /// Short description of the packages.
    pub holds: &'a str,
}

impl Wanted<'_> {
    /// Returns the environment. It is created if it does not exist or has other requirements; `report` receives the
    /// current stage.
    pub fn made(&self, report: impl Fn(&str)) -> Result<Environment> {
        let stamp = stamp_of(&[&self.requirements])?;
        self.folder().made(&[&stamp], &stamp, |environment| {
            environment.make(&report)?;
            environment.install(&self.requirements, None, self.holds, &report)
        })
    }

    /// Returns the environment if it exists with these requirements.
    pub fn found(&self) -> Option<Environment> {
        let stamp = stamp_of(&[&self.requirements]).ok()?;
        let environment = self.folder();
        environment.has(&stamp).then_some(environment)
    }

    fn folder(&self) -> Environment {
        Environment { folder: self.folder.clone() }
    }
}

impl Environment {
    /// Returns the environment of users' commands, which is created if it does not exist. It may also contain the
    /// packages of the tests. `report` receives the current stage.
    pub fn ready(report: impl Fn(&str)) -> Result<Self> {
        let (environment, [first, all], [first_stamp, all_stamp]) = of_users()?;
        environment.made(&[&first_stamp, &all_stamp], &first_stamp, |environment| {
            environment.make(&report)?;
            environment.install(&first, Some(&all), "fmpy, numpy, matplotlib", &report)
        })
    }

    /// True if the environment of users' commands is complete.
    pub fn is_ready() -> bool {
        of_users().is_ok_and(|(environment, _, stamps)| stamps.iter().any(|stamp| environment.has(stamp)))
    }

    /// Returns the environment of users' commands with the packages of the tests, of all extras of the Python package,
    /// and of the wheel.
    pub fn complete(report: impl Fn(&str)) -> Result<Self> {
        let (environment, [_, all], [first_stamp, all_stamp]) = of_users()?;
        environment.made(&[&all_stamp], &all_stamp, |environment| {
            if !environment.has(&first_stamp) {
                environment.make(&report)?;
            }
            environment.install(&all, None, "scipy, dask, pymoo, pytest", &report)
        })
    }

    /// Folder with the programs.
    pub fn programs(&self) -> PathBuf {
        self.folder.join(if cfg!(windows) { "Scripts" } else { "bin" })
    }

    /// Folder with the packages.
    pub fn packages(&self) -> Result<PathBuf> {
        let mut command = self.command();
        let output = command.args(["-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]).output()?;
        Ok(PathBuf::from(String::from_utf8_lossy(&output.stdout).trim()))
    }

    /// Completes this environment by `make` unless it has one of the stamps in `enough`. Then it gets `stamp`.
    fn made(self, enough: &[&str], stamp: &str, make: impl FnOnce(&Self) -> Result<()>) -> Result<Self> {
        let _alone = Lock::of(&self.folder)?;
        if !enough.iter().any(|stamp| self.has(stamp)) {
            make(&self)?;
            write_whole(&self.stamp(), stamp.as_bytes())?;
        }
        Ok(self)
    }

    fn stamp(&self) -> PathBuf {
        self.folder.join("requirements.stamp")
    }

    /// True if the environment is complete, has this stamp, and its interpreter still runs.
    fn has(&self, stamp: &str) -> bool {
        fs::read_to_string(self.stamp()).is_ok_and(|found| found == stamp) && version_of(&self.interpreter()).is_some()
    }

    fn make(&self, report: impl Fn(&str)) -> Result<()> {
        let python = find_python()?;
        report("making the Python environment");
        finish(
            python.command().args(["-m", "venv", "--clear"]).arg(&self.folder),
            "the Python environment cannot be created",
        )
    }

    /// Installs the packages of a list. If the list contains only names, `pins` contains the versions, and no other
    /// packages are installed.
    fn install(&self, list: &Path, pins: Option<&Path>, what: &str, report: impl Fn(&str)) -> Result<()> {
        report(&format!("installing {what}"));
        let mut pip = self.command();
        // most modules of the packages are never imported; bytecode is compiled at the first import
        pip.args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "--no-input",
            "--disable-pip-version-check",
            "--no-compile",
            "-r",
        ])
        .arg(list);
        if let Some(pins) = pins {
            pip.arg("--no-deps").arg("--constraint").arg(pins);
        }
        finish(&mut pip, "the Python packages cannot be installed (check the network)")
    }

    /// Folder with the bytecode of modules, outside the checkout. Without bytecode, a process takes three times as long
    /// to start.
    fn bytecode(&self) -> PathBuf {
        self.folder.join("bytecode")
    }

    fn interpreter(&self) -> Python {
        let program = self.programs().join(if cfg!(windows) { "python.exe" } else { "python" });
        Python { program: program.into(), arguments: &[] }
    }

    /// Creates a command that runs the environment's Python, isolated from the user's settings and files. It can import
    /// the package `bevel_differential` and the modules that scripts share.
    pub fn command(&self) -> Command {
        let folders =
            [["python", "src"], ["fmu-build", "python"]].map(|[top, folder]| paths::workspace().join(top).join(folder));
        let mut command = self.interpreter().command();
        command
            .envs(env::join_paths(folders).map(|folders| ("PYTHONPATH", folders)))
            .envs(paths::built("answers").map(|library| ("BEVEL_DIFFERENTIAL_ANSWERS", library)))
            .env("BEVEL_DIFFERENTIAL_SCENES", paths::scenes())
            .env_remove("PYTHONDONTWRITEBYTECODE")
            .env("PYTHONPYCACHEPREFIX", self.bytecode())
            .env("PYTHONUTF8", "1")
            .env("MPLBACKEND", "Agg")
            .env("MPLCONFIGDIR", self.folder.join("matplotlib"));
        command
    }

    /// Writes the program `bevel-differential` of this checkout, with `fmu`, into the environment. Returns the path of
    /// the program.
    pub fn launcher(&self, fmu: &Path) -> Result<PathBuf> {
        let source = paths::workspace().join("python").join("src");
        let values = [("FMU", fmu.to_path_buf()), ("ANSWERS", paths::built("answers")?), ("SCENES", paths::scenes())];
        let set: String = values
            .iter()
            .map(|(name, value)| {
                format!("os.environ.setdefault('BEVEL_DIFFERENTIAL_{name}', {:?})\n", value.display().to_string())
            })
            .collect();
        let python = self.interpreter().program;
        let text = format!(
            "#!{}\nimport os, sys\nsys.pycache_prefix = {:?}\nsys.path.insert(0, {:?})\n{set}from bevel_differential.command import main\nif __name__ == '__main__':\n    sys.exit(main())\n",
            python.display(),
            self.bytecode().display().to_string(),
            source.display().to_string()
        );
        let program = self.programs().join(if cfg!(windows) { "bevel-differential.py" } else { "bevel-differential" });
        make_whole(&program, |part| {
            fs::write(part, text)?;
            #[cfg(unix)]
            {
                use std::os::unix::fs::PermissionsExt as _;
                fs::set_permissions(part, fs::Permissions::from_mode(0o755))?;
            }
            Ok(())
        })
        .with_context(|| format!("{} cannot be written", paths::shown(&program)))?;
        Ok(program)
    }

    /// Runs pytest on tests/python with the packaged `fmu` and this `program`. If a test fails, the error is the
    /// report.
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
            return Err(Finding(format!("the FMU fails its Python tests:\n{report}")).into());
        }
        Ok(report)
    }
}

/// Returns the environment of users' commands, its two lists of packages, and the stamps of an environment with the
/// first list and with both. The first list contains only names, the second one all versions.
fn of_users() -> Result<(Environment, [PathBuf; 2], [String; 2])> {
    let lists = paths::workspace().join("fmu-build").join("python");
    let [first, all] = ["first.txt", "requirements.txt"].map(|name| lists.join(name));
    let stamps = [stamp_of(&[&first, &all])?, stamp_of(&[&all])?];
    Ok((Environment { folder: paths::target().join("python") }, [first, all], stamps))
}

/// Text of the stamp of an environment with the packages of these lists.
fn stamp_of(lists: &[&Path]) -> Result<String> {
    let mut text = Vec::new();
    for list in lists {
        text.extend(fs::read(list).with_context(|| format!("{} cannot be read", list.display()))?);
    }
    Ok(format!("{:016x}\n", variables::fnv1a(text.into_iter())))
}

/// Command line to call Python.
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

/// Returns the version of an interpreter if it runs.
fn version_of(python: &Python) -> Option<(u32, u32)> {
    let output = python.command().args(["-c", "import sys; print(*sys.version_info[:2])"]).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let (major, minor) = text.trim().split_once(' ')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

/// Finds a Python that is new enough and can create environments.
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

/// Runs a command to its end. If it fails, the error consists of `problem` and the end of its messages.
pub fn finish(command: &mut Command, problem: &'static str) -> Result<()> {
    let output = command.output().context(problem)?;
    if output.status.success() {
        return Ok(());
    }
    let messages = String::from_utf8_lossy(&output.stderr);
    let last: Vec<&str> = messages.lines().rev().filter(|line| !line.trim().is_empty()).take(3).collect();
    bail!("{problem}: {}", last.into_iter().rev().collect::<Vec<_>>().join(" | "))
}
