//! Selection of the FMI version of a round, and of the function of a call.

use bevel_differential::instance::Kind;
use fastrand::Rng;

use super::version::{Function, Version};
use super::{fmi2, fmi3};
use crate::random::Draws;

/// Both versions of FMI.
pub static VERSIONS: [&Version; 2] = [&fmi2::VERSION, &fmi3::VERSION];

/// FMI version of a round: `given`, or alternating with the seed.
pub fn version(seed: u64, given: Option<u32>) -> &'static Version {
    let number = given.unwrap_or(2 + (seed % 2) as u32);
    VERSIONS.into_iter().find(|version| version.interface.number == number).unwrap_or(VERSIONS[0])
}

/// Draws a function by its weight; functions for the other kind of instance are rare.
pub fn draw(r: &mut Rng, version: &'static Version, kind: Kind) -> &'static Function {
    let total: usize = version.functions.iter().map(|function| function.weight).sum();
    loop {
        let mut left = r.below(total);
        let chosen = version.functions.iter().find(|function| {
            let found = left < function.weight;
            left = left.saturating_sub(function.weight);
            found
        });
        match chosen {
            Some(function) if function.kind.is_none_or(|own| own == kind) || r.chance(10) => return function,
            _ => {}
        }
    }
}
