//! Command that builds the libraries and packs the FMU for both versions of FMI.

use std::path::{Path, PathBuf};

use anyhow::Result;
use bevel_differential::variables::MODEL_NAME;
use clap::Args;

use crate::fmu::archive::{Packing, Version, write_archive};
use crate::fmu::libraries::{self, Libraries};
use crate::fmu::{effect_list, page, plain_types, sources};
use crate::tools::paths;
use crate::tools::progress::Progress;

/// Builds target/fmu/BevelDifferential.fmu (FMI 2.0) and BevelDifferential3.fmu (FMI 3.0) for every platform whose tool chain is installed
#[derive(Args, Clone, Debug)]
pub struct PackageCommand {
    /// Also build BevelDifferential_integers.fmu, for hosts without enumerations (libcosim, Ecos)
    #[arg(long)]
    integers: bool,
    /// Also build BevelDifferential_sources.fmu, with the unit as sources in C (FMI 2.0) for real-time systems
    #[arg(long)]
    sources: bool,
    /// Compile the sources in C faster, for a check: they give the same results with more instructions
    #[arg(long, hide = true, requires = "sources")]
    quick: bool,
}

impl PackageCommand {
    /// Packages the FMU and prints its path.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("packaging the FMU");
        let (fmu, mut left_out) = packed()?;
        let mut variants = if self.integers { vec![plain_types::package(&fmu)?] } else { Vec::new() };
        if self.sources {
            progress.stage("building the library for sources in C");
            let packing = if self.quick { Packing::Quick } else { Packing::Small };
            match sources::Tools::found() {
                Ok(tools) => variants.push(sources::package(&tools, packing, &fmu)?),
                Err(remark) => left_out.push(remark),
            }
        }
        progress.finish();
        for file in [fmu.clone(), of_fmi3(&fmu)].iter().chain(&variants) {
            println!("{}", paths::shown(file));
        }
        if !left_out.is_empty() {
            println!("{}", left_out.join("; "));
        }
        Ok(())
    }
}

/// Builds the library with every installed tool chain and packs the FMU to its default path.
pub fn package() -> Result<PathBuf> {
    packed().map(|(fmu, _)| fmu)
}

/// Packs the FMU. Also returns remarks about missing parts and how to get them.
pub fn packed() -> Result<(PathBuf, Vec<String>)> {
    let Libraries { built, mut left_out, ships } = libraries::build()?;
    let (fmu, (page, remark)) = (paths::fmu(), page::made()?);
    let packing = if ships { Packing::Small } else { Packing::Quick };
    write_archive(Version::Two, &built, page.as_deref(), packing, &fmu)?;
    write_archive(Version::Three, &built, page.as_deref(), packing, &of_fmi3(&fmu))?;
    effect_list::write_json(&fmu)?;
    if page.is_none() {
        left_out.push(remark);
    }
    Ok((fmu, left_out))
}

/// Path of the FMU of FMI 3.0, next to the one of FMI 2.0.
pub fn of_fmi3(fmu: &Path) -> PathBuf {
    fmu.with_file_name(format!("{MODEL_NAME}3.fmu"))
}
