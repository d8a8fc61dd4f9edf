//! Commands that run a script in Python. What it prints is for the terminal, and where asked for, documents take it with its pictures.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use answers::text::table::for_terminal;
use anyhow::{Context, Result};
use clap::{Arg, ArgAction, ArgMatches, value_parser};
use fmu_build::fmu::{libraries, package, plain_types};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::{Environment, Wanted};
use fmu_build::tools::{paths, script, sections};

use super::command::Command;

/// A command that runs a script.
pub struct Script {
    /// Its name.
    pub name: &'static str,
    /// A former name.
    pub alias: Option<&'static str>,
    /// What it does, in a line.
    pub about: &'static str,
    /// What its help says beyond that.
    pub more: Option<&'static str>,
    /// `write` renews the documents, `out` names the folder of results.
    pub options: fn() -> Vec<Arg>,
    /// What it runs in.
    pub needs: Needs,
    /// Its path in the workspace, or a module of Python.
    pub file: &'static str,
    /// What it does, beside the bar.
    pub doing: &'static str,
    /// The folder of its results in the target directory, if it leaves any; options in braces stand for their values.
    pub folder: Option<&'static str>,
    /// Its arguments.
    pub given: &'static [Given],
    /// What documents take.
    pub sections: &'static [Section],
    /// Whether documents show the pictures in its folder.
    pub has_pictures: bool,
}

/// What most scripts have in common.
pub const SCRIPT: Script = Script {
    name: "",
    alias: None,
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

/// The environment of a script.
pub enum Needs {
    /// That of users' commands.
    Users,
    /// The same with the packages of the tests.
    Tests,
    /// One of its own: the folder with its list of packages, its place in the target directory, the packages in a few words.
    Own([&'static str; 3]),
}

/// An argument of a script.
pub enum Given {
    /// The packaged FMU.
    Fmu,
    /// The same for hosts without enumerations.
    PlainFmu,
    /// The library with the equations of motion.
    Equations,
    /// The folder of results.
    Folder,
    /// A folder of the target directory.
    Target(&'static str),
    /// The folder of the repository.
    Workspace,
    /// A word as it is.
    Word(&'static str),
    /// The value of an option.
    Value(&'static str),
    /// An option by its name: alone if it is a switch, or with its value; nothing if it is not there.
    Named(&'static str),
    /// What a function makes of the options.
    Made(fn(&ArgMatches, &Progress) -> Result<Vec<OsString>>),
}

/// A section of a document: path in the workspace, name in its marks, and the file of results that has it; without a file it is
/// what the script prints. Without a name the document is a copy of the file. A file that the script does not write renews nothing.
pub type Section = (&'static str, &'static str, &'static str);

/// A switch.
pub fn flag(name: &'static str, help: &'static str) -> Arg {
    Arg::new(name).long(name).help(help).action(ArgAction::SetTrue)
}

/// A whole number.
pub fn number(name: &'static str, value: &'static str, usual: &'static str, help: &'static str) -> Arg {
    let number = Arg::new(name).long(name).help(help).value_name(value);
    number.default_value(usual).value_parser(value_parser!(u64))
}

/// A file or a folder.
pub fn path(name: &'static str, value: &'static str, help: &'static str) -> Arg {
    Arg::new(name).long(name).help(help).value_name(value).value_parser(value_parser!(PathBuf))
}

fn is_set(options: &ArgMatches, name: &str) -> bool {
    matches!(options.try_get_one::<bool>(name), Ok(Some(true)))
}

impl Script {
    /// The command.
    pub fn command(self) -> Command {
        let declared = clap::Command::new(self.name).about(self.about).aliases(self.alias).args((self.options)());
        let declared = match self.more {
            Some(more) => declared.long_about(format!("{}\n\n{more}", self.about)),
            None => declared,
        };
        Command { declared, run: Box::new(move |options| self.run(options)) }
    }

    /// Runs it with `options`, and renews the documents if asked for.
    pub fn run(&self, options: &ArgMatches) -> Result<()> {
        let folder = self.folder(options);
        let printed = self.follow(folder.as_deref(), |progress| {
            let words = self.given.iter().map(|given| given.words(options, folder.as_deref(), progress));
            Ok(words.collect::<Result<Vec<_>>>()?.concat())
        })?;
        if is_set(options, "write") { self.renew(&printed, &folder.unwrap_or_default()) } else { Ok(()) }
    }

    /// Runs it with the arguments that `prepare` returns, prints its tables and where its results are, and returns the tables.
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
        let arguments = prepare(&progress)?;
        if let Some(folder) = folder {
            paths::create_folder(folder)?;
            // what is there afterwards is of this run
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

    /// The folder of results: the one that an option names, or its own.
    fn folder(&self, options: &ArgMatches) -> Option<PathBuf> {
        if let Ok(Some(named)) = options.try_get_one::<PathBuf>("out") {
            return Some(named.clone());
        }
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
                "" => fs::write(paths::workspace().join(document), text)
                    .with_context(|| format!("{document} cannot be written"))?,
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

/// An environment beside those of users and tests, made if it is not there.
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
