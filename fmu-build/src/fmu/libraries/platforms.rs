//! Selection of the platforms that an FMU contains.

use anyhow::{Result, ensure};
use clap::ValueEnum;

use super::library::{CROSS, HOST, Library};
use super::{darwin, linux, own, windows};
use crate::fmu::toolchains;

/// A platform to build the library for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Platform {
    /// Linux on x86-64, including old systems
    Linux64,
    /// Windows on x86-64
    Win64,
    /// Linux on 64-bit ARM, including old systems
    #[value(name = "aarch64-linux")]
    ArmLinux,
    /// macOS on x86-64 and on ARM
    Darwin64,
    /// This machine, and systems that are at least as new
    ThisMachine,
}

/// Platforms that are shipped if their tool chains are installed.
pub const SHIPPED: [Platform; 4] = [Platform::Linux64, Platform::Win64, Platform::ArmLinux, Platform::Darwin64];

/// Builds the library for each of `platforms`, or for all shipped ones if there are none. Fails before the first build
/// if the tool chain of a selected platform is missing, or if no platform can be shipped.
pub fn build(platforms: &[Platform]) -> Result<Vec<Library>> {
    let possible: Vec<Platform> = SHIPPED.into_iter().filter(|platform| platform.can_be_built()).collect();
    let platforms = match platforms {
        [] if possible.is_empty() => &SHIPPED[..1],
        [] => &possible,
        chosen => chosen,
    };
    for (i, platform) in platforms.iter().enumerate() {
        let twice = platforms[..i].iter().any(|other| other.fmi_name() == platform.fmi_name());
        ensure!(!twice, "the platform {} is chosen twice; choose it once", platform.fmi_name());
        ensure!(platform.can_be_built(), "{}", platform.hint());
    }
    let built = platforms.iter().map(|platform| match platform {
        Platform::Linux64 => linux::x86_64(),
        Platform::Win64 => windows::x86_64(),
        Platform::ArmLinux => linux::arm(),
        Platform::Darwin64 => darwin::universal(),
        Platform::ThisMachine => own::for_this_machine().map(Some),
    });
    built.filter_map(Result::transpose).collect()
}

impl Platform {
    /// FMI's name of the platform.
    pub fn fmi_name(self) -> &'static str {
        match self {
            Self::Linux64 => "linux64",
            Self::Win64 => "win64",
            Self::ArmLinux => "aarch64-linux",
            Self::Darwin64 => "darwin64",
            Self::ThisMachine => HOST.0,
        }
    }

    fn can_be_built(self) -> bool {
        match self {
            Self::Linux64 => linux::has_x86_64(),
            Self::Win64 => windows::has_x86_64(),
            Self::ArmLinux => linux::has_arm(),
            Self::Darwin64 => darwin::has_universal(),
            Self::ThisMachine => true,
        }
    }

    /// Advice if the library cannot be built.
    fn hint(self) -> String {
        let (name, install) = (self.fmi_name(), toolchains::COMMAND);
        if CROSS {
            format!(
                "the tool chain for {name} is not installed. Install it: {install} {name}; or choose other platforms: \
                 --platforms linux64, win64, aarch64-linux, darwin64 or this-machine"
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
    fn a_platform_chosen_twice_is_reported_before_anything_is_built() {
        let problem = build(&[Platform::ThisMachine, Platform::ThisMachine]).expect_err("twice").to_string();
        assert!(problem.contains("twice") && problem.contains(HOST.0), "{problem}");
    }
}
