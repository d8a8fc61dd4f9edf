//! Stands in for strength in a build that leaves it out: nothing makes one.

use super::loads::ToothLoad;
use super::parameters::Parameters;
use super::readings::Stresses;
use super::state::Fatigue;
use crate::geometry::Pair;
use crate::problem::Problem;

/// Strength that nobody asks for.
#[derive(Clone, Copy, Debug)]
pub struct Strength(());

/// Loads of one mesh that nobody looks at.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshLoad(());

#[allow(missing_docs)]
impl MeshLoad {
    pub fn add(&mut self, _: &Strength, _: &ToothLoad) {}
}

#[allow(missing_docs)]
impl Strength {
    pub fn new(_: &Parameters, _: &Pair) -> Result<Option<Self>, Problem> {
        Ok(None)
    }
    pub fn stresses(&self, _: impl Iterator<Item = MeshLoad>) -> Stresses {
        Stresses::default()
    }
    pub fn count(&self, _: &mut Fatigue, _: &[f64], _: [f64; 2], _: &[[MeshLoad; 2]], _: &[f64]) {}
}
