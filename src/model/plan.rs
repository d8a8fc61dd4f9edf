//! The scene plan: which bodies move, which are imposed, which planets share their fate.
//!
//! Planets that are identical and in phase start alike and stay alike, so one is simulated and counted as many times
//! as there are.

use super::parameters::{CarrierDrive, GearContact, Parameters, PlanetSpin};
use super::readings::MAX_PLANETS;
use crate::geometry::{Pair, assembly};
use crate::problem::Problem;

/// Largest number of groups: a planet's meshes stand in one of two phases.
pub const MAX_GROUPS: usize = 2;

/// Planets that move alike.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Group {
    /// Phase of the left and right mesh as arcs on the unit sphere [rad].
    pub phase: [f64; 2],
    /// How many planets there are of this kind.
    pub members: f64,
}

/// What a scene needs to simulate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    groups: [Group; MAX_GROUPS],
    group_count: usize,
    /// Group of each planet.
    pub group_of: [usize; MAX_PLANETS],
    /// Number of planets.
    pub planets: usize,
    /// Carrier speed is imposed.
    pub carrier_imposed: bool,
    /// Planet spin is imposed.
    pub spin_imposed: bool,
    /// Representation of tooth contact.
    pub contact: GearContact,
}

impl Plan {
    /// Plan of the scene `p` with gears `pair`, or why its planets do not assemble.
    pub fn new(p: &Parameters, pair: &Pair) -> Result<Self, Problem> {
        let phases = assembly::phases(&p.geometry)?;
        let mut plan = Self {
            groups: [Group::default(); MAX_GROUPS],
            group_count: 0,
            group_of: [0; MAX_PLANETS],
            planets: phases.len(),
            carrier_imposed: p.scene.carrier_drive == CarrierDrive::Speed,
            spin_imposed: p.scene.planet_spin == PlanetSpin::Imposed,
            contact: p.scene.gear_contact,
        };
        for (i, fraction) in phases.iter().enumerate() {
            let phase = fraction.map(|f| f * pair.base_pitch);
            let group = match plan.groups().iter().position(|g| g.phase == phase) {
                Some(group) => group,
                None => {
                    plan.groups[plan.group_count].phase = phase;
                    plan.group_count += 1;
                    plan.group_count - 1
                }
            };
            plan.groups[group].members += 1.0;
            plan.group_of[i] = group;
        }
        Ok(plan)
    }

    /// The same plan with planets that do not spin freely.
    pub fn with_spin_held(self) -> Self {
        Self { spin_imposed: true, ..self }
    }

    /// Group `g` of planets.
    #[inline]
    pub fn group(&self, g: usize) -> &Group {
        &self.groups[g]
    }

    /// The groups of planets.
    pub fn groups(&self) -> &[Group] {
        &self.groups[..self.group_count]
    }

    /// One line that tells what is simulated.
    pub fn describe(&self) -> String {
        let level = match self.contact {
            GearContact::Ideal => "ideal gears",
            GearContact::Tooth => "tooth contact",
        };
        let drive = |imposed| if imposed { "imposed" } else { "free" };
        format!(
            "{level}; carrier speed {}; planet spin {}; {} planets simulated as {}",
            drive(self.carrier_imposed),
            drive(self.spin_imposed),
            self.planets,
            self.groups().iter().map(|g| format!("1 x {}", g.members)).collect::<Vec<_>>().join(" + "),
        )
    }
}
