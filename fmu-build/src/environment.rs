//! Command `environment`: prepares Python for the scripts of the laboratory.

use std::collections::BTreeMap;
use std::ffi::OsStr;

use anyhow::{Result, bail};
use clap::Args;
use serde_json::json;

use crate::tools::paths;
use crate::tools::progress::Progress;
use crate::tools::python::{Environment, Wanted};

/// Creates a Python environment unless it exists, and prints its interpreter and variables as JSON
#[derive(Args, Clone, Debug)]
pub struct EnvironmentCommand {
    /// `users`, `tests`, or for a separate one: folder of requirements.txt, folder in the target directory, main packages
    #[arg(required = true, num_args = 1..=3)]
    kind: Vec<String>,
}

impl EnvironmentCommand {
    /// Runs the command. A variable without a value must not be set.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let report = |what: &str| progress.stage(what);
        let words: Vec<&str> = self.kind.iter().map(String::as_str).collect();
        let environment = match words[..] {
            ["users"] => Environment::ready(report)?,
            ["tests"] => Environment::complete(report)?,
            [list, folder, holds] => {
                let requirements = paths::workspace().join(list).join("requirements.txt");
                Wanted { folder: paths::target().join(folder), requirements, holds }.made(report)?
            }
            _ => bail!("{} is not an environment", self.kind.join(" ")),
        };
        progress.finish();
        let command = environment.command();
        let text = |text: &OsStr| text.display().to_string();
        let variables: BTreeMap<String, Option<String>> =
            command.get_envs().map(|(name, value)| (text(name), value.map(text))).collect();
        println!("{}", json!({"program": text(command.get_program()), "variables": variables}));
        Ok(())
    }
}
