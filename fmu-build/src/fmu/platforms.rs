//! Platforms to choose for an FMU that shall hold these and no others.

use anyhow::{Result, ensure};
use clap::ValueEnum;

use crate::fmu::libraries::{self, CROSS, HOST, Library};
use crate::fmu::toolchains::{self, WINDOWS};

/// A platform to build the library for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Platform {
    /// Linux on x86-64, old systems too
    Linux64,
    /// Windows on x86-64
    Win64,
    /// This machine, and systems as new as it
    ThisMachine,
}

/// Builds the library for each of `platforms`. A missing tool chain is an error before the first build.
pub fn build(platforms: &[Platform]) -> Result<Vec<Library>> {
    for (i, platform) in platforms.iter().enumerate() {
        let twice = platforms[..i].iter().any(|other| other.fmi_name() == platform.fmi_name());
        ensure!(!twice, "the platform {} is chosen twice; choose it once", platform.fmi_name());
        ensure!(platform.can_be_built(), "{}", platform.hint());
    }
    let built = platforms.iter().map(|platform| match platform {
        Platform::Linux64 => libraries::old_linux(),
        Platform::Win64 => libraries::windows(),
        Platform::ThisMachine => libraries::for_this_machine().map(Some),
    });
    built.filter_map(Result::transpose).collect()
}

impl Platform {
    /// FMI's name.
    pub fn fmi_name(self) -> &'static str {
        match self {
            Self::Linux64 => "linux64",
            Self::Win64 => "win64",
            Self::ThisMachine => HOST.0,
        }
    }

    fn can_be_built(self) -> bool {
        match self {
            Self::Linux64 => CROSS && toolchains::old_linux().found().is_some(),
            Self::Win64 => CROSS && (WINDOWS.found().is_some() || libraries::rustup_has_windows()),
            Self::ThisMachine => true,
        }
    }

    /// What to do where it cannot be built.
    fn hint(self) -> String {
        let (name, install) = (self.fmi_name(), toolchains::COMMAND);
        if CROSS {
            format!(
                "the tool chain for {name} is not installed. Install it: {install} {name}; or choose other platforms: \
                 --platforms linux64, win64 or this-machine"
            )
        } else {
            format!("the library for {name} is built on Linux on x86-64. Here choose --platforms this-machine")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_platform_chosen_twice_is_told_before_anything_is_built() {
        let problem = build(&[Platform::ThisMachine, Platform::ThisMachine]).expect_err("twice").to_string();
        assert!(problem.contains("twice") && problem.contains(HOST.0), "{problem}");
    }
}
