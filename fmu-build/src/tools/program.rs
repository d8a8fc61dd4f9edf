//! Program with grouped commands: its help, and its usage errors in one line.

use std::ffi::OsString;
use std::fmt;
use std::process::ExitCode;

use anyhow::Result;
use clap::ArgMatches;
use clap::error::ErrorKind;

use answers::problem::Problems;

/// Exit status of wrong use, as in the commands of the Python package.
const WRONG: u8 = 2;
/// Exit status of a completed check with a finding, as in the commands of the Python package.
pub const FINDING: u8 = 3;

/// Error of a completed check with a finding.
#[derive(Debug)]
pub struct Finding(pub String);

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Finding {}

/// A program with the data of its overview.
pub struct Program {
    /// Command line to call the program.
    pub call: &'static str,
    /// Declaration of the complete command line.
    pub root: clap::Command,
    /// Titles of groups, each with a command whose subcommands belong to the group.
    pub groups: Vec<(&'static str, clap::Command)>,
    /// Last paragraph of the overview.
    pub end: String,
}

/// Reason to run no command: help was requested, or the command line is wrong.
#[derive(Debug)]
pub enum Stop {
    /// Text to print.
    Shown(String),
    /// Usage error in one line.
    Wrong(String),
}

impl Stop {
    /// Prints help to standard output, or a usage error to standard error.
    pub fn report(&self) -> ExitCode {
        match self {
            Self::Shown(text) => {
                use std::io::Write as _;
                // a closed pipe is not an error
                let _ = write!(std::io::stdout(), "{text}");
                ExitCode::SUCCESS
            }
            Self::Wrong(line) => {
                eprintln!("{line}");
                ExitCode::from(WRONG)
            }
        }
    }
}

impl Program {
    /// Parses `arguments`, which start with the program's name.
    pub fn parse(&self, arguments: impl IntoIterator<Item = OsString>) -> Result<ArgMatches, Stop> {
        self.command().try_get_matches_from(arguments).map_err(|error| self.stop(&error))
    }

    /// Help text of the program, or of `command` if one is given.
    pub fn help(&self, command: Option<String>) -> Stop {
        let words = [self.root.get_name().to_owned()].into_iter().chain(command).chain(["--help".to_owned()]);
        let shown = self.command().try_get_matches_from(words);
        self.stop(&shown.err().unwrap_or_else(|| clap::Error::new(ErrorKind::DisplayHelp)))
    }

    /// Command line parser.
    pub fn command(&self) -> clap::Command {
        // the last of two equal options applies, as in most programs
        self.root
            .clone()
            .bin_name(self.call)
            .args_override_self(true)
            .override_help(self.overview())
            .mut_subcommands(|command| command.args_override_self(true))
    }

    /// Commands by group, one line for each.
    pub fn overview(&self) -> String {
        let all = || self.groups.iter().flat_map(|(_, group)| group.get_subcommands());
        let width = all().map(|command| command.get_name().len()).max().unwrap_or(0);
        let mut out = format!("Usage: {} [COMMAND] [OPTIONS]\n", self.call);
        for (title, group) in &self.groups {
            out.push_str(&format!("\n{title}\n"));
            for command in group.get_subcommands() {
                let about = command.get_about().map_or(String::new(), ToString::to_string);
                out.push_str(&format!("  {:<width$}  {about}\n", command.get_name()));
            }
        }
        out.push_str(&format!("\n{}\n", self.end));
        out
    }

    /// Converts an error of clap into help or a usage error.
    pub fn stop(&self, error: &clap::Error) -> Stop {
        let text = error.render().to_string();
        if error.use_stderr() {
            Stop::Wrong(self.one_line(&text))
        } else {
            Stop::Shown(format!("{}\n", text.trim_end()))
        }
    }

    /// Formats the usage error `text` with clap's suggestion, and a reference to the help.
    fn one_line(&self, text: &str) -> String {
        let lines = text.lines().map(str::trim).take_while(|line| !line.starts_with("Usage:"));
        let parts: Vec<&str> = lines.filter(|line| !line.is_empty() && !line.starts_with("For more")).collect();
        let line = parts.join(" ").replace(" tip: ", "; ").replace(" [possible values", "; [possible values");
        let usage = text.lines().find_map(|line| line.trim().strip_prefix("Usage: "));
        let named = usage.and_then(|usage| usage.strip_prefix(self.call)?.split_whitespace().next());
        let command = named.filter(|word| word.starts_with(|c: char| c.is_ascii_lowercase()));
        format!("{line} (see {} {}--help)", self.call, command.map_or(String::new(), |name| format!("{name} ")))
    }
}

/// Returns the exit status of the program after its command. An error is printed; wrong use and findings have their own
/// exit statuses.
pub fn end(outcome: Result<()>) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            match () {
                () if error.is::<Problems>() => ExitCode::from(WRONG),
                () if error.is::<Finding>() => ExitCode::from(FINDING),
                () => ExitCode::FAILURE,
            }
        }
    }
}
