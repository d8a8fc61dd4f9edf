//! Commands that run a Python script. The tables are printed. With the option `write`, tables and figures are also
//! written to the documents.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use answers::text::table::for_terminal;
use anyhow::{Context, Result};
use clap::{Arg, ArgAction, ArgMatches, value_parser};
use fmu_build::fmu::{libraries, package, plain_types};
use fmu_build::tools::files::write_whole;
use fmu_build::tools::lock::Lock;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::{Environment, Wanted};
use fmu_build::tools::{paths, script, sections};

use super::command::Command;

/// A command that runs a script.
pub struct Script {
    /// Name of the command.
    pub name: &'static str,
    /// The help text in one line.
    pub about: &'static str,
    /// A second paragraph of the long help text.
    pub more: Option<&'static str>,
    /// Options of the command. A switch `write` renews the documents.
    pub options: fn() -> Vec<Arg>,
    /// Python environment of the script.
    pub needs: Needs,
    /// Path of the script in the workspace, or a Python module.
    pub file: &'static str,
    /// Text next to the progress bar.
    pub doing: &'static str,
    /// Folder of the results in the target directory, if there are any. The name of an option in braces is replaced by
    /// its value.
    pub folder: Option<&'static str>,
    /// Arguments of the script, in order.
    pub given: &'static [Given],
    /// Sections of documents that `write` renews.
    pub sections: &'static [Section],
    /// True if `write` copies the pictures of the folder to the documents.
    pub has_pictures: bool,
}

/// Defaults of a script.
pub const DEFAULTS: Script = Script {
    name: "",
    about: "",
    more: None,
    options: Vec::new,
    needs: Needs::Users,
    file: "",
    doing: "measuring",
    folder: None,
    given: &[],
    sections: &[],
    has_pictures: false,
};

/// The Python environment of a script.
pub enum Needs {
    /// The environment of the Python package's commands.
    Users,
    /// The users' environment with the packages of the tests.
    Tests,
    /// A separate environment: folder of requirements.txt, folder in the target directory, main packages.
    Own([&'static str; 3]),
}

/// An argument of a script.
pub enum Given {
    /// The packaged FMU.
    Fmu,
    /// The packaged FMU with integers instead of enumerations.
    PlainFmu,
    /// A library with the equations of motion, for other solvers.
    Equations,
    /// The folder of results.
    Folder,
    /// A folder of the target directory.
    Target(&'static str),
    /// The folder of the repository.
    Workspace,
    /// A fixed word.
    Word(&'static str),
    /// The value of an option.
    Value(&'static str),
    /// An option, passed on as `--NAME`, with its path if it has one. Nothing is passed if the option is not set.
    Named(&'static str),
    /// Arguments that a function computes from the options.
    Made(fn(&ArgMatches, &Progress) -> Result<Vec<OsString>>),
}

/// A section of a document: path of the document in the workspace, name in the markers of the section, file of results.
/// If the file is empty, the section is the printed output. If the name is empty, the document becomes a copy of the
/// file. If the folder of results lacks the file, the section is unchanged.
pub type Section = (&'static str, &'static str, &'static str);

/// An option without a value.
pub fn flag(name: &'static str, help: &'static str) -> Arg {
    Arg::new(name).long(name).help(help).action(ArgAction::SetTrue)
}

/// An option with a whole number and the default `usual`.
pub fn number(name: &'static str, value: &'static str, usual: &'static str, help: &'static str) -> Arg {
    let number = Arg::new(name).long(name).help(help).value_name(value);
    number.default_value(usual).value_parser(value_parser!(u64))
}

/// An option with the path of a file or folder.
pub fn path(name: &'static str, value: &'static str, help: &'static str) -> Arg {
    Arg::new(name).long(name).help(help).value_name(value).value_parser(value_parser!(PathBuf))
}

fn is_set(options: &ArgMatches, name: &str) -> bool {
    matches!(options.try_get_one::<bool>(name), Ok(Some(true)))
}

impl Script {
    /// Declares the script as a command of the program.
    pub fn command(self) -> Command {
        let declared = clap::Command::new(self.name).about(self.about).args((self.options)());
        let declared = match self.more {
            Some(more) => declared.long_about(format!("{}\n\n{more}", self.about)),
            None => declared,
        };
        Command { declared, run: Box::new(move |options| self.run(options)) }
    }

    /// Runs the script with `options`, and renews the documents if `write` is set.
    pub fn run(&self, options: &ArgMatches) -> Result<()> {
        let folder = self.folder(options);
        let printed = self.follow(folder.as_deref(), |progress| {
            let words = self.given.iter().map(|given| given.words(options, folder.as_deref(), progress));
            Ok(words.collect::<Result<Vec<_>>>()?.concat())
        })?;
        if is_set(options, "write") { self.renew(&printed, &folder.unwrap_or_default()) } else { Ok(()) }
    }

    /// Runs the script with the arguments from `prepare`. Prints its tables and the folder of results. Returns the tables.
    pub fn follow(
        &self,
        folder: Option<&Path>,
        prepare: impl FnOnce(&Progress) -> Result<Vec<OsString>>,
    ) -> Result<String> {
        let progress = Progress::start("looking for Python");
        let report = |what: &str| progress.stage(what);
        let environment = match self.needs {
            Needs::Users => Environment::ready(report)?,
            Needs::Tests => Environment::complete(report)?,
            Needs::Own(own) => environment(own, report)?,
        };
        let _alone = folder.map(Lock::of).transpose()?;
        let arguments = prepare(&progress)?;
        if let Some(folder) = folder {
            paths::create_folder(folder)?;
            // so that every file in the folder after the run is from this run
            for (.., file) in self.sections.iter().filter(|(.., file)| folder.join(file).is_file()) {
                fs::remove_file(folder.join(file)).with_context(|| format!("{file} cannot be removed"))?;
            }
        }
        progress.begin_bar(self.doing);
        let mut command = environment.command();
        if self.file.ends_with(".py") {
            command.arg(paths::workspace().join(self.file));
        } else {
            command.args(["-m", self.file]);
        }
        let name = self.file.rsplit('/').next().unwrap_or(self.file);
        let printed = script::follow(command.args(arguments), name, &progress)?;
        progress.finish();
        print!("{}", for_terminal(&printed));
        if let Some(folder) = folder {
            println!("\nresults: {}", paths::shown(folder));
        }
        Ok(printed)
    }

    /// Folder of the results.
    fn folder(&self, options: &ArgMatches) -> Option<PathBuf> {
        let values = options.ids().map(|id| (format!("{{{id}}}"), value(options, id.as_str())));
        let named = |own: &str| values.fold(own.to_owned(), |folder, (option, value)| folder.replace(&option, &value));
        self.folder.map(|own| paths::target().join(named(own)))
    }

    fn renew(&self, printed: &str, folder: &Path) -> Result<()> {
        let mut renewed = Vec::new();
        for &(document, name, file) in self.sections {
            let text = match file {
                "" => printed.to_owned(),
                _ if !folder.join(file).is_file() => continue,
                _ => fs::read_to_string(folder.join(file)).with_context(|| format!("{file} cannot be read"))?,
            };
            match name {
                "" => write_whole(&paths::workspace().join(document), text.as_bytes())?,
                _ => sections::renew(
                    document,
                    [&format!("<!-- {name}:begin -->"), &format!("<!-- {name}:end -->")],
                    &text,
                )?,
            }
            renewed.push(document);
        }
        if self.has_pictures {
            sections::copy_pictures(folder)?;
            renewed.push("docs/figures");
        }
        renewed.dedup();
        println!("renewed: {}", renewed.join(", "));
        Ok(())
    }
}

/// Environment of `Needs::Own`, created if it does not exist.
pub fn environment([list, place, holds]: [&'static str; 3], report: impl Fn(&str)) -> Result<Environment> {
    let requirements = paths::workspace().join(list).join("requirements.txt");
    Wanted { folder: paths::target().join(place), requirements, holds }.made(report)
}

fn value(options: &ArgMatches, name: &str) -> String {
    let raw = options.get_raw(name).into_iter().flatten().next().unwrap_or_default();
    raw.display().to_string()
}

impl Given {
    fn words(&self, options: &ArgMatches, folder: Option<&Path>, progress: &Progress) -> Result<Vec<OsString>> {
        let packaged = || {
            progress.stage("packaging the FMU");
            package::package()
        };
        let word = match self {
            Self::Fmu => packaged()?.into(),
            Self::PlainFmu => plain_types::package(&packaged()?)?.into(),
            Self::Equations => {
                progress.stage("building the equations as a library");
                libraries::build_library("foreign-solvers")?.into()
            }
            Self::Folder => folder.unwrap_or(Path::new("")).into(),
            Self::Target(name) => paths::target().join(name).into(),
            Self::Workspace => paths::workspace().into(),
            Self::Word(word) => word.into(),
            Self::Value(name) => value(options, name).into(),
            Self::Named(name) => {
                let option = OsString::from(format!("--{name}"));
                return Ok(match options.try_get_one::<PathBuf>(name) {
                    Ok(Some(path)) => vec![option, path.into()],
                    _ if is_set(options, name) => vec![option],
                    _ => Vec::new(),
                });
            }
            Self::Made(make) => return make(options, progress),
        };
        Ok(vec![word])
    }
}
